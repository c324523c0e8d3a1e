//! `lsys link`: a system as a link of the page.

use crate::cli::Changes;
use crate::{CommandFailure, input, print, say};
use lsystem::files::write_link;
use std::path::Path;

/// Prints the link of the system in `file`: the address `page`, and the system behind its `#`.
///
/// # Errors
/// [`CommandFailure`] if the file cannot be read or its system has errors.
pub(crate) fn link(file: &Path, page: Option<&str>, changes: &Changes) -> Result<(), CommandFailure> {
    let input = input::read(file, changes, &mut say)?;
    let page = page.map_or("", |page| page.split('#').next().unwrap_or_default());
    print(|out| writeln!(out, "{page}{}", write_link(&input.definition)))
}
