//! Where a run of segments lies.

use super::hull::hull;
use super::segments::Frame;
use super::{Block, Drawing, Item, StyleChange};
use crate::turtle::Directions;
use core::ops::Range;

/// Corners that are collected before they are joined to a hull.
const MANY: usize = 4096;

impl Drawing {
    /// The corners, counter-clockwise, of a convex polygon around the axes of the segments with these numbers (0-based,
    /// in drawing order), in model units; one or two where they lie on a point or a line, none where there are no such
    /// segments. It is the smallest one, unless that has very many corners. Blocks are taken whole, so it takes as long as they are nested deep, however many segments there are.
    #[must_use]
    pub fn outline(&self, segments: Range<u128>) -> Vec<[f64; 2]> {
        let mut search = Search { drawing: self, segments, corners: vec![], directions: Directions::new() };
        if let Some(root) = self.root {
            let frame = Frame::new(1.0, StyleChange::start(self.width));
            search.block(&self.blocks[root.0 as usize], &frame, 0);
        }
        let mut corners = search.corners;
        hull(&mut corners);
        let unit = self.unit();
        corners.iter().map(|[x, y]| [self.start[0] + unit * x, self.start[1] + unit * y]).collect()
    }
}

struct Search<'a> {
    drawing: &'a Drawing,
    segments: Range<u128>,
    corners: Vec<[f64; 2]>,
    directions: Directions,
}

impl Search<'_> {
    /// Takes what is wanted of a block, whose first segment has the number `first`. Recursion is as deep as blocks are
    /// nested, at most some thousand.
    fn block(&mut self, block: &Block, frame: &Frame, first: u128) {
        if self.segments.start <= first && first.saturating_add(block.segments) <= self.segments.end {
            let corners = &self.drawing.corners[block.hull.start as usize..block.hull.end as usize];
            self.corners.extend(corners.iter().map(|&corner| frame.lie(corner)));
            if self.corners.len() > MANY {
                hull(&mut self.corners);
            }
            return;
        }
        let mut next = first;
        for item in &self.drawing.items[block.items.start as usize..block.items.end as usize] {
            if next >= self.segments.end {
                return;
            }
            match item {
                Item::Stroke(stroke) => {
                    if next >= self.segments.start {
                        self.corners.extend([frame.lie(stroke.from), frame.lie(stroke.to)]);
                    }
                    next = next.saturating_add(1);
                }
                Item::Polygon(_) => {}
                Item::Block(placed) => {
                    let inner = &self.drawing.blocks[placed.block.0 as usize];
                    let after = next.saturating_add(inner.segments);
                    if after > self.segments.start {
                        let frame = frame.place(placed, self.drawing, &mut self.directions);
                        self.block(inner, &frame, next);
                    }
                    next = after;
                }
            }
        }
    }
}
