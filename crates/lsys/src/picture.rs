//! Pictures as PNG, by the core's renderer: any generation whose drawing memoises, at any size.

use crate::args::Size;
use crate::progress::Progress as Bar;
use lsystem::{
    Camera, DensityRenderer, Drawing, Ink, PlaneRenderer, Progress, Quality, Renderer, Solid, SolidRenderer, Style,
    View, Viewport, fit, tag_png,
};
use std::sync::Arc;

/// The longer side where no size is asked for, and the one at which a stroke's least width is in pixels.
const USUAL: u32 = 1024;
/// The shorter side of a picture of a long thin drawing.
const LEAST: u32 = 128;
/// The renderer's units of work between two looks at the clock.
const WORK: usize = 1_000_000;

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
    let mut renderer: Box<dyn PlaneRenderer> = match style.ink {
        Ink::Solid => Box::new(Renderer::new()),
        Ink::Density => Box::new(DensityRenderer::new()),
    };
    renderer.load(Arc::new(drawing));
    renderer.begin(style, viewport(size), View::default());
    finish(|| renderer.step(WORK));
    encode(renderer.pixels(), size, system)
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
    encode(renderer.pixels(), size, system)
}

fn viewport(Size { width, height }: Size) -> Viewport {
    Viewport { width, height, ratio: (f64::from(width.max(height)) / f64::from(USUAL)).max(1.0) }
}

/// Takes all steps of a picture, and tells of them.
fn finish(mut step: impl FnMut() -> Progress) {
    let mut bar = Bar::new("picture", 0);
    while step() == Progress::More {
        bar.at(0);
    }
}

/// Opaque RGBA pixels as a file that carries its `system`.
fn encode(pixels: &[u8], Size { width, height }: Size, system: &str) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    // The renderer's pixels are opaque.
    let rgb: Vec<u8> = pixels.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    writer.write_image_data(&rgb)?;
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
