//! Blocks of code around a system of cpfg: `Start: {a = 2; b = a/2;}` and `Define: {array a[3] = {1, 2, 3};}`.

use super::Places;
use super::assignments::{assignment, is_name, is_random, prints};
use super::parts::Parts;
use crate::draft::Draft;
use core::ops::Range;
use lsystem_base::{number::number, say};

/// The most assignments at every step: each is compared with all constants, rules and the other assignments.
const MAX_ASSIGNMENTS: usize = 1000;

/// The statements between the braces of a block.
fn inside(block: &str) -> Option<&str> {
    block.trim().strip_prefix('{')?.strip_suffix('}')
}

/// Reads the code that runs before the first step: assignments of arithmetic become constants.
pub(super) fn start(block: &str, parts: &mut Parts<'_>, places: &Places<'_>, draft: &mut Draft<'_>) {
    let Some(inside) = inside(block) else {
        return draft.refuse_at(places.of(block), say!("The braces around this code are missing"));
    };
    for statement in inside.split(';').map(str::trim).filter(|statement| !statement.is_empty()) {
        let place = places.of(statement);
        if prints(statement) {
            draft.note_at(place, say!("This code only writes texts"));
            continue;
        }
        if let Some(seed) = statement.strip_prefix("srand").and_then(|seed| parts.arithmetic.value(seed)) {
            draft.definition.seed = seed as _;
            draft.read(place, say!("seed {}", draft.definition.seed));
            continue;
        }
        let Some((name, value)) = assignment(statement) else {
            draft.refuse_at(place, say!("Of the code before the first step, only assignments are read"));
            continue;
        };
        match parts.arithmetic.value(value) {
            Some(value) => {
                draft.read(place, format!("{name} = {}", number(value)));
                parts.set_constant(name, value);
            }
            None => draft.refuse_at(place, say!("The value of this code cannot be computed before the first step")),
        }
    }
}

/// Reads the code that runs at every step, before the productions or behind them: assignments.
pub(super) fn every_step(
    block: &str,
    is_before: bool,
    place: &Range<usize>,
    parts: &mut Parts<'_>,
    places: &Places<'_>,
    draft: &mut Draft<'_>,
) {
    let Some(inside) = inside(block) else {
        return draft.refuse_at(places.of(block), say!("The braces around this code are missing"));
    };
    for statement in inside.split(';').map(str::trim).filter(|statement| !statement.is_empty()) {
        let own = places.of(statement);
        if prints(statement) {
            draft.note_at(own, say!("This code only writes texts"));
            continue;
        }
        let Some((name, value)) = assignment(statement).filter(|(_, value)| !is_random(value)) else {
            draft.refuse_at(own, say!("Of the code that runs at every step, only assignments without chance are read"));
            continue;
        };
        let code = &parts.every_step;
        if code.before.len() + code.after.len() >= MAX_ASSIGNMENTS {
            return draft.refuse_at(own, say!("There can be at most {} assignments at every step", MAX_ASSIGNMENTS));
        }
        match parts.arithmetic.read(value) {
            Ok(value) => {
                draft.read(own, say!("{} = {} at every step", name, value));
                // The number is no constant any more.
                parts.arithmetic.macros.forget(name);
                if !parts.constants.iter().any(|(known, _)| known == name) {
                    parts.constants.push((name.to_owned(), "0".to_owned()));
                }
                let code = &mut parts.every_step;
                code.place.get_or_insert(place.clone());
                let list = if is_before { &mut code.before } else { &mut code.after };
                list.push((name.to_owned(), value));
            }
            Err(why) => draft.refuse_at(own, why),
        }
    }
}

/// Reads definitions of arrays with their numbers.
pub(super) fn define(block: &str, parts: &mut Parts<'_>, places: &Places<'_>, draft: &mut Draft<'_>) {
    let Some(inside) = inside(block) else {
        return draft.refuse_at(places.of(block), say!("The braces around this code are missing"));
    };
    for statement in inside.split(';').map(str::trim).filter(|statement| !statement.is_empty()) {
        let place = places.of(statement);
        match array(statement, parts) {
            Some((name, elements)) => {
                draft.read(place, say!("{}, an array of {} numbers", name, elements.len()));
                parts.arithmetic.arrays.insert(name.to_owned(), elements);
            }
            None => draft.note_at(place, say!("Only arrays of one dimension whose numbers are given are read")),
        }
    }
}

/// The name and the elements of `array name[size] = {1, 2, 3}`.
fn array<'t>(statement: &'t str, parts: &Parts<'_>) -> Option<(&'t str, Vec<f64>)> {
    let rest = statement.strip_prefix("array")?.strip_prefix(char::is_whitespace)?;
    let (head, elements) = rest.split_once('=')?;
    let (name, size) = head.split_once('[')?;
    let size = parts.arithmetic.value(size.trim().strip_suffix(']')?)?;
    let elements: Option<Vec<f64>> =
        inside(elements)?.split(',').map(|element| parts.arithmetic.value(element)).collect();
    let elements = elements.filter(|elements| elements.len() as f64 == size)?;
    is_name(name.trim()).then_some((name.trim(), elements))
}
