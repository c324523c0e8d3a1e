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
    /// A module bundled with its imports, except those that it imports later, whose names are `apart`.
    fn module(&self, entry: &str, apart: &[&str]) -> Result<String>;

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
}

impl Bundler for Esbuild {
    fn module(&self, entry: &str, apart: &[&str]) -> Result<String> {
        let apart: Vec<String> = apart.iter().map(|address| format!("--external:./{address}")).collect();
        let options = ["--bundle", "--format=esm"].into_iter().chain(apart.iter().map(String::as_str));
        self.run(&self.www.join(entry), &options.collect::<Vec<_>>())
    }

    fn styles(&self, names: &[&str]) -> Result<String> {
        let texts: Result<Vec<_>> = names.iter().map(|name| files::read_text(&self.www.join(name))).collect();
        self.minified("styles.css", &texts?.concat())
    }
}
