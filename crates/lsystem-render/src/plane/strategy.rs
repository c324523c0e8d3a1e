//! The choice of the strategy, from the graph and from a probe of fixed work.

use super::top_down::{Context, TopDown};

/// The steps of the probe: a top-down picture is judged after this many. Most pictures take fewer.
const PROBE: u64 = 100_000;
/// The most steps of a top-down picture in full detail: about a second, the longest wait that the reader is given.
pub(super) const MAX_STEPS: u64 = 1_000_000;
/// A picture is crowded if more than 1 in 20 steps led to a covered block. A long picture with fewer covered blocks has
/// blocks on a lattice: they coincide exactly, and a bottom-up picture would tear them apart.
const CROWDED: u64 = 20;

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strategy {
    /// Top-down. Blocks up to the extent `outlined`, in pixels, are painted as outlines; 0 means none.
    TopDown { outlined: f64 },
    /// Bottom-up, if the parts of the drawing are few enough.
    BottomUp,
}

impl Default for Strategy {
    fn default() -> Self {
        Self::TopDown { outlined: 0.0 }
    }
}

impl Strategy {
    /// The number of steps at which a top-down picture that has taken `steps` is judged next.
    pub(super) fn next_judgement(steps: u64) -> u64 {
        if steps < PROBE { PROBE } else { MAX_STEPS }
    }

    /// The strategy for the rest of a picture that has been made top-down for `steps`.
    pub(super) fn judge(top_down: &TopDown, context: &mut Context<'_>, steps: u64) -> Self {
        let is_crowded = || top_down.covered * CROWDED > steps;
        if steps > MAX_STEPS || is_crowded() && is_hopeless(top_down.done(context), steps) {
            Self::BottomUp
        } else {
            Self::default()
        }
    }
}

/// Whether a picture will take more than [`MAX_STEPS`]. The part that is done grows with the square of the steps: the
/// fuller the canvas, the larger are the blocks that are covered as a whole.
fn is_hopeless(done: Option<f64>, steps: u64) -> bool {
    let part = steps as f64 / MAX_STEPS as f64;
    done.is_some_and(|done| done < part * part)
}
