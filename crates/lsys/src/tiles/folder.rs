//! The folder of a pyramid, in which several processes write at the same time.

use crate::pending::Pending;
use lsystem::base::say;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The file with the description of the pyramid, which makes a folder one of ours.
const INDEX: &str = "pyramid.json";

pub(super) struct Folder {
    root: PathBuf,
}

impl Folder {
    /// Opens or makes a folder for the pyramid that `index` describes, with files and folders of these `names`.
    ///
    /// # Errors
    /// If the folder has another pyramid, or one of the names without a pyramid, or cannot be written.
    pub(super) fn open(root: &Path, index: &str, names: &[String]) -> io::Result<Self> {
        fs::create_dir_all(root)?;
        let folder = Self { root: root.to_owned() };
        if folder.has_index(index)? {
            return Ok(folder);
        }
        let taken = names.iter().find(|name| fs::symlink_metadata(root.join(name)).is_ok());
        // Another process may have made the pyramid in the meantime.
        if let Some(taken) = taken
            && !folder.has_index(index)?
        {
            return Err(io::Error::other(say!("there is {}, but no pyramid: choose another folder", taken)));
        }
        let pending = Pending::write(&root.join(INDEX), |out| out.write_all(index.as_bytes()))?;
        match pending.commit_new() {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => folder.has_index(index).map(|_| folder),
            done => done.map(|()| folder),
        }
    }

    /// Whether the folder is that of the pyramid; `false` if it is none.
    ///
    /// # Errors
    /// If the folder has another pyramid.
    fn has_index(&self, index: &str) -> io::Result<bool> {
        let path = self.root.join(INDEX);
        let is_file = match fs::symlink_metadata(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(false),
            found => found?.is_file(),
        };
        let mut known = Vec::new();
        // Opening a pipe would wait.
        if is_file {
            File::open(&path)?.take(index.len() as u64 + 1).read_to_end(&mut known)?;
        }
        match known == index.as_bytes() {
            true => Ok(true),
            false => Err(io::Error::other(say!("{} tells of another pyramid: choose another folder", INDEX))),
        }
    }

    /// Whether there is a file with this path inside the folder.
    pub(super) fn has(&self, path: &Path) -> bool {
        self.root.join(path).exists()
    }

    /// Writes a file with this path inside the folder, and replaces an existing one.
    pub(super) fn write(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        let path = self.root.join(path);
        if let Some(parent) = path.parent().filter(|parent| !parent.exists()) {
            fs::create_dir_all(parent)?;
        }
        Pending::write_below(&self.root, &path, |out| out.write_all(bytes)).and_then(Pending::commit)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_of_others_are_refused() {
        let root = tempfile::tempdir().unwrap();
        let names = ["index.html".to_owned()];
        let open = |index: &str| Folder::open(root.path(), index, &names);
        let page = root.path().join("index.html");
        fs::write(&page, "home").unwrap();
        assert!(open("a").is_err_and(|error| error.to_string().contains("index.html")));
        assert!(!root.path().join(INDEX).exists());
        fs::remove_file(&page).unwrap();
        let first = open("a").unwrap();
        first.write(Path::new("index.html"), b"ours").unwrap();
        let second = open("a").unwrap();
        second.write(Path::new("x/y/1.png"), b"1").unwrap();
        first.write(Path::new("x/y/1.png"), b"2").unwrap();
        assert_eq!(fs::read(root.path().join("x/y/1.png")).unwrap(), b"2");
        assert!(first.has(Path::new("x/y/1.png")) && !first.has(Path::new("x/y/2.png")));
        assert!(open("b").is_err() && open("").is_err());
    }
}
