//! A memory of painted strokes and blocks: overlapping branches often repeat each other exactly.

use core::hash::Hasher;
use lsystem_base::Mixer;

/// Slots at first: 512 KiB.
const FIRST_SLOTS: usize = 1 << 16;
/// The most slots: 2 MiB. On a lattice far more blocks coincide than 512 KiB can hold.
const MAX_SLOTS: usize = 1 << 18;
/// The memory grows when so many times its slots have been filled: a larger one is slower, and most pictures take less.
const FULL: usize = 4;
/// The most bytes of the memory.
pub(super) const SEEN_BYTES: u64 = (MAX_SLOTS * size_of::<u64>()) as u64;
/// The difference of two ages: an odd number with bits throughout.
const AGE: u64 = 0x9e37_79b9_7f4a_7c15;
/// Coordinates are rounded to a subsample divided by this, because exact repeats differ by rounding alone.
const STEPS: f64 = 65_536.0;

/// A lossy memory of what has been painted where. A place in the memory is covered, in whatever colours.
pub(super) struct Seen {
    /// Hashes; 0 is an empty slot.
    slots: Vec<u64>,
    /// Mixed into each hash in its slot, so that a new age forgets the old hashes without clearing the memory. The slots
    /// do not depend on it: pictures are the same whatever was painted before.
    age: u64,
    /// The number of new hashes since the memory was cleared.
    count: usize,
}

impl Default for Seen {
    fn default() -> Self {
        Self { slots: vec![0; FIRST_SLOTS], age: 0, count: 0 }
    }
}

impl Seen {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.age = self.age.wrapping_add(AGE);
        self.count = 0;
        self.slots.truncate(FIRST_SLOTS);
    }

    /// Remembers what was painted at these points of a canvas; `words` distinguish it from others at the same points.
    /// Returns whether it was new.
    pub(super) fn paint<const N: usize, const M: usize>(&mut self, words: [u64; N], points: [[f64; 2]; M]) -> bool {
        let mut mixer = Mixer::default();
        words.into_iter().for_each(|word| mixer.write_u64(word));
        for value in points.as_flattened() {
            mixer.write_u64((value * STEPS + 0.5).floor() as i64 as u64);
        }
        let hash = mixer.finish();
        let slot = (hash >> 20) as usize & (self.slots.len() - 1);
        let mark = hash ^ self.age | 1;
        let is_new = core::mem::replace(&mut self.slots[slot], mark) != mark;
        self.count += usize::from(is_new);
        if self.count > FULL * self.slots.len() && self.slots.len() < MAX_SLOTS {
            self.slots.resize(MAX_SLOTS, 0);
        }
        is_new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lossy memory loses the same, whatever was painted before.
    #[test]
    fn old_pictures_are_forgotten_without_a_trace() {
        let [mut new, mut old] = [Seen::default(), Seen::default()];
        let words = |number: u64| number.wrapping_mul(number) % 300_007;
        for number in 0..2_000_000 {
            old.paint([number], [[0.5, 0.5]]);
        }
        old.clear();
        let repeats = (0..900_000).filter(|&number| {
            let is_new = [&mut new, &mut old].map(|seen| seen.paint([words(number)], [[0.5, 0.5]]));
            assert_eq!(is_new[0], is_new[1], "{number}");
            !is_new[0]
        });
        assert!(repeats.count() > 100_000);
    }
}
