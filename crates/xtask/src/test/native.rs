//! The native tests: Cargo compiles them all at once, and groups of them run side by side, the longest first.

use super::passed::{Passed, fingerprint, fingerprint_of};
use crate::child;
use crate::report::{Report, measure};
use crate::workspace::{Workspace, output};
use anyhow::{Context, Result, bail};
use indicatif::ProgressBar;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// What Cargo is told to compile: everything but the measurements, so that all crates share their libraries.
pub(crate) const CRATES: [&str; 3] = ["--workspace", "--exclude", "bench"];
/// The programs that tests run, and the library of the Python package. Not this one, which would be linked anew while it
/// runs.
const PROGRAMS: [&str; 7] =
    ["build", "--lib", "--bin=lsys", "--bin=lsystem-fuzz", "--bin=outside", "--bin=site", "--bin=wasm-test-runner"];
/// What native tests read beside what is compiled into them.
const DATA: [&str; 8] = [
    "data_in",
    "docs",
    "README.md",
    "www/js/tables.js",
    "www/js/messages.d.ts",
    "www/schema",
    "crates/lsystem-library-wasm/npm",
    "crates/fuzz",
];
/// Tests that read the sources or manifests of all crates: they always run.
const READS_SOURCES: [&str; 2] = ["assertions", "boundary"];
/// In the quick test, groups that took longer are left out, in seconds.
const QUICK: f64 = 3.0;

/// A compiled test program.
struct Program {
    package: String,
    target: String,
    file: PathBuf,
    /// The folder of its crate.
    folder: PathBuf,
}

/// The compiled programs.
#[derive(Default)]
pub(super) struct Built {
    tests: Vec<Program>,
    /// Programs that are no tests.
    others: Vec<Program>,
}

impl Built {
    /// Reads a message of Cargo; those that tell no program are passed over.
    fn read(&mut self, message: &Value) -> Result<()> {
        let Some(file) = message["executable"].as_str() else { return Ok(()) };
        let manifest = Path::new(message["manifest_path"].as_str().context("a crate without a manifest")?);
        let folder = manifest.parent().context("a manifest without a folder")?;
        let program = Program {
            package: folder.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            target: message["target"]["name"].as_str().unwrap_or_default().to_owned(),
            file: file.into(),
            folder: folder.to_owned(),
        };
        let is_known = |programs: &[Program]| programs.iter().any(|known| known.file == program.file);
        let programs = if message["profile"]["test"] == true { &mut self.tests } else { &mut self.others };
        if !is_known(programs) {
            programs.push(program);
        }
        Ok(())
    }

    /// A program that is no test.
    pub(super) fn program(&self, name: &str) -> Result<&Path> {
        let found = self.others.iter().find(|program| program.target == name);
        found.map(|program| program.file.as_path()).with_context(|| format!("Cargo built no program {name}"))
    }
}

/// Tests of one program that run as one process.
struct Group {
    name: String,
    program: PathBuf,
    folder: PathBuf,
    tests: Vec<String>,
    print: String,
}

/// Compiles all programs, then all tests.
pub(super) fn build(workspace: &Workspace) -> Result<Built> {
    let mut built = Built::default();
    for what in [&PROGRAMS[..], &["test", "--no-run"]] {
        let words = what.iter().copied().chain(["--message-format=json-render-diagnostics"]).chain(CRATES);
        for line in workspace.output(&mut workspace.cargo(words))?.lines() {
            built.read(&serde_json::from_str(line)?)?;
        }
    }
    Ok(built)
}

/// Runs the tests that have not passed as they are, or only the quick ones of these.
pub(super) fn run(
    workspace: &Workspace,
    built: &Built,
    passed: &Passed,
    cases: Option<&str>,
    is_quick: bool,
    (report, bar): (&Report, &ProgressBar),
) -> Result<()> {
    let mut groups = groups(workspace, built)?;
    let known = groups.len();
    let always = |group: &Group| READS_SOURCES.iter().any(|name| group.name.ends_with(name));
    groups.retain(|group| always(group) || !passed.has(&group.name, &group.print));
    if groups.len() < known {
        report.skip(format!("{} of {known} groups of native tests passed as they are", known - groups.len()));
    }
    if is_quick {
        let is_long = |group: &Group| passed.seconds(&group.name).is_some_and(|seconds| seconds > QUICK);
        let (long, short): (Vec<_>, Vec<_>) = groups.into_iter().partition(is_long);
        long.iter().for_each(|group| report.skip(format!("{}: longer than {QUICK} s", group.name)));
        groups = short;
    }
    // Popped from the end: the longest first, so that none is left alone at the end.
    let seconds = |group: &Group| passed.seconds(&group.name).unwrap_or(f64::INFINITY);
    groups.sort_by(|a, b| seconds(a).total_cmp(&seconds(b)));
    measure(bar, groups.len());
    let groups = Mutex::new(groups);
    let failed = Mutex::new(vec![]);
    let next = || groups.lock().unwrap_or_else(PoisonError::into_inner).pop();
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, Into::into) {
            scope.spawn(|| {
                while let Some(group) = next() {
                    bar.set_message(group.name.clone());
                    let (result, time) = group.run(workspace, cases);
                    report.time(&group.name, time);
                    bar.inc(1);
                    let noted = result.and_then(|()| passed.note(&group.name, &group.print, time.as_secs_f64()));
                    if let Err(error) = noted {
                        workspace.say(format!("--- {}\n{error:#}", group.name));
                        failed.lock().unwrap_or_else(PoisonError::into_inner).push(group.name);
                    }
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap_or_else(PoisonError::into_inner);
    if failed.is_empty() {
        return Ok(());
    }
    bail!("failed: {}", failed.join(", "))
}

impl Group {
    /// Runs the tests one after the other. The error contains what they print.
    fn run(&self, workspace: &Workspace, cases: Option<&str>) -> (Result<()>, Duration) {
        let mut command = Command::new(&self.program);
        command.arg("--exact").args(&self.tests).current_dir(&self.folder);
        command.env("CARGO_MANIFEST_DIR", &self.folder).env("RUST_TEST_THREADS", "1");
        match cases {
            Some(cases) => command.env("LSYSTEM_CASES", cases),
            // The same random systems every time, so that a change is the only difference.
            None => command.env("PROPTEST_RNG_SEED", "1"),
        };
        let start = Instant::now();
        let result = child::output(&mut command, workspace.deadline, &workspace.spent).map(drop);
        (result, start.elapsed())
    }
}

/// The tests of all programs, by program and outermost module.
fn groups(workspace: &Workspace, built: &Built) -> Result<Vec<Group>> {
    let data: Vec<PathBuf> = DATA.iter().map(|name| workspace.root.join(name)).collect();
    let data = fingerprint(data.iter().map(PathBuf::as_path))?;
    let mut groups = vec![];
    for program in &built.tests {
        // Tests may run the programs of their crate, and read files beside them.
        let own =
            built.others.iter().filter(|other| other.package == program.package).map(|other| other.file.as_path());
        let beside = program.folder.join("tests");
        let is_data = |path: &Path| path.extension().is_none_or(|ending| ending != "rs");
        let beside = fingerprint_of([beside.as_path()].into_iter().filter(|path| path.exists()), is_data)?;
        let print = fingerprint([program.file.as_path()].into_iter().chain(own))?;
        let list = output(Command::new(&program.file).args(["--list", "--format=terse"]))?;
        let mut modules: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for test in list.lines().filter_map(|line| line.strip_suffix(": test")) {
            let module = test.split_once("::").map_or("", |(module, _)| module);
            modules.entry(module).or_default().push(test.to_owned());
        }
        groups.extend(modules.into_iter().map(|(module, tests)| Group {
            name: format!("{} {} {module}", program.package, program.target).trim_end().to_owned(),
            program: program.file.clone(),
            folder: program.folder.clone(),
            tests,
            print: format!("{print}-{beside}-{data}"),
        }));
    }
    Ok(groups)
}

/// Runs the examples in the documentation.
pub(super) fn examples(workspace: &Workspace, passed: &Passed, report: &Report) -> Result<()> {
    let name = "examples in the documentation";
    let roots = [workspace.root.join("crates"), workspace.root.join("README.md")];
    let is_read =
        |path: &Path| path.extension().is_some_and(|ending| ending == "rs" || ending == "md" || ending == "toml");
    let print = fingerprint_of(roots.iter().map(PathBuf::as_path), is_read)?;
    passed
        .once(report, name, &print, || workspace.run(&mut workspace.cargo(["test", "--doc"].into_iter().chain(CRATES))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Dependencies of tests may ask for more features of a crate. Then the programs alone and the programs beside tests
    /// differ, and Cargo compiles all that is above this crate twice (`crates/test-effort/Cargo.toml`).
    #[test]
    fn tests_change_no_features() -> Result<()> {
        let workspace = Workspace::find()?;
        let features = |edges| {
            let words = ["tree", "--prefix=none", "--format={p} {f}", edges].into_iter().chain(CRATES);
            let tree = output(&mut workspace.cargo(words))?;
            Ok::<BTreeSet<String>, anyhow::Error>(tree.lines().map(|line| line.replace(" (*)", "")).collect())
        };
        let (alone, tests) = (features("--edges=normal,build")?, features("--edges=normal,build,dev")?);
        assert_eq!(alone.difference(&tests).collect::<Vec<_>>(), [""; 0]);
        Ok(())
    }
}
