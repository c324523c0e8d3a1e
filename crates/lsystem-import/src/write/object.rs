//! An object of JavaScript, as packages and web pages have it: `F` and `G` draw, `f` moves, `+` and `-` turn, `|` turns
//! round, `[` and `]` branch, and the turtle starts upwards.

use super::Refusal;
use super::source::{Need, Source};
use super::spelling::{Alphabet, Spelling, turns};
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_syntax::Action;

/// The parts of systems that these objects express beside plain words of a turtle in the plane.
pub(super) const SPEAKS: &[Need] = &[Need::Chance];

/// The letters without a meaning, the best first.
const IDLE: &str = "XYZABCDEHIJKLMNOPQRSTUVWabcdehijklmnopqrstuvwxyz";

/// The usual symbols.
pub(super) fn spelling(source: &Source<'_>, label: &str) -> Result<(Spelling, String), Refusal> {
    let angle = source.definition.angle;
    if source.right_angle() != angle && source.acts(|action| action == Action::TurnRight(None)) {
        return Err(Refusal(say!("{} has one angle for turns to the left and to the right", label)));
    }
    let own = |action: Action| match action {
        Action::TurnLeft(None) => "+",
        Action::TurnRight(None) => "-",
        Action::TurnRound => "|",
        _ => "",
    };
    let code = |action: Action| match action {
        Action::TurnRound => Some("|".to_owned()),
        other => turns(source.turn(other)?, (angle, '+'), (angle, '-')),
    };
    let alphabet = Alphabet {
        label,
        idle: IDLE,
        is_upper: false,
        steps: ["FG", "f"],
        own: &own,
        code: &code,
        mortal: "Ff",
        fixed: "",
    };
    let spelling = Spelling::new(source, &alphabet)?;
    let start = turns(source.definition.heading - 90.0, (angle, '+'), (angle, '-'));
    let start = start.filter(|start| spelling.stays(source, start));
    let start = start.ok_or_else(|| Refusal(say!("{} starts upwards, and turns by its angle only", label)))?;
    Ok((spelling, start))
}

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let (spelling, start) = spelling(source, &say!("A JavaScript object"))?;
    let axiom = format!("{start}{}", spelling.word(&source.grammar.axiom));
    let rules = spelling.rules(source);
    if !rules.iter().flat_map(|rule| rule.1.iter()).any(|(_, word)| word.contains(['F', 'G']))
        && !axiom.contains(['F', 'G'])
    {
        return Err(Refusal::new(say!("Nothing is drawn, and an object has no symbol that says so")));
    }
    let angle = source.definition.angle;
    // Programs take small broken numbers for radians.
    let angle = if angle.abs() < 7.0 && angle.fract() != 0.0 {
        format!("{} * Math.PI / 180", number(angle))
    } else {
        number(angle)
    };
    // Packages take an empty successor for none: a letter without a meaning and a rule stands for it.
    let successors = || rules.iter().flat_map(|(_, successors)| successors);
    let is_free = |letter: &char| {
        let is_name = rules.iter().any(|(name, _)| name == letter);
        !is_name && !axiom.contains(*letter) && !successors().any(|(_, word)| word.contains(*letter))
    };
    let nothing = IDLE.chars().find(is_free).map(String::from).unwrap_or_default();
    let mut text = String::new();
    let title = source.title(&[]);
    if !title.is_empty() {
        let _ = writeln!(text, "// {title}");
    }
    text.push_str("// F and G draw, f moves, + turns left, - turns right; the first heading is up.\n");
    let _ = writeln!(text, "const lsystem = {{\n    axiom: {},\n    productions: {{", quoted(&axiom));
    for (name, successors) in &rules {
        let _ = writeln!(text, "        {}: {},", quoted(&name.to_string()), choices(successors, &nothing));
    }
    let _ = writeln!(text, "    }},\n    angle: {angle},\n    iterations: {},\n}};", source.definition.iterations);
    Ok(text)
}

/// A successor, or several with weights; `nothing` stands for empty ones.
fn choices(successors: &[(f64, String)], nothing: &str) -> String {
    let word = |word: &str| quoted(if word.is_empty() { nothing } else { word });
    if let [(_, only)] = successors {
        return word(only);
    }
    let one = |(weight, own): &(f64, String)| format!("{{ weight: {}, successor: {} }}", number(*weight), word(own));
    format!("{{ successors: [{}] }}", successors.iter().map(one).collect::<Vec<_>>().join(", "))
}

/// A string of JavaScript or Python.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() || matches!(c, '\u{2028}' | '\u{2029}') => {
                let _ = write!(out, "\\u{:04x}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
