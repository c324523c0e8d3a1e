//! `cargo xtask test quick`: what the last change can break, in a minute or so.
//!
//! A crate has changed if its files differ from those of the last quick test that passed. Clippy looks at the changed
//! crates. Cargo compiles what depends on them, and the tests of all that was compiled anew run, but for those that took
//! long when they last ran. If the page has changed, its types and its unit tests are checked, and a draft of it is
//! opened in the browser.

use super::native;
use super::passed::{Passed, fingerprint};
use crate::report::Report;
use crate::workspace::{Kind, Workspace};
use crate::{build, lint, page, wasms};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// The end-to-end tests that run in the quick test.
const PAGES: [&str; 1] = ["first.test.mjs"];

/// Where the fingerprint of a crate is kept.
fn name_of(package: &str) -> String {
    format!("quick {package}")
}

pub(super) fn run(workspace: &Workspace, passed: &Passed, report: &Report) -> Result<()> {
    let changed = changed(workspace, passed)?;
    let mut is_right = lint::formatting(workspace, report);
    if changed.is_empty() {
        report.skip("native tests: no crate has changed since they passed".to_owned());
    } else {
        let packages: Vec<&str> = changed.iter().flat_map(|(package, _)| ["--package", package.as_str()]).collect();
        is_right &= report.step(workspace, "compiling natively, and native tests", |workspace, bar| {
            let built = native::build(workspace)?;
            native::run(workspace, &built, passed, None, true, (report, bar))
        });
        is_right &= report.step(workspace, "clippy for what has changed", |w, _| lint::clippy(w, &packages));
    }
    let reads = ["www/js", "www/worker", "www/test/unit", "www/index.html", "www/package.json", "data_in"];
    let reads = reads.map(|name| workspace.root.join(name));
    let print = fingerprint(reads.iter().map(PathBuf::as_path))?;
    report.step(workspace, "types of the page", |workspace, _| {
        // The types of the boundary are made by the build.
        let print = format!(
            "{print}{}",
            fingerprint([wasms::generated(workspace).as_path()].into_iter().filter(|path| path.exists()))?
        );
        passed.once(report, "quick types of the page", &print, || page::types(workspace))
    });
    report.step(workspace, page::UNIT, |workspace, _| {
        passed.once(report, "quick units of the page", &print, || page::unit(workspace, None))
    });
    report.step(workspace, "the page opens and draws", |workspace, _| {
        let print = fingerprint([workspace.www().as_path()])?;
        passed.once(report, "quick pages", &print, || {
            build::build(workspace, Kind::Draft, None)?;
            page::end_to_end(workspace, Kind::Draft, &PAGES, report)
        })
    });
    if is_right {
        changed.iter().try_for_each(|(package, print)| passed.note(&name_of(package), print, 0.0))?;
    }
    Ok(())
}

/// The crates whose files differ from those that passed, with their fingerprints.
fn changed(workspace: &Workspace, passed: &Passed) -> Result<Vec<(String, String)>> {
    let metadata = workspace.metadata()?;
    let packages = metadata["packages"].as_array().context("cargo names no crates")?;
    let mut changed = vec![];
    for package in packages {
        let name = package["name"].as_str().context("a crate without a name")?;
        let manifest = Path::new(package["manifest_path"].as_str().context("a crate without a manifest")?);
        let print = fingerprint([manifest.parent().context("a manifest without a folder")?])?;
        if passed.print(&name_of(name)).as_ref() != Some(&print) {
            changed.push((name.to_owned(), print));
        }
    }
    Ok(changed)
}
