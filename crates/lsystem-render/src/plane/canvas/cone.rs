//! A stroke that tapers: all that lies within two discs or between their common tangents, row by row.

use super::Canvas;
use super::bit_words::{GROUP, NOTHING, Spans};
use super::stroke::Capsule;
use core::ops::Range;

/// A segment on the subsample lattice, y down, and half its widths at the two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::plane) struct Cone {
    pub ends: [[f64; 2]; 2],
    pub radii: [f64; 2],
}

/// The greatest radius, in subsamples, that is traced as it is: the sides of a larger stroke are straight within a
/// picture.
const MAX_RADIUS: f64 = (1_u64 << 24) as f64;

/// A common tangent of the two discs, from its upper to its lower end.
#[derive(Clone, Copy)]
struct Tangent {
    /// The heights of the ends.
    rows: [f64; 2],
    /// The x of the upper end.
    x: f64,
    /// The change of x with the height.
    slope: f64,
}

impl Tangent {
    fn new(ends: [[f64; 2]; 2]) -> Self {
        let [[x0, y0], [x1, y1]] = if ends[0][1] <= ends[1][1] { ends } else { [ends[1], ends[0]] };
        Self { rows: [y0, y1], x: x0, slope: if y1 > y0 { (x1 - x0) / (y1 - y0) } else { 0.0 } }
    }

    /// The x at a height, if the tangent reaches it.
    fn at(&self, y: f64) -> Option<f64> {
        (y >= self.rows[0] && y <= self.rows[1]).then(|| self.x + (y - self.rows[0]) * self.slope)
    }
}

impl Cone {
    /// Paints every subsample whose centre is inside. Returns the number of rows.
    pub(in crate::plane) fn paint(&self, canvas: &mut Canvas, colour: u32) -> usize {
        match self.capsule(canvas.size()) {
            Some(capsule) => capsule.paint(canvas, colour),
            None => self.fill(canvas, colour),
        }
    }

    /// A capsule that covers the same part of a canvas of this size, if there is one: for equal radii, for an end that
    /// contains the other, and for a cone that is much larger than the canvas.
    fn capsule(&self, size: [f64; 2]) -> Option<Capsule> {
        let ([from, to], [first, second]) = (self.ends, self.radii);
        let way = [to[0] - from[0], to[1] - from[1]];
        let (length, narrows) = (libm::hypot(way[0], way[1]), first - second);
        if narrows == 0.0 || !(length.is_finite() && narrows.is_finite()) {
            return Some(Capsule { from, to, radius: first });
        }
        if length <= narrows.abs() {
            let (at, radius) = if narrows > 0.0 { (from, first) } else { (to, second) };
            return Some(Capsule { from: at, to: at, radius });
        }
        if first.max(second) <= MAX_RADIUS {
            return None;
        }
        // The disc between the ends that reaches the farthest towards the middle of the canvas, or beyond it.
        let middle = [0, 1].map(|axis| size[axis] / 2.0 - from[axis]);
        let unit = way.map(|c| c / length);
        let along = middle[0] * unit[0] + middle[1] * unit[1];
        let aside = (middle[1] * unit[0] - middle[0] * unit[1]).abs();
        let sin = narrows / length;
        let place = (along - aside * sin / (1.0 - sin * sin).max(f64::MIN_POSITIVE).sqrt()).clamp(0.0, length);
        let at = [0, 1].map(|axis| from[axis] + place * unit[axis]);
        Some(Capsule { from: at, to: at, radius: first - place * sin })
    }

    /// Paints a cone whose ends do not contain each other.
    fn fill(&self, canvas: &mut Canvas, colour: u32) -> usize {
        let height = canvas.rows as i64;
        let size = canvas.size();
        let way = [0, 1].map(|axis| self.ends[1][axis] - self.ends[0][axis]);
        let length = libm::hypot(way[0], way[1]);
        let [ux, uy] = way.map(|c| c / length);
        let sin = (self.radii[0] - self.radii[1]) / length;
        let cos = (1.0 - sin * sin).max(0.0).sqrt();
        let Some(Self { ends, radii }) = self.near(size) else { return 0 };
        // Towards the thinner end the sides lean to the axis.
        let tangents = [-1.0, 1.0].map(|sign| {
            let out = [sign * uy * cos + ux * sin, -sign * ux * cos + uy * sin];
            Tangent::new([0, 1].map(|end| [0, 1].map(|axis| ends[end][axis] + radii[end] * out[axis])))
        });
        let discs = [0, 1].map(|end| (ends[end], radii[end], radii[end] * radii[end]));
        let low = (discs[0].0[1] - discs[0].1).min(discs[1].0[1] - discs[1].1);
        let high = (discs[0].0[1] + discs[0].1).max(discs[1].0[1] + discs[1].1);
        let first = ((low - 0.5).ceil() as i64).max(0);
        let last = ((high - 0.5).floor() as i64).min(height - 1);
        if first > last {
            return 0;
        }
        let widest = radii[0].max(radii[1]);
        let [upper, lower] = if ends[0][1] <= ends[1][1] { ends } else { [ends[1], ends[0]] };
        let slope = if lower[1] > upper[1] { (lower[0] - upper[0]) / (lower[1] - upper[1]) } else { 0.0 };
        // The axis at two heights, widened by the radius, bounds the rows between.
        let bounds = |rows: Range<usize>| {
            let at = |y: f64| match y {
                _ if y <= upper[1] => upper[0],
                _ if y >= lower[1] => lower[0],
                _ => upper[0] + (y - upper[1]) * slope,
            };
            let (a, b) = if slope == 0.0 {
                (upper[0], lower[0])
            } else {
                (at(rows.start as f64 - widest), at(rows.end as f64 + widest))
            };
            [(a.min(b) - widest) as i64 - 1, (a.max(b) + widest) as i64 + 1]
        };
        let spans = |rows: Range<usize>, spans: &mut Spans| {
            let spans = &mut spans[rows.start % GROUP..][..rows.len()];
            let mut reach = NOTHING;
            for (span, row) in spans.iter_mut().zip(rows) {
                let y = row as f64 + 0.5;
                let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
                for ([x, centre], _, square) in discs {
                    let aside = square - (y - centre) * (y - centre);
                    if aside >= 0.0 {
                        let aside = aside.sqrt();
                        (left, right) = (left.min(x - aside), right.max(x + aside));
                    }
                }
                for x in tangents.iter().filter_map(|tangent| tangent.at(y)) {
                    (left, right) = (left.min(x), right.max(x));
                }
                *span =
                    if left <= right { [(left - 0.5).ceil() as i64, (right - 0.5).floor() as i64] } else { NOTHING };
                reach = [reach[0].min(span[0]), reach[1].max(span[1])];
            }
            reach
        };
        canvas.trace(first as usize..last as usize + 1, bounds, spans, |canvas, group, reach, spans| {
            canvas.fill_group(group, reach, spans, colour);
            true
        });
        (last - first + 1).max(0) as usize
    }

    /// The part of the cone that may be on a canvas of this size; `None` if nothing may. The cut keeps the numbers small.
    fn near(&self, size: [f64; 2]) -> Option<Self> {
        let ([from, to], [first, second]) = (self.ends, self.radii);
        let margin = first.max(second) + 8.0;
        let (mut start, mut end) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            let (low, high) = (-margin, size[axis] + margin);
            let (at, way) = (from[axis], to[axis] - from[axis]);
            if way == 0.0 {
                if at < low || at > high {
                    return None;
                }
                continue;
            }
            let (a, b) = ((low - at) / way, (high - at) / way);
            (start, end) = (start.max(a.min(b)), end.min(a.max(b)));
        }
        if start > end {
            return None;
        }
        let point = |t: f64| [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]));
        let radius = |t: f64| first + t * (second - first);
        let cut = |t: f64, whole: f64, own: ([f64; 2], f64)| if t == whole { own } else { (point(t), radius(t)) };
        let (near, far) = (cut(start, 0.0, (from, first)), cut(end, 1.0, (to, second)));
        Some(Self { ends: [near.0, far.0], radii: [near.1, far.1] })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn a_cone_covers_the_discs_between_its_ends(
            from in [-300.0..500.0, -300.0..500.0],
            span in [-600.0..600.0_f64, -600.0..600.0],
            scale in prop_oneof![Just(0.0), Just(1e-9), 0.0..1.0],
            flat in prop_oneof![Just([1.0, 1.0]), Just([0.0, 1.0]), Just([1.0, 0.0])],
            radii in [0.0..60.0_f64, 0.5..60.0],
        ) {
            let to = [0, 1].map(|axis| from[axis] + span[axis] * scale * flat[axis]);
            let mut canvas = Canvas::default();
            canvas.reset(256, 200, 1);
            Cone { ends: [from, to], radii }.paint(&mut canvas, 1);
            canvas.settle();
            // The farthest that a disc reaches over a place: the distance is convex along the axis.
            let over = |x: f64, y: f64| {
                let reach = |t: f64| {
                    let at = [0, 1].map(|axis| from[axis] + t * (to[axis] - from[axis]));
                    radii[0] + t * (radii[1] - radii[0]) - libm::hypot(x - at[0], y - at[1])
                };
                let (mut low, mut high) = (0.0, 1.0);
                // The interval shrinks to 1e-7 of at most 850 pixels.
                for _ in 0..40 {
                    let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
                    if reach(a) < reach(b) { low = a } else { high = b }
                }
                reach((low + high) / 2.0).max(reach(0.0)).max(reach(1.0))
            };
            // Rows of all cases together are at all distances from the ends.
            for row in (0..200).step_by(if test_effort::is_thorough() { 1 } else { 7 }) {
                for column in 0..256 {
                    let over = over(column as f64 + 0.5, row as f64 + 0.5);
                    let covered = canvas.covered[column / 64 * 200 + row] >> (column % 64) & 1 != 0;
                    if over.abs() > 1e-3 {
                        prop_assert_eq!(covered, over > 0.0, "{} {} {}", column, row, over);
                    }
                }
            }
        }
    }

    #[test]
    fn a_cone_may_be_much_larger_than_the_canvas() {
        for radius in [1e5, 1e9, 1e14, 1e30] {
            for aside in [0.5, -1.0] {
                // The axis runs to the right. The side of the cone passes the middle of the canvas, or far from it.
                let (sin, length) = (0.25, 4.0 * radius);
                let cos = f64::sqrt(1.0 - sin * sin);
                let half = radius - 0.5 * length * sin;
                let across = half / cos * (1.0 - aside);
                let ends = [[32.0 - length / 2.0, 32.0 - across], [32.0 + length / 2.0, 32.0 - across]];
                let mut canvas = Canvas::default();
                canvas.reset(64, 64, 0);
                Cone { ends, radii: [radius, radius - length * sin + 1e-9 * radius] }.paint(&mut canvas, 0);
                canvas.settle();
                let covered = canvas.covered.iter().map(|word| word.count_ones()).sum::<u32>();
                assert_eq!(covered, if aside > 0.0 { 64 * 64 } else { 0 }, "{radius} {aside}");
            }
        }
    }
}
