//! PNG pictures, painted by the core's renderers while the file is written.

use crate::progress::DelayedBar;
use lsystem::files::{FileOptions, PngOptions, PngWriter, Writer};
use lsystem::{Diagnostic, Figure, Progress, Style, Vantage, Viewport, fit, render_diagnostic};
use std::io::{self, Write};

/// The default length of the longer side, in pixels. At this length a stroke's least width is in pixels; larger
/// pictures scale it.
const USUAL: u32 = 1024;
/// The least default length of the shorter side, in pixels.
const LEAST: u32 = 128;
/// Units of work between two pieces of the file.
const WORK: u64 = 1_000_000;

/// The writer of a PNG of the whole drawing, centred, with its `system` inside. In space it is seen by the page's first
/// camera.
///
/// # Errors
/// As [`PngWriter::new`].
pub(crate) fn png(
    figure: &Figure,
    style: &Style,
    choices: &FileOptions,
    system: String,
) -> Result<PngWriter, Diagnostic> {
    let options = PngOptions {
        viewport: viewport(choices.size.unwrap_or_else(|| usual_size(figure))),
        dpi: choices.dpi,
        is_transparent: choices.transparent,
        system,
        ..PngOptions::default()
    };
    PngWriter::new(figure, style.clone(), Vantage::default(), &options)
}

fn viewport([width, height]: [u32; 2]) -> Viewport {
    Viewport { width, height, ratio: (f64::from(width.max(height)) / f64::from(USUAL)).max(1.0) }
}

/// Writes a picture piece by piece, with a progress bar.
///
/// # Errors
/// Errors of the stream.
pub(crate) fn write(mut picture: PngWriter, out: &mut dyn Write) -> io::Result<()> {
    let mut bar = DelayedBar::new("picture", Some(u64::from(picture.height())));
    let mut piece = Vec::new();
    loop {
        let progress =
            picture.step(&mut piece, WORK).map_err(|error| io::Error::other(render_diagnostic(&error, "PNG", "")))?;
        out.write_all(&piece)?;
        piece.clear();
        bar.at(u64::from(picture.rows()));
        if progress == Progress::Done {
            return Ok(());
        }
    }
}

/// The default size: in the plane in the proportions of the drawing, in space a square.
fn usual_size(figure: &Figure) -> [u32; 2] {
    let Figure::Plane(drawing) = figure else { return [USUAL; 2] };
    let extent = fit(drawing);
    let longer = extent.width.max(extent.height);
    let side = |length: f64| {
        let share = length / longer;
        // The proportions are unknown if the extent is beyond the range of `f64`.
        if share.is_finite() { ((share * f64::from(USUAL)).round() as u32).clamp(LEAST, USUAL) } else { USUAL }
    };
    [side(extent.width), side(extent.height)]
}
