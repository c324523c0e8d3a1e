//! What is drawn, segments and polygons, one by one.

use super::segments::{Part, Strokes};
use super::{Drawing, Frame, Segment, StyleChange};
use crate::Tint;
use crate::space::Space;

/// Something drawn, in model units.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark<S: Space> {
    /// A segment, and what its colour may follow.
    Segment(Segment<S>, Tint),
    /// A filled polygon: its vertices, each joined to the next and the last to the first, and what its colour may
    /// follow. Inside is what the outline winds around a number of times other than zero.
    Polygon(Vec<S::Point>, Tint),
}

impl<S: Space> Drawing<S> {
    /// Everything drawn, in drawing order; a polygon comes before what is drawn while it is open. A drawing that memoises
    /// may have more than anybody can wait for.
    pub fn marks(&self) -> impl Iterator<Item = Mark<S>> {
        let mut strokes = Strokes::new(self);
        if let Some(root) = self.root {
            strokes.enter(root, &Frame::new(1.0, StyleChange::start(self.width)));
        }
        let (all, unit) = (self.segment_count() as f64, self.unit());
        let mut number = 0_u64;
        let mut places = self.places.iter();
        core::iter::from_fn(move || {
            let (part, frame) = strokes.next_part()?;
            let change = |id: super::StyleId| frame.style.then(&self.styles[id.0 as usize]);
            let own = if all > 0.0 { (number as f64 + 0.5) / all } else { 0.0 };
            let place = places.next().copied().unwrap_or(own);
            let tint = |style: &StyleChange| Tint { index: style.colour.of(0), level: style.level, place };
            Some(match part {
                Part::Stroke(stroke) => {
                    let style = change(stroke.style);
                    let segment = self.segment([stroke.from, stroke.to].map(|end| frame.lie(end)), &style, unit);
                    number += 1;
                    Mark::Segment(segment, tint(&style))
                }
                Part::Polygon(polygon) => {
                    let style = change(polygon.style);
                    let vertices =
                        self.vertices_of(polygon).iter().map(|&vertex| self.model(frame.lie(vertex), unit)).collect();
                    Mark::Polygon(vertices, tint(&style))
                }
            })
        })
    }
}
