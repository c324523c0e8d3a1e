//! `cargo xtask monkey`: random actions on the page and on embedded drawings, in a real browser.

use crate::workspace::{Kind, Workspace};
use crate::{build, page};
use anyhow::Result;

/// Arguments for the short run of the thorough tests, always with the same seed.
pub(crate) const ONE_MINUTE: [&str; 2] = ["--minutes=1", "--seed=1"];

/// Builds the page and runs the monkey on it.
pub(crate) fn monkey(workspace: &Workspace, words: &[String]) -> Result<()> {
    build::build(workspace, Kind::Shipped, None)?;
    run(workspace, words)
}

/// Runs the monkey on the built page.
pub(crate) fn run(workspace: &Workspace, words: &[String]) -> Result<()> {
    page::script(workspace, "test/monkey/monkey.mjs", words)
}
