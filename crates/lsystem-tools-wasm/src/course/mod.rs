//! Exercises, checks, growth and single steps.

pub(crate) mod check;
pub(crate) mod class;
pub(crate) mod exercise;
pub(crate) mod growth;
mod steps;

pub use check::check_output;
pub use class::{ClassMarking, variants_of, write_exercise};
pub use exercise::{OpenExercise, variant_of};
pub use growth::growth;
pub use steps::{one_by_one, step_rows, turtle_trace};
