//! How much work and memory a caller is willing to spend.

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

/// The most derivation steps any system may ask for.
pub const MAX_ITERATIONS: u32 = 1_000;
