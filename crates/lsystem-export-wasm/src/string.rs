//! Files of strings.

use crate::budget::{HISTORY, LIMITS};
use lsystem_drawing::System;
use lsystem_files::Sink;
use lsystem_syntax::{Diagnostic, Halt, LimitName, Work, run_steps};

/// The number of symbols that are written at a time.
const SYMBOLS: usize = 1 << 15;

/// Writes the string of generation `n`, read piece by piece by counts or from a remembered derivation.
pub(crate) fn write_string(system: &System, n: u32, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let symbols = |n: u32| system.word(n).map(|word| word.symbols());
    let too_long = |count: u128| count > u128::from(LIMITS.symbols);
    match symbols(n) {
        Some(count) if too_long(count) => {
            let largest = (0..n).rev().find(|&n| !symbols(n).is_some_and(too_long));
            Err(Diagnostic::limit(LimitName::Symbols, LIMITS.symbols, largest).into())
        }
        Some(_) => write_pieces(|at| system.word(n).map(|word| word.slice(at, SYMBOLS)).unwrap_or_default(), sink),
        None => {
            let full = |largest| Diagnostic::limit(LimitName::Memory, HISTORY.memory, largest);
            let mut history = system.history(n, &HISTORY).ok_or_else(|| full(None))?;
            run_steps(sink, |units| history.step(units as usize))?;
            if history.symbols(n).is_none() {
                return Err(full((0..n).rev().find(|&n| history.symbols(n).is_some())).into());
            }
            write_pieces(|at| history.slice(n, at, SYMBOLS), sink)
        }
    }
}

/// Writes all pieces of a string, and a newline. `piece` is the piece from a symbol on.
fn write_pieces(mut piece: impl FnMut(u128) -> String, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let mut at = 0;
    loop {
        let text = piece(at);
        if text.is_empty() {
            sink.text.push('\n');
            return Ok(());
        }
        sink.text.push_str(&text);
        sink.charge(SYMBOLS as u64)?;
        at += SYMBOLS as u128;
    }
}
