//! `cargo xtask bench`: speed compared with other implementations and with plain copying, the times of pictures,
//! the page's response times and cost of opening, which rules of pictures are found in which time, and plots beside
//! vpype's.

use crate::workspace::{Workspace, run};
use crate::{bindgen, build, outside, page, tools};
use anyhow::{Result, bail};
use std::ffi::OsStr;
use std::process::Command;

const PARTS: [&str; 9] = ["native", "web", "pictures", "page", "load", "space", "shares", "find", "plot"];
/// The parts that measure the built page, with their scripts.
const PAGE: [(&str, &str); 4] =
    [("page", "drags.mjs"), ("load", "load.mjs"), ("space", "space.mjs"), ("shares", "shares.mjs")];

/// Runs the named parts of the measurements, or all of them.
pub(crate) fn bench<'a>(workspace: &Workspace, words: impl Iterator<Item = &'a str>) -> Result<()> {
    let parts: Vec<_> = words.collect();
    if let Some(word) = parts.iter().find(|word| !PARTS.contains(word)) {
        bail!("there is no part `{word}` of the measurements; the parts are {}", PARTS.join(", "));
    }
    let has = |part| parts.is_empty() || parts.contains(&part);
    if has("native") {
        run(&mut workspace.cargo(["run", "--quiet", "--release", "--package=bench"]))?;
    }
    if has("web") {
        let results = workspace.target.join("bench").join("results.json");
        browser(workspace, results.as_os_str())?;
        run(workspace.cargo(["run", "--quiet", "--release", "--package=bench", "--"]).arg(results))?;
    }
    if has("pictures") {
        browser(workspace, "pictures".as_ref())?;
    }
    if has("find") {
        run(&mut workspace.cargo(["run", "--quiet", "--release", "--package=lsystem-find", "--example=table"]))?;
    }
    if has("plot") {
        outside::bench(workspace)?;
    }
    let mut scripts = PAGE.into_iter().filter(|(part, _)| has(part)).peekable();
    if scripts.peek().is_some() {
        build::build(workspace)?;
    }
    scripts.try_for_each(|(_, script)| page::bench(workspace, script))
}

/// Runs the measurements in headless Chromium.
fn browser(workspace: &Workspace, results: &OsStr) -> Result<()> {
    tools::wasm_target()?;
    let browser = tools::browser()?;
    let folder = workspace.root.join("crates/bench");
    page::packages(&folder)?;
    run(&mut workspace.cargo(["build", "--profile=wasm", "--lib", "--package=bench", "--target", tools::WASM_TARGET]))?;
    let generated = workspace.target.join("bench");
    bindgen::generate(&workspace.target.join(tools::WASM_TARGET).join("wasm/bench.wasm"), &generated, "bench")?;
    let temporary = tempfile::tempdir()?;
    run(Command::new(tools::node()?)
        .arg("web/run.mjs")
        .args([generated.join("bench.js").as_os_str(), generated.join("bench_bg.wasm").as_os_str(), results])
        .current_dir(folder)
        .env("CHROMIUM", browser.chromium)
        .env("TMPDIR", temporary.path()))
}
