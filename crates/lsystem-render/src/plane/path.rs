//! Colours along the path: which part of all segments a block is.
//!
//! A block recurs at many places of the path, so its tiles know nothing of them: on the picture every block that is
//! shorter than a step of the gradient is in the colour of its middle, and longer ones are looked into.

use super::amount::Amount;
use super::sweep::{Fact, Sweep};
use lsystem_drawing::{Block, BlockId, Drawing, Item};
use lsystem_syntax::style::{gradient_step, is_one_step};
use lsystem_syntax::{ColourBy, Meter, Progress, Style};

/// A part of the path, as parts of the whole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    pub end: f64,
    pub size: f64,
}

impl Span {
    pub(super) const WHOLE: Self = Self { end: 1.0, size: 1.0 };

    /// The number of its colour.
    pub(super) fn ink(self) -> u32 {
        gradient_step(self.end - 0.5 * self.size)
    }

    pub(super) fn is_short(self) -> bool {
        is_one_step(self.size)
    }
}

/// How many segments blocks have, beyond what integers hold.
#[derive(Debug, Default)]
pub(super) struct Path {
    /// By block; empty where colours follow something else.
    counts: Vec<Amount>,
    place: Sweep,
    /// Of the block in hand.
    sum: Amount,
}

impl Path {
    /// Forgets the drawing there was.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Counts, where colours follow the path, until that is done.
    pub(super) fn prepare(&mut self, drawing: &Drawing, style: &Style, meter: &mut Meter) -> Progress {
        if style.colour_by != ColourBy::Path {
            self.clear();
            return Progress::Done;
        }
        let mut place = self.place;
        let progress = place.step(self, drawing, meter);
        self.place = place;
        progress
    }

    /// Whether colours follow the path.
    pub(super) fn counts(&self) -> bool {
        !self.counts.is_empty()
    }

    /// The last segment of what is left of a block.
    pub(super) fn stroke(&self, block: BlockId, left: Span) -> Span {
        Span { size: self.part(block, left, Amount::ONE), ..left }
    }

    /// The last block of what is left of a block.
    pub(super) fn block(&self, block: BlockId, left: Span, last: BlockId) -> Span {
        let count = self.counts.get(last.0 as usize).copied().unwrap_or_default();
        Span { size: self.part(block, left, count), ..left }
    }

    /// How large an item of a block is.
    pub(super) fn size(&self, block: BlockId, span: Span, item: &Item) -> f64 {
        match item {
            Item::Stroke(_) => self.stroke(block, span).size,
            Item::Polygon(_) => 0.0,
            Item::Block(placed) => self.block(block, span, placed.block).size,
        }
    }

    fn part(&self, block: BlockId, span: Span, count: Amount) -> f64 {
        let all = self.counts.get(block.0 as usize).copied().unwrap_or_default();
        span.size * count.of(all)
    }
}

impl Fact for Path {
    fn item(&mut self, _: &Drawing, _: usize, _: usize, item: &Item) -> u64 {
        match item {
            Item::Stroke(_) => self.sum = self.sum.plus(Amount::ONE),
            Item::Polygon(_) => {}
            Item::Block(placed) => self.sum = self.sum.plus(self.counts[placed.block.0 as usize]),
        }
        1
    }

    fn close(&mut self, _: &Drawing, _: &Block) -> u64 {
        self.counts.push(core::mem::take(&mut self.sum));
        0
    }
}
