//! A stroke with round caps, row by row.

use super::canvas::Canvas;

/// A segment on the subsample lattice, y down, and half its width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Capsule {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub radius: f64,
}

/// The fixed point numbers of a side: fraction bits.
const FRACTION: u32 = 24;
/// Half a subsample, as a fixed point number.
const HALF: i64 = 1 << (FRACTION - 1);

/// The left or the right side of a stroke, from top to bottom: an arc around the upper end, an edge, an arc around
/// the lower end. Rows are asked for one after the other.
struct Side {
    /// -1 on the left, 1 on the right.
    sign: f64,
    upper: [f64; 2],
    lower: [f64; 2],
    square: f64,
    /// The rows of the edge.
    edge: [i64; 2],
    /// Where the edge is in the next row of it, and how far it goes from row to row.
    at: i64,
    step: i64,
}

impl Side {
    fn new(sign: f64, [upper, lower]: [[f64; 2]; 2], [ux, uy]: [f64; 2], radius: f64, first: i64) -> Self {
        let start = [upper[0] + sign * radius * uy, upper[1] - sign * radius * ux];
        let end = start[1] + lower[1] - upper[1];
        let edge = [(start[1] - 0.5).ceil() as i64, (end - 0.5).floor() as i64 + 1];
        let edge = [edge[0].max(first), edge[1]];
        let slope = if uy > 0.0 { ux / uy } else { 0.0 };
        let at = start[0] + (edge[0] as f64 + 0.5 - start[1]) * slope;
        let fixed = |v: f64| (v * f64::from(1 << FRACTION)) as i64;
        Self { sign, upper, lower, square: radius * radius, edge, at: fixed(at), step: fixed(slope) }
    }

    /// The x of this side in the middle of `row`, as a fixed point number.
    #[inline]
    fn next(&mut self, row: i64) -> i64 {
        if row >= self.edge[0] && row < self.edge[1] {
            let at = self.at;
            self.at = at.wrapping_add(self.step);
            return at;
        }
        let centre = if row < self.edge[0] { self.upper } else { self.lower };
        let height = row as f64 + 0.5 - centre[1];
        let x = centre[0] + self.sign * (self.square - height * height).max(0.0).sqrt();
        (x * f64::from(1 << FRACTION)) as i64
    }
}

impl Capsule {
    /// Paints every subsample whose centre is within the radius of the segment. Returns how many rows it took.
    pub(super) fn paint(&self, canvas: &mut Canvas, colour: u32) -> usize {
        let radius = self.radius;
        let (width, height) = ((canvas.strips * 64) as i64, canvas.rows as i64);
        let Some((ends, direction)) = self.clipped([width as f64, height as f64]) else { return 0 };
        let first = ((ends[0][1] - radius - 0.5).ceil() as i64).max(0);
        let last = ((ends[1][1] + radius - 0.5).floor() as i64).min(height - 1);
        let mut left = Side::new(-1.0, ends, direction, radius, first);
        let mut right = Side::new(1.0, ends, direction, radius, first);
        for row in first..=last {
            // From the first to the last subsample centre between the sides.
            let from = (left.next(row) + HALF - 1) >> FRACTION;
            let to = (right.next(row) - HALF) >> FRACTION;
            let (from, to) = (from.max(0), to.min(width - 1));
            if from <= to {
                canvas.span(row as usize, from as usize, to as usize, colour);
            }
        }
        (last - first + 1).max(0) as usize
    }

    /// The upper and the lower end of the part that can be seen on a canvas of this size, and the direction from
    /// one to the other. Cutting off what is far outside keeps the numbers small.
    fn clipped(&self, size: [f64; 2]) -> Option<([[f64; 2]; 2], [f64; 2])> {
        let mut ends = if self.from[1] <= self.to[1] { [self.from, self.to] } else { [self.to, self.from] };
        let delta = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let length = (delta[0] * delta[0] + delta[1] * delta[1]).sqrt();
        if !(length + ends[0][0] + ends[0][1] + self.radius).is_finite() {
            return None;
        }
        let direction = if length > 0.0 { delta.map(|d| d / length) } else { [1.0, 0.0] };
        let margin = self.radius + 8.0;
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (low, high) = (-margin, size[axis] + margin);
            let at = ends[0][axis];
            if delta[axis] == 0.0 {
                if at < low || at > high {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - at) / delta[axis], (high - at) / delta[axis]);
            start = start.max(a.min(b));
            end = end.min(a.max(b));
        }
        if start > end {
            return None;
        }
        let origin = ends[0];
        if end < 1.0 {
            ends[1] = [0, 1].map(|axis| origin[axis] + end * delta[axis]);
        }
        if start > 0.0 {
            ends[0] = [0, 1].map(|axis| origin[axis] + start * delta[axis]);
        }
        Some((ends, direction))
    }
}
