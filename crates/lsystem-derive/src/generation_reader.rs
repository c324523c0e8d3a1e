//! One generation of a derivation, whichever way it is read.

use crate::{Ancestor, DerivedPart, History, Word};

/// A generation that can be read from any place on.
#[derive(Clone, Debug)]
pub enum GenerationReader<'a> {
    /// By the numbers of symbols that letters derive.
    Counted(Word<'a>),
    /// From a remembered derivation; the number of the generation.
    Remembered(&'a History, u32),
}

impl GenerationReader<'_> {
    /// The number of symbols, saturating; `None` if the generation is not derived.
    #[must_use]
    pub fn symbols(&self) -> Option<u128> {
        match self {
            Self::Counted(word) => Some(word.symbols()),
            Self::Remembered(history, n) => history.symbols(*n),
        }
    }

    /// As [`Word::modules`].
    pub fn modules(&self, start: u128, length: usize, visit: &mut dyn FnMut(char, &[f64])) {
        match self {
            Self::Counted(word) => word.modules(start, length, visit),
            Self::Remembered(history, n) => history.modules(*n, start, length, visit),
        }
    }

    /// As [`Word::ancestry`].
    #[must_use]
    pub fn ancestry(&self, index: u128) -> Vec<Ancestor> {
        match self {
            Self::Counted(word) => word.ancestry(index),
            Self::Remembered(history, n) => history.ancestry(*n, index),
        }
    }

    /// As [`Word::part`].
    #[must_use]
    pub fn part(&self, earlier: u32, index: u128) -> Option<DerivedPart> {
        match self {
            Self::Counted(word) => word.part(earlier, index),
            Self::Remembered(history, n) => history.part(earlier, index, *n),
        }
    }

    /// As [`Word::symbol_of_segment`], in the last generation of a remembered derivation.
    #[must_use]
    pub fn symbol_of_segment(&self, segment: u128) -> Option<u128> {
        match self {
            Self::Counted(word) => word.symbol_of_segment(segment),
            Self::Remembered(history, _) => history.symbol_of_segment(segment),
        }
    }

    /// As [`Word::segments_before`], in the last generation of a remembered derivation.
    #[must_use]
    pub fn segments_before(&self, index: u128) -> Option<u128> {
        match self {
            Self::Counted(word) => Some(word.segments_before(index)),
            Self::Remembered(history, _) => history.segments_before(index),
        }
    }
}
