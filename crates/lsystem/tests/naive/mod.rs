//! The plain way, to compare with: every generation as a list of letters, the turtle over the last one.
//!
//! Independent of the core's shortcuts on purpose: productions are read from the grammar, not from the compiled
//! program, and headings are floating-point degrees that are summed up.
#![allow(dead_code, unreachable_pub, reason = "each test binary uses its own part")]

use lsystem::{Action, Grammar, Key, Production, Segment, System};

/// The letters of generation `n`, with their keys. Takes time and memory as the word grows.
pub fn derive(grammar: &Grammar, seed: u32, n: u32) -> Vec<(char, Key)> {
    let axiom = grammar.axiom.iter().enumerate();
    let mut word: Vec<(char, Key)> = axiom.map(|(i, m)| (m.symbol, Key::root(i as u64))).collect();
    for step in 1..=n {
        let mut next = Vec::new();
        for (letter, key) in word {
            match successor(grammar, letter, || key.choice(seed, step)) {
                None => next.push((letter, key)),
                Some(letters) => {
                    next.extend(letters.enumerate().map(|(i, letter)| (letter, key.child(step, i as u64))));
                }
            }
        }
        word = next;
    }
    word
}

/// The word of generation `n`.
pub fn expand(grammar: &Grammar, seed: u32, n: u32) -> String {
    derive(grammar, seed, n).into_iter().map(|(letter, _)| letter).collect()
}

/// What replaces `letter`, or `None` where no production does: the first production in text order decides whether
/// it is one of the weighted.
fn successor(grammar: &Grammar, letter: char, roll: impl FnOnce() -> f64) -> Option<impl Iterator<Item = char>> {
    let matching: Vec<_> = grammar.productions.iter().filter(|p| p.predecessor.symbol == letter).collect();
    let first = *matching.first()?;
    let mut chosen = first;
    if first.weight.is_some() {
        let weighted: Vec<_> = matching.into_iter().filter(|p| p.weight.is_some()).collect();
        let weight = |p: &Production| p.weight.as_ref().and_then(|weight| grammar.value(weight)).unwrap_or(0.0);
        let total: f64 = weighted.iter().map(|p| weight(p)).sum();
        let roll = roll();
        let mut until = 0.0;
        for production in weighted {
            chosen = production;
            until += weight(production);
            if roll < until / total {
                break;
            }
        }
    }
    Some(chosen.successor.iter().map(|m| m.symbol))
}

/// A turtle's state; all of it is saved by a branch.
#[derive(Clone, Copy)]
struct State {
    at: [f64; 2],
    degrees: f64,
    colour: i32,
    width: f64,
    level: u32,
}

/// The segments of generation `n`, in drawing order.
pub fn segments(system: &System, n: u32) -> Vec<Segment> {
    let turtle = &system.turtle;
    let (left, right) = (turtle.left.degrees(), turtle.right.degrees());
    let start = State { at: turtle.start, degrees: turtle.heading.degrees(), colour: 0, width: turtle.width, level: 0 };
    let (mut state, mut saved, mut segments) = (start, Vec::new(), Vec::new());
    for (letter, _) in derive(&system.grammar, system.seed, n) {
        let Ok(id) = system.program.alphabet.binary_search(&letter) else { continue };
        for action in &turtle.actions[id] {
            match *action {
                Action::Draw(length) => {
                    let from = state.at;
                    advance(&mut state, length.unwrap_or(turtle.step));
                    segments.push(Segment {
                        from,
                        to: state.at,
                        colour: state.colour,
                        level: state.level,
                        width: state.width * turtle.step.abs(),
                    });
                }
                Action::Move(length) => advance(&mut state, length.unwrap_or(turtle.step)),
                Action::TurnLeft(by) => turn(&mut state, by.unwrap_or(left)),
                Action::TurnRight(by) => turn(&mut state, -by.unwrap_or(right)),
                Action::TurnRound => turn(&mut state, 180.0),
                Action::Push => {
                    saved.push(state);
                    state.level += 1;
                }
                Action::Pop => state = saved.pop().unwrap_or(state),
                Action::SetColour(colour) => state.colour = colour,
                Action::AddColour(by) => state.colour = state.colour.wrapping_add(by),
                Action::SetWidth(width) => state.width = width,
                Action::ScaleWidth(factor) => state.width *= factor,
            }
        }
    }
    segments
}

fn turn(state: &mut State, degrees: f64) {
    state.degrees = (state.degrees + degrees) % 360.0;
}

fn advance(state: &mut State, length: f64) {
    let radians = state.degrees.to_radians();
    state.at[0] += length * libm::cos(radians);
    state.at[1] += length * libm::sin(radians);
}

/// The smallest box around the segments' axes: min x, min y, max x, max y; `None` without segments.
pub fn bounds(segments: &[Segment]) -> Option<[f64; 4]> {
    let mut ends = segments.iter().flat_map(|s| [s.from, s.to]);
    let [x, y] = ends.next()?;
    Some(ends.fold([x, y, x, y], |b, [x, y]| [b[0].min(x), b[1].min(y), b[2].max(x), b[3].max(y)]))
}
