//! The marks of a drawing in space, for meshes: small blocks may stay whole.

use super::block::{BlockId, Item};
use super::{Drawing, Frame, Mark, Segment};
use crate::Solid;
use crate::rotation::Vector;
use crate::style::StyleChange;
use lsystem_syntax::Tint;

/// A mark, or a block that stays whole.
#[derive(Clone, Debug)]
pub(crate) enum SolidMark {
    /// A segment or a polygon.
    Mark(Mark<Solid>),
    /// A block, and its frame in units of the root block.
    Whole(BlockId, Frame<Solid>),
}

/// Reads the marks of a drawing or of a block. The reader does not borrow the drawing between calls.
#[derive(Clone, Debug)]
pub(crate) struct SolidReader {
    /// The open blocks, outermost first: the first unread item, the end of the items, and the block's frame.
    open: Vec<(u32, u32, Frame<Solid>)>,
    /// Blocks with at most this many segments and polygons stay whole.
    whole: u128,
    /// The number of segments passed so far.
    segments: u128,
    /// The number of segments and polygons passed so far.
    marks: u128,
    /// The number of segments of the drawing.
    all: f64,
    /// As [`Drawing::unit`].
    unit: f64,
    /// The origin of the outermost frame, in model units.
    start: Vector,
}

impl SolidReader {
    /// A reader at the first mark of a drawing. Blocks with at most `whole` segments and polygons stay whole.
    pub(crate) fn new(drawing: &Drawing<Solid>, whole: u128) -> Self {
        let (all, unit, start) = (drawing.segment_count() as f64, drawing.unit(), drawing.start);
        let mut reader = Self { open: vec![], whole, segments: 0, marks: 0, all, unit, start };
        if let Some(root) = drawing.root {
            reader.enter(drawing, root, &Frame::new(1.0, StyleChange::start(drawing.width)));
        }
        reader
    }

    /// A reader at the first mark of a block. The block's origin becomes the model's origin.
    pub(crate) fn within(drawing: &Drawing<Solid>, block: BlockId, frame: &Frame<Solid>) -> Self {
        let mut reader = Self { open: vec![], start: [0.0; 3], ..Self::new(drawing, 0) };
        reader.enter(drawing, block, frame);
        reader
    }

    fn enter(&mut self, drawing: &Drawing<Solid>, block: BlockId, frame: &Frame<Solid>) {
        let items = &drawing.blocks[block.0 as usize].items;
        self.open.push((items.start, items.end, *frame));
    }

    /// The next mark or whole block. Every call needs the same drawing.
    pub(crate) fn next(&mut self, drawing: &Drawing<Solid>) -> Option<SolidMark> {
        loop {
            let (next, end, frame) = self.open.last_mut()?;
            if next == end {
                self.open.pop();
                continue;
            }
            let (item, frame) = (&drawing.items[*next as usize], *frame);
            *next += 1;
            let style = |id: crate::style::StyleId| frame.style.then(&drawing.styles[id.0 as usize]);
            match item {
                Item::Stroke(stroke) => {
                    let ends = [stroke.from, stroke.to].map(|end| frame.transform(end));
                    let [from, to] = ends.map(|end| self.model(end));
                    let style = style(stroke.style);
                    let tint = self.tint(drawing, &style);
                    let width = style.width.of(0.0) * drawing.step.abs();
                    self.pass(1, 0);
                    let segment = Segment { from, to, colour: tint.index, level: tint.level, width };
                    return Some(SolidMark::Mark(Mark::Segment(segment, tint)));
                }
                Item::Polygon(polygon) => {
                    let tint = self.tint(drawing, &style(polygon.style));
                    let vertices = drawing.vertices_of(polygon).iter();
                    let vertices = vertices.map(|&vertex| self.model(frame.transform(vertex))).collect();
                    self.pass(0, 1);
                    return Some(SolidMark::Mark(Mark::Polygon(vertices, tint)));
                }
                Item::Block(placed) => {
                    let inner = frame.place(placed, drawing, &mut ());
                    let block = &drawing.blocks[placed.block.0 as usize];
                    if block.segments.saturating_add(block.polygons) <= self.whole {
                        self.pass(block.segments, block.polygons);
                        return Some(SolidMark::Whole(placed.block, inner));
                    }
                    self.enter(drawing, placed.block, &inner);
                }
            }
        }
    }

    fn pass(&mut self, segments: u128, polygons: u128) {
        self.segments = self.segments.saturating_add(segments);
        self.marks = self.marks.saturating_add(segments).saturating_add(polygons);
    }

    fn model(&self, point: Vector) -> Vector {
        [0, 1, 2].map(|i| self.start[i] + self.unit * point[i])
    }

    fn tint(&self, drawing: &Drawing<Solid>, style: &StyleChange) -> Tint {
        let own = if self.all > 0.0 { ((self.segments as f64 + 0.5) / self.all).min(1.0) } else { 0.0 };
        let place = usize::try_from(self.marks).ok().and_then(|mark| drawing.places.get(mark)).copied();
        Tint { index: style.colour.of(0), level: style.level, place: place.unwrap_or(own) }
    }
}
