//! The text form of anvaka's L-system page.
//!
//! ```text
//! axiom: X
//! rules:
//!   X => F+[X]
//! depth: 4
//! angle: 25
//! actions:
//!   F => draw(10)
//!   + => rotate(-90)
//! ```
//!
//! The turtle starts to the right. `rotate` turns to the left by degrees. Without other actions F draws 10, f moves 10,
//! and + and - turn by the angle, which is 60 if it is missing; the depth is 5 if it is missing. Of several rules for a
//! symbol the last one counts.

use crate::draft::{Draft, production};
use crate::rules::split_rule;
use lsystem_base::decimal;
use lsystem_base::number::number;
use lsystem_syntax::{Grammar, Module};

/// The keys, in lower case. All other lines with a colon are rules or actions.
const KEYS: [&str; 12] = [
    "axiom",
    "start",
    "rules",
    "production rules",
    "actions",
    "depth",
    "angle",
    "width",
    "color",
    "stepsperframe",
    "direction",
    "position",
];

/// Keys that only this page has.
const OWN: [&str; 5] = ["depth", "actions", "stepsperframe", "direction", "position"];

/// The key and the value of a line such as `axiom: X`.
fn key(line: &str) -> Option<(String, &str)> {
    let (key, value) = line.split_once(':')?;
    let key = key.trim().to_ascii_lowercase();
    KEYS.contains(&key.as_str()).then_some((key, value.trim()))
}

pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    let keys: Vec<(String, &str)> = text.lines().filter_map(key).collect();
    let has = |names: &[&str]| keys.iter().any(|(key, _)| names.contains(&key.as_str()));
    let header =
        keys.iter().any(|(key, value)| matches!(key.as_str(), "rules" | "production rules") && value.is_empty());
    if !has(&["axiom", "start"]) || !header || !(has(&OWN) || text.contains("=>")) {
        return None;
    }
    let mut draft = Draft::new("", 1);
    let title = text.lines().find_map(|line| line.trim().strip_prefix("//"));
    draft.definition.name = title.unwrap_or_default().trim().chars().take(200).collect();
    system(text, &mut draft);
    Some(vec![draft])
}

fn system(text: &str, draft: &mut Draft) {
    let mut grammar = Grammar::default();
    let mut section = String::new();
    let word = |text: &str| text.chars().filter(|c| !c.is_whitespace()).collect::<Vec<char>>();
    (draft.definition.angle, draft.definition.heading, draft.definition.step) = (60.0, 0.0, 10.0);
    (draft.definition.iterations, draft.has_iterations) = (5, true);
    draft.others = Some("");
    for (symbol, actions) in [('F', "draw"), ('f', "move"), ('+', "turn left"), ('-', "turn right")] {
        draft.meaning(symbol, actions);
    }
    draft.meaning('[', "open branch");
    draft.meaning(']', "close branch");
    let mut space = Vec::new();
    for (at, line) in text.lines().enumerate().map(|(at, line)| (at + 1, line.trim())) {
        if line.is_empty() || line.starts_with("//") {
            continue;
        }
        if let Some((key, value)) = key(line) {
            section.clear();
            match key.as_str() {
                "axiom" | "start" => grammar.axiom = word(value).into_iter().map(Module::from).collect(),
                "depth" => draft.iterations(at, value),
                "angle" => match decimal::read(value) {
                    Some(angle) => draft.definition.angle = angle,
                    None => draft.refuse(at, line, "The angle is not a number"),
                },
                "direction" => direction(value, at, draft),
                "rules" | "production rules" => section = "rules".into(),
                "actions" => section = key,
                _ => draft.note(at, line, "This is not carried over"),
            }
            if !value.is_empty() && !section.is_empty() {
                draft.refuse(at, line, "A rule or an action must stand on a line of its own");
            }
            continue;
        }
        let Some((from, to)) = split_rule(line).filter(|_| !section.is_empty()) else {
            draft.refuse(at, line, "This line cannot be read");
            continue;
        };
        let mut letters = from.chars();
        let (Some(symbol), None) = (letters.next(), letters.next()) else {
            draft.refuse(at, line, "The left side must be one symbol");
            continue;
        };
        if section == "rules" {
            let before = grammar.productions.len();
            grammar.productions.retain(|rule| rule.predecessor.symbol != symbol);
            if grammar.productions.len() < before {
                draft.note(at, line, "This rule replaces an earlier one for the same symbol");
            }
            grammar.productions.push(production(symbol, word(to)));
        } else {
            match action(to) {
                Ok(actions) => draft.meaning(symbol, actions),
                Err(true) => space.push((at, line, symbol)),
                Err(false) => draft.refuse(at, line, "This action cannot be read"),
            }
        }
        if draft.is_refused() && grammar.productions.len() > 1000 {
            break;
        }
    }
    for (at, line, symbol) in space {
        if grammar.made().any(|module| module.symbol == symbol) {
            draft.refuse(at, line, "This turns about a fixed axis of space; our turtle turns about its own axes");
        }
    }
    draft.grammar(&grammar);
}

/// The words for an action such as `rotate(90)`; an error for another one, true for turns in space.
fn action(text: &str) -> Result<String, bool> {
    let (name, rest) = text.split_once('(').ok_or(false)?;
    let argument = rest.trim_end().strip_suffix(')').ok_or(false)?.trim();
    let value = if argument.is_empty() { None } else { Some(decimal::read(argument).ok_or(false)?) };
    let length = |word: &str| match value {
        None | Some(10.0) => word.to_owned(),
        Some(length) => format!("{word} {}", number(length)),
    };
    match (name.trim(), value) {
        ("draw", _) => Ok(length("draw")),
        ("move", _) => Ok(length("move")),
        ("push", None) => Ok("open branch".into()),
        ("pop", None) => Ok("close branch".into()),
        ("rotateX" | "rotateY", Some(0.0)) => Ok(String::new()),
        ("rotateX" | "rotateY", Some(_)) => Err(true),
        ("rotate" | "rotateZ", Some(angle)) if angle < 0.0 => Ok(format!("turn right {}", number(-angle))),
        ("rotate" | "rotateZ", Some(angle)) => Ok(format!("turn left {}", number(angle))),
        _ => Err(false),
    }
}

fn direction(value: &str, line: usize, draft: &mut Draft) {
    let numbers = value.trim_matches(['[', ']', ' ']).split(',').map(|part| decimal::read(part.trim()));
    match numbers.collect::<Option<Vec<f64>>>().as_deref() {
        Some([x, y] | [x, y, 0.0]) if (*x != 0.0 || *y != 0.0) && x.is_finite() && y.is_finite() => {
            let degrees = libm::atan2(*y, *x).to_degrees();
            draft.definition.heading = libm::round(degrees * 1e9) / 1e9;
        }
        _ => draft.refuse(line, value, "The direction must be in the plane, such as 0, 1, 0"),
    }
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cases() {
        check(
            "// dragon\naxiom: X\nrules: \n X => X+YF+\n Y => -FX-Y\n\ndepth: 10\nangle: 90",
            expect![[r#"
                anvaka’s page
                [dragon]
                n 10, angle 90, heading 0, abop, step 10
                  X
                  X -> X+YF+
                  Y -> -FX-Y"#]],
        );
        check(
            "axiom: F^F\nrules:\n  F => F f&[F]\n  f =>\ncolor: #ff0000\nstepsPerFrame: 10\ndirection: [0, 1, 0]\nactions:\n  F => draw()\n  f => move(5)\n  - => rotate(-90)\n  ^ => rotate(60)\n  & => rotate(-60.5)",
            expect![[r#"
                anvaka’s page
                []
                n 5, angle 60, heading 90, abop, step 10
                  F^F
                  F -> Ff&[F]
                  f -> *
                  | &: turn right 60.5
                  | ^: turn left 60
                  | f: move 5
                note 5 "color: #ff0000": This is not carried over
                note 6 "stepsPerFrame: 10": This is not carried over"#]],
        );
        check(
            "axiom: F\nrules:\n F -> F+F\n F -> FF\nactions:\n + => rotateX(10)\n - => jump(3)",
            expect![[r#"
                anvaka’s page
                []
                note 4 "F -> FF": This rule replaces an earlier one for the same symbol
                refused 7 "- => jump(3)": This action cannot be read"#]],
        );
        check(
            "axiom: F\nrules:\n F -> F+F\n",
            expect![[r#"
                a description
                []
                n 13, angle 90, heading 90, abop
                  F
                  F -> F+F
                note 1 "": There is no angle; 90° is taken
                note 1 "": The text gives no number of iterations; 13 is chosen by the size"#]],
        );
    }
}
