//! The strings of a system, their lengths and places: what is derived, asked of the whole system.

use crate::System;
use crate::drawn::{drawn_alone, drawn_by_letter};
use lsystem_derive::{Counter, History, Tally, Word};
use lsystem_syntax::{Diagnostic, Limits, Meter};

/// What one derivation step makes of `symbol`, as [`lsystem_derive::expand_symbol`].
#[must_use]
pub fn expand_symbol(system: &System, symbol: char, roll: f64) -> String {
    lsystem_derive::expand_symbol(&system.rules, symbol, roll)
}

/// What derivation step `step` (1-based) makes of `word`, as [`lsystem_derive::expand_once`].
#[must_use]
pub fn expand_once(system: &System, word: &str, step: u32) -> String {
    lsystem_derive::expand_once(&system.grammar, &system.rules, system.seed, word, step)
}

/// The string of generation `n`.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit) where the string would have more than [`Limits::symbols`] symbols, or `n`
/// is above [`MAX_ITERATIONS`](lsystem_syntax::MAX_ITERATIONS).
pub fn expand(system: &System, n: u32, limits: &Limits) -> Result<String, Diagnostic> {
    expand_counted(system, n, limits).0
}

/// The string of generation `n`, in place of what `text` held. A buffer that is used again saves the first touch of
/// its memory, which costs more than the derivation.
///
/// # Errors
/// As [`expand`]; `text` is then empty.
pub fn expand_into(system: &System, n: u32, limits: &Limits, text: &mut String) -> Result<(), Diagnostic> {
    lsystem_derive::expand(&system.rules, system.seed, n, limits, text, &mut Meter::new(u64::MAX))
}

/// The same, with the units of work that it takes: about [`Limits::symbols`] and some times [`Limits::work`] at most.
pub fn expand_counted(system: &System, n: u32, limits: &Limits) -> (Result<String, Diagnostic>, u64) {
    let (mut text, mut meter) = (String::new(), Meter::new(u64::MAX));
    let outcome = lsystem_derive::expand(&system.rules, system.seed, n, limits, &mut text, &mut meter);
    (outcome.map(|()| text), meter.spent())
}

/// How many symbols generation `n` has, modules with parameters counted as one; `None` where that depends on random
/// choices, contexts, conditions or cut branches, or where the numbers on the way would take more than
/// [`MAX_COUNTING`](lsystem_syntax::MAX_COUNTING). [`System::symbols`] does the same in steps.
#[must_use]
pub fn count_symbols(system: &System, n: u32) -> Option<Tally> {
    system.symbols(n).finish()
}

/// How many segments generation `n` draws; `None` as for [`count_symbols`].
#[must_use]
pub fn count_segments(system: &System, n: u32) -> Option<Tally> {
    system.segments(n).finish()
}

impl System {
    /// Ready to count the symbols of generation `n`.
    #[must_use]
    pub fn symbols(&self, n: u32) -> Counter {
        Counter::symbols(&self.rules, n)
    }

    /// Ready to count the segments that generation `n` draws.
    #[must_use]
    pub fn segments(&self, n: u32) -> Counter {
        Counter::weighing(&self.rules, n, drawn_by_letter(self).as_deref())
    }

    /// Generation `n`, read in place; `None` where [`Word`] cannot.
    #[must_use]
    pub fn word(&self, n: u32) -> Option<Word<'_>> {
        self.word_counted(n).0
    }

    /// The same, with the units of work that it takes.
    #[must_use]
    pub fn word_counted(&self, n: u32) -> (Option<Word<'_>>, u64) {
        Word::new(&self.rules, self.seed, n, drawn_by_letter(self).as_deref())
    }

    /// Ready to derive up to generation `n` and remember it; `None` as for [`History::new`].
    #[must_use]
    pub fn history(&self, n: u32, limits: &Limits) -> Option<History> {
        History::new(&self.rules, self.seed, n, drawn_alone(self), limits)
    }
}
