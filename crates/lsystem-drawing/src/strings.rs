//! The strings that a system derives, their lengths, and the places of their symbols.

use crate::System;
use crate::drawn::{drawn_alone, drawn_by_letter};
use lsystem_base::{Limits, Meter};
use lsystem_derive::{Counter, History, Tally, Word};
use lsystem_syntax::Diagnostic;

/// The successor of `symbol` after one derivation step, as [`lsystem_derive::derive_symbol`].
#[must_use]
pub fn expand_symbol(system: &System, symbol: char, roll: f64) -> String {
    lsystem_derive::derive_symbol(&system.rules, symbol, roll)
}

/// The word that derivation step `step` (1-based) makes from `word`, as [`lsystem_derive::derive_once`].
#[must_use]
pub fn expand_once(system: &System, word: &str, step: u32) -> String {
    lsystem_derive::derive_once(&system.grammar, &system.rules, system.seed, word, step)
}

/// The string of generation `n`.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if the string would have more than [`Limits::symbols`] symbols, or if
/// `n` is above [`MAX_ITERATIONS`](lsystem_base::MAX_ITERATIONS).
pub fn expand(system: &System, n: u32, limits: &Limits) -> Result<String, Diagnostic> {
    expand_counted(system, n, limits).0
}

/// Replaces `text` by the string of generation `n`. A reused buffer is faster: the first write to fresh memory costs
/// more than the derivation.
///
/// # Errors
/// As [`expand`]; `text` is then empty.
pub fn expand_into(system: &System, n: u32, limits: &Limits, text: &mut String) -> Result<(), Diagnostic> {
    lsystem_derive::derive_string(&system.rules, system.seed, n, limits, text, &mut Meter::new(u64::MAX))
}

/// As [`expand`], with the units of work spent: at most about [`Limits::symbols`] plus a small multiple of
/// [`Limits::work`].
pub fn expand_counted(system: &System, n: u32, limits: &Limits) -> (Result<String, Diagnostic>, u64) {
    let (mut text, mut meter) = (String::new(), Meter::new(u64::MAX));
    let outcome = lsystem_derive::derive_string(&system.rules, system.seed, n, limits, &mut text, &mut meter);
    (outcome.map(|()| text), meter.spent())
}

/// The number of symbols of generation `n`; a module with parameters is one symbol. `None` if the number depends on
/// random choices, contexts, conditions or cut branches, or if the counts would take more than
/// [`MAX_COUNTING`](lsystem_base::MAX_COUNTING). [`System::symbols`] counts in steps.
#[must_use]
pub fn count_symbols(system: &System, n: u32) -> Option<Tally> {
    system.symbols(n).finish()
}

/// The number of segments that generation `n` draws; `None` as for [`count_symbols`].
#[must_use]
pub fn count_segments(system: &System, n: u32) -> Option<Tally> {
    system.segments(n).finish()
}

impl System {
    /// A counter of the symbols of generation `n`.
    #[must_use]
    pub fn symbols(&self, n: u32) -> Counter {
        Counter::symbols(&self.rules, n)
    }

    /// A counter of the segments that generation `n` draws.
    #[must_use]
    pub fn segments(&self, n: u32) -> Counter {
        Counter::weighing(&self.rules, n, drawn_by_letter(self).as_deref())
    }

    /// Generation `n` for reading without deriving all of it; `None` as for [`Word::new`].
    #[must_use]
    pub fn word(&self, n: u32) -> Option<Word<'_>> {
        self.word_counted(n).0
    }

    /// As [`System::word`], with the units of work spent.
    #[must_use]
    pub fn word_counted(&self, n: u32) -> (Option<Word<'_>>, u64) {
        Word::new(&self.rules, self.seed, n, drawn_by_letter(self).as_deref())
    }

    /// A derivation up to generation `n` that remembers all generations; `None` as for [`History::new`].
    #[must_use]
    pub fn history(&self, n: u32, limits: &Limits) -> Option<History> {
        History::new(&self.rules, self.seed, n, drawn_alone(self), limits)
    }
}
