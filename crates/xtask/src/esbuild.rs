//! Bundling and minifying of scripts and styles by esbuild.

use crate::page;
use crate::workspace::output;
use anyhow::{Context, Result};
use fs_err as fs;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The language level of the oldest browsers that the page supports.
const TARGET: &str = "--target=es2022";

/// Bundles and minifies the files of a folder.
pub(crate) trait Bundler {
    /// A module bundled with all its imports.
    fn module(&self, entry: &str) -> Result<String>;

    /// Writes `NAME.js`, and modules beside it for what is imported later and for what these modules share. Returns the
    /// names of the modules that `NAME.js` imports at once.
    fn split(&self, entry: &str, name: &str, site: &Path) -> Result<Vec<String>>;

    /// The styles of the files, in order.
    fn styles(&self, names: &[String]) -> Result<String>;
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

    /// A module bundled with its imports, as a classic script. It may wait for the words of a language.
    pub(crate) fn script(&self, entry: &str) -> Result<String> {
        let module = self.run(&self.www.join(entry), &["--bundle", "--format=esm"])?;
        Ok(format!("(async()=>{{\"use strict\";{module}}})();\n"))
    }

    /// A classic script or styles, minified. The ending of `name` decides the kind.
    pub(crate) fn minified(&self, name: &str, text: &str) -> Result<String> {
        let folder = tempfile::tempdir()?;
        let file = folder.path().join(name);
        fs::write(&file, text)?;
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

    fn split(&self, entry: &str, name: &str, site: &Path) -> Result<Vec<String>> {
        let told = tempfile::NamedTempFile::new()?;
        let [entry_name, folder, metafile] = [
            format!("--entry-names={name}"),
            format!("--outdir={}", site.display()),
            format!("--metafile={}", told.path().display()),
        ];
        self.bundled(entry, &["--splitting", "--chunk-names=[name]-[hash]", &entry_name, &folder, &metafile])?;
        let told: Value = serde_json::from_slice(&fs::read(told.path())?)?;
        let mut written = told["outputs"].as_object().into_iter().flatten();
        let page = written.find(|(file, _)| Path::new(file).file_stem().is_some_and(|stem| stem == name));
        let imports = page.context("esbuild names no module")?.1["imports"].as_array().into_iter().flatten();
        let at_once = imports.filter(|import| import["kind"] == "import-statement");
        let file = |import: &Value| Some(Path::new(import["path"].as_str()?).file_name()?.to_str()?.to_owned());
        Ok(at_once.filter_map(file).collect())
    }

    fn styles(&self, names: &[String]) -> Result<String> {
        let texts: Result<Vec<_>, _> = names.iter().map(|name| fs::read_to_string(self.www.join(name))).collect();
        self.minified("styles.css", &texts?.concat())
    }
}
