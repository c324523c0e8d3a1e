//! Derivation one generation after the other, for productions that look around themselves or compute.
//!
//! Context-free systems without parameters need none of this: `derivation.rs` derives them letter by letter. Here
//! a whole generation stands in memory, because a production's context is the generation around it.

mod choices;
mod choose;
mod context;
mod history;
mod image;
mod modules;
mod room;
mod step;
mod table;

pub use history::History;
pub use image::Image;
pub use modules::Age;
pub use step::{Fault, Rewriter};

#[cfg(test)]
mod tests;
