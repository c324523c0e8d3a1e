//! The spaces that a turtle moves in: one drawing, one builder and one reader serve all of them.

use crate::Tropism;
use crate::drawing::SceneSize;
use crate::drawing::{BlockId, Builder, Contents, Enclosed, Item};
use crate::turtle::exponent_of;
use core::fmt::Debug;
use lsystem_syntax::{Heading, Meter};

/// What a drawing needs to know of its space. In every space a block's frame is the turtle's at its entry: at the
/// origin, heading along +x, its left along +y; in [`Solid`](crate::Solid) space its up along +z.
pub trait Space: Copy + Debug + PartialEq + 'static {
    /// Coordinates: x, y, and z where there is one.
    type Point: Copy + Debug + Default + PartialEq + AsRef<[f64]> + AsMut<[f64]>;
    /// How one frame is turned against another.
    type Turn: Copy + Debug + PartialEq;
    /// A turn made ready for being applied to points, perhaps together with a scale.
    type Axes: Copy + Debug;
    /// Remembers axes of turns met before, where that pays.
    type Directions: Clone + Debug;
    /// A convex body that contains what a block draws, in block units.
    type Hull: Clone + Debug;
    /// The smallest box around a drawing.
    type Extent: Copy + Debug;
    /// Looks for that box.
    type Survey: Clone + Debug;

    /// Straight ahead.
    const AHEAD: Self::Turn;
    /// The axes of [`Space::AHEAD`].
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

    /// What contains all `items`, which may place blocks that the builder has made.
    fn enclose(builder: &mut Builder<Self>, items: &[Item<Self>]) -> Enclosed<Self>;

    /// Counts what a block with these items takes where pictures are made of it, beside the drawing itself.
    fn measure(_size: &mut SceneSize, _items: &[Item<Self>]) {}

    /// What a segment takes there at least, in bytes.
    fn least_picture() -> u64 {
        0
    }

    /// Ready to look for the extent of a block in its own units.
    fn survey(root: BlockId) -> Self::Survey;

    /// Looks on until the meter is spent; the extent when it is found, after a bounded number of calls. It does not
    /// depend on how much each of them may do.
    fn advance(survey: &mut Self::Survey, contents: Contents<'_, Self>, meter: &mut Meter) -> Option<Self::Extent>;
}

/// One of the turtle's own axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// The heading: a positive turn about it rolls the turtle's left upwards.
    Ahead,
    /// To the left: a positive turn about it pitches the heading down.
    Left,
    /// Upwards: a positive turn about it turns the heading to the left.
    Up,
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
