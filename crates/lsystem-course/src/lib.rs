//! Teaching with L-systems: exercises and their marks, the output of other programs checked, how the generations
//! [grow](growth), and derivations and turtles [step by step](steps).

mod check;
mod compiled;
mod exercise;
mod fit;
mod graph;
pub mod growth;
mod hint;
mod mark;
mod same;
mod sample;
mod sketch;
pub mod steps;

pub use check::{Check, MAX_OUTPUT, Output, Verdict, check};
pub use exercise::{Asks, Exercise, First, Given};
pub use fit::Ends;
pub use mark::{Grade, Marker, Marking};
pub use same::is_same_picture;
