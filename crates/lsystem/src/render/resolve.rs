//! From subsamples to pixels.

use super::canvas::Canvas;
use crate::Progress;
use crate::Style;

/// The finished pixels and the way to them.
#[derive(Default)]
pub(super) struct Output {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
    palette: Vec<[u32; 3]>,
    background: [u32; 3],
    /// By strip, then cell: whether the pixels there are not background.
    inked: Vec<bool>,
    /// The next cell to do.
    next: usize,
}

/// Pixels along the side of a cell.
const SIDE: usize = 16;

impl Output {
    pub(super) fn begin(&mut self, style: &Style, width: usize, height: usize) {
        let background = style.background.rgb.map(u32::from);
        if (self.width, self.height, self.background) != (width, height, background) || self.pixels.is_empty() {
            (self.width, self.height, self.background) = (width, height, background);
            let [r, g, b] = style.background.rgb;
            self.pixels.clear();
            self.pixels.reserve_exact(width * height * 4);
            self.pixels.extend([r, g, b, u8::MAX].iter().cycle().take(width * height * 4));
            self.inked.clear();
            self.inked.resize(width.div_ceil(SIDE) * height.div_ceil(SIDE), false);
        }
        self.palette.clear();
        self.palette.extend(style.palette.iter().map(|colour| colour.rgb.map(u32::from)));
        if self.palette.is_empty() {
            self.palette.push([0; 3]);
        }
        self.next = 0;
    }

    pub(super) fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// Makes pixels of the subsamples, cell by cell.
    pub(super) fn step(&mut self, frame: &Canvas, left: &mut i64) -> Progress {
        while self.next < self.inked.len() {
            if *left <= 0 {
                return Progress::More;
            }
            let touched = frame.touched.get(self.next).copied().unwrap_or_default();
            if touched || self.inked[self.next] {
                self.cell(frame, self.next);
                self.inked[self.next] = touched;
                *left -= 30;
            }
            *left -= 1;
            self.next += 1;
        }
        Progress::Done
    }

    fn cell(&mut self, frame: &Canvas, index: usize) {
        let cells = frame.cells();
        let (strip, cell) = (index / cells, index % cells);
        let size = frame.strips * frame.rows;
        let columns = strip * SIDE..(strip * SIDE + SIDE).min(self.width);
        for y in cell * SIDE..(cell * SIDE + SIDE).min(self.height) {
            let at = strip * frame.rows + y * 4;
            let covered: [u64; 4] = core::array::from_fn(|i| frame.covered[at + i]);
            let mut weights = [[0_u32; 3]; SIDE];
            let mut counts = [0_u32; SIDE];
            let mut rest = covered;
            // One colour after the other: that of the first subsample left, and all others that have it.
            while let Some(row) = rest.iter().position(|&word| word != 0) {
                let bit = rest[row].trailing_zeros();
                let mut same = rest;
                let mut ink = 0;
                for digit in 0..frame.digits {
                    let plane: [u64; 4] = core::array::from_fn(|i| frame.colours[digit * size + at + i]);
                    let one = plane[row] >> bit & 1 != 0;
                    ink |= usize::from(one) << digit;
                    for i in 0..4 {
                        same[i] &= if one { plane[i] } else { !plane[i] };
                    }
                }
                let colour = self.palette[ink.min(self.palette.len() - 1)];
                for (x, (weight, count)) in weights.iter_mut().zip(&mut counts).enumerate() {
                    let n: u32 = same.iter().map(|word| (word >> (4 * x) & 15).count_ones()).sum();
                    *count += n;
                    for channel in 0..3 {
                        weight[channel] += n * colour[channel];
                    }
                }
                for i in 0..4 {
                    rest[i] &= !same[i];
                }
            }
            for x in columns.clone() {
                let (weight, count) = (weights[x % SIDE], counts[x % SIDE]);
                let out = &mut self.pixels[(y * self.width + x) * 4..][..3];
                for channel in 0..3 {
                    out[channel] = ((weight[channel] + (16 - count) * self.background[channel] + 8) / 16) as u8;
                }
            }
        }
    }
}
