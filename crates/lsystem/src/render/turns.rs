//! Cosines and sines, remembered.

use super::mixer::Mixer;
use crate::Heading;
use core::hash::{Hash, Hasher};

/// How many headings are remembered: systems with 3600 of them use few at a time.
const SLOTS: usize = 1024;

/// A table of headings met lately.
pub(super) struct Turns {
    slots: Vec<(Heading, [f64; 2])>,
}

impl Default for Turns {
    fn default() -> Self {
        Self { slots: vec![(Heading::EAST, [1.0, 0.0]); SLOTS] }
    }
}

impl Turns {
    /// The same as [`Heading::cos_sin`].
    pub(super) fn cos_sin(&mut self, heading: Heading) -> [f64; 2] {
        let mut mixer = Mixer::default();
        heading.hash(&mut mixer);
        let slot = &mut self.slots[mixer.finish() as usize % SLOTS];
        if slot.0 != heading {
            let (c, s) = heading.cos_sin();
            *slot = (heading, [c, s]);
        }
        slot.1
    }
}
