//! Definitions compiled, or their errors.

use lsystem_drawing::System;
use lsystem_syntax::{Definition, Diagnostic};

/// The system, without the wireframes of its shapes: two answers with different shapes may draw the same plant.
///
/// # Errors
/// The errors of the definition, without its warnings.
pub(crate) fn compiled(definition: &Definition) -> Result<System, Vec<Diagnostic>> {
    let (system, diagnostics) = System::new(definition);
    let system = system.map(System::without_wires);
    system.ok_or_else(|| diagnostics.into_iter().filter(Diagnostic::is_error).collect())
}
