//! The samples of a part of a picture: the nearest surface at each, its depth and its colour.

/// Samples along the side of a cell, for which the farthest depth is remembered.
const CELL: usize = 8;

/// A square of samples, row by row.
#[derive(Default)]
pub(super) struct Tile {
    /// Samples along its side, a multiple of [`CELL`].
    pub(super) side: usize,
    /// How far behind the target; infinite where nothing is.
    depth: Vec<f32>,
    /// Red in the lowest byte.
    colour: Vec<u32>,
    /// By cell: the farthest of its depths, or farther.
    far: Vec<f32>,
    /// By cell: whether something has come nearer since.
    stale: Vec<bool>,
    background: u32,
    /// By row of cells: the first and the last sample of what may have been painted; the other way round without any.
    reach: Vec<[usize; 2]>,
}

impl Tile {
    /// Empties it, with so many samples along its side.
    pub(super) fn reset(&mut self, side: usize, [r, g, b]: [u8; 3]) {
        let background = u32::from_le_bytes([r, g, b, u8::MAX]);
        let cells = side / CELL;
        if (side, background) != (self.side, self.background) {
            (self.side, self.background) = (side, background);
            refill(&mut self.depth, side * side, f32::INFINITY);
            refill(&mut self.colour, side * side, background);
            refill(&mut self.far, cells * cells, f32::INFINITY);
            refill(&mut self.stale, cells * cells, false);
            refill(&mut self.reach, cells, [side, 0]);
            return;
        }
        for (row, reach) in self.reach.iter_mut().enumerate() {
            let [left, right] = core::mem::replace(reach, [side, 0]);
            if left > right {
                continue;
            }
            for line in row * CELL..(row + 1) * CELL {
                self.depth[line * side + left..=line * side + right].fill(f32::INFINITY);
                self.colour[line * side + left..=line * side + right].fill(background);
            }
            let span = row * cells + left / CELL..=row * cells + right / CELL;
            self.far[span.clone()].fill(f32::INFINITY);
            self.stale[span].fill(false);
        }
    }

    /// Whether all samples of a rectangle, ends included, show something nearer than `near`.
    pub(super) fn hides(&mut self, [left, right]: [usize; 2], [top, bottom]: [usize; 2], near: f32) -> bool {
        for row in top / CELL..=bottom / CELL {
            for column in left / CELL..=right / CELL {
                let cell = row * (self.side / CELL) + column;
                if self.far[cell] >= near && !(self.stale[cell] && self.farthest(cell) < near) {
                    return false;
                }
            }
        }
        true
    }

    /// Looks up how far a cell reaches.
    fn farthest(&mut self, cell: usize) -> f32 {
        let (side, cells) = (self.side, self.side / CELL);
        let first = cell / cells * CELL * side + cell % cells * CELL;
        let mut far = [f32::NEG_INFINITY; CELL];
        for row in self.depth[first..=first + (CELL - 1) * side + CELL - 1].chunks(side) {
            for (far, depth) in far.iter_mut().zip(row) {
                *far = far.max(*depth);
            }
        }
        let far = far.iter().fold(f32::NEG_INFINITY, |a, b| a.max(*b));
        self.stale[cell] = false;
        self.far[cell] = far;
        far
    }

    /// Notes that something is about to be painted in a rectangle, ends included.
    pub(super) fn touch(&mut self, [left, right]: [usize; 2], [top, bottom]: [usize; 2]) {
        for row in top / CELL..=bottom / CELL {
            let reach = &mut self.reach[row];
            *reach = [reach[0].min(left), reach[1].max(right)];
            let first = row * (self.side / CELL);
            self.stale[first + left / CELL..=first + right / CELL].fill(true);
        }
    }

    /// Depths and colours of the samples `left..=right` of a row.
    #[inline]
    pub(super) fn row(&mut self, row: usize, [left, right]: [usize; 2]) -> (&mut [f32], &mut [u32]) {
        let at = row * self.side;
        (&mut self.depth[at + left..=at + right], &mut self.colour[at + left..=at + right])
    }

    /// The first pixel that may have been painted in a row of pixels that are `samples` wide, and the one after the last.
    pub(super) fn painted(&self, row: usize, samples: usize) -> [usize; 2] {
        let [left, right] = self.reach[row * samples / CELL];
        if left > right { [0, 0] } else { [left / samples, right / samples + 1] }
    }

    /// The pixels of a row from number `from` on: the means of their samples' colours.
    pub(super) fn pixels(&self, row: usize, from: usize, samples: usize, out: &mut [u8]) {
        const PAIRS: u32 = 0x00ff_00ff;
        let (out, _) = out.as_chunks_mut::<4>();
        let first = row * samples * self.side + from * samples;
        if samples == 1 {
            for (pixel, colour) in out.iter_mut().zip(&self.colour[first..]) {
                *pixel = colour.to_le_bytes();
            }
            return;
        }
        let count = (samples * samples) as u32;
        let half = count / 2 * 0x0001_0001;
        let shift = count.trailing_zeros();
        for (x, pixel) in out.iter_mut().enumerate() {
            // Sums of two channels each, 16 bits apart: at most 16 * 255.
            let (mut even, mut odd) = (half, half);
            for line in 0..samples {
                let from = first + line * self.side + x * samples;
                for colour in &self.colour[from..from + samples] {
                    even += colour & PAIRS;
                    odd += colour >> 8 & PAIRS;
                }
            }
            let colour = (even >> shift & PAIRS) | (odd >> shift & PAIRS) << 8;
            *pixel = colour.to_le_bytes();
        }
    }
}

fn refill<T: Copy>(vector: &mut Vec<T>, size: usize, value: T) {
    vector.clear();
    vector.resize(size, value);
}
