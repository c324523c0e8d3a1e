//! Strokes and polygons as `<path>` elements.

use super::Decimals;
use crate::strokes::{PATH, StrokeLook};
use core::fmt::Write;

/// A look as attributes of an element.
pub(super) fn look_attributes(look: &StrokeLook) -> String {
    let [r, g, b] = look.rgb;
    let mut text = format!(" stroke=\"#{r:02x}{g:02x}{b:02x}\"");
    attribute(&mut text, "stroke-width", Decimals::for_size(look.width), look.width);
    text
}

/// Writes strokes and polygons. Consecutive strokes of the same look share a path. The writer holds no text,
/// so that callers may store it between two calls.
#[derive(Clone, Debug)]
pub(super) struct Paths {
    decimals: Decimals,
    /// The look of the surrounding group.
    around: Option<StrokeLook>,
    /// The ID of the next path.
    pub(super) id: Option<String>,
    /// The open path.
    open: Option<OpenPath>,
    /// The vertices of the open polygon, and the number of vertices written.
    outline: Option<(Vec<[f64; 2]>, usize)>,
}

/// The open path.
#[derive(Clone, Copy, Debug)]
struct OpenPath {
    look: StrokeLook,
    /// The end of the path so far, in units of the last decimal place.
    at: [f64; 2],
    segments: usize,
}

impl Paths {
    pub(super) fn new(decimals: Decimals, around: Option<StrokeLook>) -> Self {
        Self { decimals, around, id: None, open: None, outline: None }
    }

    /// Writes a stroke, in the units of the file, y down.
    pub(super) fn stroke(&mut self, text: &mut String, from: [f64; 2], to: [f64; 2], look: StrokeLook) {
        let [start, end] = [from, to].map(|point| point.map(|c| self.decimals.round(c)));
        match self.open {
            Some(open) if open.look == look && open.segments < PATH => {
                text.push(if open.at == start { ' ' } else { 'M' });
                if open.at != start {
                    self.point(text, from);
                    text.push('L');
                }
            }
            _ => {
                self.close(text);
                text.push_str("<path");
                if let Some(id) = self.id.take() {
                    let _ = write!(text, " id=\"{id}\"");
                }
                if self.around != Some(look) {
                    text.push_str(&look_attributes(&look));
                }
                text.push_str(" d=\"M");
                self.point(text, from);
                text.push('L');
            }
        }
        self.point(text, to);
        let segments = self.open.map_or(0, |open| open.segments) + 1;
        self.open = Some(OpenPath { look, at: end, segments });
    }

    /// Begins a filled polygon without a stroke. [`Paths::vertex`] writes its vertices.
    pub(super) fn fill(&mut self, text: &mut String, vertices: Vec<[f64; 2]>, [r, g, b]: [u8; 3]) {
        self.close(text);
        // Writing to a `String` cannot fail.
        let _ = write!(text, "<path fill=\"#{r:02x}{g:02x}{b:02x}\" stroke=\"none\" d=\"");
        self.outline = Some((vertices, 0));
    }

    /// Writes the next vertex of the open polygon, or its end. Returns whether a polygon was open.
    pub(super) fn vertex(&mut self, text: &mut String) -> bool {
        let Some((vertices, written)) = &mut self.outline else { return false };
        let Some(&vertex) = vertices.get(*written) else {
            text.push_str("z\"/>\n");
            self.outline = None;
            return true;
        };
        text.push_str(match *written {
            0 => "M",
            1 => "L",
            _ => " ",
        });
        *written += 1;
        self.point(text, vertex);
        true
    }

    fn point(&self, text: &mut String, [x, y]: [f64; 2]) {
        self.decimals.write(text, x);
        text.push(' ');
        self.decimals.write(text, y);
    }

    /// Ends the open path, so that other elements can follow.
    pub(super) fn close(&mut self, text: &mut String) {
        if self.open.take().is_some() {
            text.push_str("\"/>\n");
        }
    }
}

pub(super) fn attribute(text: &mut String, name: &str, decimals: Decimals, value: f64) {
    // Writing to a `String` cannot fail.
    let _ = write!(text, " {name}=\"");
    decimals.write(text, value);
    text.push('"');
}
