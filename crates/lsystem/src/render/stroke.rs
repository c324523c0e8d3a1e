//! A stroke with round caps, row by row.

use super::canvas::Canvas;

/// A segment on the subsample lattice, y down, and half its width.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Capsule {
    pub from: [f64; 2],
    pub to: [f64; 2],
    pub radius: f64,
}

impl Capsule {
    /// Paints every subsample whose centre is within the radius of the segment. Returns how many rows it took.
    pub(super) fn paint(&self, canvas: &mut Canvas, colour: u32) -> usize {
        let mut rows = 0;
        let right = (canvas.strips * 64) as f64 - 1.0;
        self.spans([0.0, canvas.rows as f64 - 1.0], |row, first, last| {
            rows += 1;
            let (first, last) = (first.max(0.0), last.min(right));
            if first <= last {
                canvas.span(row, first as usize, last as usize, colour);
            }
        });
        rows
    }

    /// Calls `visit` with each row in `within` that the stroke reaches, and its first and last column there. A row
    /// it passes between two columns gives a last column before the first.
    fn spans(&self, within: [f64; 2], mut visit: impl FnMut(usize, f64, f64)) {
        let ([a, b], r) =
            (if self.from[1] <= self.to[1] { [self.from, self.to] } else { [self.to, self.from] }, self.radius);
        if !(a[0] + a[1] + b[0] + b[1] + r).is_finite() {
            return;
        }
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = (dx * dx + dy * dy).sqrt();
        let (ux, uy) = if length > 0.0 { (dx / length, dy / length) } else { (1.0, 0.0) };
        // Each side is an arc around a, an edge, and an arc around b; the edge's ends say where they meet.
        let slope = if uy > 0.0 { ux / uy } else { 0.0 };
        let (left_x, left_y) = (a[0] - r * uy, a[1] + r * ux);
        let (right_x, right_y) = (a[0] + r * uy, a[1] - r * ux);
        let arc = |centre: f64, y: f64| {
            let h = y - centre;
            (r * r - h * h).max(0.0).sqrt()
        };
        let first = (a[1] - r - 0.5).ceil().max(within[0]);
        let last = (b[1] + r - 0.5).floor().min(within[1]);
        if first > last {
            return;
        }
        for row in first as usize..=last as usize {
            let y = row as f64 + 0.5;
            let left = if y < left_y {
                a[0] - arc(a[1], y)
            } else if y > left_y + dy {
                b[0] - arc(b[1], y)
            } else {
                left_x + (y - left_y) * slope
            };
            let right = if y < right_y {
                a[0] + arc(a[1], y)
            } else if y > right_y + dy {
                b[0] + arc(b[1], y)
            } else {
                right_x + (y - right_y) * slope
            };
            visit(row, (left - 0.5).ceil(), (right - 0.5).floor());
        }
    }
}
