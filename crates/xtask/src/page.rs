//! The page's checks: types, unit tests in Node.js, end-to-end tests in a browser.

use crate::report::Report;
use crate::server::{Builds, Server};
use crate::workspace::{Kind, Workspace, output};
use crate::{files, tools};
use anyhow::{Context, Result, bail};
use fs_err as fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;
use std::time::Duration;

/// The path of the page in the end-to-end tests. Absolute addresses in the page fail, because the path is not the root.
const MOUNT: &str = "/some/where/";

/// The name of the step that runs [`unit()`].
pub(crate) const UNIT: &str = "unit tests of the page";

/// Installs the packages of a folder's lock file into `node_modules`. A copy of the installed lock file shows whether
/// this has been done.
pub(crate) fn packages(folder: &Path) -> Result<()> {
    let lock = fs::read(folder.join("package-lock.json"))?;
    let installed = folder.join("node_modules/.installed-lock.json");
    if installed.is_file() && fs::read(&installed)? == lock {
        return Ok(());
    }
    output(Command::new(tools::npm()?).arg("ci").current_dir(folder))?;
    files::write(&installed, lock)
}

/// Checks the types of the page and of the worker. The types of the boundary must have been generated.
pub(crate) fn types(workspace: &Workspace) -> Result<()> {
    let www = workspace.www();
    packages(&www)?;
    let compiler = "node_modules/typescript/bin/tsc";
    let check =
        |project| workspace.run(Command::new(tools::node()?).args([compiler, "--project", project]).current_dir(&www));
    check("tsconfig.json")?;
    check("tsconfig.worker.json")
}

/// Runs the tests of single modules. `cases` is the number of random states; `None` for the default.
pub(crate) fn unit(workspace: &Workspace, cases: Option<&str>) -> Result<()> {
    let www = workspace.www();
    packages(&www)?;
    let tests = unit_tests(&www)?;
    let cases = cases.map(|cases| ("LSYSTEM_CASES", cases));
    workspace.run(Command::new(tools::node()?).arg("--test").args(tests).current_dir(&www).envs(cases))
}

/// Runs tests of a built page in a browser: these files of `test/e2e`, or all if none is named; `--thorough` before them
/// tries all variants.
pub(crate) fn end_to_end(workspace: &Workspace, kind: Kind, names: &[&str], report: &Report) -> Result<()> {
    let times = tempfile::NamedTempFile::new()?;
    let result = with_page(workspace, kind, |node| {
        node.arg("test/e2e/run.mjs").args(names).current_dir(workspace.www()).env("LSYSTEM_TIMES", times.path())
    });
    for line in fs::read_to_string(times.path())?.lines() {
        let (seconds, name) = line.split_once(' ').context("a time without a test")?;
        report.time(name, Duration::try_from_secs_f64(seconds.parse()?)?);
    }
    result
}

/// Runs the tests of the page's core in Firefox.
pub(crate) fn firefox(workspace: &Workspace, firefox: &Path) -> Result<()> {
    with_page(workspace, Kind::Shipped, |node| {
        node.args(["--test", "test/firefox/core.test.mjs"]).current_dir(workspace.www()).env("FIREFOX", firefox)
    })
}

/// Runs a script of `www` that measures the page as it is shipped.
pub(crate) fn bench(workspace: &Workspace, script: &str) -> Result<()> {
    self::script(workspace, &format!("test/bench/{script}"), &[])
}

/// Runs a script of `www` with the page as it is shipped.
pub(crate) fn script(workspace: &Workspace, script: &str, words: &[String]) -> Result<()> {
    let www = workspace.www();
    packages(&www)?;
    with_page(workspace, Kind::Shipped, |node| node.arg(script).args(words).current_dir(&www))
}

/// Runs Node.js while a built page is served. `prepare` completes the command.
fn with_page(workspace: &Workspace, kind: Kind, prepare: impl FnOnce(&mut Command) -> &mut Command) -> Result<()> {
    let browser = tools::browser()?;
    // All crates are named, so that the same features are chosen as for the native tests.
    workspace.run(&mut workspace.cargo(["build", "--quiet", "--workspace", "--exclude=bench", "--bin=lsys"]))?;
    let program = workspace.target.join("debug/lsys").with_extension(std::env::consts::EXE_EXTENSION);
    let listener = TcpListener::bind("127.0.0.1:0")?;
    let address = format!("http://{}{MOUNT}", listener.local_addr()?);
    let server = Server { folder: kind.folder(workspace), mount: MOUNT, builds: Builds::done(), reloads: false };
    // The listener is bound, so the tests need not wait. The thread ends with the process.
    thread::spawn(move || server.run(&listener));
    let temporary = tempfile::tempdir()?;
    workspace.run(
        prepare(&mut Command::new(tools::node()?))
            .env("LSYSTEM_URL", address)
            .env("LSYS", program)
            .env("CHROMIUM", browser.chromium)
            .env("TMPDIR", temporary.path()),
    )
}

/// The tests of single modules. Finding none is an error, because a moved folder would go unnoticed.
fn unit_tests(www: &Path) -> Result<Vec<PathBuf>> {
    let mut found = files::list(&www.join("test/unit"), |_| true)?;
    found.retain(|path| path.to_string_lossy().ends_with(".test.mjs"));
    if found.is_empty() {
        bail!("there are no tests in {}/test/unit", www.display());
    }
    Ok(found)
}

#[cfg(test)]
mod test {
    use super::*;

    #[test]
    fn finds_tests() -> Result<()> {
        let www = tempfile::tempdir()?;
        assert!(unit_tests(www.path()).is_err());
        for name in ["unit/a.test.mjs", "unit/help.mjs", "e2e/b.test.mjs"] {
            files::write(&www.path().join("test").join(name), "")?;
        }
        assert_eq!(unit_tests(www.path())?, [www.path().join("test/unit/a.test.mjs")]);
        Ok(())
    }
}
