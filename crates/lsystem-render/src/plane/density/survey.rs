//! The survey of a picture of sums: how closely the drawing can be looked at, in bounded work.

use crate::plane::Amount;

/// Blocks of this extent, in pixels, and smaller ones are put together from tiles.
const TILED: f64 = 64.0;
/// The most blocks of a larger extent that are looked into. If there are more, larger blocks are drawn as haze.
const PATIENCE: u64 = 40_000;
/// By how much the grain becomes finer if there are few blocks, and coarser if there are too many.
const FINER: f64 = 4.0;
const COARSER: f64 = 16.0;

/// What a survey has found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Finding {
    /// Blocks up to this extent, in pixels, are drawn as haze: 0 where none is.
    pub grain: f64,
    /// All ink of the picture, or more.
    pub all: Amount,
}

/// A survey in the making. It counts the blocks whose extent is larger than a grain, with one grain after the other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Survey {
    /// In pixels.
    pub grain: f64,
    /// The ink of all that is no larger.
    all: Amount,
    /// Items visited.
    visits: u64,
    /// Whether there were too many with a smaller grain.
    is_rising: bool,
    /// The finest grain so far with which there were few enough.
    found: Option<Finding>,
}

/// What comes after a count.
pub(super) enum Next {
    /// Another count.
    Count(Survey),
    /// The end of the survey.
    End(Finding),
}

impl Survey {
    /// The first count, of a picture of this size in pixels.
    pub(super) fn new(size: [usize; 2]) -> Self {
        Self { grain: 4.0 * size[0].max(size[1]) as f64, ..Self::default() }
    }

    /// Counts a visit to something with so much ink that is not looked into.
    pub(super) fn count(&mut self, ink: Amount) {
        self.visits += 1;
        self.all = self.all.plus(ink);
    }

    /// Whether there are too many blocks.
    pub(super) fn is_over(&self) -> bool {
        self.visits > PATIENCE
    }

    fn again(&self, grain: f64) -> Next {
        Next::Count(Self { grain, is_rising: self.is_over(), found: self.found, ..Self::default() })
    }

    /// What comes after this count, which is over or has seen everything.
    pub(super) fn next(mut self) -> Next {
        let own = Finding { grain: self.grain, all: self.all };
        match self.found {
            Some(found) if self.is_over() && !self.is_rising => Next::End(found),
            _ if self.is_over() => self.again(COARSER * self.grain),
            _ if self.is_rising => Next::End(own),
            _ if self.grain <= TILED => Next::End(Finding { grain: 0.0, ..own }),
            _ => {
                self.found = Some(own);
                self.again((self.grain / FINER).max(TILED))
            }
        }
    }
}
