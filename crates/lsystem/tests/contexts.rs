//! The modules that a context matches, as files to which anyone can add cases: `tests/data/context`.
//!
//! A case starts with `=== ` and a title. Then follow `ignore:` or `consider:` lines, if any, the part of a production
//! before its arrow, and words. Carets below a word mark the modules that match; a word without carets has none. The
//! core and the naive reference must both agree with the carets.

use crate::naive;
use lsystem::derive::Rewriter;
use lsystem::syntax::parse;
use lsystem::{Limits, System};
use std::path::Path;

#[test]
fn contexts_match_where_the_carets_are() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/context");
    let mut words = 0;
    for file in std::fs::read_dir(folder).unwrap() {
        let path = file.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        for case in text.split("=== ").skip(1) {
            let (title, body) = case.split_once('\n').unwrap();
            words += check(&format!("{}: {title}", path.display()), body);
        }
    }
    assert!(words >= 60, "{words} words");
}

/// Checks the words of a case. Returns their number.
fn check(title: &str, body: &str) -> usize {
    let mut lines = body.lines().filter(|line| !line.is_empty()).peekable();
    let mut rules = String::new();
    while let Some(list) = lines.next_if(|line| line.starts_with("ignore:") || line.starts_with("consider:")) {
        rules.push_str(list);
        rules.push('\n');
    }
    // Only this production makes the symbol ✓.
    rules.push_str(&format!("{} -> ✓", lines.next().unwrap()));
    let mut words = 0;
    while let Some(word) = lines.next() {
        let carets = lines.next_if(|line| line.chars().all(|c| c == ' ' || c == '^')).unwrap_or_default();
        let expected: Vec<bool> = columns(word).iter().map(|&at| carets.chars().nth(at) == Some('^')).collect();
        assert_eq!(expected.iter().filter(|m| **m).count(), carets.matches('^').count(), "{title}: {word}");
        let (core, plain) = matches(&rules, word);
        assert_eq!(core, expected, "{title}: {word}");
        assert_eq!(plain, expected, "the plain reading, {title}: {word}");
        words += 1;
    }
    assert!(words > 0, "{title}");
    words
}

/// The place of each module's symbol in the text.
fn columns(word: &str) -> Vec<usize> {
    let mut depth = 0;
    let mut columns = Vec::new();
    for (at, ch) in word.chars().enumerate() {
        match ch {
            '(' => depth += 1,
            ')' => depth -= 1,
            ' ' => {}
            _ if depth == 0 => columns.push(at),
            _ => {}
        }
    }
    columns
}

/// By module: whether the production applies, by the core and by the naive reference.
fn matches(rules: &str, word: &str) -> (Vec<bool>, Vec<bool>) {
    let (grammar, diagnostics) = parse(word, rules);
    assert!(!diagnostics.iter().any(lsystem::Diagnostic::is_error), "{rules}: {diagnostics:?}");
    let plain = naive::modules(&grammar, 0, 1).unwrap().iter().map(|module| module.symbol == '✓').collect();
    let definition =
        lsystem::Definition { axiom: word.to_owned(), rules: rules.to_owned(), ..lsystem::Definition::default() };
    let rules = System::new(&definition).unwrap().rules;
    let mut rewriter = Rewriter::new(rules, 0, Limits::default()).unwrap();
    // Small steps, so that steps end at every module.
    while !rewriter.step(1).unwrap() {}
    let symbol = |letter: &u16| rewriter.rules().letters[usize::from(*letter)].symbol;
    (rewriter.word().letters.iter().map(|letter| symbol(letter) == '✓').collect(), plain)
}
