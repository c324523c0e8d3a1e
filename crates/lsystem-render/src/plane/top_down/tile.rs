//! Small pictures of blocks, made once and stamped wherever the block recurs.
//!
//! A tile holds the subsamples that a block covers at one size and heading, with its origin at one of a few places
//! between two subsamples. Colours are relative to the colour at entry, so that one tile serves all entry colours.

use crate::ink::{Dye, Inks, PLANES};
use crate::plane::canvas::Canvas;
use crate::plane::canvas::bit_words::GROUP;
use crate::plane::canvas::bits::{Bits, Planes};
use crate::viewport::Detail;
use core::hash::BuildHasherDefault;
use lsystem_base::Mixer;
use lsystem_drawing::BlockId;
use lsystem_syntax::Heading;
use std::collections::HashMap;

/// The sizes of tiles, as the largest extents of their blocks in subsamples. A tile is put together from smaller tiles,
/// the smallest from strokes.
const EXTENTS: [f64; 5] = [512.0, 256.0, 96.0, 28.0, 8.0];
/// By size of tile: the places for origins in a subsample, each way. A tile is off by at most half the distance between
/// two places.
const STEPS: [f64; SIZES] = [2.0, 2.0, 4.0, 4.0, 4.0];
/// The places for origins of blocks whose strokes are distinguishable, as long as memory allows.
const SPARSE_STEPS: f64 = 8.0;
/// The places for all origins in a sketch.
const SKETCH_STEPS: f64 = 2.0;
/// By size of tile: blocks of fewer strokes are painted stroke by stroke, which is as fast, and exact.
const LEAST_STROKES: [u32; SIZES] = [64, 48, 16, 8, 8];
/// The same for a picture with few strokes so far, so that simple drawings are exact throughout.
const LEAST_STROKES_SIMPLE: [u32; SIZES] = [1280, 640, 160, 80, 8];
/// A picture with fewer strokes than this is simple.
pub(in crate::plane) const SIMPLE_STROKES: u64 = 4_000;
/// Words in a chunk of memory (1 MiB); no tile needs more.
const CHUNK: usize = 1 << 17;
/// The most chunks. If more are needed, all tiles are dropped and made again as needed.
const CHUNKS: usize = 21;
/// The most bytes of all tiles.
pub(in crate::plane) const TILE_BYTES: u64 = (CHUNKS * CHUNK * size_of::<u64>()) as u64;
/// Dyed copies of tiles are made only in the first chunks, up to this number, so that copies do not displace tiles.
const CHUNKS_WITH_COPIES: usize = 16;
/// The most dyed copies of a tile.
const COPIES: usize = 6;
/// The bits of a copy's note that hold the number of the entry's shade. The bits above hold the place of the copy.
const NUMBER: u64 = u16::MAX as u64;

/// The number of sizes.
pub(in crate::plane) const SIZES: usize = EXTENTS.len();

/// The size of the tile for a block, as an index into [`EXTENTS`] (0 is the largest); `None` if a tile does not pay.
/// `simple`: the picture has few strokes so far. The largest tiles are for crowds in one ink: others rarely
/// recur, and take much memory.
pub(in crate::plane) fn size(extent: f64, strokes: u32, inks: Inks, simple: bool) -> Option<usize> {
    let enough = if simple { LEAST_STROKES_SIMPLE } else { LEAST_STROKES };
    let size = EXTENTS.iter().rposition(|&largest| extent <= largest)?;
    let crowd = inks != Inks::Many && !is_sparse(extent, strokes);
    (strokes >= enough[size] && (size > 0 || crowd)).then_some(size)
}

/// Everything that a tile depends on, apart from the settings of the whole picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(in crate::plane) struct Key {
    pub block: BlockId,
    pub heading: Heading,
    /// The subsamples in a block unit, as [`scale`] rounds them.
    pub scale: u64,
    /// The place of the origin between two subsamples, in steps.
    pub offset: [u8; 2],
    /// Whether the steps are those of sparse blocks.
    pub fine: bool,
    /// The bits of the width at entry, if a stroke inside may be wider than a hairline.
    pub width: Option<[u64; 2]>,
}

/// The bits of a scale, rounded to 2^-36 of its size, so that the order in which factors are multiplied does not
/// matter.
pub(in crate::plane) fn scale(scale: f64) -> u64 {
    (scale.to_bits() + (1 << 15)) >> 16
}

/// A place for the origin of a tile.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Snapped {
    /// The subsample, as column and row.
    pub cell: [i64; 2],
    /// The place in the subsample, in steps.
    pub offset: [u8; 2],
    /// The offset in subsamples.
    pub rest: [f64; 2],
}

/// Whether the strokes of a block are distinguishable: the block has fewer strokes than pixels.
pub(in crate::plane) fn is_sparse(extent: f64, strokes: u32) -> bool {
    let side = extent / Detail::Fine.samples() as f64;
    f64::from(strokes) < side * side
}

/// The nearest place for the origin of a block's tile, in `fine` or in ordinary steps, or in those of a sketch.
pub(in crate::plane) fn snap(at: [f64; 2], size: usize, fine: bool, is_sketch: bool) -> Snapped {
    let steps = if is_sketch {
        SKETCH_STEPS
    } else if fine {
        SPARSE_STEPS
    } else {
        STEPS[size]
    };
    let whole = at.map(|v| (v * steps + 0.5).floor() as i64);
    let offset = whole.map(|v| v.rem_euclid(steps as i64) as u8);
    Snapped { cell: whole.map(|v| v.div_euclid(steps as i64)), offset, rest: offset.map(|v| f64::from(v) / steps) }
}

/// The upper left corner of the tile of a block, from the cell of the block's origin, and the tile's size. The middle
/// of the block lies at `middle` from that cell, and the block reaches `reach` from there and `margin` cells more.
pub(in crate::plane) fn area(middle: [f64; 2], reach: [f64; 2], margin: i64) -> ([i64; 2], [usize; 2]) {
    let corner = [0, 1].map(|axis| (middle[axis] - reach[axis]).floor() as i64 - margin);
    let size = [0, 1].map(|axis| (middle[axis] + reach[axis]).ceil() as i64 + margin - corner[axis]);
    (corner, size.map(|side| side.max(1) as usize))
}

/// The place of a tile's words in memory, and its corner on a canvas.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Tile {
    chunk: usize,
    first: usize,
    pub strips: usize,
    pub rows: usize,
    planes: usize,
    /// The upper left corner, in subsamples from the subsample of the block's origin.
    pub corner: [i64; 2],
}

impl Tile {
    /// The number of bit planes for colours.
    pub(in crate::plane) fn planes(&self) -> usize {
        self.planes
    }

    /// The number of words with notes of copies.
    fn copies(&self) -> usize {
        if self.planes > 0 { COPIES } else { 0 }
    }

    /// The first word of the coverage, behind the extents.
    fn covered(&self) -> usize {
        self.first + self.copies() + self.strips
    }

    /// The first word of the planes of colours.
    fn colours(&self) -> usize {
        self.covered() + self.strips * self.rows
    }

    /// The number of words.
    fn len(&self) -> usize {
        self.colours() + self.strips * self.rows * self.planes - self.first
    }
}

/// The tiles made so far.
#[derive(Default)]
pub(in crate::plane) struct Tiles {
    places: HashMap<Key, Tile, BuildHasherDefault<Mixer>>,
    chunks: Vec<Vec<u64>>,
    /// The chunk in use.
    chunk: usize,
    /// Whether tiles had to be dropped.
    pub crowded: bool,
}

impl Tiles {
    pub(in crate::plane) fn clear(&mut self) {
        self.places.clear();
        self.chunks.iter_mut().for_each(Vec::clear);
        self.chunk = 0;
        self.crowded = false;
    }

    /// Whether a tile of this size, in subsamples, fits into a chunk.
    pub(in crate::plane) fn fits([width, height]: [usize; 2], planes: usize) -> bool {
        COPIES + 2 * GROUP + width.div_ceil(u64::BITS as usize) * (1 + height * (1 + planes)) <= CHUNK
    }

    pub(in crate::plane) fn get(&self, key: &Key) -> Option<Tile> {
        self.places.get(key).copied()
    }

    /// The bits of a tile for stamping with a dye. A dyed copy is kept if the same dye recurs.
    pub(in crate::plane) fn bits(&mut self, tile: &Tile, dye: &Dye) -> Bits<'_> {
        let colours = tile.colours();
        let dyed = match dye.entry.number {
            _ if dye.is_even(tile.planes) => None,
            0 => Some((tile.chunk, colours)),
            _ => self.copy(tile, dye),
        };
        let planes = |(chunk, first): (usize, usize), count: usize| Planes {
            words: &self.chunks[chunk],
            first,
            size: tile.strips * tile.rows,
            count,
        };
        Bits {
            rows: tile.rows,
            extents: &self.chunks[tile.chunk][tile.covered() - tile.strips..tile.covered()],
            covered: planes((tile.chunk, tile.covered()), 1),
            colours: planes((tile.chunk, colours), tile.planes),
            dyed: dyed.map(|place| planes(place, dye.digits)),
        }
    }

    /// The chunk and the first word of a tile's copy in a dye. The copy is made at the second request, if memory
    /// allows.
    fn copy(&mut self, tile: &Tile, dye: &Dye) -> Option<(usize, usize)> {
        let entry = u64::from(dye.entry.number);
        let notes = &mut self.chunks[tile.chunk][tile.first..][..tile.copies()];
        let at = notes.iter().position(|&note| note == 0 || note & NUMBER == entry)?;
        if notes[at] > NUMBER {
            let place = (notes[at] / (NUMBER + 1)) as usize;
            return Some((place / CHUNK, place % CHUNK));
        }
        if notes[at] == 0 {
            notes[at] = entry;
            return None;
        }
        let size = tile.strips * tile.rows;
        if self.chunk(size * dye.digits) >= CHUNKS_WITH_COPIES {
            return None;
        }
        let first = self.make_room(size * dye.digits);
        self.chunks[self.chunk].resize(first + size * dye.digits + GROUP, 0);
        let from = tile.colours();
        let mut numbers = [[0; GROUP]; PLANES];
        for start in (0..size).step_by(GROUP) {
            let count = GROUP.min(size - start);
            let words = |plane: usize| {
                let mut words = [0; GROUP];
                words[..count].copy_from_slice(&self.chunks[tile.chunk][from + plane * size + start..][..count]);
                words
            };
            numbers.iter_mut().take(dye.digits).enumerate().for_each(|(digit, number)| *number = words(digit));
            let fixed = if dye.digits < tile.planes { words(dye.digits) } else { [0; GROUP] };
            dye.apply(&mut numbers[..dye.digits], &fixed);
            for (digit, number) in numbers[..dye.digits].iter().enumerate() {
                let to = first + digit * size + start;
                self.chunks[self.chunk][to..to + count].copy_from_slice(&number[..count]);
            }
        }
        self.chunks[tile.chunk][tile.first + at] = entry + (self.chunk * CHUNK + first) as u64 * (NUMBER + 1);
        Some((self.chunk, first))
    }

    /// The chunk for the next `needed` words.
    fn chunk(&self, needed: usize) -> usize {
        let is_full = self.chunks.get(self.chunk).is_some_and(|words| words.len() + needed + GROUP > CHUNK);
        self.chunk + usize::from(is_full)
    }

    /// Makes room for `needed` words, and a group behind them. Returns the first word in the chunk in use.
    fn make_room(&mut self, needed: usize) -> usize {
        self.chunk = self.chunk(needed);
        if self.chunk == CHUNKS {
            self.clear();
            self.crowded = true;
        }
        if self.chunk == self.chunks.len() {
            self.chunks.push(Vec::with_capacity(CHUNK));
        }
        let words = &mut self.chunks[self.chunk];
        words.resize(words.len().max(GROUP), 0);
        words.len()
    }

    /// Keeps the picture on `canvas`, which [fits](Self::fits), as a tile.
    pub(in crate::plane) fn insert(&mut self, key: Key, canvas: &Canvas, corner: [i64; 2]) -> Tile {
        let (strips, rows, planes) = (canvas.strips, canvas.height, canvas.planes);
        let mut tile = Tile { chunk: 0, first: 0, strips, rows, planes, corner };
        tile.first = self.make_room(tile.len());
        tile.chunk = self.chunk;
        let words = &mut self.chunks[self.chunk];
        words.resize(tile.first + tile.copies(), 0);
        append_bits(canvas, words);
        words.resize(words.len() + GROUP, 0);
        self.places.insert(key, tile);
        tile
    }
}

/// Appends a canvas to the words as [`Bits`] expect: the extents, then the planes.
pub(in crate::plane) fn append_bits(canvas: &Canvas, words: &mut Vec<u64>) {
    let rows = canvas.height;
    words.extend(canvas.covered.chunks_exact(canvas.rows).map(|strip| {
        let strip = &strip[..rows];
        let first = strip.iter().position(|&word| word != 0).unwrap_or(0);
        let end = strip.iter().rposition(|&word| word != 0).map_or(first, |last| last + 1);
        first as u64 | (end as u64) << 32
    }));
    for strip in [&canvas.covered, &canvas.colours].into_iter().flat_map(|bits| bits.chunks_exact(canvas.rows)) {
        words.extend_from_slice(&strip[..rows]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ink::{Choice, Shade};
    use crate::plane::canvas::stroke::Capsule;
    use lsystem_syntax::{ColourBy, Style};

    #[test]
    fn however_often_a_tile_is_stamped_it_is_dyed_the_same() {
        let style = Style { colour_by: ColourBy::Symbol, ..Style::default() };
        let choice = Choice::new(&style, &[]);
        let digits = 3;
        // Two moving shades, then a moving one beside a fixed one, across three strips.
        for shades in [[(4, false), (2, false)], [(4, false), (4, true)]] {
            let mut canvas = Canvas::default();
            canvas.reset(150, 29, digits + usize::from(shades[1].1));
            for ((number, fixed), x) in shades.into_iter().zip([20.0, 130.0]) {
                let code = Shade { number, fixed }.code(digits);
                Capsule { from: [x, 10.0], to: [75.0, 15.5], radius: 7.0 }.paint(&mut canvas, code);
            }
            canvas.settle();
            check(&canvas, choice, digits);
        }
    }

    fn check(canvas: &Canvas, choice: Choice, digits: usize) {
        let key =
            Key { block: BlockId(0), heading: Heading::default(), scale: 0, offset: [0; 2], fine: false, width: None };
        let mut tiles = Tiles::default();
        let tile = tiles.insert(key, canvas, [0; 2]);
        // Another tile behind the first.
        tiles.insert(Key { scale: 1, ..key }, canvas, [0; 2]);
        let ink = |canvas: &Canvas, x: usize, y: usize| {
            let at = x / 64 * canvas.rows + y;
            let of = |words: &[u64]| words[at] >> (x % 64) & 1;
            let planes = canvas.colour_planes().enumerate();
            (of(&canvas.covered) != 0).then(|| planes.map(|(digit, plane)| (of(plane) as u32) << digit).sum::<u32>())
        };
        for number in (0..5).cycle().take(20) {
            let dye = Dye { entry: Shade { number, fixed: true }, choice, digits };
            for [left, top] in [[0, 0], [-5, 3], [64, 8], [77, -9], [200, 90]] {
                let mut frame = Canvas::default();
                frame.reset(256, 100, digits);
                frame.stamp(&tiles.bits(&tile, &dye), [left, top], &dye);
                frame.settle();
                for (x, y) in (0..256).flat_map(|x| (0..100).map(move |y| (x, y))) {
                    let from = [x - left, y - top].map(|v| usize::try_from(v).unwrap_or(usize::MAX));
                    let code = (from[0] < 150 && from[1] < 29).then(|| ink(canvas, from[0], from[1])).flatten();
                    let shade = |code: u32| Shade { number: code & 7, fixed: code >> digits != 0 };
                    let expected = code.map(|code| choice.then(dye.entry, shade(code)).number);
                    assert_eq!(ink(&frame, x as usize, y as usize), expected, "{number} at {left}, {top}: {x}, {y}");
                }
            }
        }
    }
}
