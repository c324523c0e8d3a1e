//! The girth of a drawing in space: its reach from an upright axis at every height, so that a picture has room for the
//! drawing at every rotation about that axis.

use super::body::{Body, Quantity};
use crate::Solid;
use crate::drawing::block::Placed;
use crate::rotation::{Vector, dot, norm};

/// The number of directions in which a drawing is measured, from straight down to straight up.
const DIRECTIONS: usize = 9;
/// The wanted error of a reach, in units of the root block: a tenth of a pixel in a picture of 1000 pixels.
pub(super) const EXACT: f64 = 1e-4;

/// Points as distances from the axis and heights above the centre, in units of the root block. The circles of these
/// points about the axis contain the whole drawing in their convex hull.
pub(crate) type Girth = [[f64; 2]; DIRECTIONS - 1];

/// The girth of a drawing with this reach in the directions of [`OutwardCoordinate::new`].
pub(super) fn girth(reach: &[f64]) -> Option<Girth> {
    let reach: [f64; DIRECTIONS] = reach.try_into().ok()?;
    // A point is the meeting point of the bounds in two neighbouring directions.
    Some(core::array::from_fn(|number| {
        let ([a, b], [c, d]) = (steep(number), steep(number + 1));
        let [first, second] = [reach[number], reach[number + 1]];
        let across = a * d - b * c;
        [((first * d - second * b) / across).max(0.0), (a * second - c * first) / across]
    }))
}

/// The direction `number` as a unit vector: away from the axis, and along it.
fn steep(number: usize) -> [f64; 2] {
    let angle = (number as f64 / (DIRECTIONS - 1) as f64 - 0.5) * core::f64::consts::PI;
    [libm::cos(angle).max(0.0), libm::sin(angle)]
}

/// The coordinate of a point in a direction away from an axis and along it.
#[derive(Clone, Copy, Debug)]
pub(super) struct OutwardCoordinate {
    from: Vector,
    up: Vector,
    /// The direction as a unit vector: away from the axis, and along it.
    by: [f64; 2],
    scale: f64,
}

impl OutwardCoordinate {
    /// The quantity for direction `number` (0-based) about the upright axis through `from`; `None` after the last
    /// direction.
    pub(super) fn new(from: Vector, number: usize) -> Option<Self> {
        (number < DIRECTIONS).then(|| Self { from, up: [0.0, 1.0, 0.0], by: steep(number), scale: 1.0 })
    }
}

impl Quantity for OutwardCoordinate {
    fn of(&self, point: Vector) -> f64 {
        let way = [0, 1, 2].map(|i| point[i] - self.from[i]);
        let height = dot(way, self.up);
        let aside = norm([0, 1, 2].map(|i| way[i] - height * self.up[i]));
        self.scale * (self.by[0] * aside + self.by[1] * height)
    }

    fn most(&self, body: &Body) -> f64 {
        self.of(body.centre()) + self.scale * body.radius
    }

    fn least(&self, body: &Body, _: f64) -> f64 {
        self.of(body.centre()) - self.scale * body.radius
    }

    fn within(&self, placed: &Placed<Solid>) -> Self {
        Self {
            from: placed.heading.undo([0, 1, 2].map(|i| (self.from[i] - placed.at[i]) / placed.scale)),
            up: placed.heading.undo(self.up),
            by: self.by,
            scale: self.scale * placed.scale,
        }
    }
}
