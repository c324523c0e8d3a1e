//! PNG pictures, painted by the core's renderers.
use crate::cli::PictureSize;
use crate::progress::DelayedBar;
use lsystem::files::tag_png;
use lsystem::render::{Pass, Quality};
use lsystem::{Camera, Drawing, Progress, Renderer, Solid, SolidRenderer, Style, View, Viewport, fit};
use std::io::Write;
use std::sync::Arc;

/// The default length of the longer side, in pixels. At this length a stroke's least width is in pixels; larger
/// pictures scale it.
const USUAL: u32 = 1024;
/// The least default length of the shorter side, in pixels.
const LEAST: u32 = 128;
/// The renderer's units of work between two updates of the progress bar.
const WORK: usize = 1_000_000;
/// The most pixels of a band. A pixel with subsamples takes up to 24 bytes, so a band takes up to 100 MB.
const BAND: u32 = 1 << 22;
/// The side of a cell, in pixels. Panes that begin at multiples of this have the same subsamples as the whole picture.
const CELL: u32 = 16;

/// A PNG of the whole drawing, centred, with its `system` inside.
///
/// # Errors
/// Errors of the encoder, which writes to memory.
pub(crate) fn png(
    drawing: Drawing,
    style: &Style,
    size: Option<PictureSize>,
    system: &str,
) -> Result<Vec<u8>, png::EncodingError> {
    let size = size.unwrap_or_else(|| usual_size(&drawing));
    let viewport = viewport(size);
    let drawing = Arc::new(drawing);
    let mut renderer = Renderer::new();
    renderer.load(drawing);
    encode(size, system, |write| {
        for (band, pass) in Pass::all(style.ink, viewport, [size.width, band_rows(size)]) {
            renderer.begin_pane(style, viewport, View::default(), None, (band, pass));
            finish(|| renderer.step(WORK));
            if pass.shows() {
                write(renderer.pixels())?;
            }
        }
        Ok(())
    })
}

/// Whether a picture in the plane is painted in bands.
pub(crate) fn is_large(PictureSize { width, height }: PictureSize) -> bool {
    width.saturating_mul(height) > BAND
}

/// The number of rows of a band: all rows, or for a large picture a multiple of [`CELL`].
fn band_rows(size: PictureSize) -> u32 {
    let rows = BAND / size.width.max(1) / CELL * CELL;
    if is_large(size) { rows.max(CELL) } else { size.height }
}

/// As [`png()`], of a drawing in space, from the page's first camera.
///
/// # Errors
/// Errors of the encoder, which writes to memory.
pub(crate) fn solid_png(
    drawing: Drawing<Solid>,
    style: &Style,
    size: Option<PictureSize>,
    system: &str,
) -> Result<Vec<u8>, png::EncodingError> {
    let size = size.unwrap_or(PictureSize { width: USUAL, height: USUAL });
    let mut renderer = SolidRenderer::new();
    renderer.load(Arc::new(drawing));
    renderer.begin(style, viewport(size), &Camera::default(), Quality::BEST);
    finish(|| renderer.step(WORK));
    encode(size, system, |write| write(renderer.pixels()))
}

fn viewport(PictureSize { width, height }: PictureSize) -> Viewport {
    Viewport { width, height, ratio: (f64::from(width.max(height)) / f64::from(USUAL)).max(1.0) }
}

/// Runs all steps of a picture, with a progress bar.
fn finish(mut step: impl FnMut() -> Progress) {
    let mut bar = DelayedBar::new("picture", None);
    while step() == Progress::More {
        bar.at(0);
    }
}

/// A PNG file with its `system` inside, unless that is empty. `paint` writes opaque RGBA pixels from top to bottom, any number of whole rows
/// at a time.
fn encode(
    PictureSize { width, height }: PictureSize,
    system: &str,
    paint: impl FnOnce(&mut dyn FnMut(&[u8]) -> Result<(), png::EncodingError>) -> Result<(), png::EncodingError>,
) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    let mut rows = writer.stream_writer()?;
    let mut rgb = Vec::new();
    paint(&mut |pixels| {
        // The pixels are opaque, so the file needs no alpha channel.
        for row in pixels.chunks(4 * width.max(1) as usize) {
            rgb.clear();
            rgb.extend(row.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
            rows.write_all(&rgb)?;
        }
        Ok(())
    })?;
    rows.finish()?;
    writer.finish()?;
    if system.is_empty() {
        return Ok(bytes);
    }
    Ok(tag_png(&bytes, system).unwrap_or(bytes))
}

/// The default size, in the proportions of the drawing.
fn usual_size(drawing: &Drawing) -> PictureSize {
    let extent = fit(drawing);
    let longer = extent.width.max(extent.height);
    let side = |length: f64| {
        let share = length / longer;
        // The proportions are unknown if the extent is beyond the range of `f64`.
        if share.is_finite() { ((share * f64::from(USUAL)).round() as u32).clamp(LEAST, USUAL) } else { USUAL }
    };
    PictureSize { width: side(extent.width), height: side(extent.height) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem::{Definition, Limits, System, draw};

    #[test]
    fn pictures_in_bands_are_those_of_the_whole() {
        let definition = Definition {
            axiom: "X".into(),
            rules: "X -> F-[[X]+X]+F[+FX]-X\nF -> FF".into(),
            angle: 22.5,
            ..Definition::default()
        };
        let drawing = Arc::new(draw(&System::new(&definition).0.unwrap(), 5, &Limits::default()).unwrap());
        let viewport = viewport(PictureSize { width: 300, height: 200 });
        let mut renderer = Renderer::new();
        renderer.load(drawing);
        renderer.begin(&definition.style, viewport, View::default());
        finish(|| renderer.step(WORK));
        let whole = renderer.pixels().to_vec();
        let mut banded = vec![];
        for (band, pass) in Pass::all(definition.style.ink, viewport, [300, 3 * CELL]) {
            renderer.begin_pane(&definition.style, viewport, View::default(), None, (band, pass));
            finish(|| renderer.step(WORK));
            if pass.shows() {
                banded.extend_from_slice(renderer.pixels());
            }
        }
        let differ = whole.iter().zip(&banded).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert!(whole.len() == banded.len() && differ * 1000 < whole.len(), "{differ}");
    }

    #[test]
    fn bands_are_small_and_whole_cells_high() {
        assert_eq!(band_rows(PictureSize { width: 2048, height: 2048 }), 2048);
        for (width, height) in [(4096, 4096), (10_000, 10_000), (32_768, 3_000), (300, 32_768)] {
            let rows = band_rows(PictureSize { width, height });
            assert!(rows.is_multiple_of(CELL) && rows > 0 && rows * width <= BAND, "{width} {height} {rows}");
        }
    }
}
