//! Derivation one generation after the other, for productions that look around themselves or compute.
//!
//! Context-free systems without parameters need none of this: `derivation.rs` derives them letter by letter. Here
//! a whole generation stands in memory, because a production's context is the generation around it.

mod compile;
mod context;
mod image;
mod rules;
mod step;
mod table;

pub use image::Image;
pub use rules::{ContextPattern, Letter, LetterId, Rule, Rules, Template};
pub use step::{Fault, Modules, Rewriter};

#[cfg(test)]
mod tests;
