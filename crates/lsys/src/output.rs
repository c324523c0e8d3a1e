//! Standard output, and files that are whole or not there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Writes to standard output what `write` produces, buffered.
///
/// # Errors
/// As the writer; [`io::ErrorKind::BrokenPipe`] where the reader has gone.
pub(crate) fn print(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(1 << 16, io::stdout().lock());
    write(&mut out)?;
    out.flush()
}

/// A file under a temporary name beside its own. Dropping it removes it; [`Pending::commit`] gives it its name.
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
        let mut name = std::ffi::OsString::from(".");
        name.push(path.file_name().ok_or(io::ErrorKind::InvalidFilename)?);
        name.push(format!(".{}.tmp", std::process::id()));
        let pending = Self { temporary: path.with_file_name(name), path: path.to_owned() };
        let mut out = BufWriter::with_capacity(1 << 16, File::create(&pending.temporary)?);
        write(&mut out)?;
        out.into_inner().map_err(io::IntoInnerError::into_error)?;
        Ok(pending)
    }

    /// Gives the file its name, in place of what had it before.
    ///
    /// # Errors
    /// As the file system.
    pub(crate) fn commit(self) -> io::Result<()> {
        fs::rename(&self.temporary, &self.path)
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        // After a rename there is nothing to remove, and on other errors nothing more can be done.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// `base.extension`, also where `base` has dots: `1.24d` becomes `1.24d.svg`.
pub(crate) fn with_extension(base: &Path, extension: &str) -> PathBuf {
    let mut name = base.as_os_str().to_owned();
    name.push(".");
    name.push(extension);
    name.into()
}
