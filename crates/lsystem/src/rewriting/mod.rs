//! Derivation one generation after the other, for productions that look around themselves or compute.
//!
//! Context-free systems without parameters need none of this: `derivation.rs` derives them letter by letter. Here
//! a whole generation stands in memory, because a production's context is the generation around it.

mod context;
mod rules;
mod step;
mod table;

pub use rules::{ContextPattern, Letter, LetterId, Rule, Rules, Template};
pub use step::{Fault, Modules, Rewriter};

#[cfg(test)]
mod tests;
