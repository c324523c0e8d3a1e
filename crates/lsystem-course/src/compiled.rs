//! Definitions compiled, or their errors.

use lsystem_drawing::System;
use lsystem_syntax::{Definition, Diagnostic, Diagnostics};

/// The system, without the wireframes of its shapes: two answers with different shapes may draw the same plant.
///
/// # Errors
/// The errors of the definition, without its warnings.
pub(crate) fn compiled(definition: &Definition) -> Result<System, Vec<Diagnostic>> {
    let errors = |problems: Diagnostics| problems.0.into_iter().filter(Diagnostic::is_error).collect();
    System::new(definition).map(System::without_wires).map_err(errors)
}
