//! `lsys import --account`: what became of every part of a text.

use crate::input::bytes_of;
use crate::{CommandFailure, print, say};
use lsystem::base::MAX_TEXT;
use lsystem::base::word;
use lsystem::base::words::said;
use lsystem::import::{Fate, import};
use lsystem::syntax::{line_of, visible};
use std::path::PathBuf;

/// Prints the parts of each file that a reader of other notations reads, notes or refuses, with what became of them.
///
/// # Errors
/// [`CommandFailure::Said`] if a file cannot be read or has no system in a known notation.
pub(crate) fn account(files: &[PathBuf]) -> Result<(), CommandFailure> {
    let mut failed = false;
    for file in files {
        let name = file.display().to_string();
        let text = bytes_of(file).map_err(|error| CommandFailure::io(&name, &error))?;
        let text = String::from_utf8_lossy(&text);
        let Some(imported) = import(&text) else {
            let why = if text.len() > MAX_TEXT {
                say!("longer than 1 MiB, which is not read")
            } else {
                say!("no L-system in a known notation")
            };
            say(&format!("{}\n", visible(&say!("error: {}", format!("{name}: {why}")))));
            failed = true;
            continue;
        };
        print(|out| {
            writeln!(out, "{}", visible(&format!("{name}: {}", said(imported.notation))))?;
            let (mut line, mut from) = (1, 0);
            for part in &imported.account {
                line += line_of(&text[from..part.span.start], part.span.start - from) - 1;
                from = part.span.start;
                let fate = match part.fate {
                    Fate::Passed => continue,
                    Fate::Read => word!("read"),
                    Fate::Noted => word!("noted"),
                    Fate::Refused => word!("refused"),
                };
                let system = part
                    .entry
                    .filter(|_| imported.entries.len() > 1)
                    .map_or(String::new(), |at| format!(" {}", at + 1));
                let fate = said(fate);
                let found = text[part.span.clone()].trim().replace('\n', " ");
                writeln!(out, "{}", visible(&format!("{line}: {fate}{system}: `{found}`: {}", part.words)))?;
            }
            Ok(())
        })?;
    }
    if failed { Err(CommandFailure::Said) } else { Ok(()) }
}
