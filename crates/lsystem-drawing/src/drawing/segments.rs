//! The segments of a drawing, one by one.

use super::{Drawing, Segment};
use crate::Plane;
use crate::drawing::block::{BlockId, Item, Placed, Polygon, Space, Stroke};
use crate::style::StyleChange;
use lsystem_syntax::Heading;

/// Iterates over a drawing's segments in drawing order. Made by [`Drawing::segments`].
#[derive(Clone, Debug)]
pub struct SegmentIter<'a, S: Space = Plane> {
    strokes: Strokes<'a, S>,
    /// The number of segments left; saturating.
    left: u128,
    /// As [`Drawing::unit`].
    unit: f64,
}

impl SegmentIter<'_> {
    /// The direction of the next segment, in degrees counter-clockwise from +x, in `0.0..360.0`. The direction is
    /// computed in the frame of the block: in the root's frame, rounding may reduce a short segment to a point.
    pub(super) fn heading(&self) -> Option<f64> {
        let (stroke, frame) = self.strokes.clone().next_placed()?;
        let (x, y) = (stroke.to[0] - stroke.from[0], stroke.to[1] - stroke.from[1]);
        let own = libm::atan2(y, x) * (180.0 / core::f64::consts::PI);
        Some((frame.heading + Heading::from_degrees(own)).degrees())
    }
}

impl<'a, S: Space> SegmentIter<'a, S> {
    pub(super) fn new(drawing: &'a Drawing<S>) -> Self {
        let mut strokes = Strokes::new(drawing);
        if let Some(root) = drawing.root {
            strokes.enter(root, &BlockFrame::new(1.0, StyleChange::start(drawing.width)));
        }
        Self { strokes, left: drawing.segment_count(), unit: drawing.unit() }
    }

    /// Skips the next `count` segments, and whole blocks where possible.
    pub fn pass(&mut self, count: u128) {
        self.strokes.pass(count);
        self.left = self.left.saturating_sub(count);
    }
}

impl<S: Space> Iterator for SegmentIter<'_, S> {
    type Item = Segment<S>;

    fn next(&mut self) -> Option<Segment<S>> {
        let (from, to, style) = self.strokes.next()?;
        self.left = self.left.saturating_sub(1);
        let drawing = self.strokes.drawing;
        Some(Segment::new([from, to].map(|end| drawing.model(end, self.unit)), &style, drawing.step.abs()))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = usize::try_from(self.left);
        (left.unwrap_or(usize::MAX), left.ok())
    }
}

impl<S: Space> Segment<S> {
    /// A segment between two points, in a style that began with [`StyleChange::start`]. `step`: the length of a step.
    pub(super) fn new([from, to]: [S::Point; 2], style: &StyleChange, step: f64) -> Self {
        let [width, end_width] = style.widths().ends().map(|width| width * step);
        Self { from, to, colour: style.colour.of(0), level: style.level, width, end_width }
    }
}

impl<S: Space> Drawing<S> {
    /// A point of the root block in model units; `unit` as [`Drawing::unit`].
    pub(super) fn model(&self, mut point: S::Point, unit: f64) -> S::Point {
        point.as_mut().iter_mut().zip(self.start.as_ref()).for_each(|(c, start)| *c = start + unit * *c);
        point
    }
}

/// The frame of a block in an outer frame, and the style at the block's entry.
#[derive(Clone, Copy, Debug)]
pub struct BlockFrame<S: Space = Plane> {
    /// The origin.
    pub at: S::Point,
    /// The rotation.
    pub heading: S::Turn,
    /// The length of one unit.
    pub scale: f64,
    /// The style at entry.
    pub style: StyleChange,
    /// The axes of `heading`, times `scale`.
    axes: S::Axes,
}

impl<S: Space> BlockFrame<S> {
    /// A frame at the origin without rotation.
    pub fn new(scale: f64, style: StyleChange) -> Self {
        Self { at: S::Point::default(), heading: S::AHEAD, scale, style, axes: S::scaled(S::AXES, scale) }
    }

    /// A point of the block in the outer frame.
    pub fn transform(&self, point: S::Point) -> S::Point {
        S::transform(&self.axes, self.at, point)
    }

    /// The frame of a block inside this one.
    pub fn place(&self, placed: &Placed<S>, drawing: &Drawing<S>, directions: &mut S::Directions) -> Self {
        let (heading, scale) = (S::then(self.heading, placed.heading), self.scale * placed.scale);
        Self {
            at: self.transform(placed.at),
            heading,
            scale,
            style: self.style.then(&drawing.styles[placed.style.0 as usize]),
            axes: S::scaled(S::axes(directions, heading), scale),
        }
    }
}

/// An item that is not a block.
#[derive(Clone, Copy, Debug)]
pub(super) enum ItemRef<'a, S: Space> {
    Stroke(&'a Stroke<S>),
    Polygon(&'a Polygon),
}

/// A position in a drawing, for reading its strokes and polygons. A cursor does not borrow the drawing between calls.
#[derive(Clone, Debug)]
pub(super) struct Cursor<S: Space> {
    /// The open blocks, outermost first: the first unread item, the end of the items, and the block's frame.
    open: Vec<(u32, u32, BlockFrame<S>)>,
    directions: S::Directions,
}

impl<S: Space> Cursor<S> {
    pub(super) fn new() -> Self {
        Self { open: vec![], directions: S::directions() }
    }

    /// Opens `block`, whose items come next.
    pub(super) fn enter(&mut self, drawing: &Drawing<S>, block: BlockId, frame: &BlockFrame<S>) {
        let items = &drawing.blocks[block.0 as usize].items;
        self.open.push((items.start, items.end, *frame));
    }

    /// The next stroke or polygon, and the frame of its block.
    pub(super) fn next_part<'a>(&mut self, drawing: &'a Drawing<S>) -> Option<(ItemRef<'a, S>, BlockFrame<S>)> {
        loop {
            let (next, end, frame) = self.open.last_mut()?;
            if next == end {
                self.open.pop();
                continue;
            }
            let item = &drawing.items[*next as usize];
            *next += 1;
            match item {
                Item::Stroke(stroke) => return Some((ItemRef::Stroke(stroke), *frame)),
                Item::Polygon(polygon) => return Some((ItemRef::Polygon(polygon), *frame)),
                Item::Block(placed) => {
                    let inner = frame.place(placed, drawing, &mut self.directions);
                    self.enter(drawing, placed.block, &inner);
                }
            }
        }
    }

    /// Skips the next `count` strokes, and the polygons before the stroke that is then the next one.
    pub(super) fn pass(&mut self, drawing: &Drawing<S>, count: u128) {
        self.go(drawing, count, false);
    }

    /// Skips the next `count` strokes, and then `to_stroke` what is not one.
    fn go(&mut self, drawing: &Drawing<S>, mut count: u128, to_stroke: bool) {
        while count > 0 || to_stroke {
            let Some((next, end, frame)) = self.open.last_mut() else { return };
            let items = &drawing.items[*next as usize..*end as usize];
            let (passed, left) = drawing.before(items, count);
            *next += passed as u32;
            count = left;
            match items.get(passed) {
                Some(Item::Block(placed)) => {
                    *next += 1;
                    let inner = frame.place(placed, drawing, &mut self.directions);
                    self.enter(drawing, placed.block, &inner);
                }
                Some(_) => return,
                None => {
                    self.open.pop();
                }
            }
        }
    }
}

/// The strokes of a block in drawing order: the ends in the frame of entry, and the style.
#[derive(Clone, Debug)]
pub(super) struct Strokes<'a, S: Space = Plane> {
    drawing: &'a Drawing<S>,
    cursor: Cursor<S>,
}

impl<'a, S: Space> Strokes<'a, S> {
    pub(super) fn new(drawing: &'a Drawing<S>) -> Self {
        Self { drawing, cursor: Cursor::new() }
    }

    /// Opens `block`, whose items come next.
    pub(super) fn enter(&mut self, block: BlockId, frame: &BlockFrame<S>) {
        self.cursor.enter(self.drawing, block, frame);
    }

    /// The next stroke, and the frame of its block.
    fn next_placed(&mut self) -> Option<(&'a Stroke<S>, BlockFrame<S>)> {
        // Polygons may be so many that they are never read one by one.
        self.cursor.go(self.drawing, 0, true);
        match self.next_part()? {
            (ItemRef::Stroke(stroke), frame) => Some((stroke, frame)),
            (ItemRef::Polygon(_), _) => None,
        }
    }

    /// The next stroke or polygon, and the frame of its block.
    pub(super) fn next_part(&mut self) -> Option<(ItemRef<'a, S>, BlockFrame<S>)> {
        self.cursor.next_part(self.drawing)
    }

    /// Skips the next `count` strokes.
    fn pass(&mut self, count: u128) {
        self.cursor.pass(self.drawing, count);
    }
}

impl<S: Space> Iterator for Strokes<'_, S> {
    type Item = (S::Point, S::Point, StyleChange);

    fn next(&mut self) -> Option<Self::Item> {
        let (stroke, frame) = self.next_placed()?;
        let style = frame.style.then(&self.drawing.styles[stroke.style.0 as usize]);
        Some((frame.transform(stroke.from), frame.transform(stroke.to), style))
    }
}
