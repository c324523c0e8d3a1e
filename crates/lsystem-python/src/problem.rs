//! Errors and warnings for Python.

use lsystem::import::Remark;
use lsystem::syntax::{Halt, Severity, visible};
use lsystem::{Diagnostic, render_diagnostic};
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;
use std::ops::Range;

/// One problem in a system or a file.
#[pyclass(frozen, get_all, name = "Problem", module = "lsystem_playground")]
#[derive(Clone, Debug)]
pub(crate) struct Problem {
    /// `error` or `warning`.
    severity: &'static str,
    /// The text with the problem: `axiom`, `rules`, `overrides`, `file`, or `numbers` for no text.
    field: &'static str,
    /// The problem in words.
    message: String,
    /// What to try.
    hint: Option<String>,
    /// The place in the text, in characters.
    start: usize,
    /// The end of the place.
    end: usize,
    /// The message with the line of the text, for people.
    report: String,
}

#[pymethods]
impl Problem {
    fn __str__(&self) -> &str {
        &self.report
    }

    fn __repr__(&self) -> String {
        format!("<{} in {}: {}>", self.severity, self.field, self.message)
    }
}

impl Problem {
    /// A diagnostic about a place in `text`, which `source` names.
    pub(crate) fn of(diagnostic: &Diagnostic, source: &str, text: &str) -> Self {
        let [start, end] = characters(text, &diagnostic.span);
        Self {
            severity: if diagnostic.severity == Severity::Error { "error" } else { "warning" },
            field: diagnostic.field.name(),
            message: diagnostic.message.clone(),
            hint: diagnostic.hint.clone(),
            start,
            end,
            report: render_diagnostic(diagnostic, source, text).trim_end().to_owned(),
        }
    }

    /// A remark on a text in another notation, which `source` names.
    pub(crate) fn of_remark(remark: &Remark, source: &str, text: &str) -> Self {
        let Remark { line, text: excerpt, message, refused, span } = remark;
        let severity = if *refused { "error" } else { "warning" };
        let excerpt = if excerpt.is_empty() { String::new() } else { format!(": `{excerpt}`") };
        let report = visible(&format!("{severity}: {source}:{line}: {message}{excerpt}"));
        let [start, end] = characters(text, span);
        Self { severity, field: "file", message: message.clone(), hint: None, start, end, report }
    }

    pub(crate) fn is_error(&self) -> bool {
        self.severity == "error"
    }
}

/// A place in bytes as a place in characters, which Python counts.
fn characters(text: &str, span: &Range<usize>) -> [usize; 2] {
    [span.start, span.end].map(|end| text.char_indices().take_while(|(at, _)| *at < end).count())
}

/// The exception `LSystemError` for a message and the problems behind it.
pub(crate) fn error(py: Python<'_>, message: &str, problems: Vec<Problem>) -> PyErr {
    let class = py.import("lsystem_playground._error").and_then(|module| module.getattr("LSystemError"));
    match class.and_then(|class| class.call1((message, problems))) {
        Ok(error) => PyErr::from_value(error),
        Err(error) => error,
    }
}

/// The exception for these problems, whose message has all errors.
pub(crate) fn refused(py: Python<'_>, problems: Vec<Problem>) -> PyErr {
    let errors: Vec<_> = problems.iter().filter(|problem| problem.is_error()).map(|p| p.report.as_str()).collect();
    error(py, &errors.join("\n"), problems)
}

/// The exception for work that ended early.
pub(crate) fn halted(py: Python<'_>, halt: Halt) -> PyErr {
    match halt {
        Halt::Limit(limit) => refused(py, vec![Problem::of(&limit, "the system", "")]),
        Halt::Stopped => PyKeyboardInterrupt::new_err(()),
    }
}
