//! The marks of a drawing, segments and polygons, one by one.

use super::segments::{Cursor, ItemRef};
use super::{Drawing, Frame, Segment};
use crate::drawing::block::Space;
use crate::style::StyleChange;
use lsystem_syntax::Tint;

/// A segment or a polygon, in model units, with the quantities that its colour may depend on.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark<S: Space> {
    /// A segment.
    Segment(Segment<S>, Tint),
    /// The vertices of a filled polygon, each joined to the next and the last to the first. The inside follows the
    /// nonzero winding rule.
    Polygon(Vec<S::Point>, Tint),
}

/// Reads the marks of a drawing. The reader does not borrow the drawing between calls.
#[derive(Clone, Debug)]
pub struct MarkReader<S: Space> {
    cursor: Cursor<S>,
    /// The number of segments read so far.
    segments: u64,
    /// The number of segments and polygons read so far.
    marks: usize,
    /// The number of segments of the drawing.
    all: f64,
    /// As [`Drawing::unit`].
    unit: f64,
}

impl<S: Space> MarkReader<S> {
    /// A reader at the first mark.
    #[must_use]
    pub fn new(drawing: &Drawing<S>) -> Self {
        let mut cursor = Cursor::new();
        if let Some(root) = drawing.root {
            cursor.enter(drawing, root, &Frame::new(1.0, StyleChange::start(drawing.width)));
        }
        Self { cursor, segments: 0, marks: 0, all: drawing.segment_count() as f64, unit: drawing.unit() }
    }

    /// The next mark. Every call needs the same drawing.
    pub fn next(&mut self, drawing: &Drawing<S>) -> Option<Mark<S>> {
        let (part, frame) = self.cursor.next_part(drawing)?;
        let change = |id: crate::style::StyleId| frame.style.then(&drawing.styles[id.0 as usize]);
        let own = if self.all > 0.0 { (self.segments as f64 + 0.5) / self.all } else { 0.0 };
        let place = drawing.places.get(self.marks).copied().unwrap_or(own);
        self.marks += 1;
        let tint = |style: &StyleChange| Tint { index: style.colour.of(0), level: style.level, place };
        Some(match part {
            ItemRef::Stroke(stroke) => {
                let style = change(stroke.style);
                let ends = [stroke.from, stroke.to].map(|end| frame.transform(end));
                self.segments += 1;
                Mark::Segment(drawing.segment(ends, &style, self.unit), tint(&style))
            }
            ItemRef::Polygon(polygon) => {
                let style = change(polygon.style);
                let vertices = drawing.vertices_of(polygon).iter();
                let vertices = vertices.map(|&vertex| drawing.model(frame.transform(vertex), self.unit)).collect();
                Mark::Polygon(vertices, tint(&style))
            }
        })
    }
}

impl<S: Space> Mark<S> {
    /// The units of work for writing the mark.
    pub fn work(&self) -> u64 {
        match self {
            Self::Segment(..) => 8,
            Self::Polygon(vertices, _) => 8 + 4 * vertices.len() as u64,
        }
    }
}

impl<S: Space> Drawing<S> {
    /// All marks in drawing order; a polygon comes before the marks that are drawn while it is open. A shared drawing
    /// may have too many marks to read them all.
    pub fn marks(&self) -> impl Iterator<Item = Mark<S>> {
        let mut reader = MarkReader::new(self);
        core::iter::from_fn(move || reader.next(self))
    }
}
