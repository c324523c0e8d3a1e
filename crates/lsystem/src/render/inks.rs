//! Which colours a block draws with, so that what has one colour is painted as such and no unused one costs anything.

use super::pen::{Pen, colours};
use crate::{Block, ColourBy, ColourChange, Drawing, Item, Style, StyleChange};

/// The palette entries that a block draws with, as bit sets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Inks {
    /// Whatever the entry's.
    fixed: u64,
    /// When the entry's is 0; all move along with it.
    moving: u64,
}

/// How colours are chosen for a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Choice {
    by: ColourBy,
    /// Of the palette.
    colours: u32,
}

/// The colours of all blocks of a drawing.
#[derive(Debug, Default)]
pub(super) struct InkTable {
    choice: Option<Choice>,
    blocks: Vec<Inks>,
    /// The palette entries in use; their places are the numbers that canvases know them by.
    used: Vec<u32>,
    /// By palette entry: its number.
    numbers: Vec<u32>,
}

impl InkTable {
    /// Forgets the drawing there was.
    pub(super) fn clear(&mut self) {
        self.choice = None;
    }

    /// Makes the table for a drawing, unless it is the one already there. Returns whether anything changed.
    pub(super) fn prepare(&mut self, drawing: &Drawing, style: &Style) -> bool {
        let choice = Choice { by: style.colour_by, colours: colours(style) };
        if self.choice == Some(choice) {
            return false;
        }
        self.choice = Some(choice);
        self.blocks.clear();
        for block in &drawing.blocks {
            let inks = choice.of_block(drawing, block, &self.blocks);
            self.blocks.push(inks);
        }
        let root = drawing.root.and_then(|id| self.blocks.get(id.0 as usize)).copied().unwrap_or_default();
        let bits = root.fixed | root.moving;
        self.used = if choice.countable() {
            (0..choice.colours).filter(|ink| bits >> ink & 1 != 0).collect()
        } else {
            (0..choice.colours).collect()
        };
        self.numbers = vec![0; choice.colours as usize];
        for (number, &ink) in self.used.iter().enumerate() {
            self.numbers[ink as usize] = number as u32;
        }
        true
    }

    /// The palette entries in use, by number.
    pub(super) fn used(&self) -> &[u32] {
        &self.used
    }

    /// How many binary digits a number has.
    pub(super) fn digits(&self) -> usize {
        (u32::BITS - (self.used.len() as u32).saturating_sub(1).leading_zeros()) as usize
    }

    /// The number of the colour that this pen draws with.
    pub(super) fn number(&self, pen: Pen) -> u32 {
        let Some(choice) = self.choice else { return 0 };
        self.numbers.get(choice.ink(pen) as usize).copied().unwrap_or_default()
    }

    /// The number of the only colour of a block, if it has only one.
    pub(super) fn only(&self, block: usize, pen: Pen) -> Option<u32> {
        let choice = self.choice?;
        let inks = self.blocks.get(block)?;
        if self.used.len() <= 1 {
            return Some(0);
        }
        let bits = inks.fixed | choice.turned(inks.moving, choice.ink(pen));
        (choice.countable() && bits.count_ones() == 1).then(|| self.numbers[bits.trailing_zeros() as usize])
    }

    /// What the colours of a block depend on: the palette entry of the pen at its entry, or nothing.
    pub(super) fn entry(&self, block: usize, pen: Pen) -> Option<u32> {
        let choice = self.choice?;
        (!choice.countable() || self.blocks.get(block)?.moving != 0).then(|| choice.ink(pen))
    }
}

impl Choice {
    /// Whether a set of palette entries fits a word.
    fn countable(self) -> bool {
        self.colours <= u64::BITS
    }

    /// The palette entry that this pen draws with.
    fn ink(self, pen: Pen) -> u32 {
        pen.ink(self.colours, self.by)
    }

    /// A set of palette entries, each moved on by `count`.
    fn turned(self, bits: u64, count: u32) -> u64 {
        let all = u64::MAX >> (u64::BITS - self.colours.clamp(1, u64::BITS));
        if count == 0 { bits } else { (bits << count | bits >> (self.colours - count)) & all }
    }

    fn of_block(self, drawing: &Drawing, block: &Block, blocks: &[Inks]) -> Inks {
        let mut inks = Inks::default();
        if !self.countable() {
            return inks;
        }
        for item in &drawing.items[block.items.start as usize..block.items.end as usize] {
            let (style, inner) = match item {
                Item::Stroke(stroke) => (stroke.style, Inks { fixed: 0, moving: 1 }),
                Item::Block(placed) => (placed.style, blocks[placed.block.0 as usize]),
            };
            let change: &StyleChange = &drawing.styles[style.0 as usize];
            let entry = self.ink(Pen { colour: change.colour.of(0), width: 0.0, level: change.level });
            let moved = self.turned(inner.moving, entry);
            inks.fixed |= inner.fixed;
            if self.by == ColourBy::Symbol && matches!(change.colour, ColourChange::Set(_)) {
                inks.fixed |= moved;
            } else {
                inks.moving |= moved;
            }
        }
        inks
    }
}
