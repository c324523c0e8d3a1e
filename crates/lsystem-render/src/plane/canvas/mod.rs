//! The subsamples of a picture: one bit each for "covered", and a colour number in binary, with a bit plane per digit.
//!
//! Bits lie in vertical strips of 64 columns, a word per row, so that stamping a tile at any offset is a loop over
//! consecutive words with one shift. Painting goes from the last drawn to the first: a covered subsample stays.
//!
//! A group of eight words that one colour covers is stored as one number, and a group is cleared only when it is first
//! painted. So large pictures with few strokes take little memory traffic.

pub(in crate::plane) mod bit_words;
pub(in crate::plane) mod bits;
pub(super) mod cone;
pub(in crate::plane) mod polygon;
pub(in crate::plane) mod resolve;
pub(in crate::plane) mod stroke;

use crate::ink::{Dye, PLANES};
use bit_words::{GROUP, GroupBits, NOTHING, STRIP, Spans, Words, any, columns, has_only_holes, within};
use bits::Bits;
use core::ops::Range;
use lsystem_base::{Meter, Progress};

/// Rows in a cell. A cell is 64 rows of a strip, and is turned into pixels at once.
const CELL: usize = 64;
/// Groups whose states fit into a word.
const GROUPS: usize = u64::BITS as usize;

/// A bit picture. Coordinates are subsamples, y down.
#[derive(Default)]
pub(in crate::plane) struct Canvas {
    pub strips: usize,
    /// The rows: `height`, rounded up to whole groups.
    pub rows: usize,
    /// The rows that were asked for.
    pub height: usize,
    /// Cells in a strip.
    pub cells: usize,
    /// Bit planes of colours.
    pub planes: usize,
    /// Whether a group with a few holes counts as covered.
    pub holes: bool,
    /// The covered subsamples: by strip, then row. Valid only in mixed groups; other words are leftovers.
    pub covered: Vec<u64>,
    /// The digits of colours: by plane, then strip, then row. A bit is set only where the subsample is covered.
    pub colours: Vec<u64>,
    /// By strip: a bit for each group that is not yet covered throughout (but for holes).
    open: Vec<u64>,
    /// By strip: a bit for each group whose words are valid.
    mixed: Vec<u64>,
    /// By strip, then group: the colour of a group that is neither open nor mixed.
    plain: Vec<u16>,
    /// Units of work since the last [`Canvas::take_work`], without those that the painters count.
    work: u64,
    /// While room is made: the words of a plane and the number of planes, and the words that are done.
    room: ([usize; 2], usize),
}

/// Strips, or words of bits, that are looked at in a unit of work.
const LOOKS_PER_UNIT: usize = 16;
/// Groups that are painted in a unit of work.
const GROUPS_PER_UNIT: usize = 4;
/// Words that are cleared or copied in a unit of work.
const WORDS_PER_UNIT: usize = 128;
/// Words that room is made for between two looks at the meter: 4 MiB.
const PIECE: usize = WORDS_PER_UNIT << 12;

/// The state of a group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::plane) enum Group {
    /// No subsample is covered.
    Bare,
    /// One colour covers all subsamples.
    Plain(u16),
    /// The words of the group hold its subsamples.
    Mixed,
}

impl Canvas {
    /// Empties the canvas and makes it at least `width` by `height` subsamples.
    pub(in crate::plane) fn reset(&mut self, width: usize, height: usize, planes: usize) {
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
        self.work += ((words + size * (1 + planes)) / WORDS_PER_UNIT) as u64;
    }

    /// Makes room for `width` by `height` subsamples, in pieces: the first touch of new memory takes most of the time.
    pub(in crate::plane) fn make_room(
        &mut self,
        [width, height]: [usize; 2],
        planes: usize,
        meter: &mut Meter,
    ) -> Progress {
        let size = width.div_ceil(STRIP) * height.next_multiple_of(GROUP);
        let all = size * (1 + planes);
        let (wanted, done) = &mut self.room;
        if *wanted != [size, planes] {
            (*wanted, *done) = ([size, planes], 0);
        }
        while *done < all {
            let next = all.min(*done + PIECE);
            grow(&mut self.covered, next.min(size), size);
            grow(&mut self.colours, next.saturating_sub(size), size * planes);
            meter.charge((1 + (next - *done) / WORDS_PER_UNIT) as u64);
            *done = next;
            // Each call does at least one piece, so that calls with a spent meter end.
            if meter.is_spent() && next < all {
                return Progress::More;
            }
        }
        *done = 0;
        Progress::Done
    }

    /// Returns the units of work since the last call, without those that the painters count.
    pub(in crate::plane) fn take_work(&mut self) -> u64 {
        core::mem::take(&mut self.work)
    }

    /// The state of a group of a strip.
    #[inline]
    pub(in crate::plane) fn group(&self, strip: usize, group: usize) -> Group {
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
    pub(in crate::plane) fn groups(&self, cell: usize) -> Range<usize> {
        cell * (CELL / GROUP)..((cell + 1) * (CELL / GROUP)).min(self.rows / GROUP)
    }

    /// Whether anything was painted in a cell of a strip.
    pub(in crate::plane) fn is_touched(&self, strip: usize, cell: usize) -> bool {
        let groups = self.groups(cell);
        let word = strip * self.words() + groups.start / GROUPS;
        let bits = columns(groups.start / GROUPS, [groups.start, groups.end - 1]);
        (self.mixed[word] | !self.open[word]) & bits != 0
    }

    /// Writes the state of every group to its words.
    pub(in crate::plane) fn settle(&mut self) {
        self.work += (self.covered.len() * (1 + self.planes) / WORDS_PER_UNIT) as u64;
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

    /// Sets the words of a group, which begins at the word `at` of every plane: the coverage `bits`, and no colours.
    fn begin_group(&mut self, at: usize, bits: GroupBits) {
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

    /// The bits of the open groups among the groups `first..=last` of a strip, which share one word.
    #[inline]
    fn open(&self, strip: usize, groups: [usize; 2]) -> u64 {
        let word = groups[0] / GROUPS;
        self.open[strip * self.words() + word] & columns(word, groups)
    }

    /// The planes of colours, each with the layout of `covered`.
    pub(in crate::plane) fn colour_planes(&self) -> impl Iterator<Item = &[u64]> {
        self.colours.chunks_exact(self.covered.len().max(1))
    }

    /// The width and the height in subsamples, in whole strips and groups.
    pub(in crate::plane) fn size(&self) -> [f64; 2] {
        [self.strips * STRIP, self.rows].map(|side| side as f64)
    }

    /// Whether the rectangle of columns `x` and rows `y`, ends included, is covered throughout (the part outside
    /// counts as covered).
    pub(in crate::plane) fn is_full(&mut self, x: [i64; 2], y: [i64; 2]) -> bool {
        let Some((x, y)) = self.clip(x, y) else { return true };
        let groups = y.map(|row| row / GROUP);
        let words = groups[1] / GROUPS - groups[0] / GROUPS + 1;
        let mut looks = 0;
        for strip in x[0] / STRIP..=x[1] / STRIP {
            looks += words;
            if looks >= LOOKS_PER_UNIT {
                self.work += (looks / LOOKS_PER_UNIT) as u64;
                looks %= LOOKS_PER_UNIT;
            }
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
                        // Holes are looked for only on demand: most strokes leave none.
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
    pub(in crate::plane) fn stamp(&mut self, tile: &Bits<'_>, [x, y]: [i64; 2], dye: &Dye) {
        let shift = x.rem_euclid(STRIP as i64) as u32;
        let strips = tile.extents.len();
        let extent = |strip: usize| match tile.extents.get(strip) {
            Some(&extent) => [extent & u64::from(u32::MAX), extent >> 32].map(|row| row as i64),
            None => [i64::MAX, 0],
        };
        for strip in 0..strips + usize::from(shift > 0) {
            let to = x.div_euclid(STRIP as i64) + strip as i64;
            let Some(to) = usize::try_from(to).ok().filter(|&to| to < self.strips) else { continue };
            // A strip of the canvas takes bits of this strip of the tile, and the rest of the strip before.
            let (mut rows, mut sources) = (extent(strip), [strip.min(strips - 1); 2]);
            if shift > 0 && strip > 0 {
                let before = extent(strip - 1);
                (rows, sources[0]) = ([rows[0].min(before[0]), rows[1].max(before[1])], strip - 1);
            }
            let above = rows[0].max(-y);
            let below = rows[1].min(self.rows as i64 - y);
            if above < below {
                let words = Words {
                    at: sources.map(|strip| strip * tile.rows),
                    masks: [strip > 0, strip < strips].map(|is| u64::from(is).wrapping_neg()),
                    shift,
                };
                self.stamp_strip(tile, words, y, above..below, to, dye);
            }
        }
    }

    /// Paints `rows` of a tile, whose first is in row `top`, into a strip.
    fn stamp_strip(&mut self, tile: &Bits<'_>, words: Words, top: i64, rows: Range<i64>, to: usize, dye: &Dye) {
        let [first, end] = [rows.start, rows.end].map(|row| (row + top) as usize);
        let groups = [first / GROUP, (end - 1) / GROUP];
        let strip_words = self.words();
        for word in groups[0] / GROUPS..=groups[1] / GROUPS {
            let mut open = self.open[to * strip_words + word] & columns(word, groups);
            while open != 0 {
                let group = word * GROUPS + open.trailing_zeros() as usize;
                open &= open - 1;
                // Words before the first row of the tile and behind the last belong to others, so they are masked.
                let skipped = (group * GROUP) as i64 - top;
                let words = Words { at: words.at.map(|at| at.wrapping_add_signed(skipped as isize)), ..words };
                let mut bits = words.masked(&tile.covered);
                if group * GROUP < first || group * GROUP + GROUP > end {
                    for (row, bits) in (group * GROUP..).zip(&mut bits) {
                        *bits = if (first..end).contains(&row) { *bits } else { 0 };
                    }
                }
                if any(&bits)
                    && let Some(new) = self.cover(to, group, bits)
                    && self.planes > 0
                {
                    self.dye(to * self.rows + group * GROUP, &new, tile, &words, dye);
                }
            }
        }
    }

    /// Paints these subsamples of a group, in colours whose digits are given by plane.
    pub(in crate::plane) fn put(
        &mut self,
        strip: usize,
        group: usize,
        bits: GroupBits,
        digit: impl Fn(usize) -> GroupBits,
    ) {
        if let Some(new) = self.cover(strip, group, bits) {
            for plane in 0..self.planes {
                self.add(plane, strip * self.rows + group * GROUP, &new, &digit(plane));
            }
        }
    }

    /// Covers these subsamples of a group. Returns the subsamples that were not covered before, if there are any.
    #[inline(always)]
    fn cover(&mut self, strip: usize, group: usize, bits: GroupBits) -> Option<GroupBits> {
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
        let [a, b, c, d, e, f, g, h] = *covered;
        let pair = [a & c & e & g, b & d & f & h];
        if pair[0] & pair[1] == u64::MAX {
            self.open[word] &= !bit;
        }
        Some(new)
    }

    /// Gives the `new` subsamples of a group, which begins at the word `at` of every plane, the dyed colours of a tile.
    #[inline(always)]
    fn dye(&mut self, at: usize, new: &GroupBits, tile: &Bits<'_>, words: &Words, dye: &Dye) {
        if dye.is_even(tile.colours.count) {
            return self.colour(at, new, dye.entry.code(dye.digits));
        }
        let fixed = || if tile.colours.count > dye.digits { words.of(&tile.colours, dye.digits) } else { [0; GROUP] };
        if let Some(dyed) = &tile.dyed {
            for digit in 0..dye.digits {
                self.add(digit, at, new, &words.of(dyed, digit));
            }
        } else {
            let mut numbers = [[0; GROUP]; PLANES];
            for (digit, number) in numbers.iter_mut().enumerate().take(dye.digits) {
                *number = words.of(&tile.colours, digit);
            }
            dye.apply(&mut numbers[..dye.digits], &fixed());
            for (digit, number) in numbers.iter().enumerate().take(dye.digits) {
                self.add(digit, at, new, number);
            }
        }
        if self.planes > dye.digits {
            self.add(dye.digits, at, new, &if dye.entry.fixed { *new } else { fixed() });
        }
    }

    /// Sets those of the `bits` that are `new`, in a plane of a group that begins at the word `at`.
    #[inline(always)]
    fn add(&mut self, plane: usize, at: usize, new: &GroupBits, bits: &GroupBits) {
        if let Some(words) = self.colours[plane * self.covered.len() + at..].first_chunk_mut::<GROUP>() {
            for ((word, bits), new) in words.iter_mut().zip(bits).zip(new) {
                *word |= bits & new;
            }
        }
    }

    /// Gives the `new` subsamples of a group, which begins at the word `at` of every plane, a colour.
    #[inline(always)]
    fn colour(&mut self, at: usize, new: &GroupBits, colour: u32) {
        for plane in (0..self.planes).filter(|plane| colour >> plane & 1 != 0) {
            self.add(plane, at, new, new);
        }
    }

    /// Paints a shape; the arguments are those of [`Canvas::trace`].
    #[inline]
    pub(in crate::plane) fn fill(
        &mut self,
        rows: Range<usize>,
        colour: u32,
        bounds: impl Fn(Range<usize>) -> [i64; 2],
        spans: impl Fn(Range<usize>, &mut Spans) -> [i64; 2],
    ) {
        self.trace(rows, bounds, spans, |canvas, group, reach, spans| {
            canvas.fill_group(group, reach, spans, colour);
            true
        });
    }

    /// Visits the open groups of a shape from top to bottom, until `visit` returns `false`. `spans` sets the spans of
    /// some rows of a group, which are empty before, and returns their first and last column. `bounds` returns columns
    /// between which the shape lies in some rows.
    #[inline(always)]
    pub(in crate::plane) fn trace(
        &mut self,
        rows: Range<usize>,
        bounds: impl Fn(Range<usize>) -> [i64; 2],
        spans: impl Fn(Range<usize>, &mut Spans) -> [i64; 2],
        mut visit: impl FnMut(&mut Self, usize, [i64; 2], &Spans) -> bool,
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
            if strips.len() > LOOKS_PER_UNIT {
                self.work += (strips.len() / LOOKS_PER_UNIT) as u64;
            }
            let mut open = strips.fold(0, |open, strip| open | self.open(strip, groups));
            while open != 0 {
                let group = groups[0] / GROUPS * GROUPS + open.trailing_zeros() as usize;
                open &= open - 1;
                let rows = start.max(group * GROUP)..end.min(group * GROUP + GROUP);
                let mut places = [NOTHING; GROUP];
                let reach = spans(rows, &mut places);
                if !visit(self, group, reach, &places) {
                    return;
                }
            }
            start = end;
        }
    }

    /// Whether the spans in a group are covered; `reach` is their first and last column.
    pub(in crate::plane) fn is_group_full(&mut self, group: usize, reach: [i64; 2], spans: &Spans) -> bool {
        let right = (self.strips * STRIP) as i64 - 1;
        if reach[0] > right || reach[1] < 0 {
            return true;
        }
        let strips = reach.map(|column| column.clamp(0, right) as usize / STRIP);
        self.work += (strips[1].saturating_sub(strips[0]) / GROUPS_PER_UNIT) as u64;
        (strips[0]..=strips[1]).filter(|&strip| self.open(strip, [group; 2]) != 0).all(|strip| {
            let bits = within(strip, spans);
            let mixed = self.group(strip, group) == Group::Mixed;
            let covered = &self.covered[strip * self.rows + group * GROUP..][..GROUP];
            bits.iter().zip(covered).all(|(bits, covered)| bits & !(if mixed { *covered } else { 0 }) == 0)
        })
    }

    /// Paints the spans in a group; `reach` is their first and last column.
    #[inline(always)]
    pub(in crate::plane) fn fill_group(&mut self, group: usize, reach: [i64; 2], spans: &Spans, colour: u32) {
        const LAST: i64 = STRIP as i64 - 1;
        let right = (self.strips * STRIP) as i64 - 1;
        let strips = reach.map(|column| column.clamp(0, right) as usize / STRIP);
        if strips[0] == strips[1] && reach[0] >= 0 && reach[1] <= right {
            // Thin steep strokes, the most frequent, lie in one strip.
            let bits = |[first, last]: [i64; 2]| u64::MAX << (first & LAST) & u64::MAX >> (!last & LAST);
            let bits = spans.map(|span| if span[0] <= span[1] { bits(span) } else { 0 });
            return self.fill_strip(strips[0], group, bits, colour);
        }
        if reach[0] > right || reach[1] < 0 {
            return;
        }
        self.work += (strips[1].saturating_sub(strips[0]) / GROUPS_PER_UNIT) as u64;
        // The columns that all rows have make up most of a broad stroke.
        let inner = spans.iter().fold([i64::MIN, i64::MAX], |[a, b], &[first, last]| [a.max(first), b.min(last)]);
        for strip in strips[0]..=strips[1] {
            if self.open(strip, [group; 2]) == 0 {
                continue;
            }
            let left = (strip * STRIP) as i64;
            let bits = if inner[0] <= left && left + LAST <= inner[1] {
                if self.fill_bare(strip, group, colour) {
                    continue;
                }
                [u64::MAX; GROUP]
            } else {
                within(strip, spans)
            };
            self.fill_strip(strip, group, bits, colour);
        }
    }

    /// Paints all of an open group, if the group is bare. Returns whether it was.
    #[inline]
    fn fill_bare(&mut self, strip: usize, group: usize, colour: u32) -> bool {
        let (word, bit) = (strip * self.words() + group / GROUPS, 1 << (group % GROUPS));
        let bare = self.mixed[word] & bit == 0;
        if bare {
            self.open[word] &= !bit;
            self.plain[strip * (self.rows / GROUP) + group] = (colour & !(u32::MAX << self.planes)) as u16;
        }
        bare
    }

    /// Paints these subsamples of a group.
    #[inline(always)]
    fn fill_strip(&mut self, strip: usize, group: usize, bits: GroupBits, colour: u32) {
        if self.open(strip, [group; 2]) != 0
            && let Some(new) = self.cover(strip, group, bits)
        {
            self.colour(strip * self.rows + group * GROUP, &new, colour);
        }
    }
}

/// Makes a list at least `length` long, with room for the final length `whole`.
fn grow(list: &mut Vec<u64>, length: usize, whole: usize) {
    if list.len() < length {
        list.reserve_exact(whole - list.len());
        list.resize(length, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plane::canvas::polygon;
    use crate::plane::canvas::stroke::Capsule;

    fn paint(canvas: &mut Canvas, colours: u32) {
        for (colour, radius) in (0..colours).zip([2.0, 20.0, 45.0, 70.0].into_iter().cycle()) {
            let along = f64::from(colour) * 37.0;
            Capsule { from: [along, 90.0], to: [200.0 - along, along], radius }.paint(canvas, colour);
            polygon::paint(canvas, &[[along, 0.0], [along + 90.0, 10.0], [150.0, 40.0 + along]], colour);
        }
        canvas.settle();
    }

    #[test]
    fn room_is_made_in_pieces() {
        let mut canvas = Canvas::default();
        let (mut steps, mut largest) = (0, 0);
        while {
            let mut meter = Meter::new(1000);
            let progress = canvas.make_room([32_768, 16_384], 1, &mut meter);
            largest = largest.max(meter.spent());
            steps += 1;
            progress == Progress::More
        } {}
        assert!(steps > 10 && largest <= 1000 + Meter::PIECE, "{steps} steps, {largest}");
        let room = canvas.covered.len();
        canvas.reset(32_768, 16_384, 1);
        assert_eq!(room, canvas.covered.len());
    }

    #[test]
    fn nothing_is_left_of_the_picture_before() {
        let mut used = Canvas::default();
        for (width, height, planes) in [(256, 200, 3), (256, 200, 3), (130, 77, 0), (300, 160, 2), (256, 200, 3)] {
            let mut fresh = Canvas::default();
            for canvas in [&mut used, &mut fresh] {
                canvas.reset(width, height, planes);
                paint(canvas, 1 << planes);
            }
            assert!(used.covered == fresh.covered, "{width} {height} {planes}");
            assert!(used.colours == fresh.colours, "{width} {height} {planes}");
            used.reset(width, height, planes);
            paint(&mut used, 0);
            assert!(used.covered.iter().chain(&used.colours).all(|&word| word == 0));
        }
    }

    #[test]
    fn what_is_covered_throughout_is_painted_no_more() {
        let mut canvas = Canvas::default();
        canvas.reset(256, 64, 2);
        let wide = |radius| Capsule { from: [-200.0, 32.0], to: [500.0, 32.0], radius };
        wide(100.0).paint(&mut canvas, 2);
        assert!(canvas.is_full([0, 255], [0, 63]));
        assert!((0..4).all(|strip| canvas.groups(0).all(|group| canvas.group(strip, group) == Group::Plain(2))));
        wide(10.0).paint(&mut canvas, 1);
        canvas.settle();
        let (low, high) = canvas.colours.split_at(canvas.covered.len());
        assert!(canvas.covered.iter().chain(high).all(|&word| word == u64::MAX) && low.iter().all(|&word| word == 0));
    }
}
