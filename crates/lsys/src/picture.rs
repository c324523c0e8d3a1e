//! The sizes of PNG pictures.

use lsystem::files::{FileOptions, PngOptions};
use lsystem::{Drawing, Viewport, fit};

/// The default length of the longer side, in pixels. At this length a stroke's least width is in pixels; larger
/// pictures scale it.
const USUAL: u32 = 1024;
/// The least default length of the shorter side, in pixels.
const LEAST: u32 = 128;
/// The default size of pictures in space.
pub(crate) const SOLID_SIZE: [u32; 2] = [USUAL; 2];

/// The options of a picture whose default size is `usual`.
pub(crate) fn png_options(usual: [u32; 2], choices: FileOptions) -> PngOptions {
    PngOptions {
        viewport: viewport(choices.size.unwrap_or(usual)),
        dpi: choices.dpi,
        is_transparent: choices.transparent,
        system: choices.system,
        ..PngOptions::default()
    }
}

fn viewport([width, height]: [u32; 2]) -> Viewport {
    Viewport { width, height, ratio: (f64::from(width.max(height)) / f64::from(USUAL)).max(1.0) }
}

/// The default size, in the proportions of the drawing.
pub(crate) fn usual_size(drawing: &Drawing) -> [u32; 2] {
    let extent = fit(drawing);
    let longer = extent.width.max(extent.height);
    let side = |length: f64| {
        let share = length / longer;
        // The proportions are unknown if the extent is beyond the range of `f64`.
        if share.is_finite() { ((share * f64::from(USUAL)).round() as u32).clamp(LEAST, USUAL) } else { USUAL }
    };
    [side(extent.width), side(extent.height)]
}
