//! The samples of a pixel of a picture at rest, summed up by surface.

use super::lanes::{LANES, Lanes};
use super::tile::ScreenTile;

/// Surfaces of a pixel that are farther from each other than this, in samples, are lit apart.
pub(super) const APART: f32 = 8.0;

/// The samples of a pixel that belong to one surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Surface {
    pub count: f32,
    /// The mean depth.
    pub depth: f32,
    /// The sum of the colours in full light: red, green, blue and 0.
    pub colour: Lanes,
    /// The part of that light that comes from the sun.
    pub sunny: f32,
}

/// The depths and the colours of a row of samples.
type SampleLine<'a> = (&'a [[f32; LANES]], &'a [[u32; LANES]]);

/// A row of pixels of a tile, as rows of samples.
pub(super) struct SampleRow<'a>([SampleLine<'a>; LANES]);

/// Four rows of four depths and colours.
struct Samples([(Lanes, [u32; LANES]); LANES]);

impl<'a> SampleRow<'a> {
    /// The first `count` pixels of a row.
    pub(super) fn of(tile: &'a ScreenTile, row: usize, count: usize) -> Self {
        let (depths, _) = tile.depth.as_chunks();
        let (colours, _) = tile.colour.as_chunks();
        Self(core::array::from_fn(|line| {
            let first = (row * LANES + line) * tile.stride / LANES;
            (&depths[first..first + count], &colours[first..first + count])
        }))
    }

    /// The nearest surface in a pixel, and those farther away as another one; `None` where nothing is.
    #[inline(always)]
    pub(super) fn surfaces(&self, column: usize) -> Option<(Surface, Option<Surface>)> {
        // Compared as bits, without branches.
        let mut bits = [0; LANES];
        for (depths, _) in &self.0 {
            for (bits, depth) in bits.iter_mut().zip(depths[column]) {
                *bits |= depth.to_bits() ^ f32::INFINITY.to_bits();
            }
        }
        if bits == [0; LANES] {
            return None;
        }
        let samples = Samples(self.0.map(|(depths, colours)| (Lanes(depths[column]), colours[column])));
        let all = samples.before(f32::INFINITY);
        let [near, far] = samples.ends();
        if far - near <= APART {
            return Some((all.surface(), None));
        }
        let nearest = samples.before(0.5 * (near + far));
        Some((nearest.surface(), Some(all.without(&nearest).surface())))
    }
}

impl Samples {
    /// The least and the greatest depth at which anything is.
    #[inline(always)]
    fn ends(&self) -> [f32; 2] {
        let (mut near, mut far) = (Lanes::all(f32::INFINITY), Lanes::all(f32::NEG_INFINITY));
        for &(depths, _) in &self.0 {
            near = near.at_most_of(depths);
            far = far.at_least_of(depths.or(depths.below(Lanes::all(f32::INFINITY)), far));
        }
        [near.least(), far.greatest()]
    }

    /// The sums of the samples before a depth.
    // Not inlined, to keep the wasm small.
    #[inline(never)]
    fn before(&self, end: f32) -> Sums {
        let (mut pairs, mut greens, mut sunlit) = ([0; LANES], [0; LANES], [0; LANES]);
        let mut depth = Lanes::all(0.0);
        for (depths, colours) in &self.0 {
            // Masked as bits, so that there are no branches.
            let shown = depths.below(Lanes::all(end)).0;
            depth = depth + Lanes(core::array::from_fn(|i| f32::from_bits(depths.0[i].to_bits() & shown[i])));
            for i in 0..LANES {
                let colour = colours[i] & shown[i];
                let (pair, green) = (colour & 0x00ff_00ff, colour >> 8 & 0xff);
                pairs[i] += pair;
                greens[i] += green + (shown[i] & 0x1_0000);
                sunlit[i] += ((pair & 0xffff) + (pair >> 16) + green + 1) * (colour >> 24);
            }
        }
        let sum = |lanes: [u32; LANES]| (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]);
        Sums { pairs: sum(pairs), greens: sum(greens), sunlit: sum(sunlit), depth: depth.sum() }
    }
}

/// Sums of samples.
struct Sums {
    /// Red, and 16 bits above it blue.
    pairs: u32,
    /// Green, and 16 bits above it the number of samples.
    greens: u32,
    /// The part of the sun, 0 to 255, times red, green, blue and 1.
    sunlit: u32,
    depth: f32,
}

impl Sums {
    #[inline(always)]
    fn without(&self, other: &Self) -> Self {
        Self {
            pairs: self.pairs - other.pairs,
            greens: self.greens - other.greens,
            sunlit: self.sunlit - other.sunlit,
            depth: self.depth - other.depth,
        }
    }

    #[inline(always)]
    fn surface(&self) -> Surface {
        let [red, blue, green, count] =
            [self.pairs & 0xffff, self.pairs >> 16, self.greens & 0xffff, self.greens >> 16]
                .map(|sum| sum as i32 as f32);
        Surface {
            count,
            depth: self.depth / count,
            colour: Lanes([red, green, blue, 0.0]),
            sunny: self.sunlit as i32 as f32 / (255.0 * (red + green + blue + count)),
        }
    }
}
