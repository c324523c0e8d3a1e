//! Writing systems as JSON files; the format is described where it is read.

use super::read_json;
use lsystem_syntax::number::number;
use lsystem_syntax::{Definition, Dialect, Grammar, Module, Production, Style, parse};

/// A file that reads back as `definition`, ending with a newline: in the course's form where that can say all of it,
/// in ours otherwise.
#[must_use]
pub fn write_json(definition: &Definition) -> String {
    if definition.dialect == Dialect::EveryLetter && definition.style == Style::course() {
        let (grammar, _) = parse(&definition.axiom, &definition.rules);
        let text = course_form(definition, &grammar);
        // Reading it back is the one sure test that nothing is lost, comments and spacing of the rules included.
        if read_json(&text).0.as_ref() == Some(definition) {
            return text;
        }
    }
    our_form(definition)
}

fn course_form(definition: &Definition, grammar: &Grammar) -> String {
    // Productions of one symbol that stand apart give a key twice; reading that back tells.
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
    let usual = Definition::default();
    let mut members = vec![("dialect", string(definition.dialect.name()))];
    let angles = [
        ("right_angle_deg", definition.right_angle),
        ("pitch_down_deg", definition.pitch_down),
        ("pitch_up_deg", definition.pitch_up),
        ("roll_left_deg", definition.roll_left),
        ("roll_right_deg", definition.roll_right),
    ];
    members.extend(angles.into_iter().filter_map(|(key, angle)| Some((key, json_number(angle?)))));
    if definition.heading != usual.heading {
        members.push(("heading_deg", json_number(definition.heading)));
    }
    if definition.step != usual.step {
        members.push(("step", json_number(definition.step)));
    }
    if definition.start != usual.start {
        members.push(("start", format!("[{}]", definition.start.map(json_number).join(", "))));
    }
    if definition.tropism != usual.tropism {
        members.push(("tropism", format!("[{}]", definition.tropism.map(json_number).join(", "))));
    }
    for (key, value, usual) in [
        ("elasticity", definition.elasticity, usual.elasticity),
        ("length_factor", definition.length_factor, usual.length_factor),
        ("angle_variation", definition.angle_variation, usual.angle_variation),
        ("length_variation", definition.length_variation, usual.length_variation),
        ("growth", definition.growth, usual.growth),
    ] {
        if value != usual {
            members.push((key, json_number(value)));
        }
    }
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
    let (style, usual) = (&definition.style, Style::for_dialect(definition.dialect));
    let mut members = Vec::new();
    if style.palette != usual.palette {
        let colours: Vec<String> = style.palette.iter().map(|&c| string(&String::from(c))).collect();
        members.push(("palette", format!("[{}]", colours.join(", "))));
    }
    if style.colour_by != usual.colour_by {
        members.push(("colour_by", string(style.colour_by.name())));
    }
    if style.palette_holds != usual.palette_holds {
        members.push(("palette_holds", style.palette_holds.to_string()));
    }
    if style.turn_colours != usual.turn_colours {
        let [left, right] = style.turn_colours;
        members.push(("turn_colours", format!("[{left}, {right}]")));
    }
    if style.background != usual.background {
        members.push(("background", string(&String::from(style.background))));
    }
    if style.width != usual.width {
        members.push(("width", json_number(style.width)));
    }
    if style.width_factor != usual.width_factor {
        members.push(("width_factor", json_number(style.width_factor)));
    }
    if style.min_width != usual.min_width {
        members.push(("min_width", json_number(style.min_width)));
    }
    if style.ink != usual.ink {
        members.push(("ink", string(style.ink.name())));
    }
    if style.exposure != usual.exposure {
        members.push(("exposure", json_number(style.exposure)));
    }
    members
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

/// An object, a member a line. `members` are keys and values already written.
fn object<K: AsRef<str>>(members: impl IntoIterator<Item = (K, String)>) -> String {
    block('{', members.into_iter().map(|(key, value)| format!("{}: {value}", string(key.as_ref()))), '}')
}

/// A list, an element a line.
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

fn string(text: &str) -> String {
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

/// JSON has no infinities: a definition with one is no system and does not read back.
fn json_number(value: f64) -> String {
    if value.is_finite() { number(value) } else { "null".to_owned() }
}
