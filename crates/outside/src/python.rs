//! The Python package, and the tests of the package and of the plugins for books.

use crate::asked::Done;
use crate::{Options, What, output};
use anyhow::{Context, Result};
use fs_err as fs;
use std::env::consts::{DLL_PREFIX, DLL_SUFFIX};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The sources of the package.
const PACKAGE: &str = "crates/lsystem-python";
/// The package in Python.
const NAME: &str = "lsystem_playground";

/// Runs the tests with a Python that has all other libraries.
pub(crate) fn check(options: &Options, python: &Path) -> Result<Vec<Done>> {
    // The package stands in its own folder, away from the sources.
    let folder = options.folder.join("package");
    if folder.is_dir() {
        fs::remove_dir_all(&folder)?;
    }
    match options.what {
        What::Wheel => install(options, python, &folder)?,
        _ => copy(options, &folder)?,
    }
    let mut done: Vec<Done> = vec![];
    for (what, tests) in
        [("Python package", "crates/lsystem-python/tests"), ("fences in books", "crates/outside/books")]
    {
        let mut command = Command::new(python);
        command.args(["-m", "unittest", "discover", "--start-directory"]).arg(options.root.join(tests));
        command.env("PYTHONPATH", &folder).env("PYTHONDONTWRITEBYTECODE", "1");
        let result = output(command.current_dir(&options.folder));
        done.push((what.to_owned(), "unittest", result.map(|_| "its tests pass".to_owned())));
    }
    Ok(done)
}

/// Copies the package with the library that was compiled together with `lsys`: compiling for a wheel begins anew.
fn copy(options: &Options, folder: &Path) -> Result<()> {
    let package = folder.join(NAME);
    fs::create_dir_all(&package)?;
    for entry in fs::read_dir(options.root.join(PACKAGE).join("python").join(NAME))? {
        let path = entry?.path();
        if path.is_file() {
            fs::copy(&path, package.join(path.file_name().unwrap_or_default()))?;
        }
    }
    let library = options.lsys.with_file_name(format!("{DLL_PREFIX}lsystem_python{DLL_SUFFIX}"));
    let ending = if cfg!(windows) { "pyd" } else { "abi3.so" };
    fs::copy(library, package.join(format!("_core.{ending}")))?;
    Ok(())
}

/// Builds the wheel, unoptimised as all tests, and installs it as anybody does.
fn install(options: &Options, python: &Path, folder: &Path) -> Result<()> {
    let wheels: PathBuf = options.folder.join("wheels");
    if wheels.is_dir() {
        fs::remove_dir_all(&wheels)?;
    }
    let mut command = Command::new(python);
    command.args(["-m", "maturin", "build", "--quiet", "--profile", "dev", "--interpreter"]).arg(python);
    command.arg("--out").arg(&wheels).current_dir(options.root.join(PACKAGE));
    output(&mut command).context("building the wheel of the Python package")?;
    let wheel = fs::read_dir(&wheels)?.next().context("maturin made no wheel")??.path();
    let words = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-index", "--no-deps"];
    output(Command::new(python).args(words).arg("--target").arg(folder).arg(wheel))?;
    Ok(())
}
