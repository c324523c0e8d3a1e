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
    /// What is wrong.
    pub message: String,
    /// What to do about it.
    pub hint: Option<String>,
    /// Where it starts in the field.
    pub start: usize,
    /// Where it ends.
    pub end: usize,
}

/// What a definition means, or what is wrong with it. Counts are exact decimal strings, null while unknown.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Whether the system can be used.
    pub ok: bool,
    /// Everything there is to say about its texts and limits.
    pub diagnostics: Vec<Problem>,
    /// What sort of system it is, in words.
    pub kind: String,
    /// Whether chance plays a part.
    pub stochastic: bool,
    /// Whether the drawing leaves the plane.
    pub solid: bool,
    /// Whether the drawing shares its blocks.
    pub memoised: Option<bool>,
    /// Symbols of the generation.
    pub symbols: Option<String>,
    /// Segments of the drawing.
    pub segments: Option<String>,
    /// Blocks of the drawing.
    pub blocks: Option<usize>,
    /// The largest number of iterations within the limits, where one was passed.
    pub largest: Option<u32>,
    /// The symbols in use.
    pub legend: Vec<Legend>,
    /// Why nothing draws.
    pub empty: Option<String>,
    /// The picture in words.
    pub description: String,
}

/// A symbol in use and what it does.
#[derive(Clone, Debug, Serialize)]
pub struct Legend {
    /// The symbol, with the names of its parameters.
    pub symbol: String,
    /// What it does, in words.
    pub actions: String,
    /// Whether a production replaces it.
    pub rewritten: bool,
}

/// What a plain function throws.
#[derive(Serialize)]
pub(crate) struct Failure {
    pub(crate) diagnostics: Vec<Problem>,
}

/// What `definition` means, and what there is to say about it.
pub(crate) fn understood(definition: &Definition) -> (Option<System>, Vec<Problem>) {
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
