//! How far a drawing in space reaches from its upright axis, at every height: what it needs of a picture, however it is
//! turned about that axis.

use super::body::{Body, Contents, Probe};
use super::{Drawing, Placed};
use crate::Solid;
use crate::rotation::{Vector, dot, norm};

/// Directions in which a drawing is measured, from straight down to straight up.
const DIRECTIONS: usize = 9;
/// Blocks looked into at most for one of them, and how exact it is then, in units of the root block.
const EFFORT: usize = 400;
const EXACT: f64 = 1e-3;

/// Points, as distances from the axis and heights above the middle, whose rings about the axis hold a whole drawing in
/// their convex hull. In units of the root block.
pub(crate) type Girth = [[f64; 2]; DIRECTIONS - 1];

/// Measures a drawing about the upright axis through the middle of its root block; `None` where nothing is drawn.
pub(super) fn girth(drawing: &Drawing<Solid>) -> Option<Girth> {
    let root = drawing.root?;
    let from = drawing.blocks[root.0 as usize].hull.centre();
    let Drawing { blocks, items, vertices, .. } = drawing;
    let contents = Contents { blocks, items, vertices };
    let steep = |number: usize| {
        let angle = (number as f64 / (DIRECTIONS - 1) as f64 - 0.5) * core::f64::consts::PI;
        [libm::cos(angle).max(0.0), libm::sin(angle)]
    };
    let reach: [f64; DIRECTIONS] = core::array::from_fn(|number| {
        let probe = Outwards { from, up: [0.0, 1.0, 0.0], by: steep(number), scale: 1.0 };
        contents.farthest(drawing.items_of(root), probe, EXACT, EFFORT).0
    });
    // Where the bounds in two directions next to each other meet.
    Some(core::array::from_fn(|number| {
        let ([a, b], [c, d]) = (steep(number), steep(number + 1));
        let [first, second] = [reach[number], reach[number + 1]];
        let across = a * d - b * c;
        [((first * d - second * b) / across).max(0.0), (a * second - c * first) / across]
    }))
}

/// How far a point lies in a direction that leads away from an axis and along it.
#[derive(Clone, Copy)]
struct Outwards {
    from: Vector,
    up: Vector,
    /// Of the way from the axis, and along it: a unit vector.
    by: [f64; 2],
    scale: f64,
}

impl Probe for Outwards {
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
