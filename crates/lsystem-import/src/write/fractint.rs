//! Fractint's `.l` files: see the reader in `fractint.rs`.
//!
//! `F` and `G` go along a heading that `+ - |` turn by 360/n degrees, and `D` and `M` along another, which `\nn` and `/nn`
//! turn by any angle. A system is written with the first if its angle and its headings are such, or else with the second.

use super::Refusal;
use super::source::{Need, Source, plain_number};
use super::spelling::{Alphabet, Spelling, turns};
use lsystem_base::say;
use lsystem_syntax::{Action, Vocabulary};

/// The parts of systems that Fractint expresses.
pub(super) const SPEAKS: &[Need] = &[Need::Acts(Vocabulary::Scaling), Need::Acts(Vocabulary::SwappedTurns)];

/// The letters that Fractint does not draw with, and that are no part of a number.
const IDLE: &str = "XYZABEHJKLNOPRSTUVW";
/// The most rules of a file.
const MAX_RULES: usize = 25;
/// The most characters of a line.
const LONGEST: usize = 250;

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    if source.needs(Need::Acts(Vocabulary::SwappedTurns)) && source.right_angle() != source.definition.angle {
        return Err(Refusal::new(say!("Fractint cannot swap turns by two angles")));
    }
    let parts = 360.0 / source.definition.angle;
    let is_part =
        parts.fract() == 0.0 && (3.0..=50.0).contains(&parts) && source.right_angle() == source.definition.angle;
    let fixed = if is_part { system(source, Some(parts)).ok() } else { None };
    fixed.map_or_else(|| system(source, None), Ok)
}

/// The file with an angle of 360/`parts` degrees, or with turns by degrees.
fn system(source: &Source<'_>, parts: Option<f64>) -> Result<String, Refusal> {
    let angle = source.definition.angle;
    let turn = |degrees: f64| match parts {
        Some(_) => turns(degrees, (angle, '+'), (angle, '-')),
        None => Some(match degrees {
            0.0 => String::new(),
            _ if degrees < 0.0 => format!("/{}", decimal(-degrees)),
            _ => format!("\\{}", decimal(degrees)),
        }),
    };
    let line = |letter: &str, length: f64| {
        if length == 1.0 {
            return Some(letter.to_owned());
        }
        // `@I` divides by the number.
        let number = decimal(length);
        (length > 0.0).then(|| format!("@{number}{letter}@I{number}"))
    };
    let own = |action: Action| match action {
        Action::TurnLeft(None) if parts.is_some() => "+",
        Action::TurnRight(None) if parts.is_some() => "-",
        Action::TurnRound if parts.is_some_and(|parts| parts % 2.0 == 0.0) => "|",
        Action::SwapTurns => "!",
        _ => "",
    };
    let [draws, moves] = if parts.is_some() { ["F", "G"] } else { ["D", "M"] };
    let code = |action: Action| match action {
        Action::Draw(length) | Action::DrawUnmarked(length) => line(draws, source.length(length)),
        Action::Move(length) | Action::MoveUnmarked(length) => line(moves, source.length(length)),
        Action::ScaleLength(factor) if factor > 0.0 => Some(format!("@{}", decimal(factor))),
        Action::SwapTurns => Some("!".into()),
        other => turn(source.turn(other)?),
    };
    let alphabet = Alphabet {
        label: "Fractint",
        idle: IDLE,
        is_upper: true,
        steps: [draws, moves],
        own: &own,
        code: &code,
        mortal: "FGDM",
        fixed: "+-|[]",
    };
    let spelling = Spelling::new(source, &alphabet)?;
    let start =
        turn(source.definition.heading).ok_or_else(|| Refusal::new(say!("Fractint cannot begin with this heading")))?;
    let mut lines = vec![
        format!("Angle {}", parts.map_or_else(|| "4".to_owned(), plain_number)),
        format!("Axiom {start}{}", spelling.word(&source.grammar.axiom)),
    ];
    lines.extend(spelling.equations(source));
    if lines.len() - 2 > MAX_RULES {
        return Err(Refusal::new(say!("Fractint reads at most {} rules", MAX_RULES)));
    }
    if lines.iter().any(|line| line.len() > LONGEST) {
        return Err(Refusal::new(say!("Fractint reads at most {} characters on a line", LONGEST)));
    }
    let name: String = source.definition.label().chars().filter(char::is_ascii_alphanumeric).take(20).collect();
    let name = if name.is_empty() { "System" } else { &name };
    let title = source.title(&['{', '}', ';']);
    let order = source.definition.iterations;
    Ok(format!("{name} {{ ; {title}, order {order}\n  {}\n}}\n", lines.join("\n  ")))
}

/// A number above 0 with the digits that Fractint reads.
fn decimal(value: f64) -> String {
    let text = plain_number(value);
    if text.len() <= 20 { text } else { format!("{value:.15}") }
}
