//! The file that the page shows: read again after each change, and written when the reader saves.
//!
//! A save replaces nothing that the page has not seen: programs that save at once take turns by a lock, and what another
//! program puts in place of the file in the meantime comes back ([`Pending::replace`]).

use crate::CommandFailure;
use crate::cli::Changes;
use crate::input::{self, InputSystem};
use crate::pending::{self, Pending, Turn};
use lsystem::Definition;
use lsystem::base::say;
use lsystem::files::{edit_file, read_link, write_link};
use lsystem::import::{OWN_JSON, import_file};
use lsystem::write_json;
use serde::Serialize;
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use tokio::sync::watch;

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
    /// The name of the copy that a save has left beside the file; empty if there is none.
    pub(super) kept: String,
}

/// Why a system was not saved.
pub(super) enum NotSaved {
    /// The file is not what the page has seen last.
    Changed(FileState),
    /// Only a new text in place of the whole file would hold the system.
    Whole(String),
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
    state: watch::Sender<FileState>,
    /// Held by whoever reads the file into the state.
    reading: Mutex<()>,
    /// Held by whoever saves, until the temporary files are gone: those of another save would go with them.
    saving: Mutex<()>,
}

impl Followed {
    /// Begins to follow the file at `path`, which has no symbolic links. Errors of its system are printed.
    ///
    /// # Errors
    /// [`CommandFailure`] if the file cannot be read, or its system has errors.
    pub(super) fn new(path: PathBuf, changes: Changes) -> Result<Self, CommandFailure> {
        let file = input::to_follow(&path).map_err(|error| CommandFailure::io(path.display(), &error))?;
        let system = input::system_in(&file.0, &path, &changes, &mut crate::say)?;
        let state = watch::Sender::new(FileState::of(&file, Ok(&system)));
        Ok(Self { path, changes, state, reading: Mutex::default(), saving: Mutex::default() })
    }

    /// The file's name without its folders.
    pub(super) fn name(&self) -> String {
        name_of(&self.path)
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Reads the file again, and wakes those who wait for a change.
    pub(super) fn refresh(&self) -> FileState {
        let _reading = self.reading.lock().unwrap_or_else(PoisonError::into_inner);
        let known = self.state.borrow().clone();
        let next = self.state_of(input::to_follow(&self.path), &known);
        self.state.send_if_modified(|state| {
            *state != next && {
                state.clone_from(&next);
                true
            }
        });
        next
    }

    /// The file's state when it is not `known` any more, or after `patience`.
    pub(super) async fn after(&self, known: &str, patience: Duration) -> FileState {
        let mut changes = self.state.subscribe();
        let changed = changes.wait_for(|state| state.version != known);
        let _ = tokio::time::timeout(patience, changed).await;
        self.state.borrow().clone()
    }

    /// Writes the system of a link into the file, if the file is still the `known` one. Only new values are written,
    /// unless `whole`: then the file is written anew, and a copy of the former one stays beside it.
    pub(super) fn save(&self, link: &str, known: &str, whole: bool) -> Result<FileState, NotSaved> {
        let link = read_link(link).ok_or_else(|| NotSaved::Wrong(say!("this is no link of the page")))?;
        if let Some(problem) = link.problems.first() {
            return Err(NotSaved::Wrong(problem.message.clone()));
        }
        let _saving = self.saving.lock().unwrap_or_else(PoisonError::into_inner);
        let done = self.write(&link.definition, known, whole);
        // No folder for temporary files stays beside the file while the page is open.
        pending::remove_all();
        let kept = done?;
        Ok(FileState { kept, ..self.refresh() })
    }

    /// Returns the name of the copy of the former file, or an empty one.
    fn write(&self, definition: &Definition, known: &str, whole: bool) -> Result<String, NotSaved> {
        let failed = |error: io::Error| NotSaved::Refused(format!("{}: {error}", self.name()));
        let _turn = Turn::at(&self.path);
        let state = self.refresh();
        // What is edited is what the page has seen, and nothing but that is replaced.
        let former = input::to_follow(&self.path);
        if state.version != known || version_of(&former) != known {
            return Err(NotSaved::Changed(self.refresh()));
        }
        if !state.refusal.is_empty() {
            return Err(NotSaved::Refused(state.refusal));
        }
        let former = match former {
            Ok((bytes, _)) => Some(bytes),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(failed(error)),
        };
        let edited = former.as_ref().and_then(|bytes| edit_file(bytes, definition));
        let is_lost = former.is_some() && edited.is_none();
        if is_lost && !whole {
            return Err(NotSaved::Whole(self.loss(&state)));
        }
        let bytes = edited.unwrap_or_else(|| write_json(definition).into_bytes());
        let pending = Pending::write(&self.path, |out| out.write_all(&bytes)).map_err(failed)?;
        let copy = is_lost.then(|| pending::keep_beside(&self.path)).transpose().map_err(failed)?;
        match pending.replace(|path| version_of(&input::to_follow(path)) == known) {
            Ok(true) => Ok(copy.map(|copy| name_of(&copy)).unwrap_or_default()),
            not_replaced => {
                let _ = copy.map(fs::remove_file);
                Err(not_replaced.map_or_else(failed, |_| NotSaved::Changed(self.refresh())))
            }
        }
    }

    /// What a new text in place of the whole file would lose.
    fn loss(&self, state: &FileState) -> String {
        let name = self.name();
        match state.link {
            Some(_) => say!(
                "{} cannot hold this change beside its comments and own keys, and would be written anew without them. A copy of the former file stays beside it.",
                name
            ),
            None => {
                say!("{} has an error, and would be written anew. A copy of the former file stays beside it.", name)
            }
        }
    }

    fn state_of(&self, file: io::Result<(Vec<u8>, u64)>, former: &FileState) -> FileState {
        let name = self.name();
        let version = version_of(&file);
        if version == former.version {
            return former.clone();
        }
        let file = match file {
            Ok(file) => file,
            Err(error) => {
                let problems = match error.kind() {
                    io::ErrorKind::NotFound => say!("{} is not there any more.", name),
                    _ => format!("{name}: {error}"),
                };
                return FileState { version, link: None, problems, ..former.clone() };
            }
        };
        let mut problems = String::new();
        let system = input::system_in(&file.0, Path::new(&name), &self.changes, &mut |words| problems += words);
        match system {
            Ok(system) => FileState::of(&file, Ok(&system)),
            Err(CommandFailure::Words(words) | CommandFailure::Limit(words)) => {
                FileState::of(&file, Err(problems + &words))
            }
            Err(_) => FileState::of(&file, Err(problems)),
        }
    }
}

impl FileState {
    /// The state of a file with this beginning and this length.
    fn of(file: &(Vec<u8>, u64), system: Result<&InputSystem, String>) -> Self {
        let (bytes, length) = file;
        let foreign = import_file(bytes).is_some_and(|found| found.notation != OWN_JSON);
        let is_picture =
            bytes.starts_with(b"\x89PNG") || bytes.starts_with(b"%PDF") || bytes.trim_ascii_start().starts_with(b"<");
        let refusal = match (foreign, is_picture) {
            (_, true) => say!("A picture is not written again: save a JSON file."),
            (true, _) => say!("A file of another program is not written again: save a JSON file."),
            _ if *length > bytes.len() as u64 => say!("The file is too long to be read, and is not written again."),
            _ => String::new(),
        };
        let (link, problems) = match system {
            Ok(system) => (Some(write_link(&system.definition)), String::new()),
            Err(problems) => (None, problems),
        };
        Self { version: version_of(&Ok((bytes, *length))), link, problems, refusal, kept: String::new() }
    }
}

/// Equal for files with equal bytes. Of a file that is too long to be read, and so is never written, the beginning and the
/// length.
fn version_of(file: &io::Result<(impl AsRef<[u8]>, u64)>) -> String {
    match file {
        Ok((bytes, length)) => {
            let mut hasher = DefaultHasher::new();
            hasher.write(bytes.as_ref());
            format!("{:016x}-{length}", hasher.finish())
        }
        Err(error) if error.kind() == io::ErrorKind::NotFound => MISSING.to_owned(),
        Err(error) => error.kind().to_string(),
    }
}

fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}
