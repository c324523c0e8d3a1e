//! One parent, a little changed.

use crate::dice::Dice;
use crate::palette;
use core::ops::Range;
use lsystem_syntax::{ColourBy, Definition, Expr, Grammar, Module};

/// Changes a rule, a number or the angle.
pub(super) fn form(dice: &mut Dice, child: &mut Definition, grammar: &mut Grammar) {
    match dice.whole(0, 9) {
        0 | 1 => turn(dice, child),
        2 | 3 if number(dice, grammar) => {}
        _ => rule(dice, grammar),
    }
}

/// Changes the colours or the width.
pub(super) fn look(dice: &mut Dice, child: &mut Definition) {
    let style = &mut child.style;
    match dice.whole(0, 4) {
        0 => style.hue = (style.hue + dice.between(-90.0, 90.0)).rem_euclid(360.0).round(),
        1 => style.width = (style.width * dice.between(0.6, 1.6) * 100.0).round() / 100.0,
        by => {
            let colours = palette::gradient(dice, style.palette.len().clamp(3, 8));
            (style.palette, style.background, style.hue) = (colours.colours, colours.paper, 0.0);
            if by == 4 && !matches!(style.colour_by, ColourBy::Generation) {
                style.colour_by = dice.one([ColourBy::Level, ColourBy::Path]);
            }
        }
    }
}

/// Changes the angle: to a like part of the circle, or by up to a quarter.
fn turn(dice: &mut Dice, child: &mut Definition) {
    let parts = 360.0 / child.angle;
    let is_part = (parts - parts.round()).abs() < 1e-9 && parts <= 12.0;
    let angle = if is_part && dice.chance(0.6) {
        let more = (parts.round() + dice.one([-2.0, -1.0, 1.0, 2.0])).clamp(3.0, 16.0);
        360.0 / more
    } else {
        (child.angle * dice.between(0.75, 1.25) * 10.0).round() / 10.0
    };
    child.angle = angle.clamp(0.5, 180.0);
}

/// Changes one number of axiom, productions and constants by up to a quarter. False if there is none.
fn number(dice: &mut Dice, grammar: &mut Grammar) -> bool {
    fn numbers<'a>(expr: &'a mut Expr, list: &mut Vec<&'a mut f64>) {
        match expr {
            Expr::Number(number) => list.push(number),
            Expr::Name(_) => {}
            Expr::Negative(inner) | Expr::Not(inner) | Expr::Curve(_, inner) => numbers(inner, list),
            Expr::Binary(_, left, right) => {
                numbers(left, list);
                numbers(right, list);
            }
            Expr::Call(_, arguments) => arguments.iter_mut().for_each(|argument| numbers(argument, list)),
        }
    }
    let Grammar { axiom, productions, images, constants, .. } = grammar;
    let successors = productions.iter_mut().chain(images).flat_map(|production| &mut production.successor);
    let mut list: Vec<&mut f64> = constants.iter_mut().map(|constant| &mut constant.value).collect();
    for argument in axiom.iter_mut().chain(successors).flat_map(|module| &mut module.arguments) {
        numbers(argument, &mut list);
    }
    // Whole counts such as the 1 of `k+1` make the system what it is.
    list.retain(|number| **number != 0.0 && **number != 1.0);
    if list.is_empty() {
        return false;
    }
    let at = dice.whole(0, list.len() - 1);
    let changed = *list[at] * dice.between(0.75, 1.25);
    let unit = libm::pow(10.0, libm::floor(libm::log10(changed.abs())) - 2.0);
    *list[at] = libm::round(changed / unit) * unit;
    true
}

/// Changes a word: one of the successors, or now and then the axiom.
fn rule(dice: &mut Dice, grammar: &mut Grammar) {
    let stock: Vec<Module> = grammar
        .productions
        .iter()
        .flat_map(|production| &production.successor)
        .filter(|module| !matches!(module.symbol, '[' | ']'))
        .cloned()
        .collect();
    let many = grammar.productions.len();
    if stock.is_empty() {
        return;
    }
    let word = match dice.whole(0, 10 * many) / 10 {
        at if at < many => &mut grammar.productions[at].successor,
        _ => &mut grammar.axiom,
    };
    let new = stock[dice.whole(0, stock.len() - 1)].clone();
    let branches = branches(word);
    let plain: Vec<usize> = (0..word.len()).filter(|&at| !matches!(word[at].symbol, '[' | ']')).collect();
    let place = plain.get(dice.whole(0, plain.len().max(1) - 1)).copied();
    let branch = branches.get(dice.whole(0, branches.len().max(1) - 1)).cloned();
    match (dice.whole(0, 6), place, branch) {
        // Another module in place of one, a module more, a module less.
        (0, Some(at), _) => word[at] = new,
        (1, Some(at), _) => word.insert(at, new),
        (2, Some(at), _) if plain.len() > 2 => drop(word.remove(at)),
        // The other way round.
        (3, Some(_), _) => {
            let turns: Vec<usize> = plain.into_iter().filter(|&at| opposite(word[at].symbol).is_some()).collect();
            if let Some(&at) = turns.get(dice.whole(0, turns.len().max(1) - 1)) {
                word[at] = mirrored(&word[at]);
            }
        }
        // A branch more, mirrored or not; a branch less.
        (4 | 5, _, Some(branch)) => {
            let mirrors = dice.chance(0.6);
            let copy: Vec<Module> =
                word[branch].iter().map(|module| if mirrors { mirrored(module) } else { module.clone() }).collect();
            let at = dice.whole(0, word.len());
            let at = if depth(word, at) == 0 { at } else { word.len() };
            word.splice(at..at, copy);
        }
        (6, _, Some(branch)) if branches.len() > 1 => drop(word.drain(branch)),
        // A module becomes a branch to one side.
        (_, Some(at), _) => {
            let module = word[at].clone();
            let side = dice.one(['+', '-']);
            let copy = [Module::from('['), Module::from(side), module, Module::from(']')];
            word.splice(at..at, copy);
        }
        _ => {}
    }
}

/// The branches of a word that lie in no other branch, with their brackets.
pub(super) fn branches(word: &[Module]) -> Vec<Range<usize>> {
    let (mut depth, mut from, mut found) = (0, 0, vec![]);
    for (at, module) in word.iter().enumerate() {
        match module.symbol {
            '[' => {
                if depth == 0 {
                    from = at;
                }
                depth += 1;
            }
            ']' if depth > 0 => {
                depth -= 1;
                if depth == 0 {
                    found.push(from..at + 1);
                }
            }
            _ => {}
        }
    }
    found
}

/// The number of open branches before a place.
fn depth(word: &[Module], at: usize) -> usize {
    word[..at].iter().fold(0_usize, |depth, module| match module.symbol {
        '[' => depth + 1,
        ']' => depth.saturating_sub(1),
        _ => depth,
    })
}

fn opposite(symbol: char) -> Option<char> {
    let pairs = [('+', '-'), ('&', '^'), ('/', '\\'), ('<', '>')];
    pairs.iter().find_map(|&(one, other)| match symbol {
        _ if symbol == one => Some(other),
        _ if symbol == other => Some(one),
        _ => None,
    })
}

/// A turn the other way; any other module as it is.
fn mirrored(module: &Module) -> Module {
    Module { symbol: opposite(module.symbol).unwrap_or(module.symbol), ..module.clone() }
}
