//! The spaces that a turtle moves in: points, turns, and how they lie in each other.

use crate::rotation::Axis;
use core::fmt::Debug;
use lsystem_syntax::Heading;

/// What a turtle needs to know of its space. In every space a block's frame is the turtle's at its entry: at the
/// origin, heading along +x, its left along +y; in [`Solid`](crate::Solid) space its up along +z.
pub trait Geometry: Copy + Debug + PartialEq + 'static {
    /// Coordinates: x, y, and z where there is one.
    type Point: Copy + Debug + Default + PartialEq + AsRef<[f64]> + AsMut<[f64]>;
    /// How one frame is turned against another.
    type Turn: Copy + Debug + PartialEq;
    /// A turn made ready for being applied to points, perhaps together with a scale.
    type Axes: Copy + Debug;
    /// Remembers axes of turns met before, where that pays.
    type Directions: Clone + Debug;
    /// Straight ahead.
    const AHEAD: Self::Turn;
    /// The axes of [`Geometry::AHEAD`].
    const AXES: Self::Axes;
    /// Upwards in the model.
    const UPWARDS: Self::Point;
    /// Whether the turtle's left is always level, so that to roll upright is nothing.
    const LEVEL: bool;

    /// A memory of directions with nothing in it.
    fn directions() -> Self::Directions;

    /// A rotation by the right-hand rule about one of the turtle's own axes; straight ahead where it would lead out
    /// of the space.
    fn turn(about: Axis, by: Heading) -> Self::Turn;

    /// `first`, and then `next` as seen from there.
    fn then(first: Self::Turn, next: Self::Turn) -> Self::Turn;

    /// The turn rolled until the turtle's left is level (`$`), `vertical` being upwards.
    fn upright(turn: Self::Turn, vertical: &Self::Point) -> Self::Turn;

    /// A direction as it is seen from a frame turned like that.
    fn seen(turn: Self::Turn, direction: Self::Point) -> Self::Point;

    /// The turn bent by a tropism, in a frame with the axes of the model.
    fn bent(turn: Self::Turn, tropism: &Tropism) -> Self::Turn;

    /// The axes of a turn.
    fn axes(directions: &mut Self::Directions, turn: Self::Turn) -> Self::Axes;

    /// The axes with everything `factor` times as long.
    fn scaled(axes: Self::Axes, factor: f64) -> Self::Axes;

    /// Where a point of a frame at `at` with these axes lies.
    fn lie(axes: &Self::Axes, at: Self::Point, point: Self::Point) -> Self::Point;

    /// The point this far ahead of `at`.
    fn ahead(axes: &Self::Axes, at: Self::Point, length: f64) -> Self::Point;

    /// A point from the first coordinates of the model.
    fn point(model: [f64; 3]) -> Self::Point;
}

/// The exponent of the unit in which something that reaches this far is at least 0.5 and less than 1 long. What is
/// next to nothing stays so: the factor that makes it as long would be beyond `f64`.
pub(crate) fn unit_of(reach: f64) -> i32 {
    exponent_of(reach).max(SMALLEST)
}

/// `2^-SMALLEST` is well within `f64`.
const SMALLEST: i32 = -1000;

/// Every coordinate times `factor`.
pub fn times<P: AsMut<[f64]>>(mut point: P, factor: f64) -> P {
    point.as_mut().iter_mut().for_each(|c| *c *= factor);
    point
}

/// Coordinate by coordinate.
pub(crate) fn minus<P: AsMut<[f64]> + AsRef<[f64]>>(mut a: P, b: &P) -> P {
    a.as_mut().iter_mut().zip(b.as_ref()).for_each(|(a, b)| *a -= b);
    a
}

/// The farthest coordinate.
pub(crate) fn reach<P: AsRef<[f64]>>(point: &P) -> f64 {
    point.as_ref().iter().fold(0.0, |reach, c| reach.max(c.abs()))
}

/// A pull upon the turtle's heading (ABOP, section 2.1): after each segment the heading H turns towards the vector T by
/// `elasticity * |H x T|` radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tropism {
    /// T, in the directions of the model: x to the right, y up, z towards the viewer.
    pub vector: [f64; 3],
    /// How easily branches bend.
    pub elasticity: f64,
}

/// The least `e` with `size < 2^e`; 0 for zero.
pub fn exponent_of(size: f64) -> i32 {
    libm::frexp(size).1
}

/// `value`, or the nearest finite number; 0 where there is none.
pub fn finite(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-f64::MAX, f64::MAX) }
}
