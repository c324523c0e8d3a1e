//! The survey of a picture of sums: finds in bounded work the least extent of blocks that can be drawn.

use crate::ink::Amount;

/// Blocks up to this extent, in pixels, are put together from tiles.
const TILED: f64 = 64.0;
/// The most visits of a count. With more, larger blocks are drawn as haze.
const MAX_VISITS: u64 = 40_000;
/// As [`MAX_VISITS`], in a sketch.
const SKETCH_VISITS: u64 = 2_500;
/// If a count is not over, the next grain is divided by this.
const FINER: f64 = 4.0;
/// If a count is over, the next grain is multiplied by this.
const COARSER: f64 = 16.0;

/// The result of a survey.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Finding {
    /// Blocks up to this extent, in pixels, are drawn as haze; 0 means none.
    pub grain: f64,
    /// An upper bound of all ink of the picture.
    pub all: Amount,
}

/// One count of a survey: the visits if blocks larger than a grain are looked into. A survey counts with one grain
/// after the other.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Survey {
    /// The grain in pixels.
    pub grain: f64,
    /// The most visits of a count.
    most: u64,
    /// The ink of all visited items that are not looked into.
    all: Amount,
    /// The items visited.
    visits: u64,
    /// Whether the count before, with a finer grain, was over.
    is_rising: bool,
    /// The finding with the finest grain so far.
    found: Option<Finding>,
}

/// The step after a count.
pub(super) enum Next {
    /// Another count.
    Count(Survey),
    /// The end of the survey.
    End(Finding),
}

impl Survey {
    /// The first count, of a picture of this size in pixels.
    pub(super) fn new(size: [usize; 2], is_sketch: bool) -> Self {
        let most = if is_sketch { SKETCH_VISITS } else { MAX_VISITS };
        Self { grain: 4.0 * size[0].max(size[1]) as f64, most, ..Self::default() }
    }

    /// Counts a visit to an item; `ink` is 0 if the item is looked into.
    pub(super) fn count(&mut self, ink: Amount) {
        self.visits += 1;
        self.all = self.all.plus(ink);
    }

    /// Whether there were too many visits.
    pub(super) fn is_over(&self) -> bool {
        self.visits > self.most
    }

    fn count_with(&self, grain: f64) -> Next {
        Next::Count(Self { grain, most: self.most, is_rising: self.is_over(), found: self.found, ..Self::default() })
    }

    /// The step after this count, which is over or complete.
    pub(super) fn next(mut self) -> Next {
        let own = Finding { grain: self.grain, all: self.all };
        match self.found {
            Some(found) if self.is_over() && !self.is_rising => Next::End(found),
            _ if self.is_over() => self.count_with(COARSER * self.grain),
            _ if self.is_rising => Next::End(own),
            _ if self.grain <= TILED => Next::End(Finding { grain: 0.0, ..own }),
            _ => {
                self.found = Some(own);
                self.count_with((self.grain / FINER).max(TILED))
            }
        }
    }
}
