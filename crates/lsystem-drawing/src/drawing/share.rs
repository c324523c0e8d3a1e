//! Drawing with shared pieces: each piece is made once and placed wherever it recurs.
//!
//! A module draws the same piece in the same number of steps, unless chance or neighbours decide. A plain letter has
//! one piece for each number of steps; a module with parameters has one piece for each state.

mod letters;
mod plan;
mod scales;
mod states;
mod vertical;
mod word;

use self::letters::LetterSharing;
use self::states::States;
use super::block::Space;
use super::builder::Builder;
use super::task::{Made, Outcome, Task};
use lsystem_base::Meter;
use lsystem_syntax::Diagnostic;

/// A drawing in the making.
#[derive(Clone, Debug)]
pub(crate) enum Share<S: Space> {
    Letters(LetterSharing<S>),
    States(Box<States<S>>),
}

impl<S: Space> Share<S> {
    /// Whether pieces recur: whether they depend only on letter, parameters, steps and vertical.
    pub(super) fn is_possible(task: &Task<S>) -> bool {
        let memoises = if task.rules.is_plain() { letters::memoises } else { states::memoises };
        memoises(&task.rules, &task.score)
    }

    /// Prepares to draw from the axiom on.
    pub(super) fn new(task: &Task<S>) -> Result<Self, Diagnostic> {
        if task.rules.is_plain() {
            return Ok(Self::Letters(LetterSharing::new(&task.rules)));
        }
        Ok(Self::States(Box::new(States::new(task)?)))
    }

    /// The bytes that the work occupies, without the builder.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Letters(letters) => letters.bytes(),
            Self::States(states) => states.bytes(),
        }
    }

    /// Continues until the meter is spent or a stage is over.
    pub(super) fn step(&mut self, task: &Task<S>, builder: &mut Builder<S>, meter: &mut Meter) -> Outcome<Made<S>> {
        match self {
            Self::Letters(letters) => letters.step(task, builder, meter),
            Self::States(states) => states.step(task, builder, meter),
        }
    }
}
