//! What is to be drawn, and what came of it.

use super::block::{BlockId, Item, Space};
use super::pieces::Pieces;
use crate::Turtle;
use crate::turtle::Score;
use lsystem_derive::Rules;
use lsystem_syntax::{Diagnostic, LimitName, Limits};
use std::sync::Arc;

/// What is to be drawn.
#[derive(Clone, Debug)]
pub(crate) struct Task<S: Space> {
    pub rules: Arc<Rules>,
    pub turtle: Turtle,
    pub score: Score<S>,
    pub seed: u32,
    pub n: u32,
    pub limits: Limits,
}

impl<S: Space> Task<S> {
    /// The most letters that pieces may be made of, and the limit that says so. At least one letter of two makes an item,
    /// by assumption: more letters would need more memory than there is.
    pub(super) fn most_letters(&self) -> (u64, LimitName) {
        let Limits { segments, memory, .. } = self.limits;
        let letters = memory / (size_of::<Item<S>>() as u64 / 2);
        if letters < segments { (letters, LimitName::Memory) } else { (segments, LimitName::Segments) }
    }
}

/// What came of working on.
pub(super) enum Outcome<T> {
    /// The work allowed is done, or a stage; there is more.
    Paused,
    Ended(T),
    /// The pieces are too different to be shared. The largest n for which sharing works.
    Apart(Option<u32>),
    Failed(Diagnostic),
}

/// A drawing whose blocks are all there.
#[derive(Clone, Debug)]
pub(crate) struct Made<S: Space> {
    pub root: Option<BlockId>,
    /// The words of the pieces that it shares.
    pub pieces: Pieces<S>,
    /// The symbols of the generation, where it has been gone through.
    pub symbols: Option<u64>,
}
