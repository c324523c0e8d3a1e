//! The parts of a bottom-up picture: its blocks, distinguished by everything that makes their pictures differ. A block
//! may recur at too many places to look into each, but it recurs in few headings, scales and widths.

use crate::ink::InkTable;
use crate::plane::descent::{Descent, Node};
use crate::plane::shape::Shape;
use crate::plane::top_down::tile;
use crate::plane::view::{Measure, TINY};
use core::hash::BuildHasherDefault;
use core::ops::Range;
use lsystem_base::Mixer;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{BlockId, Drawing, Item, Widths};
use lsystem_syntax::Heading;
use std::collections::{BinaryHeap, HashMap};

/// The facts that parts are made from.
#[derive(Clone, Copy)]
pub(in crate::plane) struct PartSource<'a> {
    pub drawing: &'a Drawing,
    pub shapes: &'a [Shape],
    pub inks: &'a InkTable,
}

impl PartSource<'_> {
    /// The bit planes of a part's picture.
    pub(in crate::plane) fn planes(&self, part: &Part) -> usize {
        self.inks.planes(self.inks.of(part.block.0 as usize))
    }
}

/// The most parts of a picture.
const MAX_PARTS: usize = 20_000;
/// The most items in all parts.
const MAX_ITEMS: usize = 200_000;
/// The most subsamples in a unit of the root block, so that cells are exact integers.
const LARGEST_SCALE: f64 = (1_u64 << 32) as f64;

/// A block at one heading, scale and width.
#[derive(Clone, Debug)]
pub(in crate::plane) struct Part {
    pub block: BlockId,
    pub heading: Heading,
    /// Subsamples in one unit of the block.
    pub scale: f64,
    pub widths: Widths,
    /// The indices of its joints, the last item's first.
    pub joints: Range<usize>,
    /// The upper left and the lower right corner of the area it covers, from its origin in subsamples.
    pub bounds: [[f64; 2]; 2],
}

/// A place where a part contains another.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Joint {
    /// The index of the item in the drawing.
    pub item: u32,
    /// The index of the inner part.
    pub part: usize,
    /// The offset from the outer to the inner origin, in subsamples.
    pub at: [f64; 2],
}

/// Everything that a part's picture depends on: block, heading, scale, and the width if it is wider than a hairline.
type PartKey = (BlockId, Heading, u64, Option<[u64; 2]>);

/// The parts of a picture.
#[derive(Default)]
pub(in crate::plane) struct Parts {
    pub list: Vec<Part>,
    pub joints: Vec<Joint>,
    /// The parts looked into. A part comes before all parts inside it, and the first is the whole drawing.
    pub order: Vec<usize>,
    known: HashMap<PartKey, usize, BuildHasherDefault<Mixer>>,
    /// The parts not looked into yet. A block has a larger number than the blocks inside, so outer parts come first.
    waiting: BinaryHeap<(BlockId, Heading, usize)>,
    /// The part that is being looked into.
    opened: Option<OpenPart>,
    /// The number of items in all parts looked into.
    items: usize,
}

/// A part that is being looked into, from its last item on.
#[derive(Clone, Copy)]
struct OpenPart {
    index: usize,
    node: Node,
    /// The index of its first joint.
    first: usize,
}

impl Parts {
    /// Starts with the whole drawing; `None` if the drawing is too large.
    pub(in crate::plane) fn new(drawing: &Drawing, shapes: &[Shape], measure: Measure, root: Node) -> Option<Self> {
        let mut parts = Self::default();
        parts.find(drawing, shapes, measure, root);
        (root.place.scale < LARGEST_SCALE).then_some(parts)
    }

    /// Looks into parts; `None` if there are too many.
    pub(in crate::plane) fn step(
        &mut self,
        scene: PartSource<'_>,
        measure: Measure,
        descent: &mut Descent,
        meter: &mut Meter,
    ) -> Option<Progress> {
        let PartSource { drawing, shapes, inks } = scene;
        while !meter.is_spent() {
            if self.opened.is_none() {
                let Some((block, _, index)) = self.waiting.pop() else { return Some(Progress::Done) };
                self.items += drawing.items_of(block).len();
                if self.list.len() > MAX_PARTS || self.items > MAX_ITEMS {
                    return None;
                }
                let node = descent.part(drawing, &self.list[index], [0.0; 2], 1.0);
                self.opened = Some(OpenPart { index, node, first: self.joints.len() });
            }
            let Some(opened) = &mut self.opened else { continue };
            let OpenPart { index, node, first } = *opened;
            if node.cursor == drawing.blocks[node.block.0 as usize].items.start {
                self.list[index].joints = first..self.joints.len();
                self.order.push(index);
                self.opened = None;
                continue;
            }
            opened.node.cursor -= 1;
            let item = opened.node.cursor;
            meter.charge(2);
            if let Item::Block(placed) = &drawing.items[item as usize] {
                let child = descent.child(drawing, inks.choice, &node, placed);
                let shape = &shapes[placed.block.0 as usize];
                if shape.strokes > 0 && shape.line.is_none() && shape.extent(child.place.scale) > TINY {
                    let part = self.find(drawing, shapes, measure, child);
                    self.joints.push(Joint { item, part, at: child.place.origin });
                    meter.charge(2);
                }
            }
        }
        Some(Progress::More)
    }

    /// The index of the part that a block is, which is added if it is new.
    fn find(&mut self, drawing: &Drawing, shapes: &[Shape], measure: Measure, node: Node) -> usize {
        let Node { block, place, pen, .. } = node;
        let radius = measure.widest(&drawing.blocks[block.0 as usize], pen);
        let width = measure.is_wide(radius).then_some(pen.widths.key());
        let index = self.list.len();
        let found = *self.known.entry((block, place.heading, tile::scale(place.scale), width)).or_insert(index);
        if found == index {
            let (centre, reach) = place.bounds(&shapes[block.0 as usize], radius);
            let bounds =
                [-1.0, 1.0].map(|sign| [0, 1].map(|axis| centre[axis] + sign * reach[axis] - place.origin[axis]));
            let (heading, scale, widths) = (place.heading, place.scale, pen.widths);
            self.list.push(Part { block, heading, scale, widths, joints: 0..0, bounds });
            self.waiting.push((block, heading, index));
        }
        found
    }
}
