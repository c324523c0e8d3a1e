//! The only way to an output file: it is either complete or as it was before, even if a signal ends the program.
//!
//! A file is written into a scratch folder beside it and then renamed. The scratch folder is removed when the program
//! ends. A killed program leaves it behind, and the next one that writes there removes it: the folder has a file with a
//! mark, whose lock ends with its program. Without the mark, or with files of others inside, a folder is not touched.

use crate::input;
use lsystem::base::say;
use std::fs::{self, File, Metadata, Permissions, TryLockError};
use std::io::{self, BufWriter, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The beginning of the names of scratch folders.
const PREFIX: &str = ".lsys-";
/// How long a program waits for another one, and how often.
const PAUSE: Duration = Duration::from_millis(10);
const TRIES: u32 = 500;
/// The file of a scratch folder that its program keeps locked, and its text. All other files have numbers as names.
const LOCK: &str = "lock";
const MARK: &[u8] = b"Temporary files of lsys, which removes them by itself.\n";

/// The scratch folders of this program. Making, renaming or removing a temporary file needs the lock, so that a signal
/// finds all files.
static SCRATCH: Mutex<Scratch> = Mutex::new(Scratch { folders: Vec::new(), files: 0, is_guarded: false });

struct Scratch {
    folders: Vec<Folder>,
    /// The number of files so far.
    files: u64,
    /// Whether signals remove the folders.
    is_guarded: bool,
}

struct Folder {
    /// The folder of the outputs.
    parent: PathBuf,
    path: PathBuf,
    /// Locked as long as the program lives.
    _lock: File,
}

fn scratch() -> MutexGuard<'static, Scratch> {
    SCRATCH.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files. Called at the end of the program.
pub(crate) fn remove_all() {
    scratch().clear();
}

/// A complete output without its name. [`Pending::commit`] gives the file its name; dropping removes the file.
pub(crate) struct Pending {
    temporary: PathBuf,
    path: PathBuf,
}

impl Pending {
    /// Writes the output of `write` to a temporary file beside `path`.
    ///
    /// # Errors
    /// Errors of the file system and of `write`; an error if the file there must not be replaced: a file that this
    /// command reads, a symbolic link, a read-only file, or no file.
    pub(crate) fn write(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<Self> {
        Self::write_below(path.parent().unwrap_or(Path::new("")), path, write)
    }

    /// As [`Pending::write`], with the temporary file in `folder`, which has `path` somewhere below it.
    ///
    /// # Errors
    /// As [`Pending::write`].
    pub(crate) fn write_below(
        folder: &Path,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<Self> {
        let former = replaceable(path)?;
        let (file, temporary) = scratch().file(folder)?;
        let pending = Self { temporary, path: path.to_owned() };
        let mut out = BufWriter::with_capacity(1 << 16, file);
        write(&mut out)?;
        let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
        if let Some(permissions) = former {
            file.set_permissions(permissions)?;
            // A loss of power must not leave an empty file in place of the former one.
            file.sync_data()?;
        }
        Ok(pending)
    }

    /// Gives the file its name and replaces an existing file.
    ///
    /// # Errors
    /// As [`Pending::write`].
    pub(crate) fn commit(self) -> io::Result<()> {
        replaceable(&self.path)?;
        let _all = scratch();
        fs::rename(&self.temporary, &self.path)
    }

    /// Gives the file its name in place of a file for which `is_known` holds, or of none. What another program puts there
    /// until then stays. Returns whether the file got its name.
    ///
    /// # Errors
    /// As [`Pending::write`].
    pub(crate) fn replace(self, is_known: impl Fn(&Path) -> bool) -> io::Result<bool> {
        let former = replaceable(&self.path)?;
        if !is_known(&self.path) {
            return Ok(false);
        }
        if former.is_none() {
            return match self.commit_new() {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
                done => done.map(|()| true),
            };
        }
        let _all = scratch();
        // Nobody takes a turn at the own file before it is known whether it stays: what others made of it could not be
        // told from the file that must come back.
        let own = File::open(&self.temporary)?;
        let _ = if cfg!(unix) { own.try_lock() } else { Ok(()) };
        let own_file = own.metadata()?;
        match exchange(&self.temporary, &self.path) {
            Ok(()) if is_known(&self.temporary) => Ok(true),
            Ok(()) => {
                // Back again, until the own file comes out: others may go on, or rest in the midst of the same.
                for _ in 0..TRIES {
                    exchange(&self.temporary, &self.path)?;
                    if is_same(&fs::metadata(&self.temporary)?, &own_file) {
                        break;
                    }
                    std::thread::sleep(PAUSE);
                }
                Ok(false)
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
            // Without exchanges, a change in this instant is lost.
            Err(_) => fs::rename(&self.temporary, &self.path).map(|()| true),
        }
    }

    /// Gives the file its name if no file has it.
    ///
    /// # Errors
    /// [`io::ErrorKind::AlreadyExists`]; errors of the file system.
    pub(crate) fn commit_new(self) -> io::Result<()> {
        let _all = scratch();
        match fs::hard_link(&self.temporary, &self.path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Err(error),
            Ok(()) => Ok(()),
            // Some file systems have no links.
            Err(_) if fs::symlink_metadata(&self.path).is_ok() => Err(io::ErrorKind::AlreadyExists.into()),
            Err(_) => fs::rename(&self.temporary, &self.path),
        }
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        let _all = scratch();
        let _ = fs::remove_file(&self.temporary);
    }
}

/// Lets two files have each other's name, at once.
#[cfg(any(target_os = "linux", target_vendor = "apple"))]
fn exchange(one: &Path, other: &Path) -> io::Result<()> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    Ok(renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE)?)
}

#[cfg(not(any(target_os = "linux", target_vendor = "apple")))]
fn exchange(_: &Path, _: &Path) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Keeps a file under another name beside it, `NAME.before-1`, or the next number that is free. Returns the path.
///
/// # Errors
/// Errors of the file system.
pub(crate) fn keep_beside(path: &Path) -> io::Result<PathBuf> {
    let mut number = 1_u32;
    loop {
        let copy = with_extension(path, &format!("before-{number}"));
        let linked = fs::hard_link(path, &copy).or_else(|error| match error.kind() {
            io::ErrorKind::AlreadyExists => Err(error),
            // Some file systems have no links.
            _ => {
                File::create_new(&copy)?;
                fs::copy(path, &copy).map(|_| ()).inspect_err(|_| drop(fs::remove_file(&copy)))
            }
        });
        match linked {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
            linked => return linked.map(|()| copy),
        }
    }
}

/// The turn of a program that reads a file and then replaces it: other programs `lsys` wait. Nobody waits without end,
/// and on systems where a lock would keep the program itself from reading there are no turns.
pub(crate) struct Turn(#[expect(dead_code, reason = "the lock ends with it")] Option<File>);

impl Turn {
    pub(crate) fn at(path: &Path) -> Self {
        for _ in 0..if cfg!(unix) { TRIES } else { 0 } {
            let Ok(file) = File::open(path).and_then(|file| Ok((file.metadata()?, file))) else { break };
            match file.1.try_lock() {
                // The file may have been replaced in the meantime.
                Ok(()) if fs::metadata(path).is_ok_and(|now| is_same(&now, &file.0)) => return Self(Some(file.1)),
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => std::thread::sleep(PAUSE),
                Err(TryLockError::Error(_)) => break,
            }
        }
        Self(None)
    }
}

/// Whether this is the same file, under whatever name.
#[cfg(unix)]
fn is_same(one: &Metadata, other: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    (one.dev(), one.ino()) == (other.dev(), other.ino())
}

#[cfg(not(unix))]
fn is_same(_: &Metadata, _: &Metadata) -> bool {
    true
}

/// Checks that a file may get this name. Returns the permissions of the file that it replaces.
fn replaceable(path: &Path) -> io::Result<Option<Permissions>> {
    let former = match fs::symlink_metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        former => former?,
    };
    let refused = |why: String| Err(io::Error::other(why));
    match former.permissions() {
        _ if former.is_symlink() => refused(say!("this is a symbolic link: give the file to which it leads")),
        _ if !former.is_file() => refused(say!("this is not a file")),
        _ if input::is_input(path) => refused(say!("this file is read by the same command: give another name")),
        permissions if permissions.readonly() => refused(say!("this file is read-only")),
        permissions => Ok(Some(permissions)),
    }
}

impl Scratch {
    /// Makes an empty temporary file for outputs in or below `parent`.
    fn file(&mut self, parent: &Path) -> io::Result<(File, PathBuf)> {
        let parent = if parent.as_os_str().is_empty() { Path::new(".") } else { parent };
        if !self.is_guarded {
            remove_on_signals()?;
            self.is_guarded = true;
        }
        let folder = match self.folders.iter().position(|folder| folder.parent == parent) {
            Some(at) => &self.folders[at],
            None => {
                remove_dead(parent);
                self.folders.push(Folder::new(parent)?);
                &self.folders[self.folders.len() - 1]
            }
        };
        self.files += 1;
        let path = folder.path.join(self.files.to_string());
        // The file gets the usual permissions.
        Ok((File::options().write(true).create_new(true).open(&path)?, path))
    }

    fn clear(&mut self) {
        self.folders.drain(..).for_each(|folder| remove(&folder.path));
    }
}

impl Folder {
    fn new(parent: &Path) -> io::Result<Self> {
        let mut number = std::process::id();
        let path = loop {
            let path = parent.join(format!("{PREFIX}{number}"));
            match fs::create_dir(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number = number.wrapping_add(1),
                made => break made.map(|()| path)?,
            }
        };
        let marked = || {
            let mut lock = File::options().write(true).create_new(true).open(path.join(LOCK))?;
            // The mark follows the lock: no other program takes the folder for a dead one in between. A file system
            // without locks gets no mark.
            if lock.lock().is_ok() {
                lock.write_all(MARK)?;
            }
            Ok(lock)
        };
        match marked() {
            Ok(lock) => Ok(Self { parent: parent.to_owned(), path, _lock: lock }),
            Err(error) => {
                remove(&path);
                Err(error)
            }
        }
    }
}

/// Removes the scratch folders in `parent` whose programs were killed. What cannot be read or removed stays.
pub(crate) fn remove_dead(parent: &Path) {
    for entry in fs::read_dir(parent).into_iter().flatten().flatten() {
        let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && entry.file_name().as_encoded_bytes().starts_with(PREFIX.as_bytes()) {
            // The lock is kept until the folder is gone.
            if let Some(_lock) = dead_lock(&entry.path().join(LOCK)) {
                remove(&entry.path());
            }
        }
    }
}

/// The lock of a scratch folder whose program has ended.
fn dead_lock(path: &Path) -> Option<File> {
    // Opening a pipe would wait.
    fs::symlink_metadata(path).ok().filter(Metadata::is_file)?;
    let lock = File::open(path).ok()?;
    lock.try_lock().ok()?;
    let mut mark = Vec::new();
    (&lock).take(MARK.len() as u64 + 1).read_to_end(&mut mark).ok()?;
    (mark == MARK).then_some(lock)
}

/// Removes a scratch folder, unless there is something else in it. The file with the mark is the last one.
fn remove(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder).and_then(Iterator::collect::<io::Result<Vec<_>>>) else { return };
    let is_own = |entry: &fs::DirEntry| {
        let name = entry.file_name();
        let is_number = name.as_encoded_bytes().iter().all(u8::is_ascii_digit);
        (is_number || name == LOCK) && entry.file_type().is_ok_and(|kind| kind.is_file())
    };
    if !entries.iter().all(is_own) {
        return;
    }
    for entry in entries.iter().filter(|entry| entry.file_name() != LOCK) {
        let _ = fs::remove_file(entry.path());
    }
    let _ = fs::remove_file(folder.join(LOCK));
    let _ = fs::remove_dir(folder);
}

/// Makes signals that end the program remove the temporary files first. Signals that were ignored at the start, as by
/// `nohup`, stay ignored.
#[cfg(unix)]
fn remove_on_signals() -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU};
    use signal_hook::iterator::Signals;
    let ends = [SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU].into_iter().filter(|&signal| !is_ignored(signal));
    let mut signals = Signals::new(ends)?;
    std::thread::Builder::new().spawn(move || {
        if let Some(signal) = signals.forever().next() {
            // The lock is kept, so that no file is made or renamed from now on.
            let mut all = scratch();
            all.clear();
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    })?;
    Ok(())
}

/// Makes a file above the limit of `ulimit -f` a write error, like a full disk. Without this the system would end the
/// program without a message.
#[cfg(unix)]
pub(crate) fn fail_on_large_files() {
    // On failure the system's default behaviour stays.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

/// Other systems have no such limit.
#[cfg(not(unix))]
pub(crate) fn fail_on_large_files() {}

/// Whether a signal was ignored when the program was started. Without `/proc`, only the signal of `nohup` counts as
/// ignored, to be safe.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    match mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()) {
        Some(mask) => mask >> (signal - 1) & 1 == 1,
        None => signal == signal_hook::consts::SIGHUP,
    }
}

#[cfg(windows)]
fn remove_on_signals() -> io::Result<()> {
    let remove = || {
        let mut all = scratch();
        all.clear();
        std::process::exit(130);
    };
    ctrlc::set_handler(remove).map_err(io::Error::other)
}

#[cfg(not(any(unix, windows)))]
fn remove_on_signals() -> io::Result<()> {
    Ok(())
}

/// `base.extension`, also for a `base` with dots: `1.24d` becomes `1.24d.svg`.
pub(crate) fn with_extension(base: &Path, extension: &str) -> PathBuf {
    let mut name = base.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    name.into()
}

#[cfg(test)]
mod tests;
