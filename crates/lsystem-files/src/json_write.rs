//! Writing systems as JSON files. `json.rs` describes the format.

use super::read_json;
use lsystem_base::number::number;
use lsystem_syntax::fields::Section;
use lsystem_syntax::{Definition, Dialect, FIELDS, Grammar, Module, Production, Style, Value, parse};

/// A JSON text that reads back as `definition`, ending with a newline. The text is a course file if such a file can
/// hold the whole definition.
#[must_use]
pub fn write_json(definition: &Definition) -> String {
    if definition.dialect == Dialect::EveryLetter && definition.style == Style::course() {
        let (grammar, _) = parse(&definition.axiom, &definition.rules);
        let text = course_form(definition, &grammar);
        // Reading the text back proves that nothing is lost, including comments and spacing of the rules.
        if read_json(&text).0.as_ref() == Some(definition) {
            return text;
        }
    }
    our_form(definition)
}

fn course_form(definition: &Definition, grammar: &Grammar) -> String {
    // Productions of one symbol that are not adjacent give a repeated key. Such a text does not read back as the same.
    let groups = grammar.productions.chunk_by(|a, b| a.predecessor == b.predecessor);
    let text = |modules: &[Module]| string(&modules.iter().map(|m| m.symbol).collect::<String>());
    let rules = groups.map(|group| {
        let value = match group {
            [Production { weight: None, successor, .. }] => text(successor),
            _ => list(group.iter().map(|p| {
                let weight = p.weight.as_ref().and_then(|weight| grammar.value(weight)).unwrap_or(1.0);
                format!("{{\"p\": {}, \"e\": {}}}", json_number(weight), text(&p.successor))
            })),
        };
        (group[0].predecessor.symbol.to_string(), value)
    });
    let mut members = words(definition);
    let stochastic = grammar.productions.iter().any(|p| p.weight.is_some());
    members.push(("stochastic", stochastic.to_string()));
    members.push(("initial", text(&grammar.axiom)));
    members.extend(numbers(definition));
    members.push(("rules", object(rules)));
    members.extend(seed(definition));
    file(members)
}

fn our_form(definition: &Definition) -> String {
    let mut members = words(definition);
    members.push(("initial", string(&definition.axiom)));
    members.extend(numbers(definition));
    members.push(("rules", lines(&definition.rules)));
    members.extend(seed(definition));
    members.push(("turtle", turtle(definition)));
    let style = style(definition);
    if !style.is_empty() {
        members.push(("style", object(style)));
    }
    file(members)
}

fn turtle(definition: &Definition) -> String {
    let mut members = vec![("dialect", string(definition.dialect.name()))];
    members.extend(changed_fields(definition, &Definition::default(), Section::Turtle, &["dialect", "overrides"]));
    if !definition.overrides.is_empty() {
        let overrides = lsystem_syntax::overrides::entries(&definition.overrides);
        members.push(match overrides {
            Some(entries) => ("overrides", object(entries.iter().map(|(s, text)| (s.to_string(), string(text))))),
            None => ("overrides", lines(&definition.overrides)),
        });
    }
    object(members)
}

fn style(definition: &Definition) -> Vec<(&'static str, String)> {
    let usual = Definition { style: Style::for_dialect(definition.dialect), ..Definition::default() };
    changed_fields(definition, &usual, Section::Style, &[])
}

/// The fields of an object that differ from `usual`, except those named in `omitted`.
fn changed_fields(
    definition: &Definition,
    usual: &Definition,
    section: Section,
    omitted: &[&str],
) -> Vec<(&'static str, String)> {
    let here = FIELDS.iter().filter_map(|spec| Some((spec, spec.file?)));
    here.filter(|(spec, (place, _))| *place == section && !omitted.contains(&spec.name))
        .filter_map(|(spec, (_, key))| Some((key, spec.get(definition)?, spec.get(usual)?)))
        .filter(|(_, value, usual)| value != usual)
        .map(|(key, value, _)| (key, written(&value)))
        .collect()
}

/// A value of a field as JSON.
pub(super) fn written(value: &Value) -> String {
    match value {
        Value::Nothing => "null".to_owned(),
        Value::Flag(flag) => flag.to_string(),
        Value::Number(number) => json_number(*number),
        Value::Text(text) => string(text),
        Value::List(list) => format!("[{}]", list.iter().map(written).collect::<Vec<_>>().join(", ")),
    }
}

fn words(definition: &Definition) -> Vec<(&'static str, String)> {
    let mut members = vec![("name", string(&definition.name))];
    let others = [("title", &definition.title), ("source", &definition.source), ("notes", &definition.notes)];
    members.extend(others.into_iter().filter(|(_, text)| !text.is_empty()).map(|(key, text)| (key, string(text))));
    members
}

fn numbers(definition: &Definition) -> [(&'static str, String); 2] {
    [("angle_deg", json_number(definition.angle)), ("num_iters", definition.iterations.to_string())]
}

fn seed(definition: &Definition) -> Option<(&'static str, String)> {
    (definition.seed != 0).then(|| ("seed", definition.seed.to_string()))
}

fn file(members: Vec<(&'static str, String)>) -> String {
    let mut text = object(members);
    text.push('\n');
    text
}

/// An object with one member on each line. `members` are keys and values as JSON.
fn object<K: AsRef<str>>(members: impl IntoIterator<Item = (K, String)>) -> String {
    block('{', members.into_iter().map(|(key, value)| format!("{}: {value}", string(key.as_ref()))), '}')
}

/// A list with one element on each line.
fn list(elements: impl Iterator<Item = String>) -> String {
    block('[', elements, ']')
}

/// A text as the list of its lines.
fn lines(text: &str) -> String {
    if text.is_empty() { "[]".to_owned() } else { list(text.split('\n').map(string)) }
}

fn block(open: char, parts: impl Iterator<Item = String>, close: char) -> String {
    let mut text = String::from(open);
    for (at, part) in parts.enumerate() {
        text.push_str(if at == 0 { "\n" } else { ",\n" });
        for (at, line) in part.split('\n').enumerate() {
            text.push_str(if at == 0 { "  " } else { "\n  " });
            text.push_str(line);
        }
    }
    if text.len() > 1 {
        text.push('\n');
    }
    text.push(close);
    text
}

pub(super) fn string(text: &str) -> String {
    let mut out = String::from('"');
    for ch in text.chars() {
        match ch {
            '"' | '\\' => out.extend(['\\', ch]),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            '\0'..='\u{1f}' | '\u{7f}' => out.push_str(&format!("\\u{:04x}", u32::from(ch))),
            _ => out.push(ch),
        }
    }
    out.push('"');
    out
}

/// A number as JSON. JSON has no infinities: a definition with one is invalid, and its text does not read back.
pub(super) fn json_number(value: f64) -> String {
    if value.is_finite() { number(value) } else { "null".to_owned() }
}
