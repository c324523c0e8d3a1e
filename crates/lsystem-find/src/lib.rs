//! Which rules make this? The shortest deterministic rules that derive a given string from an axiom.
//!
//! The search reads the string from left to right while it derives from the axiom, leftmost first. Each symbol of the
//! string decides the next symbol of a rule, or that a rule ends: only there the search has a choice. Rules with fewer
//! symbols come first.
//!
//! The rules of a picture are found by trying: all systems of some families, the shortest first. The convex hull of a
//! system's drawing is found without drawing it; only where it is that of the picture, the strokes are laid on the ink.

mod angles;
mod curve;
mod curve_letters;
mod derivation;
mod drawn;
mod family;
mod finder;
mod growth;
mod hull;
mod lattice;
mod parts;
mod picture;
mod picture_search;
mod source;
mod strings;
mod strokes;
mod words;

pub use derivation::{Search, Searched};
pub use drawn::{Drawn, FOUND};
pub use finder::{Finder, Question, merged};
pub use picture::Picture;
pub use picture_search::{Known, PictureSearch};
pub use strings::StringFinder;

use lsystem_syntax::print_module;

/// Rules that derive the string.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// The rules: predecessor and successor.
    pub rules: Vec<(char, String)>,
    /// The number of derivation steps.
    pub n: u32,
}

impl Found {
    /// The number of symbols of all rules, with their predecessors.
    #[must_use]
    pub fn symbols(&self) -> usize {
        self.rules.iter().map(|(_, successor)| 1 + successor.chars().count()).sum()
    }

    /// The rules in our notation, one on each line.
    #[must_use]
    pub fn text(&self) -> String {
        let line = |(from, to): &(char, String)| format!("{} -> {}", printed(&from.to_string()), printed(to));
        self.rules.iter().map(line).collect::<Vec<_>>().join("\n")
    }
}

/// Symbols in our notation.
fn printed(symbols: &str) -> String {
    let mut text = String::new();
    symbols.chars().for_each(|symbol| print_module(symbol, &[], &mut text));
    text
}
