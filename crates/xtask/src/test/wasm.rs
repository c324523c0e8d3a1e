//! The tests of the wasm in headless Chromium, as wasm-bindgen runs them. One of them compares digests of drawings, pixels
//! and files with those of a native run just before, which are compiled into it.

use super::native::CRATES;
use super::passed::{Passed, fingerprint};
use crate::report::Report;
use crate::wasms::{self, PACKAGES};
use crate::workspace::Workspace;
use crate::{files, tools};
use anyhow::Result;
use fs_err as fs;
use serde_json::Value;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

pub(super) const TESTS: &str = "wasm tests in the browser";

/// The file of the native digests.
fn digests(workspace: &Workspace) -> PathBuf {
    workspace.target.join("test/same-bits.txt")
}

/// Compiles the tests, with the native digests of the last run if there are any. Returns each program with the folder of
/// its crate.
pub(super) fn build(workspace: &Workspace) -> Result<BTreeSet<(PathBuf, PathBuf)>> {
    tools::wasm_target()?;
    // `--tests` leaves out examples in the documentation, which run natively. The libraries are those of the npm package.
    let words = ["test", "--no-run", "--tests", "--profile=draft", "--message-format=json-render-diagnostics"];
    let packages = PACKAGES.iter().flat_map(|package| ["--package", package]);
    let mut command = wasms::cargo(workspace, words.into_iter().chain([wasms::ONCE]).chain(packages));
    if let Ok(digests) = fs::read_to_string(digests(workspace)) {
        command.env("LSYSTEM_SAME_BITS", digests);
    }
    let messages = workspace.output(&mut command)?;
    let program = |line| {
        let message: Value = serde_json::from_str(line).ok()?;
        let is_test = message["profile"]["test"] == true && message["target"]["kind"][0] == "test";
        let manifest = PathBuf::from(message["manifest_path"].as_str()?);
        is_test.then_some((message["executable"].as_str()?.into(), manifest.parent()?.to_owned()))
    };
    // In a fixed order: Cargo tells them in another one after it has compiled them.
    Ok(BTreeSet::from_iter(messages.lines().filter_map(program)))
}

/// Runs the tests that have not passed as they are.
pub(super) fn run(workspace: &Workspace, passed: &Passed, report: &Report) -> Result<()> {
    let native = ["test", "--test=same_bits"].into_iter().chain(CRATES);
    workspace.run(workspace.cargo(native).env("LSYSTEM_SAME_BITS_FILE", digests(workspace)))?;
    let runner = ["build", "--bin=wasm-test-runner"].into_iter().chain(CRATES);
    workspace.run(&mut workspace.cargo(runner))?;
    let programs = build(workspace)?;
    let print = fingerprint(programs.iter().map(|program| program.0.as_path()))?;
    passed.once(report, TESTS, &print, || {
        let browser = tools::browser()?;
        // The driver leaves megabytes of profiles behind.
        let temporary = tempfile::tempdir()?;
        let own = workspace.root.join("crates/lsystem-wasm/webdriver.json");
        let mut capabilities: Value = serde_json::from_slice(&fs::read(&own)?)?;
        capabilities["goog:chromeOptions"]["binary"] = browser.chromium.to_string_lossy().into();
        let capabilities_file = temporary.path().join("webdriver.json");
        files::write(&capabilities_file, capabilities.to_string())?;
        let runner = workspace.target.join("debug/wasm-test-runner").with_extension(std::env::consts::EXE_EXTENSION);
        programs.iter().try_for_each(|(program, folder)| {
            let start = Instant::now();
            let ran = workspace.run(
                Command::new(&runner)
                    .arg(program)
                    .current_dir(folder)
                    .env("WASM_BINDGEN_TEST_WEBDRIVER_JSON", &capabilities_file)
                    .env("CHROMEDRIVER", &browser.driver)
                    .env("TMPDIR", temporary.path())
                    // The seconds for all tests of a binary, on a slow machine.
                    .env("WASM_BINDGEN_TEST_TIMEOUT", "300"),
            );
            report.time(&program.file_stem().unwrap_or_default().to_string_lossy(), start.elapsed());
            ran
        })
    })
}
