//! Where two bodies pass through each other: the lines that their surfaces have in common.

use super::body::{Facet, Tube, stretches};
use super::fill::normal;
use super::runs::Part;
use super::sight::{Place, Sight, cross, dot, minus};
use crate::page::Point;
use core::f64::consts::PI;

/// The most halvings of an eighth of a curve.
const HALVED: u32 = 12;

/// A polygon in its plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face<'a> {
    pub(super) plane: &'a Facet,
    pub(super) vertices: &'a [Place],
    pub(super) runs: Part<'a>,
}

/// Adds the lines where two polygons meet: on the line that both planes have in common, what both polygons cover. None
/// if the depths differ by less than `same` where both may be: then they are in the same plane.
pub(super) fn faces([a, b]: [Face; 2], same: f64, lines: &mut Vec<[Place; 2]>) {
    let [[low_a, high_a], [low_b, high_b]] = [a, b].map(|face| bounds(face.vertices));
    let low = [0, 1].map(|axis| low_a[axis].max(low_b[axis]));
    let high = [0, 1].map(|axis| high_a[axis].min(high_b[axis]));
    let middle = [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]));
    let half = [0, 1].map(|axis| (high[axis] - low[axis]) / 2.0);
    let growth = [0, 1].map(|axis| a.plane.slope[axis] - b.plane.slope[axis]);
    let apart = a.plane.at(middle) - b.plane.at(middle);
    let most = growth[0].abs() * half[0] + growth[1].abs() * half[1];
    if !(half[0] >= 0.0 && half[1] >= 0.0 && apart.abs() <= most && apart.abs() + most > same) {
        return;
    }
    let square = growth[0] * growth[0] + growth[1] * growth[1];
    let foot = [0, 1].map(|axis| middle[axis] - growth[axis] * (apart / square));
    let reach = (half[0] + half[1]) / square.sqrt();
    // The depth of the flatter plane is more exact.
    let steep = |face: Face| face.plane.slope.iter().map(|slope| slope * slope).sum::<f64>();
    let plane = if steep(a) < steep(b) { a.plane } else { b.plane };
    let ends = [-reach, reach].map(|far| {
        let at = [foot[0] - growth[1] * far, foot[1] + growth[0] * far];
        [at[0], at[1], plane.at(at)]
    });
    let Some(line) = Sight::new(ends) else { return };
    let mut crossings = vec![];
    let [first, last] = [a, b].map(|face| {
        let mut spans = vec![];
        stretches(face.vertices, face.runs, &line, &mut crossings, |span| spans.push(span));
        spans
    });
    let both = first.iter().flat_map(|span| last.iter().map(|other| span.within(other.low, other.high)));
    lines.extend(both.filter(|span| !span.is_empty()).map(|span| [span.low, span.high].map(|place| line.at(place))));
}

/// The box around a polygon on the sheet.
fn bounds(vertices: &[Place]) -> [Point; 2] {
    vertices.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], vertex| {
        [[0, 1].map(|axis| low[axis].min(vertex[axis])), [0, 1].map(|axis| high[axis].max(vertex[axis]))]
    })
}

/// Adds the lines where a tube's surface meets a polygon: chords of the tube widened by `exact`, at most `exact` inside
/// its surface, as far as the polygon covers them.
pub(super) fn tube_and_face(tube: &Tube, face: Face, exact: f64, lines: &mut Vec<[Place; 2]>) {
    let tube = tube.grown(exact);
    let Some(section) = Section::new(&tube, face.plane) else { return };
    let mut crossings = vec![];
    section.chords(exact, &mut |ends| {
        if let Some(line) = Sight::new(ends) {
            stretches(face.vertices, face.runs, &line, &mut crossings, |span| {
                let span = span.within(0.0, 1.0);
                if !span.is_empty() {
                    lines.push([span.low, span.high].map(|place| line.at(place)));
                }
            });
        }
    });
}

/// The part of a plane within a tube: it is convex.
struct Section<'a> {
    tube: &'a Tube,
    /// A point inside.
    middle: Place,
    /// Two directions of the plane, and its normal: unit vectors, perpendicular to each other.
    axes: [Place; 3],
}

/// A point on the border of a section: its direction from the middle as an angle, and in the section's axes its place
/// and the normal of the border there.
#[derive(Clone, Copy)]
struct Border {
    angle: f64,
    at: [f64; 2],
    normal: [f64; 2],
}

impl<'a> Section<'a> {
    /// `None` if the plane does not meet the tube.
    fn new(tube: &'a Tube, plane: &Facet) -> Option<Self> {
        let normal = normal(plane);
        let [first, last] = tube.ends.map(|end| dot(normal, minus(end, [0.0, 0.0, plane.depth])));
        // The ball that reaches farthest through the plane: at an end, or where the axis crosses the plane.
        let crossing = (first / (first - last)).clamp(0.0, 1.0);
        let (mut best, mut least) = (0.0, 0.0);
        for part in [0.0, 1.0, crossing] {
            let beyond = (first + part * (last - first)).abs() - tube.radii[0] - part * (tube.radii[1] - tube.radii[0]);
            if beyond < least {
                (best, least) = (part, beyond);
            }
        }
        if least == 0.0 {
            return None;
        }
        let axis = minus(tube.ends[1], tube.ends[0]);
        let above = first + best * (last - first);
        let middle = [0, 1, 2].map(|at| tube.ends[0][at] + best * axis[at] - above * normal[at]);
        // In the plane: along the sheet's x, or along y.
        let along = if normal[0].abs() < normal[1].abs() { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let aside = unit(cross(normal, along));
        Some(Self { tube, middle, axes: [aside, cross(normal, aside), normal] })
    }

    fn place(&self, [x, y]: [f64; 2]) -> Place {
        [0, 1, 2].map(|at| self.middle[at] + x * self.axes[0][at] + y * self.axes[1][at])
    }

    /// The point of the border in a direction.
    fn border(&self, angle: f64) -> Border {
        let (sin, cos) = libm::sincos(angle);
        let line = Sight::through([self.middle, self.place([cos, sin])]);
        let far = self.tube.inside(&line).high.max(0.0);
        let at = [far * cos, far * sin];
        let outward = self.tube.outward(self.place(at));
        Border { angle, at, normal: [dot(outward, self.axes[0]), dot(outward, self.axes[1])] }
    }

    /// Goes around the border by chords that leave it by at most `exact`.
    fn chords(&self, exact: f64, each: &mut dyn FnMut([Place; 2])) {
        let mut before = self.border(0.0);
        let start = before;
        for eighth in 1..=8 {
            let next = if eighth == 8 {
                Border { angle: 2.0 * PI, ..start }
            } else {
                self.border(f64::from(eighth) * PI / 4.0)
            };
            self.part([before, next], exact, HALVED, each);
            before = next;
        }
    }

    /// Goes along the border between two points.
    fn part(&self, [from, to]: [Border; 2], exact: f64, halved: u32, each: &mut dyn FnMut([Place; 2])) {
        if halved == 0 || bulge(from, to) <= exact {
            each([from, to].map(|border| self.place(border.at)));
            return;
        }
        let middle = self.border(f64::midpoint(from.angle, to.angle));
        self.part([from, middle], exact, halved - 1, each);
        self.part([middle, to], exact, halved - 1, each);
    }
}

/// The most by which a convex border leaves the chord between two of its points: the height of the triangle of the chord
/// and both tangents (Rote 1992).
fn bulge(from: Border, to: Border) -> f64 {
    let way = [to.at[0] - from.at[0], to.at[1] - from.at[1]];
    let length = (way[0] * way[0] + way[1] * way[1]).sqrt();
    // The tangents' slopes above the chord.
    let slopes = [from, to].map(|Border { normal: [x, y], .. }| {
        let (along, out) = ((x * way[0] + y * way[1]).abs(), x * way[1] - y * way[0]);
        // Or the border leads back, or has a tip.
        if out > 0.0 { along / out } else { f64::INFINITY }
    });
    // Along a tangent, the border is the chord.
    if length == 0.0 || slopes.contains(&0.0) {
        return 0.0;
    }
    length / (1.0 / slopes[0] + 1.0 / slopes[1])
}

pub(super) fn unit(way: Place) -> Place {
    let length = dot(way, way).sqrt();
    way.map(|part| part / length)
}
