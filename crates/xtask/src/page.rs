//! The page's checks: types, unit tests in Node.js, end-to-end tests in a browser.

use crate::report::Report;
use crate::server::Server;
use crate::workspace::{Workspace, output};
use crate::{files, tools};
use anyhow::{Result, bail};
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

/// The path of the page in the end-to-end tests. Absolute addresses in the page fail, because the path is not the root.
const MOUNT: &str = "/some/where/";

/// The name of the step [`unit`].
pub(crate) const UNIT: &str = "unit tests of the page";

/// Installs the packages of a folder's lock file into `node_modules`. A copy of the installed lock file shows whether
/// this has been done.
pub(crate) fn packages(folder: &Path) -> Result<()> {
    let lock = files::read(&folder.join("package-lock.json"))?;
    let installed = folder.join("node_modules/.installed-lock.json");
    if installed.is_file() && files::read(&installed)? == lock {
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
    let tests = tests(&www, |path| path.starts_with("unit"))?;
    let cases = cases.map(|cases| ("LSYSTEM_CASES", cases));
    workspace.run(Command::new(tools::node()?).arg("--test").args(tests).current_dir(&www).envs(cases))
}

/// Runs the tests of the built page in a browser.
pub(crate) fn end_to_end(workspace: &Workspace, _report: &Report) -> Result<()> {
    let www = workspace.www();
    let tests = tests(&www, |path| !path.starts_with("unit"))?;
    // Two files at a time: tests spend much time waiting, but more browsers would compete for few cores.
    with_page(workspace, |node| node.args(["--test", "--test-concurrency=2"]).args(tests).current_dir(&www))
}

/// Runs a script that measures the built page.
pub(crate) fn bench(workspace: &Workspace, script: &str) -> Result<()> {
    self::script(workspace, &format!("test/bench/{script}"), &[])
}

/// Runs a script of `www` with the built page.
pub(crate) fn script(workspace: &Workspace, script: &str, words: &[String]) -> Result<()> {
    let www = workspace.www();
    packages(&www)?;
    with_page(workspace, |node| node.arg(script).args(words).current_dir(&www))
}

/// Runs Node.js while the page is served. `prepare` completes the command.
fn with_page(workspace: &Workspace, prepare: impl FnOnce(&mut Command) -> &mut Command) -> Result<()> {
    let browser = tools::browser()?;
    let listener = TcpListener::bind("127.0.0.1:0")?;
    let address = format!("http://{}{MOUNT}", listener.local_addr()?);
    let server = Server { folder: workspace.dist(), mount: MOUNT, version: None };
    // The listener is bound, so the tests need not wait. The thread ends with the process.
    thread::spawn(move || server.run(&listener));
    let temporary = tempfile::tempdir()?;
    workspace.run(
        prepare(&mut Command::new(tools::node()?))
            .env("LSYSTEM_URL", address)
            .env("CHROMIUM", browser.chromium)
            .env("TMPDIR", temporary.path()),
    )
}

/// The test files below `test/` that `wanted` accepts. Finding none is an error, because a moved folder would go
/// unnoticed.
fn tests(www: &Path, wanted: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>> {
    let folder = www.join("test");
    let mut found = files::list(&folder, |path| path.extension().is_none() || wanted(path))?;
    found.retain(|path| path.to_string_lossy().ends_with(".test.mjs") && path.strip_prefix(&folder).is_ok_and(&wanted));
    if found.is_empty() {
        bail!("there are no tests of this kind in {}", folder.display());
    }
    Ok(found)
}

#[cfg(test)]
mod test {
    use super::*;

    #[test]
    fn finds_tests_by_folder() -> Result<()> {
        let www = tempfile::tempdir()?;
        for name in ["unit/a.test.mjs", "unit/help.mjs", "e2e/b.test.mjs", "c.test.mjs", "browser.mjs"] {
            files::write(&www.path().join("test").join(name), "")?;
        }
        let names = |found: Vec<PathBuf>| -> Vec<String> {
            found.iter().map(|path| path.file_name().unwrap().to_string_lossy().into_owned()).collect()
        };
        assert_eq!(names(tests(www.path(), |path| path.starts_with("unit"))?), ["a.test.mjs"]);
        assert_eq!(names(tests(www.path(), |path| !path.starts_with("unit"))?), ["c.test.mjs", "b.test.mjs"]);
        assert!(tests(www.path(), |path| path.starts_with("none")).is_err());
        Ok(())
    }
}
