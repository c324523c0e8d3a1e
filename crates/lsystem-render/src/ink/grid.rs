//! The places of sums in a picture.

use crate::viewport::{Detail, Viewport};
use lsystem_syntax::Ink;

/// Pixels along the side of a place in a sketch: a ninth of the sums of a fine picture.
const COARSE_SIDE: u32 = 3;
/// The most sums that shade a picture. A larger picture has larger places.
const MAX_SHADING_SUMS: f64 = (1 << 22) as f64;
/// The largest extent of a dot that shades, in pixels: a block whose ink is all added at its centre of gravity. Larger
/// dots would blur shades.
const SHADING_DOT: f64 = 2.0;

/// The most MiB of tiles: of sums alone, and of sums that shade, which leave room for the tiles of the opaque picture.
const CHUNKS: [usize; 2] = [16, 7];

/// The size of the places of sums.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Grid {
    /// Pixels along the side of a place.
    pub side: u32,
    /// Places on each side of the picture that have sums as well, so that pixels at its edge lie between places.
    pub margin: u32,
    /// The largest extent of a dot at first, in places.
    pub dot: f64,
    /// Points of a line for each place along it. Between more points, ink varies less.
    pub points: f64,
    /// The most chunks of memory for tiles.
    pub chunks: usize,
    /// Whether the picture is a [sketch](Detail::Sketch): larger blocks are drawn as haze, and tiles have fewer places.
    pub is_sketch: bool,
}

impl Grid {
    pub(crate) fn new(ink: Ink, viewport: Viewport, detail: Detail) -> Self {
        let is_sketch = detail == Detail::Sketch;
        let coarse = if detail == Detail::Fine { 1 } else { COARSE_SIDE };
        if ink != Ink::Auto {
            return Self { side: coarse, margin: 0, dot: 1.0, points: 2.0, chunks: CHUNKS[0], is_sketch };
        }
        let pixels = f64::from(viewport.width) * f64::from(viewport.height);
        let least = (pixels / MAX_SHADING_SUMS).sqrt().ceil() as u32;
        let side = coarse.max(least);
        let dot = (SHADING_DOT / f64::from(side)).max(1.0);
        Self { side, margin: 1, dot, points: 1.0, chunks: CHUNKS[1], is_sketch }
    }

    /// The number of sums along the side of a pixel.
    pub(crate) fn samples(self) -> f64 {
        1.0 / f64::from(self.side)
    }

    /// The number of places across and down.
    pub(crate) fn size(self, [width, height]: [u32; 2]) -> [usize; 2] {
        [width, height].map(|pixels| (pixels.div_ceil(self.side) + 2 * self.margin) as usize)
    }

    /// The last place whose centre is not beyond the centre of a pixel, and the part of the way to the next one.
    /// Without a margin, pixels at the edge have no such place.
    pub(crate) fn before(self, pixel: u32) -> (u32, f32) {
        let (halves, at) = (2 * self.side, 2 * pixel + 1 + self.side * (2 * self.margin).saturating_sub(1));
        (at / halves, (at % halves) as f32 / halves as f32)
    }
}
