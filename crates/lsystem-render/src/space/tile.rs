//! The samples of a part of a picture: the nearest surface at each, its depth and its colour.

use super::lanes::LANES;

/// Samples along the side of a cell, for which the farthest depth is remembered.
pub(super) const CELL: usize = 8;
/// After so many changes a cell's farthest depth is looked up again: a cell is seldom covered by less.
const STALE: u8 = 4;
/// How far to the right of their places the samples are in each of a pixel's four rows, so that upright edges, which
/// trees have most of, pass them one after the other and not four at once.
const LEAN: [f32; 4] = [-0.375, 0.125, -0.125, 0.375];

/// A rectangle of samples, row by row. Behind every row there is room for some more that are never looked at.
#[derive(Default)]
pub(super) struct Tile {
    /// Samples across and down, multiples of [`CELL`].
    pub(super) size: [usize; 2],
    /// How many of them there is room for.
    room: [usize; 2],
    /// From one row to the next.
    stride: usize,
    /// How far behind the target; infinite where nothing is.
    depth: Vec<f32>,
    /// Red in the lowest byte.
    colour: Vec<u32>,
    /// By cell: the farthest of its depths, or farther.
    far: Vec<f32>,
    /// By cell: how often something may have come nearer since.
    stale: Vec<u8>,
    background: u32,
    /// Whether samples lean, as those of pixels of four by four do.
    pub(super) leans: bool,
    /// By row of cells: the first and the last sample of what may have been painted; the other way round without any.
    reach: Vec<[usize; 2]>,
}

impl Tile {
    /// Empties it, with at least so many samples across and down, and room for others of the same picture.
    pub(super) fn reset(&mut self, size: [usize; 2], room: [usize; 2], [r, g, b]: [u8; 3]) {
        let background = u32::from_le_bytes([r, g, b, u8::MAX]);
        let [size, room] = [size, room].map(|sides| sides.map(|count| count.next_multiple_of(CELL)));
        let [cells, rows] = room.map(|count| count / CELL);
        self.size = size;
        if (room, background) != (self.room, self.background) {
            (self.room, self.background) = (room, background);
            self.stride = room[0] + LANES;
            refill(&mut self.depth, self.stride * room[1], f32::INFINITY);
            refill(&mut self.colour, self.stride * room[1], background);
            refill(&mut self.far, cells * rows, f32::INFINITY);
            refill(&mut self.stale, cells * rows, 0);
            refill(&mut self.reach, rows, [room[0], 0]);
            return;
        }
        for (row, reach) in self.reach.iter_mut().enumerate() {
            let [left, right] = core::mem::replace(reach, [room[0], 0]);
            if left > right {
                continue;
            }
            for line in row * CELL..(row + 1) * CELL {
                let at = line * self.stride;
                self.depth[at + left..=at + right].fill(f32::INFINITY);
                self.colour[at + left..=at + right].fill(background);
            }
            let span = row * cells + left / CELL..=row * cells + right / CELL;
            self.far[span.clone()].fill(f32::INFINITY);
            self.stale[span].fill(0);
        }
    }

    /// How far to the right of its place a row's samples are.
    #[inline]
    pub(super) fn lean(&self, row: usize) -> f32 {
        if self.leans { LEAN[row % LEAN.len()] } else { 0.0 }
    }

    /// How far samples are from their places at most.
    #[inline]
    pub(super) fn slack(&self) -> f64 {
        if self.leans { f64::from(LEAN[3]) } else { 0.0 }
    }

    /// Whether all samples of a rectangle, ends included, show something nearer than `near`.
    // Inlined into its long caller, the loop would keep its values in memory.
    #[inline(never)]
    pub(super) fn hides(&mut self, [left, right]: [usize; 2], [top, bottom]: [usize; 2], near: f32) -> bool {
        for row in top / CELL..=bottom / CELL {
            for column in left / CELL..=right / CELL {
                let cell = row * (self.room[0] / CELL) + column;
                if !self.is_hidden(cell, near) {
                    return false;
                }
            }
        }
        true
    }

    /// What of the samples `left..=right` of a row of cells is not behind something nearer than `near`, as far as cells
    /// tell, and notes that it is about to be painted; the other way round where nothing is.
    pub(super) fn seen(&mut self, row: usize, [mut left, mut right]: [usize; 2], near: f32) -> [usize; 2] {
        let first = row * (self.room[0] / CELL);
        while left <= right && self.is_hidden(first + left / CELL, near) {
            left = (left / CELL + 1) * CELL;
        }
        while left < right && self.is_hidden(first + right / CELL, near) {
            right = right / CELL * CELL - 1;
        }
        if left <= right {
            let reach = &mut self.reach[row];
            *reach = [reach[0].min(left), reach[1].max(right)];
            let cells = &mut self.stale[first + left / CELL..=first + right / CELL];
            cells.iter_mut().for_each(|times| *times = times.saturating_add(1));
        }
        [left, right]
    }

    /// Whether all samples of a cell show something nearer than `near`.
    #[inline]
    fn is_hidden(&mut self, cell: usize, near: f32) -> bool {
        self.far[cell] < near || self.stale[cell] >= STALE && self.farthest(cell) < near
    }

    /// Looks up how far a cell reaches.
    fn farthest(&mut self, cell: usize) -> f32 {
        let (stride, cells) = (self.stride, self.room[0] / CELL);
        let first = cell / cells * CELL * stride + cell % cells * CELL;
        let mut far = [f32::NEG_INFINITY; CELL];
        for row in self.depth[first..first + (CELL - 1) * stride + CELL].chunks(stride) {
            for (far, depth) in far.iter_mut().zip(row) {
                *far = if *depth > *far { *depth } else { *far };
            }
        }
        let far = far.iter().fold(f32::NEG_INFINITY, |a, b| a.max(*b));
        self.stale[cell] = 0;
        self.far[cell] = far;
        far
    }

    /// Notes that something is about to be painted in a rectangle, ends included.
    pub(super) fn touch(&mut self, [left, right]: [usize; 2], [top, bottom]: [usize; 2]) {
        for row in top / CELL..=bottom / CELL {
            let reach = &mut self.reach[row];
            *reach = [reach[0].min(left), reach[1].max(right)];
            let first = row * (self.room[0] / CELL);
            let cells = &mut self.stale[first + left / CELL..=first + right / CELL];
            cells.iter_mut().for_each(|times| *times = times.saturating_add(1));
        }
    }

    /// Depths and colours of the samples `left..=right` of a row.
    #[inline]
    pub(super) fn row(&mut self, row: usize, [left, right]: [usize; 2]) -> (&mut [f32], &mut [u32]) {
        let at = row * self.stride;
        (&mut self.depth[at + left..=at + right], &mut self.colour[at + left..=at + right])
    }

    /// The same for the samples from `left` on, up to `right` or a few more.
    #[inline]
    pub(super) fn lanes(
        &mut self,
        row: usize,
        [left, right]: [usize; 2],
    ) -> (&mut [[f32; LANES]], &mut [[u32; LANES]]) {
        let at = row * self.stride;
        let end = at + left + (right + 1 - left).next_multiple_of(LANES);
        let (depth, _) = self.depth[at + left..end].as_chunks_mut();
        let (colour, _) = self.colour[at + left..end].as_chunks_mut();
        (depth, colour)
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
        let first = row * samples * self.stride + from * samples;
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
                let from = first + line * self.stride + x * samples;
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
