//! The spaces that a turtle moves in: their points, turns and frames.

use crate::rotation::Axis;
use core::fmt::Debug;
use lsystem_syntax::Heading;

/// The geometry that a turtle needs. In every space a block's frame is the turtle's frame at entry: position at the
/// origin, heading along +x, left along +y; in [`Solid`](crate::Solid) space up along +z.
pub trait Geometry: Copy + Debug + PartialEq + 'static {
    /// Coordinates: x, y, and in space z.
    type Point: Copy + Debug + Default + PartialEq + AsRef<[f64]> + AsMut<[f64]>;
    /// The rotation from one frame to another.
    type Turn: Copy + Debug + PartialEq;
    /// A turn as vectors, ready to be applied to points, perhaps times a scale.
    type Axes: Copy + Debug;
    /// A cache of the axes of recent turns; empty where computing axes is cheap.
    type Directions: Clone + Debug;
    /// The turn that changes nothing.
    const AHEAD: Self::Turn;
    /// The axes of [`Geometry::AHEAD`].
    const AXES: Self::Axes;
    /// The upward direction of the model.
    const UPWARDS: Self::Point;
    /// Whether the turtle's left is always level, so that `$` changes nothing.
    const LEVEL: bool;

    /// An empty cache of axes.
    fn directions() -> Self::Directions;

    /// A rotation by the right-hand rule about one of the turtle's own axes; [`Geometry::AHEAD`] if the rotation would
    /// leave the space.
    fn turn(about: Axis, by: Heading) -> Self::Turn;

    /// `first`, followed by `next` in the turned frame.
    fn then(first: Self::Turn, next: Self::Turn) -> Self::Turn;

    /// The turn rolled until the turtle's left is level (`$`); `vertical` points upwards.
    fn upright(turn: Self::Turn, vertical: &Self::Point) -> Self::Turn;

    /// A direction in the coordinates of a turned frame.
    fn seen(turn: Self::Turn, direction: Self::Point) -> Self::Point;

    /// The turn bent by a tropism, in a frame with the axes of the model.
    fn bent(turn: Self::Turn, tropism: &Tropism) -> Self::Turn;

    /// The axes of a turn.
    fn axes(directions: &mut Self::Directions, turn: Self::Turn) -> Self::Axes;

    /// The axes times `factor`.
    fn scaled(axes: Self::Axes, factor: f64) -> Self::Axes;

    /// A point of the frame at `at` with these axes, in the coordinates of the outer frame.
    fn transform(axes: &Self::Axes, at: Self::Point, point: Self::Point) -> Self::Point;

    /// The point `length` ahead of `at`.
    fn ahead(axes: &Self::Axes, at: Self::Point, length: f64) -> Self::Point;

    /// A point of this space from model coordinates; the plane leaves out z.
    fn point(model: [f64; 3]) -> Self::Point;
}

/// The exponent `e` of the unit `2^e` in which `reach` is at least 0.5 and less than 1. Below `2^SMALLEST` the exponent
/// stays [`SMALLEST`], because the inverse unit would exceed `f64`.
pub(crate) fn unit_of(reach: f64) -> i32 {
    exponent_of(reach).max(SMALLEST)
}

/// The smallest exponent of a unit; `2^-SMALLEST` is well within `f64`.
const SMALLEST: i32 = -1000;

/// The point with every coordinate times `factor`.
pub fn times<P: AsMut<[f64]>>(mut point: P, factor: f64) -> P {
    point.as_mut().iter_mut().for_each(|c| *c *= factor);
    point
}

/// `a - b`.
pub(crate) fn minus<P: AsMut<[f64]> + AsRef<[f64]>>(mut a: P, b: &P) -> P {
    a.as_mut().iter_mut().zip(b.as_ref()).for_each(|(a, b)| *a -= b);
    a
}

/// The largest absolute coordinate.
pub(crate) fn reach<P: AsRef<[f64]>>(point: &P) -> f64 {
    point.as_ref().iter().fold(0.0, |reach, c| reach.max(c.abs()))
}

/// A tropism (ABOP, section 2.1): after each segment the heading H turns towards the vector T by `elasticity * |H x T|`
/// radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tropism {
    /// T, in the directions of the model: x to the right, y up, z towards the viewer.
    pub vector: [f64; 3],
    /// How easily branches bend.
    pub elasticity: f64,
}

/// The least `e` with `|size| < 2^e`; 0 for zero.
pub fn exponent_of(size: f64) -> i32 {
    libm::frexp(size).1
}

/// `value`, or the nearest finite number; 0 for NaN.
pub fn finite(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-f64::MAX, f64::MAX) }
}
