//! The pixels that a picture covers, and how much of the ink of two pictures agrees.

use crate::{Detail, Renderer, View, Viewport};
use lsystem_base::Progress;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Colour, ColourBy, Ink as Blending, Style};
use std::sync::Arc;

/// The sides of a mask, in pixels.
pub const SIDE: usize = 512;
/// The words of one row.
const ROW: usize = SIDE / 64;
/// A pixel has ink if it is darker than this.
const LIGHT: u8 = 180;

/// The pixels with ink, row by row from above. Bit `x % 64` of word `x / 64` is the pixel at `x`.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask(Box<[[u64; ROW]; SIDE]>);

/// A picture in the making, as a mask.
pub struct Tracing {
    renderer: Renderer,
}

impl Tracing {
    /// The drawing as a whole, its longer side filling the mask, with lines one pixel wide.
    pub fn new(drawing: Arc<Drawing>) -> Self {
        let mut renderer = Renderer::light();
        renderer.load(drawing);
        let style = Style {
            palette: vec![Colour { rgb: [0; 3] }],
            background: Colour { rgb: [255; 3] },
            colour_by: ColourBy::Single,
            ink: Blending::Solid,
            min_width: 1.0,
            hue: 0.0,
            ..Style::default()
        };
        let viewport = Viewport { width: SIDE as u32, height: SIDE as u32, ratio: 1.0 };
        renderer.begin_with(&style, viewport, View::default(), Detail::Coarse, None);
        Self { renderer }
    }

    /// Works for about `work` units.
    pub fn step(&mut self, work: u64) -> Progress {
        self.renderer.step(work as usize)
    }

    /// Runs all steps left.
    #[must_use]
    pub fn finish(mut self) -> Mask {
        while self.renderer.step(usize::MAX) == Progress::More {}
        let mut mask = Mask::default();
        for (at, pixel) in self.renderer.pixels().chunks_exact(4).take(SIDE * SIDE).enumerate() {
            if pixel[0] < LIGHT {
                mask.put(at % SIDE, at / SIDE);
            }
        }
        mask
    }
}

/// Sets the bits of a row from the first to the last one; bit `x % 64` of word `x / 64` is the pixel at `x`.
pub fn put_run(row: &mut [u64], first: usize, last: usize) {
    let (from, to) = (u64::MAX << (first % 64), u64::MAX >> (63 - last % 64));
    if first / 64 == last / 64 {
        row[first / 64] |= from & to;
    } else {
        row[first / 64] |= from;
        row[first / 64 + 1..last / 64].fill(u64::MAX);
        row[last / 64] |= to;
    }
}

impl Default for Mask {
    fn default() -> Self {
        Self(Box::new([[0; ROW]; SIDE]))
    }
}

impl Mask {
    /// The part of the ink of both that has ink of the other within one pixel in each direction: the harmonic mean of
    /// both parts, from 0 to 1. 1 if both are empty.
    #[must_use]
    pub fn agreement(&self, other: &Self) -> f64 {
        let (own, others) = (self.count(), other.count());
        if own + others == 0 {
            return 1.0;
        }
        // With `a` of `own` and `b` of `others` the parts are a/own and b/others.
        let a = self.common(&other.grown()) as f64 / own.max(1) as f64;
        let b = other.common(&self.grown()) as f64 / others.max(1) as f64;
        if a + b == 0.0 { 0.0 } else { 2.0 * a * b / (a + b) }
    }

    /// A code for each pixel, row by row from above: 1 for ink of both within one pixel, 2 for ink of the target only,
    /// 4 for ink of this picture only, 0 for none.
    pub fn compared(&self, target: &Self) -> Vec<u8> {
        let (near_target, near_own) = (target.grown(), self.grown());
        let mut pixels = vec![0; SIDE * SIDE];
        for (at, pixel) in pixels.iter_mut().enumerate() {
            let (y, x) = (at / SIDE, at % SIDE);
            *pixel = match (target.has(x, y), self.has(x, y)) {
                (true, _) if near_own.has(x, y) => 1,
                (true, _) => 2,
                (false, true) if near_target.has(x, y) => 1,
                (false, true) => 4,
                (false, false) => 0,
            };
        }
        pixels
    }

    /// The picture, optionally mirrored left to right, and then turned by quarters counter-clockwise.
    pub fn turned(&self, quarters: u32, is_mirrored: bool) -> Self {
        let mut turned = Self::default();
        for y in 0..SIDE {
            for x in 0..SIDE {
                let from = if is_mirrored { SIDE - 1 - x } else { x };
                if self.has(from, y) {
                    let (x, y) = match quarters % 4 {
                        0 => (x, y),
                        1 => (y, SIDE - 1 - x),
                        2 => (SIDE - 1 - x, SIDE - 1 - y),
                        _ => (SIDE - 1 - y, x),
                    };
                    turned.put(x, y);
                }
            }
        }
        turned
    }

    /// Whether no pixel has ink.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.count() == 0
    }

    /// Gives the pixel ink. `x` and `y` are less than [`SIDE`], from the upper left corner.
    pub fn put(&mut self, x: usize, y: usize) {
        self.0[y][x / 64] |= 1 << (x % 64);
    }

    /// Gives the pixels of a row ink, from the first to the last one, all of them less than [`SIDE`].
    pub fn put_run(&mut self, y: usize, first: usize, last: usize) {
        put_run(&mut self.0[y], first, last);
    }

    /// Whether the pixel has ink. `x` and `y` are less than [`SIDE`], from the upper left corner.
    #[must_use]
    pub fn has(&self, x: usize, y: usize) -> bool {
        self.0[y][x / 64] >> (x % 64) & 1 == 1
    }

    /// The number of pixels with ink.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.0.as_flattened().iter().map(|word| u64::from(word.count_ones())).sum()
    }

    /// The number of pixels with ink in both.
    #[must_use]
    pub fn common(&self, other: &Self) -> u64 {
        let pairs = self.0.as_flattened().iter().zip(other.0.as_flattened());
        pairs.map(|(a, b)| u64::from((a & b).count_ones())).sum()
    }

    /// The pixels with ink and their eight neighbours.
    #[must_use]
    pub fn grown(&self) -> Self {
        let mut wide = self.clone();
        for (row, from) in wide.0.iter_mut().zip(self.0.iter()) {
            for at in 0..ROW {
                let before = if at > 0 { from[at - 1] >> 63 } else { 0 };
                let after = if at + 1 < ROW { from[at + 1] << 63 } else { 0 };
                row[at] |= from[at] << 1 | before | from[at] >> 1 | after;
            }
        }
        let mut grown = wide.clone();
        for y in 0..SIDE {
            for at in 0..ROW {
                let above = if y > 0 { wide.0[y - 1][at] } else { 0 };
                let below = if y + 1 < SIDE { wide.0[y + 1][at] } else { 0 };
                grown.0[y][at] |= above | below;
            }
        }
        grown
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dots(places: &[(usize, usize)]) -> Mask {
        let mut mask = Mask::default();
        places.iter().for_each(|&(x, y)| mask.put(x, y));
        mask
    }

    #[test]
    fn ink_agrees_up_to_one_pixel_each_way() {
        for (x, y) in [(0, 0), (63, 5), (64, 5), (511, 511), (200, 0)] {
            let dot = dots(&[(x, y)]);
            for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (0, 2)] {
                let (ox, oy) = (if x > 2 { x - dx } else { x + dx }, if y > 2 { y - dy } else { y + dy });
                let expected = if dx < 2 && dy < 2 { 1.0 } else { 0.0 };
                assert_eq!(dot.agreement(&dots(&[(ox, oy)])), expected, "{x} {y} {dx} {dy}");
            }
        }
        // One of two is there, and it is the only one: 2 * 1 * 0.5 / 1.5.
        let agreement = dots(&[(9, 9)]).agreement(&dots(&[(9, 9), (99, 99)]));
        assert!((agreement - 2.0 / 3.0).abs() < 1e-12);
        assert_eq!(Mask::default().agreement(&Mask::default()), 1.0);
        assert_eq!(Mask::default().agreement(&dots(&[(1, 1)])), 0.0);
    }

    #[test]
    fn every_pixel_is_told_apart() {
        let compared = dots(&[(10, 10), (50, 50)]).compared(&dots(&[(11, 10), (90, 9)]));
        let at = |x: usize, y: usize| compared[y * SIDE + x];
        assert_eq!([at(10, 10), at(11, 10), at(50, 50), at(90, 9), at(0, 0)], [1, 1, 4, 2, 0]);
    }

    #[test]
    fn turns_are_counter_clockwise() {
        let corner = dots(&[(500, 10)]);
        let expected = [(500, 10), (10, 11), (11, 501), (501, 500)];
        for (quarters, place) in expected.into_iter().enumerate() {
            assert!(corner.turned(quarters as u32, false) == dots(&[place]), "{quarters}");
        }
        assert!(corner.turned(0, true) == dots(&[(11, 10)]));
    }
}
