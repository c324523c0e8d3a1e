//! A drawing whose pieces are all different: a tree of blocks of consecutive strokes.

use super::builder::Builder;
use super::sheet::{Desk, Sheet};
use super::{BlockId, Item, Placed, StyleChange};
use crate::space::{Space, minus};

/// Strokes and polygons of a block at the bottom: enough to make work by block cheap, few enough to stay in the nearest cache.
const STROKES: usize = 1024;
/// Blocks of a block above.
const BLOCKS: usize = 16;

/// Grows the tree from its strokes in drawing order.
#[derive(Clone, Debug)]
pub(crate) struct Tree<S: Space> {
    /// Of the unit of all coordinates that are not yet in a block.
    exponent: i32,
    sheet: Sheet<S>,
    /// By height: blocks that have no parent yet, and their origins.
    rows: Vec<Vec<(BlockId, S::Point)>>,
}

impl<S: Space> Tree<S> {
    pub(crate) fn new(exponent: i32) -> Self {
        Self { exponent, sheet: Sheet::new(), rows: vec![] }
    }

    /// Has `act` draw what the symbol at `place` of the string does, and makes blocks of what has become enough for one.
    pub(crate) fn draw(&mut self, builder: &mut Builder<S>, place: u64, act: impl FnOnce(&mut Desk<'_, S>)) {
        // No string that is drawn whole has more symbols.
        self.sheet.symbol = place as u32;
        let Builder { styles, vertices, .. } = builder;
        act(&mut Desk { sheet: &mut self.sheet, styles, vertices });
        if self.sheet.items.len() >= STROKES && self.sheet.is_closed() {
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
        self.sheet.finish();
        let Some(origin) = self.sheet.origin(builder) else { return };
        self.sheet.shift(builder, &origin);
        let block = builder.block(&self.sheet.items, self.exponent);
        self.sheet.items.clear();
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
