//! Small pictures of blocks in sums of ink, made once and added wherever the block recurs.

use crate::ink::Sheet;
use crate::ink::sheet::{BAND, Band, LANES, Stamp};
use crate::plane::top_down::tile::Key;
use core::hash::BuildHasherDefault;
use lsystem_base::Mixer;
use std::collections::HashMap;

/// The sizes of tiles, as the largest extents of their blocks in pixels. A tile is put together from smaller tiles, the
/// smallest from dots and strokes.
const EXTENTS: [f64; SIZES] = [64.0, 20.0, 7.0];
/// By size of tile: blocks of fewer strokes are drawn stroke by stroke.
const LEAST_STROKES: [u32; SIZES] = [64, 24, 12];
/// The places for origins in a pixel, each way. A tile is off by at most half the distance between two places.
const STEPS: f64 = 4.0;
/// The places for origins of blocks whose strokes are distinguishable, as long as memory allows.
const SPARSE_STEPS: f64 = 8.0;
/// The places for all origins in a sketch.
const SKETCH_STEPS: f64 = 1.0;
/// Numbers in a chunk of memory (1 MiB); no tile needs more.
const CHUNK: usize = 1 << 18;
/// The most bands of all tiles (0.8 MiB). If more are needed, all tiles are dropped and made again as needed.
const BANDS: usize = 1 << 16;

/// The most bytes of all tiles in so many chunks.
pub(in crate::plane) const fn tile_bytes(chunks: usize) -> u64 {
    (chunks * CHUNK * size_of::<f32>() + BANDS * size_of::<Band>()) as u64
}

/// The number of sizes.
pub(super) const SIZES: usize = 3;

/// The size of the tile for a block, as an index into [`EXTENTS`] (0 is the largest); `None` if a tile does not pay.
pub(super) fn size(extent: f64, strokes: u32) -> Option<usize> {
    EXTENTS.iter().rposition(|&largest| extent <= largest).filter(|&size| strokes >= LEAST_STROKES[size])
}

/// Whether the strokes of a block are distinguishable: the block has fewer strokes than pixels.
pub(super) fn is_sparse(extent: f64, strokes: u32) -> bool {
    f64::from(strokes) < extent * extent
}

/// The nearest place for the origin of a block's tile, in `fine` or in ordinary steps, or in those of a sketch: its pixel,
/// the step in the pixel, and the step in pixels.
pub(super) fn snap(at: [f64; 2], fine: bool, is_sketch: bool) -> ([i64; 2], [u8; 2], [f64; 2]) {
    let steps = if is_sketch {
        SKETCH_STEPS
    } else if fine {
        SPARSE_STEPS
    } else {
        STEPS
    };
    let whole = at.map(|v| (v * steps + 0.5).floor() as i64);
    let offset = whole.map(|v| v.rem_euclid(steps as i64) as u8);
    (whole.map(|v| v.div_euclid(steps as i64)), offset, offset.map(|v| f64::from(v) / steps))
}

/// Everything that a tile depends on, apart from the scale, the thinnest stroke, the inks and the unit of the whole
/// picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct InkKey {
    pub key: Key,
    /// The number of the shade at the block's entry, if the block draws in several shades.
    pub shade: Option<u32>,
}

/// The place of a tile's numbers in memory, and its corner on a sheet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    chunk: u32,
    first_band: u32,
    rows: u32,
    planes: u32,
    /// The upper left corner, in pixels from the pixel of the block's origin.
    pub corner: [i64; 2],
}

/// The tiles made so far.
#[derive(Default)]
pub(super) struct Tiles {
    places: HashMap<InkKey, Tile, BuildHasherDefault<Mixer>>,
    chunks: Vec<Vec<f32>>,
    /// The bands of all tiles.
    bands: Vec<Band>,
    /// The chunk in use.
    chunk: usize,
    /// The most chunks. If more are needed, all tiles are dropped.
    most: usize,
    /// Whether tiles had to be dropped.
    pub crowded: bool,
}

impl Tiles {
    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.bands.clear();
        self.chunks.iter_mut().for_each(Vec::clear);
        self.chunk = 0;
        self.crowded = false;
    }

    /// Sets the most chunks. If they change, all tiles are dropped.
    pub(super) fn limit(&mut self, chunks: usize) {
        if self.most != chunks {
            *self = Self { most: chunks, ..Self::default() };
        }
    }

    /// Whether a tile of this size, in pixels, fits into a chunk.
    pub(super) fn fits([width, height]: [usize; 2], planes: usize) -> bool {
        let padded = [width.saturating_add(LANES), height.saturating_add(BAND)];
        padded[0].saturating_mul(padded[1]).saturating_mul(planes) <= CHUNK
    }

    pub(super) fn get(&self, key: &InkKey) -> Option<Tile> {
        self.places.get(key).copied()
    }

    pub(super) fn stamp(&self, tile: &Tile) -> Stamp<'_> {
        Stamp {
            planes: tile.planes as usize,
            rows: tile.rows as usize,
            bands: &self.bands[tile.first_band as usize..][..(tile.rows as usize).div_ceil(BAND)],
            values: &self.chunks[tile.chunk as usize],
        }
    }

    /// Keeps the sums on `sheet`, which [fits](Self::fits), as a tile.
    pub(super) fn insert(&mut self, key: InkKey, sheet: &Sheet, corner: [i64; 2]) -> Tile {
        let planes = sheet.planes;
        let bands = sheet.reach.chunks(BAND).map(|rows| {
            let rows = rows.iter().filter(|reach| !reach.is_empty());
            let (first, end) =
                rows.fold((u32::MAX, 0), |(first, end), reach| (first.min(reach.start), end.max(reach.end)));
            if first < end { (first, (end - first).next_multiple_of(LANES as u32)) } else { (0, 0) }
        });
        let needed: usize = bands.clone().map(|(_, columns)| columns as usize * BAND * planes).sum();
        if self.chunks.get(self.chunk).is_some_and(|values| values.len() + needed > CHUNK) {
            self.chunk += 1;
        }
        if self.chunk >= self.most || self.bands.len() + sheet.height.div_ceil(BAND) > BANDS {
            self.clear();
            self.crowded = true;
        }
        if self.chunk == self.chunks.len() {
            self.chunks.push(Vec::with_capacity(CHUNK));
        }
        let values = &mut self.chunks[self.chunk];
        let first_band = self.bands.len() as u32;
        for (number, (first, columns)) in bands.enumerate() {
            self.bands.push(Band { first, columns, at: values.len() as u32 });
            for row in number * BAND..((number + 1) * BAND).min(sheet.height) {
                let end = values.len() + columns as usize * planes;
                let within = first as usize..((first + columns) as usize).min(sheet.width);
                let at = row * sheet.width;
                values.extend_from_slice(&sheet.values[(at + within.start) * planes..(at + within.end) * planes]);
                values.resize(end, 0.0);
            }
        }
        let (chunk, rows, planes) = (self.chunk as u32, sheet.height as u32, planes as u32);
        let tile = Tile { chunk, first_band, rows, planes, corner };
        self.places.insert(key, tile);
        tile
    }
}
