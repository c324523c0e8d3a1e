//! Strokes and polygons as `<path>` elements.

use super::Decimals;
use crate::Sink;
use crate::strokes::{PATH, StrokeFile, StrokeLook, VERTEX_WORK};
use core::fmt::Write;
use lsystem_syntax::{Halt, Work};

/// A look as attributes of an element.
pub(super) fn look_attributes(look: &StrokeLook) -> String {
    let [r, g, b] = look.rgb;
    let mut text = format!(" stroke=\"#{r:02x}{g:02x}{b:02x}\"");
    attribute(&mut text, "stroke-width", Decimals::for_size(look.width), look.width);
    text
}

/// Writes strokes and polygons. Consecutive strokes of the same look share a path. In the file, y points down.
pub(super) struct Paths<'a, 'o> {
    pub(super) sink: &'a mut Sink<'o>,
    pub(super) decimals: Decimals,
    /// The look of the surrounding group.
    around: Option<StrokeLook>,
    /// The ID of the next path.
    pub(super) id: Option<String>,
    /// The open path.
    open: Option<OpenPath>,
}

/// The open path.
#[derive(Clone, Copy)]
struct OpenPath {
    look: StrokeLook,
    /// The end of the path so far, in units of the last decimal place.
    at: [f64; 2],
    segments: usize,
}

impl<'a, 'o> Paths<'a, 'o> {
    pub(super) fn new(sink: &'a mut Sink<'o>, decimals: Decimals, around: Option<StrokeLook>) -> Self {
        Self { sink, decimals, around, id: None, open: None }
    }

    fn point(&mut self, [x, y]: [f64; 2]) {
        let text = &mut self.sink.text;
        self.decimals.write(text, x);
        text.push(' ');
        self.decimals.write(text, -y);
    }
}

impl Work for Paths<'_, '_> {
    fn charge(&mut self, units: u64) -> Result<(), Halt> {
        self.sink.charge(units)
    }
}

impl StrokeFile for Paths<'_, '_> {
    fn stroke(&mut self, from: [f64; 2], to: [f64; 2], look: StrokeLook) {
        let [start, end] = [from, to].map(|point| point.map(|c| self.decimals.round(c)));
        let open = self.open.filter(|open| open.look == look && open.segments < PATH);
        if open.is_some_and(|open| open.at == start) {
            self.sink.text.push(' ');
        } else {
            if open.is_none() {
                self.close();
                let text = &mut self.sink.text;
                text.push_str("<path");
                if let Some(id) = self.id.take() {
                    // Writing to a `String` cannot fail.
                    let _ = write!(text, " id=\"{id}\"");
                }
                if self.around != Some(look) {
                    text.push_str(&look_attributes(&look));
                }
                text.push_str(" d=\"");
            }
            self.sink.text.push('M');
            self.point(from);
            self.sink.text.push('L');
        }
        self.point(to);
        self.open = Some(OpenPath { look, at: end, segments: open.map_or(0, |open| open.segments) + 1 });
    }

    fn fill(&mut self, vertices: impl Iterator<Item = [f64; 2]>, [r, g, b]: [u8; 3]) -> Result<(), Halt> {
        self.close();
        // Writing to a `String` cannot fail.
        let _ = write!(self.sink.text, "<path fill=\"#{r:02x}{g:02x}{b:02x}\" stroke=\"none\" d=\"");
        for (number, vertex) in vertices.enumerate() {
            self.charge(VERTEX_WORK)?;
            self.sink.text.push_str(match number {
                0 => "M",
                1 => "L",
                _ => " ",
            });
            self.point(vertex);
        }
        self.sink.text.push_str("z\"/>\n");
        Ok(())
    }

    fn close(&mut self) {
        if self.open.take().is_some() {
            self.sink.text.push_str("\"/>\n");
        }
    }
}

pub(super) fn attribute(text: &mut String, name: &str, decimals: Decimals, value: f64) {
    // Writing to a `String` cannot fail.
    let _ = write!(text, " {name}=\"");
    decimals.write(text, value);
    text.push('"');
}
