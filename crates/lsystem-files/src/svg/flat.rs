//! The flat form: every segment, in drawing order.

use super::paths::Paths;
use super::{Decimals, SvgOptions, VERTEX_WORK, ViewBox};
use crate::strokes::{StrokeLook, within};
use lsystem_drawing::MarkReader;
use lsystem_drawing::{Drawing, Mark, Plane};
use lsystem_syntax::{Diagnostic, Meter, Progress, Style};

/// The state of writing a flat file.
#[derive(Clone, Debug)]
pub(super) struct Flat {
    reader: MarkReader<Plane>,
    /// The file's start; empty once written.
    head: String,
    paths: Paths,
    /// The length of one CSS pixel, in the units of the file.
    pixel: f64,
    is_done: bool,
}

impl Flat {
    pub(super) fn new(drawing: &Drawing, style: &Style, options: &SvgOptions) -> Result<Self, Diagnostic> {
        drawing.check_size(options.most)?;
        let [x, y] = drawing.start;
        let [x0, y0, x1, y1] = drawing.bounds().unwrap_or([x, y, x, y]).map(within);
        let margin = drawing.step.abs();
        let (width, height) = (x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin);
        let longer = width.max(height);
        let pixel = longer / options.size;
        let head = ViewBox { x: x0 - margin, y: -y1 - margin, width, height, pixel }.open(style, options, "");
        let paths = Paths::new(Decimals::for_size(longer), None);
        Ok(Self { reader: MarkReader::new(drawing), head, paths, pixel, is_done: false })
    }

    pub(super) fn step(&mut self, drawing: &Drawing, style: &Style, text: &mut String, meter: &mut Meter) -> Progress {
        text.push_str(&core::mem::take(&mut self.head));
        let down = |[x, y]: [f64; 2]| [within(x), within(-y)];
        while !self.is_done && !meter.is_spent() {
            if self.paths.vertex(text) {
                meter.charge(VERTEX_WORK);
                continue;
            }
            meter.charge(8);
            match self.reader.next(drawing) {
                Some(Mark::Segment(segment, tint)) => {
                    let look = StrokeLook::new(style, tint, segment.width, self.pixel);
                    self.paths.stroke(text, down(segment.from), down(segment.to), look);
                }
                Some(Mark::Polygon(vertices, tint)) => {
                    meter.charge(vertices.len() as u64 / 8);
                    let vertices = vertices.into_iter().map(down).collect();
                    self.paths.fill(text, vertices, style.colour_of(tint).rgb);
                }
                None => {
                    self.paths.close(text);
                    text.push_str("</g>\n</svg>\n");
                    self.is_done = true;
                }
            }
        }
        if self.is_done { Progress::Done } else { Progress::More }
    }
}
