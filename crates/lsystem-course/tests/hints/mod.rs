//! Hints against the mistakes that caused them: every change of one symbol of ten systems, and of one number of others.

mod numbers;

use crate::naive::is_same;
use crate::naive::systems::{one_symbol_edits, systems};
use expect_test::expect_file;
use lsystem_course::{Exercise, Marker};
use lsystem_syntax::Definition;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// What a hint speaks about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Topic {
    Turn,
    Length,
    Letter,
    Number,
    Place,
    Bracket,
}

fn topics(hint: &str) -> Vec<Topic> {
    let words: [(Topic, &[&str]); 6] = [
        (Topic::Turn, &["turn", "another direction", "mirror", "upside", "too far to the", "angle"]),
        (Topic::Length, &["too short", "too long", "another length"]),
        (Topic::Letter, &["letter", " too many in the rule", "stands where"]),
        (Topic::Number, &["missing", "too many", "too few", "iteration"]),
        (Topic::Place, &["begins where"]),
        (Topic::Bracket, &["brackets"]),
    ];
    let said = |list: &[&str]| list.iter().any(|word| hint.contains(word));
    words.into_iter().filter(|(_, list)| said(list)).map(|(topic, _)| topic).collect()
}

/// The hint with numbers and letters of rules left out.
fn pattern(hint: &str) -> String {
    let numbers = hint.split(' ').map(|word| if word.starts_with(|c: char| c.is_ascii_digit()) { "N" } else { word });
    numbers
        .map(|word| if word.trim_end_matches('.').len() == 1 && !matches!(word, "N" | "A" | "a") { "*" } else { word })
        .collect::<Vec<_>>()
        .join(" ")
}

/// The first symbol that differs: what stood there and what should stand there.
fn edit(own: &str, right: &str) -> (Option<char>, Option<char>) {
    let at = own.chars().zip(right.chars()).take_while(|(a, b)| a == b).count();
    let (a, b) = (own.chars().nth(at), right.chars().nth(at));
    match own.chars().count().cmp(&right.chars().count()) {
        std::cmp::Ordering::Less => (None, b),
        std::cmp::Ordering::Equal => (a, b),
        std::cmp::Ordering::Greater => (a, None),
    }
}

#[test]
fn one_wrong_symbol_is_named_by_its_kind() {
    let mut table = BTreeMap::<String, BTreeMap<String, usize>>::new();
    let mut silent = Vec::new();
    for system in systems() {
        let target = system.segments().unwrap();
        let exercise = Exercise { target: system.definition(), ..Exercise::default() };
        let marker = Marker::new(exercise.clone()).unwrap();
        let right = &system.rules[0].1;
        for text in one_symbol_edits(right, &system.alphabet()) {
            let wrong = system.with_rule(0, text.clone());
            let Some(segments) = wrong.segments() else { continue };
            if is_same(&target, &segments) {
                continue;
            }
            let student = Definition { rules: wrong.definition().rules, ..exercise.start() };
            let Some(hint) = marker.hint(&student) else {
                silent.push(format!("{} {text}", system.name));
                continue;
            };
            let kind = |symbol: Option<char>| match symbol {
                None => "nothing",
                Some('+' | '-') => "a turn",
                Some('[' | ']') => "a bracket",
                Some(_) => "a letter",
            };
            let (less, more) = edit(&text, right);
            let name = format!("{} instead of {}", kind(less), kind(more));
            *table.entry(name.clone()).or_default().entry(pattern(&hint)).or_default() += 1;
            let topics = topics(&hint);
            let allowed: &[Topic] = match (kind(less), kind(more)) {
                ("a turn" | "nothing", "a turn") | ("a turn", "nothing") => &[Topic::Turn],
                ("a letter" | "nothing", "a letter") | ("a letter", "nothing") => {
                    &[Topic::Letter, Topic::Number, Topic::Place]
                }
                ("a turn", "a letter") | ("a letter", "a turn") => &[Topic::Turn, Topic::Letter],
                _ => &[Topic::Bracket],
            };
            let is_true = !topics.is_empty() && topics.iter().any(|topic| allowed.contains(topic));
            assert!(is_true, "{}: {text} for {right}, {name}: {hint}", system.name);
        }
    }
    let mut text = String::new();
    for (name, hints) in &table {
        writeln!(text, "{name}:").unwrap();
        for (hint, count) in hints {
            writeln!(text, "{count:5}  {hint}").unwrap();
        }
    }
    writeln!(text, "without a hint: {}", silent.len()).unwrap();
    expect_file!["table.txt"].assert_eq(&text);
}

#[test]
fn one_wrong_number_is_named_by_its_kind() {
    let lengths =
        ["A(x) -> F(x)[+A(x*0.5)][-A(x*0.6)]", "A(x) -> F(x)[+A(x*0.6)]F(x*0.3)", "A(x) -> F(x)+(30)A(x*0.7)"];
    for (rules, number, others, topic) in [
        (lengths[0], "0.5", ["0.4", "0.55", "0.9"], Topic::Length),
        (lengths[0], "0.6", ["0.3", "0.7", "1.2"], Topic::Length),
        (lengths[1], "0.6", ["0.5", "0.7", "0.9"], Topic::Length),
        (lengths[1], "0.3", ["0.1", "0.4", "2"], Topic::Length),
        (lengths[2], "0.7", ["0.6", "0.8", "1"], Topic::Length),
        (lengths[2], "30", ["20", "45", "100"], Topic::Turn),
    ] {
        let target = Definition {
            axiom: "A(1)".into(),
            rules: rules.into(),
            angle: 25.0,
            iterations: 5,
            ..Definition::default()
        };
        let exercise = Exercise { target, ..Exercise::default() };
        let marker = Marker::new(exercise.clone()).unwrap();
        for other in others {
            let rules = rules.replace(number, other);
            let hint = marker.hint(&Definition { rules: rules.clone(), ..exercise.start() }).unwrap_or_default();
            assert_eq!(topics(&hint), [topic], "{rules}: {hint}");
        }
    }
}

#[test]
fn the_way_of_a_turn_is_right() {
    let target = Definition { axiom: "A".into(), rules: "A -> F+(40)F".into(), iterations: 1, ..Definition::default() };
    let exercise = Exercise { target, ..Exercise::default() };
    let marker = Marker::new(exercise.clone()).unwrap();
    for (rules, words) in [
        (
            "A -> F+(30)F",
            "The first segment is right. The second has the right length, but points too far to the right.",
        ),
        (
            "A -> F+(50)F",
            "The first segment is right. The second has the right length, but points too far to the left.",
        ),
        ("A -> F+(40)F(2)", "The first segment is right. The second has the right direction, but is too long."),
        ("A -> F+(40)F+F", "Nothing is missing, but one segment is too many."),
        ("A -> F", "All that you draw is right, but one segment is missing."),
    ] {
        let hint = marker.hint(&Definition { rules: rules.into(), ..exercise.start() });
        assert_eq!(hint.as_deref(), Some(words), "{rules}");
    }
}
