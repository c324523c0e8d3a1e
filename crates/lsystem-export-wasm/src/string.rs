//! Files of strings.

use crate::budget::{HISTORY, LIMITS, WORK};
use crate::stages::{Begun, FunctionWriter};
use lsystem_drawing::System;
use lsystem_syntax::{Diagnostic, Field, Kind, LimitName, Progress};

/// The number of symbols that are written at a time.
const SYMBOLS: usize = 1 << 15;

/// A file of the string of generation `n`, read piece by piece by counts or from a remembered derivation.
pub(crate) fn string_file(system: System, n: u32) -> Begun {
    let symbols = |n: u32| system.word(n).map(|word| word.symbols());
    let too_long = |count: u128| count > u128::from(LIMITS.symbols);
    let mut history = None;
    match symbols(n) {
        Some(count) if too_long(count) => {
            let mut largest = n.checked_sub(1);
            while let Some(n) = largest.filter(|&n| symbols(n).is_some_and(too_long)) {
                largest = n.checked_sub(1);
            }
            return Err(limit(LimitName::Symbols, LIMITS.symbols, largest));
        }
        Some(_) => {}
        None => history = Some(system.history(n, &HISTORY).ok_or_else(|| limit_of_memory(None))?),
    }
    let mut at = 0;
    Ok(Box::new(FunctionWriter(move |file: &mut Vec<u8>| {
        let text = match &mut history {
            None => system.word(n).map(|word| word.slice(at, SYMBOLS)).unwrap_or_default(),
            Some(history) => {
                if history.symbols(n).is_none() {
                    if history.step(WORK as usize) == Progress::Done && history.symbols(n).is_none() {
                        let largest = (0..n).rev().find(|&n| history.symbols(n).is_some());
                        return Err(limit_of_memory(largest));
                    }
                    return Ok(Progress::More);
                }
                history.slice(n, at, SYMBOLS)
            }
        };
        at += SYMBOLS as u128;
        let progress = if text.is_empty() { Progress::Done } else { Progress::More };
        file.append(&mut text.into_bytes());
        if progress == Progress::Done {
            file.push(b'\n');
        }
        Ok(progress)
    })))
}

fn limit_of_memory(largest: Option<u32>) -> Diagnostic {
    limit(LimitName::Memory, HISTORY.memory, largest)
}

fn limit(limit: LimitName, value: u64, largest: Option<u32>) -> Diagnostic {
    Diagnostic { kind: Kind::Limit { limit, value, largest }, field: Field::Numbers, span: 0..0 }
}
