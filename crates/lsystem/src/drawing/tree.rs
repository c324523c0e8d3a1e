//! A drawing whose pieces are all different: a tree of blocks of consecutive strokes.

use super::builder::Builder;
use super::{BlockId, Item, Placed, Stroke, StyleChange};
use crate::space::{Space, minus};

/// Strokes of a block at the bottom: enough to make work by block cheap, few enough to stay in the nearest cache.
const STROKES: usize = 1024;
/// Blocks of a block above.
const BLOCKS: usize = 16;

/// Grows the tree from its strokes in drawing order.
#[derive(Clone, Debug)]
pub(crate) struct Tree<S: Space> {
    /// Of the unit of all coordinates that are not yet in a block.
    exponent: i32,
    strokes: Vec<Item<S>>,
    /// By height: blocks that have no parent yet, and their origins.
    rows: Vec<Vec<(BlockId, S::Point)>>,
}

impl<S: Space> Tree<S> {
    pub(crate) fn new(exponent: i32) -> Self {
        Self { exponent, strokes: vec![], rows: vec![] }
    }

    pub(crate) fn push(&mut self, builder: &mut Builder<S>, from: S::Point, to: S::Point, style: &StyleChange) {
        let style = builder.styles.id(style);
        self.strokes.push(Item::Stroke(Stroke { from, to, style }));
        if self.strokes.len() == STROKES {
            self.close_strokes(builder);
        }
    }

    /// The root, in a frame with the axes and the origin of the coordinates.
    pub(crate) fn finish(&mut self, builder: &mut Builder<S>) -> Option<BlockId> {
        self.close_strokes(builder);
        let mut height = 0;
        while height + 1 < self.rows.len() || self.rows.get(height).is_some_and(|row| row.len() > BLOCKS) {
            self.close_row(builder, height);
            height += 1;
        }
        let items = self.rows.pop().map(|row| self.items(builder, &row, S::Point::default()))?;
        builder.block(&items, self.exponent)
    }

    fn close_strokes(&mut self, builder: &mut Builder<S>) {
        let Some(Item::Stroke(Stroke { from: origin, .. })) = self.strokes.first().copied() else { return };
        for item in &mut self.strokes {
            if let Item::Stroke(stroke) = item {
                stroke.from = minus(stroke.from, &origin);
                stroke.to = minus(stroke.to, &origin);
            }
        }
        let block = builder.block(&self.strokes, self.exponent);
        self.strokes.clear();
        if let Some(block) = block {
            self.push_block(builder, 0, block, origin);
        }
    }

    fn push_block(&mut self, builder: &mut Builder<S>, height: usize, block: BlockId, origin: S::Point) {
        if self.rows.len() == height {
            self.rows.push(vec![]);
        }
        self.rows[height].push((block, origin));
        if self.rows[height].len() > BLOCKS {
            self.close_row(builder, height);
        }
    }

    /// Gives the blocks of a row a parent, but for the last where there are too many for one.
    fn close_row(&mut self, builder: &mut Builder<S>, height: usize) {
        let mut row = core::mem::take(&mut self.rows[height]);
        let rest = row.split_off(row.len().min(BLOCKS));
        self.rows[height] = rest;
        let Some(&(_, origin)) = row.first() else { return };
        let items = self.items(builder, &row, origin);
        if let Some(block) = builder.block(&items, self.exponent) {
            self.push_block(builder, height + 1, block, origin);
        }
    }

    fn items(&self, builder: &mut Builder<S>, row: &[(BlockId, S::Point)], origin: S::Point) -> Vec<Item<S>> {
        let style = builder.styles.id(&StyleChange::NONE);
        let place = |&(block, at): &(BlockId, S::Point)| {
            let own = builder.blocks[block.0 as usize].exponent;
            let scale = libm::scalbn(1.0, own - self.exponent);
            Item::Block(Placed { block, style, at: minus(at, &origin), heading: S::AHEAD, scale })
        };
        row.iter().map(place).collect()
    }
}
