//! Files that are whole or not there, whatever ends the program.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::TempPath;

/// The temporary files that there are, so that a signal can remove them. Whoever makes, renames or removes one holds
/// the lock.
static TEMPORARY: Mutex<Vec<TempPath>> = Mutex::new(Vec::new());

fn temporary() -> MutexGuard<'static, Vec<TempPath>> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file under a temporary name in the folder of its own. Dropping it removes it; [`Pending::commit`] gives it its
/// name.
pub(crate) struct Pending {
    temporary: PathBuf,
    path: PathBuf,
}

impl Pending {
    /// Writes what `write` produces to a temporary file.
    ///
    /// # Errors
    /// As the file system or `write`; nothing is left behind then.
    pub(crate) fn write(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<Self> {
        let (file, temporary) = create(path.parent().unwrap_or(Path::new("")))?;
        let pending = Self { temporary, path: path.to_owned() };
        let mut out = BufWriter::with_capacity(1 << 16, file);
        write(&mut out)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?;
        Ok(pending)
    }

    /// Gives the file its name, in place of what had it before.
    ///
    /// # Errors
    /// As the file system.
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
    #[cfg(unix)]
    // As any other new file, and not for its owner alone.
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let (file, path) = builder.tempfile_in(folder).map_err(without_path)?.into_parts();
    let name = path.to_path_buf();
    all.push(path);
    Ok((file, name))
}

/// The error of the system itself: whoever reports it names the file that was asked for.
fn without_path(error: io::Error) -> io::Error {
    let code = error
        .get_ref()
        .and_then(std::error::Error::source)
        .and_then(|source| source.downcast_ref::<io::Error>().and_then(io::Error::raw_os_error));
    code.map_or(error, io::Error::from_raw_os_error)
}

/// Makes signals that end the program remove the temporary files first. What was ignored when the program was started,
/// as `nohup` does, stays ignored.
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
                    // The lock is kept: from here on no file is made and none gets its name.
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

/// Makes a file over the limit of `ulimit -f` an error of its writer, as a full disk is; otherwise the system would end
/// the program without a word.
#[cfg(unix)]
pub(crate) fn fail_on_large_files() {
    // Where that is not possible, all stays as it was.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default());
}

/// Other systems have no such limit.
#[cfg(not(unix))]
pub(crate) fn fail_on_large_files() {}

/// Whether a signal was ignored when the program was started. Where the system does not tell, only the signal of
/// `nohup` may be.
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

/// `base.extension`, also where `base` has dots: `1.24d` becomes `1.24d.svg`.
pub(crate) fn with_extension(base: &Path, extension: &str) -> PathBuf {
    let mut name = base.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    name.into()
}
