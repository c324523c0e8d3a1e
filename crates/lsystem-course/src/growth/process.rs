//! A system as a matrix: how many of each letter a letter becomes in one step.

use lsystem_base::word;
use lsystem_derive::{Rewrite, Tally};
use lsystem_drawing::{System, drawn_by_letter};

/// The most letters.
pub(crate) const MAX_LETTERS: usize = 400;

/// One possible successor of a letter: its probability, and the letters in it with their numbers.
#[derive(Clone, Debug)]
pub(crate) struct Outcome {
    pub(crate) chance: f64,
    pub(crate) made: Vec<(usize, u32)>,
}

/// The letters that occur, with what they become. Without chance, each letter has one outcome.
#[derive(Clone, Debug)]
pub(crate) struct Process {
    /// The symbols of the letters, in the order in which the axiom reaches them.
    pub(crate) symbols: Vec<char>,
    pub(crate) outcomes: Vec<Vec<Outcome>>,
    /// How often each letter is in the axiom.
    pub(crate) axiom: Vec<u32>,
    /// How many segments each letter draws.
    pub(crate) drawn: Vec<u32>,
}

impl Process {
    /// # Errors
    /// A sentence that says why the letters cannot be counted by a matrix.
    pub(crate) fn new(system: &System) -> Result<Self, &'static str> {
        let rules = &system.rules;
        if rules.is_parametric() {
            return Err(word!("The letters have parameters, so their numbers follow no fixed matrix."));
        }
        if !rules.is_plain() {
            return Err(word!("The rules depend on neighbours or conditions, so the numbers follow no fixed matrix."));
        }
        let drawn =
            drawn_by_letter(system).ok_or(word!("Branches are cut off, so the numbers follow no fixed matrix."))?;
        // Letters in the order in which the axiom reaches them.
        let mut place = vec![usize::MAX; rules.letters.len()];
        let mut order: Vec<usize> = Vec::new();
        let mut reach = |order: &mut Vec<usize>, letter: usize| {
            if place[letter] == usize::MAX {
                place[letter] = order.len();
                order.push(letter);
            }
            place[letter]
        };
        let tally = |places: Vec<usize>| {
            let mut sorted = places;
            sorted.sort_unstable();
            let mut made: Vec<(usize, u32)> = Vec::new();
            for place in sorted {
                match made.last_mut() {
                    Some((last, count)) if *last == place => *count += 1,
                    _ => made.push((place, 1)),
                }
            }
            made
        };
        let in_axiom: Vec<usize> = rules.axiom.letters.iter().map(|&id| reach(&mut order, usize::from(id))).collect();
        let mut outcomes = Vec::new();
        let mut at = 0;
        while let Some(&letter) = order.get(at) {
            let words: Vec<(f64, Vec<u16>)> = match &rules.rewrites[letter] {
                Rewrite::Keep => vec![(1.0, vec![letter as u16])],
                Rewrite::Always(word) => vec![(1.0, word.clone())],
                Rewrite::Choose(alternatives) => {
                    let before = [0.0].into_iter().chain(alternatives.iter().map(|alternative| alternative.until));
                    let chances = before.zip(alternatives).map(|(before, alternative)| alternative.until - before);
                    chances.zip(alternatives).map(|(chance, one)| (chance, one.successor.clone())).collect()
                }
            };
            let counted = words.into_iter().map(|(chance, word)| Outcome {
                chance,
                made: tally(word.iter().map(|&id| reach(&mut order, usize::from(id))).collect()),
            });
            outcomes.push(counted.collect());
            at += 1;
            if order.len() > MAX_LETTERS {
                return Err(word!("There are more letters than a table can show."));
            }
        }
        let mut axiom = vec![0; order.len()];
        in_axiom.iter().for_each(|&place| axiom[place] += 1);
        Ok(Self {
            symbols: order.iter().map(|&letter| rules.letters[letter].symbol).collect(),
            outcomes,
            axiom,
            drawn: order.iter().map(|&letter| u32::try_from(drawn[letter]).unwrap_or(u32::MAX)).collect(),
        })
    }

    pub(crate) fn letters(&self) -> usize {
        self.symbols.len()
    }

    pub(crate) fn is_random(&self) -> bool {
        self.outcomes.iter().any(|outcomes| outcomes.len() > 1)
    }

    /// The expected number of letters `to` that `from` becomes.
    pub(crate) fn expected(&self, from: usize) -> Vec<f64> {
        let mut row = vec![0.0; self.letters()];
        for outcome in &self.outcomes[from] {
            outcome.made.iter().for_each(|&(to, count)| row[to] += outcome.chance * f64::from(count));
        }
        row
    }

    /// The numbers of all letters one step later. Without chance only.
    pub(crate) fn next(&self, counts: &[Tally]) -> Vec<Tally> {
        let mut next = vec![Tally::ZERO; self.letters()];
        for (outcomes, count) in self.outcomes.iter().zip(counts) {
            for &(to, times) in outcomes.iter().flat_map(|outcome| &outcome.made) {
                next[to].add_times(times, count);
            }
        }
        next
    }

    /// The same modulo a number below 2^63.
    pub(crate) fn next_modulo(&self, counts: &[u64], modulus: u64) -> Vec<u64> {
        let mut next = vec![0_u64; self.letters()];
        for (outcomes, &count) in self.outcomes.iter().zip(counts) {
            for &(to, times) in outcomes.iter().flat_map(|outcome| &outcome.made) {
                let more = u128::from(count) * u128::from(times) + u128::from(next[to]);
                next[to] = (more % u128::from(modulus)) as u64;
            }
        }
        next
    }

    /// The same as expected values.
    pub(crate) fn next_expected(&self, counts: &[f64]) -> Vec<f64> {
        let mut next = vec![0.0; self.letters()];
        for (outcomes, count) in self.outcomes.iter().zip(counts) {
            for outcome in outcomes {
                outcome.made.iter().for_each(|&(to, times)| next[to] += outcome.chance * f64::from(times) * count);
            }
        }
        next
    }
}
