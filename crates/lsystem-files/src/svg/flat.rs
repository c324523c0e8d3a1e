//! Every segment, in drawing order.

use super::paths::{Ink, Paths, Pen, within};
use super::{Decimals, Sheet, Svg, SvgOptions};
use lsystem_drawing::MarkReader;
use lsystem_drawing::{Drawing, Mark, Plane};
use lsystem_syntax::{Diagnostic, Meter, Progress, Style};

pub(super) fn write(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<Svg, Diagnostic> {
    let mut text = String::new();
    let mut writer = SvgWriter::new(drawing, style, options)?;
    while writer.step(drawing, style, &mut text, u64::MAX) == Progress::More {}
    Ok(Svg { text, instances: 0, ink: style.ink })
}

/// A flat SVG file in steps. It holds no drawing, and what it has written may be taken away between two steps.
#[derive(Clone, Debug)]
pub struct SvgWriter {
    reader: MarkReader<Plane>,
    /// All that comes before the drawing, until it is written.
    head: String,
    decimals: Decimals,
    /// One CSS pixel, in the units of the file.
    pixel: f64,
    pen: Option<Pen>,
    is_done: bool,
    spent: u64,
}

impl SvgWriter {
    /// Ready to write a drawing, whatever form the options name.
    ///
    /// # Errors
    /// As [`write_svg`](crate::write_svg).
    pub fn new(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<Self, Diagnostic> {
        drawing.check_size(options.most)?;
        let [x, y] = drawing.start;
        let [x0, y0, x1, y1] = drawing.bounds().unwrap_or([x, y, x, y]).map(within);
        let margin = drawing.step.abs();
        let (width, height) = (x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin);
        let longer = width.max(height);
        let pixel = longer / options.size;
        let head = Sheet { x: x0 - margin, y: -y1 - margin, width, height, pixel }.open(style, options, "");
        let (reader, decimals) = (MarkReader::new(drawing), Decimals::for_size(longer));
        Ok(Self { reader, head, decimals, pixel, pen: None, is_done: false, spent: 0 })
    }

    /// A warning where the file will not look like the drawing.
    #[must_use]
    pub fn warning(style: &Style) -> Option<Diagnostic> {
        Svg { text: String::new(), instances: 0, ink: style.ink }.warning()
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Appends to the file for about `work` units; the drawing and the style are the same each time.
    pub fn step(&mut self, drawing: &Drawing, style: &Style, text: &mut String, work: u64) -> Progress {
        if self.is_done {
            return Progress::Done;
        }
        text.push_str(&core::mem::take(&mut self.head));
        let mut meter = Meter::new(work);
        let mut paths = Paths::new(text, self.decimals, None);
        paths.pen = self.pen;
        let down = |[x, y]: [f64; 2]| [within(x), within(-y)];
        while !meter.is_spent() {
            let Some(mark) = self.reader.next(drawing) else {
                self.is_done = true;
                break;
            };
            meter.charge(mark.work());
            match mark {
                Mark::Segment(segment, tint) => {
                    let ink = Ink::new(style, tint, segment.width, self.pixel);
                    paths.stroke(down(segment.from), down(segment.to), ink);
                }
                Mark::Polygon(vertices, tint) => paths.fill(vertices.into_iter().map(down), style.colour_of(tint).rgb),
            }
        }
        self.spent = self.spent.saturating_add(meter.spent());
        self.pen = paths.pen;
        if !self.is_done {
            return Progress::More;
        }
        paths.close();
        text.push_str("</g>\n</svg>\n");
        Progress::Done
    }
}
