//! The words of shared pieces, kept to find which symbol drew a segment or opened a polygon.

use super::block::{BlockId, Space};
use super::piece::Level;
use crate::room::bytes_of;
use core::ops::Range;

/// The words of shared pieces.
#[derive(Clone, Debug)]
pub(crate) enum Pieces<S: Space> {
    /// Nothing is shared, or modules with parameters draw no polygons.
    None,
    /// Of plain letters, by depth from 1.
    Letters(Vec<Level<S>>),
    /// Of modules with parameters that draw polygons.
    States(StateWords),
}

impl<S: Space> Pieces<S> {
    /// The bytes that they take.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::None => 0,
            Self::Letters(levels) => levels.iter().map(bytes_of).sum(),
            Self::States(words) => words.bytes(),
        }
    }
}

/// The words that modules with parameters become, as far as they tell which symbol draws what.
#[derive(Clone, Debug, Default)]
pub(crate) struct StateWords {
    /// The modules of all words: the state of one that is rewritten, among those of the depth below.
    pub modules: Vec<Option<u32>>,
    /// The axiom's modules.
    pub axiom: Range<u32>,
    /// The states by depth from 1.
    pub levels: Vec<Vec<StateWord>>,
}

/// What a module becomes.
#[derive(Clone, Debug)]
pub(crate) struct StateWord {
    /// The modules that replace it.
    pub modules: Range<u32>,
    /// The block that it draws, if any.
    pub block: Option<BlockId>,
    /// The number of symbols in its derivation.
    pub symbols: u128,
}

impl StateWords {
    /// The bytes that they take.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.modules) + self.levels.iter().map(bytes_of).sum::<u64>()
    }
}
