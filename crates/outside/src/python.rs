//! The Python package: its wheel, installed as anybody does, and the tests of the package and of the plugins for books.

use crate::asked::Asked;
use crate::{Options, output};
use anyhow::{Context, Result};
use fs_err as fs;
use std::path::PathBuf;
use std::process::Command;

pub(crate) fn ask(options: &Options, asked: &mut Asked<'_>) -> Result<()> {
    let python = asked.programs.python();
    let wheel = wheel(options, asked)?;
    let words = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-index", "--no-deps"];
    output(Command::new(python).args(words).arg("--force-reinstall").arg(wheel))?;
    for (what, tests) in
        [("Python package", "crates/lsystem-python/tests"), ("fences in books", "crates/outside/books")]
    {
        let mut command = Command::new(python);
        // Away from the sources, so that the installed package is tested.
        command.args(["-m", "unittest", "discover", "--start-directory"]).arg(options.root.join(tests));
        let result = output(command.current_dir(&options.folder).env("PYTHONDONTWRITEBYTECODE", "1"));
        asked.note(what, "unittest", result.map(|_| "its tests pass".to_owned()));
    }
    Ok(())
}

/// Builds the wheel, unoptimised as all tests.
fn wheel(options: &Options, asked: &Asked<'_>) -> Result<PathBuf> {
    let folder = options.folder.join("wheels");
    if folder.is_dir() {
        fs::remove_dir_all(&folder)?;
    }
    let python = asked.programs.python();
    let mut command = Command::new(python);
    command.args(["-m", "maturin", "build", "--quiet", "--profile", "dev", "--interpreter"]).arg(python);
    command.arg("--out").arg(&folder).current_dir(options.root.join("crates/lsystem-python"));
    output(&mut command).context("building the wheel of the Python package")?;
    Ok(fs::read_dir(&folder)?.next().context("maturin made no wheel")??.path())
}
