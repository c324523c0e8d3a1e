//! By what the reach of a letter's drawing is multiplied in each step.

use lsystem_derive::Rewrite;
use lsystem_drawing::System;
use lsystem_syntax::{Action, Heading, Motion};

/// The most steps.
const STEPS: usize = 400;
/// The reach is followed until here, so that squares stay finite.
const FAR: f64 = 1e120;
/// Quotients that differ by less are equal.
const NEAR: f64 = 1e-9;
/// The quotient is taken over as many steps, because turns may repeat.
const PERIOD: usize = 24;
/// The most letters in all successors.
const MAX_WORK: usize = 20_000;

/// The way from the first to the last point of what a letter draws: x, y, and the turn at its end.
#[derive(Clone, Copy, Debug)]
struct Way {
    x: f64,
    y: f64,
    turn: Heading,
}

const NOWHERE: Way = Way { x: 0.0, y: 0.0, turn: Heading::EAST };

/// The factor by which the way of the farthest letter grows in each step; `None` with chance or bent branches,
/// or if there is no such factor.
pub(crate) fn stretch(system: &System) -> Option<f64> {
    let (rules, turtle) = (&system.rules, &system.turtle);
    let is_simple = rules.is_plain() && !rules.is_random() && turtle.tropism.is_none() && turtle.wind.is_none();
    let size: usize = rules.rewrites.iter().filter_map(Rewrite::always).map(<[u16]>::len).sum();
    if !is_simple || turtle.length_factor != 1.0 || turtle.angle_variation != 0.0 || size > MAX_WORK {
        return None;
    }
    let alone: Vec<Way> = turtle.actions.iter().map(|actions| way_of(system, actions)).collect::<Option<_>>()?;
    let brackets: Vec<i32> = turtle.actions.iter().map(|actions| depth(actions)).collect();
    let mut ways = alone.clone();
    // The reach of all letters, of the last steps.
    let mut reaches = vec![reach(&ways)];
    for _ in 0..STEPS {
        ways = (rules.rewrites.iter().enumerate())
            .map(|(letter, rewrite)| match rewrite.always() {
                Some(word) => joined(word, &ways, &brackets),
                None => Some(ways[letter]),
            })
            .collect::<Option<_>>()?;
        reaches.push(reach(&ways));
        if reaches.last().is_some_and(|reach| *reach > FAR) {
            break;
        }
    }
    let quotient = |at: usize| libm::pow(reaches[at] / reaches[at - PERIOD], 1.0 / PERIOD as f64);
    let last = reaches.len() - 1;
    if last < 2 * PERIOD || reaches[last - PERIOD] <= 0.0 {
        return None;
    }
    let (now, before) = (quotient(last), quotient(last - PERIOD / 2));
    ((now - before).abs() < NEAR * now && now > 1.0 + 1e-6).then_some(now)
}

fn reach(ways: &[Way]) -> f64 {
    ways.iter().map(|way| libm::hypot(way.x, way.y)).fold(0.0, f64::max)
}

/// One way after the other; what stands in brackets leads nowhere.
fn joined(word: &[u16], ways: &[Way], brackets: &[i32]) -> Option<Way> {
    let mut stored = Vec::new();
    let mut way = NOWHERE;
    for &letter in word {
        match brackets[usize::from(letter)] {
            1 => stored.push(way),
            -1 => way = stored.pop()?,
            _ => way = then(way, ways[usize::from(letter)]),
        }
    }
    stored.is_empty().then_some(way)
}

fn then(first: Way, next: Way) -> Way {
    let (cos, sin) = first.turn.cos_sin();
    Way {
        x: first.x + cos * next.x - sin * next.y,
        y: first.y + sin * next.x + cos * next.y,
        turn: first.turn + next.turn,
    }
}

/// 1 for a letter that opens a bracket, -1 for one that closes it.
fn depth(actions: &[Action]) -> i32 {
    match actions {
        [Action::Push] => 1,
        [Action::Pop] => -1,
        _ => 0,
    }
}

/// The way of a letter that is not rewritten; `None` if its actions do more than going and turning.
fn way_of(system: &System, actions: &[Action]) -> Option<Way> {
    let turtle = &system.turtle;
    let mut way = NOWHERE;
    for action in actions {
        let step = match action.row().motion {
            Motion::Ahead => Way { x: action.number().unwrap_or(turtle.step), ..NOWHERE },
            Motion::Turn => Way { turn: turtle.rotation(*action)?.signed(), ..NOWHERE },
            Motion::Later => return None,
            Motion::Branch if actions.len() > 1 => return None,
            Motion::Still | Motion::Branch => NOWHERE,
        };
        way = then(way, step);
    }
    Some(way)
}
