//! A system ready for derivation and drawing.

use crate::{Grammar, Program, Style, Turtle};

/// A checked and compiled [`Definition`](crate::Definition).
#[derive(Clone, Debug, PartialEq)]
pub struct System {
    /// What its texts say.
    pub grammar: Grammar,
    /// The grammar made ready for derivation.
    pub program: Program,
    /// What its symbols do.
    pub turtle: Turtle,
    /// Colours and widths.
    pub style: Style,
    /// Selects among the outcomes of stochastic productions.
    pub seed: u32,
}
