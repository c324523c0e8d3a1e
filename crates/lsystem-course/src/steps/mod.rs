//! Derivations and turtles step by step, for people who learn how they work: what each symbol becomes, rewriting one
//! symbol at a time, and the turtle's state at each symbol.

mod one_by_one;
mod rows;
mod trace;

pub use one_by_one::{Order, Single, one_by_one};
pub use rows::{Rows, SymbolFamily, rows};
pub use trace::{State, Trace, trace};

/// Why something cannot be shown, as a sentence.
pub type Why = &'static str;
