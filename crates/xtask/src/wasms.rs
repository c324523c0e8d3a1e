//! The wasms of the site: each has a crate, generated JavaScript, and a worker that runs it.

use crate::build::Kind;
use crate::esbuild::Esbuild;
use crate::workspace::Workspace;
use crate::{bindgen, files, tools};
use anyhow::Result;
use fs_err as fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A wasm of the site: `NAME.wasm`.
pub(crate) struct Wasm {
    /// The crate with its boundary.
    pub(crate) package: &'static str,
    /// The feature with which it is compiled; `None` for all.
    feature: Option<&'static str>,
    /// The name of its files on the site and of its generated files.
    pub(crate) name: &'static str,
    /// The name of its worker's script on the site.
    pub(crate) script: &'static str,
    /// The worker's first module, in `www`.
    worker: &'static str,
}

const TOOLS: &str = "lsystem-tools-wasm";

/// All wasms: first the core, then the tools that few visits need, and the tools that pages in single files carry.
pub(crate) const WASMS: [Wasm; 4] = [
    Wasm { package: "lsystem-wasm", feature: None, name: "lsystem", script: "worker.js", worker: "worker/worker.js" },
    Wasm { package: TOOLS, feature: None, name: "tools", script: "tools.js", worker: "worker/tools.js" },
    Wasm { package: TOOLS, feature: Some("course"), name: "course", script: "course.js", worker: "worker/course.js" },
    Wasm { package: TOOLS, feature: Some("film"), name: "film", script: "film.js", worker: "worker/film.js" },
];

/// The boundary crates.
pub(crate) const PACKAGES: [&str; 2] = ["lsystem-wasm", TOOLS];

impl Wasm {
    /// The name of the wasm on the site.
    pub(crate) fn file(&self) -> String {
        format!("{}.wasm", self.name)
    }

    /// The worker as one classic script, which works in sandboxed frames and from files. Module workers and imports
    /// fail there.
    fn write(&self, esbuild: &Esbuild, generated: &Path, site: &Path) -> Result<()> {
        fs::copy(generated.join(format!("{}_bg.wasm", self.name)), site.join(self.file()))?;
        let glue = fs::read_to_string(generated.join(format!("{}.js", self.name)))?;
        files::write(&site.join(self.script), esbuild.minified("glue.js", &glue)? + &esbuild.script(self.worker)?)
    }

    fn compile(&self, workspace: &Workspace, kind: Kind) -> Result<()> {
        tools::wasm_target()?;
        compile_one(workspace, kind, self.package, self.feature)?;
        let [written, kept] = self.compiled(workspace, kind);
        fs::copy(written, kept)?;
        Ok(())
    }

    /// Generates its JavaScript, and puts the wasm and its worker into the folder of the site.
    fn generate(&self, workspace: &Workspace, kind: Kind, esbuild: &Esbuild, site: &Path) -> Result<()> {
        let generated = generated(workspace);
        let [_, file] = self.compiled(workspace, kind);
        // Reading a wasm and writing it anew takes a second, so it is done only after a change.
        let made_of = generated.join(format!("{}.made-of", self.name));
        files::once(&[&file], &made_of, || bindgen::generate(&file, &generated, self.name))?;
        self.write(esbuild, &generated, site)
    }

    /// Where Cargo puts the compiled crate, and where it is kept, because with its next features it is put there, too.
    fn compiled(&self, workspace: &Workspace, kind: Kind) -> [PathBuf; 2] {
        let folder = workspace.target.join(tools::WASM_TARGET).join(profile(kind));
        [self.package.replace('-', "_"), format!("site-{}", self.name)].map(|name| folder.join(name + ".wasm"))
    }
}

/// Compiles the boundary crates, as wasms alone: Cargo does not optimise across crates what is a Rust library, too.
pub(crate) fn compile(workspace: &Workspace, kind: Kind) -> Result<()> {
    WASMS.iter().try_for_each(|wasm| wasm.compile(workspace, kind))
}

/// Compiles the core's boundary alone.
pub(crate) fn compile_first(workspace: &Workspace, kind: Kind) -> Result<()> {
    WASMS[0].compile(workspace, kind)
}

/// Compiles a boundary crate, with one feature or with all.
pub(crate) fn compile_one(workspace: &Workspace, kind: Kind, package: &str, feature: Option<&str>) -> Result<()> {
    let profile = format!("--profile={}", profile(kind));
    let words = ["rustc", &profile, "--lib", "--crate-type=cdylib", "--package", package];
    let features = feature.iter().flat_map(|feature| ["--no-default-features", "--features", feature]);
    workspace.run(&mut cargo(workspace, words.into_iter().chain(features)))
}

/// Cargo for wasm. The variable makes it keep what it compiles by features, so that a crate's wasms are linked only after
/// a change: without it, they have one name and replace each other. An internal variable of Cargo, as Rust's own build
/// sets it; a Cargo without it would only take longer.
pub(crate) fn cargo<'a>(workspace: &Workspace, words: impl IntoIterator<Item = &'a str>) -> Command {
    let mut command = workspace.cargo(words.into_iter().chain(["--target", tools::WASM_TARGET]));
    command.env("__CARGO_DEFAULT_LIB_METADATA", "site");
    command
}

/// The profile in which a wasm is compiled.
pub(crate) fn profile(kind: Kind) -> &'static str {
    match kind {
        Kind::Shipped => "wasm",
        Kind::Draft => "draft",
    }
}

/// Where the JavaScript of the compiled crates is written. The page's type check reads the generated types there:
/// `www/tsconfig.worker.json`.
pub(crate) fn generated(workspace: &Workspace) -> PathBuf {
    workspace.root.join("target/wasm-bindgen")
}

/// Generates the JavaScript of the compiled crates, and puts wasms and workers into the folder of the site.
pub(crate) fn write(workspace: &Workspace, kind: Kind, esbuild: &Esbuild, site: &Path) -> Result<()> {
    WASMS.iter().try_for_each(|wasm| wasm.generate(workspace, kind, esbuild, site))
}

/// As [`write()`], the core's boundary alone.
pub(crate) fn write_first(workspace: &Workspace, kind: Kind, esbuild: &Esbuild, site: &Path) -> Result<()> {
    WASMS[0].generate(workspace, kind, esbuild, site)
}
