//! From subsamples to pixels.

use super::bit_words::GROUP;
use super::{Canvas, Group};
use crate::plane::opaque_picture::Plan;
use crate::viewport::Detail;
use core::ops::Range;
use lsystem_base::{Meter, Progress};

/// The finished pixels and the way to them.
#[derive(Default)]
pub(in crate::plane) struct Output {
    width: usize,
    height: usize,
    pixels: Vec<u8>,
    palette: Vec<[u32; 3]>,
    background: [u32; 3],
    /// Whether the background is left out, so that the alpha of pixels is their covered part.
    is_transparent: bool,
    /// The pixel, by palette entry, then by the number of its subsamples with that entry (0 to 16).
    shades: Vec<[[u8; 4]; 32]>,
    /// By cell, then strip: whether some pixels there may not be background.
    inked: Vec<bool>,
    detail: Detail,
    /// The next cell to do.
    next: usize,
}

/// Bytes that are cleared in a unit of work.
const BYTES_PER_UNIT: usize = 1024;
/// Pixels along the side of a cell, in fine detail.
const SIDE: usize = 16;

impl Output {
    /// Starts a pane of a picture; `inks` are the palette entries of its colours, by number. Returns the units of work.
    pub(in crate::plane) fn begin(&mut self, plan: &Plan, inks: &[u32]) -> u64 {
        let Plan { style, pane, pass, detail, is_transparent, .. } = plan;
        let (detail, is_transparent) = (*detail, *is_transparent);
        let mut work = inks.len() as u64;
        let (width, height) = if pass.shows() { (pane.width as usize, pane.height as usize) } else { (0, 0) };
        let background = style.background.rgb.map(u32::from);
        let ground = (background, is_transparent);
        let known = (self.width, self.height, self.detail) == (width, height, detail)
            && (self.background, self.is_transparent) == ground;
        if !known || self.pixels.is_empty() {
            (self.width, self.height, self.detail) = (width, height, detail);
            (self.background, self.is_transparent) = ground;
            let [r, g, b] = style.background.rgb;
            self.pixels.clear();
            self.pixels.resize(width * height * 4, if is_transparent { 0 } else { u8::MAX });
            if style.background.rgb != [u8::MAX; 3] && !is_transparent {
                self.pixels.as_chunks_mut().0.fill([r, g, b, u8::MAX]);
            }
            self.inked.clear();
            let side = 4 * SIDE / detail.samples();
            self.inked.resize(width.div_ceil(side) * height.div_ceil(side), false);
            work += (self.pixels.len() / BYTES_PER_UNIT) as u64;
        }
        self.palette.clear();
        self.palette.extend(inks.iter().map(|&ink| style.ink(ink).rgb.map(u32::from)));
        if self.palette.is_empty() {
            self.palette.push([0; 3]);
        }
        self.shades.clear();
        self.shades.extend(self.palette.iter().map(|colour| {
            core::array::from_fn(|count| {
                let count = (count as u32).min(16);
                if is_transparent {
                    return clear_pixel(colour.map(|channel| channel * count), count);
                }
                let mix = |c: usize| ((colour[c] * count + background[c] * (16 - count) + 8) / 16) as u8;
                [mix(0), mix(1), mix(2), u8::MAX]
            })
        }));
        self.next = 0;
        work
    }

    pub(in crate::plane) fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// The pixels, to be shaded. Those of the background must stay: only cells with strokes are made anew.
    pub(in crate::plane) fn pixels_mut(&mut self) -> &mut [u8] {
        &mut self.pixels
    }

    /// Turns subsamples into pixels, cell by cell from side to side. From top to bottom each row of pixels would be in
    /// another page of memory, and the processor keeps the addresses of few pages: that takes several times as long.
    pub(in crate::plane) fn step(&mut self, frame: &Canvas, meter: &mut Meter) -> Progress {
        while self.next < self.inked.len() {
            if meter.is_spent() {
                return Progress::More;
            }
            let (cell, strip) = (self.next / frame.strips.max(1), self.next % frame.strips.max(1));
            let touched = strip < frame.strips && cell < frame.cells && frame.is_touched(strip, cell);
            if touched || self.inked[self.next] {
                meter.charge(self.cell(frame, strip, cell));
                self.inked[self.next] = touched;
            }
            meter.charge(1);
            self.next += 1;
        }
        Progress::Done
    }

    /// Turns a cell into pixels. Returns the units of work.
    fn cell(&mut self, frame: &Canvas, strip: usize, cell: usize) -> u64 {
        let samples = self.detail.samples();
        let side = u64::BITS as usize / samples;
        let left = strip * side;
        let right = (left + side).min(self.width);
        let mut work = 0;
        for group in frame.groups(cell) {
            let rows = GROUP / samples;
            let rows = group * rows..(group * rows + rows).min(self.height);
            let plain = match frame.group(strip, group) {
                Group::Bare => self.shades[0][0],
                Group::Plain(ink) => self.shades[usize::from(ink).min(self.palette.len() - 1)][16],
                Group::Mixed => {
                    work += 4;
                    for y in rows {
                        let at = strip * frame.rows + y * samples;
                        let pixels = y * self.width + left..y * self.width + right;
                        match self.detail {
                            Detail::Fine => self.row(frame, at, pixels),
                            Detail::Coarse | Detail::Sketch => self.coarse_row(frame, at, pixels),
                        }
                    }
                    continue;
                }
            };
            for y in rows {
                let out = &mut self.pixels[(y * self.width + left) * 4..(y * self.width + right) * 4];
                out.as_chunks_mut().0.fill(plain);
            }
        }
        work
    }

    /// Turns the four words from `at` on into a row of pixels.
    fn row(&mut self, frame: &Canvas, at: usize, pixels: Range<usize>) {
        let covered = rows(&frame.covered, at);
        let (out, _) = self.pixels[pixels.start * 4..pixels.end * 4].as_chunks_mut::<4>();
        if any(covered) == 0 {
            out.fill(self.shades[0][0]);
            return;
        }
        let planes = || planes(frame, at);
        let (ink, same) = first_ink(planes(), covered);
        let ink = ink.min(self.palette.len() - 1);
        if same == [u64::MAX; 4] {
            out.fill(self.shades[ink][16]);
        } else if same == covered {
            let counts = counts(same);
            let shades = &self.shades[ink];
            let (mut even, mut odd) = (counts.even, counts.odd);
            for pair in out.chunks_mut(2) {
                pair[0] = shades[(even & 31) as usize];
                if let [_, second] = pair {
                    *second = shades[(odd & 31) as usize];
                }
                (even, odd) = (even >> 8, odd >> 8);
            }
        } else if self.is_transparent {
            self.clear_mixed(planes, covered, pixels);
        } else {
            self.mixed(planes, covered, pixels);
        }
    }

    /// Turns a word into a row of pixels with one subsample each.
    fn coarse_row(&mut self, frame: &Canvas, at: usize, pixels: Range<usize>) {
        let (out, _) = self.pixels[pixels.start * 4..pixels.end * 4].as_chunks_mut::<4>();
        let covered = frame.covered[at];
        let pixels = out.iter_mut().enumerate();
        let bare = self.shades[0][0];
        // Most words have one colour.
        let digits = || frame.colour_planes().map(|plane| plane[at] & covered).enumerate();
        if digits().all(|(_, word)| word == 0 || word == covered) {
            let ink: usize = digits().map(|(digit, word)| usize::from(word != 0) << digit).sum();
            let full = self.shades[ink.min(self.palette.len() - 1)][16];
            pixels.for_each(|(x, pixel)| *pixel = if covered >> x & 1 == 0 { bare } else { full });
            return;
        }
        for (x, pixel) in pixels {
            let ink: usize = digits().map(|(digit, word)| ((word >> x & 1) as usize) << digit).sum();
            *pixel = if covered >> x & 1 == 0 { bare } else { self.shades[ink.min(self.palette.len() - 1)][16] };
        }
    }

    /// Turns four words with several colours into a row of pixels.
    fn mixed<'a, I: Iterator<Item = &'a [u64; 4]>>(
        &mut self,
        planes: impl Fn() -> I,
        covered: [u64; 4],
        pixels: Range<usize>,
    ) {
        const BYTES: u64 = 0x00ff_00ff_00ff_00ff;
        // By pixel modulo 4, then by channel: sums of four pixels in sixteenths, at most 16 * 255, in 16 bits each.
        let mut sums = [[0x0008_0008_0008_0008_u64; 3]; 4];
        let mut add = |words: [u64; 4], colour: [u32; 3]| {
            let Counts { even, odd } = counts(words);
            let counts = [even, odd, even >> 8, odd >> 8].map(|counts| counts & BYTES);
            for (sums, counts) in sums.iter_mut().zip(counts) {
                for (sum, channel) in sums.iter_mut().zip(colour) {
                    *sum += counts * u64::from(channel);
                }
            }
        };
        let bare = covered.map(|word| !word);
        if any(bare) != 0 {
            add(bare, self.background);
        }
        let mut rest = covered;
        while any(rest) != 0 {
            let (ink, same) = first_ink(planes(), rest);
            add(same, self.palette[ink.min(self.palette.len() - 1)]);
            rest = [0, 1, 2, 3].map(|row| rest[row] & !same[row]);
        }
        let halves = sums.map(|[r, g, b]| {
            let [r, g, b] = [r, g, b].map(|sum| sum >> 4 & BYTES);
            [r | g << 8, b | BYTES << 8]
        });
        let (out, _) = self.pixels[pixels.start * 4..pixels.end * 4].as_chunks_mut::<4>();
        for (x, pixel) in out.iter_mut().enumerate().take(SIDE) {
            let [low, high] = halves[x % 4].map(|half| (half >> (x / 4 * 16)) as u16);
            *pixel = (u32::from(low) | u32::from(high) << 16).to_le_bytes();
        }
    }

    /// As [`Output::mixed`], without the background.
    fn clear_mixed<'a, I: Iterator<Item = &'a [u64; 4]>>(
        &mut self,
        planes: impl Fn() -> I,
        covered: [u64; 4],
        pixels: Range<usize>,
    ) {
        let mut sums = [([0_u32; 3], 0_u32); SIDE];
        let mut rest = covered;
        while any(rest) != 0 {
            let (ink, same) = first_ink(planes(), rest);
            let colour = self.palette[ink.min(self.palette.len() - 1)];
            for (x, (sum, all)) in sums.iter_mut().enumerate() {
                let count: u32 = same.iter().map(|word| (word >> (4 * x) & 15).count_ones()).sum();
                (0..3).for_each(|channel| sum[channel] += count * colour[channel]);
                *all += count;
            }
            rest = [0, 1, 2, 3].map(|row| rest[row] & !same[row]);
        }
        let (out, _) = self.pixels[pixels.start * 4..pixels.end * 4].as_chunks_mut::<4>();
        for (pixel, (sum, count)) in out.iter_mut().zip(sums) {
            *pixel = clear_pixel(sum, count);
        }
    }
}

/// A pixel without background, of which `count` subsamples are covered; `sums` are those of their channels. The colour
/// is their mean and the opacity their share, so that the pixel over any background is the mean of all 16 subsamples.
fn clear_pixel(sums: [u32; 3], count: u32) -> [u8; 4] {
    if count == 0 {
        return [0; 4];
    }
    let [r, g, b] = sums.map(|sum| ((sum + count / 2) / count) as u8);
    [r, g, b, ((count * 255 + 8) / 16) as u8]
}

/// The four words of a row of pixels.
#[inline(always)]
fn rows(words: &[u64], at: usize) -> [u64; 4] {
    words[at..].first_chunk().copied().unwrap_or_default()
}

/// The four words of each plane of colours from `at` on, by reference: copying all takes longer than looking at some.
#[inline(always)]
fn planes(frame: &Canvas, at: usize) -> impl Iterator<Item = &[u64; 4]> {
    frame.colour_planes().filter_map(move |plane| plane[at..].first_chunk())
}

/// The columns in which any word has a bit.
#[inline(always)]
fn any([a, b, c, d]: [u64; 4]) -> u64 {
    a | b | c | d
}

/// The ink of the leftmost subsample of `rest`, and all subsamples of `rest` with the same ink; `planes` are those of a
/// row of pixels.
#[inline(always)]
fn first_ink<'a>(planes: impl Iterator<Item = &'a [u64; 4]>, rest: [u64; 4]) -> (usize, [u64; 4]) {
    let bit = any(rest).trailing_zeros() & 63;
    // The row of that subsample, without a branch, which the processor could not predict.
    let [a, b, c, _] = rest.map(|word| !(word >> bit) as usize & 1);
    let row = a * (1 + b * (1 + c));
    let (mut ink, mut same) = (0, rest);
    for (digit, plane) in planes.enumerate() {
        let one = plane[row] >> bit & 1;
        ink |= (one as usize) << digit;
        // All ones where the digit is 0, so that equal digits give ones.
        let flip = one.wrapping_sub(1);
        for (same, plane) in same.iter_mut().zip(plane) {
            *same &= plane ^ flip;
        }
    }
    (ink, same)
}

/// The number of set subsamples in each of 16 pixels, a byte each; pixels at even and odd places are apart.
struct Counts {
    even: u64,
    odd: u64,
}

fn counts(words: [u64; 4]) -> Counts {
    const PAIRS: u64 = 0x5555_5555_5555_5555;
    const FOURS: u64 = 0x3333_3333_3333_3333;
    const BYTES: u64 = 0x0f0f_0f0f_0f0f_0f0f;
    let mut sum = Counts { even: 0, odd: 0 };
    for word in words {
        let pairs = word - (word >> 1 & PAIRS);
        let fours = (pairs & FOURS) + (pairs >> 2 & FOURS);
        sum.even += fours & BYTES;
        sum.odd += fours >> 4 & BYTES;
    }
    sum
}
