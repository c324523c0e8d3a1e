//! Structured results for the page.

use lsystem::drawing::legend;
pub use lsystem::syntax::Problem;
pub(crate) use lsystem::syntax::problems;
use lsystem::{Definition, System};
use serde::Serialize;

/// The properties of a definition and its problems. Counts are exact decimal strings, null while unknown.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Whether the definition has no errors.
    pub ok: bool,
    /// All errors and warnings, also about limits.
    pub diagnostics: Vec<Problem>,
    /// As [`lsystem::drawing::kind`].
    pub kind: String,
    /// Whether the drawing depends on the seed.
    pub stochastic: bool,
    /// Whether the drawing leaves the plane.
    pub space: bool,
    /// Whether the drawing shares its blocks.
    pub memoised: Option<bool>,
    /// The number of symbols of the generation.
    pub symbols: Option<String>,
    /// The number of segments of the drawing.
    pub segments: Option<String>,
    /// The number of blocks of the drawing.
    pub blocks: Option<usize>,
    /// The largest number of iterations within the limits, if the drawing exceeds a limit.
    pub largest: Option<u32>,
    /// The symbols in use.
    pub legend: Vec<Legend>,
    /// The reason why nothing is drawn.
    pub empty: Option<String>,
    /// The picture's text alternative.
    pub description: String,
}

/// A symbol in use and its actions.
#[derive(Clone, Debug, Serialize)]
pub struct Legend {
    /// The symbol, with the names of its parameters.
    pub symbol: String,
    /// The turtle's actions, in words.
    pub actions: String,
    /// Whether a production replaces the symbol.
    pub rewritten: bool,
}

/// The value that a plain function throws.
#[derive(Serialize)]
pub(crate) struct ThrownProblems {
    pub(crate) diagnostics: Vec<Problem>,
}

/// Compiles `definition`; all problems in words.
pub(crate) fn compile(definition: &Definition) -> (Option<System>, Vec<Problem>) {
    let (system, diagnostics) = System::new(definition);
    (system, problems(&diagnostics, definition, ""))
}

pub(crate) fn legend_of(system: &System) -> Vec<Legend> {
    (legend(system).into_iter())
        .map(|entry| Legend { symbol: entry.module, actions: entry.actions, rewritten: entry.rewritten })
        .collect()
}
