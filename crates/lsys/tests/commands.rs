//! Every command on a full disk and with little memory.

#![cfg(target_os = "linux")]

use crate::hostile::{catch_ignored_signals, contents, desk, names, shell_in};
use crate::program;
use crate::view::PAGE;

use lsystem::files::FORMATS;
use lsystem::import::write::NOTATIONS;
use program::output;
use std::collections::BTreeSet;
use std::fs;
use tempfile::TempDir;

/// Runs that print what they make.
const PRINTED: &[&str] = &[
    "view a.json --no-browser --page page.html",
    "link a.json",
    "shape outline.svg",
    "expand a.json",
    "draw a.json --format svg",
    "info a.json",
    "info a.json --json",
    "info a.json --growth",
    "import a.json --account",
    "export --list",
    "check a.json string.txt",
    "find FFFF --axiom F -n 1",
    "surprise --seed 7",
    "mark exercise.txt answers.csv",
    "mark exercise.txt answers.csv --csv",
    "animate a.json --to - --size 64x64",
    "completions bash",
    "help",
    "--version",
];

/// Runs that write files, and the first of the files or their folder.
const WRITTEN: &[(&str, &str)] = &[
    ("draw a.json old", "old.txt"),
    ("draw a.json --out-dir new", "new/a.txt"),
    ("tiles a.json new --levels 0..1", "new"),
    ("animate a.json --to old.gif --size 64x64", "old.gif"),
    ("animate a.json --to new --size 64x64", "new"),
    ("import a.json --to new", "new"),
    ("breed a.json --to new --seed 1 --count 2", "new"),
    ("mark exercise.txt answers.csv --html old.html", "old.html"),
    ("exhibit a.json --to old.html", "old.html"),
    ("scorm exercise.txt --pages site --to old.zip", "old.zip"),
];

/// A folder for all runs, with outputs of former runs.
fn full_desk() -> TempDir {
    let folder = desk();
    let put = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("written");
    put("outline.svg", r#"<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L1 0L1 1Z"/></svg>"#);
    put("string.txt", "F+F--F+F+F+F--F+F--F+F--F+F+F+F--F+F\n");
    fs::create_dir(folder.path().join("site")).expect("made");
    put("site/exercise.html", "<!doctype html>\n<p>exercise");
    put(
        "site/package.html",
        "<!doctype html>\n<html lang=\"en\"><title>T</title><h1>T</h1><!-- steps -->S<!-- /steps --></html>",
    );
    put("page.html", PAGE);
    for ending in FORMATS.iter().map(|format| format.ending).chain(["txt", "html", "zip"]) {
        put(&format!("old.{ending}"), "as it was");
    }
    folder
}

/// All runs that print, and all that write with one of their outputs.
fn runs() -> [Vec<(String, String)>; 2] {
    let pair = |run: &str, file: &str| (run.to_owned(), file.to_owned());
    let printed = PRINTED.iter().map(|run| pair(run, "standard output"));
    let notations = NOTATIONS.iter().map(|one| pair(&format!("export a.json --as {}", one.name), "standard output"));
    let written = WRITTEN.iter().map(|(run, file)| pair(run, file));
    let formats = FORMATS
        .iter()
        .map(|one| pair(&format!("draw a.json old --format {}", one.name), &format!("old.{}", one.ending)));
    [printed.chain(notations).collect(), written.chain(formats).collect()]
}

#[test]
fn every_command_is_tried() {
    let help = String::from_utf8(output(&program::root(), "--help").stdout).expect("UTF-8");
    let list = help.split("Commands:\n").nth(1).and_then(|rest| rest.split("\n\n").next()).expect("a list");
    let known: BTreeSet<&str> = list
        .lines()
        .filter_map(|line| line.strip_prefix("  ").filter(|line| !line.starts_with(' '))?.split(' ').next())
        .collect();
    let tried = PRINTED.iter().copied().chain(WRITTEN.iter().map(|(run, _)| *run));
    let tried: BTreeSet<&str> =
        tried.filter_map(|run| run.split(' ').next()).filter(|word| !word.starts_with('-')).collect();
    assert_eq!(tried, known, "each command has a run here");
}

#[test]
fn a_full_disk_is_told_by_every_command() {
    let [printed, written] = runs();
    let folder = full_desk();
    for (run, file) in printed {
        let (code, said) = shell_in(&folder, &format!("$lsys {run} > /dev/full"));
        assert!(code == Some(1) && said.contains(&format!("error: {file}: ")), "{run}: {code:?} {said}");
    }
    for (run, file) in written {
        let folder = full_desk();
        let before = contents(folder.path());
        let (code, said) = shell_in(&folder, &format!("ulimit -f 0; $lsys {run}"));
        assert!(code == Some(1) && said.contains(&format!("error: {file}")), "{run}: {code:?} {said}");
        assert_eq!(contents(folder.path()), before, "{run}");
        assert!(!names(folder.path()).iter().any(|name| name.starts_with(".lsys")), "{run}");
        // The next run is not disturbed.
        let (code, said) = shell_in(&folder, &format!("$lsys {run} > /dev/null"));
        assert_eq!(code, Some(0), "{run}: {said}");
        assert!(contents(folder.path()) != before, "{run}");
    }
}

#[test]
fn every_command_runs_in_600_megabytes_of_addresses() {
    catch_ignored_signals();
    for (run, _) in runs().concat() {
        let folder = full_desk();
        let script = match run.starts_with("view") {
            false => format!("ulimit -v 600000; $lsys {run} > /dev/null"),
            // The page is served until a signal comes.
            true => format!(
                "exec 3< <(ulimit -v 600000; exec $lsys {run}); page=$!; read -r address <&3
                 [[ $address == *http://127.0.0.1:* ]] || exit 9; kill -INT $page; wait $page; [[ $? == 130 ]]"
            ),
        };
        let (code, said) = shell_in(&folder, &script);
        assert_eq!(code, Some(0), "{run}: {said}");
    }
}
