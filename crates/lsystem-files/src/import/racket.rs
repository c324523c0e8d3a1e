//! Racket's `#lang lindenmayer`.
//!
//! ```text
//! #lang lindenmayer racket
//! ## axiom ##
//! F
//! ## rules ##
//! F -> F-F++F-F
//! ## variables ##
//! n=3
//! θ=60
//! =============
//! (provide (all-defined-out)) ...
//! ```

use super::draft::Draft;
use super::plain::Plain;
use lsystem_syntax::decimal;

/// Reads the systems, which rows of dashes separate.
pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    if !text.trim_start().starts_with("#lang lindenmayer") {
        return None;
    }
    let mut entries = Vec::new();
    let mut draft = Plain::new("System 1", 1);
    let (mut part, mut has_axiom) = ("", false);
    for (number, line) in text.lines().enumerate().skip(1) {
        let trimmed = line.trim();
        let is_row = |mark: char| trimmed.len() > 2 && trimmed.chars().all(|ch| ch == mark);
        if trimmed.starts_with("##") {
            part = match trimmed.trim_matches(['#', ' ']) {
                "axiom" => "axiom",
                "rules" => "rules",
                "variables" => "variables",
                other => {
                    draft.draft.refuse(number + 1, other, "This section is not known");
                    ""
                }
            };
        } else if is_row('-') {
            let next = Plain::new(&format!("System {}", entries.len() + 2), number + 1);
            finish(core::mem::replace(&mut draft, next), &mut has_axiom, &mut entries);
            part = "";
        } else if is_row('=') {
            // Code in Racket follows.
            draft.draft.note(
                number + 1,
                "",
                "Code in Racket is not read, so symbols have their usual meaning: F draws",
            );
            break;
        } else if trimmed.is_empty() || trimmed.starts_with('#') {
        } else if part == "axiom" {
            draft.start(trimmed);
            has_axiom = true;
        } else if part == "rules" {
            match trimmed.split_once("->").or_else(|| trimmed.split_once('→')) {
                Some((predecessor, successor)) if predecessor.trim().chars().count() == 1 => {
                    let letter = predecessor.trim().chars().next().unwrap_or('F');
                    draft.produce(letter, successor, None);
                }
                _ => draft.draft.refuse(number + 1, trimmed, "Only rules for one plain symbol are read"),
            }
        } else if part == "variables" {
            variable(trimmed, number + 1, &mut draft);
        }
    }
    finish(draft, &mut has_axiom, &mut entries);
    (!entries.is_empty()).then_some(entries)
}

fn variable(line: &str, number: usize, draft: &mut Plain) {
    let Some((name, value)) = line.split_once('=') else { return };
    match (name.trim(), decimal::read(value.trim())) {
        ("n", Some(value)) => draft.iterate(value),
        ("θ" | "theta" | "angle", Some(value)) => draft.definition().angle = value,
        ("w" | "h" | "width" | "height" | "margin", _) => {}
        _ => draft.draft.note(number, line, "This variable has no meaning here"),
    }
}

fn finish(mut draft: Plain, has_axiom: &mut bool, entries: &mut Vec<Draft>) {
    if core::mem::take(has_axiom) {
        draft.definition().heading = 0.0;
        draft.draw_something();
        entries.push(draft.into_draft());
    }
}
