//! The text of anvaka's L-system page.
//!
//! ```text
//! axiom: X
//! rules:
//!   X => F-[[X]+X]+F[-FX]-X
//!   F => FF
//! depth: 5
//! angle: 25
//! actions:
//!   F => draw()
//!   + => rotate(-25)
//! ```

use super::draft::Draft;
use super::plain::{Plain, word};
use lsystem_syntax::decimal;
use lsystem_syntax::number::number;

/// Reads one system: lines of `key: value`, with indented lists of rules and actions.
pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    let keys: Vec<&str> = text.lines().filter_map(|line| line.split_once(':')).map(|(key, _)| key.trim()).collect();
    if !keys.contains(&"axiom") || !keys.contains(&"rules") || !text.contains("=>") {
        return None;
    }
    let mut draft = Plain::new("", 1);
    let mut part = "";
    draft.definition().angle = 90.0;
    for (at, line) in text.lines().enumerate() {
        let line_number = at + 1;
        let line = line.split("//").next().unwrap_or("");
        if line.trim().is_empty() {
            continue;
        }
        if let Some((left, right)) = line.split_once("=>") {
            let Some(symbol) = left.trim().chars().next().filter(|_| left.trim().chars().count() == 1) else {
                draft.draft.refuse(line_number, line, "Only rules and actions of one plain symbol are read");
                continue;
            };
            match part {
                "actions" => action(symbol, right.trim(), line_number, &mut draft),
                _ => draft.produce(symbol, right, None),
            }
            continue;
        }
        let Some((key, value)) = line.split_once(':') else {
            draft.draft.refuse(line_number, line, "This line is neither a rule nor a setting");
            continue;
        };
        let value = value.trim();
        match key.trim() {
            "rules" => part = "rules",
            "actions" => part = "actions",
            "axiom" => draft.grammar.axiom = word(value),
            "depth" => draft.draft.iterations(line_number, value),
            "angle" => draft.definition().angle = decimal::read(value).unwrap_or(90.0),
            "title" | "name" => value.clone_into(&mut draft.definition().name),
            "direction" => direction(value, line_number, &mut draft),
            "color" | "width" | "stepsPerFrame" | "position" | "size" | "animate" => {}
            other => draft.draft.note(line_number, other, "This setting has no meaning here"),
        }
    }
    Some(vec![draft.into_draft()])
}

/// The direction at the start, as `[0, 1, 0]`.
fn direction(value: &str, line: usize, draft: &mut Plain) {
    let numbers: Vec<f64> =
        value.trim_matches(['[', ']']).split(',').filter_map(|part| decimal::read(part.trim())).collect();
    match numbers[..] {
        [x, y, 0.0] | [x, y] if x != 0.0 || y != 0.0 => draft.definition().heading = libm::atan2(y, x).to_degrees(),
        _ => draft.draft.refuse(line, value, "The direction at the start must lie in the plane"),
    }
}

/// The actions of a symbol.
fn action(symbol: char, code: &str, line: usize, draft: &mut Plain) {
    let (name, inside) = code.split_once('(').unwrap_or((code, ""));
    let argument = inside.trim_end_matches([')', ';', ' ']);
    let value = decimal::read(argument);
    let with = |words: &str| value.map_or(words.to_owned(), |value| format!("{words} {}", number(value)));
    let turn = |left: &str, right: &str, default: f64| {
        let value = value.unwrap_or(default);
        format!("{} {}", if value < 0.0 { right } else { left }, number(value.abs()))
    };
    let angle = draft.definition().angle;
    let actions = match name.trim() {
        "draw" => with("draw"),
        "move" => with("move"),
        "push" => "open branch".to_owned(),
        "pop" => "close branch".to_owned(),
        "rotate" | "rotateZ" => turn("turn left", "turn right", angle),
        "rotateX" => turn("pitch down", "pitch up", angle),
        "rotateY" => turn("roll left", "roll right", angle),
        _ => return draft.draft.refuse(line, code, "This action cannot be expressed"),
    };
    draft.draft.meaning(symbol, actions);
}
