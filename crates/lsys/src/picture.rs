//! Pictures as PNG, by the core's renderer: any generation whose drawing memoises, at any size.

use crate::cli::Size;
use crate::progress::Progress as Bar;
use lsystem::files::tag_png;
use lsystem::render::{Pass, Quality};
use lsystem::{Camera, Drawing, Progress, Renderer, Solid, SolidRenderer, Style, View, Viewport, fit};
use std::io::Write;
use std::sync::Arc;

/// The longer side where no size is asked for, and the one at which a stroke's least width is in pixels.
const USUAL: u32 = 1024;
/// The shorter side of a picture of a long thin drawing.
const LEAST: u32 = 128;
/// The renderer's units of work between two looks at the clock.
const WORK: usize = 1_000_000;
/// The most pixels that are painted at a time: with their subsamples they take up to 24 bytes each, or 100 MB.
const BAND: u32 = 1 << 22;
/// Pixels along the side of a cell: panes that begin at multiples of it have the same subsamples.
const CELL: u32 = 16;

/// `drawing`, whole and centred, in a file that carries its `system`. Strokes are as thin, compared with the picture,
/// as at the usual size.
///
/// # Errors
/// Those of the encoder, which writes to memory.
pub(crate) fn png(
    drawing: Drawing,
    style: &Style,
    size: Option<Size>,
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

/// Whether a picture in the plane would be painted in bands.
pub(crate) fn is_large(Size { width, height }: Size) -> bool {
    width.saturating_mul(height) > BAND
}

/// Rows of a picture that are made at a time: all of an ordinary one, and otherwise whole cells of the renderer.
fn band_rows(size: Size) -> u32 {
    let rows = BAND / size.width.max(1) / CELL * CELL;
    if is_large(size) { rows.max(CELL) } else { size.height }
}

/// As [`png()`], of a drawing in space, seen from where the page looks at it first.
///
/// # Errors
/// Those of the encoder, which writes to memory.
pub(crate) fn solid_png(
    drawing: Drawing<Solid>,
    style: &Style,
    size: Option<Size>,
    system: &str,
) -> Result<Vec<u8>, png::EncodingError> {
    let size = size.unwrap_or(Size { width: USUAL, height: USUAL });
    let mut renderer = SolidRenderer::new();
    renderer.load(Arc::new(drawing));
    renderer.begin(style, viewport(size), &Camera::default(), Quality::BEST);
    finish(|| renderer.step(WORK));
    encode(size, system, |write| write(renderer.pixels()))
}

fn viewport(Size { width, height }: Size) -> Viewport {
    Viewport { width, height, ratio: (f64::from(width.max(height)) / f64::from(USUAL)).max(1.0) }
}

/// Takes all steps of a picture, and tells of them.
fn finish(mut step: impl FnMut() -> Progress) {
    let mut bar = Bar::new("picture", None);
    while step() == Progress::More {
        bar.at(0);
    }
}

/// A file that carries its `system`, of opaque RGBA pixels that `paint` writes row by row, any number of rows at a time.
fn encode(
    Size { width, height }: Size,
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
        // The renderer's pixels are opaque.
        for row in pixels.chunks(4 * width.max(1) as usize) {
            rgb.clear();
            rgb.extend(row.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]));
            rows.write_all(&rgb)?;
        }
        Ok(())
    })?;
    rows.finish()?;
    writer.finish()?;
    Ok(tag_png(&bytes, system).unwrap_or(bytes))
}

/// A size in the proportions of the drawing.
fn usual_size(drawing: &Drawing) -> Size {
    let extent = fit(drawing);
    let longer = extent.width.max(extent.height);
    let side = |length: f64| {
        let share = length / longer;
        // Beyond the range of f64 the proportions are not known.
        if share.is_finite() { ((share * f64::from(USUAL)).round() as u32).clamp(LEAST, USUAL) } else { USUAL }
    };
    Size { width: side(extent.width), height: side(extent.height) }
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
        let viewport = viewport(Size { width: 300, height: 200 });
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
        assert_eq!(band_rows(Size { width: 2048, height: 2048 }), 2048);
        for (width, height) in [(4096, 4096), (10_000, 10_000), (32_768, 3_000), (300, 32_768)] {
            let rows = band_rows(Size { width, height });
            assert!(rows.is_multiple_of(CELL) && rows > 0 && rows * width <= BAND, "{width} {height} {rows}");
        }
    }
}
