//! The outlines of lines: a pen that follows them, with caps, joins and dashes.

use crate::SvgError;
use crate::canvas::{Canvas, Polygons, Shade};
use crate::shapes::Line;
use crate::style::{Cap, Join, Pen};
use crate::transform::Transform;
use crate::work::{Kind, Work};
use std::f64::consts::{PI, TAU};

/// The units of a dash.
const DASH: u64 = 60;
/// The edges of outlines that are painted at once. Parts that overlap are painted once only within these.
const MAX_EDGES: usize = 1 << 17;
/// Directions whose sine is less than this need no join.
const STRAIGHT: f64 = 1e-4;

/// A pen on a canvas.
struct Stroke<'a> {
    canvas: &'a mut Canvas,
    polygons: Polygons,
    transform: Transform,
    shade: Shade,
    pen: &'a Pen,
    /// Half the width.
    half: f64,
    /// The angle between the corners of round caps and joins, in radians.
    step: f64,
}

/// Draws the outlines of lines. They are at least one pixel wide.
pub(crate) fn stroke(
    lines: &[Line],
    pen: &Pen,
    transform: Transform,
    shade: Shade,
    canvas: &mut Canvas,
    work: &mut Work,
) -> Result<(), SvgError> {
    let scale = transform.scale();
    if pen.width <= 0.0 || scale <= 0.0 || !scale.is_finite() {
        return Ok(());
    }
    let half = (pen.width / 2.0).max(0.5 / scale);
    let step = (2.0 * libm::acos(1.0 - 0.1 / (half * scale).max(0.5))).clamp(0.1, PI / 4.0);
    let polygons = Polygons::on(canvas);
    let mut stroke = Stroke { canvas, polygons, transform, shade, pen, half, step };
    for line in lines {
        let mut points = line.points.clone();
        if line.is_closed {
            points.extend(line.points.first());
        }
        points.dedup();
        match (&*pen.dashes, points.len() > 1) {
            ([], _) | (_, false) => stroke.line(&points, line.is_closed && points.len() > 2, work)?,
            (dashes, true) => stroke.dashed(&points, dashes, work)?,
        }
    }
    stroke.paint(work)
}

impl Stroke<'_> {
    fn paint(&mut self, work: &mut Work) -> Result<(), SvgError> {
        self.canvas.fill(&mut self.polygons, false, self.shade, work)
    }

    fn add(&mut self, points: &[[f64; 2]], work: &mut Work) -> Result<(), SvgError> {
        self.polygons.add(points, true, self.transform, work)?;
        if self.polygons.count() > MAX_EDGES { self.paint(work) } else { Ok(()) }
    }

    /// A line whose points differ from the next ones.
    fn line(&mut self, points: &[[f64; 2]], is_closed: bool, work: &mut Work) -> Result<(), SvgError> {
        let &[first, .., last] = points else {
            let &[at] = points else { return Ok(()) };
            // A line without length is a dot, if its caps show.
            return match self.pen.cap {
                Cap::Butt => Ok(()),
                Cap::Round => self.fan(at, [self.half, 0.0], TAU, work),
                Cap::Square => self.bar([at[0] - self.half, at[1]], [at[0] + self.half, at[1]], [1.0, 0.0], work),
            };
        };
        let directions: Vec<[f64; 2]> = points.windows(2).map(|pair| direction(pair[0], pair[1])).collect();
        for (pair, along) in points.windows(2).zip(&directions) {
            self.bar(pair[0], pair[1], *along, work)?;
        }
        for (pair, &at) in directions.windows(2).zip(&points[1..]) {
            self.join(at, pair[0], pair[1], work)?;
        }
        let (Some(&start), Some(&end)) = (directions.first(), directions.last()) else { return Ok(()) };
        if is_closed {
            return self.join(first, end, start, work);
        }
        self.cap(first, [-start[0], -start[1]], work)?;
        self.cap(last, end, work)
    }

    fn bar(
        &mut self,
        [x1, y1]: [f64; 2],
        [x2, y2]: [f64; 2],
        along: [f64; 2],
        work: &mut Work,
    ) -> Result<(), SvgError> {
        let [nx, ny] = self.side(along);
        self.add(&[[x1 + nx, y1 + ny], [x2 + nx, y2 + ny], [x2 - nx, y2 - ny], [x1 - nx, y1 - ny]], work)
    }

    fn cap(&mut self, at: [f64; 2], [dx, dy]: [f64; 2], work: &mut Work) -> Result<(), SvgError> {
        match self.pen.cap {
            Cap::Butt => Ok(()),
            Cap::Square => {
                let end = [at[0] + dx * self.half, at[1] + dy * self.half];
                self.bar(at, end, [dx, dy], work)
            }
            Cap::Round => {
                let [nx, ny] = self.side([dx, dy]);
                self.fan(at, [-nx, -ny], PI, work)
            }
        }
    }

    fn join(&mut self, [x, y]: [f64; 2], from: [f64; 2], to: [f64; 2], work: &mut Work) -> Result<(), SvgError> {
        let sine = from[0] * to[1] - from[1] * to[0];
        let cosine = from[0] * to[0] + from[1] * to[1];
        if sine.abs() < STRAIGHT && cosine > 0.0 {
            return Ok(());
        }
        // The outside of the bend.
        let sign = if sine > 0.0 { -1.0 } else { 1.0 };
        let [a, b] = [from, to].map(|along| self.side(along).map(|each| each * sign));
        let turn = libm::atan2(sine, cosine);
        if self.pen.join == Join::Round {
            return self.fan([x, y], a, turn, work);
        }
        // The miter is as long as 1 / cos(turn / 2) half widths.
        let square = (1.0 + cosine) / 2.0;
        let corners = [[x, y], [x + a[0], y + a[1]], [x + b[0], y + b[1]]];
        if self.pen.join == Join::Miter && square * self.pen.miter * self.pen.miter >= 1.0 {
            let tip = [x + (a[0] + b[0]) / (2.0 * square), y + (a[1] + b[1]) / (2.0 * square)];
            return self.add(&[corners[0], corners[1], tip, corners[2]], work);
        }
        self.add(&corners, work)
    }

    /// A part of a circle, from the side [x, y] of its middle, through an angle in radians.
    fn fan(&mut self, at: [f64; 2], [x, y]: [f64; 2], angle: f64, work: &mut Work) -> Result<(), SvgError> {
        let parts = (angle.abs() / self.step).ceil().max(1.0);
        let corner = |part: usize| {
            let (sin, cos) = libm::sincos(angle * part as f64 / parts);
            [at[0] + x * cos - y * sin, at[1] + x * sin + y * cos]
        };
        let corners: Vec<_> = [at].into_iter().chain((0..=parts as usize).map(corner)).collect();
        self.add(&corners[usize::from(angle >= TAU)..], work)
    }

    fn side(&self, [dx, dy]: [f64; 2]) -> [f64; 2] {
        [-dy * self.half, dx * self.half]
    }

    fn dashed(&mut self, points: &[[f64; 2]], dashes: &[f64], work: &mut Work) -> Result<(), SvgError> {
        let period: f64 = dashes.iter().sum();
        let length: f64 = points.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
        let count = (length / period + 2.0) * dashes.len() as f64;
        work.charge(Kind::Dashes, count as usize, DASH)?;
        if !(period.is_finite() && count.is_finite()) {
            return Ok(());
        }
        let mut at = 0;
        let mut left = self.pen.offset.rem_euclid(period);
        while left >= dashes[at] && left > 0.0 {
            left -= dashes[at];
            at = (at + 1) % dashes.len();
        }
        let mut left = dashes[at] - left;
        let mut dash = vec![points[0]];
        for pair in points.windows(2) {
            let (whole, mut done) = (distance(pair[0], pair[1]), 0.0);
            while whole - done > left {
                done += left;
                let part = done / whole;
                let place = [0, 1].map(|axis| pair[0][axis] + (pair[1][axis] - pair[0][axis]) * part);
                dash.push(place);
                self.dash(&mut dash, at, work)?;
                dash.push(place);
                at = (at + 1) % dashes.len();
                left = dashes[at];
            }
            left -= whole - done;
            dash.push(pair[1]);
        }
        self.dash(&mut dash, at, work)
    }

    /// Draws every other dash.
    fn dash(&mut self, dash: &mut Vec<[f64; 2]>, at: usize, work: &mut Work) -> Result<(), SvgError> {
        dash.dedup();
        if at.is_multiple_of(2) {
            self.line(dash, false, work)?;
        }
        dash.clear();
        Ok(())
    }
}

fn direction(from: [f64; 2], to: [f64; 2]) -> [f64; 2] {
    let length = distance(from, to).max(f64::MIN_POSITIVE);
    [(to[0] - from[0]) / length, (to[1] - from[1]) / length]
}

fn distance(from: [f64; 2], to: [f64; 2]) -> f64 {
    libm::hypot(to[0] - from[0], to[1] - from[1])
}
