//! Two parents, crossed.

use super::mutate::branches;
use crate::dice::Dice;
use lsystem_syntax::{Definition, Grammar, Module};

/// Gives the child of one parent parts of another: productions of letters that both have, or else a branch; the angle or
/// the mean of both; the colours.
pub(super) fn cross(
    dice: &mut Dice,
    child: &mut Definition,
    grammar: &mut Grammar,
    other: &Definition,
    theirs: &Grammar,
) {
    let mut changed = false;
    for own in &mut grammar.productions {
        let alike: Vec<_> = theirs
            .productions
            .iter()
            .filter(|their| their.predecessor.symbol == own.predecessor.symbol)
            .filter(|their| their.predecessor.parameters.len() == own.predecessor.parameters.len())
            .filter(|their| their.successor != own.successor)
            .collect();
        if !alike.is_empty() && dice.chance(0.6) {
            *own = alike[dice.whole(0, alike.len() - 1)].clone();
            changed = true;
        }
    }
    if changed {
        let known = |name: &str| grammar.constants.iter().any(|constant| constant.name == name);
        let more: Vec<_> = theirs.constants.iter().filter(|constant| !known(&constant.name)).cloned().collect();
        grammar.constants.extend(more);
    } else {
        graft(dice, grammar, theirs);
    }
    child.angle = match dice.whole(0, 2) {
        0 => child.angle,
        1 => other.angle,
        _ => (5.0 * (child.angle + other.angle)).round() / 10.0,
    };
    if dice.chance(0.5) {
        let (own, their) = (&mut child.style, &other.style);
        own.palette.clone_from(&their.palette);
        (own.background, own.hue, own.palette_holds) = (their.background, their.hue, their.palette_holds);
        if dice.chance(0.5) {
            own.colour_by = their.colour_by;
        }
    }
}

/// Adds a branch of the other parent to a successor. Its letters without production stay, others become the letter whose
/// successor this is.
fn graft(dice: &mut Dice, grammar: &mut Grammar, theirs: &Grammar) {
    let scions: Vec<&[Module]> = theirs
        .productions
        .iter()
        .flat_map(|production| branches(&production.successor).into_iter().map(|branch| &production.successor[branch]))
        .filter(|branch| branch.iter().all(|module| module.arguments.is_empty()))
        .collect();
    let stocks: Vec<usize> = (0..grammar.productions.len())
        .filter(|&at| grammar.productions[at].predecessor.parameters.is_empty())
        .collect();
    if scions.is_empty() || stocks.is_empty() {
        return;
    }
    let stock = &mut grammar.productions[stocks[dice.whole(0, stocks.len() - 1)]];
    let own = stock.predecessor.symbol;
    let grows = |symbol: char| theirs.productions.iter().any(|production| production.predecessor.symbol == symbol);
    let scion: Vec<Module> = scions[dice.whole(0, scions.len() - 1)]
        .iter()
        .map(|module| if grows(module.symbol) { Module::from(own) } else { module.clone() })
        .collect();
    let heads: Vec<usize> = branches(&stock.successor).into_iter().map(|branch| branch.start).collect();
    let at = heads.get(dice.whole(0, heads.len().max(1) - 1)).copied().unwrap_or(stock.successor.len());
    stock.successor.splice(at..at, scion);
}
