//! Whether two drawings are the same, how much they agree, and marks for exercises.

mod check;

pub use check::{Check, Output, SymbolDifference, Verdict, check};
