//! The subsamples of a picture: one bit each for "covered", and a colour number in binary, a bit plane per digit.
//!
//! Bits lie in vertical strips of 64 columns, a word per row, so that stamping a tile at any offset is a loop over
//! consecutive words with one shift. Painting goes from the last drawn to the first: what is covered stays.
//!
//! What a broad stroke covers throughout is one number to eight words of each plane, so that large pictures of little
//! take little memory traffic; and nothing is cleared before it is painted upon.

use super::inks::Dye;
use super::tile::Bits;
use core::ops::Range;

/// Columns in a strip.
const STRIP: usize = u64::BITS as usize;
/// Rows in a cell; a cell is a strip's word range that is made pixels of at once.
const CELL: usize = 64;
/// Rows in a group; a group is a strip's word range for which it is remembered how it is covered.
pub(super) const GROUP: usize = 8;
/// So many subsamples of a group, of 512, may stay bare on a canvas that leaves holes: what a whole picture is off by
/// is 1/255 at most, and what 8x8 pixels are off by 2/255. The last holes of a crowd take longest to fill.
const HOLES: u32 = 2;
/// Groups in a word of bits.
const GROUPS: usize = u64::BITS as usize;

/// The words of a group.
type Block = [u64; GROUP];

/// The first and the last column of a shape in each row of a group.
pub(super) type Spans = [[i64; 2]; GROUP];
/// A row that a shape does not reach.
pub(super) const NOTHING: [i64; 2] = [1 << 40, -1];

/// A bit picture. Coordinates are subsamples, y down.
#[derive(Default)]
pub(super) struct Canvas {
    pub strips: usize,
    /// Whole groups of them.
    pub rows: usize,
    /// As many of the rows as were asked for.
    pub height: usize,
    /// Cells in a strip.
    pub cells: usize,
    /// Bit planes of colours.
    pub planes: usize,
    /// Whether what is covered but for a few holes counts as covered.
    pub holes: bool,
    /// By strip, then row. These are there where a group is mixed; elsewhere they are left over from other pictures.
    pub covered: Vec<u64>,
    /// The same by plane, then strip, then row. Only bits that are covered are ever set.
    pub colours: Vec<u64>,
    /// By strip: a bit for each group that is not covered throughout, or as good as that.
    open: Vec<u64>,
    /// By strip: a bit for each group whose subsamples differ.
    mixed: Vec<u64>,
    /// By strip, then group: the colour of one that is neither open nor mixed.
    plain: Vec<u16>,
}

/// What a group holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Group {
    /// Nothing.
    Bare,
    /// One colour throughout.
    Plain(u16),
    /// What its words tell.
    Mixed,
}

impl Canvas {
    /// Makes it empty and at least `width` by `height` subsamples.
    pub(super) fn reset(&mut self, width: usize, height: usize, planes: usize) {
        let (strips, rows) = (width.div_ceil(STRIP), height.next_multiple_of(GROUP));
        self.height = height;
        (self.strips, self.rows, self.planes) = (strips, rows, planes);
        self.cells = rows.div_ceil(CELL);
        let (words, size) = (strips * self.words(), strips * rows);
        self.covered.resize(size, 0);
        self.colours.resize(size * planes, 0);
        self.plain.resize(size / GROUP, 0);
        self.open.clear();
        self.open.resize(words, u64::MAX);
        self.mixed.clear();
        self.mixed.resize(words, 0);
    }

    /// What a group of a strip holds.
    #[inline]
    pub(super) fn group(&self, strip: usize, group: usize) -> Group {
        let (word, bit) = (strip * self.words() + group / GROUPS, 1 << (group % GROUPS));
        if self.mixed[word] & bit != 0 {
            Group::Mixed
        } else if self.open[word] & bit != 0 {
            Group::Bare
        } else {
            Group::Plain(self.plain[strip * (self.rows / GROUP) + group])
        }
    }

    /// The groups of a cell.
    pub(super) fn groups(&self, cell: usize) -> Range<usize> {
        cell * (CELL / GROUP)..((cell + 1) * (CELL / GROUP)).min(self.rows / GROUP)
    }

    /// Whether anything was painted in a cell of a strip.
    pub(super) fn is_touched(&self, strip: usize, cell: usize) -> bool {
        let groups = self.groups(cell);
        let word = strip * self.words() + groups.start / GROUPS;
        let bits = columns(groups.start / GROUPS, [groups.start, groups.end - 1]);
        (self.mixed[word] | !self.open[word]) & bits != 0
    }

    /// Lets the words of every group tell what it holds.
    pub(super) fn settle(&mut self) {
        for strip in 0..self.strips {
            for group in 0..self.rows / GROUP {
                let at = strip * self.rows + group * GROUP;
                match self.group(strip, group) {
                    Group::Mixed => {}
                    Group::Bare => self.begin_group(at, [0; GROUP]),
                    Group::Plain(colour) => {
                        self.begin_group(at, [u64::MAX; GROUP]);
                        self.colour(at, &[u64::MAX; GROUP], u32::from(colour));
                    }
                }
            }
        }
    }

    /// Sets the words of a group, which begins at a word of every plane: what is covered, and no colours.
    #[inline(always)]
    fn begin_group(&mut self, at: usize, bits: Block) {
        let size = self.covered.len();
        if let Some(words) = self.covered[at..].first_chunk_mut() {
            *words = bits;
        }
        for plane in 0..self.planes {
            if let Some(words) = self.colours[plane * size + at..].first_chunk_mut() {
                *words = [0; GROUP];
            }
        }
    }

    /// Words of bits for the groups of a strip.
    fn words(&self) -> usize {
        (self.rows / GROUP).div_ceil(GROUPS)
    }

    /// Those of the groups `first..=last` of a strip, which lie in one word, that are not covered throughout: bits.
    #[inline]
    fn open(&self, strip: usize, groups: [usize; 2]) -> u64 {
        let word = groups[0] / GROUPS;
        self.open[strip * self.words() + word] & columns(word, groups)
    }

    /// Whether the rectangle of columns `x` and rows `y`, ends included, is covered throughout (the part outside
    /// counts as covered).
    pub(super) fn is_full(&mut self, x: [i64; 2], y: [i64; 2]) -> bool {
        let Some((x, y)) = self.clip(x, y) else { return true };
        let groups = y.map(|row| row / GROUP);
        for strip in x[0] / STRIP..=x[1] / STRIP {
            let outside = !columns(strip, x);
            let column = &self.covered[strip * self.rows..][..self.rows];
            for word in groups[0] / GROUPS..=groups[1] / GROUPS {
                let index = strip * self.words() + word;
                let mut open = self.open[index] & columns(word, groups);
                while open != 0 {
                    if self.mixed[index] & (open & open.wrapping_neg()) == 0 {
                        return false;
                    }
                    let first = (word * GROUPS + open.trailing_zeros() as usize) * GROUP;
                    let rows = &column[first.max(y[0])..(first + GROUP).min(y[1] + 1)];
                    if rows.iter().any(|word| word | outside != u64::MAX) {
                        if !(self.holes && has_only_holes(&column[first..first + GROUP])) {
                            return false;
                        }
                        // Not before it is asked for: what fills a picture from one side to the other leaves no holes.
                        self.open[index] &= !(open & open.wrapping_neg());
                    }
                    open &= open - 1;
                }
            }
        }
        true
    }

    /// The part of a rectangle that lies on the canvas.
    fn clip(&self, x: [i64; 2], y: [i64; 2]) -> Option<([usize; 2], [usize; 2])> {
        let right = (self.strips * STRIP) as i64 - 1;
        let bottom = self.rows as i64 - 1;
        let x = [x[0].max(0), x[1].min(right)];
        let y = [y[0].max(0), y[1].min(bottom)];
        (x[0] <= x[1] && y[0] <= y[1]).then_some((x.map(|v| v as usize), y.map(|v| v as usize)))
    }

    /// Paints a tile with its upper left corner at (`x`, `y`), dyed.
    pub(super) fn stamp(&mut self, tile: &Bits<'_>, [x, y]: [i64; 2], dye: &Dye) {
        let shift = x.rem_euclid(STRIP as i64) as u32;
        let strips = tile.extents.len();
        let extent = |strip: usize| match tile.extents.get(strip) {
            Some(&extent) => [extent & u64::from(u32::MAX), extent >> 32].map(|row| row as i64),
            None => [i64::MAX, 0],
        };
        for strip in 0..strips + usize::from(shift > 0) {
            let to = x.div_euclid(STRIP as i64) + strip as i64;
            let Some(to) = usize::try_from(to).ok().filter(|&to| to < self.strips) else { continue };
            // Bits of this strip of the tile, and those that the one before it leaves over.
            let (mut rows, mut sources) = (extent(strip), [strip.min(strips - 1); 2]);
            if shift > 0 && strip > 0 {
                let before = extent(strip - 1);
                (rows, sources[0]) = ([rows[0].min(before[0]), rows[1].max(before[1])], strip - 1);
            }
            let above = rows[0].max(-y);
            let below = rows[1].min(self.rows as i64 - y);
            if above < below {
                let words = Words {
                    first: sources.map(|strip| strip * tile.rows),
                    masks: [strip > 0, strip < strips].map(|is| u64::from(is).wrapping_neg()),
                    shift,
                    start: 0,
                    count: 0,
                    skipped: 0,
                };
                self.stamp_strip(tile, &words, y, above..below, to, dye);
            }
        }
    }

    /// Paints `rows` of a tile, whose first is in row `top`, into a strip.
    fn stamp_strip(&mut self, tile: &Bits<'_>, words: &Words, top: i64, rows: Range<i64>, to: usize, dye: &Dye) {
        let [first, end] = [rows.start, rows.end].map(|row| (row + top) as usize);
        let groups = [first / GROUP, (end - 1) / GROUP];
        let strip_words = self.words();
        for word in groups[0] / GROUPS..=groups[1] / GROUPS {
            let mut open = self.open[to * strip_words + word] & columns(word, groups);
            while open != 0 {
                let group = word * GROUPS + open.trailing_zeros() as usize;
                open &= open - 1;
                let part = (group * GROUP).max(first)..(group * GROUP + GROUP).min(end);
                let start = (part.start as i64 - top) as usize;
                let words = Words { start, count: part.len(), skipped: part.start % GROUP, ..*words };
                let bits = words.of(tile.covered);
                if any(&bits)
                    && let Some(new) = self.cover(to, group, bits)
                    && self.planes > 0
                {
                    self.dye(to * self.rows + group * GROUP, &new, tile, &words, dye);
                }
            }
        }
    }

    /// Covers these subsamples of a group; those that were not covered, if there are any.
    #[inline(always)]
    fn cover(&mut self, strip: usize, group: usize, bits: Block) -> Option<Block> {
        let at = strip * self.rows + group * GROUP;
        let (word, bit) = (strip * self.words() + group / GROUPS, 1 << (group % GROUPS));
        if self.mixed[word] & bit == 0 {
            if !any(&bits) {
                return None;
            }
            self.mixed[word] |= bit;
            self.begin_group(at, bits);
            if bits == [u64::MAX; GROUP] {
                self.open[word] &= !bit;
            }
            return Some(bits);
        }
        let covered = self.covered[at..].first_chunk_mut::<GROUP>()?;
        let mut new = bits;
        for (new, covered) in new.iter_mut().zip(&mut *covered) {
            let before = *covered;
            *covered |= *new;
            *new &= !before;
        }
        if !any(&new) {
            return None;
        }
        if covered.iter().all(|&word| word == u64::MAX) {
            self.open[word] &= !bit;
        }
        Some(new)
    }

    /// Gives colours to what is `new` in a group that begins at a word of every plane: those of a tile's `words`, dyed.
    #[inline(always)]
    fn dye(&mut self, at: usize, new: &Block, tile: &Bits<'_>, words: &Words, dye: &Dye) {
        let size = self.covered.len();
        let of = |plane: usize| words.of(&tile.colours[plane * tile.covered.len()..]);
        let own = tile.colours.len() / tile.covered.len().max(1);
        if own == 0 || dye.is_even(own) {
            self.colour(at, new, dye.entry.code(dye.digits));
        } else {
            let mut start = at;
            dye.apply(own, self.planes, of, |colours| {
                if let Some(words) = self.colours.get_mut(start..).and_then(<[u64]>::first_chunk_mut::<GROUP>) {
                    for ((word, colour), new) in words.iter_mut().zip(colours).zip(new) {
                        *word |= colour & new;
                    }
                }
                start += size;
            });
        }
    }

    /// Gives a colour to what is `new` in a group that begins at a word of every plane.
    #[inline(always)]
    fn colour(&mut self, at: usize, new: &Block, colour: u32) {
        let size = self.covered.len();
        for plane in (0..self.planes).filter(|plane| colour >> plane & 1 != 0) {
            if let Some(words) = self.colours[plane * size + at..].first_chunk_mut::<GROUP>() {
                for (word, new) in words.iter_mut().zip(new) {
                    *word |= new;
                }
            }
        }
    }

    /// Paints a shape row by row. `spans` sets the spans of some rows of a group, which reach nothing before, and gives
    /// the first and the last column of them all; `bounds` gives columns between which the shape is in some rows.
    #[inline]
    pub(super) fn fill(
        &mut self,
        rows: Range<usize>,
        colour: u32,
        bounds: impl Fn(Range<usize>) -> [i64; 2],
        spans: impl Fn(Range<usize>, &mut Spans) -> [i64; 2],
    ) {
        let right = (self.strips * STRIP) as i64 - 1;
        let mut start = rows.start;
        while start < rows.end {
            let cell = start / CELL;
            let end = rows.end.min((cell + 1) * CELL);
            let groups = [start / GROUP, (end - 1) / GROUP];
            let reach = bounds(start..end);
            let reach = [reach[0].max(0), reach[1].min(right)];
            let strips =
                if reach[0] <= reach[1] { reach[0] as usize / STRIP..reach[1] as usize / STRIP + 1 } else { 0..0 };
            let mut open = strips.fold(0, |open, strip| open | self.open(strip, groups));
            while open != 0 {
                let group = groups[0] / GROUPS * GROUPS + open.trailing_zeros() as usize;
                open &= open - 1;
                let rows = start.max(group * GROUP)..end.min(group * GROUP + GROUP);
                let mut places = [NOTHING; GROUP];
                let reach = spans(rows, &mut places);
                self.fill_group(group, reach, &places, colour);
            }
            start = end;
        }
    }

    /// Paints some rows of a group; `reach` is from the first to the last of all their columns.
    #[inline(always)]
    fn fill_group(&mut self, group: usize, reach: [i64; 2], spans: &Spans, colour: u32) {
        const LAST: i64 = STRIP as i64 - 1;
        let right = (self.strips * STRIP) as i64 - 1;
        let strips = reach.map(|column| column.clamp(0, right) as usize / STRIP);
        if strips[0] == strips[1] && reach[0] >= 0 && reach[1] <= right {
            // Mostly so: what is thin and steep.
            let bits = |[first, last]: [i64; 2]| u64::MAX << (first & LAST) & u64::MAX >> (!last & LAST);
            let bits = spans.map(|span| if span[0] <= span[1] { bits(span) } else { 0 });
            return self.fill_strip(strips[0], group, bits, colour);
        }
        if reach[0] > right || reach[1] < 0 {
            return;
        }
        // Columns that all rows have: most of what is broad.
        let inner = spans.iter().fold([i64::MIN, i64::MAX], |[a, b], &[first, last]| [a.max(first), b.min(last)]);
        for strip in strips[0]..=strips[1] {
            if self.open(strip, [group; 2]) == 0 {
                continue;
            }
            let left = (strip * STRIP) as i64;
            if inner[0] <= left && left + LAST <= inner[1] {
                self.fill_whole(strip, group, colour);
                continue;
            }
            let bits = spans.map(|[first, last]| {
                let (first, last) = ((first - left).max(0), (last - left).min(LAST));
                if first <= last { u64::MAX << (first & LAST) & u64::MAX >> ((LAST - last) & LAST) } else { 0 }
            });
            self.fill_strip(strip, group, bits, colour);
        }
    }

    /// Paints all of a group.
    #[inline(always)]
    fn fill_whole(&mut self, strip: usize, group: usize, colour: u32) {
        let (word, bit) = (strip * self.words() + group / GROUPS, 1 << (group % GROUPS));
        if self.mixed[word] & bit == 0 {
            self.open[word] &= !bit;
            self.plain[strip * (self.rows / GROUP) + group] = (colour & !(u32::MAX << self.planes)) as u16;
        } else {
            self.fill_strip(strip, group, [u64::MAX; GROUP], colour);
        }
    }

    /// Paints these subsamples of a group.
    #[inline(always)]
    fn fill_strip(&mut self, strip: usize, group: usize, bits: Block, colour: u32) {
        if self.open(strip, [group; 2]) != 0
            && let Some(new) = self.cover(strip, group, bits)
        {
            self.colour(strip * self.rows + group * GROUP, &new, colour);
        }
    }
}

/// Where a group's words are in a tile: in two strips next to each other.
#[derive(Clone, Copy)]
struct Words {
    /// Where these strips begin in a plane.
    first: [usize; 2],
    /// All ones where there is such a strip.
    masks: [u64; 2],
    /// How far the bits are moved, from the first strip to the second.
    shift: u32,
    /// The first of the rows, and how many there are.
    start: usize,
    count: usize,
    /// Words of the group before those.
    skipped: usize,
}

impl Words {
    /// The words of a plane, in their places.
    #[inline(always)]
    fn of(&self, plane: &[u64]) -> Block {
        let moved = |before: u64, own: u64| {
            (before & self.masks[0]) >> 1 >> (63 - self.shift) | (own & self.masks[1]) << self.shift
        };
        let [before, own] = self.first.map(|first| &plane[first + self.start..][..self.count]);
        let mut group = [0; GROUP];
        if let (Some(before), Some(own)) = (before.first_chunk::<GROUP>(), own.first_chunk::<GROUP>()) {
            for ((word, before), own) in group.iter_mut().zip(before).zip(own) {
                *word = moved(*before, *own);
            }
        } else {
            for ((word, before), own) in group[self.skipped..].iter_mut().zip(before).zip(own) {
                *word = moved(*before, *own);
            }
        }
        group
    }
}

/// Whether a group has any bits.
#[inline(always)]
fn any(group: &Block) -> bool {
    group.iter().fold(0, |any, word| any | word) != 0
}

/// Whether these rows are covered, but for the holes that may be left.
fn has_only_holes(rows: &[u64]) -> bool {
    rows.iter().map(|row| row.count_zeros()).sum::<u32>() <= HOLES
}

/// The bits of a strip that lie in columns `x`, ends included.
fn columns(strip: usize, x: [usize; 2]) -> u64 {
    let low = x[0].saturating_sub(strip * STRIP).min(STRIP - 1);
    let high = (x[1] - strip * STRIP).min(STRIP - 1);
    u64::MAX << low & u64::MAX >> (STRIP - 1 - high)
}
