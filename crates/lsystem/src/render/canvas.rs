//! The subsamples of a picture: one bit each for "covered", and a colour number in binary, a bit plane per digit.
//!
//! Bits lie in vertical strips of 64 columns, a word per row, so that stamping a tile at any offset is a loop over
//! consecutive words with one shift. Painting goes from the last drawn to the first: what is covered stays.

use super::tile::Bits;
use core::ops::Range;

/// Columns in a strip.
const STRIP: usize = u64::BITS as usize;
/// Rows in a cell; a cell is a strip's word range for which coverage is remembered.
const CELL: usize = 64;
/// Cells in a word of bits.
const CELLS: usize = u64::BITS as usize;

/// A bit picture. Coordinates are subsamples, y down.
#[derive(Default)]
pub(super) struct Canvas {
    pub strips: usize,
    pub rows: usize,
    /// Cells in a strip.
    pub cells: usize,
    /// Colour digits.
    pub digits: usize,
    /// By strip, then row.
    pub covered: Vec<u64>,
    /// By digit, then strip, then row. Only bits that are covered are ever set.
    pub colours: Vec<u64>,
    /// By strip, then cell: whether anything was painted there.
    pub touched: Vec<bool>,
    /// By strip, then cell: so many of its first rows are covered throughout.
    done: Vec<u8>,
    /// By strip: a bit for each cell that may not be covered throughout.
    open: Vec<u64>,
}

impl Canvas {
    /// Makes it empty and at least `width` by `height` subsamples.
    pub(super) fn reset(&mut self, width: usize, height: usize, digits: usize) {
        let (strips, rows) = (width.div_ceil(STRIP), height);
        if (strips, rows, digits) != (self.strips, self.rows, self.digits) {
            (self.strips, self.rows, self.digits) = (strips, rows, digits);
            self.cells = rows.div_ceil(CELL);
            let size = strips * rows;
            self.covered.clear();
            self.covered.resize(size, 0);
            self.colours.clear();
            self.colours.resize(size * digits, 0);
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
                for digit in 0..digits {
                    self.colours[digit * size + first..digit * size + last].fill(0);
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
                    let from = cell * CELL + usize::from(self.done[at]);
                    let column = &self.covered[strip * self.rows..][..self.rows];
                    let full = from + column[from..last].iter().take_while(|&&word| word == u64::MAX).count();
                    self.done[at] = (full - cell * CELL) as u8;
                    if full == last {
                        self.open[index] &= !(open & open.wrapping_neg());
                    } else {
                        let rows = &column[full.max(y[0])..last.min(y[1] + 1).max(full.max(y[0]))];
                        if rows.iter().any(|word| word | outside != u64::MAX) {
                            return false;
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

    /// Paints a tile with its upper left corner at (`x`, `y`), its shades in these colours.
    pub(super) fn stamp(&mut self, tile: &Bits<'_>, [x, y]: [i64; 2], colours: &[u32]) {
        let above = (-y).clamp(0, tile.rows as i64) as usize;
        let below = (self.rows as i64 - y).clamp(0, tile.rows as i64) as usize;
        if above >= below {
            return;
        }
        let row = (y + above as i64) as usize;
        let shift = x.rem_euclid(STRIP as i64) as u32;
        for strip in 0..tile.strips {
            let left = x.div_euclid(STRIP as i64) + strip as i64;
            self.stamp_strip(tile, strip, above..below, left, row, colours, |word| word << shift);
            if shift > 0 {
                self.stamp_strip(tile, strip, above..below, left + 1, row, colours, |word| word >> (64 - shift));
            }
        }
    }

    /// Paints `rows` of a tile's strip `from`, each word moved, from `row` on in strip `to`.
    #[expect(clippy::too_many_arguments, reason = "the inner loop of one caller")]
    #[inline(always)]
    fn stamp_strip(
        &mut self,
        tile: &Bits<'_>,
        from: usize,
        rows: Range<usize>,
        to: i64,
        row: usize,
        colours: &[u32],
        moved: impl Fn(u64) -> u64,
    ) {
        let Some(to) = usize::try_from(to).ok().filter(|&to| to < self.strips) else { return };
        let count = rows.len();
        let cells = self.cells;
        if self.is_closed(to, [row / CELL, (row + count - 1) / CELL]) {
            return;
        }
        self.touched[to * cells + row / CELL..=to * cells + (row + count - 1) / CELL].fill(true);
        let at = to * self.rows + row;
        let source = from * tile.rows + rows.start;
        let covered = &mut self.covered[at..at + count];
        let bits = &tile.covered[source..source + count];
        let (size, tile_size) = (self.strips * self.rows, tile.strips * tile.rows);
        if self.digits > 0
            && covered.iter().zip(bits).fold(0, |new, (covered, word)| new | moved(*word) & !covered) == 0
        {
            return;
        }
        for (shade, colour) in colours.iter().enumerate() {
            let shaded =
                if tile.shades.is_empty() { bits } else { &tile.shades[shade * tile_size + source..][..count] };
            for digit in (0..self.digits).filter(|digit| colour >> digit & 1 != 0) {
                let plane = &mut self.colours[digit * size + at..][..count];
                for ((plane, covered), word) in plane.iter_mut().zip(&*covered).zip(shaded) {
                    *plane |= moved(*word) & !covered;
                }
            }
        }
        for (covered, word) in covered.iter_mut().zip(bits) {
            *covered |= moved(*word);
        }
    }

    /// Whether these cells of a strip, ends included, are known to be covered throughout.
    #[inline]
    fn is_closed(&self, strip: usize, cells: [usize; 2]) -> bool {
        let words = self.cells.div_ceil(CELLS);
        (cells[0] / CELLS..=cells[1] / CELLS).all(|word| self.open[strip * words + word] & columns(word, cells) == 0)
    }

    /// Paints a shape row by row. `sides` gives the first and the last column in each of `rows`, which are asked for
    /// one after the other, and `bounds` the first and the last column that the shape reaches in some of them.
    #[inline]
    pub(super) fn fill(
        &mut self,
        rows: Range<usize>,
        colour: u32,
        bounds: impl Fn(Range<usize>) -> [i64; 2],
        mut sides: impl FnMut(usize) -> [i64; 2],
    ) {
        let right = (self.strips * STRIP) as i64 - 1;
        let mut row = rows.start;
        while row < rows.end {
            let cell = row / CELL;
            let end = rows.end.min((cell + 1) * CELL);
            let reach = bounds(row..end);
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
            for row in row..end {
                let [first, last] = sides(row);
                let (first, last) = (first.max(0), last.min(right));
                if first <= last && !closed {
                    self.span(row, first as usize, last as usize, colour);
                }
            }
            row = end;
        }
    }

    /// Paints columns `first..=last` of a row, which lie on the canvas.
    #[inline]
    fn span(&mut self, row: usize, first: usize, last: usize, colour: u32) {
        for strip in first / STRIP..=last / STRIP {
            let bits = columns(strip, [first, last]);
            let at = strip * self.rows + row;
            let before = self.covered[at];
            self.covered[at] = before | bits;
            let mut digits = colour;
            let mut plane = at;
            while digits != 0 {
                if digits & 1 != 0
                    && let Some(word) = self.colours.get_mut(plane)
                {
                    *word |= bits & !before;
                }
                digits >>= 1;
                plane += self.covered.len();
            }
        }
    }
}

/// The bits of a strip that lie in columns `x`, ends included.
fn columns(strip: usize, x: [usize; 2]) -> u64 {
    let low = x[0].saturating_sub(strip * STRIP).min(STRIP - 1);
    let high = (x[1] - strip * STRIP).min(STRIP - 1);
    u64::MAX << low & u64::MAX >> (STRIP - 1 - high)
}
