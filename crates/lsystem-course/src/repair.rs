//! The one symbol by which an answer differs from a right one, found by trying every change of one symbol.

use crate::actions::Actions;
use crate::compiled::compiled;
use crate::exercise::Exercise;
use crate::same::Outline;
use crate::sketch::{LIMITS, lists};
use core::fmt;
use lsystem_base::Limits;
use lsystem_base::say;
use lsystem_base::sorted;
use lsystem_drawing::Figure;
use lsystem_syntax::{Action, Definition, Motion};

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

/// A rule's text in which one symbol is exchanged.
struct Change {
    repair: Repair,
    rules: String,
}

impl Repair {
    /// The change of one symbol of a student's own rules after which they draw the target.
    pub(crate) fn of(exercise: &Exercise, student: &Definition) -> Option<Self> {
        let target = &exercise.target;
        let n = exercise.complete(student).iterations;
        if n != target.iterations {
            return None;
        }
        let mut late = None;
        let mut early = ink(&Definition { iterations: n.min(STEPS), ..target.clone() }, MAX[0])?;
        let mut is_right = |whole: &Definition| {
            let is_early = drawn(&Definition { iterations: n.min(STEPS), ..whole.clone() }, MAX[0])
                .is_some_and(|figure| is_of(&mut early, &figure));
            if !is_early || n <= STEPS {
                return is_early;
            }
            late = late.take().or_else(|| ink(target, MAX[1]));
            drawn(whole, MAX[1]).is_some_and(|figure| late.as_mut().is_some_and(|late| is_of(late, &figure)))
        };
        if is_right(&exercise.complete(student)) {
            return None;
        }
        changes(exercise, student).take(MAX_CHANGES).find_map(|Change { repair, rules }| {
            let whole = exercise.complete(&Definition { rules, ..student.clone() });
            is_right(&whole).then_some(repair)
        })
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

/// All changes of one symbol in the student's plain rules: turns exchanged, symbols taken away, put in, exchanged.
fn changes(exercise: &Exercise, student: &Definition) -> impl Iterator<Item = Change> {
    let actions = Actions::new(&exercise.complete(student));
    let kind = |symbol: char| match actions.of(symbol) {
        [Action::Push | Action::Pop, ..] => Kind::Bracket,
        [] => Kind::Other,
        all if all.iter().all(|action| is_turn(*action)) => Kind::Turn,
        _ => Kind::Other,
    };
    let mut alphabet: Vec<(char, Kind)> = exercise
        .target
        .axiom
        .chars()
        .chain(exercise.target.rules.lines().filter_map(successor).flat_map(|(_, at, line)| line[at..].chars()))
        .filter(|symbol| !symbol.is_whitespace())
        .map(|symbol| (symbol, kind(symbol)))
        .filter(|(_, kind)| *kind != Kind::Bracket)
        .collect();
    sorted::sort_by_key(&mut alphabet, |(symbol, _)| *symbol);
    alphabet.dedup_by_key(|(symbol, _)| *symbol);
    let mut all = Vec::new();
    let mut first = 0;
    for line in student.rules.split('\n') {
        if let Some((rule, at, _)) = successor(line) {
            let mut put = |from: usize, to: usize, less: Option<(char, Kind)>, more: Option<(char, Kind)>| {
                let new = more.map(|(symbol, _)| symbol).into_iter().collect::<String>();
                let rules = [&student.rules[..first + from], &new, &student.rules[first + to..]].concat();
                let repair = Repair { less, more: more.map(|(_, kind)| kind), rule: rule.to_owned() };
                let is_turns = |(_, kind): (char, Kind)| kind == Kind::Turn;
                let rank = match (less, more) {
                    (Some(less), Some(more)) if is_turns(less) && is_turns(more) => 0,
                    (_, None) => 1,
                    (None, _) => 2,
                    _ => 3,
                };
                all.push((rank, Change { repair, rules }));
            };
            for (offset, symbol) in line[at..].char_indices() {
                let (from, to) = (at + offset, at + offset + symbol.len_utf8());
                for &more in &alphabet {
                    put(from, from, None, Some(more));
                }
                if symbol.is_whitespace() || kind(symbol) == Kind::Bracket {
                    continue;
                }
                let less = Some((symbol, kind(symbol)));
                put(from, to, less, None);
                for &more in alphabet.iter().filter(|more| more.0 != symbol) {
                    put(from, to, less, Some(more));
                }
            }
            for &more in &alphabet {
                put(line.len(), line.len(), None, Some(more));
            }
        }
        first += line.len() + 1;
    }
    sorted::sort_by_key(&mut all, |(rank, _)| *rank);
    all.into_iter().map(|(_, change)| change)
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

pub(crate) fn drawn(definition: &Definition, most: u64) -> Option<Figure> {
    let mut thin = definition.clone();
    (thin.style.width, thin.style.width_factor) = (0.0, 1.0);
    let limits = Limits { segments: most, ..LIMITS };
    let figure = Figure::draw(&compiled(&thin).ok()?, definition.iterations, &limits).ok()?;
    figure.check_size(most).ok()?;
    Some(figure)
}

pub(crate) fn ink(definition: &Definition, most: u64) -> Option<Outline> {
    let (segments, sides) = lists(&drawn(definition, most)?)?;
    Outline::new(&segments, &sides)
}

pub(crate) fn is_of(ink: &mut Outline, figure: &Figure) -> bool {
    lists(figure).is_some_and(|(segments, sides)| ink.is_of(&segments, &sides) == Some(true))
}
