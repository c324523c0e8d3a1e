//! The files of the checks, made by `lsys`.

use crate::{Options, output};
use anyhow::{Context, Result, bail};
use fs_err as fs;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// The program, and the folder for its files.
pub(crate) struct Made<'a> {
    options: &'a Options,
    folder: PathBuf,
}

/// What `lsys info` tells about a system.
pub(crate) struct Told {
    pub(crate) symbols: u64,
    pub(crate) segments: u64,
    /// The least coordinates, then the greatest ones: two or three each.
    bounds: Vec<f64>,
}

impl Told {
    /// The extent along each axis.
    pub(crate) fn sides(&self) -> Vec<f64> {
        let (low, high) = self.bounds.split_at(self.bounds.len() / 2);
        low.iter().zip(high).map(|(low, high)| high - low).collect()
    }
}

impl<'a> Made<'a> {
    /// Empties the folder.
    pub(crate) fn new(options: &'a Options) -> Result<Self> {
        let folder = options.folder.join("files");
        if folder.is_dir() {
            fs::remove_dir_all(&folder)?;
        }
        fs::create_dir_all(&folder)?;
        Ok(Self { options, folder })
    }

    /// A file or a folder for a check, which does not exist yet.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// A new folder for a check.
    pub(crate) fn new_folder(&self, name: &str) -> Result<PathBuf> {
        let folder = self.path(name);
        fs::create_dir(&folder)?;
        Ok(folder)
    }

    /// Draws a system of `data_in` on white paper in a format, with these words. Returns the file, and what `lsys` says.
    pub(crate) fn draw(&self, system: &str, format: &str, words: &[&str]) -> Result<(PathBuf, String)> {
        let names = [system, format].into_iter().chain(words.iter().copied());
        let name: String = names.collect::<Vec<_>>().join("-").replace(|letter: char| !letter.is_alphanumeric(), "-");
        let mut command = self.command("draw", system);
        command.arg(self.folder.join(&name)).args(["--format", format, "--set", "background=#ffffff"]).args(words);
        let done = command.stdout(Stdio::null()).output()?;
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        if !done.status.success() {
            bail!("lsys could not draw {system} as {format}: {said}");
        }
        let is_own = |path: &Path| path.file_stem().is_some_and(|stem| stem.to_string_lossy() == name);
        let mut paths = fs::read_dir(&self.folder)?.filter_map(|entry| Some(entry.ok()?.path()));
        let file = paths.find(|path| is_own(path)).with_context(|| format!("lsys wrote no file {name}"))?;
        Ok((file, said))
    }

    /// What `lsys info` tells.
    pub(crate) fn told(&self, system: &str) -> Result<Told> {
        let told: Value = serde_json::from_str(&output(self.command("info", system).arg("--json"))?)?;
        let count = |key: &str| told[key].as_str().and_then(|digits| digits.parse().ok()).context("a count");
        let bounds = told["bounds"].as_array().context("bounds")?.iter().filter_map(Value::as_f64).collect();
        Ok(Told { symbols: count("symbols")?, segments: count("segments")?, bounds })
    }

    /// The command `lsys VERB FILE`.
    pub(crate) fn command(&self, verb: &str, system: &str) -> Command {
        let mut command = Command::new(&self.options.lsys);
        command.arg(verb).arg(self.source(system));
        command
    }

    /// The file of a system of `data_in`.
    pub(crate) fn source(&self, system: &str) -> PathBuf {
        self.options.source(system)
    }
}
