//! The plane: headings are integers, hulls are polygons.

use crate::Tropism;
use crate::drawing::{BlockId, Builder, Contents, Enclosed, Item, PlaneSurvey as Survey, hull};
use crate::space::{Axis, Space, times, unit_of};
use core::ops::Range;
use lsystem_syntax::{Heading, Meter};

/// Drawings in the plane, x to the right and y up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Plane;

impl Space for Plane {
    type Point = [f64; 2];
    /// Counter-clockwise.
    type Turn = Heading;
    /// Cosine and sine.
    type Axes = (f64, f64);
    type Directions = Directions;
    /// Corners of a convex polygon, counter-clockwise; one or two where all is on a point or a line. Rounding may leave
    /// the end of a segment's axis out by 1e-11.
    type Hull = Range<u32>;
    /// Min x, min y, max x, max y.
    type Extent = [f64; 4];
    type Survey = Survey;

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

    fn lie(&(c, s): &(f64, f64), [x, y]: [f64; 2], [u, v]: [f64; 2]) -> [f64; 2] {
        [x + (c * u - s * v), y + (s * u + c * v)]
    }

    fn ahead(&(c, s): &(f64, f64), [x, y]: [f64; 2], length: f64) -> [f64; 2] {
        [x + length * c, y + length * s]
    }

    fn point([x, y, _]: [f64; 3]) -> [f64; 2] {
        [x, y]
    }

    fn enclose(builder: &mut Builder, items: &[Item]) -> Enclosed<Self> {
        let Builder { blocks, corners, vertices, directions, points, .. } = builder;
        points.clear();
        let (mut slack, mut work, mut boxed) = (0.0_f64, 0, 0.0_f64);
        for item in items {
            match item {
                Item::Stroke(stroke) => {
                    // Most strokes begin where the one before ended.
                    if points.last() != Some(&stroke.from) {
                        points.push(stroke.from);
                    }
                    points.push(stroke.to);
                }
                Item::Polygon(polygon) if polygon.count > LONG => {
                    let [low, high] = around(&vertices[polygon.range()]);
                    points.extend([low, [high[0], low[1]], high, [low[0], high[1]]]);
                    boxed = boxed.max(high[0] - low[0]).max(high[1] - low[1]);
                    work += u64::from(polygon.count) / 8;
                }
                Item::Polygon(polygon) => points.extend(&vertices[polygon.range()]),
                Item::Block(placed) => {
                    let block = &blocks[placed.block.0 as usize];
                    let axes = Self::scaled(directions.cos_sin(placed.heading), placed.scale);
                    let corners = &corners[block.hull.start as usize..block.hull.end as usize];
                    points.extend(corners.iter().map(|&corner| Self::lie(&axes, placed.at, corner)));
                    slack = slack.max(placed.scale * block.slack);
                }
            }
        }
        let reach = points.iter().flatten().fold(0.0_f64, |reach, c| reach.max(c.abs()));
        let shift = unit_of(reach);
        let unit = libm::scalbn(1.0, -shift);
        points.iter_mut().for_each(|point| *point = times(*point, unit));
        let (outside, hulled) = hull(points);
        // Nothing in a box is farther from its sides than the longer one is long.
        let slack = slack.max(boxed) * unit + outside;
        let first = corners.len() as u32;
        corners.extend(&*points);
        Enclosed { hull: first..corners.len() as u32, slack, shift, work: work + hulled }
    }

    fn survey(root: BlockId) -> Survey {
        Survey::new(root)
    }

    fn advance(survey: &mut Survey, contents: Contents<'_, Self>, meter: &mut Meter) -> Option<[f64; 4]> {
        survey.step(contents, meter)
    }
}

/// Polygons of more vertices than this count for their boxes, where hulls are made: their own hulls would take too long.
const LONG: u32 = 1 << 14;

/// The least and the greatest coordinates.
fn around(points: &[[f64; 2]]) -> [[f64; 2]; 2] {
    points.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
        [[low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])]]
    })
}

/// Cosines and sines of the headings met last: a turtle has few, and meets them again at once.
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
    /// Enough for all multiples of most angles; systems with 3600 of them use few at a time.
    const BITS: u32 = 10;

    /// The same as [`Heading::cos_sin`].
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
