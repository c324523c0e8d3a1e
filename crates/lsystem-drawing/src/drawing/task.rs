//! The input and the outcome of drawing.

use super::block::{BlockId, Item, Space};
use super::pieces::Pieces;
use crate::Turtle;
use crate::turtle::Score;
use lsystem_base::{LimitName, Limits};
use lsystem_derive::Rules;
use lsystem_syntax::Diagnostic;
use std::sync::Arc;

/// A system, a generation and limits to draw within.
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
    /// The most letters in the words of all pieces, and the limit that sets it. The memory limit assumes, as a guess,
    /// that every second letter makes an item.
    pub(super) fn most_letters(&self) -> (u64, LimitName) {
        let Limits { segments, memory, .. } = self.limits;
        let letters = memory / (size_of::<Item<S>>() as u64 / 2);
        if letters < segments { (letters, LimitName::Memory) } else { (segments, LimitName::Segments) }
    }
}

/// The outcome of a step.
pub(super) enum Outcome<T> {
    /// The budget is spent or a stage is over; there is more to do.
    Paused,
    Ended(T),
    /// The pieces are too different to be shared. The largest n for which sharing works, if any.
    NotShareable(Option<u32>),
    Failed(Diagnostic),
}

/// The result after all blocks are made.
#[derive(Clone, Debug)]
pub(crate) struct Made<S: Space> {
    pub root: Option<BlockId>,
    /// The words of the shared pieces.
    pub pieces: Pieces<S>,
    /// The number of symbols of the generation, if counted.
    pub symbols: Option<u64>,
}
