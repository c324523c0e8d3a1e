//! Small pictures of blocks, made once and stamped wherever the block recurs.
//!
//! A tile is what a block covers at one size and heading, with its origin at one of a few places between two
//! subsamples. Colours are kept apart by shade, relative to the colour at entry, so that one tile serves them all.

use super::canvas::Canvas;
use super::view::SAMPLES;
use crate::{BlockId, Heading};
use core::hash::{BuildHasherDefault, Hasher};
use std::collections::HashMap;

/// The sizes of tiles, as the largest extents of their blocks in subsamples: each is put together from smaller
/// ones, the smallest from strokes.
const EXTENTS: [f64; 4] = [256.0, 96.0, 28.0, 8.0];
/// By size of tile: into how many steps a subsample is divided, each way, for the places of origins. A tile is off by
/// half a step at most.
const STEPS: [f64; 4] = [2.0, 4.0, 4.0, 4.0];
/// The same for blocks whose strokes can be told apart, having fewer than pixels, as long as there is room.
const SPARSE_STEPS: f64 = 8.0;
/// By size of tile: blocks of fewer strokes are painted stroke by stroke, which is as fast, and exact.
const FEW: [u32; 4] = [48, 16, 12, 8];
/// By size of tile: the same as long as the picture has few strokes, so that simple drawings are exact throughout.
const SOME: [u32; 4] = [640, 160, 80, 8];
/// How many strokes are few for a picture.
pub(super) const SIMPLE: u64 = 30_000;
/// Words in a chunk of memory; no tile needs more.
const CHUNK: usize = 1 << 16;
/// Chunks kept; when more are needed, all tiles are dropped and made again as needed.
const CHUNKS: usize = 24;

/// The number of sizes.
pub(super) const SIZES: usize = EXTENTS.len();

/// The size of the tile for a block: 0 is the largest. `simple` says that the picture has
/// taken few strokes so far.
pub(super) fn size(extent: f64, strokes: u32, simple: bool) -> Option<usize> {
    let enough = if simple { SOME } else { FEW };
    EXTENTS.iter().rposition(|&largest| extent <= largest).filter(|&size| strokes >= enough[size])
}

/// Everything a tile depends on, apart from what holds for the whole picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    pub block: BlockId,
    pub heading: Heading,
    /// The bits of the number of subsamples in a block unit.
    pub scale: u64,
    /// Where its origin is between two subsamples, in steps.
    pub offset: [u8; 2],
    /// Whether these are fine steps.
    pub fine: bool,
    /// The bits of the width at entry, where a stroke inside may be wider than a hairline.
    pub width: Option<u64>,
}

/// A place on the subsample lattice, and the rest of the way to it in steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Snapped {
    pub cell: [i64; 2],
    pub offset: [u8; 2],
    /// The offset in subsamples.
    pub rest: [f64; 2],
}

/// Whether the strokes of a block can be told apart.
pub(super) fn is_sparse(extent: f64, strokes: u32) -> bool {
    f64::from(strokes) < extent * extent / (SAMPLES * SAMPLES)
}

/// The nearest place for the origin of a block's tile, in `fine` or in ordinary steps.
pub(super) fn snap(at: [f64; 2], size: usize, fine: bool) -> Snapped {
    let steps = if fine { SPARSE_STEPS } else { STEPS[size] };
    let whole = at.map(|v| (v * steps).round() as i64);
    let offset = whole.map(|v| v.rem_euclid(steps as i64) as u8);
    Snapped { cell: whole.map(|v| v.div_euclid(steps as i64)), offset, rest: offset.map(|v| f64::from(v) / steps) }
}

/// Where a tile's bits are, and where they go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    chunk: usize,
    first: usize,
    pub strips: usize,
    pub rows: usize,
    /// How many shades it has.
    shades: usize,
    /// From the lattice cell of the block's origin to the upper left corner.
    pub corner: [i64; 2],
}

/// The bits of a tile, laid out as on a [`Canvas`].
pub(super) struct Bits<'a> {
    pub strips: usize,
    pub rows: usize,
    /// By strip, then row.
    pub covered: &'a [u64],
    /// By shade, then strip, then row, where there are several shades: what of it is covered in each.
    pub shades: &'a [u64],
}

/// The tiles made so far.
#[derive(Default)]
pub(super) struct Tiles {
    places: HashMap<Key, Tile, BuildHasherDefault<Mixer>>,
    chunks: Vec<Vec<u64>>,
    /// The chunk in use.
    chunk: usize,
    /// Whether there were more tiles than could be kept.
    pub crowded: bool,
}

impl Tiles {
    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.chunks.iter_mut().for_each(Vec::clear);
        self.chunk = 0;
        self.crowded = false;
    }

    /// Whether a tile of this size, in subsamples, can be kept.
    pub(super) fn fits([width, height]: [usize; 2], shades: usize) -> bool {
        width.div_ceil(u64::BITS as usize) * height * (1 + shades) <= CHUNK
    }

    pub(super) fn get(&self, key: &Key) -> Option<Tile> {
        self.places.get(key).copied()
    }

    pub(super) fn bits(&self, tile: &Tile) -> Bits<'_> {
        let size = tile.strips * tile.rows;
        let (covered, shades) = self.chunks[tile.chunk][tile.first..].split_at(size);
        let shades = if tile.shades > 1 { &shades[..size * tile.shades] } else { &[] };
        Bits { strips: tile.strips, rows: tile.rows, covered, shades }
    }

    /// Keeps what is on `canvas`, which [fits](Self::fits) and has so many shades.
    pub(super) fn insert(&mut self, key: Key, canvas: &Canvas, shades: usize, corner: [i64; 2]) -> Tile {
        let size = canvas.covered.len();
        let needed = size * (1 + shades);
        if self.chunks.get(self.chunk).is_some_and(|words| words.len() + needed > CHUNK) {
            self.chunk += 1;
        }
        if self.chunk == CHUNKS {
            self.clear();
            self.crowded = true;
        }
        if self.chunk == self.chunks.len() {
            self.chunks.push(Vec::with_capacity(CHUNK));
        }
        let words = &mut self.chunks[self.chunk];
        let first = words.len();
        words.extend_from_slice(&canvas.covered);
        if shades > 1 {
            for shade in 0..shades {
                let start = words.len();
                words.extend_from_slice(&canvas.covered);
                for (digit, plane) in canvas.colours.chunks_exact(size).enumerate() {
                    let flip = if shade >> digit & 1 != 0 { 0 } else { u64::MAX };
                    for (word, digit) in words[start..].iter_mut().zip(plane) {
                        *word &= digit ^ flip;
                    }
                }
            }
        }
        let (strips, rows) = (canvas.strips, canvas.rows);
        let tile = Tile { chunk: self.chunk, first, strips, rows, shades, corner };
        self.places.insert(key, tile);
        tile
    }
}

/// A fast hash for keys that nobody chooses with ill intent beyond wasting their own time.
#[derive(Default)]
pub(super) struct Mixer(u64);

impl Hasher for Mixer {
    fn finish(&self) -> u64 {
        self.0 ^ self.0 >> 32
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.write_u64(u64::from(*byte));
        }
    }

    fn write_u8(&mut self, value: u8) {
        self.write_u64(u64::from(value));
    }

    fn write_u32(&mut self, value: u32) {
        self.write_u64(u64::from(value));
    }

    fn write_u64(&mut self, value: u64) {
        self.0 = (self.0.rotate_left(5) ^ value).wrapping_mul(0x517c_c1b7_2722_0a95);
    }

    fn write_usize(&mut self, value: usize) {
        self.write_u64(value as u64);
    }
}
