//! Derivation of L-systems: from a parsed [`Grammar`](lsystem_syntax::Grammar) to the word of any generation, whole, in
//! pages, or only counted.
//!
//! [`Rules`] are the compiled grammar, in which letters are small integers. If every letter derives independently of
//! its neighbours ([`Rules::is_plain`]), a generation is visited depth first ([`DepthFirst`]), written from copied parts
//! ([`derive_string`]), counted without being derived ([`Counter`]) and read at any position ([`Word`]). Otherwise a
//! [`Rewriter`] makes one generation after another, and a [`History`] records the successors of every module. A random
//! choice depends only on the place of its module ([`Key`]), so that all these methods give the same result.
//!
//! ```
//! use lsystem_base::{Limits, Meter};
//! use lsystem_derive::{Counter, Rules, derive_string};
//! use std::sync::Arc;
//!
//! let (grammar, _) = lsystem_syntax::parse("F", "F -> F+F");
//! let rules = Arc::new(Rules::new(&grammar, vec![0..8], |_| false, false).unwrap());
//! let (mut text, mut meter) = (String::new(), Meter::new(1_000));
//! derive_string(&rules, 0, 2, &Limits::default(), &mut text, &mut meter).unwrap();
//! assert_eq!(text, "F+F+F+F");
//!
//! // No memory holds generation 200, but its symbols can be counted: 2^200 letters and the turns between them.
//! let count = Counter::symbols(&rules, 200).finish().unwrap();
//! assert_eq!(count.to_string().len(), 61);
//! ```

// In the order of the data.
mod compile;
mod rewrite;
mod rules;

mod access;
mod asking;
mod counts;
mod derivation;
mod key;
mod tally;
mod walk;

mod rewriting;

mod generation_reader;

#[cfg(test)]
mod testing;

pub use access::{Ancestor, DerivedPart, Word};
pub use asking::{Interpret, Interpretation, Interpreter, QueryAnswer};
pub use counts::{Counter, weigh_until};
pub use derivation::{derive_once, derive_string, derive_symbol, fault};
pub use generation_reader::GenerationReader;
pub use key::{Key, Quantity};
pub use rewriting::{Age, Fault, History, Image, Rewriter, between};
pub use rules::{Letter, LetterId, Rewrite, Rule, Rules, Template};
pub use tally::Tally;
pub use walk::{DepthFirst, ModuleAge, Next};

pub(crate) use rules::Alternative;
