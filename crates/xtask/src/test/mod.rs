//! `cargo xtask test`: all checks before a merge, or the quick ones while working.
//!
//! Two lanes run side by side: the native one compiles, checks and tests natively; the other one builds the page, and
//! tests it and the wasm in the browser.

mod native;
mod passed;
mod quick;
mod wasm;

use crate::report::Report;
use crate::workspace::{Kind, Workspace};
use crate::{build, fuzz, ledger, lint, monkey, outside, package, page, tools};
use anyhow::{Context, Result};
use clap::ValueEnum;
use native::Built;
pub(crate) use native::CRATES;
use passed::{Passed, fingerprint};
use std::path::PathBuf;
use std::thread;

const FIREFOX: &str = "core of the page in Firefox";

/// A part of the test.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Part {
    /// What a change of one crate or of the page can break, without what takes long.
    Quick,
    /// Formatting and clippy, where thorough also documentation; warnings are errors.
    Lint,
    /// The tests of all crates.
    Native,
    /// Files opened with programs of other people.
    Outside,
    /// Random inputs, always the same ones.
    Fuzz,
    /// The wasm in the browser.
    Wasm,
    /// Bytes, lines, packages and processor seconds beside their limits.
    Ledger,
    /// The built page.
    Page,
}

/// The parts to run, and how.
#[derive(clap::Args)]
pub(crate) struct TestOptions {
    /// The parts to run; all but `quick` if none is named
    parts: Vec<Part>,
    /// Run what passed as it is, too; always so in continuous integration
    #[arg(long)]
    all: bool,
    /// All variants and samples of tests, 10,000 new random systems in property tests, documentation, a
    /// minute of the monkey
    #[arg(long)]
    thorough: bool,
}

impl TestOptions {
    /// Only this part.
    pub(crate) fn only(part: Part) -> Self {
        Self { parts: vec![part], all: false, thorough: false }
    }

    fn has(&self, part: Part) -> bool {
        if self.parts.is_empty() { part != Part::Quick } else { self.parts.contains(&part) }
    }

    /// The number of random cases in the property tests; `None` for the default.
    fn cases(&self) -> Option<&'static str> {
        self.thorough.then_some("10000")
    }
}

pub(crate) fn test(workspace: &Workspace, options: &TestOptions) -> Result<()> {
    let all = options.all || options.thorough || std::env::var_os("CI").is_some();
    let passed = Passed::read(workspace.target.join("test/passed.txt"), all);
    let report = Report::new(workspace, "test").patient(options.thorough);
    if options.has(Part::Quick) {
        quick::run(workspace, &passed, &report)?;
        return report.finish();
    }
    // What is compiled for the tests is compiled once, with the lints.
    let mut workspace = workspace.clone();
    workspace.lints = options.has(Part::Lint) && options.has(Part::Native);
    let workspace = &workspace;
    // Only a whole run that compiles everything tells what the test costs.
    let is_cold = all && options.parts.is_empty() && !workspace.target.join(tools::WASM_TARGET).exists();
    thread::scope(|scope| {
        scope.spawn(|| browser_lane(workspace, options, &passed, &report));
        native_lane(workspace, options, &passed, &report);
    });
    if is_cold {
        report.keep(workspace)?;
    }
    if options.has(Part::Ledger) {
        report.step(workspace, "ledger", |workspace, _| ledger::without_times(workspace));
    }
    report.finish()
}

/// What is compiled natively, and its tests.
fn native_lane(workspace: &Workspace, options: &TestOptions, passed: &Passed, report: &Report) {
    if options.has(Part::Lint) {
        lint::formatting(workspace, report);
    }
    let mut built = None;
    if options.has(Part::Native) || options.has(Part::Outside) || options.has(Part::Fuzz) {
        report.step(workspace, "compiling natively", |workspace, _| {
            built = Some(native::build(workspace)?);
            Ok(())
        });
    }
    if options.has(Part::Lint) {
        lint::native(workspace, report, options.thorough);
    }
    if let Some(built) = &built {
        run_native(workspace, options, built, passed, report);
    }
}

/// What is compiled for the browser, and its tests.
fn browser_lane(workspace: &Workspace, options: &TestOptions, passed: &Passed, report: &Report) {
    if options.has(Part::Lint) {
        lint::scripts(workspace, report);
        lint::workflows(workspace, report);
    }
    let mut site = false;
    if options.has(Part::Ledger) || options.has(Part::Page) {
        site = report.step(workspace, "building the page", |workspace, _| build::build(workspace, Kind::Shipped, None));
    }
    if options.has(Part::Page) {
        report.step(workspace, "types of the page", |workspace, _| page::types(workspace));
        // As a draft, whose libraries the tests in the browser share. `cargo xtask package` tests it as it is published.
        report.step(workspace, "compiling the npm package", |workspace, _| package::compile(workspace, Kind::Draft));
    }
    if options.has(Part::Page) && site {
        run_page(workspace, options, passed, report);
    }
    if options.has(Part::Wasm) {
        report.step(workspace, wasm::TESTS, |workspace, _| wasm::run(workspace, passed, report));
    }
}

fn run_native(workspace: &Workspace, options: &TestOptions, built: &Built, passed: &Passed, report: &Report) {
    if options.has(Part::Native) {
        report.step(workspace, "native tests", |workspace, bar| {
            native::run(workspace, built, passed, options.cases(), false, (report, bar))
        });
        report.step(workspace, "examples in the documentation", |workspace, _| {
            native::examples(workspace, passed, report)
        });
    }
    if options.has(Part::Fuzz) {
        let name = "fuzzing, always the same inputs";
        report.step(workspace, name, |workspace, _| {
            let program = built.program("lsystem-fuzz")?;
            let print = fingerprint([program, &workspace.root.join("crates/fuzz")])?;
            passed.once(report, name, &print, || fuzz::short(workspace, program, options.thorough))
        });
    }
    if options.has(Part::Outside) {
        let name = "files opened with other programs";
        report.step(workspace, name, |workspace, _| {
            let (program, lsys) = (built.program("outside")?, built.program("lsys")?);
            let what = if options.thorough { "wheel" } else { "check" };
            let beside = ["crates/outside", "crates/lsystem-python", "docs/books", "data_in"]
                .map(|name| workspace.root.join(name));
            let print = fingerprint([program, lsys].into_iter().chain(beside.iter().map(PathBuf::as_path)))?;
            passed.once(report, name, &print, || outside::run(workspace, program, what, lsys))
        });
    }
}

fn run_page(workspace: &Workspace, options: &TestOptions, passed: &Passed, report: &Report) {
    let below = |names: &[&str]| -> Result<String> {
        let paths: Vec<PathBuf> = names.iter().map(|name| workspace.root.join(name)).collect();
        fingerprint(paths.iter().map(PathBuf::as_path)).context("reading what the tests read")
    };
    let step = |name: &str, reads: &[&str], step: &dyn Fn(&Workspace) -> Result<()>| {
        report.step(workspace, name, |workspace, _| passed.once(report, name, &below(reads)?, || step(workspace)));
    };
    let library = package::compiled(workspace, Kind::Draft).to_string_lossy().into_owned();
    step("npm package", &[&library, "crates/lsystem-library-wasm/npm"], &|workspace| {
        package::npm(workspace, Kind::Draft)
    });
    step(page::UNIT, &["www", "data_in"], &|workspace| page::unit(workspace, options.cases()));
    step("end-to-end tests of the page", &["www", "dist", "crates/lsystem/tests/data"], &|workspace| {
        page::end_to_end(workspace, Kind::Shipped, options.thorough.then_some("--thorough").as_slice(), report)
    });
    match tools::firefox() {
        Some(firefox) => step(FIREFOX, &["www/test/firefox", "dist"], &|workspace| page::firefox(workspace, &firefox)),
        None => report.skip(format!(
            "{FIREFOX}: Firefox is missing; put it on the PATH, or set FIREFOX to where it is (Debian: apt-get install {})",
            tools::FIREFOX
        )),
    }
    if options.thorough {
        let one_minute = monkey::ONE_MINUTE.map(str::to_owned);
        step("a minute of the monkey", &["dist"], &|workspace| monkey::run(workspace, &one_minute));
    }
}
