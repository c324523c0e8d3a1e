//! Texts with their diagnostics, as files to which anyone can add cases: `tests/data/notation` and `tests/data/json`.
//!
//! A case starts with `=== ` and a title. Without sections, its lines are rules, read with the axiom `F`. The sections
//! `--- axiom`, `--- rules` and `--- overrides` form a system in the dialect `abop`; a section `--- file` is a JSON
//! file. Below a line stand the diagnostics that point at it:
//!
//! ```text
//! F = FF
//!   ^ error `=` gives a constant its value, and `FF` is not a number. For a rule write `F -> FF`. [->]
//! ```
//!
//! Carets mark the characters, `|` a place where text is missing, `@` a diagnostic without a place. Then follow
//! severity, message, hint, and in brackets what the button writes there. `UPDATE_EXPECT=1 cargo test -p lsystem-playground --test annotated` updates the files; check the
//! difference.

use expect_test::expect_file;
use lsystem::syntax::{Field, Severity, parse};
use lsystem::{Definition, Diagnostic, System, read_json};
use std::path::{Path, PathBuf};

#[test]
fn texts_and_what_is_said_about_them() {
    let mut cases = 0;
    let mut wrong = 0;
    for path in files() {
        let text = std::fs::read_to_string(&path).unwrap();
        let mut actual = String::new();
        let mut parts = text.split("=== ");
        actual.push_str(parts.next().unwrap());
        for part in parts {
            let (title, body) = part.split_once('\n').unwrap();
            let (annotated, errors) = annotate(body);
            actual.push_str(&format!("=== {title}\n{annotated}"));
            cases += 1;
            wrong += usize::from(errors > 0);
        }
        expect_file![&path].assert_eq(&actual);
    }
    assert!(cases >= 200 && wrong >= 120, "{cases} cases, {wrong} of them wrong texts");
}

fn files() -> Vec<PathBuf> {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let mut files: Vec<PathBuf> = ["notation", "json"]
        .iter()
        .flat_map(|folder| std::fs::read_dir(data.join(folder)).unwrap())
        .map(|file| file.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "txt"))
        .collect();
    files.sort();
    files
}

/// The case with its present diagnostics, and the number of errors.
fn annotate(body: &str) -> (String, usize) {
    let mut sections: Vec<(&str, String)> = vec![("", String::new())];
    for line in body.split_inclusive('\n').filter(|line| !is_annotation(line)) {
        match line.strip_prefix("--- ") {
            Some(name) => sections.push((name.trim_end(), String::new())),
            None => sections.last_mut().unwrap().1.push_str(line),
        }
    }
    let text = |name: &str| sections.iter().find(|(n, _)| *n == name).map(|(_, text)| text.trim_end_matches('\n'));
    let diagnostics = if let Some(file) = text("file") {
        let (definition, diagnostics) = read_json(file);
        assert_eq!(definition.is_none(), diagnostics.iter().any(Diagnostic::is_error));
        diagnostics
    } else if sections.len() > 1 {
        let own = |name: &str| text(name).unwrap_or_default().to_owned();
        let (axiom, rules, overrides) = (own("axiom"), own("rules"), own("overrides"));
        let definition = Definition { axiom, rules, overrides, ..Definition::default() };
        let diagnostics = System::problems(&definition);
        assert_eq!(System::new(&definition).is_err(), diagnostics.iter().any(Diagnostic::is_error));
        diagnostics
    } else {
        parse("F", text("").unwrap()).1
    };
    let errors = diagnostics.iter().filter(|d| d.is_error()).count();

    let mut out = String::new();
    for (name, text) in &sections {
        if !name.is_empty() {
            out.push_str(&format!("--- {name}\n"));
        }
        let field = match *name {
            "axiom" => Field::Axiom,
            "overrides" => Field::Overrides,
            "file" => Field::File,
            _ => Field::Rules,
        };
        let own: Vec<&Diagnostic> = diagnostics.iter().filter(|d| d.field == field).collect();
        for diagnostic in own.iter().filter(|d| d.span == (0..0)) {
            out.push_str(&format!("@ {}\n", said(diagnostic)));
        }
        let mut from = 0;
        for line in text.split_inclusive('\n') {
            out.push_str(line);
            let here = from..from + line.len();
            from = here.end;
            for diagnostic in own.iter().filter(|d| d.span != (0..0) && here.contains(&d.span.start)) {
                let before = text[here.start..diagnostic.span.start].chars().count();
                let end = diagnostic.span.end.min(here.end);
                let length = text[diagnostic.span.start..end].trim_end_matches('\n').chars().count();
                let mark = if length == 0 { "|".to_owned() } else { "^".repeat(length) };
                out.push_str(&format!("{}{mark} {}\n", " ".repeat(before), said(diagnostic)));
            }
        }
    }
    (out, errors)
}

fn said(diagnostic: &Diagnostic) -> String {
    let severity = match diagnostic.severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
    };
    let fix = diagnostic.fix.as_ref().map_or_else(String::new, |fix| format!(" [{fix}]"));
    match &diagnostic.hint {
        Some(hint) => format!("{severity} {}. {hint}{fix}", diagnostic.message),
        None => format!("{severity} {}{fix}", diagnostic.message),
    }
}

fn is_annotation(line: &str) -> bool {
    let rest = line.trim_start().trim_start_matches(['^', '|', '@']);
    rest.len() < line.trim_start().len() && (rest.starts_with(" error ") || rest.starts_with(" warning "))
}
