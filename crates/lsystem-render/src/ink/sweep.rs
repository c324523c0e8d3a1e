//! Visits all blocks of a drawing in steps: block after block, item after item.

use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Block, Drawing, Item};

/// The item that is visited next, as indices.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sweep {
    block: usize,
    pass: usize,
    item: usize,
}

/// Collects facts about each block, children before parents.
pub(crate) trait BlockVisitor {
    /// How often the items of a block are visited.
    const PASSES: usize = 1;

    /// Visits the item with this number (0-based) in the block. Returns the units of work.
    fn item(&mut self, drawing: &Drawing, pass: usize, number: usize, item: &Item) -> u64;

    /// Ends a block. Returns the units of work.
    fn close(&mut self, drawing: &Drawing, block: &Block) -> u64;
}

impl Sweep {
    /// Goes on until all blocks are done or the meter is spent.
    pub(crate) fn step<V: BlockVisitor>(&mut self, visitor: &mut V, drawing: &Drawing, meter: &mut Meter) -> Progress {
        while let Some(block) = drawing.blocks.get(self.block) {
            let items = drawing.contents(block);
            while self.pass < V::PASSES {
                while let Some(item) = items.get(self.item) {
                    if meter.is_spent() {
                        return Progress::More;
                    }
                    meter.charge(visitor.item(drawing, self.pass, self.item, item));
                    self.item += 1;
                }
                (self.pass, self.item) = (self.pass + 1, 0);
            }
            if meter.is_spent() {
                return Progress::More;
            }
            meter.charge(1 + visitor.close(drawing, block));
            *self = Self { block: self.block + 1, ..Self::default() };
        }
        Progress::Done
    }
}
