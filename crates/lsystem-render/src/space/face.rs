//! A flat triangle of a filled polygon.

use super::stroke::{Painted, band, span};
use super::tile::ScreenTile;
use lsystem_drawing::rotation::Vector;

/// A triangle of one colour in the space of a picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub corners: [Vector; 3],
    pub colour: u32,
}

impl Face {
    /// Paints a band of the triangle, from the row `from` on, on a tile whose upper left corner is at `corner`.
    pub(super) fn paint(&self, tile: &mut ScreenTile, corner: [f64; 2], from: usize) -> Painted {
        let [width, height] = tile.size.map(|count| count as f64);
        let [a, b, c] = self.corners.map(|[x, y, d]| [x - corner[0], y - corner[1], d]);
        let least = |i: usize| a[i].min(b[i]).min(c[i]);
        let most = |i: usize| a[i].max(b[i]).max(c[i]);
        let slack = tile.slack();
        let Some(across) = span(least(0) - slack, most(0) + slack, width) else { return Painted::default() };
        let Some(down) = span(least(1), most(1), height) else { return Painted::default() };
        let (down, rest) = band(across, down, from);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if area.abs() < 1e-9 || tile.hides(across, down, least(2) as f32) {
            return Painted { looked: 0, rest };
        }
        tile.touch(across, down);
        // The change of depth from column to column and from row to row, in the triangle's plane.
        let [p, q] = [[b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]];
        let right = (p[2] * q[1] - q[2] * p[1]) / area;
        let below = (p[0] * q[2] - q[0] * p[2]) / area;
        let mut looked = 0;
        for row in down[0]..=down[1] {
            let y = row as f64 + 0.5;
            let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
            for [p, q] in [[a, b], [b, c], [c, a]] {
                if (p[1] <= y) != (q[1] <= y) {
                    let x = p[0] + (y - p[1]) / (q[1] - p[1]) * (q[0] - p[0]);
                    (from, to) = (from.min(x), to.max(x));
                }
            }
            let lean = f64::from(tile.lean(row));
            let Some(columns) = span(from - lean, to - lean, width) else { continue };
            let depth = a[2] + below * (y - a[1]) + right * (columns[0] as f64 + 0.5 + lean - a[0]);
            let (depths, colours) = tile.row(row, columns);
            looked += depths.len();
            for (i, (old, colour)) in depths.iter_mut().zip(colours).enumerate() {
                let depth = (depth + right * i as f64).max(least(2)) as f32;
                if depth < *old {
                    *old = depth;
                    *colour = self.colour;
                }
            }
        }
        Painted { looked, rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_cover_their_area_and_what_is_behind() {
        let mut tile = ScreenTile::default();
        tile.reset([64, 64], [64, 64], [0, 0, 0, 255]);
        let red = u32::from_le_bytes([255, 0, 0, 255]);
        let green = u32::from_le_bytes([0, 255, 0, 255]);
        let face = Face { corners: [[4.0, 4.0, 0.0], [60.0, 4.0, 56.0], [4.0, 60.0, 0.0]], colour: red };
        face.paint(&mut tile, [0.0; 2], 0);
        // Parallel to the picture, and nearer on the right half only.
        let other = Face { corners: [[0.0, 0.0, 28.0], [64.0, 0.0, 28.0], [0.0, 64.0, 28.0]], colour: green };
        other.paint(&mut tile, [0.0; 2], 0);
        let mut counts = [0; 2];
        for row in 0..64 {
            for colour in tile.row(row, [0, 63]).1.iter() {
                counts[0] += i32::from(*colour == red);
                counts[1] += i32::from(*colour == green);
            }
        }
        // Red is left of column 32: 56 * 56 / 2 - 28 * 28 / 2 samples. Green has the rest of 64 * 64 / 2.
        assert!((counts[0] - 1176).abs() < 60 && (counts[1] - 872).abs() < 60, "{counts:?}");
    }
}
