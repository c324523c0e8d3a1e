//! PNG pictures of any size, painted band by band while the file is written, so that memory does not grow with the
//! picture.

use super::Sink;
use super::png::KEYWORD;
use core::cell::RefCell;
use lsystem_base::LimitName;
use lsystem_drawing::Figure;
use lsystem_plot::INCH;
use lsystem_render::{FigureRenderer, Painted, PictureOptions, Quality, Vantage, Viewport};
use lsystem_syntax::{Diagnostic, Halt, Style, Work};
use std::io;
use std::io::Write;
use std::rc::Rc;

/// Pixels that are encoded in a unit of work.
const PIXELS_PER_UNIT: u64 = 4;
/// The units of work of a step of the renderer.
const WORK: u64 = 1 << 14;

/// The size and the content of a PNG file.
#[derive(Clone, Debug, PartialEq)]
pub struct PngOptions {
    /// The size: at most [`MAX_PICTURE_SIDE`](lsystem_base::MAX_PICTURE_SIDE) pixels each way.
    pub viewport: Viewport,
    /// Pixels of an inch on paper; `None` for a file without resolution.
    pub dpi: Option<f64>,
    /// Whether the background is left out, as by [`FigureRenderer::transparent`].
    pub is_transparent: bool,
    /// The system as a text of [`write_json`](crate::write_json), stored in the file for
    /// [`read_file`](crate::read_file); empty for none.
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

/// Writes a picture of a figure, seen from a vantage, as PNG.
///
/// # Errors
/// [`LimitName::Memory`] if the machine cannot count the picture's bytes: on 32 bits, 32,768 x 32,768 transparent
/// pixels.
pub fn write_png(
    figure: &Figure,
    style: &Style,
    vantage: Vantage,
    options: &PngOptions,
    sink: &mut Sink<'_>,
) -> Result<(), Halt> {
    let viewport = size_of(options);
    let mut painter = FigureRenderer::new();
    if options.is_transparent {
        painter = painter.transparent();
    }
    painter.load(figure);
    let (style, &PngOptions { upto, band, .. }) = (style.clone(), options);
    painter.begin(PictureOptions { style, viewport, vantage, upto, quality: Quality::BEST, band });
    let Viewport { width, height, .. } = viewport;
    let channels = if options.is_transparent { 4 } else { 3 };
    // The encoder counts the bytes of the picture, and one more for each row.
    let bytes = (u64::from(width) * channels + 1) * u64::from(height);
    if usize::try_from(bytes).is_err() {
        return Err(Diagnostic::limit(LimitName::Memory, usize::MAX as u64, None).into());
    }
    let encoded = Encoded::default();
    let mut encoder = encoder(viewport, options, encoded.clone()).map_err(|_| too_large())?;
    let (mut rows, mut bytes) = (0, vec![]);
    loop {
        let before = painter.spent();
        let painted = painter.step(WORK);
        sink.charge(painter.spent() - before)?;
        sink.rows(rows, height);
        match painted {
            Painted::Nothing => {}
            Painted::Rows => {
                for row in painter.pixels().chunks_exact(4 * width as usize) {
                    sink.charge(1 + u64::from(width) / PIXELS_PER_UNIT)?;
                    let row = if options.is_transparent {
                        row
                    } else {
                        bytes.clear();
                        bytes.extend(row.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
                        &bytes
                    };
                    encoder.write_all(row).map_err(|_| too_large())?;
                    rows += 1;
                    sink.rows(rows, height);
                    encoded.hand_on(sink)?;
                }
            }
            Painted::All => {
                encoder.finish().map_err(|_| too_large())?;
                return encoded.hand_on(sink);
            }
        }
    }
}

/// The encoder of a picture, which writes to `encoded`.
fn encoder(
    Viewport { width, height, .. }: Viewport,
    options: &PngOptions,
    encoded: Encoded,
) -> Result<png::StreamWriter<'static, Encoded>, png::EncodingError> {
    let mut encoder = png::Encoder::new(encoded, width, height);
    encoder.set_color(if options.is_transparent { png::ColorType::Rgba } else { png::ColorType::Rgb });
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_pixel_dims(options.dpi.map(resolution));
    if !options.system.is_empty() {
        encoder.add_itxt_chunk(KEYWORD.to_owned(), options.system.clone())?;
    }
    encoder.write_header()?.into_stream_writer()
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

/// The resolution in the unit of the file: pixels of a metre (PNG specification, section 11.3.4.3).
fn resolution(dpi: f64) -> png::PixelDimensions {
    let per_metre = libm::round(dpi * 1000.0 / INCH).clamp(1.0, f64::from(i32::MAX)) as u32;
    png::PixelDimensions { xppu: per_metre, yppu: per_metre, unit: png::Unit::Meter }
}

/// The bytes that the encoder has written and nobody has taken yet.
#[derive(Clone, Default)]
struct Encoded(Rc<RefCell<Vec<u8>>>);

impl Encoded {
    fn hand_on(&self, sink: &mut Sink<'_>) -> Result<(), Halt> {
        let bytes = self.0.take();
        if bytes.is_empty() { Ok(()) } else { sink.bytes(&bytes) }
    }
}

impl Write for Encoded {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
