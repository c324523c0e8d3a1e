//! A drawing whose pieces are all different: a tree of blocks of consecutive strokes.

use super::builder::Builder;
use super::sheet::{Desk, Sheet, is_hollow, origin, shift};
use crate::drawing::block::{BlockId, Item, Placed, Space};
use crate::room::bytes_of;
use crate::space::minus;
use crate::style::StyleChange;

/// Strokes and polygons of a block at the bottom: enough to make work by block cheap, few enough to stay in the nearest cache.
const STROKES: usize = 1024;
/// Strokes and blocks of a block at the bottom of a long word: hulls of blocks have many corners.
pub(crate) const WORD: usize = 512;
/// Blocks of a block above.
const BLOCKS: usize = 16;

/// Grows the tree from its strokes in drawing order.
#[derive(Clone, Debug)]
pub(crate) struct Tree<S: Space> {
    /// Of the unit of all coordinates that are not yet in a block.
    exponent: i32,
    /// How many items make a block at the bottom.
    bottom: usize,
    /// Whether all lies in one block as it is where there are no more items than that.
    is_word: bool,
    pub sheet: Sheet<S>,
    /// Items of the sheet that are in blocks already.
    done: usize,
    /// The items of the block that is made next.
    run: Vec<Item<S>>,
    /// By height: blocks that have no parent yet, and their origins.
    rows: Vec<Vec<(BlockId, S::Point)>>,
}

impl<S: Space> Tree<S> {
    pub(super) fn new(exponent: i32) -> Self {
        Self { exponent, bottom: STROKES, is_word: false, sheet: Sheet::new(), done: 0, run: vec![], rows: vec![] }
    }

    /// A tree of the strokes and blocks of a word. All of them are one block, unless the word is `long`.
    pub(crate) fn of_word(exponent: i32, long: bool) -> Self {
        Self { bottom: if long { WORD } else { usize::MAX }, is_word: true, ..Self::new(exponent) }
    }

    /// The bytes that it takes.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.run) + self.sheet.bytes()
    }

    /// Has `act` draw what the symbol at `place` of the string does, and makes blocks of what has become enough for one.
    pub(super) fn draw(
        &mut self,
        builder: &mut Builder<S>,
        place: u64,
        act: impl FnOnce(&mut Desk<'_, S>, &mut S::Directions),
    ) {
        // No string that is drawn whole has more symbols.
        self.sheet.symbol = place as u32;
        let Builder { styles, vertices, directions, .. } = builder;
        act(&mut Desk { sheet: &mut self.sheet, styles, vertices }, directions);
        self.settle(builder);
    }

    /// Appends a block.
    pub(super) fn place(&mut self, builder: &mut Builder<S>, placed: Placed<S>) {
        self.sheet.items.push(Item::Block(placed));
        self.settle(builder);
    }

    fn settle(&mut self, builder: &mut Builder<S>) {
        if self.sheet.items.len() - self.done >= self.bottom && self.sheet.is_closed() {
            self.close_run(builder);
        }
    }

    /// Makes one more block at the bottom, or where none is left to make the root, in a frame with the axes and the origin of
    /// the coordinates.
    pub(crate) fn finish_one(&mut self, builder: &mut Builder<S>) -> Option<Option<BlockId>> {
        if self.is_word && self.rows.is_empty() && self.done == 0 {
            self.sheet.finish();
            return Some(builder.block(&self.sheet.items, self.exponent));
        }
        if self.done < self.sheet.items.len() {
            self.close_run(builder);
            return None;
        }
        let mut height = 0;
        while height + 1 < self.rows.len() || self.rows.get(height).is_some_and(|row| row.len() > BLOCKS) {
            self.close_row(builder, height);
            height += 1;
        }
        let row = self.rows.pop();
        Some(row.and_then(|row| {
            let items = self.items(builder, &row, S::Point::default());
            builder.block(&items, self.exponent)
        }))
    }

    /// Makes a block of the next items: of as many as make one, and of those that follow if they are too few for
    /// another.
    fn close_run(&mut self, builder: &mut Builder<S>) {
        let left = self.sheet.items.len() - self.done;
        let count = if left < 2 * self.bottom && !self.is_word { left } else { left.min(self.bottom) };
        self.run.clear();
        let next = &self.sheet.items[self.done..self.done + count];
        self.run.extend(next.iter().filter(|item| !is_hollow(item)));
        self.done += count;
        if self.done == self.sheet.items.len() {
            self.sheet.items.clear();
            self.done = 0;
        }
        let Some(origin) = self.run.first().map(|item| origin(builder, item)) else { return };
        shift(builder, &mut self.run, &origin);
        if let Some(block) = builder.block(&self.run, self.exponent) {
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
