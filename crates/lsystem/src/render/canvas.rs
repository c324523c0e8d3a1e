//! The subsamples of a picture: one bit each for "covered", and a colour number in binary, a bit plane per digit.
//!
//! Bits lie in vertical strips of 64 columns, a word per row, so that stamping a tile at any offset is a loop over
//! consecutive words with one shift. Painting goes from the last drawn to the first: what is covered stays.

use super::inks::{Dye, PLANES};
use super::tile::Bits;
use core::ops::Range;

/// Columns in a strip.
const STRIP: usize = u64::BITS as usize;
/// Rows in a cell; a cell is a strip's word range for which coverage is remembered.
const CELL: usize = 64;
/// Rows in a group; a group is a strip's word range of which some holes are left.
const GROUP: usize = 8;
/// So many subsamples of a group, of 512, may stay bare on a canvas that leaves holes: what a whole picture is off by
/// is 1/255 at most, and what 8x8 pixels are off by 2/255. The last holes of a crowd take longest to fill.
const HOLES: u32 = 2;
/// Cells in a word of bits.
const CELLS: usize = u64::BITS as usize;

/// A bit picture. Coordinates are subsamples, y down.
#[derive(Default)]
pub(super) struct Canvas {
    pub strips: usize,
    pub rows: usize,
    /// Cells in a strip.
    pub cells: usize,
    /// Bit planes of colours.
    pub planes: usize,
    /// Whether what is covered but for a few holes counts as covered.
    pub holes: bool,
    /// By strip, then row.
    pub covered: Vec<u64>,
    /// By plane, then strip, then row. Only bits that are covered are ever set.
    pub colours: Vec<u64>,
    /// By strip, then cell: whether anything was painted there.
    pub touched: Vec<bool>,
    /// By strip, then cell: so many of its first rows are covered throughout, or as good as that.
    done: Vec<u8>,
    /// By strip: a bit for each cell that may not be covered throughout.
    open: Vec<u64>,
}

impl Canvas {
    /// Makes it empty and at least `width` by `height` subsamples.
    pub(super) fn reset(&mut self, width: usize, height: usize, planes: usize) {
        let (strips, rows) = (width.div_ceil(STRIP), height);
        if (strips, rows, planes) != (self.strips, self.rows, self.planes) {
            (self.strips, self.rows, self.planes) = (strips, rows, planes);
            self.cells = rows.div_ceil(CELL);
            let size = strips * rows;
            self.covered.clear();
            self.covered.resize(size, 0);
            self.colours.clear();
            self.colours.resize(size * planes, 0);
            let cells = strips * self.cells;
            self.touched.clear();
            self.touched.resize(cells, false);
            self.done.clear();
            self.done.resize(cells, 0);
            self.open.clear();
            self.open.resize(strips * self.cells.div_ceil(CELLS), u64::MAX);
            return;
        }
        let (cells, size) = (self.cells, strips * rows);
        for index in 0..self.touched.len() {
            if core::mem::take(&mut self.touched[index]) {
                self.done[index] = 0;
                self.open[index / cells * cells.div_ceil(CELLS) + index % cells / CELLS] |=
                    1 << (index % cells % CELLS);
                let first = index / cells * rows + index % cells * CELL;
                let last = index / cells * rows + (index % cells * CELL + CELL).min(rows);
                self.covered[first..last].fill(0);
                for plane in 0..planes {
                    self.colours[plane * size + first..plane * size + last].fill(0);
                }
            }
        }
    }

    /// Whether the rectangle of columns `x` and rows `y`, ends included, is covered throughout (the part outside
    /// counts as covered).
    pub(super) fn is_full(&mut self, x: [i64; 2], y: [i64; 2]) -> bool {
        let Some((x, y)) = self.clip(x, y) else { return true };
        let cells = [y[0] / CELL, y[1] / CELL];
        for strip in x[0] / STRIP..=x[1] / STRIP {
            let outside = !columns(strip, x);
            for word in cells[0] / CELLS..=cells[1] / CELLS {
                let index = strip * self.cells.div_ceil(CELLS) + word;
                let mut open = self.open[index] & columns(word, cells);
                while open != 0 {
                    let cell = word * CELLS + open.trailing_zeros() as usize;
                    let at = strip * self.cells + cell;
                    let last = (cell * CELL + CELL).min(self.rows);
                    let mut full = cell * CELL + usize::from(self.done[at]);
                    let column = &self.covered[strip * self.rows..][..self.rows];
                    while full < last {
                        let end = (full + GROUP).min(last);
                        if !is_good(&column[full..end], self.holes) {
                            break;
                        }
                        full = end;
                    }
                    self.done[at] = (full - cell * CELL) as u8;
                    if full == last {
                        self.open[index] &= !(open & open.wrapping_neg());
                    } else {
                        // What is left of the rectangle, group by group.
                        let mut from = full.max(y[0]);
                        while from < last.min(y[1] + 1) {
                            let end = (from / GROUP * GROUP + GROUP).min(last);
                            let rows = &column[from..end.min(y[1] + 1)];
                            if rows.iter().any(|word| word | outside != u64::MAX)
                                && !(self.holes && is_good(&column[from / GROUP * GROUP..end], true))
                            {
                                return false;
                            }
                            from = end;
                        }
                    }
                    open &= open - 1;
                }
            }
        }
        true
    }

    /// The part of a rectangle that lies on the canvas.
    fn clip(&self, x: [i64; 2], y: [i64; 2]) -> Option<([usize; 2], [usize; 2])> {
        let right = (self.strips * STRIP) as i64 - 1;
        let bottom = self.rows as i64 - 1;
        let x = [x[0].max(0), x[1].min(right)];
        let y = [y[0].max(0), y[1].min(bottom)];
        (x[0] <= x[1] && y[0] <= y[1]).then_some((x.map(|v| v as usize), y.map(|v| v as usize)))
    }

    /// Paints a tile with its upper left corner at (`x`, `y`), dyed.
    pub(super) fn stamp(&mut self, tile: &Bits<'_>, [x, y]: [i64; 2], dye: &Dye) {
        let shift = x.rem_euclid(STRIP as i64) as u32;
        for (strip, &extent) in tile.extents.iter().enumerate() {
            let [first, last] = [extent & u64::from(u32::MAX), extent >> 32].map(|row| row as i64);
            let above = (-y).clamp(first, last.max(first)) as usize;
            let below = (self.rows as i64 - y).clamp(first, last.max(first)) as usize;
            if above >= below {
                continue;
            }
            let row = (y + above as i64) as usize;
            let left = x.div_euclid(STRIP as i64) + strip as i64;
            self.stamp_strip(tile, strip, above..below, left, row, dye, [shift, 0]);
            if shift > 0 {
                self.stamp_strip(tile, strip, above..below, left + 1, row, dye, [0, 64 - shift]);
            }
        }
    }

    /// Paints `rows` of a tile's strip `from`, each word shifted left and right by so many bits, from `row` on in strip
    /// `to`.
    #[expect(clippy::too_many_arguments, reason = "the inner loop of one caller")]
    fn stamp_strip(
        &mut self,
        tile: &Bits<'_>,
        from: usize,
        rows: Range<usize>,
        to: i64,
        row: usize,
        dye: &Dye,
        [left, right]: [u32; 2],
    ) {
        let moved = |word: u64| word << left >> right;
        let Some(to) = usize::try_from(to).ok().filter(|&to| to < self.strips) else { return };
        let size = self.strips * self.rows;
        let end = row + rows.len();
        let mut next = row;
        while next < end {
            let cell = next / CELL;
            let part = next..end.min((cell + 1) * CELL);
            next = part.end;
            if self.is_closed(to, [cell, cell]) {
                continue;
            }
            let at = to * self.rows + part.start;
            let source = from * tile.rows + rows.start + part.start - row;
            let covered = &mut self.covered[at..at + part.len()];
            let bits = &tile.covered[source..source + part.len()];
            // Most of what is stamped in a crowd is covered already.
            let (new, full) = (covered.iter().zip(bits))
                .fold((0, u64::MAX), |(new, full), (covered, word)| (new | moved(*word) & !covered, full & covered));
            if new == 0 {
                if full == u64::MAX && part.len() == CELL {
                    self.close(to, cell);
                }
                continue;
            }
            self.touched[to * self.cells + cell] = true;
            if self.planes == 0 {
                for (covered, word) in covered.iter_mut().zip(bits) {
                    *covered |= moved(*word);
                }
                continue;
            }
            let colours = tile.colours;
            let plane_of = |plane: usize, i: usize| moved(colours[plane * tile.covered.len() + source + i]);
            let plain = colours.is_empty() || dye.changes_nothing();
            for start in (0..part.len()).step_by(GROUP) {
                let end = (start + GROUP).min(part.len());
                let mut new = [0; GROUP];
                let mut any = 0;
                for (i, new) in (start..end).zip(&mut new) {
                    *new = moved(bits[i]) & !covered[i];
                    covered[i] |= *new;
                    any |= *new;
                }
                if any == 0 {
                    continue;
                }
                if plain {
                    let code = dye.entry.code(dye.digits);
                    for (plane, words) in self.colours.chunks_exact_mut(size).enumerate() {
                        let words = &mut words[at + start..at + end];
                        if !colours.is_empty() && plane * tile.covered.len() < colours.len() {
                            for ((i, new), word) in (start..end).zip(new).zip(words) {
                                *word |= plane_of(plane, i) & new;
                            }
                        } else if code >> plane & 1 != 0 {
                            for (new, word) in new.into_iter().zip(words) {
                                *word |= new;
                            }
                        }
                    }
                    continue;
                }
                let mut planes = [[0; GROUP]; PLANES];
                for (plane, words) in planes.iter_mut().enumerate().take(colours.len() / tile.covered.len()) {
                    for (i, word) in (start..end).zip(words) {
                        *word = plane_of(plane, i);
                    }
                }
                dye.apply(&mut planes);
                for (words, plane) in self.colours.chunks_exact_mut(size).zip(planes) {
                    for ((word, plane), new) in words[at + start..at + end].iter_mut().zip(plane).zip(new) {
                        *word |= plane & new;
                    }
                }
            }
        }
    }

    /// Notes that a cell is covered throughout.
    fn close(&mut self, strip: usize, cell: usize) {
        self.open[strip * self.cells.div_ceil(CELLS) + cell / CELLS] &= !(1 << (cell % CELLS));
    }

    /// Whether these cells of a strip, ends included, are known to be covered throughout.
    #[inline]
    fn is_closed(&self, strip: usize, cells: [usize; 2]) -> bool {
        let words = self.cells.div_ceil(CELLS);
        (cells[0] / CELLS..=cells[1] / CELLS).all(|word| self.open[strip * words + word] & columns(word, cells) == 0)
    }

    /// Paints a shape row by row. `sides` gives the first and the last column in each of `rows`, and `bounds` the
    /// first and the last column that the shape reaches in some of them.
    #[inline]
    pub(super) fn fill(
        &mut self,
        rows: Range<usize>,
        colour: u32,
        bounds: impl Fn(Range<usize>) -> [i64; 2],
        sides: impl Fn(usize) -> [i64; 2],
    ) {
        let right = (self.strips * STRIP) as i64 - 1;
        let mut start = rows.start;
        while start < rows.end {
            let cell = start / CELL;
            let end = rows.end.min((cell + 1) * CELL);
            let reach = bounds(start..end);
            let reach = [reach[0].max(0), reach[1].min(right)];
            let mut closed = true;
            if reach[0] <= reach[1] {
                for strip in reach[0] as usize / STRIP..=reach[1] as usize / STRIP {
                    if !self.is_closed(strip, [cell, cell]) {
                        closed = false;
                        self.touched[strip * self.cells + cell] = true;
                    }
                }
            }
            if !closed {
                for row in start..end {
                    let [first, last] = sides(row);
                    let (first, last) = (first.max(0), last.min(right));
                    if first <= last {
                        self.span(row, first as usize, last as usize, colour);
                    }
                }
            }
            start = end;
        }
    }

    /// Paints columns `first..=last` of a row, which lie on the canvas.
    #[inline]
    fn span(&mut self, row: usize, first: usize, last: usize, colour: u32) {
        for strip in first / STRIP..=last / STRIP {
            let bits = columns(strip, [first, last]);
            let at = strip * self.rows + row;
            let before = self.covered[at];
            if bits & !before == 0 {
                continue;
            }
            self.covered[at] = before | bits;
            let size = self.covered.len();
            let mut left = colour;
            for plane in 0..self.planes {
                if left & 1 != 0 {
                    self.colours[plane * size + at] |= bits & !before;
                }
                left >>= 1;
            }
        }
    }
}

/// Whether the rows of a group are covered, but for the holes that may be left.
#[inline]
fn is_good(rows: &[u64], holes: bool) -> bool {
    if holes {
        rows.iter().map(|row| row.count_zeros()).sum::<u32>() <= HOLES
    } else {
        rows.iter().all(|&row| row == u64::MAX)
    }
}

/// The bits of a strip that lie in columns `x`, ends included.
fn columns(strip: usize, x: [usize; 2]) -> u64 {
    let low = x[0].saturating_sub(strip * STRIP).min(STRIP - 1);
    let high = (x[1] - strip * STRIP).min(STRIP - 1);
    u64::MAX << low & u64::MAX >> (STRIP - 1 - high)
}
