//! Straight work: one call from its beginning to its end, counted by an owner who may stop it.

use crate::Diagnostic;
use lsystem_base::{LimitName, Meter, Progress};

/// The reason why work ended early.
#[derive(Clone, Debug, PartialEq)]
pub enum Halt {
    /// A limit is exceeded, or the work is impossible for this input.
    Limit(Diagnostic),
    /// The owner wants no more.
    Stopped,
}

impl Halt {
    /// The diagnostic of work that nobody stops.
    #[must_use]
    pub fn diagnostic(self) -> Diagnostic {
        match self {
            Self::Limit(diagnostic) => diagnostic,
            Self::Stopped => Diagnostic::limit(LimitName::Work, 0, None),
        }
    }
}

impl From<Diagnostic> for Halt {
    fn from(diagnostic: Diagnostic) -> Self {
        Self::Limit(diagnostic)
    }
}

/// Counts work, and may stop it.
pub trait Work {
    /// Counts units of work. Charge at most [`Meter::PIECE`] units at a time, and a long loop in each of its rounds.
    ///
    /// # Errors
    /// [`Halt::Stopped`] if the work must end. Pass the error on.
    fn charge(&mut self, units: u64) -> Result<(), Halt>;
}

/// A meter counts, and never stops the work.
impl Work for Meter {
    fn charge(&mut self, units: u64) -> Result<(), Halt> {
        Self::charge(self, units);
        Ok(())
    }
}

/// The units of work of a step of resumable work: well under a millisecond.
const SHARE: u64 = 1 << 14;

/// Runs resumable work to its end. `step` works for about as many units as it is given.
///
/// # Errors
/// If the work is stopped.
pub fn run_steps(work: &mut dyn Work, mut step: impl FnMut(u64) -> Progress) -> Result<(), Halt> {
    while step(SHARE) == Progress::More {
        work.charge(SHARE)?;
    }
    Ok(())
}
