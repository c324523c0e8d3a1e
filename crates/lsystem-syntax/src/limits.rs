//! How much work and memory a caller is willing to spend.

use crate::LimitName;

/// Every limit in one place; each is checked before the allocation it guards.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Symbols of a string held in memory.
    pub symbols: u64,
    /// Modules, and numbers in them, of one generation held in memory.
    pub modules: u64,
    /// Segments of a drawing that does not memoise; strokes and placed blocks of one that does, counted as the symbols
    /// of the successors that they come from.
    pub segments: u64,
    /// Symbols derived, in all generations together, for a drawing that does not memoise. A symbol that nothing
    /// rewrites counts once; each branch that is open at the same time counts 32 more.
    pub work: u64,
    /// Bytes that a drawing may take while it is made, with what it is derived from; or a derivation, with what is
    /// remembered of it.
    pub memory: u64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { symbols: 256 << 20, modules: 32 << 20, segments: 2_000_000, work: 100_000_000, memory: 1 << 30 }
    }
}

impl Limits {
    /// The value of the limit called `name`.
    #[must_use]
    pub fn value(&self, name: LimitName) -> u64 {
        match name {
            LimitName::Symbols => self.symbols,
            LimitName::Modules => self.modules,
            LimitName::Segments => self.segments,
            LimitName::Work => self.work,
            LimitName::Memory => self.memory,
            LimitName::Iterations => u64::from(MAX_ITERATIONS),
            LimitName::Text => MAX_TEXT as u64,
            LimitName::Letters => MAX_LETTERS as u64,
            LimitName::Parameters => MAX_PARAMETERS as u64,
            LimitName::Context => MAX_CONTEXT as u64,
            LimitName::Actions => MAX_ACTIONS as u64,
        }
    }
}

/// The most derivation steps any system may ask for.
pub const MAX_ITERATIONS: u32 = 1_000;

/// The longest text that is read, in bytes: an axiom, rules, overrides, or a file.
pub const MAX_TEXT: usize = 1 << 20;

/// The most colours in a palette.
pub const MAX_PALETTE: usize = 256;

/// The bytes that the numbers of a count may take on the way.
pub const MAX_COUNTING: u64 = 16 << 20;

/// The most pixels along a side of a picture.
pub const MAX_PICTURE_SIDE: u32 = 1 << 15;

/// The most pixels of a picture: they take up to two gigabytes while it is made.
pub const MAX_PICTURE_PIXELS: u32 = 100_000_000;

/// The most different symbols in a system: letters are numbered with 16 bits.
pub const MAX_LETTERS: usize = 1 << 16;

/// The most parameters of a module.
pub const MAX_PARAMETERS: usize = 8;

/// The most modules in a context on either side, brackets counted.
pub(crate) const MAX_CONTEXT: usize = 64;

/// The most actions of a symbol: one piece of work does all that a symbol does.
pub const MAX_ACTIONS: usize = 256;
