//! An object of JavaScript, as packages and web pages have it: `F` and `G` draw, `f` moves, `+` and `-` turn, `|` turns
//! round, `[` and `]` branch, and the turtle starts upwards.

use super::Refusal;
use super::source::{Need, PlainRule, Source};
use super::spelling::{Alphabet, Spelling, turns};
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_syntax::{Action, Module};

/// The parts of systems that such objects lack.
pub(super) const LACKS: &[Need] = &[
    Need::Contexts,
    Need::Parameters,
    Need::Variation,
    Need::Images,
    Need::Space,
    Need::BranchLengths,
    Need::Scaling,
    Need::SwappedTurns,
    Need::Polygons,
    Need::Circles,
    Need::Tubes,
    Need::Surfaces,
    Need::Cuts,
    Need::Tropism,
    Need::Growth,
    Need::OpenBranches,
];

/// The usual symbols.
pub(super) fn spelling(source: &Source<'_>, label: &str) -> Result<(Spelling, String), Refusal> {
    let angle = source.definition.angle;
    if source.right_angle() != angle && source.acts(|action| action == Action::TurnRight(None)) {
        return Err(Refusal(say!("{} has one angle for turns to the left and to the right", label)));
    }
    let is_step = |length: &Option<f64>| source.length(*length) == 1.0;
    let own = |actions: &[Action]| match actions {
        [Action::Draw(length)] if is_step(length) => "FG",
        [Action::Move(length)] if is_step(length) => "f",
        [Action::TurnLeft(None)] => "+",
        [Action::TurnRight(None)] => "-",
        [Action::TurnRound] => "|",
        [Action::Push] => "[",
        [Action::Pop] => "]",
        _ => "",
    };
    let one = |action: &Action| match action {
        Action::Draw(length) if is_step(length) => Some("F".to_owned()),
        Action::Move(length) if is_step(length) => Some("f".to_owned()),
        Action::Push => Some("[".to_owned()),
        Action::Pop => Some("]".to_owned()),
        Action::TurnRound => Some("|".to_owned()),
        other => turns(source.turn(*other)?, (angle, '+'), (angle, '-')),
    };
    let code = |actions: &[Action]| actions.iter().map(one).collect::<Option<String>>();
    let alphabet = Alphabet {
        label,
        idle: "XYZABCDEHIJKLMNOPQRSTUVWabcdehijklmnopqrstuvwxyz",
        is_upper: false,
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
    let rules = rules(source, &spelling);
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
    let mut text = String::new();
    let title = source.title(&[]);
    if !title.is_empty() {
        let _ = writeln!(text, "// {title}");
    }
    text.push_str("// F and G draw, f moves, + turns left, - turns right; the first heading is up.\n");
    let _ = writeln!(text, "const lsystem = {{\n    axiom: {},\n    productions: {{", quoted(&axiom));
    for (name, successors) in rules {
        let _ = writeln!(text, "        {}: {},", quoted(&name.to_string()), choices(&successors));
    }
    let _ = writeln!(text, "    }},\n    angle: {angle},\n    iterations: {},\n}};", source.definition.iterations);
    Ok(text)
}

/// The productions in the symbols of a spelling.
pub(super) fn rules(source: &Source<'_>, spelling: &Spelling) -> Vec<(char, Vec<(f64, String)>)> {
    let word = |modules: &[Module]| spelling.word(modules);
    let own = source.plain_rules();
    let own = own.iter().map(|PlainRule { symbol, successors }| {
        let successors = successors.iter().map(|(weight, successor)| (*weight, word(successor))).collect();
        (spelling.name_of(*symbol), successors)
    });
    let repeated = spelling.repeated.iter().map(|(name, word)| (*name, vec![(1.0, word.clone())]));
    let vanishing = spelling.vanishing.iter().map(|name| (*name, vec![(1.0, String::new())]));
    own.chain(repeated).chain(vanishing).collect()
}

/// A successor, or several with weights.
fn choices(successors: &[(f64, String)]) -> String {
    if let [(_, only)] = successors {
        return quoted(only);
    }
    let one =
        |(weight, word): &(f64, String)| format!("{{ weight: {}, successor: {} }}", number(*weight), quoted(word));
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
