//! What has been painted already: overlapping branches often repeat each other exactly.

use super::mixer::Mixer;
use core::hash::Hasher;

/// How many things are remembered at first: half a mebibyte.
const FIRST: usize = 1 << 16;
/// And at most: 2 MiB. On a lattice far more blocks coincide than a small memory knows of.
const MOST: usize = 1 << 18;
/// The bytes of the memory, at most.
pub(super) const SEEN: u64 = (MOST * size_of::<u64>()) as u64;
/// Places less than this part of a subsample apart count as the same: exact repeats differ by rounding alone.
const STEPS: f64 = 65_536.0;

/// A lossy memory of what has been painted where. What it knows is covered, in whatever colours.
pub(super) struct Seen {
    slots: Vec<u64>,
    /// Mixed into all that is remembered, so that it can be forgotten without clearing the memory.
    age: u64,
    /// How many things have been remembered since everything was forgotten.
    count: usize,
}

impl Default for Seen {
    fn default() -> Self {
        Self { slots: vec![0; FIRST], age: 0, count: 0 }
    }
}

impl Seen {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.age += 1;
        self.count = 0;
    }

    /// Notes something painted, told apart by `words` from others at these points of a canvas; whether it was new.
    pub(super) fn paint<const N: usize, const M: usize>(&mut self, words: [u64; N], points: [[f64; 2]; M]) -> bool {
        let mut mixer = Mixer::default();
        mixer.write_u64(self.age);
        words.into_iter().for_each(|word| mixer.write_u64(word));
        for value in points.as_flattened() {
            mixer.write_u64((value * STEPS + 0.5).floor() as i64 as u64);
        }
        let hash = mixer.finish() | 1;
        let slot = (hash >> 20) as usize & (self.slots.len() - 1);
        let is_new = core::mem::replace(&mut self.slots[slot], hash) != hash;
        self.count += usize::from(is_new);
        if self.count > self.slots.len() && self.slots.len() < MOST {
            self.slots.resize(2 * self.slots.len(), 0);
        }
        is_new
    }
}
