//! Small pictures of blocks, made once and stamped wherever the block recurs.
//!
//! A tile is what a block covers at one size and heading, with its origin at one of a few places between two
//! subsamples. Colours are relative to the colour at entry, so that one tile serves them all.

use super::canvas::Canvas;
use super::mixer::Mixer;
use super::view::Detail;
use crate::{BlockId, Heading};
use core::hash::BuildHasherDefault;
use std::collections::HashMap;

/// The sizes of tiles, as the largest extents of their blocks in subsamples: each is put together from smaller
/// ones, the smallest from strokes.
const EXTENTS: [f64; 4] = [256.0, 96.0, 28.0, 8.0];
/// By size of tile: into how many steps a subsample is divided, each way, for the places of origins. A tile is off by
/// half a step at most.
const STEPS: [f64; SIZES] = [2.0, 4.0, 4.0, 4.0];
/// The same for blocks whose strokes can be told apart, as long as there is room.
const SPARSE_STEPS: f64 = 8.0;
/// By size of tile: blocks of fewer strokes are painted stroke by stroke, which is as fast, and exact.
const FEW: [u32; SIZES] = [48, 16, 12, 8];
/// The same in a picture that has few strokes so far, so that simple drawings are exact throughout.
const SIMPLE: [u32; SIZES] = [640, 160, 80, 8];
/// How many strokes are few for a picture.
pub(super) const SIMPLE_STROKES: u64 = 12_000;
/// Words in a chunk of memory; no tile needs more.
const CHUNK: usize = 1 << 17;
/// Chunks kept; when more are needed, all tiles are dropped and made again as needed.
const CHUNKS: usize = 23;

/// The number of sizes.
pub(super) const SIZES: usize = EXTENTS.len();

/// The size of the tile for a block, if it should have one: 0 is the largest. `simple` says that it is on a picture
/// that has few strokes so far.
pub(super) fn size(extent: f64, strokes: u32, simple: bool) -> Option<usize> {
    let enough = if simple { SIMPLE } else { FEW };
    EXTENTS.iter().rposition(|&largest| extent <= largest).filter(|&size| strokes >= enough[size])
}

/// Everything a tile depends on, apart from what holds for the whole picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Key {
    pub block: BlockId,
    pub heading: Heading,
    /// The number of subsamples in a block unit, as [`scale`] tells.
    pub scale: u64,
    /// Where its origin is between two subsamples, in steps.
    pub offset: [u8; 2],
    /// Whether these are fine steps.
    pub fine: bool,
    /// The bits of the width at entry, where a stroke inside may be wider than a hairline.
    pub width: Option<u64>,
}

/// What tells scales apart: 2^-36 of their size, so that factors give the same tile in whatever order they are multiplied.
pub(super) fn scale(scale: f64) -> u64 {
    (scale.to_bits() + (1 << 15)) >> 16
}

/// A place on the subsample lattice, and the rest of the way to it in steps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Snapped {
    pub cell: [i64; 2],
    pub offset: [u8; 2],
    /// The offset in subsamples.
    pub rest: [f64; 2],
}

/// Whether the strokes of a block can be told apart: it has fewer than pixels.
pub(super) fn is_sparse(extent: f64, strokes: u32) -> bool {
    let side = extent / Detail::Fine.samples() as f64;
    f64::from(strokes) < side * side
}

/// The nearest place for the origin of a block's tile, in `fine` or in ordinary steps.
pub(super) fn snap(at: [f64; 2], size: usize, fine: bool) -> Snapped {
    let steps = if fine { SPARSE_STEPS } else { STEPS[size] };
    let whole = at.map(|v| (v * steps + 0.5).floor() as i64);
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
    planes: usize,
    /// From the lattice cell of the block's origin to the upper left corner.
    pub corner: [i64; 2],
}

/// The bits of a tile, laid out as on a [`Canvas`].
pub(super) struct Bits<'a> {
    pub rows: usize,
    /// By strip: the first row that has bits, and 2^32 times the row after the last.
    pub extents: &'a [u64],
    /// By strip, then row.
    pub covered: &'a [u64],
    /// By plane, then strip, then row.
    pub colours: &'a [u64],
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
    pub(super) fn fits([width, height]: [usize; 2], planes: usize) -> bool {
        width.div_ceil(u64::BITS as usize) * (1 + height * (1 + planes)) <= CHUNK
    }

    pub(super) fn get(&self, key: &Key) -> Option<Tile> {
        self.places.get(key).copied()
    }

    pub(super) fn bits(&self, tile: &Tile) -> Bits<'_> {
        let size = tile.strips * tile.rows;
        let words = &self.chunks[tile.chunk][tile.first..tile.first + tile.strips + size * (1 + tile.planes)];
        let (extents, words) = words.split_at(tile.strips);
        let (covered, colours) = words.split_at(size);
        Bits { rows: tile.rows, extents, covered, colours }
    }

    /// Keeps what is on `canvas`, which [fits](Self::fits).
    pub(super) fn insert(&mut self, key: Key, canvas: &Canvas, corner: [i64; 2]) -> Tile {
        let (strips, rows, planes) = (canvas.strips, canvas.height, canvas.planes);
        let needed = strips * (1 + rows * (1 + planes));
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
        words.extend(canvas.covered.chunks_exact(canvas.rows).map(|strip| {
            let strip = &strip[..rows];
            let first = strip.iter().position(|&word| word != 0).unwrap_or(0);
            let end = strip.iter().rposition(|&word| word != 0).map_or(first, |last| last + 1);
            first as u64 | (end as u64) << 32
        }));
        for strip in [&canvas.covered, &canvas.colours].into_iter().flat_map(|bits| bits.chunks_exact(canvas.rows)) {
            words.extend_from_slice(&strip[..rows]);
        }
        let tile = Tile { chunk: self.chunk, first, strips, rows, planes, corner };
        self.places.insert(key, tile);
        tile
    }
}
