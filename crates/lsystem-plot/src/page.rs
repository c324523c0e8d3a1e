//! The place of a drawing on its sheet.

use crate::Sheet;
use crate::options::{PlotOptions, within};
use lsystem_drawing::{BlockFrame, Drawing, StyleChange};

/// A point of the sheet in millimetres from its top left corner, y down.
pub type Point = [f64; 2];

/// The distance of two points.
pub(crate) fn distance(a: Point, b: Point) -> f64 {
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    (x * x + y * y).sqrt()
}

/// The least side of a drawing, in units of its root block. Smaller ones are rounding errors.
const LEAST: f64 = 1e-9;

/// A sheet with a drawing on it.
#[derive(Clone, Debug)]
pub(crate) struct Page {
    /// The width and the height of the sheet.
    pub(crate) size: [f64; 2],
    /// The frame of the drawing's root block in millimetres from the bottom left corner, y up.
    pub(crate) frame: BlockFrame,
    /// The millimetres of one step of the turtle.
    pub(crate) step: f64,
}

impl Page {
    /// Places a drawing in the middle of the sheet, as large as fits between the margins.
    pub(crate) fn new(drawing: &Drawing, sheet: &Sheet, options: &PlotOptions) -> Self {
        let usual = Sheet::default();
        let [width, height] = [(sheet.width, usual.width), (sheet.height, usual.height)]
            .map(|(side, usual)| within(side, usual, 1.0, 10_000.0));
        let sheet = Sheet { width, height, margin: within(sheet.margin, usual.margin, 0.0, 10_000.0) };
        let [x0, y0, x1, y1] = drawing.extent().unwrap_or_default();
        let exponent = drawing.root.map_or(0, |root| drawing.blocks[root.0 as usize].exponent);
        let step = libm::scalbn(1.0, exponent.saturating_neg()).min(1e300);
        let style = StyleChange::start(drawing.width);
        // Broad strokes reach beyond their axes by half their width.
        let root = drawing.root.filter(|_| options.hatch || options.hide);
        let widest = root.map_or(0.0, |root| drawing.blocks[root.0 as usize].widest.of(drawing.width));
        let broad = (widest.max(0.0) * step).min(1e300);
        let (across, up) = (x1 - x0 + broad, y1 - y0 + broad);
        let scale = |sheet: &Sheet| {
            let (width, height) = sheet.inner();
            (width / across.max(LEAST)).min(height / up.max(LEAST))
        };
        let turned = sheet.turned();
        let sheet = if options.turns && scale(&turned) > scale(&sheet) { turned } else { sheet };
        // A negative step turns the picture by 180 degrees.
        let scale = scale(&sheet) * if drawing.step < 0.0 { -1.0 } else { 1.0 };
        let mut frame: BlockFrame = BlockFrame::new(scale, style);
        let centre = frame.transform([f64::midpoint(x0, x1), f64::midpoint(y0, y1)]);
        frame.at = [sheet.width / 2.0 - centre[0], sheet.height / 2.0 - centre[1]];
        Self { size: [sheet.width, sheet.height], frame, step: (step * scale.abs()).min(1e300) }
    }
}
