//! `cargo xtask bench`: speed compared with other implementations and with plain copying, the times of pictures,
//! the page's response times and cost of opening, which rules of pictures are found in which time, and plots beside
//! those of vpype.

use crate::workspace::{Kind, Workspace};
use crate::{bindgen, build, outside, page, tools};
use anyhow::Result;
use clap::ValueEnum;
use std::ffi::OsStr;
use std::process::Command;

/// A part of the measurements.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Part {
    /// Beside other implementations, natively.
    Native,
    /// Beside other implementations, in the browser.
    Web,
    /// The times of pictures.
    Pictures,
    /// How fast the page responds.
    Page,
    /// The cost of opening the page and ten embedded drawings.
    Load,
    /// Pictures in space, moving and at rest.
    Space,
    /// Pictures that several workers share.
    Shares,
    /// Rules of pictures: how many are found, and when.
    Find,
    /// Ink, travel and time of plots, beside vpype's linemerge and linesort, and hidden lines beside its plug-in occult.
    Plot,
}

/// The parts that measure the built page, with their scripts.
const PAGE: [(Part, &str); 4] =
    [(Part::Page, "drags.mjs"), (Part::Load, "load.mjs"), (Part::Space, "space.mjs"), (Part::Shares, "shares.mjs")];

/// Runs the named parts of the measurements, or all of them.
pub(crate) fn bench(workspace: &Workspace, parts: &[Part]) -> Result<()> {
    let has = |part| parts.is_empty() || parts.contains(&part);
    if has(Part::Native) {
        workspace.run(&mut workspace.cargo(["run", "--quiet", "--release", "--package=bench"]))?;
    }
    if has(Part::Web) {
        let results = workspace.target.join("bench").join("results.json");
        browser(workspace, results.as_os_str())?;
        workspace.run(workspace.cargo(["run", "--quiet", "--release", "--package=bench", "--"]).arg(results))?;
    }
    if has(Part::Pictures) {
        browser(workspace, "pictures".as_ref())?;
    }
    if has(Part::Find) {
        let table = ["run", "--quiet", "--release", "--package=lsystem-find", "--example=table"];
        workspace.run(&mut workspace.cargo(table))?;
    }
    if has(Part::Plot) {
        outside::bench(workspace)?;
    }
    let mut scripts = PAGE.into_iter().filter(|(part, _)| has(*part)).peekable();
    if scripts.peek().is_some() {
        build::build(workspace, Kind::Shipped, None)?;
    }
    scripts.try_for_each(|(_, script)| page::bench(workspace, script))
}

/// Runs the measurements in headless Chromium.
fn browser(workspace: &Workspace, results: &OsStr) -> Result<()> {
    tools::wasm_target()?;
    let browser = tools::browser()?;
    let folder = workspace.root.join("crates/bench");
    page::packages(&folder)?;
    let words = ["build", "--profile=wasm", "--lib", "--package=bench", "--target", tools::WASM_TARGET];
    workspace.run(&mut workspace.cargo(words))?;
    let generated = workspace.target.join("bench");
    bindgen::generate(&workspace.target.join(tools::WASM_TARGET).join("wasm/bench.wasm"), &generated, "bench", false)?;
    let temporary = tempfile::tempdir()?;
    let mut command = Command::new(tools::node()?);
    command.arg("web/run.mjs").args(["bench.js", "bench_bg.wasm"].map(|name| generated.join(name))).arg(results);
    command.env("CHROMIUM", browser.chromium).env("TMPDIR", temporary.path());
    workspace.run(command.current_dir(folder))
}
