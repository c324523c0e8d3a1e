//! Reading a file into a system, with messages about its problems. All files that the program reads are opened here.

use crate::cli::Changes;
use crate::cores::Say;
use crate::{CommandFailure, memory, settings};
use lsystem::base::words::said;
use lsystem::base::{LimitName, MAX_FILE, say};
use lsystem::course::MAX_OUTPUT;
use lsystem::drawing::FigureDrawer;
use lsystem::files::FileContent;
use lsystem::import::{Entry, Imported, OWN_JSON, Remark, import_file};
use lsystem::syntax::visible;
use lsystem::{Definition, Diagnostic, Figure, Limits, Progress, System, read_file, render_diagnostic};
use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A system from a file, with the command line's changes.
pub(crate) struct InputSystem {
    /// The file's path, or `standard input`.
    pub(crate) file: PathBuf,
    /// The definition in the file, with the command line's changes.
    pub(crate) definition: Definition,
    /// The compiled definition.
    pub(crate) system: System,
    /// The number of derivation steps.
    pub(crate) iterations: u32,
    /// The limits of all work on the file.
    limits: Limits,
    /// The bytes of memory that the work may take: less than the limit if there is less.
    free: u64,
}

/// The units of work between two checks of a drawing's memory; they add a few megabytes.
const WORK: u64 = 1 << 16;

/// Reads `file` (`-` for standard input) and prints all errors and warnings.
///
/// # Errors
/// [`CommandFailure::Said`] if the file has errors; [`CommandFailure::Words`] if it cannot be read.
pub(crate) fn read(file: &Path, changes: &Changes, say: Say<'_>) -> Result<InputSystem, CommandFailure> {
    let bytes = bytes_of(file).map_err(|error| CommandFailure::io(name_of(file), &error))?;
    system_in(&bytes, file, changes, say)
}

/// The system in the bytes of `file`. Prints all errors and warnings.
///
/// # Errors
/// As [`read`].
pub(crate) fn system_in(
    bytes: &[u8],
    file: &Path,
    changes: &Changes,
    say: Say<'_>,
) -> Result<InputSystem, CommandFailure> {
    let name = name_of(file);
    let FileContent { mut definition, mut diagnostics, json } = content(bytes, &name, changes.entry.as_deref(), say)?;
    let mut system = None;
    if let Some(definition) = &mut definition {
        definition.iterations = changes.iterations.unwrap_or(definition.iterations);
        definition.seed = changes.seed.unwrap_or(definition.seed);
        if !changes.settings.is_empty() {
            *definition = settings::apply(definition, &changes.settings).map_err(|error| {
                say(&format!("{}\n", visible(&error)));
                CommandFailure::Said
            })?;
        }
        system = System::read(definition, &mut diagnostics);
    }
    for diagnostic in &diagnostics {
        say(&message(diagnostic, &json, definition.as_ref(), &name));
    }
    let (Some(definition), Some(system)) = (definition, system) else { return Err(CommandFailure::Said) };
    let iterations = definition.iterations;
    let usual = Limits::default();
    let limits = Limits { memory: changes.memory.unwrap_or(usual.memory), ..usual };
    let free = memory::at_most(limits.memory);
    Ok(InputSystem { file: name.into(), definition, system, iterations, limits, free })
}

/// The system in a file of any notation. The remarks on a system in another notation are printed.
///
/// # Errors
/// [`CommandFailure::Said`] if the system is refused; [`CommandFailure::Words`] if `entry` names no system, or is needed
/// and missing.
fn content(bytes: &[u8], name: &str, entry: Option<&str>, say: Say<'_>) -> Result<FileContent, CommandFailure> {
    // Our own JSON is read as a file of ours, so that messages show their places in it.
    let foreign = import_file(bytes).filter(|imported| imported.notation != OWN_JSON);
    let Some(Imported { notation, entries, .. }) = foreign else {
        return match entry {
            Some(_) => Err(CommandFailure::Words(say!("{}: --entry is for files with several systems", name))),
            None => Ok(read_file(bytes)),
        };
    };
    let found = match entry {
        Some(wanted) => (entries.iter().find(|entry| entry.name == wanted))
            .or_else(|| entries.iter().find(|entry| entry.name.eq_ignore_ascii_case(wanted)))
            .or_else(|| entries.get(wanted.parse::<usize>().ok()?.checked_sub(1)?)),
        None => entries.first().filter(|_| entries.len() == 1),
    };
    let Some(found) = found else {
        let problem = match entry {
            Some(wanted) => say!("there is no system `{}`", wanted),
            None => say!("this {} file has {} systems; choose one with --entry NAME", said(notation), entries.len()),
        };
        return Err(CommandFailure::Words(format!("{name}: {problem}\n{}", names(&entries))));
    };
    for remark in &found.remarks {
        say(&remark_line(name, remark));
    }
    match &found.definition {
        Some(definition) => {
            Ok(FileContent { definition: Some(definition.clone()), diagnostics: Vec::new(), json: String::new() })
        }
        None => Err(CommandFailure::Said),
    }
}

/// The names of the systems in a file, with their numbers where they have no names.
fn names(entries: &[Entry]) -> String {
    const MAX: usize = 200;
    let named = entries.iter().enumerate().take(MAX).map(|(at, entry)| match entry.name.as_str() {
        "" => (at + 1).to_string(),
        name => name.to_owned(),
    });
    let more = if entries.len() > MAX { ", ..." } else { "" };
    format!("{}{more}", named.collect::<Vec<_>>().join(", "))
}

/// A remark as a line of text.
pub(crate) fn remark_line(name: &str, remark: &Remark) -> String {
    let Remark { line, text, message, refused, .. } = remark;
    let text = if text.is_empty() { String::new() } else { format!(": `{text}`") };
    let words = format!("{name}:{line}: {message}{text}");
    let words = if *refused { say!("error: {}", words) } else { say!("warning: {}", words) };
    format!("{}\n", visible(&words))
}

impl InputSystem {
    /// The limits, with those that bound memory divided by `shares`.
    pub(crate) fn limits(&self, shares: u64) -> Limits {
        let Limits { symbols, segments, .. } = self.limits;
        Limits { symbols: symbols / shares, segments: segments / shares, memory: self.free / shares, ..self.limits }
    }

    /// The drawing in the space of the system, within one of `shares` equal shares of memory. The drawer itself has the
    /// whole limits, because limits decide how a drawing is made and the result must not depend on `shares`.
    ///
    /// # Errors
    /// The limit that the drawing exceeds.
    pub(crate) fn draw(&self, shares: u64) -> Result<Figure, Diagnostic> {
        self.finish(Figure::drawer(&self.system, self.iterations, self.drawing_limits()), shares)
    }

    fn finish(&self, mut drawer: FigureDrawer, shares: u64) -> Result<Figure, Diagnostic> {
        let share = self.free / shares;
        while drawer.step(WORK) == Progress::More {
            if share < self.limits.memory && drawer.bytes() > share {
                return Err(Diagnostic::limit(LimitName::Memory, share, None));
            }
        }
        drawer.finish()
    }

    /// The limits of a drawing. Only memory limits the segments of a drawing; [`Limits::segments`] of the input is for
    /// text files.
    pub(crate) fn drawing_limits(&self) -> Limits {
        Limits { segments: u64::from(u32::MAX), work: 1 << 30, ..self.limits }
    }

    /// The derived string.
    ///
    /// # Errors
    /// [`CommandFailure::Limit`] if the string would be too long.
    pub(crate) fn expand(&self, shares: u64) -> Result<String, CommandFailure> {
        let string = lsystem::expand(&self.system, self.iterations, &self.limits(shares));
        string.map_err(|limit| self.limit(&limit))
    }

    /// The failure for a diagnostic about a limit.
    pub(crate) fn limit(&self, limit: &Diagnostic) -> CommandFailure {
        CommandFailure::Limit(self.message(limit))
    }

    /// A message about the system as a whole.
    pub(crate) fn message(&self, diagnostic: &Diagnostic) -> String {
        render_diagnostic(diagnostic, &self.file.display().to_string(), "")
    }
}

/// The most bytes that are read of a picture. A larger picture has its system in the beginning.
const PICTURE: u64 = 64 << 20;
/// The most bytes that are read of any other file: the longest text in UTF-16 with its mark, and one more byte to
/// detect a longer text.
const TEXT: u64 = 2 * MAX_FILE as u64 + 3;
/// The number of first bytes that decide the kind of a file.
const HEAD: u64 = 1 << 10;

/// The bytes of a file, or the beginning of a file that is too large, so that memory and time are bounded.
pub(crate) fn bytes_of(file: &Path) -> io::Result<Vec<u8>> {
    beginning(open(file)?, TEXT)
}

/// As [`bytes_of`], with the length of the file, for a file that this command may replace.
///
/// # Errors
/// Errors of the file system; an error if this is no file, since reading a pipe would wait.
pub(crate) fn to_follow(file: &Path) -> io::Result<(Vec<u8>, u64)> {
    if !file.metadata()?.is_file() {
        return Err(io::Error::other(say!("this is not a file")));
    }
    let file = File::open(file)?;
    let bytes = beginning(&file, TEXT)?;
    let length = file.metadata()?.len().max(bytes.len() as u64);
    Ok((bytes, length))
}

/// The text in a file.
///
/// # Errors
/// [`CommandFailure::Words`] if the file cannot be read, is too long or is no text.
pub(crate) fn text_of(file: &Path) -> Result<String, CommandFailure> {
    let name = name_of(file);
    let bytes = bytes_of(file).map_err(|error| CommandFailure::io(&name, &error))?;
    let words = |words: String| CommandFailure::Words(format!("{name}: {words}"));
    let text = String::from_utf8(bytes).map_err(|_| words(say!("this is no text")))?;
    let is_short = text.len() <= MAX_FILE;
    is_short.then_some(text).ok_or_else(|| words(say!("longer than {} KiB, which is not read", MAX_FILE >> 10)))
}

/// The bytes of a picture, as [`bytes_of`]; or those of a longer text, such as the output of a program or a table, and
/// at most one byte more than [`MAX_OUTPUT`].
pub(crate) fn output_of(file: &Path) -> io::Result<Vec<u8>> {
    beginning(open(file)?, MAX_OUTPUT as u64 + 1)
}

/// The files that this command reads, so that no output replaces one of them.
static INPUTS: Mutex<BTreeSet<Identity>> = Mutex::new(BTreeSet::new());

fn inputs() -> MutexGuard<'static, BTreeSet<Identity>> {
    INPUTS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Keeps a file from being replaced, also under another spelling or by another link.
pub(crate) fn keep(file: &Path) {
    // On other systems than Unix there is no such path, and a redirected file is not known.
    let path = if is_standard_input(file) { Path::new("/dev/stdin") } else { file };
    inputs().extend(identity(path).ok());
}

/// The same for all names of a file: the numbers of its device and of its inode.
#[cfg(unix)]
type Identity = (u64, u64);

#[cfg(unix)]
fn identity(file: &Path) -> io::Result<Identity> {
    use std::os::unix::fs::MetadataExt;
    let data = file.metadata()?;
    Ok((data.dev(), data.ino()))
}

/// The same for all spellings of a file's path, and for symbolic links to it.
#[cfg(not(unix))]
type Identity = PathBuf;

#[cfg(not(unix))]
fn identity(file: &Path) -> io::Result<Identity> {
    file.canonicalize()
}

/// Whether this command reads the file.
pub(crate) fn is_input(file: &Path) -> bool {
    identity(file).is_ok_and(|id| inputs().contains(&id))
}

/// The file's path, or `standard input`.
pub(crate) fn name_of(file: &Path) -> String {
    if is_standard_input(file) { say!("standard input") } else { file.display().to_string() }
}

fn open(file: &Path) -> io::Result<Box<dyn Read>> {
    keep(file);
    Ok(if is_standard_input(file) { Box::new(io::stdin().lock()) } else { Box::new(File::open(file)?) })
}

fn is_standard_input(file: &Path) -> bool {
    file.as_os_str() == "-"
}

/// The first bytes of a picture, or the first `text` bytes of anything else.
fn beginning(mut file: impl Read, text: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.by_ref().take(HEAD).read_to_end(&mut bytes)?;
    let most = if is_picture(&bytes) { PICTURE } else { text };
    file.take(most - HEAD).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Whether a file begins like a PNG, or like an SVG in UTF-8 or UTF-16.
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

    /// An endless stream that counts the bytes read from it.
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
    fn a_number_is_a_place_only_if_no_system_has_that_name() {
        let text = b"3 {\n angle 4\n axiom F\n}\nb {\n angle 4\n axiom G\n}\nc {\n angle 4\n axiom D\n}\n";
        for (entry, axiom) in [("3", Some("F")), ("2", Some("G")), ("B", Some("G")), ("1", Some("F")), ("4", None)] {
            let found = content(text, "a.l", Some(entry), &mut |_| {}).ok().and_then(|found| found.definition);
            assert_eq!(found.map(|found| found.axiom).as_deref(), axiom, "{entry}");
        }
    }

    #[test]
    fn files_of_ours_keep_the_places_of_their_problems() {
        let text = br#"{"initial": "F", "rules": ["F -> FF"], "turtle": {}, "moon": 1}"#;
        let FileContent { definition, diagnostics, json } = content(text, "a.json", None, &mut |_| {}).ok().unwrap();
        assert_eq!((definition.map(|found| found.axiom).as_deref(), diagnostics.len()), (Some("F"), 1));
        assert_eq!(json.as_bytes(), text);
        assert!(content(text, "a.json", Some("a"), &mut |_| {}).is_err());
    }

    #[test]
    fn no_more_is_read_than_a_file_can_need() {
        for (start, most) in [("", TEXT), ("{", TEXT), ("<svg", PICTURE), ("\u{feff}\n<svg", PICTURE)] {
            let mut taken = 0;
            let bytes = beginning(Endless(start.as_bytes(), &mut taken), TEXT).unwrap();
            assert_eq!((bytes.len() as u64, taken), (most, most), "{start:?}");
            assert!(bytes.starts_with(start.as_bytes()));
        }
        assert!(is_picture(b"\x89PNG\r\n") && is_picture(b"\xff\xfe<\0s\0") && is_picture(b"\xfe\xff\0<\0s"));
        assert_eq!(beginning(&b"{}"[..], TEXT).unwrap(), b"{}");
    }
}
