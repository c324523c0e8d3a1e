//! Exact counts of any generation, without expanding it.
//!
//! What a letter derives in d steps is what its successor's letters derive in d - 1 steps, so a count is a sum over
//! the successor: d times |alphabet| additions, however long the string.

use crate::program::{Program, Rewrite, SymbolId};
use crate::{Rules, System, Tally};

/// How many symbols generation `n` has, modules with parameters counted as one; `None` where that depends on random
/// choices, contexts, conditions or cut branches.
#[must_use]
pub fn count_symbols(system: &System, n: u32) -> Option<Tally> {
    if system.rules.as_ref().is_some_and(Rules::is_cutting) {
        return None;
    }
    count(&system.program, n, |_| 1)
}

/// How many segments generation `n` draws; `None` where that depends on random choices, contexts, conditions or
/// cut branches.
#[must_use]
pub fn count_segments(system: &System, n: u32) -> Option<Tally> {
    if system.rules.as_ref().is_some_and(Rules::is_cutting) {
        return None;
    }
    let segments = drawn_by_letter(system)?;
    count(&system.program, n, |symbol| segments[usize::from(symbol)])
}

/// By letter: how many segments it draws, 0 for one that never occurs; `None` where one that may occur does not always
/// draw as many.
pub(crate) fn drawn_by_letter(system: &System) -> Option<Vec<u64>> {
    let drawn = |symbol| match &system.rules {
        None => Some(segments_of(system, symbol)),
        Some(rules) => drawn_as(system, rules, symbol),
    };
    let reachable = system.program.reachable();
    (reachable.iter().enumerate()).map(|(id, reached)| if *reached { drawn(id as SymbolId) } else { Some(0) }).collect()
}

/// The segments of what a letter is drawn as; `None` where they are not always as many.
fn drawn_as(system: &System, rules: &Rules, letter: SymbolId) -> Option<u64> {
    let images = &rules.images[usize::from(letter)];
    let mut all =
        images.iter().map(|image| image.successor.letters.iter().map(|&letter| segments_of(system, letter)).sum());
    let always = images.iter().any(|image| image.condition.is_none() && image.weight.is_none());
    let own = (!always).then(|| segments_of(system, letter));
    let first: u64 = own.or_else(|| all.next())?;
    all.all(|other| other == first).then_some(first)
}

/// The segments that one letter draws by itself.
pub(crate) fn segments_of(system: &System, symbol: SymbolId) -> u64 {
    let actions = &system.turtle.actions[usize::from(symbol)];
    actions.iter().filter(|action| action.draws()).count() as u64
}

/// The sum of `weight` over the letters of generation `n`; `None` where it depends on random choices.
#[must_use]
pub fn count(program: &Program, n: u32, weight: impl Fn(SymbolId) -> u64) -> Option<Tally> {
    let sums = Sums::new(program);
    let mut totals: Vec<Option<Tally>> = sums.start(&weight);
    for _ in 0..n {
        totals = sums.step(&totals);
    }
    sums.of(&program.axiom, &totals)
}

/// By generation from 0: the sum of `weight` over its letters, up to the first sum above `limit` or generation `n`.
/// Ends early with what is known where a sum depends on random choices.
pub(crate) fn counts_until(
    program: &Program,
    n: u32,
    limit: u64,
    weight: impl Fn(SymbolId) -> u64,
) -> Result<Vec<u128>, Unknown> {
    let sums = Sums::new(program);
    let mut totals: Vec<Option<Saturating>> = sums.start(&weight);
    let mut generations = Vec::new();
    for generation in 0..=n {
        if generation > 0 {
            totals = sums.step(&totals);
        }
        let total = sums.of(&program.axiom, &totals).ok_or(Unknown)?.0;
        generations.push(total);
        if total > u128::from(limit) {
            break;
        }
    }
    Ok(generations)
}

/// A count depends on random choices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unknown;

/// By depth from 0 to `n`, then letter: the sum of `weight` over what the letter derives in that many steps,
/// saturating. Letters with random choices count as themselves.
pub(crate) fn sums_by_depth(program: &Program, n: u32, weight: impl Fn(SymbolId) -> u64) -> Vec<Vec<u128>> {
    let own = (0..program.alphabet.len()).map(|symbol| u128::from(weight(symbol as SymbolId))).collect();
    let successors: Vec<Option<Multiset>> = (program.rewrites.iter())
        .map(|rewrite| if let Rewrite::Always(word) = rewrite { Some(multiset(word)) } else { None })
        .collect();
    let mut rows: Vec<Vec<u128>> = vec![own];
    for depth in 1..=n as usize {
        let below = &rows[depth - 1];
        let of = |letters: &Multiset| {
            let mut sum = Saturating(0);
            letters.iter().for_each(|&(s, times)| sum.add_times(times, &Saturating(below[usize::from(s)])));
            sum.0
        };
        let row = successors.iter().zip(below).map(|(letters, &own)| letters.as_ref().map_or(own, of)).collect();
        rows.push(row);
    }
    rows
}

/// The sum of the letters' numbers over a word, saturating.
pub(crate) fn sum_of(by_letter: &[u128], word: &[SymbolId]) -> u128 {
    word.iter().fold(0, |sum: u128, &s| sum.saturating_add(by_letter[usize::from(s)]))
}

/// What sums need of a number.
trait Total: Clone + PartialEq + From<u64> {
    fn add_times(&mut self, times: u32, other: &Self);
}

impl Total for Tally {
    fn add_times(&mut self, times: u32, other: &Self) {
        Self::add_times(self, times, other);
    }
}

/// A number that stays at its greatest value instead of overflowing.
#[derive(Clone, Copy, PartialEq)]
struct Saturating(u128);

impl From<u64> for Saturating {
    fn from(count: u64) -> Self {
        Self(u128::from(count))
    }
}

impl Total for Saturating {
    fn add_times(&mut self, times: u32, other: &Self) {
        self.0 = self.0.saturating_add(other.0.saturating_mul(u128::from(times)));
    }
}

/// By letter: how often each letter occurs in its successor; several rows where the choice is random.
struct Sums {
    alternatives: Vec<Vec<Multiset>>,
}

type Multiset = Vec<(SymbolId, u32)>;

impl Sums {
    fn new(program: &Program) -> Self {
        let reachable = program.reachable();
        let alternatives = (program.rewrites.iter().zip(reachable))
            .map(|(rewrite, reached)| match rewrite {
                // What never occurs need not be counted, and may be very much.
                _ if !reached => vec![],
                Rewrite::Keep => vec![],
                Rewrite::Always(successor) => vec![multiset(successor)],
                Rewrite::Choose(choices) => {
                    let mut all: Vec<Multiset> = choices.iter().map(|c| multiset(&c.successor)).collect();
                    all.dedup();
                    all
                }
            })
            .collect();
        Self { alternatives }
    }

    fn start<T: Total>(&self, weight: &impl Fn(SymbolId) -> u64) -> Vec<Option<T>> {
        (0..self.alternatives.len()).map(|symbol| Some(T::from(weight(symbol as SymbolId)))).collect()
    }

    /// The totals after one step more.
    fn step<T: Total>(&self, totals: &[Option<T>]) -> Vec<Option<T>> {
        (self.alternatives.iter().zip(totals))
            .map(|(alternatives, own)| {
                let Some((first, rest)) = alternatives.split_first() else { return own.clone() };
                let total = sum(first, totals)?;
                rest.iter().all(|other| sum(other, totals).as_ref() == Some(&total)).then_some(total)
            })
            .collect()
    }

    fn of<T: Total>(&self, word: &[SymbolId], totals: &[Option<T>]) -> Option<T> {
        sum(&multiset(word), totals)
    }
}

fn sum<T: Total>(letters: &Multiset, totals: &[Option<T>]) -> Option<T> {
    let mut sum = T::from(0);
    for &(symbol, times) in letters {
        sum.add_times(times, totals[usize::from(symbol)].as_ref()?);
    }
    Some(sum)
}

/// The letters of `word` with how often each occurs, sorted.
fn multiset(word: &[SymbolId]) -> Multiset {
    let mut sorted = word.to_vec();
    lsystem_syntax::sorted::sort(&mut sorted);
    let mut letters = Multiset::new();
    for symbol in sorted {
        match letters.last_mut() {
            Some((last, times)) if *last == symbol => *times += 1,
            _ => letters.push((symbol, 1)),
        }
    }
    letters
}
