//! One derivation step: symbols with what they become.

use crate::steps::Why;
use core::ops::Range;
use lsystem_base::word;
use lsystem_base::{Limits, MAX_ITERATIONS, Progress};
use lsystem_derive::{History, Word};
use lsystem_drawing::System;
use lsystem_syntax::print_module;
use serde::Serialize;

/// The most symbols of a row.
const MAX_SYMBOLS: usize = 400;
/// The most symbols that one symbol is shown to become; further ones are only counted.
const MAX_CHILDREN: usize = 120;
/// The limits of a derivation that has to be remembered.
const LIMITS: Limits =
    Limits { symbols: 4 << 20, modules: 1 << 20, segments: 1 << 22, work: 1 << 24, memory: 24 << 20 };

/// A symbol with what it becomes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
#[cfg_attr(feature = "typescript", ts(rename = "Family"))]
pub struct SymbolFamily {
    /// The symbol, with its arguments.
    pub parent: String,
    /// The successor, symbol by symbol.
    pub children: Vec<String>,
    /// How many symbols are not listed.
    pub more: String,
    /// The place of the first of them in the next generation, 0-based.
    pub first: String,
}

/// Some symbols of a generation, with what they become in the next one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Rows {
    /// The symbols.
    pub families: Vec<SymbolFamily>,
    /// The place of the first of them, 0-based.
    pub start: String,
    /// The numbers of symbols of this generation and of the next one.
    pub lengths: [String; 2],
}

/// A source of symbols: a generation and the next one.
pub(crate) enum Reader<'a> {
    Counted(u32, Box<[Word<'a>; 2]>),
    Remembered(Box<History>, u32),
}

impl<'a> Reader<'a> {
    /// Generations `n` and `n + 1`.
    pub(crate) fn new(system: &'a System, n: u32) -> Result<Self, Why> {
        const LONG: Why = word!("This generation is too long to be read symbol by symbol.");
        let next = n + 1;
        if next > MAX_ITERATIONS {
            return Err(word!("There are no further generations."));
        }
        if let (Some(word), Some(later)) = (system.word(n), system.word(next)) {
            return Ok(Self::Counted(n, Box::new([word, later])));
        }
        let mut history = system.history(next, &LIMITS).ok_or(LONG)?;
        while history.symbols(next).is_none() {
            if history.step(1 << 18) == Progress::Done {
                break;
            }
        }
        if history.symbols(next).is_none() {
            return Err(LONG);
        }
        Ok(Self::Remembered(Box::new(history), n))
    }

    pub(crate) fn lengths(&self) -> [u128; 2] {
        match self {
            Self::Counted(_, words) => [words[0].symbols(), words[1].symbols()],
            Self::Remembered(history, n) => [*n, n + 1].map(|n| history.symbols(n).unwrap_or(0)),
        }
    }

    /// The places in the next generation of what a symbol becomes.
    fn part(&self, index: u128) -> Option<Range<u128>> {
        match self {
            Self::Counted(n, words) => Some(words[1].part(*n, index)?.symbols),
            Self::Remembered(history, n) => Some(history.part(*n, index, n + 1)?.symbols),
        }
    }

    pub(crate) fn modules(&self, is_next: bool, start: u128, length: usize, visit: &mut dyn FnMut(char, &[f64])) {
        match self {
            Self::Counted(_, words) => words[usize::from(is_next)].modules(start, length, visit),
            Self::Remembered(history, n) => history.modules(n + u32::from(is_next), start, length, visit),
        }
    }
}

/// `count` symbols of generation `n` from `start` on, with what they become.
///
/// # Errors
/// A sentence that says why they cannot be read.
pub fn rows(system: &System, n: u32, start: u128, count: usize) -> Result<Rows, Why> {
    let reader = Reader::new(system, n)?;
    let lengths = reader.lengths();
    let start = start.min(lengths[0].saturating_sub(1));
    let mut parents = Vec::new();
    reader
        .modules(false, start, count.min(MAX_SYMBOLS), &mut |symbol, arguments| parents.push(text(symbol, arguments)));
    let families = parents.into_iter().enumerate().map(|(at, parent)| {
        let part = reader.part(start + at as u128).unwrap_or(0..0);
        let length = part.end - part.start;
        let mut children = Vec::new();
        let listed = usize::try_from(length).unwrap_or(usize::MAX).min(MAX_CHILDREN);
        reader.modules(true, part.start, listed, &mut |symbol, arguments| children.push(text(symbol, arguments)));
        SymbolFamily { parent, children, more: (length - listed as u128).to_string(), first: part.start.to_string() }
    });
    Ok(Rows {
        families: families.collect(),
        start: start.to_string(),
        lengths: lengths.map(|length| length.to_string()),
    })
}

pub(crate) fn text(symbol: char, arguments: &[f64]) -> String {
    let mut text = String::new();
    print_module(symbol, arguments, &mut text);
    text
}
