//! `cargo xtask test`: all checks before a merge.

use crate::report::StepReport;
use crate::workspace::{Workspace, run};
use crate::{build, files, fuzz, lint, monkey, outside, package, page, size, tools};
use anyhow::{Result, bail};
use serde_json::Value;

/// The parts of the test, in order.
const PARTS: [&str; 7] = ["lint", "native", "outside", "fuzz", "wasm", "size", "page"];

/// The parts to run, and whether to run them thoroughly.
pub(crate) struct TestOptions {
    /// Whether the property tests try 10,000 new random systems instead of the same 500 every time.
    thorough: bool,
    parts: Vec<&'static str>,
}

impl TestOptions {
    pub(crate) fn read<'a>(words: impl Iterator<Item = &'a str>) -> Result<Self> {
        let mut options = Self { thorough: false, parts: vec![] };
        for word in words {
            match PARTS.iter().find(|part| **part == word) {
                Some(part) => options.parts.push(part),
                None if word == "--thorough" => options.thorough = true,
                None => bail!("there is no part `{word}` of the test; the parts are {}", PARTS.join(", ")),
            }
        }
        if options.parts.is_empty() {
            options.parts = PARTS.to_vec();
        }
        Ok(options)
    }

    /// The number of random cases in the property tests; `None` for the default.
    fn cases(&self) -> Option<&'static str> {
        self.thorough.then_some("10000")
    }
}

pub(crate) fn test(workspace: &Workspace, options: &TestOptions) -> Result<()> {
    let has = |part| options.parts.contains(&part);
    let mut report = StepReport::default();
    if has("lint") {
        lint::steps(workspace, &mut report);
    }
    if has("native") {
        report.step("native tests", || {
            // The crates for development have their own steps.
            let others = ["--exclude=xtask", "--exclude=bench", "--exclude=lsystem-fuzz"];
            let mut test = workspace.cargo(["test", "--no-fail-fast", "--workspace"].into_iter().chain(others));
            match options.cases() {
                Some(cases) => test.env("LSYSTEM_CASES", cases),
                // The same random systems every time, so that a change is the only difference.
                None => test.env("PROPTEST_RNG_SEED", "1"),
            };
            run(&mut test)
        });
        // A separate step: together with the others, Cargo would choose other features for shared libraries and compile
        // them twice.
        report.step("native tests of xtask", || run(&mut workspace.cargo(["test", "--package=xtask"])));
    }
    if has("outside") {
        report.step("files opened with other programs", || outside::check(workspace));
    }
    if has("fuzz") {
        report.step("native tests of the fuzz targets", || {
            run(&mut workspace.cargo(["test", "--package=lsystem-fuzz", "--lib"]))
        });
        report.step("fuzzing, always the same inputs", || fuzz::short(workspace));
    }
    if has("wasm") {
        report.step("wasm tests in the browser", || wasm(workspace));
    }
    if (has("size") || has("page")) && report.step("build", || build::build(workspace)) {
        if has("size") {
            report.step("size of the wasm", || size::check(workspace));
        }
        if has("page") {
            report.step("npm package", || package::npm(workspace));
            page::steps(workspace, options.cases(), &mut report);
            if options.thorough {
                report.step("a minute of the monkey", || monkey::run(workspace, &monkey::MonkeyOptions::one_minute()));
            }
        }
    }
    report.finish()
}

fn wasm(workspace: &Workspace) -> Result<()> {
    tools::wasm_target()?;
    let browser = tools::browser()?;
    // The driver leaves megabytes of profiles behind.
    let temporary = tempfile::tempdir()?;
    let crate_folder = workspace.root.join("crates/lsystem-wasm");
    let mut capabilities: Value = serde_json::from_slice(&files::read(&crate_folder.join("webdriver.json"))?)?;
    capabilities["goog:chromeOptions"]["binary"] = browser.chromium.to_string_lossy().into();
    let capabilities_file = temporary.path().join("webdriver.json");
    files::write(&capabilities_file, capabilities.to_string())?;
    // `--tests` leaves out examples in the documentation, which run natively.
    run(workspace
        .cargo([
            "test",
            "--no-fail-fast",
            "--tests",
            "--package=lsystem-wasm",
            "--package=lsystem-export-wasm",
            "--target",
            tools::WASM_TARGET,
        ])
        // With debug information, the runner needs half a minute to read a binary.
        .env("CARGO_PROFILE_DEV_DEBUG", "0")
        .env("WASM_BINDGEN_TEST_WEBDRIVER_JSON", capabilities_file)
        .env("CHROMEDRIVER", browser.driver)
        .env("TMPDIR", temporary.path())
        // The seconds for all tests of a binary, on a slow machine.
        .env("WASM_BINDGEN_TEST_TIMEOUT", "300"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options() {
        let all = TestOptions::read([].into_iter()).unwrap();
        assert_eq!((all.thorough, all.parts), (false, PARTS.to_vec()));
        let some = TestOptions::read(["page", "--thorough", "native"].into_iter()).unwrap();
        assert_eq!((some.thorough, some.parts), (true, vec!["page", "native"]));
        assert!(TestOptions::read(["pages"].into_iter()).is_err());
    }
}
