//! Structured results for the page.

use lsystem::drawing::legend;
use lsystem::syntax::Severity;
use lsystem::{Definition, Diagnostic, System};
use serde::Serialize;

/// A diagnostic in words, with its place in UTF-16 units.
#[derive(Clone, Debug, Serialize)]
pub struct Problem {
    /// `axiom`, `rules`, `overrides`, `file` or `numbers`.
    pub field: &'static str,
    /// `error` or `warning`.
    pub severity: &'static str,
    /// The problem, in a sentence.
    pub message: String,
    /// A possible remedy.
    pub hint: Option<String>,
    /// The text that is probably meant in place of the problem's; empty where that is to be removed.
    pub fix: Option<String>,
    /// The start of the place in the field.
    pub start: usize,
    /// The end of the place in the field.
    pub end: usize,
}

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

/// Diagnostics in words; `file` is the text that [`lsystem::syntax::Field::File`] spans point into.
pub(crate) fn problems(diagnostics: &[Diagnostic], definition: &Definition, file: &str) -> Vec<Problem> {
    let problem = |diagnostic: &Diagnostic| {
        let span =
            lsystem::syntax::utf16_span(definition.text(diagnostic.field).unwrap_or(file), diagnostic.span.clone());
        Problem {
            field: diagnostic.field.name(),
            severity: match diagnostic.severity() {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            message: diagnostic.message(),
            hint: diagnostic.hint(),
            fix: diagnostic.fix(),
            start: span.start,
            end: span.end,
        }
    };
    diagnostics.iter().map(problem).collect()
}

pub(crate) fn legend_of(system: &System) -> Vec<Legend> {
    (legend(system).into_iter())
        .map(|entry| Legend { symbol: entry.module, actions: entry.actions, rewritten: entry.rewritten })
        .collect()
}
