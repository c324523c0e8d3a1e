//! The inverse problem: the shortest deterministic rules that derive a given string or draw a given picture.
//!
//! A [`StringFinder`] reads the string from left to right while it derives from the axiom, leftmost first. Each symbol
//! of the string decides the next symbol of a rule, or that a rule ends: only there the search has a choice. Rules with
//! fewer symbols come first.
//!
//! A [`Finder`] enumerates families of systems for a [`Picture`], the shortest successors first. The convex hull of a
//! system's drawing is computed without drawing it; only if it fits that of the picture, the strokes are compared with
//! the ink. In addition, successors of plants and of curves are read off the picture itself. Systems with names, such as
//! those of a gallery, are given by the caller and come first ([`Finder::try_first`]). A system is called the same only if
//! the skeletons of both drawings agree ([`Drawn::is_same`]); [`Picture::compared`] shows where others differ. Several
//! finders can search in parallel ([`merged`]). All searches run in steps and depend on counted work only.
//!
//! ```
//! use lsystem_find::{Question, Searched, StringFinder};
//!
//! let question = Question { axiom: Some("F".into()), n: Some(2), ..Question::default() };
//! let mut finder = StringFinder::new("F+F-F+F+F-F-F+F-F", &question).unwrap();
//! while finder.found().is_empty() && finder.step(10_000) == Searched::More {}
//! assert_eq!(finder.found()[0].found.text(), "F -> F+F-F");
//! ```

mod align;
mod angles;
mod brush;
mod curve;
mod curve_letters;
mod derivation;
mod drawn;
mod enlarged;
mod family;
mod finder;
mod growth;
mod hull;
mod lattice;
mod named;
mod overlay;
mod parts;
mod photograph;
mod picture;
mod picture_search;
mod projection;
mod question;
mod share;
mod sheet;
mod source;
mod squares;
mod strings;
mod strokes;
mod successors;

pub use derivation::{Search, Searched};
pub use drawn::{Drawn, Named};
pub use finder::{Finder, merged};
pub use overlay::{FOUND, SIDE};
pub use photograph::Photograph;
pub use picture::Picture;
pub use picture_search::{Known, PictureSearch};
pub use question::Question;
pub use share::Share;
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
    // Alone, these would stand for nothing.
    if matches!(symbols, "ε" | "*") {
        return format!("`{symbols}`");
    }
    let mut text = String::new();
    symbols.chars().for_each(|symbol| print_module(symbol, &[], &mut text));
    text
}
