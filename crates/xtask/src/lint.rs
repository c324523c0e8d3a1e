//! Formatting, clippy, documentation, biome for scripts and styles, and actionlint for workflows: warnings are errors.

use crate::report::Report;
use crate::test::CRATES;
use crate::workspace::Workspace;
use crate::{files, page, tools};
use anyhow::{Result, ensure};
use std::process::Command;

/// All that `cargo xtask lint` looks at.
pub(crate) fn lint(workspace: &Workspace) -> Result<()> {
    let report = Report::new(workspace, "lint");
    formatting(workspace, &report);
    scripts(workspace, &report);
    workflows(workspace, &report);
    native(workspace, &report, true);
    report.step(workspace, "clippy for the measurements", |workspace, _| clippy(workspace, &["--package=bench"]));
    report.finish()
}

pub(crate) fn formatting(workspace: &Workspace, report: &Report) -> bool {
    report
        .step(workspace, "formatting", |workspace, _| workspace.run(&mut workspace.cargo(["fmt", "--all", "--check"])))
}

/// Formatting and rules of scripts and styles (`biome.jsonc`). To format them:
/// `www/node_modules/.bin/biome format --write`.
pub(crate) fn scripts(workspace: &Workspace, report: &Report) {
    report.step(workspace, "scripts and styles", |workspace, _| {
        page::packages(&workspace.www())?;
        let biome = workspace.www().join("node_modules/@biomejs/biome/bin/biome");
        let words = ["ci", "--error-on-warnings", "--colors=off"];
        workspace.run(Command::new(tools::node()?).arg(biome).args(words).current_dir(&workspace.root))
    });
}

/// The workflows of GitHub, by actionlint.
pub(crate) fn workflows(workspace: &Workspace, report: &Report) {
    report.step(workspace, "workflows", |workspace, _| {
        let folder = workspace.root.join("crates/xtask/workflows");
        page::packages(&folder)?;
        let flows = files::list(&workspace.root.join(".github/workflows"), |_| true)?;
        ensure!(!flows.is_empty(), "there are no workflows");
        workspace.run(Command::new(tools::node()?).arg(folder.join("lint.mjs")).args(flows))
    });
}

/// Clippy, unless it looks at what is compiled for the tests, and where all shall be seen the documentation of all crates.
/// Examples in the documentation are tested elsewhere.
pub(crate) fn native(workspace: &Workspace, report: &Report, is_all: bool) {
    // Without the measurements: the libraries beside which they measure take as long as ours.
    if !workspace.lints {
        report.step(workspace, "clippy", |workspace, _| clippy(workspace, &CRATES));
    }
    if is_all {
        report.step(workspace, "documentation", |workspace, _| {
            workspace.run(workspace.cargo(["doc", "--no-deps"]).args(CRATES).env("RUSTDOCFLAGS", "-D warnings"))
        });
    }
}

/// Clippy for the crates that these words choose.
pub(crate) fn clippy(workspace: &Workspace, which: &[&str]) -> Result<()> {
    workspace.run(workspace.cargo(["clippy", "--all-targets"]).args(which).args(["--", "-D", "warnings"]))
}
