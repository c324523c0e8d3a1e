//! The lines of paths and of basic shapes. Curves become polygons.

use crate::SvgError;
use crate::length::length;
use crate::transform::Transform;
use crate::work::{Kind, Work};
use crate::xml::Element;
use std::f64::consts::TAU;
use svgtypes::{PathParser, PathSegment, PointsParser};

/// The units of a point of a line.
const POINT: u64 = 60;
/// A curve's polygon is at most this far from the curve, in pixels.
const APART: f64 = 0.1;
/// The most sides of a curve's polygon.
const MAX_SIDES: f64 = 200.0;
/// A path ends before larger numbers.
const MAX_NUMBER: f64 = 1e12;

pub(crate) struct Line {
    pub(crate) points: Vec<[f64; 2]>,
    pub(crate) is_closed: bool,
}

/// Lines in the making.
pub(crate) struct Pencil<'a> {
    lines: Vec<Line>,
    transform: Transform,
    work: &'a mut Work,
}

impl<'a> Pencil<'a> {
    /// `transform` leads to pixels.
    pub(crate) fn new(transform: Transform, work: &'a mut Work) -> Self {
        Self { lines: Vec::new(), transform, work }
    }

    pub(crate) fn lines(self) -> Vec<Line> {
        self.lines
    }

    fn start(&mut self, at: [f64; 2]) {
        // Paths that only move draw nothing.
        if self.lines.last().is_some_and(|line| line.points.len() < 2) {
            self.lines.pop();
        }
        self.lines.push(Line { points: vec![at], is_closed: false });
    }

    fn line(&mut self, to: [f64; 2]) -> Result<(), SvgError> {
        self.work.charge(Kind::Segments, 1, POINT)?;
        let Some(line) = self.lines.last_mut() else { return Ok(()) };
        if line.is_closed {
            let first = line.points.first().copied().unwrap_or_default();
            self.lines.push(Line { points: vec![first, to], is_closed: false });
        } else {
            line.points.push(to);
        }
        Ok(())
    }

    fn at(&self) -> [f64; 2] {
        let Some(line) = self.lines.last() else { return [0.0; 2] };
        let at = if line.is_closed { line.points.first() } else { line.points.last() };
        at.copied().unwrap_or_default()
    }

    fn cubic(&mut self, a: [f64; 2], b: [f64; 2], to: [f64; 2]) -> Result<(), SvgError> {
        let from = self.at();
        // The largest second difference bounds the distance from a polygon (Wang's formula).
        let bend = self.bend(from, a, b).max(self.bend(a, b, to));
        let sides = (0.75 * bend / APART).sqrt().ceil().clamp(1.0, MAX_SIDES);
        for side in 1..=sides as usize {
            let t = side as f64 / sides;
            let s = 1.0 - t;
            let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
            self.line([0, 1].map(|axis| [from, a, b, to].iter().zip(weights).map(|(at, by)| at[axis] * by).sum()))?;
        }
        Ok(())
    }

    fn bend(&self, a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
        let [a, b, c] = [a, b, c].map(|at| self.transform.of(at));
        libm::hypot(a[0] - 2.0 * b[0] + c[0], a[1] - 2.0 * b[1] + c[1])
    }

    fn close(&mut self) {
        if let Some(line) = self.lines.last_mut() {
            line.is_closed = true;
        }
    }

    /// Draws a path, up to the first mistake in its text.
    fn path(&mut self, text: &str) -> Result<(), SvgError> {
        let (mut at, mut start) = ([0.0; 2], [0.0; 2]);
        // The last control point of the curve before, cubic or quadratic.
        let (mut cubic, mut quadratic) = (None, None);
        for segment in PathParser::from(text).map_while(Result::ok) {
            let origin = if segment.is_abs() { [0.0; 2] } else { at };
            let place = |x: f64, y: f64| [origin[0] + x, origin[1] + y];
            let mirrored = |control: Option<[f64; 2]>| control.map_or(at, |[x, y]| [2.0 * at[0] - x, 2.0 * at[1] - y]);
            let (mut next_cubic, mut next_quadratic) = (None, None);
            let to = match segment {
                PathSegment::MoveTo { x, y, .. } | PathSegment::LineTo { x, y, .. } => place(x, y),
                PathSegment::HorizontalLineTo { x, .. } => [origin[0] + x, at[1]],
                PathSegment::VerticalLineTo { y, .. } => [at[0], origin[1] + y],
                PathSegment::CurveTo { x, y, .. }
                | PathSegment::SmoothCurveTo { x, y, .. }
                | PathSegment::Quadratic { x, y, .. }
                | PathSegment::SmoothQuadratic { x, y, .. }
                | PathSegment::EllipticalArc { x, y, .. } => place(x, y),
                PathSegment::ClosePath { .. } => start,
            };
            if !to.iter().all(|each| each.abs() < MAX_NUMBER) {
                break;
            }
            match segment {
                PathSegment::MoveTo { .. } => {
                    start = to;
                    self.start(to);
                }
                PathSegment::ClosePath { .. } => self.close(),
                PathSegment::CurveTo { x1, y1, x2, y2, .. } => {
                    next_cubic = Some(place(x2, y2));
                    self.cubic(place(x1, y1), place(x2, y2), to)?;
                }
                PathSegment::SmoothCurveTo { x2, y2, .. } => {
                    next_cubic = Some(place(x2, y2));
                    self.cubic(mirrored(cubic), place(x2, y2), to)?;
                }
                PathSegment::Quadratic { x1, y1, .. } => {
                    next_quadratic = Some(place(x1, y1));
                    self.quadratic(place(x1, y1), to)?;
                }
                PathSegment::SmoothQuadratic { .. } => {
                    next_quadratic = Some(mirrored(quadratic));
                    self.quadratic(mirrored(quadratic), to)?;
                }
                PathSegment::EllipticalArc { rx, ry, x_axis_rotation, large_arc, sweep, .. } => {
                    self.arc([rx.abs(), ry.abs()], x_axis_rotation, [large_arc, sweep], to)?;
                }
                _ => self.line(to)?,
            }
            (at, cubic, quadratic) = (to, next_cubic, next_quadratic);
        }
        Ok(())
    }

    fn quadratic(&mut self, by: [f64; 2], to: [f64; 2]) -> Result<(), SvgError> {
        let from = self.at();
        let between = |end: [f64; 2]| [0, 1].map(|axis| (end[axis] + 2.0 * by[axis]) / 3.0);
        self.cubic(between(from), between(to), to)
    }

    /// An arc of an ellipse, given by its radii, the direction of the first one in degrees, whether it is the larger
    /// one and clockwise, and its end (SVG 2, appendix B.2.4).
    fn arc(
        &mut self,
        radii: [f64; 2],
        degrees: f64,
        [large, clockwise]: [bool; 2],
        to: [f64; 2],
    ) -> Result<(), SvgError> {
        let from = self.at();
        if radii.contains(&0.0) || from == to {
            return self.line(to);
        }
        let (sin, cos) = libm::sincos(degrees.to_radians());
        let half = [(from[0] - to[0]) / 2.0, (from[1] - to[1]) / 2.0];
        // Half the chord in the frame of a circle with radius 1.
        let [x, y] = [(cos * half[0] + sin * half[1]) / radii[0], (cos * half[1] - sin * half[0]) / radii[1]];
        let square = x * x + y * y;
        let larger = square.max(1.0).sqrt();
        let [rx, ry] = radii.map(|radius| radius * larger);
        let off = (1.0 / square - 1.0).max(0.0).sqrt() * if large == clockwise { -1.0 } else { 1.0 };
        let [x, y] = [x / larger, y / larger];
        let middle = [off * y, -off * x];
        let (first, last) = ([x - middle[0], y - middle[1]], [-x - middle[0], -y - middle[1]]);
        let begin = libm::atan2(first[1], first[0]);
        let turn = libm::atan2(last[1], last[0]) - begin;
        let turn = if clockwise { turn.rem_euclid(TAU) } else { turn.rem_euclid(TAU) - TAU };
        let centre = [(from[0] + to[0]) / 2.0, (from[1] + to[1]) / 2.0];
        let place = |x: f64, y: f64| {
            let [x, y] = [rx * (x + middle[0]), ry * (y + middle[1])];
            [centre[0] + cos * x - sin * y, centre[1] + sin * x + cos * y]
        };
        let size = rx.max(ry) * self.transform.scale();
        let sides = (turn.abs() * (size / (8.0 * APART)).sqrt()).ceil().clamp(4.0, MAX_SIDES);
        for side in 1..sides as usize {
            let (sin, cos) = libm::sincos(begin + turn * side as f64 / sides);
            self.line(place(cos, sin))?;
        }
        self.line(to)
    }

    fn oval(&mut self, [x, y]: [f64; 2], [rx, ry]: [f64; 2]) -> Result<(), SvgError> {
        self.start([x + rx, y]);
        self.arc([rx, ry], 0.0, [false, true], [x - rx, y])?;
        self.arc([rx, ry], 0.0, [false, true], [x + rx, y])?;
        self.close();
        Ok(())
    }

    fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], [rx, ry]: [f64; 2]) -> Result<(), SvgError> {
        let (rx, ry) = (rx.min(width / 2.0), ry.min(height / 2.0));
        let (right, bottom) = (x + width, y + height);
        self.start([x + rx, y]);
        for (edge, corner) in [
            ([right - rx, y], [right, y + ry]),
            ([right, bottom - ry], [right - rx, bottom]),
            ([x + rx, bottom], [x, bottom - ry]),
            ([x, y + ry], [x + rx, y]),
        ] {
            self.line(edge)?;
            if rx > 0.0 && ry > 0.0 {
                self.arc([rx, ry], 0.0, [false, true], corner)?;
            }
        }
        self.close();
        Ok(())
    }

    /// Draws a basic shape or a path. `size` is that of the viewport.
    pub(crate) fn shape(&mut self, element: &Element, size: [f64; 2]) -> Result<(), SvgError> {
        let diagonal = libm::hypot(size[0], size[1]) / std::f64::consts::SQRT_2;
        let known = |name: &str, whole: f64| element.get(name).and_then(|text| length(text, whole));
        let pair = |names: [&str; 2]| [0, 1].map(|axis| known(names[axis], size[axis]).unwrap_or(0.0));
        let is_size = |size: &[f64; 2]| size.iter().all(|each| *each > 0.0 && each.is_finite());
        match element.name {
            "path" => self.path(element.get("d").unwrap_or_default())?,
            "line" => {
                self.start(pair(["x1", "y1"]));
                self.line(pair(["x2", "y2"]))?;
            }
            "polyline" | "polygon" => {
                for (at, (x, y)) in PointsParser::from(element.get("points").unwrap_or_default()).enumerate() {
                    if at == 0 { self.start([x, y]) } else { self.line([x, y])? }
                }
                if element.name == "polygon" {
                    self.close();
                }
            }
            "circle" => {
                let radii = [known("r", diagonal).unwrap_or(0.0); 2];
                if is_size(&radii) {
                    self.oval(pair(["cx", "cy"]), radii)?;
                }
            }
            "ellipse" | "rect" => {
                let radii = [known("rx", size[0]), known("ry", size[1])];
                let radii = [radii[0].or(radii[1]), radii[1].or(radii[0])].map(|each| each.unwrap_or(0.0).max(0.0));
                let sides = pair(["width", "height"]);
                if element.name == "rect" && is_size(&sides) {
                    self.rectangle(pair(["x", "y"]), sides, radii)?;
                }
                if element.name == "ellipse" && is_size(&radii) {
                    self.oval(pair(["cx", "cy"]), radii)?;
                }
            }
            _ => {}
        }
        Ok(())
    }
}
