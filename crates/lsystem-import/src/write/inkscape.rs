//! The lines of Inkscape's dialog Extensions > Render > L-system.
//!
//! `A` to `F` draw and `G` to `L` move. The turtle starts upwards, and `+` turns left. Inkscape before 1.2 draws the mirror
//! image.

use super::Refusal;
use super::source::{Source, plain_number};
use super::spelling::{Alphabet, Spelling, turns};
use lsystem_base::say;
use lsystem_syntax::{Action, Heading};

/// The largest order that the dialog takes.
const MAX_ORDER: u32 = 100;

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    if source.definition.iterations > MAX_ORDER {
        return Err(Refusal::new(say!("Inkscape takes at most {} iterations", MAX_ORDER)));
    }
    let (left, right) = (source.definition.angle, source.right_angle());
    let turn = |degrees: f64| turns(degrees, (left, '+'), (right, '-'));
    let own = |action: Action| match action {
        Action::TurnLeft(None) => "+",
        Action::TurnRight(None) => "-",
        Action::TurnRound => "|",
        _ => "",
    };
    let code = |action: Action| match action {
        Action::TurnRound => Some("|".to_owned()),
        other => turn(source.turn(other)?),
    };
    let alphabet = Alphabet {
        label: "Inkscape",
        idle: "XYZMNOPQRSTUVW",
        is_upper: true,
        steps: ["FABCDE", "GHIJKL"],
        own: &own,
        code: &code,
        mortal: "FG",
        fixed: "",
    };
    let spelling = Spelling::new(source, &alphabet)?;
    let start = turn(source.definition.heading - 90.0).filter(|start| spelling.stays(source, start));
    let start = start.ok_or_else(|| Refusal::new(say!("Inkscape starts upwards, and turns by the two angles only")))?;
    let rules = spelling.equations(source);
    // The dialog takes 0 to 360 degrees.
    let angle = |degrees: f64| {
        let within = if (0.0..=360.0).contains(&degrees) { degrees } else { Heading::from_degrees(degrees).degrees() };
        plain_number(within)
    };
    Ok(format!(
        "Axiom: {start}{}\nRules: {}\nOrder: {}\nStep length (px): 10\nLeft angle: {}\nRight angle: {}\n",
        spelling.word(&source.grammar.axiom),
        rules.join(";"),
        source.definition.iterations,
        angle(left),
        angle(right),
    ))
}
