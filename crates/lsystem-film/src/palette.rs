//! The colours of a GIF: at most 255, and one for pixels that stay.

use crate::Script;
use color_quant::NeuQuant;
use lsystem_base::sorted;
use std::collections::HashMap;

/// The most colours of a palette. A GIF has one more, for pixels that stay.
const MAX: usize = 255;
/// In a film with more colours, the most frequent ones that are kept as they are, so that flat areas stay exact.
const KEPT: usize = 64;
/// The most colours that are counted. The next ones are near to these.
const MAX_COUNTED: usize = 1 << 16;
/// The network looks at each of its samples, the best quality.
const SAMPLING: i32 = 1;
/// Entries of the cache of nearest colours, a power of two.
const CACHE: usize = 1 << 12;

/// A colour: red, green and blue.
pub(crate) type Rgb = [u8; 3];

/// The frames whose colours make the palette of a film.
const SAMPLES: u32 = 12;
/// The longer side of these frames, in pixels. Smaller pictures have the same colours.
const SAMPLE_SIDE: u32 = 640;

/// The numbers of the frames whose colours make the palette of a film, spread over its time, and their size in pixels.
#[must_use]
pub fn palette_samples(script: &Script) -> (Vec<u32>, [u32; 2]) {
    let count = script.frames().min(SAMPLES);
    let last = u64::from(script.frames() - 1);
    let spread = |at: u32| (u64::from(at) * last / u64::from(count.max(2) - 1)) as u32;
    let longer = script.size[0].max(script.size[1]);
    let size = script.size.map(|side| if longer > SAMPLE_SIDE { (side * SAMPLE_SIDE / longer).max(1) } else { side });
    ((0..count).map(spread).collect(), size)
}

/// Makes the palette of a film from some of its frames.
#[derive(Default)]
pub struct PaletteMaker {
    counts: HashMap<Rgb, u64>,
}

impl PaletteMaker {
    /// Counts the colours of a frame: RGBA, 8 bits each.
    pub fn add(&mut self, pixels: &[u8]) {
        for_runs(pixels, |colour, count| {
            let is_full = self.counts.len() >= MAX_COUNTED;
            match self.counts.get_mut(&colour) {
                Some(sum) => *sum += count,
                None if is_full => {}
                None => {
                    self.counts.insert(colour, count);
                }
            }
        });
    }

    /// The palette: all colours if they fit, or else the most frequent ones and the best mixtures of the rest.
    #[must_use]
    pub fn finish(self) -> Palette {
        let mut counts: Vec<(Rgb, u64)> = self.counts.into_iter().collect();
        sorted::sort_by_key(&mut counts, |&(colour, count)| (core::cmp::Reverse(count), colour));
        if counts.len() <= MAX {
            return Palette::new(counts.into_iter().map(|(colour, _)| colour).collect());
        }
        let mut colours: Vec<Rgb> = counts[..KEPT].iter().map(|&(colour, _)| colour).collect();
        // Frequent colours count for more, but rare ones are not lost.
        let weight = |count: u64| 1 + count.ilog2() as usize;
        let samples =
            counts[KEPT..].iter().flat_map(|&([r, g, b], count)| core::iter::repeat_n([r, g, b, 255], weight(count)));
        let samples: Vec<u8> = samples.flatten().collect();
        let network = NeuQuant::new(SAMPLING, MAX - KEPT, &samples);
        colours.extend(network.color_map_rgb().as_chunks::<3>().0);
        Palette::new(colours)
    }
}

/// The colours of a film.
#[derive(Clone, Debug)]
pub struct Palette {
    /// At most [`MAX`] colours, each once.
    colours: Vec<Rgb>,
    places: HashMap<Rgb, u8>,
}

/// A frame as places in a palette.
#[derive(Clone, Debug)]
pub struct IndexedFrame {
    /// The colours of this frame alone, if they are others than the film's.
    pub(crate) own: Option<Vec<Rgb>>,
    /// For each pixel, from the upper left corner row by row, the place of its colour.
    pub(crate) places: Vec<u8>,
}

impl Palette {
    fn new(colours: Vec<Rgb>) -> Self {
        let mut palette = Self { colours: Vec::new(), places: HashMap::new() };
        for colour in colours.into_iter().take(MAX) {
            let place = palette.colours.len() as u8;
            if let std::collections::hash_map::Entry::Vacant(entry) = palette.places.entry(colour) {
                entry.insert(place);
                palette.colours.push(colour);
            }
        }
        palette
    }

    pub(crate) fn colours(&self) -> &[Rgb] {
        &self.colours
    }

    /// The frame in this palette, or in a palette of its own where that is exact and this one is not.
    #[must_use]
    pub fn index(&self, pixels: &[u8]) -> IndexedFrame {
        let mut places = Vec::with_capacity(pixels.len() / 4);
        let mut is_exact = true;
        let mut cache: Vec<Option<(Rgb, u8)>> = vec![None; CACHE];
        for_runs(pixels, |colour, count| {
            let slot = &mut cache[slot_of(colour)];
            let place = match *slot {
                Some((known, place)) if known == colour => place,
                _ => {
                    let place = self.places.get(&colour).copied().unwrap_or_else(|| {
                        is_exact = false;
                        self.nearest(colour)
                    });
                    *slot = Some((colour, place));
                    place
                }
            };
            places.extend(core::iter::repeat_n(place, count as usize));
        });
        if !is_exact && let Some(own) = Self::exact(pixels) {
            return IndexedFrame { own: Some(own.colours.clone()), ..own.index(pixels) };
        }
        IndexedFrame { own: None, places }
    }

    /// The palette with all colours of a frame, if they fit.
    fn exact(pixels: &[u8]) -> Option<Self> {
        let mut maker = PaletteMaker::default();
        // Most frames with too many colours have them in their first rows.
        for part in pixels.chunks(1 << 16) {
            maker.add(part);
            if maker.counts.len() > MAX {
                return None;
            }
        }
        Some(maker.finish())
    }

    /// The place of the nearest colour.
    fn nearest(&self, [r, g, b]: Rgb) -> u8 {
        let distance = |&[or, og, ob]: &Rgb| {
            let [r, g, b] = [r.abs_diff(or), g.abs_diff(og), b.abs_diff(ob)].map(u32::from);
            // The eye sees differences of green best and of blue least (the weights of luma, as whole numbers).
            3 * r * r + 6 * g * g + b * b
        };
        let nearest = self.colours.iter().enumerate().min_by_key(|(_, colour)| distance(colour));
        nearest.map_or(0, |(place, _)| place as u8)
    }
}

/// The cache's slot of a colour.
fn slot_of([r, g, b]: Rgb) -> usize {
    let number = u32::from_be_bytes([0, r, g, b]);
    (number.wrapping_mul(0x9e37_79b1) >> 20) as usize & (CACHE - 1)
}

/// Calls `each` for the runs of equal pixels.
fn for_runs(pixels: &[u8], mut each: impl FnMut(Rgb, u64)) {
    let pixels = pixels.as_chunks::<4>().0;
    for run in pixels.chunk_by(|a, b| a[..3] == b[..3]) {
        if let [[r, g, b, _], ..] = *run {
            each([r, g, b], run.len() as u64);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixels(colours: impl Iterator<Item = Rgb>) -> Vec<u8> {
        colours.flat_map(|[r, g, b]| [r, g, b, 255]).collect()
    }

    fn shown(palette: &Palette, sheet: &IndexedFrame) -> Vec<Rgb> {
        let colours = sheet.own.as_deref().unwrap_or(palette.colours());
        sheet.places.iter().map(|&place| colours[usize::from(place)]).collect()
    }

    #[test]
    fn few_colours_are_exact() {
        let few: Vec<Rgb> = (0..255).map(|i| [i as u8, 0, 255]).collect();
        let mut maker = PaletteMaker::default();
        maker.add(&pixels(few.iter().copied()));
        let palette = maker.finish();
        let sheet = palette.index(&pixels(few.iter().copied()));
        assert!(sheet.own.is_none() && shown(&palette, &sheet) == few);
        let others: Vec<Rgb> = (0..200).map(|i| [3, i as u8, 77]).collect();
        let sheet = palette.index(&pixels(others.iter().copied()));
        assert!(sheet.own.is_some() && shown(&palette, &sheet) == others);
    }

    #[test]
    fn many_colours_are_near() {
        let many = || (0..64_000_u32).map(|i| [(i % 40) as u8 * 6, (i / 40 % 40) as u8 * 6, (i / 1600) as u8 * 6]);
        let flat = core::iter::repeat_n([251, 250, 245], 50_000);
        let frame: Vec<Rgb> = many().chain(flat).collect();
        let mut maker = PaletteMaker::default();
        maker.add(&pixels(frame.iter().copied()));
        let palette = maker.finish();
        assert!(palette.colours().len() <= MAX);
        let sheet = palette.index(&pixels(frame.iter().copied()));
        let near = |(a, b): (&Rgb, &Rgb)| (0..3).map(|i| u32::from(a[i].abs_diff(b[i]))).sum::<u32>();
        let found = shown(&palette, &sheet);
        // Flat areas are exact. 191 colours in a cube of colours are about 40 apart each way.
        assert!(found[64_000..].iter().all(|&colour| colour == [251, 250, 245]));
        let mean = found.iter().zip(&frame).map(near).sum::<u32>() / 64_000;
        assert!(mean < 40, "{mean}");
    }
}
