//! What has been painted already: overlapping branches often repeat each other exactly.

use super::mixer::Mixer;
use core::hash::Hasher;

/// How many things are remembered.
const SLOTS: usize = 1 << 16;
/// Places less than this part of a subsample apart count as the same: exact repeats differ by rounding alone.
const STEPS: f64 = 65_536.0;

/// A lossy memory of what has been painted where. What it knows is covered, in whatever colours.
pub(super) struct Seen {
    slots: Vec<u64>,
    /// Mixed into all that is remembered, so that it can be forgotten without clearing the memory.
    age: u64,
}

impl Default for Seen {
    fn default() -> Self {
        Self { slots: vec![0; SLOTS], age: 0 }
    }
}

impl Seen {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.age += 1;
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
        core::mem::replace(&mut self.slots[(hash >> 20) as usize % SLOTS], hash) != hash
    }
}
