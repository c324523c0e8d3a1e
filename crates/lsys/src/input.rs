//! Reading a file into a system, and saying what is wrong with it.

use crate::cli::Changes;
use crate::cores::Say;
use crate::{Failure, settings};
use lsystem::drawing::Space;
use lsystem::files::FileContent;
use lsystem::syntax::{LimitName, MAX_TEXT, visible};
use lsystem::{Definition, Diagnostic, Drawer, Drawing, Limits, Progress, Solid, System, read_file, render_diagnostic};
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
    limits: Limits,
}

/// Symbols between two looks at the memory of a drawing; they take a few megabytes.
const WORK: u64 = 1 << 16;

/// Reads `file` (`-` for standard input), and says what to warn of.
///
/// # Errors
/// [`Failure::Said`] where the file makes no system.
pub(crate) fn read(file: &Path, changes: &Changes, say: Say<'_>) -> Result<Input, Failure> {
    let name = if file.as_os_str() == "-" { "standard input".into() } else { file.display().to_string() };
    let bytes = bytes_of(file).map_err(|error| Failure::io(&name, &error))?;
    let FileContent { mut definition, mut diagnostics, json } = read_file(&bytes);
    let mut system = None;
    if let Some(definition) = &mut definition {
        definition.iterations = changes.iterations.unwrap_or(definition.iterations);
        definition.seed = changes.seed.unwrap_or(definition.seed);
        if !changes.settings.is_empty() {
            *definition = settings::apply(definition, &changes.settings).map_err(|error| {
                say(&format!("{}\n", visible(&error)));
                Failure::Said
            })?;
        }
        let (made, more) = System::new(definition);
        system = made;
        diagnostics.extend(more);
    }
    for diagnostic in &diagnostics {
        say(&message(diagnostic, &json, definition.as_ref(), &name));
    }
    let (Some(definition), Some(system)) = (definition, system) else { return Err(Failure::Said) };
    let iterations = definition.iterations;
    let usual = Limits::default();
    let limits = Limits { memory: changes.memory.unwrap_or(usual.memory), ..usual };
    Ok(Input { file: name.into(), definition, system, iterations, limits })
}

impl Input {
    /// One of so many equal `shares` of the limits that bound memory.
    pub(crate) fn limits(&self, shares: u64) -> Limits {
        let Limits { symbols, segments, memory, .. } = self.limits;
        Limits { symbols: symbols / shares, segments: segments / shares, memory: memory / shares, ..self.limits }
    }

    /// The drawing in the plane, within its share of memory.
    ///
    /// # Errors
    /// Names the limit that it passes.
    pub(crate) fn draw(&self, shares: u64) -> Result<Drawing, Diagnostic> {
        self.finish(Drawer::new(&self.system, self.iterations, self.drawing_limits()), shares)
    }

    /// The same in space.
    ///
    /// # Errors
    /// As [`Input::draw`].
    pub(crate) fn draw_solid(&self, shares: u64) -> Result<Drawing<Solid>, Diagnostic> {
        self.finish(Drawer::solid(&self.system, self.iterations, self.drawing_limits()), shares)
    }

    /// The limits of a drawing. Memory ends a drawing; [`Limits::segments`] of the input is for files of text.
    fn drawing_limits(&self) -> Limits {
        Limits { segments: u64::from(u32::MAX), work: 1 << 30, ..self.limits }
    }

    /// All steps of a drawing. Its limits are whole however many `shares` there are, because limits decide how it is made.
    fn finish<S: Space>(&self, mut drawer: Drawer<S>, shares: u64) -> Result<Drawing<S>, Diagnostic> {
        let share = self.limits.memory / shares;
        while drawer.step(WORK) == Progress::More {
            if shares > 1 && drawer.bytes() > share {
                return Err(Diagnostic::limit(LimitName::Memory, share, None));
            }
        }
        drawer.finish()
    }

    /// The string.
    ///
    /// # Errors
    /// [`Failure::Limit`] where it would be too long.
    pub(crate) fn expand(&self, shares: u64) -> Result<String, Failure> {
        let string = lsystem::expand(&self.system, self.iterations, &self.limits(shares));
        string.map_err(|limit| self.limit(&limit))
    }

    /// The failure that passes `limit`.
    pub(crate) fn limit(&self, limit: &Diagnostic) -> Failure {
        Failure::Limit(self.message(limit))
    }

    /// A message about the system as a whole.
    pub(crate) fn message(&self, diagnostic: &Diagnostic) -> String {
        render_diagnostic(diagnostic, &self.file.display().to_string(), "")
    }
}

/// As much of a picture as is read, in bytes: all of most pictures, and of a larger one the beginning, where its system
/// stands.
const PICTURE: u64 = 64 << 20;
/// As much of any other file as is read, in bytes: the longest text, in UTF-16 and with its mark, and one more byte that
/// tells that a longer one is too long.
const TEXT: u64 = 2 * MAX_TEXT as u64 + 3;
/// The first bytes of a file, which tell what it is.
const HEAD: u64 = 1 << 10;

/// The bytes of a file, or the beginning of one that is too large: memory and time are bounded whatever stands in it.
fn bytes_of(file: &Path) -> io::Result<Vec<u8>> {
    if file.as_os_str() == "-" { beginning(io::stdin().lock()) } else { beginning(File::open(file)?) }
}

fn beginning(mut file: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.by_ref().take(HEAD).read_to_end(&mut bytes)?;
    let most = if is_picture(&bytes) { PICTURE } else { TEXT };
    file.take(most - HEAD).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether a file begins as a PNG or an SVG does, in UTF-8 or UTF-16.
fn is_picture(head: &[u8]) -> bool {
    let first = head.iter().position(|byte| !b" \t\r\n\0\xef\xbb\xbf\xff\xfe".contains(byte));
    first.is_some_and(|first| head[first..].starts_with(b"<")) || head.starts_with(b"\x89PNG")
}

fn message(diagnostic: &Diagnostic, text: &str, definition: Option<&Definition>, name: &str) -> String {
    match definition.and_then(|definition| definition.text(diagnostic.field)) {
        Some(source) => render_diagnostic(diagnostic, &format!("{name}, {}", diagnostic.field.name()), source),
        None => render_diagnostic(diagnostic, name, text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Never ends; counts what is taken from it.
    struct Endless<'a>(&'a [u8], &'a mut u64);

    impl Read for Endless<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let start = self.0.len().min(buffer.len());
            buffer[..start].copy_from_slice(&self.0[..start]);
            buffer[start..].fill(b' ');
            self.0 = &self.0[start..];
            *self.1 += buffer.len() as u64;
            Ok(buffer.len())
        }
    }

    #[test]
    fn no_more_is_read_than_a_file_can_need() {
        for (start, most) in [("", TEXT), ("{", TEXT), ("<svg", PICTURE), ("\u{feff}\n<svg", PICTURE)] {
            let mut taken = 0;
            let bytes = beginning(Endless(start.as_bytes(), &mut taken)).unwrap();
            assert_eq!((bytes.len() as u64, taken), (most, most), "{start:?}");
            assert!(bytes.starts_with(start.as_bytes()));
        }
        assert!(is_picture(b"\x89PNG\r\n") && is_picture(b"\xff\xfe<\0s\0") && is_picture(b"\xfe\xff\0<\0s"));
        assert_eq!(beginning(&b"{}"[..]).unwrap(), b"{}");
    }
}
