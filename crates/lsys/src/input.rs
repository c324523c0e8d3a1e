//! Reading a file into a system, and saying what is wrong with it.

use crate::args::Changes;
use crate::{Failure, say};
use lsystem::{Definition, Diagnostic, Field, Limits, MAX_TEXT, System, render_diagnostic};
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
pub(crate) fn read(file: &Path, changes: Changes) -> Result<Input, Failure> {
    let name = if file.as_os_str() == "-" { "standard input".into() } else { file.display().to_string() };
    let text = text_of(file).map_err(|error| Failure::io(&name, &error))?;
    let text = String::from_utf8(text).map_err(|error| not_text(&name, &error))?;
    let (mut definition, mut diagnostics) = lsystem::read_json(&text);
    let mut system = None;
    if let Some(definition) = &mut definition {
        definition.iterations = changes.iterations.unwrap_or(definition.iterations);
        definition.seed = changes.seed.unwrap_or(definition.seed);
        let (made, more) = System::new(definition);
        system = made;
        diagnostics.extend(more);
    }
    for diagnostic in &diagnostics {
        tell(diagnostic, &text, definition.as_ref(), &name);
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
        say(&render_diagnostic(limit, &self.file.display().to_string(), ""));
        Failure::Said
    }
}

/// At most as much as can be read as a system, and a byte more, by which too long a text is known.
fn text_of(file: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let most = MAX_TEXT as u64 + 1;
    if file.as_os_str() == "-" {
        io::stdin().lock().take(most).read_to_end(&mut bytes)?;
    } else {
        File::open(file)?.take(most).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

fn not_text(name: &str, error: &std::string::FromUtf8Error) -> Failure {
    let at = error.utf8_error().valid_up_to();
    let line = error.as_bytes()[..at].iter().filter(|&&byte| byte == b'\n').count() + 1;
    Failure::Words(format!("{name}, line {line}: not UTF-8 text"))
}

fn tell(diagnostic: &Diagnostic, text: &str, definition: Option<&Definition>, name: &str) {
    let (source, field) = match (diagnostic.field, definition) {
        (Field::Axiom, Some(definition)) => (definition.axiom.as_str(), ", axiom"),
        (Field::Rules, Some(definition)) => (definition.rules.as_str(), ", rules"),
        (Field::Overrides, Some(definition)) => (definition.overrides.as_str(), ", overrides"),
        _ => (text, ""),
    };
    say(&render_diagnostic(diagnostic, &format!("{name}{field}"), source));
}
