//! From sums of ink to pixels.
//!
//! The sums range over many powers of two, so a pixel shows the logarithm of its sum, relative to the other sums of the
//! picture. The exposure depends on ratios alone, so a small change of the view changes the exposure a little.

mod shade;

use super::alpha::least_opaque;
use super::grid::Grid;
use super::pigment::{Pigment, light, pigment};
use super::sheet::Sheet;
use super::smooth;
use crate::pane::{Pane, Pass};
use lsystem_base::{Meter, Progress};
use lsystem_syntax::{Colour, ColourSource, Style};
use shade::Memory;

/// The bytes of the tables of tones.
pub(crate) const TONE_BYTES: u64 = 2 << 20;
/// The number of keys. A key is the exponent of an `f32` and the first 8 bits of its fraction, so sums with the same
/// key differ by at most a 256th.
const KEYS: usize = 1 << 16;
/// The keys between a sum and its double.
const KEYS_OF_TWO: usize = KEYS >> 8;
/// The bits of an `f32` below its key.
const SHIFT: u32 = 31 - KEYS.trailing_zeros();

/// The quantiles between which the darks lie, among all sums with ink. Their mean logarithm is where ink begins to
/// count by its logarithm. A mean over a range does not jump when a gap between two sums crosses a quantile.
const DARKS: [f64; 2] = [0.1, 0.4];
/// The quantiles between which the lights lie. Their mean logarithm is exposed fully.
const LIGHTS: [f64; 2] = [0.97, 1.0];
/// The least and the most powers of two between the darks and the lights.
const RANGE: [f64; 2] = [0.25, 16.0];
/// The powers of two that a smaller range is stretched to, so that the part of a drawing in view has contrast.
const STRETCHED: f64 = 3.0;
/// The share of the lights' exposure that the first layer of ink gets, so that a single stroke beside 10^20 strokes
/// shows.
const FIRST_LAYER: f64 = 0.15;
/// The number of layers of ink that the lights show as: in a picture without contrast, and in one with much.
const LAYERS: [f64; 2] = [1.0, 1.6];

/// The mean difference of neighbouring sums, in powers of two, to which a small range is stretched at most: a picture
/// without larger shapes would show its rounding.
const ROUGHEST: f64 = 0.1;
/// Neighbours are compared inside groups of so many sums, which are the same in panes as in the whole picture.
const GROUP: usize = 16;
/// If sums only shade, about this many are counted, in rows at equal distances.
const SAMPLED: usize = 1 << 18;
/// Layers are computed for one key in so many, and interpolated for those between.
const KEYS_AT_ONCE: usize = 8;
/// The layers of ink, as powers of two, between which strokes begin to pile up.
const PILED: [f64; 2] = [1.0, 4.0];

/// Colours with more pigment than this, as the mean of all channels, become less deep where strokes pile up.
const DEEP: f32 = 0.6;

/// Steps of the tables over pigment: fine enough for the 256 levels of a channel.
const STEPS: usize = 4096;
/// The most pigment of the tables: it leaves less than a 256th of the light.
const DARKEST: f64 = 8.0;

/// The parts, 0 to 1, to which the amount of ink shades a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Shading {
    /// Where strokes pile up.
    pub piled: f64,
    /// Where single strokes lie. Without long strokes these places are the edges of piles.
    pub single: f64,
}

/// The finished pixels and the way to them.
#[derive(Default)]
pub(crate) struct Tone {
    width: usize,
    height: usize,
    grid: Grid,
    /// The first row of the pane in the picture.
    top: u32,
    paper: [u8; 3],
    /// Whether the background is left out.
    is_transparent: bool,
    exposure: f64,
    /// The parts to which the sums shade an opaque picture, instead of making one of their own.
    pub(crate) shading: Option<Shading>,
    /// The background and the palette, if colours follow the density.
    ramp: Option<Vec<[u8; 3]>>,
    pixels: Vec<u8>,
    /// By key: the number of sums.
    counts: Vec<u32>,
    /// The number of neighbours with ink, and the sum of their keys' differences.
    neighbours: [u64; 2],
    /// By key: the number of layers that a sum shows as.
    layers: Vec<f32>,
    /// By key: the part to which a sum shades.
    parts: Vec<f32>,
    /// By key: the pixel, in a picture of one ink.
    shades: Vec<[u8; 4]>,
    /// By channel, then by pigment: the level of the channel, 0 to 255.
    lights: [Vec<u8>; 3],
    /// By channel, then by level: the pigment of one layer that makes the level.
    pigments: [Vec<f32>; 3],
    /// The interpolated sums of a row.
    row: Vec<f32>,
    /// In a picture that is shaded: the sums of two rows of places by column of pixels, and the number of the first row.
    spread: ([Vec<f32>; 2], Option<usize>),
    /// In a picture that is shaded: by column, the place before and the part of the way to the next.
    columns: Vec<(u32, f32)>,
    /// Shades, by colour and key: many pixels have the same.
    memories: Vec<Memory>,
    next: usize,
    stage: Stage,
    pass: Pass,
}

/// The stage on the way to the pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    #[default]
    Counting,
    Exposing,
    Showing,
    Done,
}

/// The pixels that are made of sums.
pub(crate) struct Print<'a> {
    pub style: &'a Style,
    pub pane: Pane,
    pub pass: Pass,
    /// Whether the background is left out.
    pub is_transparent: bool,
}

/// The key of a sum.
fn key(sum: f32) -> usize {
    (sum.to_bits() >> SHIFT) as usize & (KEYS - 1)
}

/// The sum that a key stands for.
fn sum(key: usize) -> f64 {
    f64::from(f32::from_bits((key as u32) << SHIFT | 1 << (SHIFT - 1)))
}

impl Tone {
    /// Starts a pane. Returns the units of work.
    pub(crate) fn begin(&mut self, print: &Print<'_>, grid: Grid) -> u64 {
        let &Print { style, pane, pass, is_transparent } = print;
        self.is_transparent = is_transparent;
        let mut work = 1;
        let size = if pass.shows() { (pane.width as usize, pane.height as usize) } else { (0, 0) };
        if (self.width, self.height) != size {
            (self.width, self.height) = size;
            self.pixels.clear();
        }
        let bytes = if self.shading.is_some() { 0 } else { self.width * self.height * 4 };
        if self.pixels.len() != bytes {
            self.pixels.resize(bytes, u8::MAX);
            work += self.pixels.len() as u64 / 1024;
        }
        (self.grid, self.top) = (grid, pane.y);
        self.spread.1 = None;
        self.columns.clear();
        if self.shading.is_some() {
            self.columns.extend((pane.x..pane.x + self.width as u32).map(|column| grid.before(column)));
        }
        self.exposure = libm::exp2(style.exposure.clamp(-10.0, 10.0));
        let entries = || (0..style.palette.len()).map(|index| style.entry(index));
        self.ramp = (style.colour_by.source() == ColourSource::Ink)
            .then(|| core::iter::once(style.background).chain(entries()).map(|colour| colour.rgb).collect());
        let paper = style.background.rgb;
        if paper != self.paper || self.lights[0].is_empty() {
            self.paper = paper;
            work += 3 * STEPS as u64;
            self.pigments = [0, 1, 2].map(|channel| {
                let of = |level| pigment(Colour { rgb: [level; 3] }, style.background)[channel];
                (0..=u8::MAX).map(of).collect()
            });
            self.lights = paper.map(|paper| {
                let pigment = |step: usize| (step as f64 / (STEPS - 1) as f64 * 2.0 - 1.0) * DARKEST;
                (0..STEPS).map(|step| libm::round(255.0 * light(paper, pigment(step))) as u8).collect()
            });
        }
        if matches!(pass, Pass::Only | Pass::Survey) {
            self.counts.clear();
            self.counts.resize(KEYS, 0);
            self.neighbours = [0; 2];
        }
        self.next = 0;
        self.pass = pass;
        self.stage = match pass {
            Pass::Only | Pass::Count => Stage::Counting,
            Pass::Survey => Stage::Done,
            Pass::Show => Stage::Exposing,
        };
        work
    }

    pub(crate) fn pixels(&self) -> &[u8] {
        &self.pixels
    }

    /// Goes on towards the pixels, or shades those of an opaque picture; `pigment` is used in a picture of one ink.
    pub(crate) fn step(
        &mut self,
        sums: &Sheet,
        pigment: Pigment,
        mut below: Option<&mut [u8]>,
        meter: &mut Meter,
    ) -> Progress {
        while !meter.is_spent() {
            match self.stage {
                Stage::Counting if self.next < sums.height => {
                    self.count(sums, self.next);
                    meter.charge(1 + sums.reach.get(self.next).map_or(0, |reach| reach.len() as u64 / 16));
                    // For shades a sample is enough.
                    let rows = if self.shading.is_some() { sums.numbers() / SAMPLED } else { 1 };
                    self.next += rows.max(1);
                }
                Stage::Counting => {
                    self.stage = if self.pass == Pass::Count { Stage::Done } else { Stage::Exposing };
                }
                Stage::Exposing => {
                    // A stroke as wide as a pixel covers only a part of a place larger than a pixel.
                    let unit = f64::from(self.grid.side) / sums.layer();
                    let keys = self.expose(sums.planes, pigment, unit);
                    meter.charge((KEYS / 8 + keys) as u64);
                    (self.stage, self.next) = (Stage::Showing, 0);
                }
                Stage::Showing if self.next < self.height => {
                    match &mut below {
                        Some(pixels) => self.shade(sums, self.next, pixels),
                        None => self.show(sums, self.next),
                    }
                    self.next += 1;
                    // A coarse picture interpolates four sums for each pixel.
                    let is_coarse = self.grid.side > 1 && self.shading.is_none();
                    meter.charge(1 + (self.width * sums.planes * if is_coarse { 4 } else { 1 }) as u64 / 16);
                }
                Stage::Showing | Stage::Done => return Progress::Done,
            }
        }
        Progress::More
    }

    fn count(&mut self, sums: &Sheet, row: usize) {
        let reach = &sums.reach[row];
        let at = row * sums.width;
        let values = &sums.values[(at + reach.start as usize) * sums.planes..(at + reach.end as usize) * sums.planes];
        let mut last = 0;
        for (&value, column) in values.iter().step_by(sums.planes).zip(reach.start as usize..) {
            let key = key(value);
            self.counts[key] += 1;
            if key > 0 && last > 0 && !column.is_multiple_of(GROUP) {
                self.neighbours[0] += 1;
                self.neighbours[1] += key.abs_diff(last) as u64;
            }
            last = key;
        }
    }

    /// The mean logarithm to the base 2 of the sums between two quantiles (0 to 1) of all sums other than 0. Each
    /// logarithm counts as at least `least`.
    fn level(&self, parts: [f64; 2], least: f64) -> f64 {
        let all: u64 = self.counts.iter().skip(1).map(|&count| u64::from(count)).sum();
        let [low, high] = parts.map(|part| part * all as f64);
        let (mut before, mut mean) = (0.0, 0.0);
        for (key, &count) in self.counts.iter().enumerate().skip(1).filter(|(_, count)| **count > 0) {
            let after = before + f64::from(count);
            let within = after.min(high) - f64::max(before, low);
            if within > 0.0 {
                mean += within / (high - low) * libm::log2(sum(key)).max(least);
            }
            before = after;
        }
        mean
    }

    /// Makes the tables of layers and shades; a sum of 1 is `unit` layers of ink. Returns the number of keys.
    fn expose(&mut self, planes: usize, pigment: Pigment, unit: f64) -> usize {
        let lights = self.level(LIGHTS, f64::NEG_INFINITY);
        let darks = self.level(DARKS, lights - RANGE[1]);
        // An even picture has the middle of the tones.
        let missing = (RANGE[0] - (lights - darks)).max(0.0) / 2.0;
        let (lights, darks) = (lights + missing, darks - missing);
        let [neighbours, differences] = self.neighbours.map(|sum| sum as f64);
        let most = ROUGHEST * KEYS_OF_TWO as f64 * neighbours / differences.max(1.0);
        let stretch = (STRETCHED / (lights - darks)).min(most).max(1.0);
        let contrast = (stretch * (lights - darks) / STRETCHED).min(1.0);
        let most_layers = LAYERS[0] + (LAYERS[1] - LAYERS[0]) * contrast;
        let over_darks = |log: f64| libm::log2(1.0 + libm::exp2(stretch * (log - darks)));
        let full = over_darks(lights);
        self.layers.clear();
        self.layers.resize(KEYS, 0.0);
        self.shades.clear();
        self.shades.resize(KEYS, self.pixel(self.paper));
        self.forget_shades();
        self.parts.clear();
        self.parts.resize(KEYS, 0.0);
        let Shading { piled, single } = self.shading.unwrap_or_default();
        let first = self.counts.iter().skip(1).position(|&count| count > 0).map_or(KEYS, |key| key + 1);
        let last = self.counts.iter().rposition(|&count| count > 0).unwrap_or(0);
        // If places are larger than pixels, interpolation makes sums down to a ninth of the least.
        let first = if self.grid.side > 1 { first.saturating_sub(4 * KEYS_OF_TWO).max(1) } else { first };
        let at = |key: usize| {
            let sum = sum(key);
            let log = libm::log2(sum);
            let first = (sum * unit).min(1.0);
            let shown = self.exposure * (FIRST_LAYER * first + (1.0 - FIRST_LAYER) * over_darks(log) / full);
            [shown, single + (piled - single) * smooth(PILED, log + libm::log2(unit))]
        };
        let (mut before, mut after) = ([0.0; 2], at(first.min(last)));
        for key in first..=last {
            let step = (key - first) % KEYS_AT_ONCE;
            if step == 0 {
                (before, after) = (after, at((key + KEYS_AT_ONCE).min(KEYS - 1)));
            }
            let way = step as f64 / KEYS_AT_ONCE as f64;
            let [shown, part] = [0, 1].map(|i| before[i] + way * (after[i] - before[i]));
            let layers = most_layers * shown;
            (self.layers[key], self.parts[key]) = (layers as f32, part as f32);
            // Several inks, and the colours of an opaque picture, are shaded pixel by pixel.
            if planes > 1 || self.shading.is_some() && self.ramp.is_none() {
                continue;
            }
            let colour = match &self.ramp {
                Some(ramp) => ramp_colour(ramp, shown),
                None => [0, 1, 2].map(|channel| self.light(channel, pigment[channel] * layers as f32)),
            };
            let [r, g, b] = colour;
            self.shades[key] = if self.shading.is_some() { [r, g, b, u8::MAX] } else { self.pixel(colour) };
        }
        if self.shading.is_some() && first <= last {
            // Rows that are not counted may have smaller and larger sums.
            for table in [&mut self.layers, &mut self.parts] {
                let ends = [table[first], table[last]];
                table[1..first].fill(ends[0]);
                table[last + 1..].fill(ends[1]);
            }
            let ends = [self.shades[first], self.shades[last]];
            self.shades[1..first].fill(ends[0]);
            self.shades[last + 1..].fill(ends[1]);
        }
        (last + 1).saturating_sub(first)
    }

    /// The pixel that shows this colour.
    #[inline]
    fn pixel(&self, colour: [u8; 3]) -> [u8; 4] {
        let [r, g, b] = colour;
        if self.is_transparent { least_opaque(colour, self.paper, 0) } else { [r, g, b, u8::MAX] }
    }

    #[inline]
    fn light(&self, channel: usize, pigment: f32) -> u8 {
        let step = (pigment / DARKEST as f32 + 1.0) * (0.5 * (STEPS - 1) as f32) + 0.5;
        self.lights[channel][(step as usize).min(STEPS - 1)]
    }

    fn show(&mut self, sums: &Sheet, y: usize) {
        let mut pixels = core::mem::take(&mut self.pixels);
        let (out, _) = pixels[y * self.width * 4..(y + 1) * self.width * 4].as_chunks_mut::<4>();
        let blank = self.pixel(self.paper);
        if self.grid.side == 1 {
            let reach = sums.reach[y].start as usize..sums.reach[y].end as usize;
            out[..reach.start].fill(blank);
            out[reach.end..].fill(blank);
            let at = y * sums.width;
            let values = &sums.values[(at + reach.start) * sums.planes..(at + reach.end) * sums.planes];
            self.colour(values, sums.planes, &mut out[reach]);
        } else {
            let mut row = core::mem::take(&mut self.row);
            self.interpolate(sums, y, &mut row);
            self.colour(&row, sums.planes, out);
            self.row = row;
        }
        self.pixels = pixels;
    }

    fn colour(&self, values: &[f32], planes: usize, out: &mut [[u8; 4]]) {
        if planes == 1 {
            for (pixel, &value) in out.iter_mut().zip(values) {
                *pixel = self.shades[key(value)];
            }
            return;
        }
        for (pixel, values) in out.iter_mut().zip(values.chunks_exact(4)) {
            let shown = self.layers[key(values[0])];
            let part = if values[0] > 0.0 { shown / values[0] } else { 0.0 };
            *pixel = self.pixel([0, 1, 2].map(|channel| self.light(channel, values[1 + channel] * part)));
        }
    }

    /// Interpolates a row of sums, one for each pixel, between those of larger places.
    fn interpolate(&self, sums: &Sheet, y: usize, out: &mut Vec<f32>) {
        out.clear();
        let near = |pixel: usize, end: usize| {
            let at = (pixel as f32 + 0.5) / self.grid.side as f32 - 0.5;
            let first = at.max(0.0) as usize;
            (first.min(end - 1), (first + 1).min(end - 1), (at - first as f32).clamp(0.0, 1.0))
        };
        let (above, below, down) = near(y, sums.height);
        for x in 0..self.width {
            let (left, right, across) = near(x, sums.width);
            for plane in 0..sums.planes {
                let value = |row: usize, column: usize| sums.values[(row * sums.width + column) * sums.planes + plane];
                let upper = value(above, left) + across * (value(above, right) - value(above, left));
                let lower = value(below, left) + across * (value(below, right) - value(below, left));
                out.push(upper + down * (lower - upper));
            }
        }
    }
}

/// The colour at a place on a ramp, from 0 to 1.
fn ramp_colour(ramp: &[[u8; 3]], place: f64) -> [u8; 3] {
    let place = place.clamp(0.0, 1.0) * (ramp.len() - 1) as f64;
    let from = (place as usize).min(ramp.len().saturating_sub(2));
    let part = place - from as f64;
    let [a, b] = [from, from + 1].map(|at| ramp.get(at).copied().unwrap_or_default());
    [0, 1, 2].map(|i| libm::round(f64::from(a[i]) * (1.0 - part) + f64::from(b[i]) * part) as u8)
}
