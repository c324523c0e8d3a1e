//! Which colours a block draws with, so that one picture of it serves whatever colour it is entered with.

use super::sweep::{Fact, Sweep};
use lsystem_drawing::{Block, BlockId, ColourChange, Drawing, Item, StyleChange, StyleId};
use lsystem_syntax::MAX_PALETTE;
use lsystem_syntax::{ColourBy, Meter, Progress, Style};

/// A colour, as far as it is known inside a block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Shade {
    /// A palette entry, or how many entries it is after the one at the block's entry.
    pub number: u32,
    /// Whether it is a palette entry.
    pub fixed: bool,
}

impl Shade {
    /// As the bits of planes: the digits of the number, and what tells whether it is fixed behind them.
    pub(super) fn code(self, digits: usize) -> u32 {
        self.number | u32::from(self.fixed) << digits
    }
}

/// How colours are chosen for a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Choice {
    by: ColourBy,
    /// Of the palette; at least 1.
    pub colours: u32,
    /// Whether numbers beyond the palette mean its last entry, instead of wrapping around.
    holds: bool,
}

impl Choice {
    /// By a style, in a drawing with these changes of it.
    pub(crate) fn new(style: &Style, changes: &[StyleChange]) -> Self {
        let by = style.colour_by;
        // Where numbers become smaller again, those beyond the palette have to be told apart.
        let falls =
            by != ColourBy::Level && changes.iter().any(|change| matches!(change.colour, ColourChange::Add(..0)));
        let largest = changes.iter().map(|change| change.colour.of(0).max(0).unsigned_abs());
        let apart = if style.holds() && falls { largest.max().unwrap_or(0).saturating_add(1) } else { 1 };
        Self { by, colours: style.inks().max(apart).min(MAX_PALETTE as u32), holds: style.holds() && !falls }
    }

    /// The number of the palette entry for an index.
    fn wrapped(self, index: i64) -> u32 {
        let colours = i64::from(self.colours.max(1));
        (if self.holds { index.clamp(0, colours - 1) } else { index.rem_euclid(colours) }) as u32
    }

    /// The shade after a change, from the entry's.
    pub(crate) fn shade(self, change: &StyleChange) -> Shade {
        let wrapped = |index: i32| self.wrapped(i64::from(index));
        let moving = |number: u32| Shade { number, fixed: false };
        match (self.by, change.colour) {
            // Along the path the walk knows.
            (ColourBy::Single | ColourBy::Path | ColourBy::Density, _) => moving(0),
            (ColourBy::Level, _) => moving(self.wrapped(i64::from(change.level))),
            (_, ColourChange::Set(index)) => Shade { number: wrapped(index), fixed: true },
            (_, ColourChange::Add(count)) => moving(wrapped(count)),
        }
    }

    /// `first`, then `second`.
    pub(crate) fn then(self, first: Shade, second: Shade) -> Shade {
        if second.fixed {
            return second;
        }
        let sum = first.number + second.number;
        let beyond = if self.holds { self.colours.max(1) - 1 } else { sum.wrapping_sub(self.colours) };
        Shade { number: if sum >= self.colours { beyond } else { sum }, fixed: first.fixed }
    }
}

/// The shades that something is drawn with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Inks {
    /// Nothing is drawn.
    #[default]
    None,
    /// All in one.
    One(Shade),
    /// Several.
    Many,
}

impl Inks {
    fn with(self, other: Self) -> Self {
        match (self, other) {
            (Self::None, inks) | (inks, Self::None) => inks,
            (Self::One(a), Self::One(b)) if a == b => self,
            _ => Self::Many,
        }
    }

    fn after(self, choice: Choice, entry: Shade) -> Self {
        match self {
            Self::One(shade) => Self::One(choice.then(entry, shade)),
            inks => inks,
        }
    }
}

/// The colours of all blocks of a drawing.
#[derive(Debug, Default)]
pub(super) struct InkTable {
    pub choice: Choice,
    ready: bool,
    blocks: Vec<Inks>,
    /// The palette entries of the picture, by number on its canvas.
    used: Vec<u32>,
    /// Whether some shade is fixed inside a block.
    fixes: bool,
    /// Whether all blocks are known.
    made: bool,
    place: Sweep,
    /// Of the block in hand, and the style and the block of its last item.
    block: Inks,
    last: Option<(StyleId, Option<BlockId>)>,
}

impl InkTable {
    /// Forgets the drawing there was.
    pub(super) fn clear(&mut self) {
        self.ready = false;
    }

    /// Starts the table for a drawing, unless it is the one already there. Returns whether anything changes.
    pub(super) fn choose(&mut self, drawing: &Drawing, style: &Style) -> bool {
        let choice = Choice::new(style, &drawing.styles);
        if self.ready && self.choice == choice {
            return false;
        }
        *self = Self { ready: true, choice, ..Self::default() };
        true
    }

    /// Goes on with the table, until it is made.
    pub(super) fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let mut place = self.place;
        let progress = place.step(self, drawing, meter);
        self.place = place;
        if progress == Progress::Done && !self.made {
            self.finish(drawing);
        }
        progress
    }

    fn finish(&mut self, drawing: &Drawing) {
        let choice = self.choice;
        self.made = true;
        self.fixes = drawing.styles.iter().any(|style| choice.shade(style).fixed);
        let start = Shade { number: 0, fixed: true };
        self.used = match drawing.root.map(|root| self.of(root.0 as usize).after(choice, start)) {
            Some(Inks::One(_)) if choice.by == ColourBy::Path => (0..choice.colours).collect(),
            Some(Inks::One(shade)) => vec![shade.number],
            Some(Inks::Many) => (0..choice.colours).collect(),
            _ => vec![],
        };
    }

    /// The palette entries of the picture, by number.
    pub(super) fn used(&self) -> &[u32] {
        &self.used
    }

    /// The shades in a block.
    pub(super) fn of(&self, block: usize) -> Inks {
        self.blocks.get(block).copied().unwrap_or_default()
    }

    /// Binary digits of a palette entry's number.
    pub(super) fn digits(&self) -> usize {
        (u32::BITS - (self.choice.colours - 1).leading_zeros()) as usize
    }

    /// The bit planes that the picture takes for its colours.
    pub(super) fn picture_planes(&self) -> usize {
        if self.used.len() > 1 { self.digits() } else { 0 }
    }

    /// The bit planes that a tile with these shades takes: the digits of the number and, where it matters, one more
    /// that tells what is fixed.
    pub(super) fn planes(&self, inks: Inks) -> usize {
        if inks == Inks::Many { self.digits() + usize::from(self.fixes) } else { 0 }
    }

    /// What becomes of a picture with these shades where it is entered with `shade`.
    pub(super) fn dye(&self, inks: Inks, shade: Shade) -> Dye {
        let entry = match inks {
            Inks::One(own) => self.choice.then(shade, own),
            _ => shade,
        };
        Dye { entry, choice: self.choice, digits: self.digits() }
    }

    /// A shade as the bits of as many planes.
    pub(super) fn code(&self, shade: Shade) -> u32 {
        shade.code(self.digits())
    }
}

impl Fact for InkTable {
    fn item(&mut self, drawing: &Drawing, _: usize, _: usize, item: &Item) -> u64 {
        let (style, inner) = match item {
            Item::Stroke(stroke) => (stroke.style, None),
            Item::Polygon(polygon) => (polygon.style, None),
            Item::Block(placed) => (placed.style, Some(placed.block)),
        };
        // Long runs of strokes in one style are common.
        if self.block == Inks::Many || self.last.replace((style, inner)) == Some((style, inner)) {
            return 1;
        }
        let entry = self.choice.shade(&drawing.styles[style.0 as usize]);
        self.block = self.block.with(match inner {
            None => Inks::One(entry),
            Some(block) => self.blocks[block.0 as usize].after(self.choice, entry),
        });
        1
    }

    fn close(&mut self, _: &Drawing, _: &Block) -> u64 {
        self.last = None;
        self.blocks.push(core::mem::take(&mut self.block));
        0
    }
}

/// A change of colour numbers in binary, for 64 of them at a time: what a tile's shades are where it is stamped.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dye {
    /// The shade at the block's entry.
    pub entry: Shade,
    pub choice: Choice,
    /// Binary digits of a number; the plane behind them tells what is fixed.
    pub digits: usize,
}

/// The most bit planes of a picture's colours: the digits of [`MAX_PALETTE`] colours' numbers.
pub(super) const PLANES: usize = MAX_PALETTE.next_power_of_two().trailing_zeros() as usize;

impl Dye {
    /// Whether a tile of so many planes becomes one shade throughout.
    #[inline(always)]
    pub(super) fn is_even(&self, planes: usize) -> bool {
        planes == 0 || self.choice.holds && self.entry.number + 1 == self.choice.colours && planes <= self.digits
    }

    /// Makes the numbers of a tile, given the words of each digit, what they are after the entry's shade, but for those
    /// that are `fixed`.
    pub(super) fn apply<const N: usize>(&self, numbers: &mut [[u64; N]], fixed: &[u64; N]) {
        let by = self.entry.number;
        if by == 0 {
            return;
        }
        // n + by or, where that is beyond the palette, the last number or n - (colours - by), which is the same modulo
        // the palette's size.
        let Choice { colours, holds, .. } = self.choice;
        let back = colours - by;
        let mask = |number: u32, digit: usize| u64::from(number >> digit & 1).wrapping_neg();
        let mut less = [0; N];
        for (digit, plane) in numbers.iter().enumerate() {
            let one = mask(back, digit);
            for (less, n) in less.iter_mut().zip(plane) {
                *less = !*n & (one | *less) | one & *less;
            }
        }
        let (mut within, mut beyond) = (less, less);
        for i in 0..N {
            within[i] &= !fixed[i];
            beyond[i] = !(less[i] | fixed[i]);
        }
        // Which of them get the last number.
        let ends = if holds { beyond } else { [0; N] };
        let down = if holds { 0 } else { back.wrapping_neg() };
        let mut carry = [0; N];
        for (digit, plane) in numbers.iter_mut().enumerate() {
            let [up, down, last] = [by, down, colours - 1].map(|number| mask(number, digit));
            for i in 0..N {
                let more = up & within[i] | down & beyond[i];
                let n = plane[i];
                plane[i] = (n ^ more ^ carry[i]) & !ends[i] | last & ends[i];
                carry[i] = n & more | carry[i] & (n ^ more);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dyeing_adds_within_the_palette() {
        for (colours, holds) in [2, 3, 5, 8, 100, 256].into_iter().flat_map(|c| [(c, false), (c, true)]) {
            let digits = (u32::BITS - (colours - 1_u32).leading_zeros()) as usize;
            let choice = Choice { by: ColourBy::Symbol, colours, holds };
            for by in (0..colours).step_by(7) {
                for number in 0..colours {
                    for fixed in [false, true] {
                        let entry = Shade { number: by, fixed: true };
                        let shade = Shade { number, fixed };
                        let plane = |digit: usize| [0, u64::from(shade.code(digits) >> digit & 1) << 17];
                        let mut planes: Vec<_> = (0..digits).map(plane).collect();
                        Dye { entry, choice, digits }.apply(&mut planes, &plane(digits));
                        let got: u32 = (0..digits).map(|d| (planes[d][1] >> 17 & 1) as u32 * (1 << d)).sum();
                        assert_eq!(got, choice.then(entry, shade).number, "{number} + {by} of {colours}");
                    }
                }
            }
        }
    }
}
