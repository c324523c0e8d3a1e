//! Definitions compiled, or their errors.

use lsystem_drawing::System;
use lsystem_syntax::{Definition, Diagnostic};

/// # Errors
/// The errors of the definition, without its warnings.
pub(crate) fn compiled(definition: &Definition) -> Result<System, Vec<Diagnostic>> {
    let (system, diagnostics) = System::new(definition);
    system.ok_or_else(|| diagnostics.into_iter().filter(Diagnostic::is_error).collect())
}
