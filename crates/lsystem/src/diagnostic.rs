//! What is wrong with what somebody typed, as values: kind, place, and words from one table.

use core::ops::Range;

/// One thing to tell the author of a system.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What it is about, with its arguments.
    pub kind: Kind,
    /// Which text it is in.
    pub field: Field,
    /// Where in that text, in bytes; empty at the place where something is missing, 0..0 when no place applies.
    pub span: Range<usize>,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The system works, perhaps not as meant.
    Warning,
    /// The system cannot be used.
    Error,
}

/// The text that a diagnostic's span points into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Field {
    /// [`Definition::axiom`](crate::Definition::axiom).
    Axiom,
    /// [`Definition::rules`](crate::Definition::rules).
    Rules,
    /// [`Definition::overrides`](crate::Definition::overrides).
    Overrides,
    /// A file that was read.
    File,
    /// The definition's numbers: no text, no span.
    Numbers,
}

/// What a diagnostic is about. The words are in the message table (`message.rs`).
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// Deriving further would pass a limit.
    Limit {
        /// Which limit.
        limit: LimitName,
        /// Its value.
        value: u64,
        /// The largest number of iterations within it, where known.
        largest: Option<u32>,
    },
}

/// The limits, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LimitName {
    /// Symbols of a string held in memory ([`Limits::symbols`](crate::Limits::symbols)).
    Symbols,
    /// Segments of a drawing that does not memoise ([`Limits::segments`](crate::Limits::segments)).
    Segments,
    /// Derivation work of a system that does not memoise ([`Limits::work`](crate::Limits::work)).
    Work,
    /// Iterations (1,000).
    Iterations,
}
