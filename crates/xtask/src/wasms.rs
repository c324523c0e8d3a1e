//! The wasms of the site: each has a crate, generated JavaScript, and a worker that runs it.

use crate::esbuild::Esbuild;
use crate::workspace::{Kind, Workspace};
use crate::{bindgen, files, split, tools};
use anyhow::Result;
use fs_err as fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A wasm of the site: `NAME.wasm`.
pub(crate) struct Wasm {
    /// The crate with its boundary.
    pub(crate) package: &'static str,
    /// The name of its files on the site and of its generated files.
    pub(crate) name: &'static str,
    /// The name of its worker's script on the site.
    pub(crate) script: &'static str,
    /// The worker's first module, in `www`.
    worker: &'static str,
}

/// All wasms: the core, and the tools that few visits need.
pub(crate) const WASMS: [Wasm; 2] = [
    Wasm { package: "lsystem-wasm", name: "lsystem", script: "worker.js", worker: "worker/worker.js" },
    Wasm { package: "lsystem-tools-wasm", name: "tools", script: "tools.js", worker: "worker/tools.js" },
];

/// The tools.
pub(crate) const TOOLS: &Wasm = &WASMS[1];

/// Wasms of some tools, for pages in single files, and their workers.
pub(crate) const ALONE: [&str; 2] = ["course", "film"];

/// The boundary crates.
pub(crate) const PACKAGES: [&str; 2] = [WASMS[0].package, WASMS[1].package];

impl Wasm {
    /// The name of the wasm on the site.
    pub(crate) fn file(&self) -> String {
        format!("{}.wasm", self.name)
    }

    /// The worker as one classic script, which works in sandboxed frames and from files. Module workers and imports
    /// fail there.
    fn write(&self, esbuild: &Esbuild, generated: &Path, site: &Path) -> Result<()> {
        fs::copy(generated.join(format!("{}_bg.wasm", self.name)), site.join(self.file()))?;
        self.write_script(esbuild, generated, &site.join(self.script), self.worker)
    }

    fn write_script(&self, esbuild: &Esbuild, generated: &Path, file: &Path, worker: &str) -> Result<()> {
        let glue = fs::read_to_string(generated.join(format!("{}.js", self.name)))?;
        files::write(file, esbuild.minified("glue.js", &glue)? + &esbuild.script(worker)?)
    }

    /// The wasm as the linker has written it.
    pub(crate) fn linked(&self, workspace: &Workspace, kind: Kind) -> PathBuf {
        let [_, kept] = self.compiled(workspace, kind);
        kept
    }

    fn compile(&self, workspace: &Workspace, kind: Kind) -> Result<()> {
        tools::wasm_target()?;
        // What is shipped is split by what the linker tells.
        let told: &[&str] = if kind == Kind::Shipped { &["--", "-C", split::EMIT] } else { &[] };
        compile_one(workspace, kind, self.package, told)?;
        let [written, kept] = self.compiled(workspace, kind);
        fs::copy(written, kept)?;
        Ok(())
    }

    /// Generates its JavaScript, and puts the wasm and its worker into the folder of the site.
    fn generate(&self, workspace: &Workspace, kind: Kind, esbuild: &Esbuild, site: &Path) -> Result<()> {
        let generated = generated(workspace);
        let (file, has_names) = (self.linked(workspace, kind), kind == Kind::Shipped);
        // Reading a wasm and writing it anew takes a second, so it is done only after a change.
        let made_of = generated.join(format!("{}.made-of", self.name));
        files::once(&[&file], &made_of, || bindgen::generate(&file, &generated, self.name, has_names))?;
        self.write(esbuild, &generated, site)
    }

    /// Where Cargo puts the compiled crate, and where it is kept, because tests are compiled to there, too.
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

/// For Cargo: compile a draft that nobody works on, which takes a tenth less than one whose parts are kept.
pub(crate) const ONCE: &str = "--config=profile.draft.incremental=false";

/// Compiles a boundary crate. `more` are arguments of Cargo.
pub(crate) fn compile_one(workspace: &Workspace, kind: Kind, package: &str, more: &[&str]) -> Result<()> {
    let profile = format!("--profile={}", profile(kind));
    let words = ["rustc", &profile, "--lib", "--crate-type=cdylib", "--package", package];
    workspace.run(cargo(workspace, words).args(more))
}

/// Cargo for wasm. The variable makes it keep what it compiles by features, so that a crate's wasms are linked only after
/// a change: without it, they have one name and replace each other. An internal variable of Cargo, as Rust's own build
/// sets it; a Cargo without it would only take longer.
pub(crate) fn cargo<'a>(workspace: &Workspace, words: impl IntoIterator<Item = &'a str>) -> Command {
    let mut command = workspace.cargo(words.into_iter().chain(["--target", tools::WASM_TARGET]));
    command.env("__CARGO_DEFAULT_LIB_METADATA", "site").env_remove("RUSTC_WORKSPACE_WRAPPER");
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

/// Generates the JavaScript of the compiled crates, and puts wasms and workers into the folder of the site. For pages
/// like `simple.html`, which start the core themselves, `core.js` has its JavaScript alone.
pub(crate) fn write(workspace: &Workspace, kind: Kind, esbuild: &Esbuild, site: &Path) -> Result<()> {
    WASMS.iter().try_for_each(|wasm| wasm.generate(workspace, kind, esbuild, site))?;
    let generated = generated(workspace);
    let glue = fs::read_to_string(generated.join("lsystem.js"))?;
    files::write(&site.join("core.js"), esbuild.minified("glue.js", &glue)?)?;
    ALONE.iter().try_for_each(|tool| {
        let (script, worker) = (site.join(format!("{tool}.js")), format!("worker/{tool}.js"));
        TOOLS.write_script(esbuild, &generated, &script, &worker)
    })
}

/// As [`write()`], the core's boundary alone.
pub(crate) fn write_first(workspace: &Workspace, kind: Kind, esbuild: &Esbuild, site: &Path) -> Result<()> {
    WASMS[0].generate(workspace, kind, esbuild, site)
}
