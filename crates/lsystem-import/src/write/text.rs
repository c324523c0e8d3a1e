//! Labelled lines, as in papers and encyclopedias: axiom, rules in our notation, angle, iterations.
//!
//! People write such texts in many ways, so a text is taken only if our own reader makes the same system of it.

use super::Refusal;
use super::compare::difference;
use super::object;
use super::source::{Need, Source};
use crate::import;
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_syntax::{Action, Dialect, Vocabulary, overrides, print_axiom, print_rules};

/// All parts but surfaces, which have a field of their own.
pub(super) const SPEAKS: &[Need] = &[
    Need::Contexts,
    Need::Parameters,
    Need::Conditions,
    Need::Chance,
    Need::Variation,
    Need::Images,
    Need::Space,
    Need::BranchLengths,
    Need::Acts(Vocabulary::Scaling),
    Need::Acts(Vocabulary::SwappedTurns),
    Need::Acts(Vocabulary::Polygons),
    Need::Acts(Vocabulary::Circles),
    Need::Acts(Vocabulary::Tubes),
    Need::Acts(Vocabulary::Cuts),
    Need::Tropism,
    Need::Growth,
    Need::OpenBranches,
    Need::Queries,
    Need::Surroundings,
];

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let usual = usual(source);
    for title in [true, false] {
        for text in [Some(own(source, title)), usual.as_ref().map(|usual| titled(source, title) + usual)] {
            if let Some(text) = text.filter(|text| reads_back(source, text)) {
                return Ok(text);
            }
        }
    }
    Err(Refusal::new(say!("A text of labelled lines would be read as another system")))
}

/// Whether the reader makes the same system of a text.
fn reads_back(source: &Source<'_>, text: &str) -> bool {
    let Some(imported) = import(text) else { return false };
    let [entry] = imported.entries.as_slice() else { return false };
    let Some(definition) = &entry.definition else { return false };
    let varies = |own: &lsystem_syntax::Definition| (own.angle_variation, own.length_variation, own.growth);
    difference(source.definition, definition, true).is_none() && varies(definition) == varies(source.definition)
}

fn titled(source: &Source<'_>, title: bool) -> String {
    let title = if title { source.title(&[]) } else { String::new() };
    if title.is_empty() { title } else { title + "\n" }
}

/// The system in its own symbols.
fn own(source: &Source<'_>, title: bool) -> String {
    let definition = source.definition;
    let grammar = &source.system.grammar;
    let mut text = titled(source, title);
    let _ = writeln!(text, "Axiom: {}\n{}", print_axiom(grammar), print_rules(grammar));
    numbers(source, &mut text);
    if definition.heading != 90.0 {
        let _ = writeln!(text, "Heading: {}", number(definition.heading));
    }
    for symbol in &source.symbols {
        if symbol.actions != Dialect::Abop.actions(symbol.symbol) {
            let _ = writeln!(text, "{}", overrides::line(symbol.symbol, &actions(&symbol.actions)));
        }
    }
    text
}

/// Actions in the words of custom symbols.
fn actions(actions: &[Action]) -> String {
    overrides::print_actions(actions)
}

fn numbers(source: &Source<'_>, text: &mut String) {
    let definition = source.definition;
    let _ = writeln!(text, "Angle: {}", number(definition.angle));
    if source.right_angle() != definition.angle {
        let _ = writeln!(text, "Right angle: {}", number(source.right_angle()));
    }
    let _ = writeln!(text, "Iterations: {}", definition.iterations);
}

/// The system in the usual symbols: `F` and `G` draw, `f` moves, `+` and `-` turn, and the turtle starts upwards.
fn usual(source: &Source<'_>) -> Option<String> {
    if source.lacking(&[]).is_some() {
        return None;
    }
    let (spelling, start) = object::spelling(source, "").ok()?;
    let mut text = format!("Axiom: {start}{}\n", spelling.word(&source.grammar.axiom));
    for (name, successors) in spelling.rules(source) {
        let successor = successors.first().map_or("", |(_, word)| word);
        let _ = writeln!(text, "{name} -> {successor}");
    }
    numbers(source, &mut text);
    Some(text)
}
