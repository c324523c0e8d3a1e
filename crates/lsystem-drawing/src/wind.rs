//! The sway of a plant in the wind.

use crate::rotation::Axis;
use crate::space::{Geometry, finite};
use lsystem_syntax::Heading;

/// A sway: each branch begins with a small turn, and a branch that a later step made with a later phase, so that waves
/// run through the plant, from the trunk to the twigs. Blocks stay shared, because all branches of a step turn alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wind {
    /// The greatest turn of a branch against its bough, in degrees.
    pub strength: f64,
    /// The time, as a part of the wave's period.
    pub phase: Heading,
}

/// The derivation steps from one crest of the wave to the next. A guess: many branches in branches bend by less than
/// three times the strength, whereas without a wave their turns would add up.
pub(crate) const WAVE: usize = 9;
/// The part of the strength by which the whole plant leans.
const ROOT: f64 = 1.0 / 3.0;
/// The part of the strength across the wind, so that the tips go around flat loops in space.
const ACROSS: f64 = 0.4;

impl Wind {
    /// A sway of a strength and with a phase, in degrees; `None` if nothing sways.
    #[must_use]
    pub fn new([strength, phase]: [f64; 2]) -> Option<Self> {
        let strength = finite(strength);
        (strength != 0.0).then(|| Self { strength, phase: Heading::from_degrees(phase) })
    }

    /// The turn of a branch that derivation step `step` made.
    pub(crate) fn after<S: Geometry>(&self, step: usize) -> S::Turn {
        let lag = Heading::from_degrees(360.0 / WAVE as f64 * (step % WAVE) as f64);
        turned::<S>(self.strength, self.phase - lag)
    }

    /// The turn of the whole plant.
    pub(crate) fn at_root<S: Geometry>(&self) -> S::Turn {
        turned::<S>(self.strength * ROOT, self.phase)
    }
}

/// A place on the flat loop: to the left by the sine of the phase, and in space downwards by its cosine.
fn turned<S: Geometry>(strength: f64, phase: Heading) -> S::Turn {
    let (c, s) = phase.cos_sin();
    let left = S::turn(Axis::Up, Heading::from_degrees(strength * s));
    S::then(left, S::turn(Axis::Left, Heading::from_degrees(strength * ACROSS * c)))
}
