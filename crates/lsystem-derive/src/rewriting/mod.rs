//! Derivation by generations, for productions with contexts, parameters, conditions or computed weights.
//!
//! `derivation.rs` derives context-free systems without parameters letter by letter. Here a whole generation stands in
//! memory, because contexts match any part of it.

mod choices;
mod choose;
mod context;
mod history;
mod image;
mod modules;
mod plan;
mod room;
mod step;
mod table;

pub use history::History;
pub use image::Image;
pub use modules::{Age, between};
pub use step::{Fault, Rewriter};

#[cfg(test)]
mod tests;
