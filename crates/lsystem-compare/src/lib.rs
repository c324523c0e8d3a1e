//! Whether two drawings are the same, how much they agree, and marks for exercises.

mod check;

pub use check::{Check, MAX_OUTPUT, Output, SymbolDifference, Verdict, check};
