//! Which colours a block draws with, so that one picture of it serves whatever colour it is entered with.

use crate::{Block, ColourBy, ColourChange, Drawing, Item, Style, StyleChange};

/// A colour, as far as it is known inside a block.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Shade {
    /// This palette entry.
    Fixed(u32),
    /// So many palette entries after the one at the block's entry.
    Moving(u32),
}

/// How colours are chosen for a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Choice {
    by: ColourBy,
    /// Of the palette; at least 1.
    colours: u32,
}

impl Choice {
    /// More palette entries than a set can hold are not counted.
    fn is_countable(self) -> bool {
        self.colours <= u64::BITS
    }

    /// The shade after a change, from the entry's.
    pub(super) fn shade(self, change: &StyleChange) -> Shade {
        let wrapped = |index: i32| i64::from(index).rem_euclid(i64::from(self.colours.max(1))) as u32;
        match (self.by, change.colour) {
            (ColourBy::Single, _) => Shade::Moving(0),
            (ColourBy::Level, _) => Shade::Moving(change.level % self.colours.max(1)),
            (ColourBy::Symbol, ColourChange::Set(index)) => Shade::Fixed(wrapped(index)),
            (ColourBy::Symbol, ColourChange::Add(count)) => Shade::Moving(wrapped(count)),
        }
    }

    /// `first`, then `second`.
    pub(super) fn then(self, first: Shade, second: Shade) -> Shade {
        let sum = |a: u32, b: u32| if a + b >= self.colours { a + b - self.colours } else { a + b };
        match (first, second) {
            (_, Shade::Fixed(ink)) => Shade::Fixed(ink),
            (Shade::Fixed(ink), Shade::Moving(by)) => Shade::Fixed(sum(ink, by)),
            (Shade::Moving(a), Shade::Moving(b)) => Shade::Moving(sum(a, b)),
        }
    }
}

/// A set of shades. Their places in it, fixed ones first, are the numbers that a canvas knows them by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Inks {
    fixed: u64,
    moving: u64,
}

impl Inks {
    pub(super) fn count(self) -> u32 {
        self.fixed.count_ones() + self.moving.count_ones()
    }

    fn insert(&mut self, shade: Shade) {
        match shade {
            Shade::Fixed(ink) => self.fixed |= 1 << ink,
            Shade::Moving(by) => self.moving |= 1 << by,
        }
    }

    fn number(self, shade: Shade) -> u32 {
        let before = |bits: u64, index: u32| (bits & !(u64::MAX << index)).count_ones();
        match shade {
            Shade::Fixed(ink) => before(self.fixed, ink),
            Shade::Moving(by) => self.fixed.count_ones() + before(self.moving, by),
        }
    }

    pub(super) fn shades(self) -> impl Iterator<Item = Shade> {
        let fixed = (0..u64::BITS).filter(move |ink| self.fixed >> ink & 1 != 0).map(Shade::Fixed);
        fixed.chain((0..u64::BITS).filter(move |by| self.moving >> by & 1 != 0).map(Shade::Moving))
    }
}

/// Binary digits of the numbers below `count`.
pub(super) fn digits(count: u32) -> usize {
    (u32::BITS - count.saturating_sub(1).leading_zeros()) as usize
}

/// The colours of all blocks of a drawing.
#[derive(Debug, Default)]
pub(super) struct InkTable {
    pub choice: Choice,
    ready: bool,
    blocks: Vec<Inks>,
    /// The palette entries of the picture, by number.
    used: Vec<u32>,
    /// The colours of the picture.
    pub picture: Inks,
}

impl InkTable {
    /// Forgets the drawing there was.
    pub(super) fn clear(&mut self) {
        self.ready = false;
    }

    /// Makes the table for a drawing, unless it is the one already there. Returns whether anything changed.
    pub(super) fn prepare(&mut self, drawing: &Drawing, style: &Style) -> bool {
        let colours = match style.colour_by {
            ColourBy::Single => 1,
            ColourBy::Symbol | ColourBy::Level => u32::try_from(style.palette.len()).unwrap_or(u32::MAX / 2).max(1),
        };
        let choice = Choice { by: style.colour_by, colours };
        if self.ready && self.choice == choice {
            return false;
        }
        (self.ready, self.choice) = (true, choice);
        self.blocks.clear();
        self.picture = Inks::default();
        if !choice.is_countable() {
            self.used = (0..colours).collect();
            return true;
        }
        for block in &drawing.blocks {
            let inks = of_block(choice, drawing, block, &self.blocks);
            self.blocks.push(inks);
        }
        if let Some(root) = drawing.root {
            for shade in self.blocks[root.0 as usize].shades() {
                self.picture.insert(choice.then(Shade::Fixed(0), shade));
            }
        }
        self.used = (0..colours).filter(|ink| self.picture.fixed >> ink & 1 != 0).collect();
        true
    }

    /// The palette entries of the picture, by number.
    pub(super) fn used(&self) -> &[u32] {
        &self.used
    }

    /// The shades in a block, or `None` if there are too many to count.
    pub(super) fn of(&self, block: usize) -> Option<Inks> {
        self.blocks.get(block).copied()
    }

    /// The number of a shade on a canvas with these inks.
    pub(super) fn number(&self, inks: Inks, shade: Shade) -> u32 {
        match shade {
            Shade::Fixed(ink) if !self.choice.is_countable() => ink,
            _ => inks.number(shade),
        }
    }
}

fn of_block(choice: Choice, drawing: &Drawing, block: &Block, blocks: &[Inks]) -> Inks {
    let mut inks = Inks::default();
    let mut last = None;
    for item in &drawing.items[block.items.start as usize..block.items.end as usize] {
        let (style, inner) = match item {
            Item::Stroke(stroke) => (stroke.style, None),
            Item::Block(placed) => (placed.style, Some(placed.block)),
        };
        // Long runs of strokes in one style are common.
        if last.replace((style, inner)) == Some((style, inner)) {
            continue;
        }
        let entry = choice.shade(&drawing.styles[style.0 as usize]);
        match inner {
            None => inks.insert(entry),
            Some(block) => {
                blocks[block.0 as usize].shades().for_each(|shade| inks.insert(choice.then(entry, shade)));
            }
        }
    }
    inks
}
