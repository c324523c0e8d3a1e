//! Objects of scripts: the npm packages `lindenmayer` and `lindsvg`, and the presets of web pages.
//!
//! ```text
//! {axiom: 'F--F--F', rules: {F: 'F+F--F+F'}, angle: 60, iterations: 4}
//! ```
//!
//! Every object that has an axiom and rules is a system. Names of fields differ from page to page; the lists below hold
//! the usual ones.

use super::draft::Draft;
use super::literal::{Literal, literal};
use super::plain::{Plain, line_of};
use lsystem_syntax::Meter;

const AXIOM: &[&str] = &["axiom", "start", "initial", "initiator", "startsymbol", "initialstring", "omega"];
const RULES: &[&str] = &["rules", "productions", "rule", "production", "generator", "rewrites"];
const ANGLE: &[&str] = &["angle", "delta", "theta", "turn", "angledeg", "angle_deg", "turnangle", "rotation", "δ"];
const ITERATIONS: &[&str] =
    &["iterations", "n", "depth", "generations", "iteration", "order", "steps", "level", "levels", "num_iters", "gens"];
const NAME: &[&str] = &["name", "title", "label", "id"];
/// The heading at the start.
const HEADING: &[&str] = &["alpha", "startangle", "initialangle", "heading", "direction"];
const IN: &[&str] = &["predecessor", "in", "from", "symbol", "key", "input", "left", "letter", "a", "match", "before"];
const OUT: &[&str] = &[
    "successor",
    "out",
    "to",
    "value",
    "output",
    "right",
    "replace",
    "replacement",
    "b",
    "after",
    "rule",
    "string",
    "e",
];
const WEIGHT: &[&str] = &["weight", "p", "probability", "chance", "prob"];

/// The most units of work for the objects of a text.
const WORK: u64 = 1 << 22;

/// Reads every object with an axiom and rules. Our own files are not read here.
pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    let mut entries = Vec::new();
    let mut meter = Meter::new(WORK);
    let mut at = 0;
    while let Some(open) = text[at..].find('{') {
        let start = at + open;
        let Some((value, length)) = literal(&text[start..], &mut meter) else {
            // An object of code, which may hold others.
            at = start + 1;
            if meter.is_spent() {
                break;
            }
            continue;
        };
        collect(&value, name_before(&text[..start]), line_of(text, start), &mut entries);
        at = start + length;
    }
    (!entries.is_empty()).then_some(entries)
}

/// The name before an object, as in `koch: {` or `const koch = new LSystem({`.
fn name_before(text: &str) -> &str {
    let line = text.rsplit(['\n', '{', ',', ';', '[']).next().unwrap_or("");
    let name = line.trim_end().trim_end_matches('(').trim_end();
    let name = name.strip_suffix("LSystem").map_or(name, |rest| rest.trim_end().trim_end_matches("new").trim_end());
    let name = name.trim_end_matches([':', '=', ' ']);
    name.rsplit([' ', '\t', '(']).next().unwrap_or("").trim_matches(['"', '\'', '`'])
}

/// Adds the systems of a value: the object itself, or those inside.
fn collect(value: &Literal, name: &str, line: usize, entries: &mut Vec<Draft>) {
    match value {
        Literal::Object(fields) => {
            if let (Some(axiom), Some(rules)) = (field(fields, AXIOM), field(fields, RULES))
                && let Some(axiom) = axiom.text()
            {
                // Our own and the course's files have these names.
                let own = fields.iter().any(|(key, _)| matches!(key.as_str(), "initial" | "num_iters" | "angle_deg"));
                if !own {
                    entries.push(entry(fields, &axiom, rules, name, line));
                }
                return;
            }
            for (key, value) in fields {
                collect(value, key, line, entries);
            }
        }
        Literal::List(items) => items.iter().for_each(|item| collect(item, name, line, entries)),
        _ => {}
    }
}

fn field<'a>(fields: &'a [(String, Literal)], names: &[&str]) -> Option<&'a Literal> {
    let found = names.iter().find_map(|name| fields.iter().find(|(key, _)| key.to_ascii_lowercase() == **name));
    found.map(|(_, value)| value)
}

fn entry(fields: &[(String, Literal)], axiom: &str, rules: &Literal, name: &str, line: usize) -> Draft {
    let own = field(fields, NAME).and_then(Literal::text);
    let mut draft = Plain::new(own.as_deref().filter(|own| !own.is_empty()).unwrap_or(name), line);
    draft.start(axiom);
    read_rules(rules, &mut draft, line);
    // The package lindsvg counts in radians.
    let radians = field(fields, &["theta"]).is_some() && field(fields, &["alpha"]).is_some();
    match field(fields, ANGLE).map(Literal::number) {
        Some(Some((value, has_pi))) => draft.definition().angle = degrees(value, has_pi || radians),
        Some(None) => draft.draft.refuse(line, "angle", "The angle is computed by code, which is not read"),
        None => draft.draft.note(line, "", "There is no angle; 90° is taken"),
    }
    if field(fields, ANGLE).is_none() {
        draft.definition().angle = 90.0;
    }
    if let Some((value, _)) = field(fields, ITERATIONS).and_then(Literal::number) {
        draft.iterate(value);
    }
    if let Some((value, has_pi)) = field(fields, HEADING).and_then(Literal::number) {
        draft.definition().heading = degrees(value, has_pi || radians);
    }
    for (key, value) in fields {
        if *value == Literal::Code || matches!(key.as_str(), "finals" | "commands" | "actions" | "draw") {
            draft.draft.note(line, key, "Code is not read, so symbols have their usual meaning: F draws");
        }
    }
    draft.draw_something();
    draft.into_draft()
}

fn degrees(value: f64, radians: bool) -> f64 {
    let degrees = if radians { value.to_degrees() } else { value };
    // 60, not 59.99999999999999.
    let round = libm::round(degrees * 1e9) / 1e9;
    if radians { round } else { degrees }
}

/// Reads rules in any of the usual forms.
fn read_rules(rules: &Literal, draft: &mut Plain, line: usize) {
    match rules {
        Literal::Object(rules) => {
            for (predecessor, successor) in rules {
                rule(predecessor, successor, draft, line);
            }
        }
        Literal::List(items) => {
            for item in items {
                match item {
                    Literal::Object(fields) => match (field(fields, IN).and_then(Literal::text), field(fields, OUT)) {
                        (Some(predecessor), Some(_)) => rule(&predecessor, item, draft, line),
                        // Each object of a list may hold one rule.
                        _ => {
                            fields
                                .iter()
                                .for_each(|(predecessor, successor)| rule(predecessor, successor, draft, line));
                        }
                    },
                    Literal::List(pair) => match pair.as_slice() {
                        [predecessor, successor] if predecessor.text().is_some() => {
                            rule(&predecessor.text().unwrap_or_default(), successor, draft, line);
                        }
                        _ => draft.draft.refuse(line, "rules", "This rule is not a pair of predecessor and successor"),
                    },
                    Literal::Text(text) => written(text, draft, line),
                    _ => draft.draft.refuse(line, "rules", "A rule is code, which is not read"),
                }
            }
        }
        Literal::Text(text) => {
            text.split(['\n', ';']).filter(|rule| !rule.trim().is_empty()).for_each(|rule| written(rule, draft, line));
        }
        _ => draft.draft.refuse(line, "rules", "The rules are code, which is not read"),
    }
}

/// Reads a rule in one string, as in `F -> FF`, `F=FF` or `F:FF`.
fn written(text: &str, draft: &mut Plain, line: usize) {
    let arrow = ["->", "=>", "→", "=", ":"].iter().find_map(|arrow| text.split_once(arrow));
    match arrow {
        Some((predecessor, successor)) => {
            rule(predecessor.trim(), &Literal::Text(successor.trim().to_owned()), draft, line);
        }
        None => draft.draft.refuse(line, text, "This rule has no arrow"),
    }
}

/// Adds a rule. The successor is a string, an object with a weight, or a list of those to choose from at random.
fn rule(predecessor: &str, successor: &Literal, draft: &mut Plain, line: usize) {
    let mut letters = predecessor.chars();
    let (Some(letter), None) = (letters.next(), letters.next()) else {
        return draft.draft.refuse(line, predecessor, "A rule for more than one plain symbol is not read");
    };
    match successor {
        Literal::List(items)
            if items.iter().any(|item| matches!(item, Literal::Object(_) | Literal::List(_))) || several(items) =>
        {
            for item in items {
                outcome(letter, item, Some(1.0), draft, line);
            }
        }
        other => outcome(letter, other, None, draft, line),
    }
}

/// Whether a list holds several words rather than the letters of one.
fn several(items: &[Literal]) -> bool {
    items.len() > 1 && items.iter().any(|item| item.text().is_some_and(|text| text.chars().nth(1).is_some()))
}

/// Adds one outcome of a rule.
fn outcome(letter: char, successor: &Literal, weight: Option<f64>, draft: &mut Plain, line: usize) {
    let (text, weight) = match successor {
        Literal::Object(fields) => {
            let own = field(fields, WEIGHT).and_then(Literal::number).map(|(weight, _)| weight);
            (field(fields, OUT).and_then(Literal::text), own.or(weight))
        }
        Literal::List(pair) if pair.len() == 2 && pair[1].number().is_some() => {
            (pair[0].text(), pair[1].number().map(|(weight, _)| weight))
        }
        other => (other.text(), weight),
    };
    match text {
        Some(text) => {
            if text.contains('(') {
                draft.draft.note(line, &text, "Parentheses are plain symbols here");
            }
            draft.produce(letter, &text, weight);
        }
        None => draft.draft.refuse(line, &letter.to_string(), "The successor is code, which is not read"),
    }
}
