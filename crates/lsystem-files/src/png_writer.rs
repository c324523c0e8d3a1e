//! PNG pictures of any size, painted band by band while the file is written, so that memory does not grow with the picture.

use super::Writer;
use super::embed::KEYWORD;
use super::sheet::INCH;
use core::cell::RefCell;
use lsystem_drawing::Figure;
use lsystem_render::{FigureRenderer, Painted, PictureOptions, Quality, Vantage, Viewport};
use lsystem_syntax::{Diagnostic, LimitName, Progress, Style};
use std::io;
use std::io::Write;
use std::rc::Rc;

/// Pixels that are encoded in a unit of work.
const PIXELS_PER_UNIT: u64 = 4;

/// The size and the content of a PNG file.
#[derive(Clone, Debug, PartialEq)]
pub struct PngOptions {
    /// The size: at most [`MAX_PICTURE_SIDE`](lsystem_syntax::MAX_PICTURE_SIDE) pixels each way.
    pub viewport: Viewport,
    /// Pixels of an inch on paper; none if the file tells no resolution.
    pub dpi: Option<f64>,
    /// Whether the background is left out, as by [`FigureRenderer::transparent`].
    pub is_transparent: bool,
    /// The system as a text of [`write_json`](crate::write_json), stored in the file for [`read_file`](crate::read_file);
    /// empty for none.
    pub system: String,
    /// If given, only the first `upto` segments are shown.
    pub upto: Option<u128>,
    /// The most pixels that are painted at a time, as [`PictureOptions::band`].
    pub band: u32,
}

impl Default for PngOptions {
    /// 1024 x 1024 pixels, opaque, in bands of 4 Mi pixels (100 MB).
    fn default() -> Self {
        Self {
            viewport: Viewport { width: 1024, height: 1024, ratio: 1.0 },
            dpi: None,
            is_transparent: false,
            system: String::new(),
            upto: None,
            band: 1 << 22,
        }
    }
}

/// Writes a picture as PNG in steps.
pub struct PngWriter {
    painter: Box<FigureRenderer>,
    /// The encoder, until the file is complete. It writes to `encoded`.
    encoder: Option<png::StreamWriter<'static, Encoded>>,
    encoded: Encoded,
    width: usize,
    height: u32,
    /// The rows encoded so far.
    rows: u32,
    is_transparent: bool,
    /// The number of painted rows that are encoded; none while pixels are being painted.
    row: Option<usize>,
    /// A row of the file.
    bytes: Vec<u8>,
}

impl PngWriter {
    /// The writer for a figure, seen from a vantage.
    ///
    /// # Errors
    /// [`LimitName::Memory`] if the machine cannot count the picture's bytes: on 32 bits, 32,768 x 32,768 transparent
    /// pixels.
    pub fn new(figure: &Figure, style: Style, vantage: Vantage, options: &PngOptions) -> Result<Self, Diagnostic> {
        let viewport = size_of(options);
        let mut painter = Box::new(FigureRenderer::new());
        if options.is_transparent {
            *painter = painter.transparent();
        }
        painter.load(figure);
        let &PngOptions { upto, band, .. } = options;
        painter.begin(PictureOptions { style, viewport, vantage, upto, quality: Quality::BEST, band });
        let Viewport { width, height, .. } = viewport;
        let channels = if options.is_transparent { 4 } else { 3 };
        // The encoder counts the bytes of the picture, and one more for each row.
        let bytes = (u64::from(width) * channels + 1) * u64::from(height);
        if usize::try_from(bytes).is_err() {
            return Err(Diagnostic::limit(LimitName::Memory, usize::MAX as u64, None));
        }
        let encoded = Encoded::default();
        let mut encoder = png::Encoder::new(encoded.clone(), width, height);
        encoder.set_color(if options.is_transparent { png::ColorType::Rgba } else { png::ColorType::Rgb });
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_pixel_dims(options.dpi.map(resolution));
        let text = match options.system.as_str() {
            "" => Ok(()),
            system => encoder.add_itxt_chunk(KEYWORD.to_owned(), system.to_owned()),
        };
        let encoder = text.and_then(|()| encoder.write_header()).and_then(png::Writer::into_stream_writer);
        Ok(Self {
            painter,
            encoder: Some(encoder.map_err(|_| too_large())?),
            encoded,
            width: width as usize,
            height,
            rows: 0,
            is_transparent: options.is_transparent,
            row: None,
            bytes: Vec::new(),
        })
    }

    /// The height of the picture.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The rows written so far, of [`PngWriter::height`].
    #[must_use]
    pub fn rows(&self) -> u32 {
        self.rows
    }

    /// Encodes a painted row.
    fn encode(&mut self, row: usize) -> io::Result<()> {
        let length = 4 * self.width;
        let Some(pixels) = self.painter.pixels().get(row * length..(row + 1) * length) else { return Ok(()) };
        let Some(encoder) = &mut self.encoder else { return Ok(()) };
        if self.is_transparent {
            return encoder.write_all(pixels);
        }
        self.bytes.clear();
        self.bytes.extend(pixels.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
        encoder.write_all(&self.bytes)
    }

    /// Goes on until the file is complete or the work is done.
    fn go_on(&mut self, work: u64) -> io::Result<Progress> {
        let mut left = work;
        while self.encoder.is_some() {
            let Some(row) = self.row else {
                let before = self.painter.spent();
                let painted = self.painter.step(left);
                left = left.saturating_sub(self.painter.spent() - before);
                match painted {
                    Painted::Nothing => {}
                    Painted::Rows => self.row = Some(0),
                    Painted::All => {
                        return self
                            .encoder
                            .take()
                            .map_or(Ok(()), png::StreamWriter::finish)
                            .map_or_else(|error| Err(io::Error::other(error)), |()| Ok(Progress::Done));
                    }
                }
                if left == 0 {
                    return Ok(Progress::More);
                }
                continue;
            };
            if (row + 1) * 4 * self.width > self.painter.pixels().len() {
                self.row = None;
                continue;
            }
            self.encode(row)?;
            self.row = Some(row + 1);
            self.rows += 1;
            left = left.saturating_sub(1 + self.width as u64 / PIXELS_PER_UNIT);
            if left == 0 {
                return Ok(Progress::More);
            }
        }
        Ok(Progress::Done)
    }
}

impl Writer for PngWriter {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        let progress = self.go_on(work).map_err(|_| too_large());
        file.append(&mut self.encoded.0.borrow_mut());
        progress
    }
}

/// The encoder fails only where numbers of the file do not fit its fields: a text of 2 GB.
fn too_large() -> Diagnostic {
    Diagnostic::limit(LimitName::Text, u64::from(u32::MAX / 2), None)
}

/// The size of the picture: at least one pixel.
fn size_of(options: &PngOptions) -> Viewport {
    let Viewport { width, height, ratio } = options.viewport.within_sides();
    Viewport { width: width.max(1), height: height.max(1), ratio }
}

/// The resolution as the file tells it: pixels of a metre (PNG specification, section 11.3.4.3).
fn resolution(dpi: f64) -> png::PixelDimensions {
    let per_metre = libm::round(dpi * 1000.0 / INCH).clamp(1.0, f64::from(i32::MAX)) as u32;
    png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter }
}

/// The bytes that the encoder has written and nobody has taken yet.
#[derive(Clone, Default)]
struct Encoded(Rc<RefCell<Vec<u8>>>);

impl Write for Encoded {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
