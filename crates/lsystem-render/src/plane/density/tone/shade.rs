//! Shades an opaque picture by the sums of ink of the whole picture, whose places are larger than pixels.

use super::{DEEP, Tone, key};
use crate::plane::alpha::least_opaque;
use crate::plane::density::sheet::Sheet;

/// The number of shades that are remembered.
const MEMORIES: usize = 1 << 13;

/// A pixel, the key of its sum, and its shade.
pub(super) type Memory = ([u8; 4], u32, [u8; 4]);

impl Tone {
    /// Forgets the shades of other tables.
    pub(super) fn forget_shades(&mut self) {
        self.memories.clear();
        self.memories.resize(MEMORIES, ([0; 4], u32::MAX, [0; 4]));
    }

    /// Shades a row of the pane's opaque picture. Pixels of the background stay.
    pub(super) fn shade(&mut self, sums: &Sheet, y: usize, pixels: &mut [u8]) {
        let (above, down) = self.grid.before(self.top + y as u32);
        let (above, width) = (above as usize, sums.width);
        let row = pixels.get_mut(y * self.width * 4..(y + 1) * self.width * 4).unwrap_or_default();
        let Some([upper, lower]) = sums.reach.get(above..).and_then(<[_]>::first_chunk) else { return };
        let (first, end) = match (upper.is_empty(), lower.is_empty()) {
            (true, true) => return,
            (false, true) => (upper.start, upper.end),
            (true, false) => (lower.start, lower.end),
            (false, false) => (upper.start.min(lower.start), upper.end.max(lower.end)),
        };
        let (upper, lower) = sums.values[above * width..(above + 2) * width].split_at(width);
        let reach = first as usize..end as usize;
        self.row.clear();
        self.row.resize(width, 0.0);
        for ((value, upper), lower) in self.row[reach.clone()].iter_mut().zip(&upper[reach.clone()]).zip(&lower[reach])
        {
            *value = upper + down * (lower - upper);
        }
        let starts = self.columns.partition_point(|&(before, _)| before + 1 < first);
        let ends = self.columns.partition_point(|&(before, _)| before < end);
        self.shade_by(row.as_chunks_mut().0.get_mut(starts..ends).unwrap_or_default(), starts);
    }

    /// Shades the pixels from column `first` on by the row of sums.
    fn shade_by(&mut self, pixels: &mut [[u8; 4]], first: usize) {
        let [r, g, b] = self.paper;
        let background = if self.is_transparent { [0; 4] } else { [r, g, b, u8::MAX] };
        let mut memories = core::mem::take(&mut self.memories);
        for (pixel, &(before, across)) in pixels.iter_mut().zip(&self.columns[first..]) {
            if *pixel == background {
                continue;
            }
            let Some([left, right]) = self.row.get(before as usize..).and_then(<[_]>::first_chunk) else { continue };
            let key = key(left + across * (right - left));
            // Pixels of one colour have places of their own for all keys in use, as those are neighbours.
            let colour = u32::from_le_bytes(*pixel).wrapping_mul(0x9e37_79b9) >> 19;
            let memory = &mut memories[(key + colour as usize) % MEMORIES];
            if (memory.0, memory.1) != (*pixel, key as u32) {
                *memory = (*pixel, key as u32, self.shaded(*pixel, key));
            }
            *pixel = memory.2;
        }
        self.memories = memories;
    }

    /// The pixel of an opaque picture, shaded.
    fn shaded(&self, pixel: [u8; 4], key: usize) -> [u8; 4] {
        let part = self.parts[key];
        if part == 0.0 {
            return pixel;
        }
        let between = |from: u8, to: u8, part: f32| {
            let [from, to] = [from, to].map(f32::from);
            (from + part * (to - from) + 0.5) as u8
        };
        let opacity = f32::from(pixel[3]) / 255.0;
        let colour = [0, 1, 2].map(|channel| between(self.paper[channel], pixel[channel], opacity));
        let shaded = if self.ramp.is_some() {
            [0, 1, 2].map(|channel| between(colour[channel], self.shades[key][channel], part))
        } else {
            let pigment = [0, 1, 2].map(|channel| self.pigments[channel][usize::from(colour[channel])]);
            let mut more = self.layers[key] - 1.0;
            if more > 0.0 {
                let mean = pigment.iter().map(|pigment| pigment.abs()).sum::<f32>() / 3.0;
                more *= (DEEP / mean).min(1.0);
            }
            [0, 1, 2].map(|channel| self.light(channel, pigment[channel] * (1.0 + part * more)))
        };
        let [r, g, b] = shaded;
        if self.is_transparent { least_opaque(shaded, self.paper, pixel[3]) } else { [r, g, b, u8::MAX] }
    }
}
