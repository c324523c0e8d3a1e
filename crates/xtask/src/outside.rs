//! `cargo xtask outside`, `cargo xtask bench plot`: the crate `outside`, which opens files with programs of other people.

use crate::workspace::Workspace;
use crate::{page, python};
use anyhow::{Context, Result};
use std::path::Path;
use std::process::Command;

/// Runs the program `outside`: `what` is `check`, `wheel` or `plots`. `lsys` makes the files.
pub(crate) fn run(workspace: &Workspace, program: &Path, what: &str, lsys: &Path) -> Result<()> {
    page::packages(&workspace.root.join("crates/outside"))
        .context("installing the glTF validator, which needs the npm registry")?;
    python::prepare(workspace)?;
    let folder = workspace.target.join("outside");
    workspace.run(Command::new(program).arg(what).args([&workspace.root, &folder]).arg(lsys))
}

/// Plots beside those that vpype makes.
pub(crate) fn bench(workspace: &Workspace) -> Result<()> {
    let words = ["build", "--quiet", "--release", "--package=lsystem-cli", "--package=outside"];
    workspace.run(&mut workspace.cargo(words))?;
    let program = |name| workspace.target.join("release").join(name).with_extension(std::env::consts::EXE_EXTENSION);
    run(workspace, &program("outside"), "plots", &program("lsys"))
}
