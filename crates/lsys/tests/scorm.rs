//! Packages for learning systems, as `lsys scorm` writes them.

use lsystem::Definition;
use lsystem::course::Exercise;
use std::path::Path;
use std::process::Command;

const STEPS: &str =
    "<!doctype html>\n<html lang=\"en\"><title>T</title><h1>T</h1><!-- steps -->S<!-- /steps --></html>";

fn lsys(folder: &Path, words: &[&str]) -> (Option<i32>, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_lsys"))
        .env("LC_ALL", "C")
        .args(words)
        .current_dir(folder)
        .output()
        .expect("lsys runs");
    (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).expect("UTF-8"))
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("site")).expect("made");
    std::fs::write(folder.path().join("site/package.html"), STEPS).expect("written");
    std::fs::write(folder.path().join("site/exercise.html"), "<!doctype html>\n<p>exercise").expect("written");
    folder
}

fn exercise(title: &str) -> String {
    let target = Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), ..Definition::default() };
    format!(
        "https://example.org/exercise.html#v=1&x={}",
        Exercise { title: title.into(), target, ..Exercise::default() }.write()
    )
}

#[test]
fn links_and_files_with_links_become_a_package() {
    let folder = folder();
    std::fs::write(folder.path().join("second.txt"), format!("Here:\n{}\n", exercise("Second"))).expect("written");
    let words =
        ["scorm", &exercise("First"), "second.txt", "--pages", "site", "--to", "week.zip", "--standard", "2004"];
    let (code, text) = lsys(folder.path(), &words);
    assert_eq!(code, Some(0), "{text}");
    assert!(text.starts_with("week.zip, ") && text.contains("can be forged"), "{text}");
    let zip = std::fs::read(folder.path().join("week.zip")).expect("written");
    assert!(zip.starts_with(b"PK\x03\x04"));
    let (code, text) = lsys(folder.path(), &["scorm", "--lesson", "--pages", "site", "--to", "lesson.zip"]);
    assert_eq!(code, Some(0), "{text}");
    assert!(folder.path().join("lesson.zip").is_file());
}

#[test]
fn what_cannot_be_packed_is_told_and_nothing_is_written() {
    let folder = folder();
    let first = exercise("First");
    for (words, said) in [
        (&["scorm", "--to", "a.zip"][..], "required"),
        (&["scorm", &first, "--lesson", "--to", "a.zip"], "cannot be used with"),
        (&["scorm", &first, "--to", "a.zip", "--standard", "1.3"], "[possible values: 1.2, 2004]"),
        (&["scorm", "missing.txt", "--to", "a.zip", "--pages", "site"], "missing.txt"),
        (&["scorm", &first, "--to", "a.zip"], "--pages"),
        (&["scorm", &first, "--to", "a.zip", "--pages", "nowhere"], "package.html"),
        (&["scorm", "#v=1&x=AAAA", "--to", "a.zip", "--pages", "site"], "damaged"),
        (&["scorm", &first, "--to", "site", "--pages", "site"], "site"),
    ] {
        let (code, text) = lsys(folder.path(), words);
        assert!(code != Some(0) && text.contains(said), "{words:?}: {code:?} {text}");
        assert!(!folder.path().join("a.zip").exists(), "{words:?}");
    }
}
