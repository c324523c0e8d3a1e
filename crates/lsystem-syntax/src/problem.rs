//! Diagnostics for pages: all words, and places in UTF-16 units.

use crate::{Definition, Diagnostic, Severity, utf16_span};
use serde::Serialize;

/// A diagnostic in words, with its place in UTF-16 units.
#[derive(Clone, Debug, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Problem {
    /// `axiom`, `rules`, `overrides`, `file` or `numbers`.
    #[cfg_attr(feature = "typescript", ts(type = "'axiom' | 'rules' | 'overrides' | 'file' | 'numbers'"))]
    pub field: &'static str,
    /// `error` or `warning`.
    #[cfg_attr(feature = "typescript", ts(type = "'error' | 'warning'"))]
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

/// Diagnostics in words; `file` is the text that [`Field::File`](crate::Field::File) spans point into.
#[must_use]
pub fn problems(diagnostics: &[Diagnostic], definition: &Definition, file: &str) -> Vec<Problem> {
    let problem = |diagnostic: &Diagnostic| {
        let span = utf16_span(definition.text(diagnostic.field).unwrap_or(file), diagnostic.span.clone());
        Problem {
            field: diagnostic.field.name(),
            severity: match diagnostic.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            message: diagnostic.message.clone(),
            hint: diagnostic.hint.clone(),
            fix: diagnostic.fix.clone(),
            start: span.start,
            end: span.end,
        }
    };
    diagnostics.iter().map(problem).collect()
}
