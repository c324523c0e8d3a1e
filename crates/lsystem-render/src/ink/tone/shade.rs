//! Shades an opaque picture by the sums of ink of the whole picture, whose places may be larger than pixels.

use super::{DEEP, KEYS, Tone, key};
use crate::ink::alpha::least_opaque;
use crate::ink::sheet::Sheet;

/// The number of neighbours that are shaded at a time if they are alike.
const ALIKE: usize = 16;

/// A pixel and its shade. A place of the memory belongs to one key for each pixel.
pub(crate) type Memory = ([u8; 4], [u8; 4]);

/// The first place of a pixel's shades in the memory. Neighbouring keys have neighbouring places.
fn place(pixel: [u8; 4]) -> usize {
    (u32::from_le_bytes(pixel).wrapping_mul(0x9e37_79b9) >> 16) as usize
}

impl Tone {
    /// Forgets the shades of other tables. No pixel without opacity has another colour than 0.
    pub(crate) fn forget_shades(&mut self) {
        self.memories.clear();
        self.memories.resize(KEYS, ([u8::MAX, 0, 0, 0], [0; 4]));
    }

    /// Shades a row of the pane's opaque picture. Pixels of the background stay.
    pub(crate) fn shade(&mut self, sums: &Sheet, y: usize, pixels: &mut [u8]) {
        let (above, down) = self.grid.before(self.top + y as u32);
        let above = above as usize;
        let row = pixels.get_mut(y * self.width * 4..(y + 1) * self.width * 4).unwrap_or_default();
        let Some([upper, lower]) = sums.reach.get(above..).and_then(<[_]>::first_chunk) else { return };
        let (first, end) = match (upper.is_empty(), lower.is_empty() || down == 0.0) {
            (true, true) => return,
            (false, true) => (upper.start, upper.end),
            (true, false) => (lower.start, lower.end),
            (false, false) => (upper.start.min(lower.start), upper.end.max(lower.end)),
        };
        let starts = self.columns.partition_point(|&(before, _)| before + 1 < first);
        let ends = self.columns.partition_point(|&(before, _)| before < end);
        let pixels = row.as_chunks_mut().0.get_mut(starts..ends).unwrap_or_default();
        if self.grid.side == 1 {
            let first = self.columns.get(starts).map_or(0, |&(before, _)| before as usize);
            let row = &sums.values[above * sums.width + first..(above + 1) * sums.width];
            return self.shade_by(pixels, [row; 2], 0.0);
        }
        let (mut rows, last) = core::mem::take(&mut self.spread);
        if last != Some(above) {
            rows.swap(0, 1);
            if last.is_none_or(|last| last + 1 != above) {
                self.spread_row(sums, above, &mut rows[0]);
            }
            self.spread_row(sums, above + 1, &mut rows[1]);
        }
        let both = rows.each_ref().map(|row| row.get(starts..ends).unwrap_or_default());
        self.shade_by(pixels, both, down);
        self.spread = (rows, Some(above));
    }

    /// Interpolates the sums of a row of places, one for each column of pixels.
    fn spread_row(&self, sums: &Sheet, row: usize, out: &mut Vec<f32>) {
        out.clear();
        let values = &sums.values[row * sums.width..(row + 1) * sums.width];
        out.extend(self.columns.iter().map(|&(before, across)| {
            let pair = values.get(before as usize..).and_then(<[_]>::first_chunk);
            pair.map_or(0.0, |[left, right]| left + across * (right - left))
        }));
    }

    /// Shades pixels by their sums, which lie between those of two rows, at a part of the way `down`.
    fn shade_by(&mut self, pixels: &mut [[u8; 4]], [upper, lower]: [&[f32]; 2], down: f32) {
        let [r, g, b] = self.paper;
        let background = if self.is_transparent { [0; 4] } else { [r, g, b, u8::MAX] };
        let mut memories = core::mem::take(&mut self.memories);
        let Some(places) = memories.first_chunk_mut::<KEYS>() else { return };
        let rows = upper.chunks(ALIKE).zip(lower.chunks(ALIKE));
        for (pixels, (upper, lower)) in pixels.chunks_mut(ALIKE).zip(rows) {
            // Most pixels are like their neighbours.
            let first = pixels[0];
            let differ = |pixel: &[u8; 4]| u32::from_le_bytes(*pixel) ^ u32::from_le_bytes(first);
            let is_even = pixels.iter().fold(0, |all, pixel| all | differ(pixel)) == 0;
            if is_even && first == background {
                continue;
            }
            let mut keys = [0; ALIKE];
            for (place, (upper, lower)) in keys.iter_mut().zip(upper.iter().zip(lower)) {
                *place = key(upper + down * (lower - upper));
            }
            let start = place(first);
            if is_even {
                pixels
                    .iter_mut()
                    .zip(keys)
                    .for_each(|(pixel, key)| *pixel = self.remembered(places, first, start, key));
            } else {
                for (pixel, key) in pixels.iter_mut().zip(keys).filter(|(pixel, _)| **pixel != background) {
                    *pixel = self.remembered(places, *pixel, place(*pixel), key);
                }
            }
        }
        self.memories = memories;
    }

    /// The shade of a pixel whose places in the memory begin at `start`.
    #[inline(always)]
    fn remembered(&self, memories: &mut [Memory; KEYS], pixel: [u8; 4], start: usize, key: usize) -> [u8; 4] {
        let memory = &mut memories[(key + start) % KEYS];
        if memory.0 != pixel {
            *memory = (pixel, self.shaded(pixel, key));
        }
        memory.1
    }

    /// The pixel of an opaque picture, shaded.
    #[inline(never)]
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
