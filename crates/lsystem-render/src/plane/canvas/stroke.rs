//! A stroke with round caps, row by row.

use super::Canvas;
use super::bit_words::{GROUP, NOTHING, Spans};
use crate::search::nearest_on;
use core::ops::Range;

/// A segment on the subsample lattice, y down, and half its width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::plane) struct Capsule {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub radius: f64,
}

/// The fraction bits of the fixed point numbers of a side.
const FRACTION: u32 = 24;
/// Half a subsample, as a fixed point number.
const HALF: i64 = 1 << (FRACTION - 1);

/// The greatest radius, in subsamples, that is traced as it is. The side of a larger stroke is straight within a
/// picture, and soon exceeds the range of fixed point numbers.
const MAX_RADIUS: f64 = (1_u64 << 34) as f64;

/// The left or the right side of a stroke, from top to bottom: an arc around the upper end, an edge, an arc around
/// the lower end.
struct StrokeSide {
    /// -1 on the left, 1 on the right.
    sign: f64,
    /// The ends of the segment.
    upper: [f64; 2],
    lower: [f64; 2],
    /// The square of the radius.
    square: f64,
    /// The first row of the edge, and the row after its last.
    edge: [i64; 2],
    /// The x of the edge in its first row, as a fixed point number.
    at: i64,
    /// The change of x from row to row, as a fixed point number.
    step: i64,
}

impl StrokeSide {
    fn new(sign: f64, [upper, lower]: [[f64; 2]; 2], [ux, uy]: [f64; 2], radius: f64, first: i64) -> Self {
        let start = [upper[0] + sign * radius * uy, upper[1] - sign * radius * ux];
        let end = start[1] + lower[1] - upper[1];
        let edge = [(start[1] - 0.5).ceil() as i64, ((end - 0.5).floor() as i64).saturating_add(1)];
        let edge = [edge[0].max(first), edge[1]];
        let slope = if uy > 0.0 { ux / uy } else { 0.0 };
        let at = start[0] + (edge[0] as f64 + 0.5 - start[1]) * slope;
        let fixed = |v: f64| (v * f64::from(1 << FRACTION)) as i64;
        Self { sign, upper, lower, square: radius * radius, edge, at: fixed(at), step: fixed(slope) }
    }

    /// The x of this side in the middle of `row`, as a fixed point number.
    #[inline]
    fn x(&self, row: i64) -> i64 {
        if row >= self.edge[0] && row < self.edge[1] {
            return self.at.wrapping_add(self.step.wrapping_mul(row - self.edge[0]));
        }
        let centre = if row < self.edge[0] { self.upper } else { self.lower };
        let height = row as f64 + 0.5 - centre[1];
        let x = centre[0] + self.sign * (self.square - height * height).max(0.0).sqrt();
        (x * f64::from(1 << FRACTION)) as i64
    }
}

impl Capsule {
    /// Paints every subsample whose centre is within the radius of the segment. Returns the number of rows.
    pub(in crate::plane) fn paint(&self, canvas: &mut Canvas, colour: u32) -> usize {
        self.trace(canvas, |canvas, group, reach, spans| {
            canvas.fill_group(group, reach, spans, colour);
            true
        })
    }

    /// Whether each subsample of the stroke is covered; `false` if numbers are not finite.
    pub(in crate::plane) fn is_covered(&self, canvas: &mut Canvas) -> bool {
        let mut covered = self.length().is_some();
        self.trace(canvas, |canvas, group, reach, spans| {
            covered = canvas.is_group_full(group, reach, spans);
            covered
        });
        covered
    }

    /// Visits the open groups of the stroke, as [`Canvas::trace`] does. Returns the number of rows.
    #[inline(always)]
    fn trace(&self, canvas: &mut Canvas, visit: impl FnMut(&mut Canvas, usize, [i64; 2], &Spans) -> bool) -> usize {
        let height = canvas.rows as i64;
        let size = canvas.size();
        let near = if self.radius > MAX_RADIUS { self.around(size) } else { *self };
        let radius = near.radius;
        let Some((ends, direction)) = near.clipped(size) else { return 0 };
        let first = ((ends[0][1] - radius - 0.5).ceil() as i64).max(0);
        let last = ((ends[1][1] + radius - 0.5).floor() as i64).min(height - 1);
        let left = StrokeSide::new(-1.0, ends, direction, radius, first);
        let right = StrokeSide::new(1.0, ends, direction, radius, first);
        if first > last {
            return 0;
        }
        let slope = if direction[1] > 0.0 { direction[0] / direction[1] } else { 0.0 };
        // The axis at two heights, widened by the radius, bounds the rows between.
        let bounds = |rows: Range<usize>| {
            let at = |y: f64| match y {
                _ if y <= ends[0][1] => ends[0][0],
                _ if y >= ends[1][1] => ends[1][0],
                _ => ends[0][0] + (y - ends[0][1]) * slope,
            };
            let (a, b) = if slope == 0.0 {
                (ends[0][0], ends[1][0])
            } else {
                (at(rows.start as f64 - radius), at(rows.end as f64 + radius))
            };
            [(a.min(b) - radius) as i64 - 1, (a.max(b) + radius) as i64 + 1]
        };
        // The rows in which both sides are edges.
        let edges = left.edge[0].max(right.edge[0])..left.edge[1].min(right.edge[1]);
        let spans = |rows: Range<usize>, spans: &mut Spans| {
            // From the first to the last subsample centre between the sides.
            let between =
                |left: i64, right: i64| [left.wrapping_add(HALF - 1) >> FRACTION, right.wrapping_sub(HALF) >> FRACTION];
            let spans = &mut spans[rows.start % GROUP..][..rows.len()];
            if edges.start <= rows.start as i64 && rows.end as i64 <= edges.end {
                let [mut l, mut r] = [&left, &right].map(|side| side.x(rows.start as i64));
                for span in &mut *spans {
                    *span = between(l, r);
                    (l, r) = (l.wrapping_add(left.step), r.wrapping_add(right.step));
                }
                let (first, last) = (spans.first().unwrap_or(&NOTHING), spans.last().unwrap_or(&NOTHING));
                return [first[0].min(last[0]), first[1].max(last[1])];
            }
            let mut reach = NOTHING;
            for (span, row) in spans.iter_mut().zip(rows) {
                *span = between(left.x(row as i64), right.x(row as i64));
                reach = [reach[0].min(span[0]), reach[1].max(span[1])];
            }
            reach
        };
        canvas.trace(first as usize..last as usize + 1, bounds, spans, visit);
        (last - first + 1).max(0) as usize
    }

    /// A dot of radius [`MAX_RADIUS`] that covers the same part of a canvas of this size: its side is where the
    /// stroke's side is.
    fn around(&self, size: [f64; 2]) -> Self {
        let middle = size.map(|side| side / 2.0);
        let (_, part) = nearest_on(middle, [self.from, self.to]);
        let out = [0, 1].map(|axis| middle[axis] - self.from[axis] - part * (self.to[axis] - self.from[axis]));
        let distance = libm::hypot(out[0], out[1]);
        // The distance from the side inwards to the middle of the picture, or at most to the middle of the dot.
        let inwards = (self.radius - distance).min(MAX_RADIUS);
        let dot = [0, 1].map(|axis| {
            let towards = if distance > 0.0 { out[axis] / distance } else { 0.0 };
            middle[axis] + towards * (inwards - MAX_RADIUS)
        });
        Self { from: dot, to: dot, radius: MAX_RADIUS }
    }

    /// The length of the segment; `None` if numbers are not finite.
    fn length(&self) -> Option<f64> {
        let [dx, dy] = [0, 1].map(|axis| self.to[axis] - self.from[axis]);
        let length = (dx * dx + dy * dy).sqrt();
        (length + self.from[0] + self.from[1] + self.radius).is_finite().then_some(length)
    }

    /// The upper and the lower end of the part near a canvas of this size, and the direction from one to the other. The
    /// cut keeps the numbers small.
    fn clipped(&self, size: [f64; 2]) -> Option<([[f64; 2]; 2], [f64; 2])> {
        let mut ends = if self.from[1] <= self.to[1] { [self.from, self.to] } else { [self.to, self.from] };
        let length = self.length()?;
        let delta = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let direction = if length > 0.0 { delta.map(|d| d / length) } else { [1.0, 0.0] };
        let margin = self.radius + 8.0;
        let near = |p: [f64; 2]| (0..2).all(|axis| p[axis] >= -margin && p[axis] <= size[axis] + margin);
        if ends.into_iter().all(near) {
            return Some((ends, direction));
        }
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_stroke_may_be_wider_than_numbers_can_tell() {
        for radius in (9..150).step_by(3).map(|digits| libm::pow(10.0, f64::from(digits))) {
            for degrees in [0.0, 1e-9, 30.0, 90.0, 135.0, 180.0] {
                let (sin, cos) = libm::sincos(f64::to_radians(degrees));
                // The stroke is as long as wide, and its side is `aside` subsamples from the middle of the canvas.
                let covered = |aside: f64| {
                    let away = radius - aside;
                    let middle = [32.0 - sin * away, 32.0 + cos * away];
                    let [from, to] = [-radius, radius].map(|l| [middle[0] + l * cos, middle[1] + l * sin]);
                    let mut canvas = Canvas::default();
                    canvas.reset(64, 64, 0);
                    Capsule { from, to, radius }.paint(&mut canvas, 0);
                    canvas.settle();
                    canvas.covered.iter().map(|word| word.count_ones()).sum::<u32>()
                };
                assert_eq!(covered(radius), 64 * 64, "{radius} {degrees}");
                assert_eq!(covered(radius / 2.0), 64 * 64, "{radius} {degrees}");
                assert_eq!(covered(-radius), 0, "{radius} {degrees}");
                if radius < 1e13 {
                    assert!((1800..2300).contains(&covered(0.0)), "{radius} {degrees}: {}", covered(0.0));
                }
            }
        }
    }

    proptest! {
        #[test]
        fn a_stroke_covers_what_is_within_its_radius(
            from in [-300.0..500.0, -300.0..500.0],
            span in [-600.0..600.0, -600.0..600.0],
            scale in prop_oneof![Just(0.0), Just(1e-14), 0.0..1.0],
            flatness in [prop_oneof![Just(0.0), Just(1e-16), 0.0..1.0], prop_oneof![Just(0.0), Just(1e-16), 0.0..1.0]],
            radius in 2.0..30.0,
        ) {
            let to = [0, 1].map(|axis| from[axis] + span[axis] * scale * flatness[axis]);
            let mut canvas = Canvas::default();
            canvas.reset(256, 200, 1);
            Capsule { from, to, radius }.paint(&mut canvas, 1);
            canvas.settle();
            let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
            let norm = dx * dx + dy * dy;
            for row in 0..200 {
                for column in 0..256 {
                    let (x, y) = (column as f64 + 0.5 - from[0], row as f64 + 0.5 - from[1]);
                    let t = if norm > 0.0 { ((x * dx + y * dy) / norm).clamp(0.0, 1.0) } else { 0.0 };
                    let distance = ((x - t * dx) * (x - t * dx) + (y - t * dy) * (y - t * dy)).sqrt();
                    let at = column / 64 * 200 + row;
                    let covered = canvas.covered[at] >> (column % 64) & 1 != 0;
                    if (distance - radius).abs() > 1e-3 {
                        prop_assert_eq!(covered, distance < radius, "{} {}", column, row);
                        prop_assert_eq!(covered, canvas.colours[at] >> (column % 64) & 1 != 0);
                    }
                    prop_assert!(!covered || canvas.is_touched(column / 64, row / 64), "{} {}", column, row);
                }
            }
        }

        #[test]
        fn a_stroke_is_covered_where_all_its_subsamples_are(
            bare in proptest::collection::vec([0..256_usize, 0..200_usize], 0..3),
            from in [-100.0..300.0_f64, -100.0..300.0],
            to in [-100.0..300.0_f64, -100.0..300.0],
            radius in 0.5..150.0_f64,
        ) {
            let mut canvas = Canvas::default();
            canvas.reset(256, 200, 0);
            // All rows but for a few subsamples.
            for row in 0..200 {
                let mut columns: Vec<_> = bare.iter().filter(|[_, y]| *y == row).map(|[x, _]| *x as i64).collect();
                columns.extend([-1, 256]);
                columns.sort_unstable();
                for pair in columns.windows(2) {
                    let reach = [pair[0] + 1, pair[1] - 1];
                    canvas.fill(row..row + 1, 0, |_| reach, |rows, spans| {
                        spans[rows.start % GROUP] = reach;
                        reach
                    });
                }
            }
            let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
            let distance = |[x, y]: [usize; 2]| {
                let (x, y) = (x as f64 + 0.5 - from[0], y as f64 + 0.5 - from[1]);
                let t = ((x * dx + y * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
                ((x - t * dx) * (x - t * dx) + (y - t * dy) * (y - t * dy)).sqrt()
            };
            let least = bare.into_iter().map(distance).fold(f64::INFINITY, f64::min);
            if (least - radius).abs() > 1e-3 {
                prop_assert_eq!(Capsule { from, to, radius }.is_covered(&mut canvas), least > radius);
            }
        }
    }
}
