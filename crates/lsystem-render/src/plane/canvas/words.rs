//! Groups of rows in strips of columns: the words that a canvas is made of.

use super::bits::Planes;

/// Columns in a strip.
pub(in crate::plane) const STRIP: usize = u64::BITS as usize;
/// Rows in a group; a group is a strip's word range for which it is remembered how it is covered.
pub(in crate::plane) const GROUP: usize = 8;
/// So many subsamples of a group, of 512, may stay bare on a canvas that leaves holes: what a whole picture is off by
/// is 1/255 at most, and what 8x8 pixels are off by 2/255. The last holes of a crowd take longest to fill.
const HOLES: u32 = 2;

/// The words of a group.
pub(in crate::plane) type Block = [u64; GROUP];

/// The first and the last column of a shape in each row of a group.
pub(in crate::plane) type Spans = [[i64; 2]; GROUP];
/// A row that a shape does not reach.
pub(in crate::plane) const NOTHING: [i64; 2] = [1 << 40, -1];

/// Where a group's words are in a plane of a tile: in two strips next to each other.
#[derive(Clone, Copy)]
pub(in crate::plane) struct Words {
    /// Where they begin; the bits of the second move up by `shift`, and those of the first that this leaves over go below.
    pub(in crate::plane) at: [usize; 2],
    /// All ones where there is such a strip.
    pub(in crate::plane) masks: [u64; 2],
    pub(in crate::plane) shift: u32,
}

impl Words {
    /// The words of a plane, in their places. Where the tile covers nothing they are anything.
    #[inline(always)]
    pub(in crate::plane) fn of(&self, planes: &Planes<'_>, plane: usize) -> Block {
        self.moved(planes, plane, [u64::MAX; 2])
    }

    /// Those of a plane alone.
    #[inline(always)]
    pub(in crate::plane) fn masked(&self, planes: &Planes<'_>) -> Block {
        self.moved(planes, 0, self.masks)
    }

    #[inline(always)]
    fn moved(&self, planes: &Planes<'_>, plane: usize, masks: [u64; 2]) -> Block {
        let first = planes.first + plane * planes.size;
        let [before, own] = self.at.map(|at| {
            planes.words.get(first.wrapping_add(at)..).and_then(<[u64]>::first_chunk::<GROUP>).unwrap_or(&[0; GROUP])
        });
        let pair = |i: usize| funnel([before, own].map(|words| [words[i], words[i + 1]]), masks, self.shift);
        let [[a, b], [c, d], [e, f], [g, h]] = [pair(0), pair(2), pair(4), pair(6)];
        [a, b, c, d, e, f, g, h]
    }
}

/// Two words of a strip and two of the one before it as they are behind a shift; nothing is shifted where both are the
/// same.
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
fn funnel([before, own]: [[u64; 2]; 2], masks: [u64; 2], shift: u32) -> [u64; 2] {
    let word =
        |i: usize| (before[i] & masks[0]).wrapping_shr(shift.wrapping_neg()) | (own[i] & masks[1]).wrapping_shl(shift);
    [word(0), word(1)]
}

/// The same at once: the compiler finds no vectors in it.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[inline(always)]
fn funnel(words: [[u64; 2]; 2], masks: [u64; 2], shift: u32) -> [u64; 2] {
    use core::arch::wasm32::{u64x2, u64x2_extract_lane, u64x2_shl, u64x2_shr, u64x2_splat, v128_and, v128_or};
    let [before, own] = [0, 1].map(|i| v128_and(u64x2(words[i][0], words[i][1]), u64x2_splat(masks[i])));
    let moved = v128_or(u64x2_shr(before, shift.wrapping_neg()), u64x2_shl(own, shift));
    [u64x2_extract_lane::<0>(moved), u64x2_extract_lane::<1>(moved)]
}

/// The bits of a strip that lie in these spans.
#[inline(always)]
pub(in crate::plane) fn within(strip: usize, spans: &Spans) -> Block {
    const LAST: i64 = STRIP as i64 - 1;
    let left = (strip * STRIP) as i64;
    spans.map(|[first, last]| {
        let (first, last) = ((first - left).max(0), (last - left).min(LAST));
        if first <= last { u64::MAX << (first & LAST) & u64::MAX >> ((LAST - last) & LAST) } else { 0 }
    })
}

/// Whether a group has any bits.
#[inline(always)]
pub(in crate::plane) fn any(group: &Block) -> bool {
    let [a, b, c, d, e, f, g, h] = *group;
    let pair = [a | c | e | g, b | d | f | h];
    pair[0] | pair[1] != 0
}

/// Whether these rows are covered, but for the holes that may be left.
pub(in crate::plane) fn has_only_holes(rows: &[u64]) -> bool {
    let mut holes = 0;
    rows.iter().all(|row| {
        holes += row.count_zeros();
        holes <= HOLES
    })
}

/// The bits of a strip that lie in columns `x`, ends included.
pub(in crate::plane) fn columns(strip: usize, x: [usize; 2]) -> u64 {
    let low = x[0].saturating_sub(strip * STRIP).min(STRIP - 1);
    let high = (x[1] - strip * STRIP).min(STRIP - 1);
    u64::MAX << low & u64::MAX >> (STRIP - 1 - high)
}
