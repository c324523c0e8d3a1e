//! Output files that are either complete or absent, even if a signal ends the program.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::TempPath;

/// All temporary files, so that a signal can remove them. Making, renaming or removing a temporary file needs the lock.
static TEMPORARY: Mutex<Vec<TempPath>> = Mutex::new(Vec::new());

fn temporary() -> MutexGuard<'static, Vec<TempPath>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file in the folder of the final file. [`Pending::commit`] gives the file its final name; dropping
/// removes the file.
pub(crate) struct Pending {
    temporary: PathBuf,
    path: PathBuf,
}

impl Pending {
    /// Writes the output of `write` to a temporary file.
    ///
    /// # Errors
    /// Errors of the file system and of `write`; the temporary file is then removed.
    pub(crate) fn write(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<Self> {
        let (file, temporary) = create(path.parent().unwrap_or(Path::new("")))?;
        let pending = Self { temporary, path: path.to_owned() };
        let mut out = BufWriter::with_capacity(1 << 16, file);
        write(&mut out)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?;
        Ok(pending)
    }

    /// Gives the file its final name and replaces an existing file.
    ///
    /// # Errors
    /// Errors of the file system.
    pub(crate) fn commit(self) -> io::Result<()> {
        let mut all = temporary();
        let Some(at) = all.iter().position(|path| **path == *self.temporary) else {
            return Err(io::ErrorKind::NotFound.into());
        };
        let result = all.swap_remove(at).persist(&self.path).map_err(|error| error.error);
        // Dropping `self` takes the lock again.
        drop(all);
        result
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        temporary().retain(|path| **path != *self.temporary);
    }
}

/// Makes an empty file in `folder` that is removed when the program ends.
fn create(folder: &Path) -> io::Result<(File, PathBuf)> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let mut all = temporary();
    if all.is_empty() {
        remove_on_signals()?;
    }
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lsys.").suffix(".tmp");
    // An own `open` gives the file the usual permissions and keeps the temporary name out of error messages.
    let open = |path: &Path| File::options().write(true).create_new(true).open(path);
    let (file, path) = builder.make_in(folder, open)?.into_parts();
    let name = path.to_path_buf();
    all.push(path);
    Ok((file, name))
}

/// Makes signals that end the program remove the temporary files first. Signals that were ignored at the start, as by
/// `nohup`, stay ignored.
#[cfg(unix)]
fn remove_on_signals() -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU};
    use signal_hook::iterator::Signals;
    use std::sync::Once;
    static ONCE: Once = Once::new();
    let mut result = Ok(());
    ONCE.call_once(|| {
        let ends = [SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGXCPU].into_iter().filter(|&signal| !is_ignored(signal));
        let listen = |mut signals: Signals| {
            std::thread::spawn(move || {
                if let Some(signal) = signals.forever().next() {
                    // The lock is kept, so that no file is made or renamed from now on.
                    let mut all = temporary();
                    all.clear();
                    let _ = signal_hook::low_level::emulate_default_handler(signal);
                }
            });
        };
        result = Signals::new(ends).map(listen);
    });
    result
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
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    match mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()) {
        Some(mask) => mask >> (signal - 1) & 1 == 1,
        None => signal == signal_hook::consts::SIGHUP,
    }
}

#[cfg(windows)]
fn remove_on_signals() -> io::Result<()> {
    use std::sync::Once;
    static ONCE: Once = Once::new();
    let mut result = Ok(());
    ONCE.call_once(|| {
        let remove = || {
            let mut all = temporary();
            all.clear();
            std::process::exit(130);
        };
        result = ctrlc::set_handler(remove).map_err(io::Error::other);
    });
    result
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
