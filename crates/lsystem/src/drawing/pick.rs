//! Which segment is at a point.

use super::segments::Frame;
use super::{Block, Drawing, Item, StyleChange};
use crate::turtle::Directions;

/// A segment found near a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pick {
    /// Its number in drawing order, 0-based.
    pub segment: u128,
    /// How far its axis is from the point, in units of the root block.
    pub distance: f64,
}

/// A segment this much closer than asked for is as good as any other.
const CLOSE: f64 = 0.25;

impl Drawing {
    /// A segment whose axis is within `tolerance` of `point`, both in units of the root block
    /// ([`Drawing::from_model`]): the nearest, or one that is within a quarter of the tolerance, later ones first.
    /// Looks into at most `visits` blocks and segments; where many overlap it gives the best seen so far.
    #[must_use]
    pub fn pick(&self, point: [f64; 2], tolerance: f64, visits: usize) -> Option<Pick> {
        let mut search = Search {
            drawing: self,
            point,
            best: None,
            reach: tolerance,
            enough: tolerance * CLOSE,
            visits,
            directions: Directions::new(),
        };
        let root = &self.blocks[self.root?.0 as usize];
        search.block(root, &Frame::new(1.0, StyleChange::start(self.width)), 0);
        search.best
    }

    /// A model point in units of the root block.
    #[must_use]
    pub fn from_model(&self, point: [f64; 2]) -> [f64; 2] {
        let unit = self.unit();
        [(point[0] - self.start[0]) / unit, (point[1] - self.start[1]) / unit]
    }
}

struct Search<'a> {
    drawing: &'a Drawing,
    point: [f64; 2],
    best: Option<Pick>,
    /// Only what is nearer than this is of interest.
    reach: f64,
    enough: f64,
    visits: usize,
    directions: Directions,
}

impl Search<'_> {
    /// Looks through a block, whose first segment has the number `first`, from its end to its start. Recursion is as
    /// deep as blocks are nested, at most some thousand.
    fn block(&mut self, block: &Block, frame: &Frame, first: u128) {
        let items = &self.drawing.items[block.items.start as usize..block.items.end as usize];
        let mut after = first.saturating_add(block.segments);
        for item in items.iter().rev() {
            if self.visits == 0 || self.reach <= self.enough {
                return;
            }
            self.visits -= 1;
            match item {
                Item::Stroke(stroke) => {
                    after -= 1;
                    let distance = to_segment(self.point, frame.lie(stroke.from), frame.lie(stroke.to));
                    if distance < self.reach {
                        self.reach = distance;
                        self.best = Some(Pick { segment: after, distance });
                    }
                }
                Item::Polygon(_) => {}
                Item::Block(placed) => {
                    let inner = &self.drawing.blocks[placed.block.0 as usize];
                    after = after.saturating_sub(inner.segments);
                    let frame = frame.place(placed, self.drawing, &mut self.directions);
                    if self.is_near(inner, &frame) {
                        self.block(inner, &frame, after);
                    }
                }
            }
        }
    }

    /// Whether a block's hull is within reach.
    fn is_near(&self, block: &Block, frame: &Frame) -> bool {
        let corners = &self.drawing.corners[block.hull.start as usize..block.hull.end as usize];
        let Some(&last) = corners.last() else { return false };
        let mut inside = true;
        let mut from = frame.lie(last);
        for &corner in corners {
            let to = frame.lie(corner);
            if to_segment(self.point, from, to) < self.reach {
                return true;
            }
            // Corners go counter-clockwise: inside is to the left of every side.
            let side = (to[0] - from[0]) * (self.point[1] - from[1]) - (to[1] - from[1]) * (self.point[0] - from[0]);
            inside &= side >= 0.0;
            from = to;
        }
        inside && corners.len() > 2
    }
}

/// The distance from a point to a segment.
fn to_segment(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let away = [point[0] - from[0], point[1] - from[1]];
    let length2 = along[0] * along[0] + along[1] * along[1];
    let part = if length2 > 0.0 { ((away[0] * along[0] + away[1] * along[1]) / length2).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (away[0] - part * along[0], away[1] - part * along[1]);
    (x * x + y * y).sqrt()
}
