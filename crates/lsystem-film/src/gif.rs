//! Animated GIF (CompuServe, GIF89a, 1990), frame by frame.

use crate::palette::Rgb;
use crate::{Ending, IndexedFrame, Palette};
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::borrow::Cow;

/// Writes an animated GIF. Each frame holds the pixels that have changed since the frame before. The bytes are taken as
/// they come, so that the file is never in memory.
pub struct GifWriter {
    encoder: Encoder<Vec<u8>>,
    size: [u16; 2],
    palette: Palette,
    /// The colours of the last frame; empty before the first.
    before: Vec<Rgb>,
}

/// An upright rectangle of pixels.
#[derive(Clone, Copy)]
struct Area {
    left: usize,
    top: usize,
    width: usize,
    height: usize,
}

impl GifWriter {
    /// Begins a file of frames of this size.
    ///
    /// # Errors
    /// A side over 65,535 pixels.
    pub fn new([width, height]: [u32; 2], ending: Ending, palette: Palette) -> Result<Self, EncodingError> {
        let size = [width, height].map(|side| u16::try_from(side).unwrap_or(u16::MAX));
        let mut encoder = Encoder::new(Vec::new(), size[0], size[1], &table(palette.colours()))?;
        if ending != Ending::Once {
            encoder.set_repeat(Repeat::Infinite)?;
        }
        Ok(Self { encoder, size, palette, before: Vec::new() })
    }

    /// Adds a frame that is shown for `delay` hundredths of a second; none for 0.
    ///
    /// # Errors
    /// A frame of another size.
    pub fn add(&mut self, frame: &IndexedFrame, delay: u16) -> Result<(), EncodingError> {
        let [width, height] = self.size.map(usize::from);
        if frame.places.len() != width * height {
            return Err(EncodingError::FrameBufferTooSmallForDimensions);
        }
        if delay == 0 {
            return Ok(());
        }
        let colours = frame.own.as_deref().unwrap_or(self.palette.colours());
        let area = self.changed(frame, colours);
        // The place behind the last colour stands for pixels that stay.
        let stays = colours.len() as u8;
        let mut buffer = Vec::with_capacity(area.width * area.height);
        let is_first = self.before.is_empty();
        if is_first {
            self.before = vec![[0; 3]; width * height];
        }
        for y in area.top..area.top + area.height {
            let row = y * width + area.left..y * width + area.left + area.width;
            for (before, &place) in self.before[row.clone()].iter_mut().zip(&frame.places[row]) {
                let colour = colours.get(usize::from(place)).copied().unwrap_or_default();
                buffer.push(if !is_first && *before == colour { stays } else { place });
                *before = colour;
            }
        }
        self.encoder.write_frame(&Frame {
            delay,
            dispose: DisposalMethod::Keep,
            transparent: Some(stays),
            left: area.left as u16,
            top: area.top as u16,
            width: area.width as u16,
            height: area.height as u16,
            palette: frame.own.as_deref().map(table),
            buffer: Cow::Owned(buffer),
            ..Frame::default()
        })
    }

    /// The area with all changed pixels; one pixel if none has changed.
    fn changed(&self, frame: &IndexedFrame, colours: &[Rgb]) -> Area {
        let [width, height] = self.size.map(usize::from);
        if self.before.is_empty() {
            return Area { left: 0, top: 0, width, height };
        }
        let mut low = [width, height];
        let mut high = [0, 0];
        for (y, (places, before)) in frame.places.chunks(width).zip(self.before.chunks(width)).enumerate() {
            let differs = |(place, before): (&u8, &Rgb)| colours.get(usize::from(*place)) != Some(before);
            let Some(first) = places.iter().zip(before).position(differs) else { continue };
            let last = places.iter().zip(before).rposition(differs).unwrap_or(first);
            low = [low[0].min(first), low[1].min(y)];
            high = [high[0].max(last + 1), y + 1];
        }
        if high[1] == 0 {
            return Area { left: 0, top: 0, width: 1, height: 1 };
        }
        Area { left: low[0], top: low[1], width: high[0] - low[0], height: high[1] - low[1] }
    }

    /// The bytes since the last call.
    pub fn take(&mut self) -> Vec<u8> {
        core::mem::take(self.encoder.get_mut())
    }

    /// Ends the file, and returns its last bytes.
    ///
    /// # Errors
    /// None in practice: the bytes go to memory.
    pub fn finish(self) -> Result<Vec<u8>, EncodingError> {
        self.encoder.into_inner()
    }
}

/// A table of colours, with one more for pixels that stay.
fn table(colours: &[Rgb]) -> Vec<u8> {
    colours.iter().chain([&[0; 3]]).flatten().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PaletteMaker;

    /// Frames of a square that moves, changes its colour and stays.
    fn frames() -> Vec<Vec<u8>> {
        let frame = |step: usize| {
            let colour = |x: usize, y: usize| {
                let inside = x.abs_diff(10 + 3 * step.min(4)) < 5 && y.abs_diff(12) < 6;
                if inside { [step as u8 * 20, (x * 3 + y) as u8, 90] } else { [251, 250, 245] }
            };
            let pixel = |at: usize| colour(at % 40, at / 40);
            (0..40 * 30)
                .flat_map(|at| {
                    let [r, g, b] = pixel(at);
                    [r, g, b, 255]
                })
                .collect()
        };
        [0, 1, 2, 3, 4, 4, 5].map(frame).into()
    }

    #[test]
    fn decoded_frames_are_those_that_were_written() {
        let frames = frames();
        for sampled in [1, 7] {
            let mut maker = PaletteMaker::default();
            frames[..sampled].iter().for_each(|frame| maker.add(frame));
            let palette = maker.finish();
            let mut writer = GifWriter::new([40, 30], Ending::Repeat, palette.clone()).unwrap();
            let mut file = Vec::new();
            for frame in &frames {
                writer.add(&palette.index(frame), 4).unwrap();
                file.extend(writer.take());
            }
            file.extend(writer.finish().unwrap());

            let mut options = gif::DecodeOptions::new();
            options.set_color_output(gif::ColorOutput::RGBA);
            let mut decoder = options.read_info(&file[..]).unwrap();
            assert_eq!(decoder.repeat(), Repeat::Infinite);
            let mut canvas = vec![0; 4 * 40 * 30];
            let mut number = 0;
            while let Some(frame) = decoder.read_next_frame().unwrap() {
                assert_eq!(frame.delay, 4);
                for (at, pixel) in frame.buffer.chunks(4).enumerate() {
                    let width = usize::from(frame.width);
                    let (x, y) = (usize::from(frame.left) + at % width, usize::from(frame.top) + at / width);
                    if pixel[3] == 255 {
                        canvas[4 * (y * 40 + x)..][..4].copy_from_slice(pixel);
                    }
                }
                assert!(canvas == frames[number], "{sampled} {number}");
                number += 1;
            }
            assert_eq!(number, frames.len());
        }
    }

    #[test]
    fn wrong_sizes_are_refused() {
        let palette = PaletteMaker::default().finish();
        let mut writer = GifWriter::new([4, 4], Ending::Once, palette.clone()).unwrap();
        assert!(writer.add(&palette.index(&[0; 16]), 4).is_err());
    }
}
