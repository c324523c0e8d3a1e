//! The one symbol by which an answer differs from a right one, found by trying every change of one symbol.

use crate::actions::Actions;
use crate::compiled::compiled;
use crate::exercise::Exercise;
use crate::same::Outline;
use crate::sketch::{LIMITS, lists};
use core::fmt;
use core::ops::Range;
use lsystem_base::{Limits, Meter, Progress, say};
use lsystem_drawing::Figure;
use lsystem_syntax::{Action, Definition, Motion};
use std::collections::BTreeSet;

/// The derivation steps of the drawings that are tried: small drawings show a wrong symbol, too.
const STEPS: u32 = 3;
/// The most segments of a drawing that is tried, and of the drawings that are compared in the end.
const MAX: [u64; 2] = [2_000, 20_000];
/// The most changes that are tried.
const MAX_CHANGES: usize = 2_000;

/// A change of one symbol that makes an answer right.
pub(crate) struct Repair {
    /// The symbol to take away.
    less: Option<(char, Kind)>,
    /// The kind of the symbol to put there.
    more: Option<Kind>,
    /// The text before the arrow of the rule.
    rule: String,
}

/// The kind of a symbol.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Turn,
    Bracket,
    Other,
}

/// One symbol exchanged in the rules.
struct Change<'a> {
    less: Option<(char, Kind)>,
    more: Option<(char, Kind)>,
    /// The bytes of the rules in whose place the new symbol comes.
    at: Range<usize>,
    /// The text before the arrow.
    rule: &'a str,
}

impl Repair {
    /// The change of one symbol of a student's own rules after which they draw the target. All drawings that are tried
    /// charge one meter; a spent one ends the search.
    pub(crate) fn of(exercise: &Exercise, student: &Definition, meter: &mut Meter) -> Option<Self> {
        let target = &exercise.target;
        let n = exercise.complete(student).iterations;
        if n != target.iterations {
            return None;
        }
        let mut late = None;
        let mut early = ink(&Definition { iterations: n.min(STEPS), ..target.clone() }, MAX[0], meter)?;
        let mut is_right = |whole: &Definition, meter: &mut Meter| {
            let is_early = drawn(&Definition { iterations: n.min(STEPS), ..whole.clone() }, MAX[0], meter)
                .is_some_and(|figure| is_of(&mut early, &figure));
            if !is_early || n <= STEPS {
                return is_early;
            }
            let late = late.get_or_insert_with(|| ink(target, MAX[1], meter)).as_mut();
            late.zip(drawn(whole, MAX[1], meter)).is_some_and(|(late, figure)| is_of(late, &figure))
        };
        if is_right(&exercise.complete(student), meter) {
            return None;
        }
        for Change { less, more, at, rule } in changes(exercise, student) {
            let new = more.map(|(symbol, _)| symbol).into_iter().collect::<String>();
            let rules = [&student.rules[..at.start], &new, &student.rules[at.end..]].concat();
            if is_right(&exercise.complete(&Definition { rules, ..student.clone() }), meter) {
                return Some(Self { less, more: more.map(|(_, kind)| kind), rule: rule.to_owned() });
            }
            if meter.is_spent() {
                break;
            }
        }
        None
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rule = &self.rule;
        match (self.less, self.more) {
            (Some((_, Kind::Turn)), Some(Kind::Turn)) => {
                f.write_str(&say!("One turn in the rule of {} is the wrong one.", rule))
            }
            (Some((_, Kind::Turn)), Some(_)) => {
                f.write_str(&say!("In the rule of {}, a turn stands where a letter should be.", rule))
            }
            (Some((symbol, _)), Some(Kind::Turn)) => {
                f.write_str(&say!("In the rule of {}, one {} stands where a turn should be.", rule, symbol))
            }
            (Some((symbol, _)), Some(_)) => {
                f.write_str(&say!("One {} in the rule of {} should be another letter.", symbol, rule))
            }
            (None, Some(Kind::Turn)) => f.write_str(&say!("A turn is missing in the rule of {}.", rule)),
            (None, _) => f.write_str(&say!("A letter is missing in the rule of {}.", rule)),
            (Some((_, Kind::Turn)), None) => f.write_str(&say!("There is one turn too many in the rule of {}.", rule)),
            (Some((symbol, _)), None) => {
                f.write_str(&say!("There is one {} too many in the rule of {}.", symbol, rule))
            }
        }
    }
}

/// The predecessor of a rule whose brackets do not match.
pub(crate) fn unmatched(rules: &str) -> Option<&str> {
    rules.lines().filter_map(successor).find_map(|(rule, at, line)| {
        let depth = line[at..].chars().try_fold(0_usize, |depth, symbol| match symbol {
            '[' => Some(depth + 1),
            ']' => depth.checked_sub(1),
            _ => Some(depth),
        });
        (depth != Some(0)).then_some(rule)
    })
}

/// The first [`MAX_CHANGES`] changes of one symbol in the student's plain rules: turns exchanged, then symbols taken away,
/// put in, and exchanged.
fn changes<'a>(exercise: &Exercise, student: &'a Definition) -> Vec<Change<'a>> {
    let actions = Actions::new(&exercise.complete(student));
    let kind = |symbol: char| match actions.of(symbol) {
        [Action::Push | Action::Pop, ..] => Kind::Bracket,
        [] => Kind::Other,
        all if all.iter().all(|action| is_turn(*action)) => Kind::Turn,
        _ => Kind::Other,
    };
    let target = &exercise.target;
    let successors = target.rules.lines().filter_map(successor).flat_map(|(_, at, line)| line[at..].chars());
    let symbols: BTreeSet<char> = target.axiom.chars().chain(successors).filter(|c| !c.is_whitespace()).collect();
    let kinds = symbols.into_iter().map(|symbol| (symbol, kind(symbol)));
    let alphabet: Vec<(char, Kind)> = kinds.filter(|(_, kind)| *kind != Kind::Bracket).collect();
    let turns: Vec<(char, Kind)> = alphabet.iter().copied().filter(|(_, kind)| *kind == Kind::Turn).collect();
    // Each symbol of the rules that may be taken away, and the end of each line.
    let places = || {
        let starts = student.rules.split('\n').scan(0, |next, line| {
            *next += line.len() + 1;
            Some((*next - line.len() - 1, successor(line)))
        });
        starts.filter_map(|(start, line)| Some((start, line?))).flat_map(|(start, (rule, at, line))| {
            let ends = line[at..].char_indices().map(move |(offset, symbol)| (at + offset, Some(symbol)));
            ends.chain([(line.len(), None)]).map(move |(at, symbol)| (rule, start + at, symbol))
        })
    };
    let mut all = Vec::new();
    for rank in 0..4 {
        for (rule, from, symbol) in places() {
            let own = symbol.filter(|symbol| !symbol.is_whitespace()).map(|symbol| (symbol, kind(symbol)));
            let own = own.filter(|(_, kind)| *kind != Kind::Bracket);
            let is_turn = own.is_some_and(|(_, kind)| kind == Kind::Turn);
            let (less, more) = match (rank, own) {
                (0, Some(_)) if is_turn => (own, &turns[..]),
                (2, _) => (None, &alphabet[..]),
                (3, Some(_)) => (own, &alphabet[..]),
                _ => (own, &[][..]),
            };
            let is_other =
                |more: &&(char, Kind)| Some(**more) != less && !(rank == 3 && is_turn && more.1 == Kind::Turn);
            let at = from..from + less.map_or(0, |(symbol, _)| symbol.len_utf8());
            let none = (rank == 1 && own.is_some()).then_some(None);
            for more in more.iter().filter(is_other).map(|more| Some(*more)).chain(none) {
                if all.len() == MAX_CHANGES {
                    return all;
                }
                all.push(Change { less, more, at: at.clone(), rule });
            }
        }
    }
    all
}

/// The predecessor of a plain rule, and where its successor begins; `None` for other lines.
fn successor(line: &str) -> Option<(&str, usize, &str)> {
    let (predecessor, rest) = line.split_once("->")?;
    let is_plain =
        !line.contains(['(', '#', ':', '<', '>']) || !rest.contains(['(', '#', ':']) && predecessor.len() < 3;
    is_plain.then(|| (predecessor.trim(), predecessor.len() + 2, line))
}

fn is_turn(action: Action) -> bool {
    action.row().motion == Motion::Turn && action != Action::RollUpright
}

/// A drawing of at most `most` segments. `None` as well if the meter is spent.
pub(crate) fn drawn(definition: &Definition, most: u64, meter: &mut Meter) -> Option<Figure> {
    let mut thin = definition.clone();
    (thin.style.width, thin.style.width_factor) = (0.0, 1.0);
    let limits = Limits { segments: most, ..LIMITS };
    meter.charge((thin.axiom.len() + thin.rules.len()) as u64);
    let mut drawer = Figure::drawer(&compiled(&thin).ok()?, definition.iterations, limits);
    let progress = drawer.step(meter.left());
    meter.charge(drawer.spent());
    if progress == Progress::More {
        return None;
    }
    let figure = drawer.finish().ok()?;
    figure.check_size(most).ok()?;
    meter.charge(figure.segment_count() as u64);
    Some(figure)
}

pub(crate) fn ink(definition: &Definition, most: u64, meter: &mut Meter) -> Option<Outline> {
    let (segments, sides) = lists(&drawn(definition, most, meter)?)?;
    Outline::new(&segments, &sides)
}

pub(crate) fn is_of(ink: &mut Outline, figure: &Figure) -> bool {
    lists(figure).is_some_and(|(segments, sides)| ink.is_of(&segments, &sides) == Some(true))
}
