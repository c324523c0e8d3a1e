//! Bundling and minifying of scripts and styles by esbuild.

use crate::workspace::output;
use crate::{files, page};
use anyhow::Result;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The language level of the oldest browsers that the page supports.
const TARGET: &str = "--target=es2022";

/// Bundles and minifies the files of a folder.
pub(crate) trait Bundler {
    /// A module bundled with its imports, also with those that it imports later.
    fn module(&self, entry: &str) -> Result<String>;

    /// A module bundled as `page.js`, and files for what it imports later and for what these have in common: names and
    /// texts.
    fn split(&self, entry: &str) -> Result<Vec<(String, String)>>;

    /// The styles of the files, in order.
    fn styles(&self, names: &[&str]) -> Result<String>;
}

/// esbuild, at the version in the lock file of `www`.
pub(crate) struct Esbuild {
    program: PathBuf,
    www: PathBuf,
}

impl Esbuild {
    /// Finds esbuild, and installs it if it is missing.
    pub(crate) fn of(www: &Path) -> Result<Self> {
        page::packages(www)?;
        let program = if cfg!(windows) { "esbuild.cmd" } else { "esbuild" };
        Ok(Self { program: www.join("node_modules/.bin").join(program), www: www.to_owned() })
    }

    /// A module bundled with its imports, as a classic script.
    pub(crate) fn script(&self, entry: &str) -> Result<String> {
        self.run(&self.www.join(entry), &["--bundle", "--format=iife"])
    }

    /// A classic script or styles, minified. The ending of `name` decides the kind.
    pub(crate) fn minified(&self, name: &str, text: &str) -> Result<String> {
        let folder = tempfile::tempdir()?;
        let file = folder.path().join(name);
        files::write(&file, text)?;
        self.run(&file, &[])
    }

    fn run(&self, file: &Path, options: &[&str]) -> Result<String> {
        let mut command = Command::new(&self.program);
        command.arg(file).args(["--minify", "--charset=utf8", "--legal-comments=none", "--log-level=warning", TARGET]);
        output(command.args(options))
    }

    /// Bundles a module. Elements and styles of late parts are texts in their scripts.
    fn bundled(&self, entry: &str, options: &[&str]) -> Result<String> {
        let texts = ["--bundle", "--format=esm", "--loader:.html=text", "--loader:.css=text"];
        self.run(&self.www.join(entry), &[&texts, options].concat())
    }
}

impl Bundler for Esbuild {
    fn module(&self, entry: &str) -> Result<String> {
        self.bundled(entry, &[])
    }

    fn split(&self, entry: &str) -> Result<Vec<(String, String)>> {
        let folder = tempfile::tempdir()?;
        let place = format!("--outdir={}", folder.path().display());
        self.bundled(entry, &["--splitting", &place, "--entry-names=page", "--chunk-names=[name]-[hash]"])?;
        let files = files::list(folder.path(), |_| true)?;
        let read = |file: &PathBuf| {
            let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
            Ok((name, files::read_text(file)?))
        };
        files.iter().map(read).collect()
    }

    fn styles(&self, names: &[&str]) -> Result<String> {
        let texts: Result<Vec<_>> = names.iter().map(|name| files::read_text(&self.www.join(name))).collect();
        self.minified("styles.css", &texts?.concat())
    }
}
