//! Exact counts of any generation without derivation.
//!
//! The count of a letter after d steps is the sum of the counts of its successor's letters after d - 1 steps. A count
//! therefore takes one pass over all successors for each step, independent of the string's length.

use crate::{LetterId, Rewrite, Rules, Tally};
use lsystem_base::{MAX_COUNTING, Meter, Progress};

/// The most units of work of [`Counter::finish`].
const MAX_WORK: u64 = 1 << 27;

/// A count of a generation, made in resumable steps. It holds no references, so that callers may store it between two
/// steps.
#[derive(Clone, Debug)]
pub struct Counter {
    sums: SuccessorCounts,
    /// By letter: its sum after `steps` derivation steps; `None` if unknown.
    totals: Vec<Option<Tally>>,
    /// By letter: its sum after one more step, as far as computed.
    next: Vec<Option<Tally>>,
    steps: u32,
    n: u32,
    at: CounterPlace,
    /// The bytes of the numbers in `next`.
    bytes: usize,
    /// `None` while counting.
    count: Option<Option<Tally>>,
    spent: u64,
}

/// The place of the next addition: the index of the rewritten letter, of its alternative, and of the entry in it.
#[derive(Clone, Debug, Default)]
struct CounterPlace {
    letter: usize,
    alternative: usize,
    entry: usize,
    /// The sum of this alternative so far, and the sum of the first alternative.
    sum: Tally,
    first: Option<Tally>,
}

impl Counter {
    /// A counter of the symbols of generation `n`. A module with arguments counts as one symbol.
    #[must_use]
    pub fn symbols(rules: &Rules, n: u32) -> Self {
        Self::weighing(rules, n, Some(&vec![1; rules.letters.len()]))
    }

    /// A counter of the sum of `weights`, one for each letter, over generation `n`. Without weights the count is
    /// `None`.
    #[must_use]
    pub fn weighing(rules: &Rules, n: u32, weights: Option<&[u64]>) -> Self {
        let known = weights.is_some() && !rules.is_cutting();
        let weight = |letter: usize| weights.map_or(0, |weights| weights[letter]);
        let totals: Vec<_> = (0..rules.letters.len()).map(|letter| Some(Tally::from(weight(letter)))).collect();
        let (next, at) = (vec![None; totals.len()], CounterPlace::default());
        let count = if known { None } else { Some(None) };
        Self { sums: SuccessorCounts::new(rules), totals, next, steps: 0, n, at, bytes: 0, count, spent: 0 }
    }

    /// The count. `None` while counting, if the count depends on random choices, contexts, conditions or cut branches,
    /// or if the intermediate numbers take more than [`MAX_COUNTING`] bytes.
    #[must_use]
    pub fn count(&self) -> Option<&Tally> {
        self.count.as_ref()?.as_ref()
    }

    /// Whether counting has ended.
    #[must_use]
    pub fn is_done(&self) -> bool {
        self.count.is_some()
    }

    /// The units of work of all steps.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Counts to the end, and returns the count as [`Counter::count`] does; `None` also if that takes more than
    /// about a second.
    #[must_use]
    pub fn finish(mut self) -> Option<Tally> {
        self.step(MAX_WORK);
        self.count.flatten()
    }

    /// Counts for about `work` units of work.
    pub fn step(&mut self, work: u64) -> Progress {
        let mut meter = Meter::new(work);
        while self.count.is_none() && !meter.is_spent() {
            self.add(&mut meter);
        }
        self.spent = self.spent.saturating_add(meter.spent().max(1));
        if self.count.is_some() { Progress::Done } else { Progress::More }
    }

    /// Continues the sum of one letter, or at the end the sum of the axiom.
    fn add(&mut self, meter: &mut Meter) {
        meter.charge(1);
        let Self { sums, totals, next, at, .. } = self;
        let last = self.steps == self.n;
        let letter = sums.rewritten.get(at.letter).map(|&letter| usize::from(letter));
        let alternatives = match letter {
            _ if last => core::slice::from_ref(&sums.axiom),
            Some(letter) => &sums.alternatives[letter],
            None => {
                // All letters have their sums for this step.
                for &letter in &sums.rewritten {
                    core::mem::swap(&mut totals[usize::from(letter)], &mut next[usize::from(letter)]);
                }
                meter.charge(sums.rewritten.len() as u64 / 4);
                self.steps += 1;
                (self.bytes, *at) = (0, CounterPlace::default());
                return;
            }
        };
        let word = &alternatives[at.alternative];
        let mut known = true;
        while let Some(&(symbol, times)) = word.get(at.entry)
            && !meter.is_spent()
        {
            let Some(total) = &totals[usize::from(symbol)] else {
                known = false;
                break;
            };
            at.sum.add_times(times, total);
            at.entry += 1;
            meter.charge(1 + total.limbs() as u64 / 4);
        }
        if known && at.entry < word.len() {
            return;
        }
        let sum = core::mem::take(&mut at.sum);
        at.entry = 0;
        at.alternative += 1;
        known &= at.first.as_ref().is_none_or(|first| *first == sum);
        if known && at.alternative < alternatives.len() {
            at.first = Some(sum);
            return;
        }
        let sum = known.then_some(sum);
        if last {
            self.count = Some(sum);
            return;
        }
        self.bytes += sum.as_ref().map_or(0, |sum| 4 * sum.limbs());
        if let Some(letter) = letter {
            next[letter] = sum;
        }
        *at = CounterPlace { letter: at.letter + 1, ..CounterPlace::default() };
        if 2 * self.bytes as u64 > MAX_COUNTING {
            self.count = Some(None);
        }
    }
}

/// The sums of `weight` over the letters of generations 0, 1 and so on, up to generation `n` or the first sum above
/// `limit`. An error if a sum depends on random choices, or if the meter is spent.
pub(crate) fn counts_until(
    rules: &Rules,
    n: u32,
    limit: u64,
    weight: impl Fn(LetterId) -> u64,
    meter: &mut Meter,
) -> Result<Vec<u128>, Unknown> {
    let sums = SuccessorCounts::new(rules);
    let mut totals: Vec<Option<Saturating>> = sums.start(&weight);
    let mut generations = Vec::new();
    for generation in 0..=n {
        if generation > 0 {
            sums.step(&mut totals);
        }
        meter.charge(sums.size());
        if meter.is_spent() {
            return Err(Unknown);
        }
        let total = sum(&sums.axiom, &totals).ok_or(Unknown)?.0;
        generations.push(total);
        if total > u128::from(limit) {
            break;
        }
    }
    Ok(generations)
}

/// Calls `nonzero(generation, is_nonzero)` for generations 0 to `last`. `is_nonzero`: the sum of `weight`
/// over the generation's letters is above 0; `None` if it is unknown. Stops if `nonzero` returns true. Returns false if
/// the meter was spent first.
pub fn weigh_until(
    rules: &Rules,
    last: u32,
    weight: impl Fn(LetterId) -> u64,
    meter: &mut Meter,
    mut nonzero: impl FnMut(u32, Option<bool>) -> bool,
) -> bool {
    let sums = SuccessorCounts::new(rules);
    let mut totals: Vec<Option<Saturating>> = sums.start(&weight);
    for generation in 0..=last {
        if generation > 0 {
            sums.step(&mut totals);
        }
        meter.charge(sums.size());
        if meter.is_spent() {
            return false;
        }
        if nonzero(generation, sum(&sums.axiom, &totals).map(|total| total.0 > 0)) {
            return true;
        }
    }
    true
}

/// The error for a count that depends on random choices or takes too long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unknown;

/// The most cells of [`Depths`], 16 bytes each.
pub(crate) const MAX_CELLS: usize = 1 << 19;

/// By depth from 0 to `n`, then by letter: the saturating sum of the letter after `depth` derivation steps.
#[derive(Clone, Debug)]
pub(crate) struct Depths {
    /// By letter: its column; [`FIXED`] if its sum is the same at every depth.
    columns: Vec<u32>,
    width: usize,
    cells: Vec<u128>,
    /// By letter: its own weight.
    own: Vec<u64>,
}

const FIXED: u32 = u32::MAX;

impl Depths {
    /// The sums of `weight` for all letters that may occur. Letters with several possible successors count as
    /// themselves.
    /// `None` if there are more than [`MAX_CELLS`] sums, or if the meter is spent.
    pub(crate) fn new(rules: &Rules, n: u32, weight: impl Fn(LetterId) -> u64, meter: &mut Meter) -> Option<Self> {
        let own: Vec<u64> = (0..rules.letters.len()).map(|symbol| weight(symbol as LetterId)).collect();
        let sums = SuccessorCounts::new(rules);
        let changing = |letter: LetterId| matches!(rules.rewrites[usize::from(letter)], Rewrite::Always(_));
        let rewritten: Vec<LetterId> = sums.rewritten.iter().copied().filter(|&letter| changing(letter)).collect();
        let width = rewritten.len();
        let rows = n as usize + 1;
        let cost = sums.size().saturating_mul(u64::from(n));
        if width.saturating_mul(rows) > MAX_CELLS || cost > meter.left() {
            return None;
        }
        meter.charge(cost);
        let mut columns = vec![FIXED; own.len()];
        rewritten.iter().enumerate().for_each(|(column, &letter)| columns[usize::from(letter)] = column as u32);
        let mut cells = Vec::with_capacity(width * rows);
        cells.extend(rewritten.iter().map(|&letter| u128::from(own[usize::from(letter)])));
        let mut depths = Self { columns, width, cells, own };
        for depth in 1..rows {
            for &letter in &rewritten {
                let mut sum = Saturating(0);
                for &(symbol, times) in sums.alternatives[usize::from(letter)].iter().flatten() {
                    sum.add_times(times, &Saturating(depths.get(depth - 1, symbol)));
                }
                depths.cells.push(sum.0);
            }
        }
        Some(depths)
    }

    /// The sum of `letter` after `depth` derivation steps.
    pub(crate) fn get(&self, depth: usize, letter: LetterId) -> u128 {
        match self.columns[usize::from(letter)] {
            FIXED => u128::from(self.own[usize::from(letter)]),
            column => self.cells[depth * self.width + column as usize],
        }
    }

    /// The index of a letter's sum among all cells; `None` if the sum is the same at every depth.
    pub(crate) fn cell(&self, depth: usize, letter: LetterId) -> Option<usize> {
        let column = self.columns[usize::from(letter)];
        (column != FIXED).then(|| depth * self.width + column as usize)
    }

    /// The number of cells: sums that depend on the depth.
    pub(crate) fn cells(&self) -> usize {
        self.cells.len()
    }

    /// The saturating sum of a word after `depth` derivation steps.
    pub(crate) fn sum(&self, depth: usize, word: &[LetterId]) -> u128 {
        word.iter().fold(0, |sum: u128, &letter| sum.saturating_add(self.get(depth, letter)))
    }
}

/// A number that sums are made of.
trait Total: Clone + PartialEq + From<u64> {
    fn add_times(&mut self, times: u32, other: &Self);
}

/// A number that saturates instead of overflowing.
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

/// By letter: the letters of each possible successor with their numbers of occurrences.
#[derive(Clone, Debug)]
struct SuccessorCounts {
    alternatives: Vec<Vec<Multiset>>,
    /// The letters that have alternatives.
    rewritten: Vec<LetterId>,
    axiom: Multiset,
}

type Multiset = Vec<(LetterId, u32)>;

impl SuccessorCounts {
    fn new(rules: &Rules) -> Self {
        let reachable = rules.reachable();
        let mut times = vec![0; rules.letters.len()];
        let alternatives: Vec<Vec<Multiset>> = (rules.rewrites.iter().zip(reachable))
            .map(|(rewrite, reached)| match rewrite {
                // Unreachable letters need no count, and their successors may be long.
                _ if !reached => vec![],
                Rewrite::Keep => vec![],
                Rewrite::Always(successor) => vec![multiset(successor, &mut times)],
                Rewrite::Choose(alternatives) => {
                    let mut all: Vec<Multiset> =
                        alternatives.iter().map(|c| multiset(&c.successor, &mut times)).collect();
                    all.dedup();
                    all
                }
            })
            .collect();
        let letters = alternatives.iter().enumerate().filter(|(_, all)| !all.is_empty());
        let rewritten = letters.map(|(letter, _)| letter as LetterId).collect();
        Self { alternatives, rewritten, axiom: multiset(&rules.axiom.letters, &mut times) }
    }

    fn start<T: Total>(&self, weight: &impl Fn(LetterId) -> u64) -> Vec<Option<T>> {
        (0..self.alternatives.len()).map(|symbol| Some(T::from(weight(symbol as LetterId)))).collect()
    }

    /// The units of work of one step.
    fn size(&self) -> u64 {
        let entries: usize =
            self.rewritten.iter().flat_map(|&l| &self.alternatives[usize::from(l)]).map(|m| m.len() + 1).sum();
        (entries + self.axiom.len()) as u64 / 4 + 1
    }

    /// Advances all sums by one derivation step.
    fn step<T: Total>(&self, totals: &mut [Option<T>]) {
        let of = |&letter: &LetterId| {
            let (first, rest) = self.alternatives[usize::from(letter)].split_first()?;
            let total = sum(first, totals)?;
            rest.iter().all(|other| sum(other, totals).as_ref() == Some(&total)).then_some(total)
        };
        let next: Vec<Option<T>> = self.rewritten.iter().map(of).collect();
        self.rewritten.iter().zip(next).for_each(|(&letter, total)| totals[usize::from(letter)] = total);
    }
}

fn sum<T: Total>(letters: &Multiset, totals: &[Option<T>]) -> Option<T> {
    let mut sum = T::from(0);
    for &(symbol, times) in letters {
        sum.add_times(times, totals[usize::from(symbol)].as_ref()?);
    }
    Some(sum)
}

/// The letters of `word` with their numbers of occurrences, sorted. `counted` is scratch: zeros by letter, before and
/// after.
fn multiset(word: &[LetterId], counted: &mut [u32]) -> Multiset {
    let mut letters = Multiset::new();
    for &symbol in word {
        let count = &mut counted[usize::from(symbol)];
        if *count == 0 {
            letters.push((symbol, 0));
        }
        *count += 1;
    }
    lsystem_base::sorted::sort(&mut letters);
    letters.iter_mut().for_each(|(symbol, times)| *times = core::mem::take(&mut counted[usize::from(*symbol)]));
    letters
}
