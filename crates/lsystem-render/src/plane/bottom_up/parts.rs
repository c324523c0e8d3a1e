//! Which parts a picture is made of: its blocks, told apart by whatever makes their pictures differ. What recurs at far
//! too many places to look into each of them still recurs in few ways.

use crate::plane::descent::{Descent, Node};
use crate::plane::inks::InkTable;
use crate::plane::mixer::Mixer;
use crate::plane::shape::Shape;
use crate::plane::top_down::tile;
use crate::plane::view::{Measure, TINY};
use core::hash::BuildHasherDefault;
use core::ops::Range;
use lsystem_drawing::{BlockId, Drawing, Item};
use lsystem_syntax::{Heading, Meter, Progress};
use std::collections::{BinaryHeap, HashMap};

/// What a picture is made of.
#[derive(Clone, Copy)]
pub(in crate::plane) struct Scene<'a> {
    pub drawing: &'a Drawing,
    pub shapes: &'a [Shape],
    pub inks: &'a InkTable,
}

impl Scene<'_> {
    /// The bit planes of a part's picture.
    pub(in crate::plane) fn planes(&self, part: &Part) -> usize {
        self.inks.planes(self.inks.of(part.block.0 as usize))
    }
}

/// The most parts, and the most items in all of them.
const MOST: [usize; 2] = [20_000, 200_000];
/// The most subsamples in a unit of the root block: places are integers here, with room to spare.
const LARGEST: f64 = (1_u64 << 32) as f64;

/// A block as it is in some places of the picture.
#[derive(Clone, Debug)]
pub(in crate::plane) struct Part {
    pub block: BlockId,
    pub heading: Heading,
    /// Subsamples in one of its units.
    pub scale: f64,
    /// The width at entry, in step lengths.
    pub width: f64,
    /// Where it contains others, last first.
    pub joints: Range<usize>,
    /// What it covers, from its origin in subsamples: the upper left and the lower right corner.
    pub bounds: [[f64; 2]; 2],
}

/// Where a part contains another.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Joint {
    /// Which of the drawing's items.
    pub item: u32,
    /// Which of the parts.
    pub part: usize,
    /// From one origin to the other, in subsamples.
    pub at: [f64; 2],
}

/// All that a part's picture depends on: as for tiles, which also depend on where they are.
type Key = (BlockId, Heading, u64, Option<u64>);

/// The parts of a picture.
#[derive(Default)]
pub(in crate::plane) struct Parts {
    pub list: Vec<Part>,
    pub joints: Vec<Joint>,
    /// Those looked into: a part comes before all that are inside it, and the first is the whole drawing.
    pub order: Vec<usize>,
    known: HashMap<Key, usize, BuildHasherDefault<Mixer>>,
    /// Those found and not looked into. Blocks have larger numbers than those inside them.
    waiting: BinaryHeap<(BlockId, Heading, usize)>,
    /// The one that is looked into.
    opened: Option<Opened>,
    /// Items looked at.
    items: usize,
}

/// A part that is looked into, from its last item on.
#[derive(Clone, Copy)]
struct Opened {
    index: usize,
    node: Node,
    /// The first of its joints.
    first: usize,
}

impl Parts {
    /// Starts with the whole drawing; `None` where it is too large.
    pub(in crate::plane) fn new(drawing: &Drawing, shapes: &[Shape], measure: Measure, root: Node) -> Option<Self> {
        let mut parts = Self::default();
        parts.find(drawing, shapes, measure, root);
        (root.place.scale < LARGEST).then_some(parts)
    }

    /// Looks into parts; `None` where there are too many.
    pub(in crate::plane) fn step(
        &mut self,
        scene: Scene<'_>,
        measure: Measure,
        descent: &mut Descent,
        meter: &mut Meter,
    ) -> Option<Progress> {
        let Scene { drawing, shapes, inks } = scene;
        while !meter.is_spent() {
            if self.opened.is_none() {
                let Some((block, _, index)) = self.waiting.pop() else { return Some(Progress::Done) };
                self.items += drawing.items_of(block).len();
                if [self.list.len(), self.items].into_iter().zip(MOST).any(|(count, most)| count > most) {
                    return None;
                }
                let node = descent.alone(drawing, &self.list[index], [0.0; 2], 1.0);
                self.opened = Some(Opened { index, node, first: self.joints.len() });
            }
            let Some(opened) = &mut self.opened else { continue };
            let Opened { index, node, first } = *opened;
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

    /// The part that a block is.
    fn find(&mut self, drawing: &Drawing, shapes: &[Shape], measure: Measure, node: Node) -> usize {
        let Node { block, place, pen, .. } = node;
        let radius = measure.widest(&drawing.blocks[block.0 as usize], pen.width);
        let width = measure.is_wide(radius).then_some(pen.width.to_bits());
        let index = self.list.len();
        let found = *self.known.entry((block, place.heading, tile::scale(place.scale), width)).or_insert(index);
        if found == index {
            let (centre, reach) = place.bounds(&shapes[block.0 as usize], radius);
            let bounds =
                [-1.0, 1.0].map(|sign| [0, 1].map(|axis| centre[axis] + sign * reach[axis] - place.origin[axis]));
            let (heading, scale, width) = (place.heading, place.scale, pen.width);
            self.list.push(Part { block, heading, scale, width, joints: 0..0, bounds });
            self.waiting.push((block, heading, index));
        }
        found
    }
}
