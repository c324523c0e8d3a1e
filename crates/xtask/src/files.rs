//! Small helpers for trees of files.

use anyhow::{Context, Result};
use fs_err as fs;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// All files below `root` that `wanted` accepts, sorted. `wanted` gets paths relative to `root`, also those of folders;
/// a refused folder is not entered. A missing folder has no files, and a file is its own.
pub(crate) fn list(root: &Path, wanted: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>> {
    if !root.exists() {
        return Ok(vec![]);
    }
    let mut found = vec![];
    let is_wanted = |path: &Path| path == root || path.strip_prefix(root).is_ok_and(&wanted);
    for entry in WalkDir::new(root).follow_links(true).into_iter().filter_entry(|entry| is_wanted(entry.path())) {
        let entry = entry?;
        if entry.file_type().is_file() {
            found.push(entry.into_path());
        }
    }
    found.sort();
    Ok(found)
}

/// Writes a file and creates the folders above it.
pub(crate) fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<()> {
    fs::create_dir_all(path.parent().context("a file without a folder")?)?;
    Ok(fs::write(path, bytes)?)
}

/// Makes something of files, unless it was made of the same files before. `made_of` is a file that tells of which ones.
pub(crate) fn once(files: &[&Path], made_of: &Path, make: impl FnOnce() -> Result<()>) -> Result<()> {
    let print = files.iter().map(|file| fingerprint(file)).collect::<Result<String>>()?;
    if made_of.is_file() && fs::read_to_string(made_of)? == print {
        return Ok(());
    }
    make()?;
    write(made_of, print)
}

/// The SHA-256 of a file, as hexadecimal digits.
pub(crate) fn fingerprint(file: &Path) -> Result<String> {
    Ok(hex(&Sha256::digest(fs::read(file)?)))
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        _ = write!(text, "{byte:02x}");
        text
    })
}
