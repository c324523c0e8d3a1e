//! How much work and memory a caller is willing to spend.

use crate::LimitName;

/// Every limit in one place; each is checked before the allocation it guards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Symbols of a string held in memory.
    pub symbols: u64,
    /// Segments of a drawing that does not memoise.
    pub segments: u64,
    /// Symbols derived, in all generations together, for a drawing that does not memoise.
    pub work: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { symbols: 256 << 20, segments: 2_000_000, work: 100_000_000 }
    }
}

impl Limits {
    /// The value of the limit called `name`.
    #[must_use]
    pub fn value(&self, name: LimitName) -> u64 {
        match name {
            LimitName::Symbols => self.symbols,
            LimitName::Segments => self.segments,
            LimitName::Work => self.work,
            LimitName::Iterations => u64::from(MAX_ITERATIONS),
        }
    }
}

/// The most derivation steps any system may ask for.
pub const MAX_ITERATIONS: u32 = 1_000;
