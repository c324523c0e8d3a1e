//! `lsys check`: what a program printed, compared with a system.

use crate::cli::Changes;
use crate::{CommandFailure, input, print, say};
use lsystem::course::{Verdict, check as compare};
use std::path::Path;

/// Compares `output` with the system in `file`, and prints the result.
///
/// # Errors
/// [`CommandFailure::Said`] if the output is wrong or the system has errors; [`CommandFailure::Words`] if a file cannot
/// be read.
pub(crate) fn check(file: &Path, output: &Path, changes: &Changes) -> Result<(), CommandFailure> {
    let input = input::read(file, changes, &mut say)?;
    let name = input::name_of(output);
    let bytes = input::output_of(output).map_err(|error| CommandFailure::io(&name, &error))?;
    let text = String::from_utf8(bytes).map_err(|_| CommandFailure::Words(say!("{}: this is no text", name)))?;
    let check = compare(&input.definition, &text);
    match &check.verdict {
        Verdict::Unreadable(reason) => Err(CommandFailure::Words(format!("{name}: {reason}"))),
        Verdict::Failed(diagnostics) => {
            diagnostics.iter().for_each(|diagnostic| say(&input.message(diagnostic)));
            Err(CommandFailure::Said)
        }
        _ => {
            print(|out| writeln!(out, "{}", check.words()))?;
            if check.is_right() { Ok(()) } else { Err(CommandFailure::Said) }
        }
    }
}
