//! Systems in the notations of other programs and of papers: files in `tests/data/import` with what is read from them.
//!
//! A case starts with `=== ` and a title; the pasted text follows, and below `--- read` what the reader makes of it.
//! `UPDATE_EXPECT=1 cargo test -p lsystem-playground --test import` updates the files; check the difference.

use expect_test::expect_file;
use lsystem::import::import;
use std::fmt::Write;
use std::path::Path;

#[test]
fn texts_of_others_and_what_is_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/import");
    let mut cases = 0;
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let mut parts = text.split("=== ");
        let mut actual = parts.next().unwrap().to_owned();
        for part in parts {
            let (title, body) = part.split_once('\n').unwrap();
            let pasted = body.split("--- read\n").next().unwrap();
            write!(actual, "=== {title}\n{pasted}--- read\n{}\n", read(pasted.trim_end_matches('\n'))).unwrap();
            cases += 1;
        }
        expect_file![&path].assert_eq(&actual);
    }
    assert!(cases >= 70, "{cases} cases");
}

/// The system read from a text, with its remarks.
fn read(text: &str) -> String {
    let mut out = String::new();
    let Some(imported) = import(text) else { return "nothing\n".to_owned() };
    for entry in imported.entries {
        write!(out, "{}: {}", imported.notation, entry.name).unwrap();
        match &entry.definition {
            Some(definition) => {
                let right = definition.right_angle.map_or(String::new(), |right| format!(" right {right}"));
                let dialect = definition.dialect.name();
                let (n, angle, heading) = (definition.iterations, definition.angle, definition.heading);
                writeln!(out, ", n {n}, angle {angle}{right}, heading {heading}, {dialect}").unwrap();
                writeln!(out, "  axiom {}", definition.axiom).unwrap();
                let texts = definition.rules.lines().chain(definition.overrides.lines());
                texts.for_each(|line| writeln!(out, "  {line}").unwrap());
            }
            None => writeln!(out, ", refused").unwrap(),
        }
        for remark in entry.remarks {
            let text = if remark.text.is_empty() { String::new() } else { format!(" `{}`", remark.text) };
            writeln!(out, "  ! line {}{text}: {}", remark.line, remark.message).unwrap();
        }
    }
    out
}
