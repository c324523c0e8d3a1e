//! The flat form: every segment, in drawing order.

use super::paths::Paths;
use super::{Decimals, SvgOptions, ViewBox};
use crate::Sink;
use crate::strokes::{StrokeLook, within, write_marks};
use lsystem_drawing::Drawing;
use lsystem_syntax::{Halt, Style};

/// Writes a flat file.
pub(super) fn write_flat(
    drawing: &Drawing,
    style: &Style,
    options: &SvgOptions,
    sink: &mut Sink<'_>,
) -> Result<(), Halt> {
    drawing.check_size(options.most)?;
    let [x, y] = drawing.start;
    let [x0, y0, x1, y1] = drawing.bounds().unwrap_or([x, y, x, y]).map(within);
    let margin = drawing.step.abs();
    let (width, height) = (x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin);
    let longer = width.max(height);
    let pixel = longer / options.size;
    ViewBox { x: x0 - margin, y: -y1 - margin, width, height, pixel }.open(style, options, "", &mut sink.text);
    let mut paths = Paths::new(sink, Decimals::for_size(longer), None);
    let look = |tint, width| StrokeLook::new(style, tint, width, pixel);
    write_marks(drawing, style, |point| point.map(within), look, &mut paths)?;
    sink.text.push_str("</g>\n</svg>\n");
    Ok(())
}
