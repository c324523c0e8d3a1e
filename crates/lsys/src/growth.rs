//! `lsys info --growth`: how the generations of a system grow.

use crate::cli::{Changes, GrowthFormat};
use crate::output::escape_json;
use crate::{CommandFailure, input, print, say};
use lsystem::course::growth::growth;
use std::path::PathBuf;

/// Prints the growth of each file's system.
///
/// # Errors
/// [`CommandFailure::Words`] if a system's growth is not known; others as [`input::read`].
pub(crate) fn print_growth(files: &[PathBuf], format: GrowthFormat, changes: &Changes) -> Result<(), CommandFailure> {
    for (at, file) in files.iter().enumerate() {
        let input = input::read(file, changes, &mut say)?;
        let name = input.file.display().to_string();
        let growth =
            growth(&input.system, input.iterations).map_err(|why| CommandFailure::Words(format!("{name}: {why}")))?;
        let text = match format {
            GrowthFormat::Text => growth.words(),
            GrowthFormat::Csv => growth.csv(),
            GrowthFormat::Latex => growth.latex(),
            GrowthFormat::Json => {
                let json = serde_json::to_string_pretty(&growth).unwrap_or_default();
                escape_json(&json) + "\n"
            }
        };
        let head = if files.len() > 1 { format!("{}{name}\n", if at > 0 { "\n" } else { "" }) } else { String::new() };
        print(|out| write!(out, "{head}{text}"))?;
    }
    Ok(())
}
