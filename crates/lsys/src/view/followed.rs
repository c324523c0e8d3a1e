//! The file that the page shows: read again after each change, and written when the reader saves.

use super::rewrite::rewrite;
use crate::CommandFailure;
use crate::cli::Changes;
use crate::input::{self, InputSystem};
use crate::pending::{self, Pending};
use lsystem::base::say;
use lsystem::files::{read_link, write_link};
use lsystem::import::{OWN_JSON, import_file};
use serde::Serialize;
use std::hash::{DefaultHasher, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The version of a file that is not there.
const MISSING: &str = "missing";

/// What the page is told about the file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct FileState {
    /// Equal for equal bytes.
    pub(super) version: String,
    /// The file's system as a link; `None` if it has errors or is not there.
    pub(super) link: Option<String>,
    /// Errors with their places, as the program prints them; empty if there is none.
    pub(super) problems: String,
    /// Why the page cannot save into the file; empty if it can.
    pub(super) refusal: String,
}

/// Why a system was not saved.
pub(super) enum NotSaved {
    /// The file is not what the page has seen last.
    Changed(FileState),
    /// The sender's mistake, in words.
    Wrong(String),
    /// The file cannot be written, in words.
    Refused(String),
}

/// The followed file.
pub(super) struct Followed {
    path: PathBuf,
    /// The name of a system in a file with several.
    changes: Changes,
    state: Mutex<FileState>,
    changed: Condvar,
}

impl Followed {
    /// Begins to follow the file at `path`, which has no symbolic links. Errors of its system are printed.
    ///
    /// # Errors
    /// [`CommandFailure`] if the file cannot be read, or its system has errors.
    pub(super) fn new(path: PathBuf, changes: Changes) -> Result<Self, CommandFailure> {
        let bytes = input::bytes_to_follow(&path).map_err(|error| CommandFailure::io(path.display(), &error))?;
        let system = input::system_in(&bytes, &path, &changes, &mut crate::say)?;
        let state = Mutex::new(FileState::of(&bytes, Ok(&system)));
        Ok(Self { path, changes, state, changed: Condvar::new() })
    }

    /// The file's name without its folders.
    pub(super) fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Reads the file again, and wakes those who wait for a change.
    pub(super) fn refresh(&self) -> FileState {
        let mut state = self.lock();
        self.read_into(&mut state);
        state.clone()
    }

    /// The file's state when it is not `known` any more, or after `patience`.
    pub(super) fn after(&self, known: &str, patience: Duration) -> FileState {
        let end = Instant::now() + patience;
        let mut state = self.lock();
        // Folders on a network report no changes.
        self.read_into(&mut state);
        while state.version == known {
            let left = end.saturating_duration_since(Instant::now());
            if left.is_zero() {
                break;
            }
            state = self.changed.wait_timeout(state, left).unwrap_or_else(PoisonError::into_inner).0;
        }
        state.clone()
    }

    /// Writes the system of a link into the file, if the file is still the `known` one.
    pub(super) fn save(&self, link: &str, known: &str) -> Result<FileState, NotSaved> {
        let link = read_link(link).ok_or_else(|| NotSaved::Wrong(say!("this is no link of the page")))?;
        if let Some(problem) = link.problems.first() {
            return Err(NotSaved::Wrong(problem.message.clone()));
        }
        // An older text may be read here; then its version is not the known one, and nothing is written.
        let former = input::bytes_to_follow(&self.path).ok().and_then(|bytes| String::from_utf8(bytes).ok());
        let text = rewrite(former.as_deref().unwrap_or_default(), &link.definition);
        let mut state = self.lock();
        let done = self.write(&text, known, &mut state);
        // No folder for temporary files stays beside the file while the page is open.
        pending::remove_all();
        done.map(|()| state.clone())
    }

    fn write(&self, text: &str, known: &str, state: &mut FileState) -> Result<(), NotSaved> {
        let failed = |error: io::Error| NotSaved::Refused(format!("{}: {error}", self.name()));
        let written = Pending::write(&self.path, |out| out.write_all(text.as_bytes()));
        // Looked at as late as possible: only a change within the next instant would be lost.
        self.read_into(state);
        if state.version != known {
            return Err(NotSaved::Changed(state.clone()));
        }
        if !state.refusal.is_empty() {
            return Err(NotSaved::Refused(state.refusal.clone()));
        }
        written.and_then(Pending::commit).map_err(failed)?;
        self.read_into(state);
        Ok(())
    }

    fn lock(&self) -> MutexGuard<'_, FileState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn read_into(&self, state: &mut FileState) {
        let next = self.read(state);
        if next != *state {
            *state = next;
            self.changed.notify_all();
        }
    }

    fn read(&self, former: &FileState) -> FileState {
        let bytes = match input::bytes_to_follow(&self.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let problems = say!("{} is not there any more.", self.name());
                return FileState { version: MISSING.to_owned(), link: None, problems, ..former.clone() };
            }
            Err(error) => {
                let problems = format!("{}: {error}", self.name());
                return FileState { version: error.kind().to_string(), link: None, problems, ..former.clone() };
            }
        };
        if version_of(&bytes) == former.version {
            return former.clone();
        }
        let mut problems = String::new();
        let name = self.name();
        let system = input::system_in(&bytes, Path::new(&name), &self.changes, &mut |words| problems += words);
        match system {
            Ok(system) => FileState::of(&bytes, Ok(&system)),
            Err(CommandFailure::Words(words) | CommandFailure::Limit(words)) => {
                FileState::of(&bytes, Err(problems + &words))
            }
            Err(_) => FileState::of(&bytes, Err(problems)),
        }
    }
}

impl FileState {
    fn of(bytes: &[u8], system: Result<&InputSystem, String>) -> Self {
        let foreign = import_file(bytes).is_some_and(|found| found.notation != OWN_JSON);
        let is_picture =
            bytes.starts_with(b"\x89PNG") || bytes.starts_with(b"%PDF") || bytes.trim_ascii_start().starts_with(b"<");
        let refusal = match (foreign, is_picture) {
            (_, true) => say!("A picture is not written again: save a JSON file."),
            (true, _) => say!("A file of another program is not written again: save a JSON file."),
            _ => String::new(),
        };
        let (link, problems) = match system {
            Ok(system) => (Some(write_link(&system.definition)), String::new()),
            Err(problems) => (None, problems),
        };
        Self { version: version_of(bytes), link, problems, refusal }
    }
}

fn version_of(bytes: &[u8]) -> String {
    let mut hasher = DefaultHasher::new();
    hasher.write(bytes);
    format!("{:016x}-{}", hasher.finish(), bytes.len())
}
