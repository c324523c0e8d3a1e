//! A drawing whose pieces are all different: a tree of blocks of consecutive strokes.

use super::builder::Builder;
use super::{BlockId, Item, Placed, Stroke, StyleChange};
use crate::Heading;

/// Strokes of a block at the bottom: enough to make work by block cheap, few enough to stay in the nearest cache.
const STROKES: usize = 1024;
/// Blocks of a block above.
const BLOCKS: usize = 16;

/// Grows the tree from its strokes in drawing order.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    /// Of the unit of all coordinates that are not yet in a block.
    exponent: i32,
    strokes: Vec<Item>,
    /// By height: blocks that have no parent yet, and their origins.
    rows: Vec<Vec<(BlockId, [f64; 2])>>,
}

impl Tree {
    pub(crate) fn new(exponent: i32) -> Self {
        Self { exponent, strokes: vec![], rows: vec![] }
    }

    pub(crate) fn push(&mut self, builder: &mut Builder, from: [f64; 2], to: [f64; 2], style: &StyleChange) {
        let style = builder.styles.id(style);
        self.strokes.push(Item::Stroke(Stroke { from, to, style }));
        if self.strokes.len() == STROKES {
            self.close_strokes(builder);
        }
    }

    /// The root, in a frame with the axes and the origin of the coordinates.
    pub(crate) fn finish(&mut self, builder: &mut Builder) -> Option<BlockId> {
        self.close_strokes(builder);
        let mut height = 0;
        while height + 1 < self.rows.len() || self.rows.get(height).is_some_and(|row| row.len() > BLOCKS) {
            self.close_row(builder, height);
            height += 1;
        }
        let items = self.rows.pop().map(|row| self.items(builder, &row, [0.0; 2]))?;
        builder.block(&items, self.exponent)
    }

    fn close_strokes(&mut self, builder: &mut Builder) {
        let Some(Item::Stroke(Stroke { from: origin, .. })) = self.strokes.first().copied() else { return };
        for item in &mut self.strokes {
            if let Item::Stroke(stroke) = item {
                stroke.from = minus(stroke.from, origin);
                stroke.to = minus(stroke.to, origin);
            }
        }
        let block = builder.block(&self.strokes, self.exponent);
        self.strokes.clear();
        if let Some(block) = block {
            self.push_block(builder, 0, block, origin);
        }
    }

    fn push_block(&mut self, builder: &mut Builder, height: usize, block: BlockId, origin: [f64; 2]) {
        if self.rows.len() == height {
            self.rows.push(vec![]);
        }
        self.rows[height].push((block, origin));
        if self.rows[height].len() > BLOCKS {
            self.close_row(builder, height);
        }
    }

    /// Gives the blocks of a row a parent, but for the last where there are too many for one.
    fn close_row(&mut self, builder: &mut Builder, height: usize) {
        let mut row = core::mem::take(&mut self.rows[height]);
        let rest = row.split_off(row.len().min(BLOCKS));
        self.rows[height] = rest;
        let Some(&(_, origin)) = row.first() else { return };
        let items = self.items(builder, &row, origin);
        if let Some(block) = builder.block(&items, self.exponent) {
            self.push_block(builder, height + 1, block, origin);
        }
    }

    fn items(&self, builder: &mut Builder, row: &[(BlockId, [f64; 2])], origin: [f64; 2]) -> Vec<Item> {
        let style = builder.styles.id(&StyleChange::NONE);
        let place = |&(block, at): &(BlockId, [f64; 2])| {
            let own = builder.blocks[block.0 as usize].exponent;
            let scale = libm::scalbn(1.0, own - self.exponent);
            Item::Block(Placed { block, style, at: minus(at, origin), heading: Heading::EAST, scale })
        };
        row.iter().map(place).collect()
    }
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}
