//! The looks of strokes in files.

use lsystem_drawing::StyleChange;
use lsystem_syntax::{Style, Tint};

/// The most segments of one path. Longer paths take browsers disproportionately long.
pub(super) const PATH: usize = 10_000;

/// The look of a stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StrokeLook {
    pub(super) rgb: [u8; 3],
    /// In the units of the file.
    pub(super) width: f64,
}

impl StrokeLook {
    /// The look of a stroke of this width. `pixel` is the length of one CSS pixel in the same units.
    pub(super) fn new(style: &Style, tint: Tint, width: f64, pixel: f64) -> Self {
        let width = within(width.max(style.min_width * pixel));
        // A stroke of width 0 is drawn one pixel wide, as on the screen.
        Self { rgb: style.colour_of(tint).rgb, width: if width > 0.0 { width } else { pixel } }
    }

    /// The look of a style that began with [`StyleChange::start`]. `step` is the step length.
    pub(super) fn of(style: &Style, change: &StyleChange, step: f64, pixel: f64) -> Self {
        let tint = Tint { index: change.colour.of(0), level: change.level, place: 0.0 };
        Self::new(style, tint, change.width.of(0.0) * step, pixel)
    }
}

/// Clamps a length so that sums of two lengths stay finite.
pub(super) fn within(length: f64) -> f64 {
    length.clamp(-1e300, 1e300)
}
