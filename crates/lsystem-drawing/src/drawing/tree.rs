//! A tree of blocks of consecutive strokes: for drawings without shared pieces, and for the word of one piece.

use super::builder::Builder;
use super::item_buffer::{ItemBuffer, ItemWriter, origin, shift};
use super::taper::{Flow, TaperItems};
use crate::drawing::block::{BlockId, Item, Placed, Space};
use crate::exact_path::Spot;
use crate::room::bytes_of;
use crate::space::minus;
use crate::style::{StyleChange, WidthChange};

/// The strokes and polygons of a bottom block: enough to make work per block cheap, few enough for the L1 cache.
const STROKES: usize = 1024;
/// The items of a bottom block in a long word; fewer than [`STROKES`], because the hulls of placed blocks have many
/// corners.
pub(crate) const WORD: usize = 512;
/// The inner blocks of a block above the bottom.
const BLOCKS: usize = 16;

/// A tree that grows from its items in drawing order.
#[derive(Clone, Debug)]
pub(crate) struct Tree<S: Space> {
    /// The exponent of the unit of all coordinates that are not yet in a block.
    exponent: i32,
    /// The number of items of a bottom block.
    bottom: usize,
    /// Whether the tree is the word of a piece. A word that fits into one bottom block becomes one block as it is.
    is_word: bool,
    pub buffer: ItemBuffer<S>,
    /// The number of the buffer's items that are in blocks already.
    done: usize,
    /// The items of the block that is made next.
    run: Vec<Item<S>>,
    /// By height: the blocks without a parent, and their origins.
    rows: Vec<Vec<(BlockId, S::Point, Spot)>>,
}

impl<S: Space> Tree<S> {
    pub(super) fn new(exponent: i32, tapers: bool) -> Self {
        Self {
            exponent,
            bottom: STROKES,
            is_word: false,
            buffer: ItemBuffer::new(tapers),
            done: 0,
            run: vec![],
            rows: vec![],
        }
    }

    /// A tree of the items of a word. The items form one block, unless the word is `long`.
    pub(crate) fn of_word(exponent: i32, long: bool, tapers: bool) -> Self {
        Self { bottom: if long { WORD } else { usize::MAX }, is_word: true, ..Self::new(exponent, tapers) }
    }

    /// The bytes that the tree occupies, without its blocks.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.run) + self.buffer.bytes()
    }

    /// Draws the symbol at `place` of the string by `act`, and makes a block if there are enough items.
    pub(super) fn draw(
        &mut self,
        builder: &mut Builder<S>,
        place: u64,
        act: impl FnOnce(&mut ItemWriter<'_, S>, &mut S::Directions),
    ) {
        // A string that is drawn symbol by symbol has fewer than 2^32 symbols.
        self.buffer.symbol = place as u32;
        let Builder { styles, vertices, directions, items: made, exact_path, .. } = builder;
        act(&mut ItemWriter { buffer: &mut self.buffer, made, styles, vertices, exact_path }, directions);
        self.settle(builder);
    }

    /// Appends the block of a piece that is entered with the width change `entry`, if the piece has one.
    pub(super) fn place(
        &mut self,
        builder: &mut Builder<S>,
        placed: Option<Placed<S>>,
        flow: &Flow,
        entry: WidthChange,
    ) {
        let Builder { styles, vertices, items: made, exact_path, .. } = builder;
        ItemWriter { buffer: &mut self.buffer, made, styles, vertices, exact_path }.place(placed, flow, entry);
        self.settle(builder);
    }

    /// Notes that all items are drawn. Returns what they show to their surroundings; nothing follows the items of a
    /// `whole` drawing.
    pub(crate) fn end(&mut self, builder: &mut Builder<S>, whole: bool) -> Flow {
        let ItemBuffer { items, taper, .. } = &mut self.buffer;
        let Some(taper) = taper else { return Flow::default() };
        if whole {
            taper.end(&mut TaperItems { buffer: items, made: &mut builder.items, styles: &mut builder.styles });
        }
        taper.flow()
    }

    /// Makes a bottom block if there are enough items and no polygon is open.
    fn settle(&mut self, builder: &mut Builder<S>) {
        if self.buffer.items.len() - self.done >= self.bottom && self.buffer.is_closed() {
            self.close_run(builder);
        }
    }

    /// Makes one more bottom block and returns `None`. After the last one, makes the rest of the tree and returns the
    /// root, if any. The root's frame has the axes and the origin of the coordinates.
    pub(crate) fn finish_one(&mut self, builder: &mut Builder<S>) -> Option<Option<BlockId>> {
        if self.is_word && self.rows.is_empty() && self.done == 0 {
            self.buffer.finish();
            return Some(builder.block(&self.buffer.items, self.exponent, Spot::ENTRY));
        }
        if self.done < self.buffer.items.len() {
            self.close_run(builder);
            return None;
        }
        let mut height = 0;
        while height + 1 < self.rows.len() || self.rows.get(height).is_some_and(|row| row.len() > BLOCKS) {
            self.close_row(builder, height);
            height += 1;
        }
        if let Some(taper) = &self.buffer.taper {
            taper.widen(&mut builder.blocks);
        }
        let row = self.rows.pop();
        Some(row.and_then(|row| {
            let items = self.items(builder, &row, S::Point::default());
            builder.block(&items, self.exponent, Spot::ENTRY)
        }))
    }

    /// Makes a block of the next items. Outside of words, the last block also takes a rest that is too small for a
    /// block.
    fn close_run(&mut self, builder: &mut Builder<S>) {
        let left = self.buffer.items.len() - self.done;
        let count = if left < 2 * self.bottom && !self.is_word { left } else { left.min(self.bottom) };
        self.run.clear();
        let next = &self.buffer.items[self.done..self.done + count];
        self.run.extend(next.iter().filter(|item| !item.is_hollow()));
        let from = self.done;
        self.done += count;
        let made = self.run.first().map(|item| origin(builder, item)).and_then(|(origin, spot)| {
            shift(builder, &mut self.run, &origin);
            // An item that waits for the width at its end stays an item.
            let keeps = self.buffer.taper.is_some();
            let block = if keeps {
                builder.new_block(&self.run, self.exponent, spot)
            } else {
                builder.block(&self.run, self.exponent, spot)
            };
            block.map(|block| (block, origin, spot))
        });
        if let (Some(taper), Some((block, ..))) = (&mut self.buffer.taper, &made) {
            let number = builder.blocks[block.0 as usize].items.start;
            taper.moved(&self.buffer.items, from, number, block.0 as usize);
        }
        if self.done == self.buffer.items.len() {
            self.buffer.items.clear();
            self.done = 0;
        }
        if let Some(made) = made {
            self.push_block(builder, 0, made);
        }
    }

    /// Adds a block at a height, and gives a full row a parent.
    fn push_block(&mut self, builder: &mut Builder<S>, height: usize, made: (BlockId, S::Point, Spot)) {
        if self.rows.len() == height {
            self.rows.push(vec![]);
        }
        self.rows[height].push(made);
        if self.rows[height].len() > BLOCKS {
            self.close_row(builder, height);
        }
    }

    /// Makes a parent for the first blocks of a row, at most [`BLOCKS`].
    fn close_row(&mut self, builder: &mut Builder<S>, height: usize) {
        let mut row = core::mem::take(&mut self.rows[height]);
        let rest = row.split_off(row.len().min(BLOCKS));
        self.rows[height] = rest;
        let Some(&(_, origin, spot)) = row.first() else { return };
        let items = self.items(builder, &row, origin);
        if let Some(block) = builder.block(&items, self.exponent, spot) {
            self.push_block(builder, height + 1, (block, origin, spot));
        }
    }

    /// Items that place the blocks of a row relative to `origin`.
    fn items(&self, builder: &mut Builder<S>, row: &[(BlockId, S::Point, Spot)], origin: S::Point) -> Vec<Item<S>> {
        let style = builder.styles.id(&StyleChange::NONE);
        let place = |&(block, at, spot): &(BlockId, S::Point, Spot)| {
            let own = builder.blocks[block.0 as usize].exponent;
            let scale = libm::scalbn(1.0, own - self.exponent);
            Item::Block(Placed { block, style, spot: Some(spot), at: minus(at, &origin), heading: S::AHEAD, scale })
        };
        row.iter().map(place).collect()
    }
}
