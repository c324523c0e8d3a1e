//! When a picture is to be put together from the pictures of its parts, because the descent takes too long.

use super::descent::Node;

/// After this many steps, switch to the ascent: that takes as long as some of them at most, whatever is left.
const SOON: u64 = 1_000_000;
/// Switch after a tenth of them already if less than this part of the picture is drawn, and more than 1 in so many steps
/// led to covered subsamples: an ascent's picture is a little off, which shows least in a crowd.
const SLOW: f64 = 1e-5;
const CROWD: u64 = 50;

/// Whether to switch from the descent to the ascent.
pub(super) struct Switch {
    /// The steps after which the ascent is tried.
    pub soon: u64,
    /// The steps after which the crowd is looked at.
    due: u64,
    /// The steps that led to covered subsamples.
    pub covered: u64,
    /// What the ascent would show, as long as it may be tried.
    untried: Option<Whole>,
}

/// What an ascent is started with: the whole drawing, and the upper left and the lower right corner of the whole picture
/// in subsamples, of which this may be a pane.
pub(super) type Whole = (Node, [[f64; 2]; 2]);

impl Default for Switch {
    fn default() -> Self {
        Self { soon: SOON, due: 0, covered: 0, untried: None }
    }
}

impl Switch {
    /// Allows no ascent.
    pub(super) fn forbid(&mut self) {
        self.untried = None;
    }

    /// Allows an ascent of the picture that begins.
    pub(super) fn allow(&mut self, whole: Whole) {
        self.untried = Some(whole);
        (self.due, self.covered) = (self.soon / 10, 0);
    }

    /// What to start the ascent with, if it is to be tried now, after so many `steps`; it is tried only once.
    /// `done` finds out which part of the picture is drawn, which costs more than the rest.
    #[inline]
    pub(super) fn take(&mut self, steps: u64, done: impl FnOnce() -> Option<f64>) -> Option<Whole> {
        if self.untried.is_none() || steps <= self.due {
            return None;
        }
        let late = steps > self.soon || {
            self.due = self.soon;
            self.covered * CROWD > steps && done().is_some_and(|done| done < SLOW)
        };
        if late { self.untried.take() } else { None }
    }
}
