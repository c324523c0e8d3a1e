//! The words of shared pieces, kept to find the symbol that drew a segment or opened a polygon.

use super::block::{BlockId, Space};
use super::piece::Level;
use crate::room::bytes_of;
use core::ops::Range;

/// The words of shared pieces.
#[derive(Clone, Debug)]
pub(crate) enum Pieces<S: Space> {
    /// No words: nothing is shared, or modules with parameters draw no polygons.
    None,
    /// The pieces of plain letters, by depth from 1.
    Letters(Vec<Level<S>>),
    /// The words of modules with parameters that draw polygons.
    States(StateWords),
}

impl<S: Space> Pieces<S> {
    /// The bytes that the words occupy.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::None => 0,
            Self::Letters(levels) => levels.iter().map(bytes_of).sum(),
            Self::States(words) => words.bytes(),
        }
    }
}

/// The successors of modules with parameters.
#[derive(Clone, Debug, Default)]
pub(crate) struct StateWords {
    /// The modules of all words. For a module that is rewritten: the index of its state at the depth below.
    pub modules: Vec<Option<u32>>,
    /// The axiom's range in `modules`.
    pub axiom: Range<u32>,
    /// The words of all states, by depth from 1.
    pub levels: Vec<Vec<StateWord>>,
}

/// The successor of a state.
#[derive(Clone, Debug)]
pub(crate) struct StateWord {
    /// The successor's range in [`StateWords::modules`].
    pub modules: Range<u32>,
    /// The blocks that the state draws, if any: usually, and while left and right turns are exchanged.
    pub blocks: [Option<BlockId>; 2],
    /// The number of symbols in the state's derivation.
    pub symbols: u128,
}

impl StateWords {
    /// The bytes that the words occupy.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.modules) + self.levels.iter().map(bytes_of).sum::<u64>()
    }
}
