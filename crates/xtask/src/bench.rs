//! `cargo xtask bench`: speed beside other implementations and beside plain copying.

use crate::workspace::{Workspace, run};
use crate::{bindgen, page, tools};
use anyhow::{Result, bail};
use std::process::Command;

/// Measures natively, in the browser, or both.
pub(crate) fn bench<'a>(workspace: &Workspace, words: impl Iterator<Item = &'a str>) -> Result<()> {
    let parts: Vec<_> = words.collect();
    if let Some(word) = parts.iter().find(|word| !["native", "web"].contains(word)) {
        bail!("there is no part `{word}` of the measurements; there are native, web");
    }
    let has = |part| parts.is_empty() || parts.contains(&part);
    if has("native") {
        run(&mut workspace.cargo(["run", "--quiet", "--release", "--package=bench"]))?;
    }
    if has("web") {
        web(workspace)?;
    }
    Ok(())
}

fn web(workspace: &Workspace) -> Result<()> {
    tools::wasm_target()?;
    let browser = tools::browser()?;
    let folder = workspace.root.join("crates/bench");
    page::packages(&folder)?;
    run(&mut workspace.cargo(["build", "--release", "--lib", "--package=bench", "--target", tools::WASM_TARGET]))?;
    let generated = workspace.target.join("bench");
    bindgen::generate(&workspace.target.join(tools::WASM_TARGET).join("release/bench.wasm"), &generated, "bench")?;
    let temporary = tempfile::tempdir()?;
    let results = generated.join("results.json");
    run(Command::new(tools::node()?)
        .arg("web/run.mjs")
        .args([generated.join("bench.js"), generated.join("bench_bg.wasm"), results.clone()])
        .current_dir(folder)
        .env("CHROMIUM", browser.chromium)
        .env("TMPDIR", temporary.path()))?;
    run(workspace.cargo(["run", "--quiet", "--release", "--package=bench", "--"]).arg(results))
}
