//! Sections of a file of cpfg that are written into the productions: code of every step, decompositions, and
//! homomorphisms of their own results.

use super::decomposition::Decomposition;
use super::parts::Parts;
use super::symbols::Symbols;
use crate::draft::Draft;
use core::ops::Range;
use lsystem_base::{say, word, words::said};
use lsystem_syntax::{Diagnostic, Grammar, Production, parse};
use std::collections::BTreeSet;

const HOMOMORPHISM: [&str; 2] = [word!("A homomorphism"), word!("this homomorphism")];

/// Writes the numbers that code changes at every step into the modules that use them.
pub(super) fn every_step(parts: &Parts<'_>, decompositions: &str, symbols: &mut Symbols<'_>, draft: &mut Draft<'_>) {
    let Some(place) = &parts.every_step.place else { return };
    let (mut grammar, wrong) = parse(&draft.definition.axiom, &draft.definition.rules);
    if let Some(error) = wrong.iter().find(|problem| problem.is_error()) {
        return draft.refuse_at(place.clone(), say!("In our notation: {}", error.message));
    }
    let initial = |name: &str| before_steps(parts, name);
    let mut free = |symbol: char| symbols.free.get(&format!("{symbol} at every step"));
    let (own, _) = parse("", decompositions);
    match parts.every_step.write(&mut grammar, &own.productions, &initial, &mut free) {
        Ok(()) => draft.grammar(&grammar),
        Err(why) => draft.refuse_at(place.clone(), said(why)),
    }
}

/// The value of a number before the first step.
fn before_steps(parts: &Parts<'_>, name: &str) -> f64 {
    let found = parts.constants.iter().rev().find(|(known, _)| known == name);
    found.and_then(|(_, value)| value.parse().ok()).unwrap_or(0.0)
}

/// Writes the decompositions, whose keyword stands at this place, into the axiom and the successors.
pub(super) fn decompose(parts: &Parts<'_>, place: &Range<usize>, decompositions: &str, draft: &mut Draft<'_>) {
    let (mut grammar, wrong) = parse(&draft.definition.axiom, &draft.definition.rules);
    let (own, own_wrong) = parse("", decompositions);
    let error = wrong.iter().chain(&own_wrong).find(|problem| problem.is_error());
    if let Some(error) = error {
        return draft.refuse_at(place.clone(), say!("In our notation: {}", error.message));
    }
    let depth = parts.decomposition_depth.map_or(Some(1.0), |text| parts.arithmetic.value(text));
    let Some(depth) = depth else { return draft.refuse_at(place.clone(), say!("The maximum depth cannot be read")) };
    match Decomposition::new([word!("A decomposition"), word!("this decomposition")], &own, depth as usize)
        .and_then(|own| own.apply(&mut grammar))
    {
        Ok(stopped) => {
            draft.grammar(&grammar);
            if stopped {
                let why = say!("The maximum depth ends these decompositions; they go on in the next step, as in cpfg");
                draft.note_at(place.clone(), why);
            }
        }
        Err(why) => draft.refuse_at(place.clone(), why),
    }
}

/// Writes the results of a homomorphism that applies to its own results into one that applies once.
pub(super) fn homomorphism(parts: &Parts<'_>, draft: &mut Draft<'_>) {
    let depth = parts.depth.map_or(Some(1.0), |text| parts.arithmetic.value(text));
    let Some(first) = parts.images.first() else { return };
    let Some(depth) = depth else {
        return draft.refuse_at(first.place.clone(), say!("The maximum depth cannot be read"));
    };
    let (mut grammar, wrong) = parse(&draft.definition.axiom, &draft.definition.rules);
    let imaged: BTreeSet<char> = grammar.images.iter().map(|image| image.predecessor.symbol).collect();
    let mut made = grammar.images.iter().flat_map(|image| &image.successor);
    if depth <= 1.0 || wrong.iter().any(Diagnostic::is_error) || !made.any(|module| imaged.contains(&module.symbol)) {
        return;
    }
    let own = Grammar {
        productions: core::mem::take(&mut grammar.images),
        constants: grammar.constants.clone(),
        ..Grammar::default()
    };
    // The first application is that of the drawing itself. It needs only productions for modules of the string.
    let words = grammar.productions.iter().map(|rule| &rule.successor).chain([&grammar.axiom]);
    let drawn: BTreeSet<char> = words.flatten().map(|module| module.symbol).collect();
    let first_ones: Vec<Production> =
        own.productions.iter().filter(|image| drawn.contains(&image.predecessor.symbol)).cloned().collect();
    let written =
        Decomposition::new(HOMOMORPHISM, &own, depth as usize - 1).and_then(|inner| inner.applied(&first_ones));
    match written {
        Ok(images) => {
            grammar.images = images;
            draft.grammar(&grammar);
        }
        // Where nothing is derived, the axiom is all that the homomorphism applies to.
        Err(_) if grammar.productions.is_empty() || (draft.has_iterations && draft.definition.iterations == 0) => {
            let axiom =
                Decomposition::new(HOMOMORPHISM, &own, depth as usize).and_then(|inner| inner.word(&grammar.axiom));
            match axiom {
                Ok(axiom) => {
                    grammar = Grammar { axiom, productions: Vec::new(), images: Vec::new(), ..grammar };
                    draft.grammar(&grammar);
                }
                Err(why) => draft.refuse_at(first.place.clone(), why),
            }
        }
        Err(why) => draft.refuse_at(first.place.clone(), why),
    }
}
