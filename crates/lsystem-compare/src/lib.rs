//! Whether two drawings are the same, how much they agree, and marks for exercises.

mod check;
mod fit;
mod same;

pub use check::{Check, MAX_OUTPUT, Output, SymbolDifference, Verdict, check};
pub use fit::Segment;
pub use same::is_same_picture;
