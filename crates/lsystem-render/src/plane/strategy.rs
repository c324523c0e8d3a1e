//! The one place that chooses how a picture is made: from the graph, and from a probe of fixed work.

use super::top_down::{Easel, TopDown};

/// The steps of the probe: a top-down picture is judged after so many. Most pictures take fewer.
const PROBE: u64 = 100_000;
/// The most steps of a top-down picture that is true in every detail: about a second, after which nobody waits for more.
pub(super) const PATIENCE: u64 = 1_000_000;
/// A picture is crowded if more than 1 step in so many led to a covered block. Where few blocks are covered though the
/// picture takes long, blocks lie on a lattice: they coincide exactly, and a bottom-up picture tears them apart.
const CROWDED: u64 = 20;

/// How a picture is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Strategy {
    /// Top-down. Blocks up to this extent, in pixels, are painted as outlines: 0 where every block is looked into.
    TopDown { rough: f64 },
    /// Bottom-up, if the drawing has few enough parts.
    BottomUp,
}

impl Default for Strategy {
    fn default() -> Self {
        Self::TopDown { rough: 0.0 }
    }
}

impl Strategy {
    /// The steps after which a top-down picture is judged, if it has taken so many.
    pub(super) fn next_judgement(steps: u64) -> u64 {
        if steps < PROBE { PROBE } else { PATIENCE }
    }

    /// Judges a picture that has been made top-down for so many `steps`.
    pub(super) fn judge(top_down: &TopDown, easel: &mut Easel<'_>, steps: u64) -> Self {
        let is_crowded = || top_down.covered * CROWDED > steps;
        if steps > PATIENCE || is_crowded() && is_hopeless(top_down.done(easel), steps) {
            Self::BottomUp
        } else {
            Self::default()
        }
    }
}

/// Whether a picture will not be done in time. What is done grows with the square of the steps: the more is covered, the
/// larger are the blocks that are.
fn is_hopeless(done: Option<f64>, steps: u64) -> bool {
    let part = steps as f64 / PATIENCE as f64;
    done.is_some_and(|done| done < part * part)
}
