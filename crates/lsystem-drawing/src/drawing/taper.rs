//! Tapered strokes: a stroke runs from its own width to the width with which its branch goes on.
//!
//! The width at a stroke's far end is known only when the next stroke of its branch is drawn, so the last item of each
//! open branch waits for it. The last stroke of a piece waits for what follows the piece, and takes the width from where
//! the piece is placed ([`StyleChange::next`]): pieces stay shared.

use super::block::{Block, Item, Space};
use crate::chunks::Chunks;
use crate::room::{bytes_of, reserve};
use crate::style::{StyleId, Styles, WidthChange};

/// The first and the last thing of a piece on its own branch, without the branches inside.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Flow {
    lead: Lead,
    /// The width change of the last stroke, if nothing follows it.
    trail: Option<WidthChange>,
}

/// The first thing on a branch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Lead {
    /// Neither a stroke nor a move.
    #[default]
    Nothing,
    /// A move: the branch is interrupted.
    Gap,
    /// A stroke with this width change.
    Stroke(WidthChange),
}

/// An item whose last stroke waits for the next stroke of its branch.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    /// The number of branches around its own.
    depth: usize,
    place: ItemPlace,
    /// The width change of that stroke.
    width: WidthChange,
}

/// The place of an item of a tree.
#[derive(Clone, Copy, Debug)]
enum ItemPlace {
    /// The index in the tree's buffer.
    Buffer(usize),
    /// The number in the builder's list: the item is in a finished block.
    Made(u32),
}

/// The items of a tree that wait for the width at their ends.
#[derive(Clone, Debug)]
pub(crate) struct Taper {
    /// The items that wait, at most one of each open branch, outermost first: in the order of the items.
    waiting: Vec<Waiting>,
    /// The number of open branches.
    depth: usize,
    lead: Lead,
    /// The number of the first block with items that waited.
    first: Option<usize>,
    /// A bound on the widths that finished blocks got later and that may exceed their own.
    wider: Option<WidthChange>,
}

/// The lists that hold the items and their styles.
pub(super) struct TaperItems<'a, S: Space> {
    pub buffer: &'a mut [Item<S>],
    pub made: &'a mut Chunks<Item<S>>,
    pub styles: &'a mut Styles,
}

impl Taper {
    pub(super) fn new() -> Self {
        Self { waiting: vec![], depth: 0, lead: Lead::Nothing, first: None, wider: None }
    }

    /// The bytes that the waiting items occupy.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.waiting)
    }

    /// Opens a branch.
    pub(super) fn open(&mut self) {
        self.depth += 1;
    }

    /// Ends a branch: nothing follows its last stroke.
    pub(super) fn close<S: Space>(&mut self, items: &mut TaperItems<'_, S>) {
        self.settle(None, items);
        self.depth = self.depth.saturating_sub(1);
    }

    /// A stroke of the branch, at this place of the buffer.
    pub(super) fn stroke<S: Space>(&mut self, width: WidthChange, index: usize, items: &mut TaperItems<'_, S>) {
        self.meet(Lead::Stroke(width), items);
        self.wait(width, index);
    }

    /// A move: what follows does not touch the last stroke.
    pub(super) fn gap<S: Space>(&mut self, items: &mut TaperItems<'_, S>) {
        self.meet(Lead::Gap, items);
    }

    /// A piece that is entered with the width change `entry`; `index`: the place of its block in the buffer.
    pub(super) fn piece<S: Space>(
        &mut self,
        flow: &Flow,
        entry: WidthChange,
        index: usize,
        items: &mut TaperItems<'_, S>,
    ) {
        match flow.lead {
            Lead::Nothing => return,
            Lead::Gap => self.meet(Lead::Gap, items),
            Lead::Stroke(width) => self.meet(Lead::Stroke(entry.then(width)), items),
        }
        if let Some(width) = flow.trail {
            self.wait(entry.then(width), index);
        }
    }

    /// Ends all branches: nothing follows.
    pub(super) fn end<S: Space>(&mut self, items: &mut TaperItems<'_, S>) {
        while let Some(waiting) = self.waiting.last() {
            self.depth = waiting.depth;
            self.settle(None, items);
        }
    }

    /// The ends of a piece with these items, as its surroundings see them.
    pub(super) fn flow(&self) -> Flow {
        let trail = self.waiting.first().filter(|waiting| waiting.depth == 0);
        Flow { lead: self.lead, trail: trail.map(|waiting| waiting.width) }
    }

    /// Notes that the items of the buffer from `from` on, as far as they are not hollow, became the items of `block`
    /// from `number` on.
    pub(super) fn moved<S: Space>(&mut self, buffer: &[Item<S>], from: usize, number: u32, block: usize) {
        for waiting in self.waiting.iter_mut().rev() {
            let ItemPlace::Buffer(index) = waiting.place else { return };
            let Some(before) = index.checked_sub(from) else { return };
            if let Some(passed) = buffer.get(from..index) {
                let hollow = passed.iter().filter(|item| item.is_hollow()).count();
                waiting.place = ItemPlace::Made(number + (before - hollow) as u32);
                self.first.get_or_insert(block);
            }
        }
    }

    /// Widens the blocks whose strokes got ends wider than all strokes inside.
    pub(super) fn widen<S: Space>(&self, blocks: &mut [Block<S>]) {
        if let (Some(first), Some(wider)) = (self.first, self.wider) {
            blocks[first..].iter_mut().for_each(|block| block.widest = block.widest.widest(wider));
        }
    }

    /// Notes the next thing on the innermost branch.
    fn meet<S: Space>(&mut self, lead: Lead, items: &mut TaperItems<'_, S>) {
        if self.depth == 0 && self.lead == Lead::Nothing {
            self.lead = lead;
        }
        self.settle(if let Lead::Stroke(width) = lead { Some(width) } else { None }, items);
    }

    fn wait(&mut self, width: WidthChange, index: usize) {
        reserve(&mut self.waiting, 1);
        self.waiting.push(Waiting { depth: self.depth, place: ItemPlace::Buffer(index), width });
    }

    /// Gives the item that waits on the innermost branch the width of what follows, or its own.
    fn settle<S: Space>(&mut self, next: Option<WidthChange>, items: &mut TaperItems<'_, S>) {
        let Some(Waiting { place, width, .. }) = self.waiting.pop_if(|waiting| waiting.depth == self.depth) else {
            return;
        };
        let next = next.unwrap_or(width);
        let item = match place {
            ItemPlace::Buffer(index) => items.buffer.get_mut(index),
            ItemPlace::Made(number) => {
                if next.factor > width.factor || next.offset > width.offset {
                    self.wider = Some(self.wider.map_or(next, |wider| wider.widest(next)));
                }
                items.made.get_mut(number as usize)
            }
        };
        let mut set = |style: &mut StyleId| {
            let own = items.styles.list[style.0 as usize];
            *style = items.styles.id(&crate::StyleChange { next: Some(next), ..own });
        };
        match item {
            Some(Item::Stroke(stroke)) => set(&mut stroke.style),
            Some(Item::Block(placed)) => set(&mut placed.style),
            Some(Item::Polygon(_)) | None => {}
        }
    }
}
