//! A derivation gone through depth first: the letters of the last generation in order, none before it held.
//! Whoever knows what becomes of some letters takes these as soon as they occur.

use crate::{Choice, Key, LetterId, Rewrite, Rules};

/// Where a derivation stands. It holds no references, so it can rest between two calls.
#[derive(Clone, Debug)]
pub struct Walk {
    n: u32,
    seed: u32,
    /// The words that are being gone through, outermost first.
    open: Vec<Word>,
    /// The letters met so far, in all generations.
    pub work: u64,
}

#[derive(Clone, Debug)]
struct Word {
    source: Source,
    /// The letter to read next.
    next: usize,
    /// Of the letter that this word replaced.
    key: Key,
    /// The derivation step that made the letter that this word replaced, or the first of its kind in its place.
    since: u32,
}

#[derive(Clone, Copy, Debug)]
enum Source {
    Axiom,
    /// The successor of a letter, by its place among the choices.
    Successor(LetterId, usize),
}

/// What is special about a module.
#[derive(Clone, Copy, Debug)]
pub struct Fate {
    /// Its key.
    pub key: Key,
    /// The derivation step in which it was made, or the first of its letter in its place.
    pub since: u32,
    /// Whether it is still growing.
    pub grows: bool,
}

/// What comes next.
pub enum Next {
    /// A letter of the last generation, or one that is known, and the steps that it has yet to go.
    Letter(LetterId, u32),
    /// The given work is spent.
    Pause,
    /// The whole derivation has been gone through.
    End,
}

impl Walk {
    /// Before the first letter of generation `n`.
    #[must_use]
    pub fn new(n: u32, seed: u32) -> Self {
        Self { n, seed, open: vec![Word { source: Source::Axiom, next: 0, key: Key::root(0), since: 0 }], work: 0 }
    }

    /// Goes on to the next letter that is `known` or of the last generation, until `self.work` is `until`.
    pub fn next(&mut self, rules: &Rules, known: impl Fn(LetterId) -> bool, until: u64) -> Next {
        loop {
            // The axiom's letters are generation 0.
            let generation = self.open.len() as u32 - 1;
            let Some(word) = self.open.last_mut() else { return Next::End };
            let Some(&symbol) = letters(rules, word.source).get(word.next) else {
                if generation == 0 {
                    return Next::End;
                }
                self.open.pop();
                continue;
            };
            if self.work >= until {
                return Next::Pause;
            }
            let index = word.next as u64;
            word.next += 1;
            self.work += 1;
            if generation == self.n || known(symbol) {
                return Next::Letter(symbol, self.n - generation);
            }
            let key = word.key(generation, index);
            let since = word.since(generation, symbol);
            let step = generation + 1;
            let choice = match &rules.rewrites[usize::from(symbol)] {
                Rewrite::Keep => return Next::Letter(symbol, 0),
                Rewrite::Always(_) => 0,
                Rewrite::Choose(choices) => Choice::of(choices, key.choice(self.seed, step)),
            };
            self.open.push(Word { source: Source::Successor(symbol, choice), next: 0, key, since });
        }
    }

    /// What is special about the letter that was given last; `heir` says which of the letters that replace one goes on in
    /// its place.
    pub fn fate(
        &self,
        rules: &Rules,
        symbol: LetterId,
        mut heir: impl FnMut(LetterId, &[LetterId]) -> Option<usize>,
    ) -> Fate {
        let generation = self.open.len().saturating_sub(1) as u32;
        let Some(word) = self.open.last() else { return Fate { key: Key::root(0), since: 0, grows: false } };
        let index = word.next.saturating_sub(1);
        let grows = match word.source {
            Source::Successor(former, _) if generation == self.n => {
                heir(former, letters(rules, word.source)) != Some(index)
            }
            _ => false,
        };
        Fate { key: word.key(generation, index as u64), since: word.since(generation, symbol), grows }
    }
}

impl Word {
    /// Of its letter at `index`, in this generation.
    fn key(&self, generation: u32, index: u64) -> Key {
        match self.source {
            Source::Axiom => Key::root(index),
            Source::Successor(..) => self.key.child(generation, index),
        }
    }

    /// Since which generation there has been a `symbol` in the place of one of its letters, in this generation.
    fn since(&self, generation: u32, symbol: LetterId) -> u32 {
        match self.source {
            Source::Successor(former, _) if former == symbol => self.since,
            _ => generation,
        }
    }
}

fn letters(rules: &Rules, source: Source) -> &[LetterId] {
    match source {
        Source::Axiom => &rules.axiom.letters,
        Source::Successor(symbol, choice) => match &rules.rewrites[usize::from(symbol)] {
            Rewrite::Keep => &[],
            Rewrite::Always(word) => word,
            Rewrite::Choose(choices) => choices.get(choice).map_or(&[], |c| &c.successor),
        },
    }
}
