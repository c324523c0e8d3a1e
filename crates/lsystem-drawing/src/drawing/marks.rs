//! What is drawn, segments and polygons, one by one.

use super::segments::{Part, Standing};
use super::{Drawing, Frame, Segment};
use crate::drawing::block::Space;
use crate::style::StyleChange;
use lsystem_syntax::Tint;

/// Something drawn, in model units.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark<S: Space> {
    /// A segment, and what its colour may follow.
    Segment(Segment<S>, Tint),
    /// A filled polygon: its vertices, each joined to the next and the last to the first, and what its colour may
    /// follow. Inside is what the outline winds around a number of times other than zero.
    Polygon(Vec<S::Point>, Tint),
}

/// Reads what is drawn; it holds no drawing, so it can rest between two calls.
#[derive(Clone, Debug)]
pub struct MarkReader<S: Space> {
    standing: Standing<S>,
    /// The segments, and the segments and polygons, read so far.
    segments: u64,
    marks: usize,
    /// How many segments there are.
    all: f64,
    unit: f64,
}

impl<S: Space> MarkReader<S> {
    /// From the first on.
    #[must_use]
    pub fn new(drawing: &Drawing<S>) -> Self {
        let mut standing = Standing::new();
        if let Some(root) = drawing.root {
            standing.enter(drawing, root, &Frame::new(1.0, StyleChange::start(drawing.width)));
        }
        Self { standing, segments: 0, marks: 0, all: drawing.segment_count() as f64, unit: drawing.unit() }
    }

    /// The next mark; of the same drawing each time.
    pub fn next(&mut self, drawing: &Drawing<S>) -> Option<Mark<S>> {
        let (part, frame) = self.standing.next_part(drawing)?;
        let change = |id: crate::style::StyleId| frame.style.then(&drawing.styles[id.0 as usize]);
        let own = if self.all > 0.0 { (self.segments as f64 + 0.5) / self.all } else { 0.0 };
        let place = drawing.places.get(self.marks).copied().unwrap_or(own);
        self.marks += 1;
        let tint = |style: &StyleChange| Tint { index: style.colour.of(0), level: style.level, place };
        Some(match part {
            Part::Stroke(stroke) => {
                let style = change(stroke.style);
                let ends = [stroke.from, stroke.to].map(|end| frame.lie(end));
                self.segments += 1;
                Mark::Segment(drawing.segment(ends, &style, self.unit), tint(&style))
            }
            Part::Polygon(polygon) => {
                let style = change(polygon.style);
                let vertices = drawing.vertices_of(polygon).iter();
                let vertices = vertices.map(|&vertex| drawing.model(frame.lie(vertex), self.unit)).collect();
                Mark::Polygon(vertices, tint(&style))
            }
        })
    }
}

impl<S: Space> Mark<S> {
    /// The units of work that writing it takes.
    pub fn work(&self) -> u64 {
        match self {
            Self::Segment(..) => 8,
            Self::Polygon(vertices, _) => 8 + 4 * vertices.len() as u64,
        }
    }
}

impl<S: Space> Drawing<S> {
    /// Everything drawn, in drawing order; a polygon comes before what is drawn while it is open. A drawing that memoises
    /// may have more than anybody can wait for.
    pub fn marks(&self) -> impl Iterator<Item = Mark<S>> {
        let mut reader = MarkReader::new(self);
        core::iter::from_fn(move || reader.next(self))
    }
}
