//! Depth-first derivation. The letters of the last generation come in order, and no earlier generation is held in
//! memory. A caller that knows the derivation of a letter takes the letter as soon as it occurs.

use crate::{Alternative, Key, LetterId, Rewrite, Rules};

/// The state of a depth-first derivation. It holds no references, so that callers may store it between two calls.
#[derive(Clone, Debug)]
pub struct DepthFirst {
    n: u32,
    seed: u32,
    /// The words on the path from the axiom to the present letter, outermost first.
    open: Vec<OpenWord>,
    /// The number of letters visited so far, in all generations.
    pub work: u64,
}

#[derive(Clone, Debug)]
struct OpenWord {
    source: WordSource,
    /// The index of the next letter.
    next: usize,
    /// The key of the letter that this word replaced.
    key: Key,
    /// As [`ModuleAge::since`], for the letter that this word replaced.
    since: u32,
}

#[derive(Clone, Copy, Debug)]
enum WordSource {
    Axiom,
    /// The successor of a letter, by its index among the alternatives.
    Successor(LetterId, usize),
}

/// The key and the age of a module.
#[derive(Clone, Copy, Debug)]
pub struct ModuleAge {
    /// The module's key.
    pub key: Key,
    /// The derivation step that made the module, or the oldest ancestor in an unbroken line of the same letter; 0 for
    /// the axiom.
    pub since: u32,
    /// The derivation step that made the module; 0 for the axiom.
    pub step: u32,
    /// Whether the module is new in the last generation and therefore still grows.
    pub grows: bool,
}

/// The result of [`DepthFirst::next`].
pub enum Next {
    /// A letter of the last generation, or a known letter, and the number of derivation steps that remain for the
    /// letter.
    Letter(LetterId, u32),
    /// The budget is spent.
    Pause,
    /// The derivation is complete.
    End,
}

impl DepthFirst {
    /// A walk at the start of generation `n`.
    #[must_use]
    pub fn new(n: u32, seed: u32) -> Self {
        Self {
            n,
            seed,
            open: vec![OpenWord { source: WordSource::Axiom, next: 0, key: Key::root(0), since: 0 }],
            work: 0,
        }
    }

    /// Continues to the next letter that is `known` or of the last generation, or pauses once `self.work` is `until`.
    pub fn next(&mut self, rules: &Rules, known: impl Fn(LetterId) -> bool, until: u64) -> Next {
        loop {
            // The axiom is generation 0.
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
                Rewrite::Choose(alternatives) => Alternative::of(alternatives, key.choice(self.seed, step)),
            };
            self.open.push(OpenWord { source: WordSource::Successor(symbol, choice), next: 0, key, since });
        }
    }

    /// The key and the age of the letter returned last. `continues` gives the index of the letter in a successor that
    /// continues the predecessor; that letter does not grow.
    pub fn fate(
        &self,
        rules: &Rules,
        symbol: LetterId,
        mut continues: impl FnMut(LetterId, &[LetterId]) -> Option<usize>,
    ) -> ModuleAge {
        let generation = self.open.len().saturating_sub(1) as u32;
        let Some(word) = self.open.last() else {
            return ModuleAge { key: Key::root(0), since: 0, step: 0, grows: false };
        };
        let index = word.next.saturating_sub(1);
        let grows = match word.source {
            WordSource::Successor(former, _) if generation == self.n => {
                continues(former, letters(rules, word.source)) != Some(index)
            }
            _ => false,
        };
        let (key, since) = (word.key(generation, index as u64), word.since(generation, symbol));
        ModuleAge { key, since, step: generation, grows }
    }
}

impl OpenWord {
    /// The key of the word's letter at `index`; `generation` is the generation of the word.
    fn key(&self, generation: u32, index: u64) -> Key {
        match self.source {
            WordSource::Axiom => Key::root(index),
            WordSource::Successor(..) => self.key.child(generation, index),
        }
    }

    /// As [`ModuleAge::since`], for a letter `symbol` of this word; `generation` is the generation of the word.
    fn since(&self, generation: u32, symbol: LetterId) -> u32 {
        match self.source {
            WordSource::Successor(former, _) if former == symbol => self.since,
            _ => generation,
        }
    }
}

fn letters(rules: &Rules, source: WordSource) -> &[LetterId] {
    match source {
        WordSource::Axiom => &rules.axiom.letters,
        WordSource::Successor(symbol, choice) => match &rules.rewrites[usize::from(symbol)] {
            Rewrite::Keep => &[],
            Rewrite::Always(word) => word,
            Rewrite::Choose(alternatives) => alternatives.get(choice).map_or(&[], |c| &c.successor),
        },
    }
}
