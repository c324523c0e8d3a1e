//! The marks of a drawing in space, for meshes: small blocks may stay whole.

use super::block::{BlockId, Item};
use super::{BlockFrame, Drawing, Mark, Segment};
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
    Whole(BlockId, BlockFrame<Solid>),
}

/// Reads the marks of a drawing or of a block.
pub(crate) struct SolidReader<'a> {
    drawing: &'a Drawing<Solid>,
    /// The open blocks, outermost first: the items that remain, and the block's frame.
    open: Vec<(core::slice::Iter<'a, Item<Solid>>, BlockFrame<Solid>)>,
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

impl<'a> SolidReader<'a> {
    /// A reader at the first mark of a drawing. Blocks with at most `whole` segments and polygons stay whole.
    pub(crate) fn new(drawing: &'a Drawing<Solid>, whole: u128) -> Self {
        let (all, unit, start) = (drawing.segment_count() as f64, drawing.unit(), drawing.start);
        let mut reader = Self { drawing, open: vec![], whole, segments: 0, marks: 0, all, unit, start };
        if let Some(root) = drawing.root {
            reader.enter(root, &BlockFrame::new(1.0, StyleChange::start(drawing.width)));
        }
        reader
    }

    /// A reader at the first mark of a block. The block's origin becomes the model's origin.
    pub(crate) fn within(drawing: &'a Drawing<Solid>, block: BlockId, frame: &BlockFrame<Solid>) -> Self {
        let mut reader = Self { open: vec![], start: [0.0; 3], ..Self::new(drawing, 0) };
        reader.enter(block, frame);
        reader
    }

    fn enter(&mut self, block: BlockId, frame: &BlockFrame<Solid>) {
        self.open.push((self.drawing.items_of(block).iter(), *frame));
    }

    fn pass(&mut self, segments: u128, polygons: u128) {
        self.segments = self.segments.saturating_add(segments);
        self.marks = self.marks.saturating_add(segments).saturating_add(polygons);
    }

    fn model(&self, point: Vector) -> Vector {
        [0, 1, 2].map(|i| self.start[i] + self.unit * point[i])
    }

    fn tint(&self, style: &StyleChange) -> Tint {
        let own = if self.all > 0.0 { ((self.segments as f64 + 0.5) / self.all).min(1.0) } else { 0.0 };
        let place = usize::try_from(self.marks).ok().and_then(|mark| self.drawing.places.get(mark)).copied();
        Tint { index: style.colour.of(0), level: style.level, place: place.unwrap_or(own) }
    }
}

impl Iterator for SolidReader<'_> {
    type Item = SolidMark;

    fn next(&mut self) -> Option<SolidMark> {
        let drawing = self.drawing;
        loop {
            let (items, frame) = self.open.last_mut()?;
            let Some(item) = items.next() else {
                self.open.pop();
                continue;
            };
            let frame = *frame;
            let style = |id: crate::style::StyleId| frame.style.then(&drawing.styles[id.0 as usize]);
            match item {
                Item::Stroke(stroke) => {
                    let ends = [stroke.from, stroke.to].map(|end| frame.transform(end));
                    let [from, to] = ends.map(|end| self.model(end));
                    let style = style(stroke.style);
                    let tint = self.tint(&style);
                    let [width, end_width] = style.widths().ends().map(|width| width * drawing.step.abs());
                    self.pass(1, 0);
                    let segment = Segment { from, to, colour: tint.index, level: tint.level, width, end_width };
                    return Some(SolidMark::Mark(Mark::Segment(segment, tint)));
                }
                Item::Polygon(polygon) => {
                    let tint = self.tint(&style(polygon.style));
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
                    self.enter(placed.block, &inner);
                }
            }
        }
    }
}
