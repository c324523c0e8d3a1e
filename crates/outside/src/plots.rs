//! `cargo xtask bench plot`: plots beside those that vpype makes of the plain SVG.

use crate::{Options, output, programs};
use anyhow::{Context, Result};
use std::process::Command;

/// Curves, islands, plants, many coincident strokes, and pens of several colours.
const SYSTEMS: [&str; 10] = [
    "curves/hilbert",
    "curves/gosper",
    "curves/levy-c",
    "curves/koch-snowflake",
    "curves/penrose",
    "curves/sierpinski-gasket",
    "abop/1.24a",
    "abop/1.24f",
    "practical-1/tree1",
    "focs-lsystems/dragon-curve",
];

/// Prints a table: the ink of each system, what is drawn and travelled, and the times.
pub(crate) fn compare(options: &Options) -> Result<()> {
    let python = programs::python(options)?;
    let vpype = python.parent().context("a folder")?.join(format!("vpype{}", std::env::consts::EXE_SUFFIX));
    let temporary = tempfile::tempdir()?;
    let sources = SYSTEMS.map(|system| options.source(system));
    let mut command = Command::new(&python);
    command.arg(options.scripts().join("plots.py")).arg(&options.lsys).arg(vpype).arg(temporary.path()).args(sources);
    print!("{}", output(&mut command)?);
    Ok(())
}
