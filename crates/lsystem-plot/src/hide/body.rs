//! What covers lines: tubes and faces, in millimetres of the sheet, and depths that grow towards the viewer.

use super::runs::Part;
use super::sight::{Place, Sight, dot, minus};
use super::span::Span;
use crate::page::Point;

/// The hull of two balls: a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tube {
    pub(super) ends: [Place; 2],
    /// The radii of the balls, at least 0.
    pub(super) radii: [f64; 2],
}

/// The plane of a polygon: the depth at the sheet's corner, and the growth of the depth along x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Facet {
    pub(super) depth: f64,
    pub(super) slope: [f64; 2],
}

impl Tube {
    /// The nearest depth.
    pub(super) fn near(&self) -> f64 {
        (self.ends[0][2] + self.radii[0]).max(self.ends[1][2] + self.radii[1])
    }

    /// Lines below this depth are hidden wherever they are within the tube's outline.
    pub(super) fn base(&self) -> f64 {
        self.ends[0][2].min(self.ends[1][2])
    }

    /// The tube with larger radii, or smaller ones.
    pub(super) fn grown(&self, by: f64) -> Self {
        Self { radii: self.radii.map(|radius| (radius + by).max(0.0)), ..*self }
    }

    pub(super) fn widest(&self) -> f64 {
        self.radii[0].max(self.radii[1])
    }

    /// The axis on the sheet: its direction and its length.
    pub(super) fn axis(&self) -> (Point, f64) {
        let [x, y, _] = minus(self.ends[1], self.ends[0]);
        let length = (x * x + y * y).sqrt();
        let unit = if length > 0.0 { [x / length, y / length] } else { [1.0, 0.0] };
        (unit, length)
    }

    /// Where the straight sides of the outline touch the two discs of the sheet, as distances along the axis from the
    /// first end and aside. `None` if one disc lies within the other.
    pub(super) fn sides(&self, length: f64) -> Option<[[f64; 2]; 2]> {
        let [first, last] = self.radii;
        let sin = (first - last) / length;
        // Not a number if the length is 0.
        (sin.abs() < 1.0).then(|| {
            let cos = (1.0 - sin * sin).sqrt();
            [[first * sin, first * cos], [length + last * sin, last * cos]]
        })
    }

    /// Whether a point of the sheet is within the outline.
    pub(super) fn has(&self, [x, y]: Point) -> bool {
        let (unit, length) = self.axis();
        let [dx, dy] = [x - self.ends[0][0], y - self.ends[0][1]];
        let (along, aside) = (dx * unit[0] + dy * unit[1], (dy * unit[0] - dx * unit[1]).abs());
        let is_in = |from: f64, radius: f64| {
            let along = along - from;
            along * along + aside * aside < radius * radius
        };
        let between = |[[y0, x0], [y1, x1]]: [[f64; 2]; 2]| {
            (y0..y1).contains(&along) && aside < x0 + (x1 - x0) * (along - y0) / (y1 - y0)
        };
        is_in(0.0, self.radii[0]) || is_in(length, self.radii[1]) || self.sides(length).is_some_and(between)
    }

    /// The stretch of a line that the tube hides, whatever the depths are.
    pub(super) fn outline(&self, line: &Sight) -> Span {
        let span = self.disc(line, 0).with(self.disc(line, 1));
        self.ribbon(line).map_or(span, |(ribbon, _)| span.with(ribbon))
    }

    /// The stretch of a line that the tube hides: where a ray from the line to the viewer meets the tube.
    ///
    /// All points behind a convex body, and the body, are convex together. So the stretch is one, and ends where the
    /// line meets the front of the body, or its outline at the depth of the outline or behind.
    pub(super) fn shadow(&self, line: &Sight) -> Span {
        if line.top <= self.base() {
            return self.outline(line);
        }
        if line.bottom >= self.near() {
            return Span::NONE;
        }
        let mut span = self.cone(line);
        for end in [0, 1] {
            let behind = self.disc(line, end).below(line.from[2] - self.ends[end][2], line.way[2]);
            span = span.with(behind).with(self.ball(line, end));
        }
        let Some((ribbon, depth)) = self.ribbon(line) else { return span };
        span.with(ribbon.below(line.from[2] - depth[0], line.way[2] - depth[1]))
    }

    /// The stretch of a line within the tube. A tube is convex.
    pub(super) fn inside(&self, line: &Sight) -> Span {
        // The cone comes first: it may have one end only.
        self.cone(line).with(self.ball(line, 0)).with(self.ball(line, 1))
    }

    /// The way from the axis to a place, through the surface at right angles.
    pub(super) fn outward(&self, place: Place) -> Place {
        minus(place, self.at(self.foot(place)))
    }

    /// Whether a place is within the tube.
    pub(super) fn contains(&self, place: Place) -> bool {
        let part = self.foot(place);
        let out = minus(place, self.at(part));
        let radius = self.radii[0] + part * (self.radii[1] - self.radii[0]);
        dot(out, out) < radius * radius
    }

    /// A point of the axis.
    fn at(&self, part: f64) -> Place {
        [0, 1, 2].map(|axis| self.ends[0][axis] + part * (self.ends[1][axis] - self.ends[0][axis]))
    }

    /// The part of the axis at which the ball stands whose surface is nearest to a place, or that holds it deepest.
    fn foot(&self, place: Place) -> f64 {
        let axis = minus(self.ends[1], self.ends[0]);
        let length = dot(axis, axis).sqrt();
        let sin = (self.radii[0] - self.radii[1]) / length;
        // One ball is within the other.
        if sin.is_nan() || sin.abs() >= 1.0 {
            return if self.radii[1] > self.radii[0] { 1.0 } else { 0.0 };
        }
        let from = minus(place, self.ends[0]);
        let along = dot(from, axis) / length;
        let aside = (dot(from, from) - along * along).max(0.0).sqrt();
        ((along - aside * sin / (1.0 - sin * sin).sqrt()) / length).clamp(0.0, 1.0)
    }

    /// The stretch over the disc of an end.
    fn disc(&self, line: &Sight, end: usize) -> Span {
        let [x, y, _] = minus(line.from, self.ends[end]);
        let radius = self.radii[end];
        Span::quadratic(line.square, x * line.way[0] + y * line.way[1], x * x + y * y - radius * radius)
    }

    /// The stretch within the ball of an end.
    fn ball(&self, line: &Sight, end: usize) -> Span {
        let from = minus(line.from, self.ends[end]);
        let radius = self.radii[end];
        Span::quadratic(dot(line.way, line.way), dot(from, line.way), dot(from, from) - radius * radius)
    }

    /// The stretch between the straight sides of the outline, and the depth of the plane through both sides over the
    /// line: at its start, and the growth to its end.
    fn ribbon(&self, line: &Sight) -> Option<(Span, [f64; 2])> {
        let (unit, length) = self.axis();
        let [[y0, x0], [y1, x1]] = self.sides(length)?;
        let [dx, dy, _] = minus(line.from, self.ends[0]);
        let (along, aside) = (dx * unit[0] + dy * unit[1], dy * unit[0] - dx * unit[1]);
        let [dx, dy, _] = line.way;
        let (ahead, left) = (dx * unit[0] + dy * unit[1], dy * unit[0] - dx * unit[1]);
        let growth = (x1 - x0) / (y1 - y0);
        let width = x0 + (along - y0) * growth;
        let span = Span::ALL
            .below(y0 - along, -ahead)
            .below(along - y1, ahead)
            .below(aside - width, left - ahead * growth)
            .below(-aside - width, -left - ahead * growth);
        let rise = (self.ends[1][2] - self.ends[0][2]) / (y1 - y0);
        Some((span, [self.ends[0][2] + (along - y0) * rise, ahead * rise]))
    }

    /// The stretch between the places where the line meets the cone between the balls.
    fn cone(&self, line: &Sight) -> Span {
        let axis = minus(self.ends[1], self.ends[0]);
        let length = dot(axis, axis).sqrt();
        let Some([[y0, x0], [y1, x1]]) = self.sides(length) else { return Span::NONE };
        let axis = axis.map(|part| part / length);
        let from = minus(line.from, self.ends[0]);
        let (along, ahead) = (dot(from, axis), dot(line.way, axis));
        let growth = (x1 - x0) / (y1 - y0);
        let radius = x0 + (along - y0) * growth;
        let widening = ahead * growth;
        let a = dot(line.way, line.way) - ahead * ahead - widening * widening;
        let b = dot(from, line.way) - along * ahead - radius * widening;
        let c = dot(from, from) - along * along - radius * radius;
        let root = (b * b - a * c).sqrt();
        // The sum has no cancellation.
        let sum = -b - root.copysign(b);
        let mut span = Span::NONE;
        for place in [sum / a, c / sum] {
            if (y0..=y1).contains(&(along + place * ahead)) && place.is_finite() {
                span = Span { low: span.low.min(place), high: span.high.max(place) };
            }
        }
        span
    }
}

impl Facet {
    /// The plane through a point with this normal; `None` if it is seen from its edge.
    pub(super) fn new(point: Place, normal: Place) -> Option<Self> {
        /// The least cosine of the angle between the normal and the direction to the viewer.
        const LEAST: f64 = 1e-6;
        if normal[2].abs() < LEAST {
            return None;
        }
        let slope = [-normal[0] / normal[2], -normal[1] / normal[2]];
        Some(Self { depth: point[2] - slope[0] * point[0] - slope[1] * point[1], slope })
    }

    pub(super) fn at(&self, [x, y]: Point) -> f64 {
        self.depth + self.slope[0] * x + self.slope[1] * y
    }

    /// The stretches of a line that the polygon with these vertices in this plane hides, by the nonzero winding rule.
    /// The line is moved by `nearer` towards the viewer.
    pub(super) fn shadows(
        &self,
        vertices: &[Place],
        runs: Part,
        line: &Sight,
        nearer: f64,
        crossings: &mut Vec<(f64, i32)>,
        hidden: &mut Vec<Span>,
    ) {
        let ([x, y, z], [dx, dy, dz]) = (line.from, line.way);
        let front = Span::ALL.below(z + nearer - self.at([x, y]), dz - self.slope[0] * dx - self.slope[1] * dy);
        if front.within(0.0, 1.0).is_empty() {
            return;
        }
        stretches(vertices, runs, line, crossings, |span| {
            let span = span.within(front.low, front.high).within(0.0, 1.0);
            if !span.is_empty() {
                hidden.push(span);
            }
        });
    }
}

/// The stretches of a line over a polygon, in order, by the nonzero winding rule. They may reach beyond the line.
pub(super) fn stretches(
    vertices: &[Place],
    runs: Part,
    line: &Sight,
    crossings: &mut Vec<(f64, i32)>,
    mut each: impl FnMut(Span),
) {
    let ([x, y, _], [dx, dy, _]) = (line.from, line.way);
    crossings.clear();
    let side = |vertex: &Place| dx * (vertex[1] - y) - dy * (vertex[0] - x);
    let (mut at, count) = (0, vertices.len());
    let mut is_left = side(&vertices[count - 1]) > 0.0;
    while at < count {
        if let Some((end, _)) = runs.passed(at, count, line).filter(|passed| passed.1 == is_left) {
            at = end;
            continue;
        }
        let (vertex, own) = (&vertices[at], side(&vertices[at]));
        // Half-open, so that a vertex on the line counts once.
        if (own > 0.0) != is_left {
            let before = &vertices[at.checked_sub(1).unwrap_or(count - 1)];
            let side_before = side(before);
            let part = side_before / (side_before - own);
            let at = [0, 1].map(|axis| before[axis] + part * (vertex[axis] - before[axis]));
            let place = ((at[0] - x) * dx + (at[1] - y) * dy) / line.square;
            crossings.push((place, if own > 0.0 { 1 } else { -1 }));
            is_left = own > 0.0;
        }
        at += 1;
    }
    crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let (mut winding, mut low) = (0, 0.0);
    for &(place, way) in &*crossings {
        if winding == 0 {
            low = place;
        }
        winding += way;
        if winding == 0 {
            each(Span { low, high: place });
        }
    }
}

/// The winding number of a polygon around a point of the sheet.
pub(super) fn winding(vertices: &[Place], [x, y]: Point) -> i32 {
    let next = vertices.iter().cycle().skip(1);
    let around = vertices.iter().zip(next).map(|(a, b)| {
        let is_left = (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) > 0.0;
        match (a[1] <= y, b[1] <= y) {
            (true, false) if is_left => 1,
            (false, true) if !is_left => -1,
            _ => 0,
        }
    });
    around.sum()
}
