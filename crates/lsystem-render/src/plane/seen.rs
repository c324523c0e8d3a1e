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
/// Coordinates are rounded to a subsample divided by this, because exact repeats differ by rounding alone.
const STEPS: f64 = 65_536.0;

/// A lossy memory of what has been painted where. A place in the memory is covered, in whatever colours.
pub(super) struct Seen {
    /// Hashes; 0 is an empty slot.
    slots: Vec<u64>,
    /// Mixed into each hash, so that a new age forgets the old hashes without clearing the memory.
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
        self.age += 1;
        self.count = 0;
        self.slots.truncate(FIRST_SLOTS);
    }

    /// Remembers what was painted at these points of a canvas; `words` distinguish it from others at the same points.
    /// Returns whether it was new.
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
        if self.count > FULL * self.slots.len() && self.slots.len() < MAX_SLOTS {
            self.slots.resize(MAX_SLOTS, 0);
        }
        is_new
    }
}
