//! The lines of Inkscape's dialog Extensions > Render > L-system.
//!
//! `A` to `F` draw and `G` to `L` move. The turtle starts upwards. Inkscape measures angles on a page whose y axis points
//! down, so that its left turn goes to the right on the page: `+` is written for a right turn, and the two angles change
//! places.

use super::Refusal;
use super::source::{Source, plain_number};
use super::spelling::{Alphabet, Spelling, turns};
use lsystem_base::say;
use lsystem_syntax::{Action, Heading, Module};

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let (left, right) = (source.definition.angle, source.right_angle());
    let turn = |degrees: f64| turns(degrees, (left, '-'), (right, '+'));
    let is_step = |length: &Option<f64>| source.length(*length) == 1.0;
    let own = |actions: &[Action]| match actions {
        [Action::Draw(length)] if is_step(length) => "FABCDE",
        [Action::Move(length)] if is_step(length) => "GHIJKL",
        [Action::TurnLeft(None)] => "-",
        [Action::TurnRight(None)] => "+",
        [Action::TurnRound] => "|",
        [Action::Push] => "[",
        [Action::Pop] => "]",
        _ => "",
    };
    let one = |action: &Action| match action {
        Action::Draw(length) if is_step(length) => Some("F".to_owned()),
        Action::Move(length) if is_step(length) => Some("G".to_owned()),
        Action::Push => Some("[".to_owned()),
        Action::Pop => Some("]".to_owned()),
        Action::TurnRound => Some("|".to_owned()),
        other => turn(source.turn(*other)?),
    };
    let code = |actions: &[Action]| actions.iter().map(one).collect::<Option<String>>();
    let alphabet = Alphabet {
        label: "Inkscape",
        idle: "XYZMNOPQRSTUVW",
        is_upper: true,
        own: &own,
        code: &code,
        mortal: "FG",
        fixed: "",
    };
    let spelling = Spelling::new(source, &alphabet)?;
    let start = turn(source.definition.heading - 90.0).filter(|start| spelling.stays(source, start));
    let start = start.ok_or_else(|| Refusal::new(say!("Inkscape starts upwards, and turns by the two angles only")))?;
    let word = |modules: &[Module]| spelling.word(modules);
    let rules = source.plain_rules();
    let rules = rules.iter().map(|rule| {
        let successor = rule.successors.first().map_or(String::new(), |(_, successor)| word(successor));
        format!("{}={successor}", spelling.name_of(rule.symbol))
    });
    let more = spelling.repeated.iter().map(|(name, word)| format!("{name}={word}"));
    let gone = spelling.vanishing.iter().map(|name| format!("{name}="));
    let rules: Vec<String> = rules.chain(more).chain(gone).collect();
    // The dialog takes 0 to 360 degrees.
    let angle = |degrees: f64| {
        let within = if (0.0..=360.0).contains(&degrees) { degrees } else { Heading::from_degrees(degrees).degrees() };
        plain_number(within)
    };
    Ok(format!(
        "Axiom: {start}{}\nRules: {}\nOrder: {}\nStep length (px): 10\nLeft angle: {}\nRight angle: {}\n",
        word(&source.grammar.axiom),
        rules.join(";"),
        source.definition.iterations,
        angle(right),
        angle(left),
    ))
}
