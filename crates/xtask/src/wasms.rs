//! The wasms of the site: each has a crate, generated JavaScript, and a worker that runs it.

use crate::build::Kind;
use crate::esbuild::Esbuild;
use crate::workspace::Workspace;
use crate::{bindgen, files, tools};
use anyhow::Result;
use std::fs;
use std::path::{Path, PathBuf};

/// A wasm of the site.
pub(crate) struct Wasm {
    /// The crate with its boundary.
    pub(crate) package: &'static str,
    /// The name of the wasm on the site.
    pub(crate) file: &'static str,
    /// The name of its worker's script on the site.
    pub(crate) script: &'static str,
    /// The worker's first module, in `www`.
    worker: &'static str,
}

/// All wasms: the core, and the tools that few visits need.
pub(crate) const WASMS: [Wasm; 6] = [
    Wasm { package: "lsystem-wasm", file: "lsystem.wasm", script: "worker.js", worker: "worker/worker.js" },
    Wasm { package: "lsystem-import-wasm", file: "import.wasm", script: "import.js", worker: "worker/import.js" },
    Wasm { package: "lsystem-course-wasm", file: "course.wasm", script: "course.js", worker: "worker/course.js" },
    Wasm { package: "lsystem-find-wasm", file: "find.wasm", script: "find.js", worker: "worker/find.js" },
    Wasm { package: "lsystem-export-wasm", file: "export.wasm", script: "export.js", worker: "worker/export.js" },
    Wasm { package: "lsystem-film-wasm", file: "film.wasm", script: "film.js", worker: "worker/film.js" },
];

impl Wasm {
    /// The name of the crate's library and of its generated files.
    fn library(&self) -> String {
        self.package.replace('-', "_")
    }

    /// The worker as one classic script, which works in sandboxed frames and from files. Module workers and imports
    /// fail there.
    fn write(&self, esbuild: &Esbuild, generated: &Path, site: &Path) -> Result<()> {
        let library = self.library();
        fs::copy(generated.join(format!("{library}_bg.wasm")), site.join(self.file))?;
        let glue = files::read_text(&generated.join(format!("{library}.js")))?;
        files::write(&site.join(self.script), esbuild.minified("glue.js", &glue)? + &esbuild.script(self.worker)?)
    }
}

/// Compiles the boundary crates.
pub(crate) fn compile(workspace: &Workspace, kind: Kind) -> Result<()> {
    tools::wasm_target()?;
    let profile = format!("--profile={}", profile(kind));
    let packages = WASMS.iter().flat_map(|wasm| ["--package", wasm.package]);
    let words = ["build", &profile, "--lib", "--target", tools::WASM_TARGET].into_iter().chain(packages);
    workspace.run(&mut workspace.cargo(words))
}

fn profile(kind: Kind) -> &'static str {
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
    let generated = generated(workspace);
    let compiled = workspace.target.join(tools::WASM_TARGET).join(profile(kind));
    WASMS.iter().try_for_each(|wasm| {
        let library = wasm.library();
        let file = compiled.join(format!("{library}.wasm"));
        // Reading a wasm and writing it anew takes a second, so it is done only after a change.
        let made_of = generated.join(format!("{library}.made-of"));
        files::once(&file, &made_of, || bindgen::generate(&file, &generated, &library))?;
        wasm.write(esbuild, &generated, site)
    })
}
