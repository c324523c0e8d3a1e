//! The marks of a drawing, segments and polygons, one by one.

use super::segments::{Cursor, ItemRef};
use super::{BlockFrame, Drawing, Segment};
use crate::drawing::block::Space;
use crate::style::{StyleChange, StyleId};
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
        self.marks_from(0)
    }

    /// The marks from segment number `start` (0-based) on. The time depends on the depth of nested blocks, not on
    /// `start`. Unless `start` is 0, the places along the path are those of the drawing order.
    pub fn marks_from(&self, start: u128) -> impl Iterator<Item = Mark<S>> {
        let unit = self.unit();
        let frame = BlockFrame::new(1.0, StyleChange::start(self.width));
        self.marks_by(start, frame, self.step.abs(), move |point| self.model(point, unit))
    }

    /// As [`Drawing::marks`], but in the outer frame of `frame`, the frame of the root block. A step of the turtle has
    /// the length `step` there.
    pub fn marks_in(&self, frame: BlockFrame<S>, step: f64) -> impl Iterator<Item = Mark<S>> {
        self.marks_by(0, frame, step, |point| point)
    }

    /// The marks from segment `start` on in the outer frame of `frame`, whose points `place_point` moves. A step is as
    /// long as `step`.
    fn marks_by(
        &self,
        start: u128,
        frame: BlockFrame<S>,
        step: f64,
        place_point: impl Fn(S::Point) -> S::Point,
    ) -> impl Iterator<Item = Mark<S>> {
        let mut cursor = Cursor::new();
        if let Some(root) = self.root {
            cursor.enter(self, root, &frame);
        }
        cursor.pass(self, start);
        let all = self.segment_count() as f64;
        // As a number that large starts do not overflow: exact up to 2^53.
        let (mut segments, mut marks) = (start as f64, if start == 0 { 0 } else { self.places.len() });
        core::iter::from_fn(move || {
            let (part, frame) = cursor.next_part(self)?;
            let change = |id: StyleId| frame.style.then(&self.styles[id.0 as usize]);
            let own = if all > 0.0 { (segments + 0.5) / all } else { 0.0 };
            let place = self.places.get(marks).copied().unwrap_or(own);
            marks += 1;
            let tint = |style: &StyleChange| Tint { index: style.colour.of(0), level: style.level, place };
            Some(match part {
                ItemRef::Stroke(stroke) => {
                    let style = change(stroke.style);
                    let [from, to] = [stroke.from, stroke.to].map(|end| place_point(frame.transform(end)));
                    segments += 1.0;
                    Mark::Segment(Segment::new([from, to], &style, step), tint(&style))
                }
                ItemRef::Polygon(polygon) => {
                    let style = change(polygon.style);
                    let vertices = self.vertices_of(polygon).iter();
                    let vertices = vertices.map(|&vertex| place_point(frame.transform(vertex))).collect();
                    Mark::Polygon(vertices, tint(&style))
                }
            })
        })
    }
}
