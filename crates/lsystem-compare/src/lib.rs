//! Whether two drawings are the same and how much they agree; exercises and their marks.

mod check;
mod compiled;
mod exercise;
mod fit;
mod graph;
mod hint;
mod ink;
mod mark;
mod same;
mod sample;
mod sketch;

pub use check::{Check, MAX_OUTPUT, Output, Verdict, check};
pub use exercise::{Asks, Exercise, First, Given};
pub use fit::Ends;
pub use ink::{Mask, SIDE};
pub use mark::{Grade, Marker, Marking};
pub use same::is_same_picture;
