//! Reading a file into a system, and saying what is wrong with it.

use crate::args::Changes;
use crate::{Failure, say, settings};
use lsystem::{Definition, Diagnostic, FileContent, Limits, System, read_file, render_diagnostic};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// A system from a file, with the command line's changes.
pub(crate) struct Input {
    /// Where it is from.
    pub(crate) file: PathBuf,
    /// What the file says.
    pub(crate) definition: Definition,
    /// Ready for use.
    pub(crate) system: System,
    /// Derivation steps.
    pub(crate) iterations: u32,
    /// What may be spent.
    pub(crate) limits: Limits,
}

/// Reads `file` (`-` for standard input). Warnings go to standard error.
///
/// # Errors
/// [`Failure::Said`] where the file makes no system; what is wrong stands on standard error then.
pub(crate) fn read(file: &Path, changes: &Changes) -> Result<Input, Failure> {
    let name = if file.as_os_str() == "-" { "standard input".into() } else { file.display().to_string() };
    let bytes = bytes_of(file).map_err(|error| Failure::io(&name, &error))?;
    let FileContent { mut definition, mut diagnostics, json } = read_file(&bytes);
    let mut system = None;
    if let Some(definition) = &mut definition {
        definition.iterations = changes.iterations.unwrap_or(definition.iterations);
        definition.seed = changes.seed.unwrap_or(definition.seed);
        if !changes.settings.is_empty() {
            *definition = settings::apply(definition, &changes.settings).map_err(|error| {
                say(&format!("{error}\n"));
                Failure::Said
            })?;
        }
        let (made, more) = System::new(definition);
        system = made;
        diagnostics.extend(more);
    }
    for diagnostic in &diagnostics {
        tell(diagnostic, &json, definition.as_ref(), &name);
    }
    let (Some(definition), Some(system)) = (definition, system) else { return Err(Failure::Said) };
    let iterations = definition.iterations;
    Ok(Input { file: name.into(), definition, system, iterations, limits: Limits::default() })
}

impl Input {
    /// The string.
    ///
    /// # Errors
    /// [`Failure::Said`] where it would be too long.
    pub(crate) fn expand(&self) -> Result<String, Failure> {
        lsystem::expand(&self.system, self.iterations, &self.limits).map_err(|limit| self.limit(&limit))
    }

    /// Says that `limit` is passed.
    pub(crate) fn limit(&self, limit: &Diagnostic) -> Failure {
        self.tell(limit);
        Failure::Said
    }

    /// Says something about the system as a whole.
    pub(crate) fn tell(&self, diagnostic: &Diagnostic) {
        say(&render_diagnostic(diagnostic, &self.file.display().to_string(), ""));
    }
}

/// As much of a file as is looked at, in bytes: more than any system has, and all of most pictures.
const MOST: u64 = 64 << 20;

/// The bytes of a file. Of a larger picture the beginning is enough, where we put its system; a larger text is no
/// system in any case.
fn bytes_of(file: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    if file.as_os_str() == "-" {
        io::stdin().lock().take(MOST).read_to_end(&mut bytes)?;
    } else {
        File::open(file)?.take(MOST).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

fn tell(diagnostic: &Diagnostic, text: &str, definition: Option<&Definition>, name: &str) {
    let shown = match definition.and_then(|definition| definition.text(diagnostic.field)) {
        Some(source) => render_diagnostic(diagnostic, &format!("{name}, {}", diagnostic.field.name()), source),
        None => render_diagnostic(diagnostic, name, text),
    };
    say(&shown);
}
