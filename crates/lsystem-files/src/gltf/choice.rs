//! The choice of the blocks that a scene writes once and places.

use lsystem_drawing::{BlockId, Drawing, Item, Solid};
use lsystem_syntax::{Meter, Progress};

/// The fewest segments and polygons of a drawing with placed parts: the file of a smaller drawing is small without them,
/// and its tubes taper across all joints.
const SMALL: u128 = 2_000;
/// The least size of a placed part, in segments and polygons. A part of fewer takes viewers as long as this one.
const LEAST: u128 = 64;
/// The most nodes of a scene. Viewers draw each node by itself, and more than some thousands take longer than a frame of
/// a film.
const MOST_NODES: u64 = 4_000;
/// The bytes of a node, and of a segment or polygon: means of files.
const NODE_BYTES: u64 = 110;
const MARK_BYTES: u64 = 600;

/// A search for the size of parts with the smallest file.
#[derive(Clone, Debug)]
pub(super) struct Choice {
    root: BlockId,
    all: u128,
    /// The size being tried: blocks of at most this many segments and polygons are parts.
    size: u128,
    /// By block, as far as read: the nodes and the marks outside parts; and whether the block is a part in use.
    nodes: Vec<u64>,
    loose: Vec<u64>,
    used: Vec<bool>,
    /// The segments and polygons of the parts in use.
    parts: u64,
    /// The bytes of the smallest file so far, and its size of parts; 0 for no parts.
    best: Option<(u64, u128)>,
}

impl Choice {
    /// A search. A file may have at most `most` segments and polygons that are written out. `None` if no parts are
    /// placed.
    pub(super) fn new(drawing: &Drawing<Solid>, most: u64) -> Option<Self> {
        let root = drawing.root?;
        let all = drawing.segment_count().saturating_add(drawing.polygon_count());
        if !drawing.is_memoised() || all <= SMALL {
            return None;
        }
        let flat = u64::try_from(all).ok().filter(|&all| all <= most);
        let best = flat.map(|all| (all.saturating_mul(MARK_BYTES), 0));
        let (nodes, loose) = (vec![], vec![]);
        let used = vec![false; drawing.block_count()];
        Some(Self { root, all, size: LEAST, nodes, loose, used, parts: 0, best })
    }

    /// The best size of parts, after all steps; 0 for no parts.
    pub(super) fn best(&self) -> u128 {
        self.best.map_or(0, |(_, size)| size)
    }

    /// Continues until the meter is spent.
    pub(super) fn step(&mut self, drawing: &Drawing<Solid>, meter: &mut Meter) -> Progress {
        while self.size < self.all {
            if meter.is_spent() {
                return Progress::More;
            }
            let block = BlockId(self.nodes.len() as u32);
            if block <= self.root {
                meter.charge(2 + drawing.items_of(block).len() as u64 / 4);
                self.read(drawing, block);
            } else {
                self.compare();
            }
        }
        Progress::Done
    }

    /// Reads the next block.
    fn read(&mut self, drawing: &Drawing<Solid>, block: BlockId) {
        let (mut nodes, mut loose) = (0_u64, 0_u64);
        if block == self.root || marks(drawing, block) > self.size {
            for item in drawing.items_of(block) {
                let Item::Block(placed) = item else {
                    loose = loose.saturating_add(1);
                    continue;
                };
                let (inner, count) = (placed.block.0 as usize, marks(drawing, placed.block));
                if count <= self.size && !core::mem::replace(&mut self.used[inner], true) {
                    self.parts = self.parts.saturating_add(count as u64);
                }
                nodes = nodes.saturating_add(self.nodes[inner]);
                loose = loose.saturating_add(self.loose[inner]);
            }
        } else {
            nodes = 1;
        }
        self.nodes.push(nodes);
        self.loose.push(loose);
    }

    /// Compares the size with the best one, and begins the next.
    fn compare(&mut self) {
        let root = self.root.0 as usize;
        let (nodes, marks) = (self.nodes[root], self.parts.saturating_add(self.loose[root]));
        let bytes = nodes.saturating_mul(NODE_BYTES).saturating_add(marks.saturating_mul(MARK_BYTES));
        if nodes <= MOST_NODES && self.best.is_none_or(|(best, _)| bytes < best) {
            self.best = Some((bytes, self.size));
        }
        self.size *= 2;
        self.parts = 0;
        self.nodes.clear();
        self.loose.clear();
        self.used.fill(false);
    }
}

/// The number of segments and polygons of a block.
fn marks(drawing: &Drawing<Solid>, block: BlockId) -> u128 {
    let block = &drawing.blocks[block.0 as usize];
    block.segments.saturating_add(block.polygons)
}
