//! The two plain functions: a definition in, a string or segments out.

use crate::budget::{ARRAY_SEGMENTS, LIMITS};
use crate::report::Problem;
use lsystem::syntax::problems;
use lsystem::{Definition, Diagnostic, SegmentArrays, System};
use serde::Serialize;
use ts_rs::TS;

/// The problems that keep a plain function from its result.
#[derive(Debug, Serialize, TS)]
pub struct ThrownProblems {
    /// The errors of the definition, with its warnings, or the exceeded limit.
    pub diagnostics: Vec<Problem>,
}

/// The string of generation `n` of a definition.
///
/// # Errors
/// If the definition has errors or the string is too long.
pub fn expand(definition: &Definition, n: u32) -> Result<String, ThrownProblems> {
    lsystem::expand(&compile(definition)?, n, &LIMITS).map_err(|limit| failure(definition, &[limit]))
}

/// The segments of generation `n` of a definition.
///
/// # Errors
/// If the definition has errors or the drawing is too large.
pub fn segments(definition: &Definition, n: u32) -> Result<SegmentArrays, ThrownProblems> {
    let wrong = |limit| failure(definition, &[limit]);
    let drawing = lsystem::draw(&compile(definition)?, n, &LIMITS).map_err(wrong)?;
    let mut arrays = SegmentArrays::default();
    drawing.write_segments(ARRAY_SEGMENTS, &mut arrays).map_err(wrong)?;
    Ok(arrays)
}

fn compile(definition: &Definition) -> Result<System, ThrownProblems> {
    System::new(definition).map_err(|problems| failure(definition, &problems.0))
}

fn failure(definition: &Definition, diagnostics: &[Diagnostic]) -> ThrownProblems {
    ThrownProblems { diagnostics: problems(diagnostics, definition, "") }
}
