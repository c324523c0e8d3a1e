//! Small helpers for trees of files.

use anyhow::{Context, Result};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// All files below `root` that `wanted` accepts, sorted. `wanted` gets paths relative to `root`, also those of folders;
/// a refused folder is not entered. A missing folder has no files.
pub(crate) fn list(root: &Path, wanted: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>> {
    let mut files = vec![];
    let mut folders = vec![root.to_owned()];
    while let Some(folder) = folders.pop() {
        if !folder.is_dir() {
            continue;
        }
        for entry in fs::read_dir(&folder).with_context(|| format!("reading {}", folder.display()))? {
            let path = entry?.path();
            if !wanted(path.strip_prefix(root)?) {
                continue;
            }
            if path.is_dir() { folders.push(path) } else { files.push(path) }
        }
    }
    files.sort();
    Ok(files)
}

pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("reading {}", path.display()))
}

pub(crate) fn read_text(path: &Path) -> Result<String> {
    fs::read_to_string(path).with_context(|| format!("reading {}", path.display()))
}

/// Writes a file and creates the folders above it.
pub(crate) fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<()> {
    let write = || {
        path.parent().map_or(Ok(()), fs::create_dir_all)?;
        fs::write(path, bytes)
    };
    write().with_context(|| format!("writing {}", path.display()))
}

/// Makes something of a file, unless it was made of the same file before. `made_of` is a file that tells of which one.
pub(crate) fn once(file: &Path, made_of: &Path, make: impl FnOnce() -> Result<()>) -> Result<()> {
    let print = fingerprint(file)?;
    if made_of.is_file() && read_text(made_of)? == print {
        return Ok(());
    }
    make()?;
    write(made_of, print)
}

/// The SHA-256 of a file, as hexadecimal digits.
pub(crate) fn fingerprint(file: &Path) -> Result<String> {
    Ok(hex(&Sha256::digest(read(file)?)))
}

/// Bytes as hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        _ = write!(text, "{byte:02x}");
        text
    })
}
