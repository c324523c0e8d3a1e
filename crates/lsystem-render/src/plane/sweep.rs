//! Facts about the blocks of a drawing, found in steps: block after block, item after item.

use lsystem_drawing::{Block, Drawing, Item};
use lsystem_syntax::{Meter, Progress};

/// How far a sweep is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sweep {
    block: usize,
    pass: usize,
    item: usize,
}

/// What is found out about each block, children before parents.
pub(super) trait Fact {
    /// How often the items of a block are looked at.
    const PASSES: usize = 1;

    /// Looks at the item with this number in the block; the units of work that this took.
    fn item(&mut self, drawing: &Drawing, pass: usize, number: usize, item: &Item) -> u64;

    /// Ends a block; the units of work that this took.
    fn close(&mut self, drawing: &Drawing, block: &Block) -> u64;
}

impl Sweep {
    /// Goes on until all blocks are done or the meter is spent.
    pub(super) fn step<F: Fact>(&mut self, fact: &mut F, drawing: &Drawing, meter: &mut Meter) -> Progress {
        while let Some(block) = drawing.blocks.get(self.block) {
            let items = drawing.contents(block);
            while self.pass < F::PASSES {
                while let Some(item) = items.get(self.item) {
                    if meter.is_spent() {
                        return Progress::More;
                    }
                    meter.charge(fact.item(drawing, self.pass, self.item, item));
                    self.item += 1;
                }
                (self.pass, self.item) = (self.pass + 1, 0);
            }
            if meter.is_spent() {
                return Progress::More;
            }
            meter.charge(1 + fact.close(drawing, block));
            *self = Self { block: self.block + 1, ..Self::default() };
        }
        Progress::Done
    }
}
