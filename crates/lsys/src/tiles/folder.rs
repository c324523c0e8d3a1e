//! The folder of a pyramid, in which several processes write at the same time.
//!
//! A file is written into a folder of the process first and then moved, so it is whole or absent. A process that was
//! killed leaves its own folder behind, which the next process removes: the lock on a file inside ends with the
//! process.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use tempfile::TempDir;

/// The file with the description of the pyramid. Its lock guards the making and the removing of processes' folders.
const INDEX: &str = "pyramid.json";
/// The beginning of the names of processes' folders.
const OWN: &str = ".lsys-";
/// The file in a process's folder that the process keeps locked.
const LOCK: &str = "lock";

pub(super) struct Folder {
    root: PathBuf,
    own: TempDir,
    /// Locked as long as the process lives.
    _lock: File,
    files: AtomicU64,
}

impl Folder {
    /// Opens or makes a folder for the pyramid that `index` describes.
    ///
    /// # Errors
    /// If the folder has another pyramid, or cannot be written.
    pub(super) fn open(root: &Path, index: &str) -> io::Result<Self> {
        fs::create_dir_all(root)?;
        let path = root.join(INDEX);
        let mut file = File::options().read(true).write(true).create(true).truncate(false).open(&path)?;
        file.lock()?;
        let mut known = String::new();
        file.read_to_string(&mut known)?;
        if known.is_empty() {
            file.write_all(index.as_bytes())?;
        } else if known != index {
            return Err(io::Error::other(format!("{INDEX} tells of another pyramid: choose another folder")));
        }
        remove_dead(root)?;
        let own = tempfile::Builder::new().prefix(OWN).tempdir_in(root)?;
        let lock = File::create(own.path().join(LOCK))?;
        lock.lock()?;
        Ok(Self { root: root.to_owned(), own, _lock: lock, files: AtomicU64::new(0) })
    }

    /// Whether there is a file with this path inside the folder.
    pub(super) fn has(&self, path: &Path) -> bool {
        self.root.join(path).exists()
    }

    /// Writes a file with this path inside the folder, and replaces an existing one.
    pub(super) fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let number = self.files.fetch_add(1, Ordering::Relaxed);
        let temporary = self.own.path().join(number.to_string());
        fs::write(&temporary, bytes)?;
        let path = self.root.join(path);
        match fs::rename(&temporary, &path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                path.parent().map_or(Ok(()), fs::create_dir_all)?;
                fs::rename(&temporary, &path)
            }
            done => done,
        }
    }
}

/// Removes what processes that do not live any more have left behind.
fn remove_dead(root: &Path) -> io::Result<()> {
    for entry in fs::read_dir(root)? {
        let entry = entry?;
        if !entry.file_name().to_string_lossy().starts_with(OWN) {
            continue;
        }
        let is_dead = match File::open(entry.path().join(LOCK)) {
            Ok(lock) => lock.try_lock().is_ok(),
            Err(error) => error.kind() == io::ErrorKind::NotFound,
        };
        if is_dead {
            match fs::remove_dir_all(entry.path()) {
                // The process has ended by itself.
                Err(error) if error.kind() == io::ErrorKind::NotFound => {}
                result => result?,
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dead_folders_are_removed_and_living_ones_stay() {
        let root = tempfile::tempdir().unwrap();
        let first = Folder::open(root.path(), "a").unwrap();
        first.write(Path::new("x/y/1.png"), b"1").unwrap();
        let dead = root.path().join(".lsys-dead");
        fs::create_dir(&dead).unwrap();
        fs::write(dead.join("0"), b"half").unwrap();
        fs::write(dead.join(LOCK), b"").unwrap();
        let second = Folder::open(root.path(), "a").unwrap();
        assert!(!dead.exists() && first.own.path().exists() && second.own.path().exists());
        first.write(Path::new("x/y/1.png"), b"2").unwrap();
        assert_eq!(fs::read(root.path().join("x/y/1.png")).unwrap(), b"2");
        assert!(second.has(Path::new("x/y/1.png")) && !second.has(Path::new("x/y/2.png")));
        drop((first, second));
        let names: Vec<_> = fs::read_dir(root.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(names.len(), 2, "{names:?}");
        assert!(Folder::open(root.path(), "b").is_err());
    }
}
