//! Colours along the path: the position of a block among all segments.
//!
//! A block recurs at many positions of the path, so tiles hold no path colours. On the picture a block that is shorter
//! than a step of the gradient has the colour of its middle. A longer block is looked into.

use crate::ink::Amount;
use crate::ink::{BlockVisitor, Sweep};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Block, BlockId, Drawing, Item};
use lsystem_syntax::Style;
use lsystem_syntax::style::{gradient_step, is_one_step};

/// A part of the path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    /// The end, as a part of the whole path: 0 to 1.
    pub end: f64,
    /// The length, as a part of the whole path.
    pub size: f64,
}

impl Span {
    pub(super) const WHOLE: Self = Self { end: 1.0, size: 1.0 };

    /// The number of the colour in the middle.
    pub(super) fn ink(self) -> u32 {
        gradient_step(self.end - 0.5 * self.size)
    }

    /// Whether the span has one colour.
    pub(super) fn is_short(self) -> bool {
        is_one_step(self.size)
    }
}

/// The number of segments in each block.
#[derive(Debug, Default)]
pub(super) struct Path {
    /// By block; empty if colours do not follow the path.
    counts: Vec<Amount>,
    sweep: Sweep,
    /// The segments so far of the block being counted.
    sum: Amount,
}

impl Path {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Goes on counting, if colours follow the path.
    pub(super) fn prepare(&mut self, drawing: &Drawing, style: &Style, meter: &mut Meter) -> Progress {
        if style.colour_by.source().is_shared() {
            self.clear();
            return Progress::Done;
        }
        let mut sweep = self.sweep;
        let progress = sweep.step(self, drawing, meter);
        self.sweep = sweep;
        progress
    }

    /// Whether colours follow the path.
    pub(super) fn counts(&self) -> bool {
        !self.counts.is_empty()
    }

    /// The span of the last segment in `left`, the part of a block that is not yet done.
    pub(super) fn stroke(&self, block: BlockId, left: Span) -> Span {
        Span { size: self.part(block, left, Amount::ONE), ..left }
    }

    /// The span of the block `last`, which is the last item in `left`.
    pub(super) fn block(&self, block: BlockId, left: Span, last: BlockId) -> Span {
        let count = self.counts.get(last.0 as usize).copied().unwrap_or_default();
        Span { size: self.part(block, left, count), ..left }
    }

    /// The length of an item of a block, as a part of the whole path.
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

impl BlockVisitor for Path {
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
