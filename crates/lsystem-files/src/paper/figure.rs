//! The place of a drawing on paper.

use crate::number::Decimals;
use crate::strokes::{StrokeLook, within};
use lsystem_drawing::{Drawing, StyleChange};
use lsystem_plot::Sheet;
use lsystem_syntax::{Style, Tint};

/// The longer side, in pixels, of the picture for which [`Style::min_width`] is taken.
const PICTURE: f64 = 1024.0;
/// The largest width and height of a figure in LaTeX, in millimetres: the text of the class `article` is 121 mm wide.
const TEXT: [f64; 2] = [120.0, 160.0];

/// A drawing scaled to millimetres. The origin is the lower left corner; y points up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Figure {
    /// The width and the height, with a margin of one step on every side.
    pub(super) size: [f64; 2],
    /// The length of one CSS pixel.
    pub(super) pixel: f64,
    /// The millimetres of one model unit.
    pub(super) scale: f64,
    /// The lower left corner, in model units.
    corner: [f64; 2],
}

impl Figure {
    /// A figure for LaTeX: it fits the text of an article, and the sheet.
    pub(super) fn for_text(drawing: &Drawing, sheet: &Sheet) -> Self {
        let (width, height) = sheet.inner();
        Self::new(drawing, [width.min(TEXT[0]), height.min(TEXT[1])])
    }

    /// A figure of at most this width and height.
    pub(super) fn new(drawing: &Drawing, most: [f64; 2]) -> Self {
        let [x, y] = drawing.start;
        let [x0, y0, x1, y1] = drawing.bounds().unwrap_or([x, y, x, y]).map(within);
        let margin = drawing.step.abs();
        let sides = [x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin];
        let scale = (most[0] / sides[0]).min(most[1] / sides[1]);
        let size = sides.map(|side| side * scale);
        let pixel = size[0].max(size[1]) / PICTURE;
        Self { size, pixel, scale, corner: [x0 - margin, y0 - margin] }
    }

    /// A point of the drawing.
    pub(super) fn place(&self, point: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| (within(point[axis]) - self.corner[axis]) * self.scale)
    }

    /// The look of a stroke of this width in model units.
    pub(super) fn look(&self, style: &Style, tint: Tint, width: f64) -> StrokeLook {
        StrokeLook::new(style, tint, width * self.scale, self.pixel)
    }

    /// The look of strokes at the drawing's start.
    pub(super) fn start(&self, drawing: &Drawing, style: &Style) -> StrokeLook {
        StrokeLook::of(style, &StyleChange::start(drawing.width), drawing.step.abs() * self.scale, self.pixel)
    }
}

/// Coordinates of a figure, exact to 0.01 mm.
pub(super) fn coordinates() -> Decimals {
    Decimals::for_size(1e4)
}

/// Lengths that depend on the whole figure, such as stroke widths, exact to 0.0001 mm.
pub(super) fn lengths() -> Decimals {
    Decimals::for_size(1e2)
}
