//! Groups of rows in strips of columns: the words that a canvas is made of.

use super::bits::Planes;

/// Columns in a strip.
pub(in crate::plane) const STRIP: usize = u64::BITS as usize;
/// Rows in a group. A group is 8 rows of a strip; the canvas keeps its state in a few bits.
pub(in crate::plane) const GROUP: usize = 8;
/// The most bare subsamples, of 512, in a group that counts as covered on a canvas that leaves holes, because the last
/// holes of a crowd take longest to fill. A whole picture is off by 1/255 at most, and 8x8 pixels by 2/255.
const MAX_HOLES: u32 = 2;

/// The words of a group.
pub(in crate::plane) type GroupBits = [u64; GROUP];

/// The first and the last column of a shape in each row of a group.
pub(in crate::plane) type Spans = [[i64; 2]; GROUP];
/// The empty span of a row that a shape does not reach.
pub(in crate::plane) const NOTHING: [i64; 2] = [1 << 40, -1];

/// The place of a group's words in a plane of a tile. A shifted tile has them in two strips next to each other.
#[derive(Clone, Copy)]
pub(in crate::plane) struct Words {
    /// The first word in the strip before and in the strip itself.
    pub(in crate::plane) at: [usize; 2],
    /// For each of the two strips: all ones if the tile has it, otherwise 0.
    pub(in crate::plane) masks: [u64; 2],
    /// The columns by which bits move to the right.
    pub(in crate::plane) shift: u32,
}

impl Words {
    /// The shifted words of a plane. Bits that the tile does not cover are arbitrary.
    #[inline(always)]
    pub(in crate::plane) fn of(&self, planes: &Planes<'_>, plane: usize) -> GroupBits {
        self.moved(planes, plane, [u64::MAX; 2])
    }

    /// The shifted words of the first plane. Bits outside the tile are 0.
    #[inline(always)]
    pub(in crate::plane) fn masked(&self, planes: &Planes<'_>) -> GroupBits {
        self.moved(planes, 0, self.masks)
    }

    #[inline(always)]
    fn moved(&self, planes: &Planes<'_>, plane: usize, masks: [u64; 2]) -> GroupBits {
        let first = planes.first + plane * planes.size;
        let [before, own] = self.at.map(|at| {
            planes.words.get(first.wrapping_add(at)..).and_then(<[u64]>::first_chunk::<GROUP>).unwrap_or(&[0; GROUP])
        });
        let pair = |i: usize| funnel([before, own].map(|words| [words[i], words[i + 1]]), masks, self.shift);
        let [[a, b], [c, d], [e, f], [g, h]] = [pair(0), pair(2), pair(4), pair(6)];
        [a, b, c, d, e, f, g, h]
    }
}

/// Shifts two words of a strip to the right, and the rest of two words of the strip before into their gaps. With a
/// shift of 0 both strips are the same.
#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
#[inline(always)]
fn funnel([before, own]: [[u64; 2]; 2], masks: [u64; 2], shift: u32) -> [u64; 2] {
    let word =
        |i: usize| (before[i] & masks[0]).wrapping_shr(shift.wrapping_neg()) | (own[i] & masks[1]).wrapping_shl(shift);
    [word(0), word(1)]
}

/// As the portable version, with explicit vectors, because the compiler finds none in it.
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
pub(in crate::plane) fn within(strip: usize, spans: &Spans) -> GroupBits {
    const LAST: i64 = STRIP as i64 - 1;
    let left = (strip * STRIP) as i64;
    spans.map(|[first, last]| {
        let (first, last) = ((first - left).max(0), (last - left).min(LAST));
        if first <= last { u64::MAX << (first & LAST) & u64::MAX >> ((LAST - last) & LAST) } else { 0 }
    })
}

/// Whether a group has any bits.
#[inline(always)]
pub(in crate::plane) fn any(group: &GroupBits) -> bool {
    let [a, b, c, d, e, f, g, h] = *group;
    let pair = [a | c | e | g, b | d | f | h];
    pair[0] | pair[1] != 0
}

/// Whether these rows are covered but for the permitted holes.
pub(in crate::plane) fn has_only_holes(rows: &[u64]) -> bool {
    let mut holes = 0;
    rows.iter().all(|row| {
        holes += row.count_zeros();
        holes <= MAX_HOLES
    })
}

/// The bits of a strip that lie in columns `x`, ends included.
pub(in crate::plane) fn columns(strip: usize, x: [usize; 2]) -> u64 {
    let low = x[0].saturating_sub(strip * STRIP).min(STRIP - 1);
    let high = (x[1] - strip * STRIP).min(STRIP - 1);
    u64::MAX << low & u64::MAX >> (STRIP - 1 - high)
}
