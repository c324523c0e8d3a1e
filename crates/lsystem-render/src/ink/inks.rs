//! The colours of a block relative to its entry, so that one tile serves every entry colour.

use super::sweep::{BlockVisitor, Sweep};
use lsystem_base::MAX_PALETTE;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Block, BlockId, ColourChange, Drawing, Item, StyleChange, StyleId};
use lsystem_syntax::{ColourSource, Style};

/// A colour inside a block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(crate) struct Shade {
    /// If fixed, the palette entry; otherwise the number of entries after the colour at the block's entry.
    pub number: u32,
    /// Whether the shade is independent of the colour at entry.
    pub fixed: bool,
}

impl Shade {
    /// The shade as bits of planes: the digits of the number, then the bit `fixed`.
    pub(crate) fn code(self, digits: usize) -> u32 {
        self.number | u32::from(self.fixed) << digits
    }
}

/// How colours are chosen for a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Choice {
    by: ColourSource,
    /// The number of colours in the palette; at least 1.
    pub colours: u32,
    /// Whether a stroke has the faint colour, whose number is `colours`.
    has_faint: bool,
    /// Whether numbers beyond the palette mean its last entry. Otherwise they wrap around.
    holds: bool,
}

impl Default for Choice {
    fn default() -> Self {
        Self { by: ColourSource::Index, colours: 0, has_faint: false, holds: false }
    }
}

impl Choice {
    /// The choice of a style, for a drawing with these style changes.
    pub(crate) fn new(style: &Style, changes: &[StyleChange]) -> Self {
        let by = style.colour_by.source();
        // If numbers can become smaller again, numbers beyond the palette must stay apart.
        let falls =
            by != ColourSource::Level && changes.iter().any(|change| matches!(change.colour, ColourChange::Add(..0)));
        let largest = changes.iter().map(|change| change.colour.of(0).max(0).unsigned_abs());
        let apart = if style.holds() && falls { largest.max().unwrap_or(0).saturating_add(1) } else { 1 };
        let has_faint = style.is_faint(Style::FAINT) && changes.iter().any(is_faint);
        let most = MAX_PALETTE as u32 - u32::from(has_faint);
        Self { by, colours: style.inks().max(apart).min(most), has_faint, holds: style.holds() && !falls }
    }

    /// The number of inks: the colours of the palette, and the faint colour.
    pub(crate) fn inks(self) -> u32 {
        self.colours + u32::from(self.has_faint)
    }

    /// The ink of a number, for [`Style::ink`].
    pub(crate) fn ink(self, number: u32) -> u32 {
        if number == self.colours { Style::FAINT_INK } else { number }
    }

    /// The palette entry for an index.
    fn wrapped(self, index: i64) -> u32 {
        let colours = i64::from(self.colours.max(1));
        (if self.holds { index.clamp(0, colours - 1) } else { index.rem_euclid(colours) }) as u32
    }

    /// The shade after a change, relative to the block's entry.
    pub(crate) fn shade(self, change: &StyleChange) -> Shade {
        let wrapped = |index: i32| self.wrapped(i64::from(index));
        let moving = |number: u32| Shade { number, fixed: false };
        if self.has_faint && is_faint(change) {
            return Shade { number: self.colours, fixed: true };
        }
        match (self.by, change.colour) {
            // Colours along the path come from the descent, and those by density from the tone curve.
            (ColourSource::Constant | ColourSource::Along | ColourSource::Ink, _) => moving(0),
            (ColourSource::Level, _) => moving(self.wrapped(i64::from(change.level))),
            (ColourSource::Index, ColourChange::Set(index)) => Shade { number: wrapped(index), fixed: true },
            (ColourSource::Index, ColourChange::Add(count)) => moving(wrapped(count)),
        }
    }

    /// The shade `second` of a block that is entered with `first`.
    pub(crate) fn then(self, first: Shade, second: Shade) -> Shade {
        if second.fixed {
            return second;
        }
        let sum = first.number + second.number;
        let beyond = if self.holds { self.colours.max(1) - 1 } else { sum.wrapping_sub(self.colours) };
        Shade { number: if sum >= self.colours { beyond } else { sum }, fixed: first.fixed }
    }
}

/// Whether a change sets the faint colour.
fn is_faint(change: &StyleChange) -> bool {
    change.colour == ColourChange::Set(Style::FAINT)
}

/// The shades of a block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Inks {
    /// The block draws nothing.
    #[default]
    None,
    /// The block draws in one shade.
    One(Shade),
    /// The block draws in several shades.
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
pub(crate) struct InkTable {
    pub choice: Choice,
    /// Whether the table belongs to the present drawing.
    ready: bool,
    blocks: Vec<Inks>,
    /// The palette entries of the picture, by number on its canvas.
    used: Vec<u32>,
    /// Whether some shade is fixed inside a block.
    fixes: bool,
    /// Whether all blocks are known.
    made: bool,
    sweep: Sweep,
    /// The shades so far of the block being visited.
    block: Inks,
    /// The style and the block of the item that was visited last.
    last: Option<(StyleId, Option<BlockId>)>,
}

impl InkTable {
    /// Forgets the drawing.
    pub(crate) fn clear(&mut self) {
        self.ready = false;
    }

    /// Starts the table for a drawing, unless the present table fits. Returns whether anything changes.
    pub(crate) fn choose(&mut self, drawing: &Drawing, style: &Style) -> bool {
        let choice = Choice::new(style, &drawing.styles);
        if self.ready && self.choice == choice {
            return false;
        }
        *self = Self { ready: true, choice, ..Self::default() };
        true
    }

    /// Goes on with the table, until it is made.
    pub(crate) fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        let mut sweep = self.sweep;
        let progress = sweep.step(self, drawing, meter);
        self.sweep = sweep;
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
            Some(Inks::One(_)) if !choice.by.is_shared() => (0..choice.colours).collect(),
            Some(Inks::One(shade)) => vec![shade.number],
            Some(Inks::Many) => (0..choice.inks()).collect(),
            _ => vec![],
        };
    }

    /// The palette entries of the picture, by number.
    pub(crate) fn used(&self) -> &[u32] {
        &self.used
    }

    /// The shades of a block.
    pub(crate) fn of(&self, block: usize) -> Inks {
        self.blocks.get(block).copied().unwrap_or_default()
    }

    /// Binary digits of a palette entry's number.
    pub(crate) fn digits(&self) -> usize {
        (u32::BITS - (self.choice.inks() - 1).leading_zeros()) as usize
    }

    /// The number of bit planes for the colours of the picture.
    pub(crate) fn picture_planes(&self) -> usize {
        if self.used.len() > 1 { self.digits() } else { 0 }
    }

    /// The number of bit planes for the colours of a tile: the digits of the number and, if some shade is fixed, one
    /// more for the bit `fixed`.
    pub(crate) fn planes(&self, inks: Inks) -> usize {
        if inks == Inks::Many { self.digits() + usize::from(self.fixes) } else { 0 }
    }

    /// The dye for a tile with these shades that is entered with `shade`.
    pub(crate) fn dye(&self, inks: Inks, shade: Shade) -> Dye {
        let entry = match inks {
            Inks::One(own) => self.choice.then(shade, own),
            _ => shade,
        };
        Dye { entry, choice: self.choice, digits: self.digits() }
    }

    /// The shade as bits of planes.
    pub(crate) fn code(&self, shade: Shade) -> u32 {
        shade.code(self.digits())
    }
}

impl BlockVisitor for InkTable {
    fn item(&mut self, drawing: &Drawing, _: usize, _: usize, item: &Item) -> u64 {
        let (style, inner) = match item {
            Item::Stroke(stroke) => (stroke.style, None),
            Item::Polygon(polygon) => (polygon.style, None),
            Item::Block(placed) => (placed.style, Some(placed.block)),
        };
        // Long runs of strokes in one style are common: only the first of them counts.
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

/// Turns the shades of a tile into the shades at the place where the tile is stamped, 64 subsamples at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dye {
    /// The shade at the block's entry.
    pub entry: Shade,
    pub choice: Choice,
    /// Binary digits of a number. The plane after them holds the bit `fixed`.
    pub digits: usize,
}

/// The most bit planes of a picture's colours: the digits of [`MAX_PALETTE`] colours' numbers.
pub(crate) const PLANES: usize = MAX_PALETTE.next_power_of_two().trailing_zeros() as usize;

impl Dye {
    /// Whether a tile of `planes` bit planes becomes one shade throughout.
    #[inline(always)]
    pub(crate) fn is_even(&self, planes: usize) -> bool {
        planes == 0 || self.choice.holds && self.entry.number + 1 == self.choice.colours && planes <= self.digits
    }

    /// Adds the number of the entry's shade to the numbers of a tile, but for `fixed` subsamples. `numbers` has the
    /// words of each digit.
    pub(crate) fn apply<const N: usize>(&self, numbers: &mut [[u64; N]], fixed: &[u64; N]) {
        let by = self.entry.number;
        if by == 0 {
            return;
        }
        // n + by is within the palette if n < back = colours - by. Beyond, the result is the last number if the choice
        // holds, and otherwise n - back.
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
        // The subsamples that get the last number.
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
            let choice = Choice { by: ColourSource::Index, colours, has_faint: false, holds };
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
