//! How the turtle came to the places of a shared drawing.
//!
//! The coordinates of blocks are rounded: in a drawing 10^300 steps wide, two parts that touch lie 10^284 steps apart or
//! overlap by as much. The exact path keeps the way to each place as a sum, so that places can be computed to any precision.

use crate::Plane;
use crate::room::{bytes_for, bytes_of, reserve};
use crate::space::Geometry;

/// A place in the frame of a piece: the turtle enters at the origin heading along +x. The unit is that of the drawing's
/// exact_path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spot(pub(crate) u32);

impl Spot {
    /// The place at which the turtle enters; also where no exact path is kept.
    pub const ENTRY: Self = Self(0);
}

/// The last part of the way to a place: `from + factor * rotate(heading, by)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg<S: Geometry = Plane> {
    pub from: Spot,
    pub by: By,
    pub heading: S::Turn,
    pub factor: f64,
}

/// A way in the turtle's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) enum By {
    /// One unit ahead.
    Ahead,
    /// Through a piece, to its end.
    Piece(Spot),
    /// To a corner, ahead and to the left.
    Corner([f64; 2]),
}

/// The ways to all places of a drawing.
#[derive(Clone, Debug)]
pub(crate) struct ExactPath<S: Geometry = Plane> {
    /// A unit is `2^exponent` steps.
    pub exponent: i32,
    /// By place, from 1 on.
    pub legs: Vec<Leg<S>>,
    /// The places of the drawing's vertices.
    pub vertices: Vec<Spot>,
    /// Whether the exact path is kept.
    pub kept: bool,
}

impl<S: Geometry> ExactPath<S> {
    pub(crate) fn new() -> Self {
        Self { exponent: 0, legs: vec![], vertices: vec![], kept: false }
    }

    /// Begins an exact path, in units of `2^exponent` steps; unless it is `kept`, there is none.
    pub(crate) fn keep(&mut self, kept: bool, exponent: i32) {
        *self = Self { exponent, kept, ..Self::new() };
    }

    /// The place at the end of a leg.
    pub(crate) fn go(&mut self, leg: Leg<S>) -> Spot {
        if !self.kept {
            return Spot::ENTRY;
        }
        reserve(&mut self.legs, 1);
        self.legs.push(leg);
        Spot(self.legs.len() as u32)
    }

    /// The place at the start of the leg to a place.
    pub(crate) fn start(&self, spot: Spot) -> Spot {
        spot.0.checked_sub(1).and_then(|at| self.legs.get(at as usize)).map_or(Spot::ENTRY, |leg| leg.from)
    }

    /// The bytes that the exact path occupies.
    pub(crate) fn bytes(&self) -> u64 {
        bytes_of(&self.legs) + bytes_of(&self.vertices)
    }

    /// The bytes that `more` legs allocate.
    pub(crate) fn bytes_for(&self, more: usize) -> u64 {
        if self.kept { bytes_for(&self.legs, more) } else { 0 }
    }
}
