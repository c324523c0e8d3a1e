//! `lsys export`: a system in the notation of another program.

use crate::cli::Changes;
use crate::{CommandFailure, input, print, say};
use lsystem::base::words::said;
use lsystem::import::write::{NOTATIONS, Notation, export as written};
use lsystem::syntax::visible;
use std::path::Path;

/// Prints the system in `file` in another notation. What is left out is a warning.
///
/// # Errors
/// [`CommandFailure::Words`] with the reason if the notation cannot express the system.
pub(crate) fn export(file: &Path, notation: &Notation, changes: &Changes) -> Result<(), CommandFailure> {
    let input = input::read(file, changes, &mut say)?;
    let name = input.file.display();
    let written = written(&input.definition, notation);
    let written = written.map_err(|refusal| CommandFailure::Words(format!("{name}: {refusal}")))?;
    for sentence in &written.left_out {
        say(&format!("{}\n", visible(&say!("warning: {}", format!("{name}: {sentence}")))));
    }
    print(|out| out.write_all(written.text.as_bytes()))
}

/// Prints the names of the notations.
pub(crate) fn list() -> Result<(), CommandFailure> {
    let width = NOTATIONS.iter().map(|notation| notation.name.len()).max().unwrap_or_default();
    let line = |notation: &Notation| format!("{:width$}  {}\n", notation.name, said(notation.help));
    print(|out| out.write_all(NOTATIONS.iter().map(line).collect::<String>().as_bytes()))
}
