//! New values in the text of a JSON file. The rest of the text stays: comments, keys of others, order and layout.

use jsonc_parser::ast::Value as Json;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};
use lsystem::Definition;
use lsystem::base::number::number;
use lsystem::syntax::fields::Section;
use lsystem::syntax::{FIELDS, Value};
use lsystem::{read_json, write_json};
use std::ops::Range;

/// The text of a file with the system `definition`: `text` with the values that are new, or a new text if that would not
/// read back as the same system.
pub(super) fn rewrite(text: &str, definition: &Definition) -> String {
    let edited = edited(text, definition).filter(|edited| read_json(edited).0.as_ref() == Some(definition));
    edited.unwrap_or_else(|| write_json(definition))
}

fn edited(text: &str, definition: &Definition) -> Option<String> {
    let former = read_json(text).0?;
    let parsed = parse_to_ast(text, &CollectOptions::default(), &ParseOptions::default()).ok()?;
    let Some(Json::Object(file)) = &parsed.value else { return None };
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    for spec in &FIELDS {
        let values = (spec.file, spec.get(&former), spec.get(definition));
        let (Some((section, key)), Some(old), Some(new)) = values else { continue };
        if old == new {
            continue;
        }
        let object = match section {
            Section::File => file,
            // A file without these objects has other defaults.
            Section::Turtle => file.get_object("turtle")?,
            Section::Style => file.get_object("style")?,
        };
        let is_lines = matches!(spec.name, "rules" | "overrides");
        edits.push(match object.get(key) {
            Some(property) => {
                let range = property.value.range();
                (range.start..range.end, written(&new, is_lines, &line_start(text, property.range.start))?)
            }
            None => {
                let last = object.properties.last()?;
                let start = line_start(text, last.range.start);
                let value = written(&new, is_lines, &start)?;
                let gap = if start.is_empty() { " " } else { &start };
                (last.range.end..last.range.end, format!(",{gap}\"{key}\": {value}"))
            }
        });
    }
    // From the end, so that places stay right; new members of an object keep their order.
    edits.sort_by_key(|(range, _)| range.start);
    let mut edited = text.to_owned();
    for (range, value) in edits.into_iter().rev() {
        edited.replace_range(range, &value);
    }
    Some(edited)
}

/// The line break and the indentation before a member that begins a line; empty for other members.
fn line_start(text: &str, start: usize) -> String {
    let indent = text.get(..start).and_then(|before| before.rsplit_once('\n')).map(|(_, indent)| indent);
    let indent = indent.filter(|indent| indent.bytes().all(|byte| byte == b' ' || byte == b'\t'));
    indent.map_or_else(String::new, |indent| format!("\n{indent}"))
}

/// A value as JSON; a text of lines as their list, with each line on its own.
fn written(value: &Value, is_lines: bool, line_start: &str) -> Option<String> {
    let text = match value {
        Value::Text(text) if is_lines => text,
        _ => return json(value),
    };
    let lines = text.split('\n').filter(|_| !text.is_empty()).map(serde_json::to_string);
    let lines = lines.collect::<Result<Vec<_>, _>>().ok()?;
    Some(match (&lines[..], line_start) {
        ([] | [_], _) | (_, "") => format!("[{}]", lines.join(", ")),
        _ => format!("[{line_start}  {}{line_start}]", lines.join(&format!(",{line_start}  "))),
    })
}

/// A value as JSON on one line.
fn json(value: &Value) -> Option<String> {
    match value {
        Value::Number(value) => Some(number(*value)),
        Value::List(list) => Some(format!("[{}]", list.iter().map(json).collect::<Option<Vec<_>>>()?.join(", "))),
        _ => serde_json::to_string(value).ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use expect_test::{Expect, expect};

    fn check(text: &str, change: impl Fn(&mut Definition), expected: &Expect) {
        let mut definition = read_json(text).0.unwrap();
        assert_eq!(rewrite(text, &definition), text, "nothing is new");
        change(&mut definition);
        let changed = rewrite(text, &definition);
        assert_eq!(read_json(&changed).0, Some(definition));
        expected.assert_eq(&changed);
    }

    #[test]
    fn only_new_values_are_written() {
        let text = r##"{
    // my first plant
    "initial": "X", "angle_deg": 20.0, /* degrees */
    "rules": ["X -> F[+X]"],
    "num_iters": 4,
    "author": "Ada",
    "turtle": {},
}
"##;
        check(
            text,
            |plant| {
                plant.angle = 22.5;
                plant.rules = "X -> F[+X]F\nF -> FF".into();
                plant.seed = 7;
                plant.title = "A \"plant\"".into();
            },
            &expect![[r#"
                {
                    // my first plant
                    "initial": "X", "angle_deg": 22.5, /* degrees */
                    "rules": [
                      "X -> F[+X]F",
                      "F -> FF"
                    ],
                    "num_iters": 4,
                    "author": "Ada",
                    "turtle": {},
                    "title": "A \"plant\"",
                    "seed": 7,
                }
            "#]],
        );
        let course = r#"{"initial": "F", "angle_deg": 90, "num_iters": 3, "rules": {"F": "F+F"}, "group": 4}"#;
        check(
            course,
            |plant| plant.iterations = 5,
            &expect![[r#"{"initial": "F", "angle_deg": 90, "num_iters": 5, "rules": {"F": "F+F"}, "group": 4}"#]],
        );
    }

    #[test]
    fn a_text_that_cannot_hold_the_system_is_written_anew() {
        let course = r#"{"initial": "F", "angle_deg": 90, "num_iters": 3, "rules": {"F": "F+F"}, "group": 4}"#;
        let mut plant = read_json(course).0.unwrap();
        plant.heading = 0.0;
        assert_eq!(rewrite(course, &plant), write_json(&plant));
        for broken in ["", "[]", "{", "{\"rules\": 3}", "\u{feff}{}"] {
            assert_eq!(rewrite(broken, &plant), write_json(&plant), "{broken}");
        }
    }
}
