//! What passed, with the fingerprint of all that it reads. What reads the same files as when it last passed is skipped.

use crate::files;
use crate::report::Report;
use anyhow::Result;
use fs_err as fs;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// The fingerprints of what passed, by name, kept in a file.
pub(super) struct Passed {
    file: PathBuf,
    /// Whether everything runs, whatever has passed.
    all: bool,
    known: Mutex<BTreeMap<String, Entry>>,
}

/// A test or a step that passed.
#[derive(Clone)]
struct Entry {
    print: String,
    seconds: f64,
}

impl Passed {
    /// Reads the file. A missing or unreadable file means that nothing is known.
    pub(super) fn read(file: PathBuf, all: bool) -> Self {
        let text = fs::read_to_string(&file).unwrap_or_default();
        let known = text.lines().filter_map(|line| {
            let mut words = line.splitn(3, ' ');
            let (print, seconds) = (words.next()?.to_owned(), words.next()?.parse().ok()?);
            Some((words.next()?.to_owned(), Entry { print, seconds }))
        });
        Self { known: Mutex::new(known.collect()), file, all }
    }

    /// Whether this passed with the same fingerprint and need not run again.
    pub(super) fn has(&self, name: &str, print: &str) -> bool {
        !self.all && self.entry(name).is_some_and(|entry| entry.print == print)
    }

    /// The seconds that this took when it last passed.
    pub(super) fn seconds(&self, name: &str) -> Option<f64> {
        Some(self.entry(name)?.seconds)
    }

    /// The fingerprint with which this last passed.
    pub(super) fn print(&self, name: &str) -> Option<String> {
        Some(self.entry(name)?.print)
    }

    fn entry(&self, name: &str) -> Option<Entry> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner).get(name).cloned()
    }

    /// Runs a step, unless it passed with the same fingerprint.
    pub(super) fn once(
        &self,
        report: &Report,
        name: &str,
        print: &str,
        step: impl FnOnce() -> Result<()>,
    ) -> Result<()> {
        if self.has(name, print) {
            report.skip(format!("{name}: passed as it is"));
            return Ok(());
        }
        let start = Instant::now();
        step()?;
        self.note(name, print, start.elapsed().as_secs_f64())
    }

    /// Notes that this passed. The file is written at once, so that an interrupted run loses nothing.
    pub(super) fn note(&self, name: &str, print: &str, seconds: f64) -> Result<()> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        known.insert(name.to_owned(), Entry { print: print.to_owned(), seconds });
        let lines = known.iter().map(|(name, entry)| format!("{} {:.3} {name}\n", entry.print, entry.seconds));
        files::write(&self.file, lines.collect::<String>())
    }
}

/// The fingerprint of files and of all files below folders, by path and content. Folders of installed packages are left
/// out.
pub(super) fn fingerprint<'a>(paths: impl IntoIterator<Item = &'a Path>) -> Result<String> {
    fingerprint_of(paths, |_| true)
}

/// As [`fingerprint`], of the files that `wanted` accepts.
pub(super) fn fingerprint_of<'a>(
    paths: impl IntoIterator<Item = &'a Path>,
    wanted: impl Fn(&Path) -> bool,
) -> Result<String> {
    let mut all = Sha256::new();
    for path in paths {
        let is_own = |below: &Path| !below.ends_with("node_modules") && !below.ends_with("target");
        let found = if path.is_dir() { files::list(path, is_own)? } else { vec![path.to_owned()] };
        for file in found.iter().filter(|file| wanted(file)) {
            all.update(file.strip_prefix(path)?.as_os_str().as_encoded_bytes());
            all.update(Sha256::digest(fs::read(file)?));
        }
    }
    Ok(files::hex(&all.finalize())[..32].to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_reads_the_same_has_passed() {
        let folder = tempfile::tempdir().unwrap();
        let source = folder.path().join("source");
        let print = || fingerprint([source.as_path()]).unwrap();
        files::write(&source.join("a"), "1").unwrap();
        let first = print();
        let file = folder.path().join("passed.txt");
        let passed = Passed::read(file.clone(), false);
        assert!(!passed.has("a test of this", &first));
        passed.note("a test of this", &first, 1.5).unwrap();
        files::write(&source.join("node_modules/b"), "1").unwrap();
        let again = Passed::read(file.clone(), false);
        assert!(again.has("a test of this", &print()) && again.seconds("a test of this") == Some(1.5));
        assert!(!Passed::read(file, true).has("a test of this", &print()));
        files::write(&source.join("b"), "1").unwrap();
        assert!(!again.has("a test of this", &print()));
    }
}
