//! The samples of a part of a picture: the nearest surface at each, its depth and its colour.

use super::lanes::LANES;

/// Samples along the side of a cell. A tile remembers the farthest depth of each cell.
pub(super) const CELL: usize = 8;
/// After this many changes a cell's farthest depth is looked up again: fewer shapes seldom cover a cell.
const STALE_AFTER: u8 = 4;
/// The shift to the right of the samples in each of a pixel's four rows, in samples. An upright edge, the most frequent
/// in trees, then passes the rows one after the other and not four at once.
const LEAN: [f32; 4] = [-0.375, 0.125, -0.125, 0.375];

/// A rectangle of samples, row by row. Each row has room for some more samples at its end, which are never shown.
#[derive(Default)]
pub(super) struct ScreenTile {
    /// Samples across and down, multiples of [`CELL`].
    pub(super) size: [usize; 2],
    /// Samples across and down that there is room for.
    room: [usize; 2],
    /// The samples from one row to the next in memory.
    pub(super) stride: usize,
    /// By sample: the depth behind the target; infinite if nothing is painted.
    pub(super) depth: Vec<f32>,
    /// By sample: RGBA with red in the lowest byte.
    pub(super) colour: Vec<u32>,
    /// By cell: an upper bound of its depths.
    far: Vec<f32>,
    /// By cell: the number of changes since `far` was looked up.
    stale: Vec<u8>,
    background: u32,
    /// Whether rows are shifted by [`LEAN`], as for 4x4 samples in a pixel.
    pub(super) leans: bool,
    /// By row of cells: the first and the last sample that may have been painted; in reverse order if there is none.
    reach: Vec<[usize; 2]>,
}

impl ScreenTile {
    /// Empties the tile, with at least `size` samples across and down, and `room` for other tiles of the same picture.
    pub(super) fn reset(&mut self, size: [usize; 2], room: [usize; 2], background: [u8; 4]) {
        let background = u32::from_le_bytes(background);
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

    /// The shift to the right of a row's samples, in samples.
    #[inline]
    pub(super) fn lean(&self, row: usize) -> f32 {
        if self.leans { LEAN[row % LEAN.len()] } else { 0.0 }
    }

    /// The most that samples are shifted, in samples.
    #[inline]
    pub(super) fn slack(&self) -> f64 {
        if self.leans { f64::from(LEAN[3]) } else { 0.0 }
    }

    /// Whether all samples of a rectangle, ends included, show surfaces nearer than `near`.
    // Inlined into its long caller, the loop would keep its values in memory, not in registers.
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

    /// The part of the samples `left..=right` of a row of cells that is not behind surfaces nearer than `near`, as far
    /// by the order of cells; in reverse order if there is none. Notes that the part is about to be painted.
    pub(super) fn uncovered(&mut self, row: usize, [mut left, mut right]: [usize; 2], near: f32) -> [usize; 2] {
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

    /// Whether all samples of a cell show surfaces nearer than `near`.
    #[inline]
    fn is_hidden(&mut self, cell: usize, near: f32) -> bool {
        self.far[cell] < near || self.stale[cell] >= STALE_AFTER && self.farthest(cell) < near
    }

    /// Looks up the farthest depth of a cell.
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

    /// Notes that a rectangle, ends included, is about to be painted.
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

    /// Depths and colours of the samples of a row from `left` on, up to `right` or a few more, in groups of [`LANES`].
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

    /// The first pixel that may have been painted in a row of pixels that are `samples` wide, and the one after the
    /// last.
    pub(super) fn painted(&self, row: usize, samples: usize) -> [usize; 2] {
        let [left, right] = self.reach[row * samples / CELL];
        if left > right { [0, 0] } else { [left / samples, right / samples + 1] }
    }

    /// Writes the pixels of a row from number `from` on: the mean of each pixel's samples.
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
        if self.background >> 24 == 0 {
            self.clear_pixels(first, samples, out);
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

    /// As [`ScreenTile::pixels`], without the background: the mean colour of the painted samples, and their share as
    /// the opacity.
    fn clear_pixels(&self, first: usize, samples: usize, out: &mut [[u8; 4]]) {
        let all = (samples * samples) as u32;
        for (x, pixel) in out.iter_mut().enumerate() {
            let mut sums = [0; 4];
            for line in 0..samples {
                let from = first + line * self.stride + x * samples;
                for colour in &self.colour[from..from + samples] {
                    sums.iter_mut().zip(colour.to_le_bytes()).for_each(|(sum, channel)| *sum += u32::from(channel));
                }
            }
            let [r, g, b, opacity] = sums;
            let painted = opacity / u32::from(u8::MAX);
            let mean = |sum: u32| ((sum + painted / 2) / painted.max(1)) as u8;
            *pixel = [mean(r), mean(g), mean(b), ((opacity + all / 2) / all) as u8];
        }
    }
}

fn refill<T: Copy>(vector: &mut Vec<T>, size: usize, value: T) {
    vector.clear();
    vector.resize(size, value);
}
