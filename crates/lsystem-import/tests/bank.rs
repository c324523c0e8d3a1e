//! The bank of texts that were once read wrong or not at all, and those that still are. The list may only shrink.

use crate::foreign::problem;
use lsystem_import::import;
use serde_json::Value;

/// The cases that are not right yet, with what is wrong: `unread`, `refused`, `told` (another system, with remarks) or
/// `silent` (another system without one).
const WRONG: &[(&str, &str)] = &[
    ("junk-yaml-actions", "unread"),
    ("racket-nothing", "told"),
    ("A16 edges", "told"),
    ("A27 forms", "unread"),
    ("kind 16", "unread"),
    ("kind 21", "unread"),
    ("kind 23", "unread"),
    ("text 3", "unread"),
    ("text 19", "unread"),
];

fn cases() -> Vec<Value> {
    let mut all: Value = serde_json::from_str(include_str!("foreign-cases-2.json")).unwrap();
    all["cases"].as_array_mut().map(core::mem::take).unwrap()
}

/// What is wrong with a case, in a word.
fn fault(case: &Value) -> Option<&'static str> {
    let why = problem(case)?;
    if std::env::var_os("BANK").is_some() {
        eprintln!("== {}\n{}\n-> {why}", case["id"], case["text"].as_str().unwrap());
    }
    let Some(found) = import(case["text"].as_str().unwrap()) else { return Some("unread") };
    if found.entries.iter().any(|entry| entry.definition.is_none()) {
        return Some("refused");
    }
    Some(if found.entries.iter().all(|entry| entry.remarks.is_empty()) { "silent" } else { "told" })
}

#[test]
fn the_list_of_faults_is_true() {
    let cases = cases();
    let found: Vec<(&str, &str)> =
        cases.iter().filter_map(|case| Some((case["id"].as_str().unwrap(), fault(case)?))).collect();
    assert_eq!(cases.len(), 162);
    assert_eq!(found, WRONG);
}

/// A text may be cut anywhere, as when a part of a page is copied.
#[test]
fn cases_cut_at_every_character_end_without_a_panic() {
    for case in cases().into_iter().step_by(2) {
        let text = case["text"].as_str().unwrap();
        for (at, _) in text.char_indices() {
            for part in [&text[..at], &text[at..]] {
                let Some(found) = import(part) else { continue };
                assert_eq!(found.account.last().map(|part| part.span.end), Some(part.len()), "{part}");
            }
        }
    }
}
