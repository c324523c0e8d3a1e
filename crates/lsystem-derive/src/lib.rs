//! L-systems derived.
//!
//! What comes in is a parsed [`Grammar`](lsystem_syntax::Grammar); what goes out are the words of its generations: whole,
//! in pages, or only counted.
//!
//! The way between: [`Rules`] are the grammar made ready, letters being small integers. Where every letter derives by
//! itself ([`Rules::is_plain`]), a generation is gone through depth first ([`Walk`]), copied from what is known
//! ([`expand()`]), added up without being derived ([`Counter`]) and read at any place ([`Word`]). Otherwise a [`Rewriter`]
//! makes one generation after the other, and a [`History`] remembers what became of every module. Random choices depend on
//! places alone ([`Key`]), so that all ways give the same.

// The order of the data.
mod compile;
mod rewrite;
mod rules;

mod access;
mod counts;
mod derivation;
mod key;
mod tally;
mod walk;

mod rewriting;

#[cfg(test)]
mod testing;

pub use access::{Ancestor, Part, Word};
pub use counts::{Counter, weigh_until};
pub use derivation::{expand, expand_once, expand_symbol, fault};
pub use key::{Key, Purpose};
pub use rewrite::Rewrite;
pub use rewriting::{Age, Fault, History, Image, Rewriter};
pub use rules::{Letter, LetterId, Rule, Rules, Template};
pub use tally::Tally;
pub use walk::{Fate, Next, Walk};

pub(crate) use rewrite::Choice;
