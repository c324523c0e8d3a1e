//! What has been painted already: overlapping branches often repeat each other exactly.

use super::mixer::Mixer;
use super::tile::Key;
use core::hash::{Hash, Hasher};

/// How many things are remembered as painted.
const SLOTS: usize = 1 << 16;
/// How many tiles are remembered as wanted.
const WANTED: usize = 1 << 14;
/// Places this part of a subsample apart count as the same.
const STEPS: f64 = 64.0;

/// A lossy memory of what has been painted where. What it knows is covered, in whatever colours.
pub(super) struct Seen {
    painted: Vec<u64>,
    wanted: Vec<u64>,
    /// Mixed into all that is remembered as painted, so that it can be forgotten without clearing the memory.
    age: u64,
}

impl Default for Seen {
    fn default() -> Self {
        Self { painted: vec![0; SLOTS], wanted: vec![0; WANTED], age: 0 }
    }
}

impl Seen {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.age += 1;
        self.wanted.fill(0);
    }

    /// Notes something painted, told apart by `words` from others at these points of a canvas; whether it was new.
    pub(super) fn paint<const N: usize, const M: usize>(&mut self, words: [u64; N], points: [[f64; 2]; M]) -> bool {
        let mut mixer = Mixer::default();
        mixer.write_u64(self.age);
        words.into_iter().for_each(|word| mixer.write_u64(word));
        for value in points.as_flattened() {
            mixer.write_u64((value * STEPS + 0.5).floor() as i64 as u64);
        }
        note(&mut self.painted, &mixer)
    }

    /// Notes a tile that is wanted; whether it was not wanted before.
    pub(super) fn want(&mut self, key: &Key) -> bool {
        let mut mixer = Mixer::default();
        key.hash(&mut mixer);
        note(&mut self.wanted, &mixer)
    }
}

/// Whether it is not among those noted last.
fn note(slots: &mut [u64], mixer: &Mixer) -> bool {
    let hash = mixer.finish() | 1;
    let slot = (hash >> 20) as usize % slots.len();
    core::mem::replace(&mut slots[slot], hash) != hash
}
