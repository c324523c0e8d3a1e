//! The segments of a drawing, one by one.

use super::{BlockId, Drawing, Item, Segment, StyleChange};
use crate::Heading;
use crate::turtle::Directions;

/// Iterates over a drawing's segments in drawing order. Made by [`Drawing::segments`].
#[derive(Clone, Debug)]
pub struct Segments<'a> {
    drawing: &'a Drawing,
    /// The blocks that are being read, outermost first.
    open: Vec<Frame>,
    directions: Directions,
    /// The number of segments still to come, saturating.
    left: u128,
    unit: f64,
}

/// A block that is being read, and where it lies in the root block.
#[derive(Clone, Copy, Debug)]
struct Frame {
    /// The items still to be read.
    next: u32,
    end: u32,
    at: [f64; 2],
    heading: Heading,
    /// Cosine and sine of the heading, times the scale.
    axis: (f64, f64),
    scale: f64,
    style: StyleChange,
}

impl<'a> Segments<'a> {
    pub(super) fn new(drawing: &'a Drawing) -> Self {
        let mut segments = Self {
            drawing,
            open: vec![],
            directions: Directions::new(),
            left: drawing.segment_count(),
            unit: drawing.unit(),
        };
        if let Some(root) = drawing.root {
            segments.enter(root, [0.0; 2], Heading::EAST, 1.0, StyleChange::start(drawing.width));
        }
        segments
    }

    fn enter(&mut self, block: BlockId, at: [f64; 2], heading: Heading, scale: f64, style: StyleChange) {
        let items = &self.drawing.blocks[block.0 as usize].items;
        let (c, s) = self.directions.cos_sin(heading);
        self.open.push(Frame {
            next: items.start,
            end: items.end,
            at,
            heading,
            axis: (c * scale, s * scale),
            scale,
            style,
        });
    }
}

impl Iterator for Segments<'_> {
    type Item = Segment;

    fn next(&mut self) -> Option<Segment> {
        loop {
            let frame = self.open.last_mut()?;
            if frame.next == frame.end {
                self.open.pop();
                continue;
            }
            let item = &self.drawing.items[frame.next as usize];
            frame.next += 1;
            let (c, s) = frame.axis;
            let [x, y] = frame.at;
            let lie = |[u, v]: [f64; 2]| [x + (c * u - s * v), y + (s * u + c * v)];
            match item {
                Item::Stroke(stroke) => {
                    let (start, unit) = (self.drawing.start, self.unit);
                    let model = |[x, y]: [f64; 2]| [start[0] + unit * x, start[1] + unit * y];
                    let style = frame.style.then(&self.drawing.styles[stroke.style.0 as usize]);
                    let segment = Segment {
                        from: model(lie(stroke.from)),
                        to: model(lie(stroke.to)),
                        colour: style.colour.of(0),
                        level: style.level,
                        width: style.width.of(0.0) * self.drawing.step.abs(),
                    };
                    self.left = self.left.saturating_sub(1);
                    return Some(segment);
                }
                Item::Block(placed) => {
                    let (at, heading) = (lie(placed.at), frame.heading + placed.heading);
                    let scale = frame.scale * placed.scale;
                    let style = frame.style.then(&self.drawing.styles[placed.style.0 as usize]);
                    self.enter(placed.block, at, heading, scale, style);
                }
            }
        }
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = usize::try_from(self.left);
        (left.unwrap_or(usize::MAX), left.ok())
    }
}
