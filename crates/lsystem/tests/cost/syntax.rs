//! The cost of reading texts. If reading took quadratic time, the longest of these texts would take without end.

use super::systems::texts;
use lsystem::System;
use lsystem::base::{MAX_ACTIONS, MAX_TEXT};
use lsystem::drawing::{kind, legend};
use lsystem::syntax::{classify, parse_overrides};
use std::time::{Duration, Instant};

/// The most diagnostics of one text, with one for the number of others.
const MAX: usize = 101;

#[test]
fn the_longest_texts_are_read_and_told_about_in_few_words() {
    let mut slowest = (Duration::ZERO, "");
    for length in [100, MAX_TEXT - 4_096] {
        for (name, definition) in texts(length) {
            let began = Instant::now();
            let mut diagnostics = vec![];
            let system = System::read(&definition, &mut diagnostics);
            // The time is only printed, because it depends on the machine.
            slowest = slowest.max((began.elapsed(), name));
            assert!(diagnostics.len() <= 4 * MAX, "{name}: {} diagnostics", diagnostics.len());
            let text = diagnostics.iter().map(|d| d.message.len()).max().unwrap_or(0);
            assert!(text < 1_000, "{name}: a message of {text} bytes");
            let classes = classify(&definition);
            assert_eq!(classes.rules.len(), definition.rules.len());
            if let Some(system) = &system {
                assert!(!kind(system).is_empty());
                assert!(legend(system).len() <= system.rules.letters.len());
            }
        }
    }
    println!("reading a text takes {:.1?} at most ({})", slowest.0, slowest.1);
}

#[test]
fn a_symbol_has_at_most_so_many_actions() {
    let actions = |count: usize| format!("F: {}\nG: move", vec!["draw"; count].join(", "));
    assert!(parse_overrides(&actions(MAX_ACTIONS)).1.is_empty());
    let text = actions(MAX_ACTIONS + 1);
    let (overrides, diagnostics) = parse_overrides(&text);
    let [diagnostic] = &diagnostics[..] else { panic!("{diagnostics:?}") };
    assert!(diagnostic.is_error());
    assert_eq!(diagnostic.message, "A symbol can have at most 256 actions");
    assert_eq!(&text[diagnostic.span.clone()], "draw");
    assert_eq!(overrides.iter().map(|o| o.actions.len()).collect::<Vec<_>>(), [MAX_ACTIONS, 1]);
}
