//! Hints and scores for one wrong number in rules: whoever follows them comes nearer, step by step.

use expect_test::expect_file;
use lsystem_course::{Exercise, Marker};
use lsystem_syntax::Definition;
use serde_json::Value;
use std::fmt::Write as _;

/// The lesson's exercise with numbers, and trees of the gallery.
const SYSTEMS: [&str; 4] = [
    include_str!("../../../../www/exercises.json"),
    include_str!("../../../../data_in/abop/2.6a.json"),
    include_str!("../../../../data_in/abop/2.7b.json"),
    include_str!("../../../../data_in/abop/2.8a.json"),
];
/// The derivation steps: enough for every number to matter.
const STEPS: u32 = 3;
/// Wrong numbers, as parts of the right one: from below and from above, nearer and nearer.
const PARTS: [[f64; 2]; 2] = [[0.7, 0.9], [1.25, 1.1]];

fn definition(text: &str) -> Definition {
    let file: Value = serde_json::from_str(text).unwrap();
    let exercise = file.as_array().and_then(|all| all.iter().find(|one| one["id"] == "lesson-numbers"));
    let system = exercise.map_or(&file, |one| &one["target"]);
    let field = |names: [&str; 2]| names.into_iter().map(|name| &system[name]).find(|value| !value.is_null()).unwrap();
    let rules = &system["rules"];
    let lines = || rules.as_array().unwrap().iter().filter_map(Value::as_str).collect::<Vec<_>>().join("\n");
    let tropism = system["turtle"]["elasticity"].as_f64().unwrap_or_default();
    Definition {
        name: exercise.map_or_else(|| system["name"].as_str().unwrap(), |one| one["id"].as_str().unwrap()).into(),
        axiom: field(["initial", "axiom"]).as_str().unwrap().into(),
        angle: field(["angle_deg", "angle"]).as_f64().unwrap(),
        rules: rules.as_str().map_or_else(lines, str::to_owned),
        iterations: STEPS,
        elasticity: tropism,
        ..Definition::default()
    }
}

/// The numbers in rules, and what stands before and after each.
fn numbers(rules: &str) -> Vec<(&str, &str, &str)> {
    let is_part = |c: char| c.is_ascii_digit() || c == '.';
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(start) = rules[at..].find(is_part).map(|start| at + start) {
        at = rules[start..].find(|c| !is_part(c)).map_or(rules.len(), |end| start + end);
        if !rules[..start].ends_with(|c: char| c.is_alphanumeric()) {
            found.push((&rules[..start], &rules[start..at], &rules[at..]));
        }
    }
    found
}

#[test]
fn who_follows_a_hint_about_a_number_comes_nearer() {
    let mut table = String::new();
    for target in SYSTEMS.map(definition) {
        let (name, right) = (target.name.clone(), target.rules.clone());
        let exercise = Exercise { target, ..Exercise::default() };
        let mut marker = Marker::new(exercise.clone()).unwrap();
        let repeated = numbers(&right).into_iter().filter(|(_, number, after)| after.contains(*number));
        let repeated = repeated.map(|(_, number, _)| ("", number, "")).collect::<Vec<_>>();
        for (before, number, after) in numbers(&right).into_iter().chain(repeated) {
            let value: f64 = number.parse().unwrap();
            for parts in PARTS {
                let mut former = 0.0;
                for part in parts {
                    let other = (value * part * 1e6).round() / 1e6;
                    let rules = match (before, after) {
                        ("", "") => right.replace(number, &other.to_string()),
                        _ => format!("{before}{other}{after}"),
                    };
                    let student = Definition { rules: rules.clone(), ..exercise.start() };
                    let mark = marker.mark(&student);
                    if mark.is_solved {
                        continue;
                    }
                    let hint = marker.hint(&student).unwrap_or_default();
                    writeln!(table, "{name:18} {number:>7} {other:>9} {:>7}  {hint}", mark.percent()).unwrap();
                    // Some turns about the heading show in no angle between two segments: then no way is told.
                    if let Some((_, advice)) = hint.split_once("Try a ") {
                        let (way, named) = advice.trim_end_matches('.').split_once(" number than ").unwrap();
                        let is_named = named == other.to_string();
                        assert!(!is_named || (way == "larger") == (part < 1.0), "{name}: {rules}: {hint}");
                        let next = named.parse::<f64>().unwrap() * if way == "larger" { 1.1 } else { 0.9 };
                        let all = [rules.replace(named, &next.to_string())];
                        let alone = numbers(&rules).into_iter().filter(|number| number.1 == named);
                        let alone = alone.map(|(before, _, after)| format!("{before}{next}{after}"));
                        let follows = |rules| marker.mark(&Definition { rules, ..student.clone() }).agreement;
                        let followed = all.into_iter().chain(alone).map(follows).fold(0.0, f64::max);
                        assert!(is_named || followed > mark.agreement, "{name}: {rules}: {hint}: {followed}");
                        assert!(mark.agreement > former, "{name}: {rules}: {} after {former}", mark.agreement);
                    } else {
                        let ways = ["direction, but is too", "too far"];
                        assert!(!ways.iter().any(|way| hint.contains(way)), "{name}: {rules}: {hint}");
                    }
                    former = mark.agreement;
                }
            }
        }
    }
    expect_file!["numbers.txt"].assert_eq(&table);
}
