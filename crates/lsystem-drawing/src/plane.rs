//! The plane: headings are integers.

use crate::rotation::Axis;
use crate::space::{Geometry, Tropism};
use lsystem_syntax::Heading;

/// Drawings in the plane, x to the right and y up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plane;

impl Geometry for Plane {
    type Point = [f64; 2];
    /// Counter-clockwise.
    type Turn = Heading;
    /// Cosine and sine.
    type Axes = (f64, f64);
    type Directions = Directions;
    const AHEAD: Heading = Heading::EAST;
    const AXES: (f64, f64) = (1.0, 0.0);
    const UPWARDS: [f64; 2] = [0.0, 1.0];
    const LEVEL: bool = true;

    fn directions() -> Directions {
        Directions::default()
    }

    fn turn(about: Axis, by: Heading) -> Heading {
        if about == Axis::Up { by } else { Heading::EAST }
    }

    fn then(first: Heading, next: Heading) -> Heading {
        first + next
    }

    fn upright(turn: Heading, _: &[f64; 2]) -> Heading {
        turn
    }

    fn seen(turn: Heading, [x, y]: [f64; 2]) -> [f64; 2] {
        let (c, s) = turn.cos_sin();
        [c * x + s * y, c * y - s * x]
    }

    fn bent(turn: Heading, tropism: &Tropism) -> Heading {
        let ((c, s), [x, y, _]) = (turn.cos_sin(), tropism.vector);
        turn + Heading::from_degrees(tropism.elasticity * (c * y - s * x) * (180.0 / core::f64::consts::PI))
    }

    fn axes(directions: &mut Directions, turn: Heading) -> (f64, f64) {
        directions.cos_sin(turn)
    }

    fn scaled((c, s): (f64, f64), factor: f64) -> (f64, f64) {
        (c * factor, s * factor)
    }

    fn transform(&(c, s): &(f64, f64), [x, y]: [f64; 2], [u, v]: [f64; 2]) -> [f64; 2] {
        [x + (c * u - s * v), y + (s * u + c * v)]
    }

    fn ahead(&(c, s): &(f64, f64), [x, y]: [f64; 2], length: f64) -> [f64; 2] {
        [x + length * c, y + length * s]
    }

    fn point([x, y, _]: [f64; 3]) -> [f64; 2] {
        [x, y]
    }
}

/// A cache of cosines and sines by heading: a turtle has few headings and repeats them.
#[derive(Clone, Debug)]
pub struct Directions {
    slots: Vec<(Heading, f64, f64)>,
}

impl Default for Directions {
    fn default() -> Self {
        Self { slots: vec![(Heading::EAST, 1.0, 0.0); 1 << Self::BITS] }
    }
}

impl Directions {
    /// The cache has `2^BITS` places: enough for all multiples of most angles. Systems with 3600 headings use few at a
    /// time.
    const BITS: u32 = 10;

    /// As [`Heading::cos_sin`].
    pub fn cos_sin(&mut self, heading: Heading) -> (f64, f64) {
        let hash = heading.units().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - Self::BITS);
        let slot = &mut self.slots[hash as usize];
        if slot.0 != heading {
            let (c, s) = heading.cos_sin();
            *slot = (heading, c, s);
        }
        (slot.1, slot.2)
    }
}
