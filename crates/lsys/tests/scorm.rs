//! Packages for learning systems, as `lsys scorm` writes them.

use crate::program;

use flate2::read::DeflateDecoder;
use lsystem::Definition;
use lsystem::course::Exercise;
use program::{command, printed};
use std::io::Read;

const STEPS: &str =
    "<!doctype html>\n<html lang=\"en\"><title>T</title><h1>T</h1><!-- steps -->S<!-- /steps --></html>";

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
    let (code, text) = printed(&mut command(folder.path(), &words));
    assert_eq!(code, Some(0), "{text}");
    assert!(text.starts_with("week.zip, ") && text.contains("can be forged"), "{text}");
    let zip = std::fs::read(folder.path().join("week.zip")).expect("written");
    assert!(zip.starts_with(b"PK\x03\x04"));
    let (code, text) =
        printed(&mut command(folder.path(), &["scorm", "--lesson", "--pages", "site", "--to", "lesson.zip"]));
    assert_eq!(code, Some(0), "{text}");
    assert!(folder.path().join("lesson.zip").is_file());
}

/// The text of a file in a zip.
fn file_in(zip: &[u8], name: &str) -> String {
    let start =
        (0..zip.len()).find(|&at| zip[at..].starts_with(b"PK\x03\x04") && zip[at + 30..].starts_with(name.as_bytes()));
    let start = start.expect("the file is there");
    let more = usize::from(u16::from_le_bytes([zip[start + 28], zip[start + 29]]));
    let mut text = String::new();
    DeflateDecoder::new(&zip[start + 30 + name.len() + more..]).read_to_string(&mut text).expect("UTF-8");
    text
}

#[test]
fn a_package_is_in_the_language_of_its_maker() {
    let folder = folder();
    let page = "<!doctype html>\n<html lang=\"en\"><title>E</title><button>Hint</button><p>Iterations</html>";
    std::fs::write(folder.path().join("site/exercise.html"), page).expect("written");
    let (first, second) = (exercise("Koch curve"), exercise(""));
    let package = |language: &str| {
        let words = ["scorm", &first, &second, "--pages", "site", "--to", "week.zip", "--language", language];
        let (code, text) = printed(&mut command(folder.path(), &words));
        assert_eq!(code, Some(0), "{text}");
        std::fs::read(folder.path().join("week.zip")).expect("written")
    };
    let english = package("en");
    assert_eq!(file_in(&english, "exercise.html"), page);
    for (language, title, exercise, hint, read_me) in [
        ("de", "Aufgaben zu L-Systemen", "2. Aufgabe<", "\"Hint\":\"Hinweis\"", "lsys mark EXERCISE ANSWERS.csv"),
        (
            "fr",
            "Exercices sur les L-syst\u{e8}mes",
            "2. Exercice<",
            "\"Hint\":\"Indice\"",
            "lsys mark EXERCISE ANSWERS.csv",
        ),
    ] {
        let zip = package(language);
        let steps = file_in(&zip, "index.html");
        assert!(steps.contains(&format!("<html lang=\"{language}\" data-package=")), "{steps}");
        assert!(steps.contains(&format!("<h1>{title}</h1>")) && steps.contains(exercise), "{steps}");
        assert!(file_in(&zip, "imsmanifest.xml").contains(title));
        let page = file_in(&zip, "exercise.html");
        assert!(page.contains(&format!("<html lang=\"{language}\"><title>E</title>")) && page.contains(hint), "{page}");
        assert!(page.len() < 4000 && page.ends_with("<button>Hint</button><p>Iterations</html>"), "{page}");
        let told = file_in(&zip, "read-me.txt");
        assert!(told.contains(read_me) && !told.contains("forged"), "{told}");
        // Links and what the learning system keeps are the same.
        for part in [&first[first.find("x=").expect("an exercise")..], "#v=1"] {
            assert!(told.contains(part) && file_in(&english, "read-me.txt").contains(part), "{told}");
        }
    }
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
        let (code, text) = printed(&mut command(folder.path(), words));
        assert!(code != Some(0) && text.contains(said), "{words:?}: {code:?} {text}");
        assert!(!folder.path().join("a.zip").exists(), "{words:?}");
    }
}
