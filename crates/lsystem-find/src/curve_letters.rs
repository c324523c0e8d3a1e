//! The letters of a word, given its lines: which letter each line is, and the places of letters that do not draw.

use crate::lattice::{Lattice, Walker};
use crate::successors::{Alphabet, Symbol};

/// A line of a word whose letters are not known yet.
pub(crate) const LINE: Symbol = 0;

/// Assigns letters to the lines of a word, from the edges of the curve after two derivation steps.
pub(crate) struct LetterSearch<'a> {
    lattice: &'a Lattice,
    alphabet: Alphabet,
    /// The lines and turns of the word of each letter with a rule.
    lines: &'a [Vec<Symbol>],
    /// How many letters do not draw; where there are none, each line is a letter with a rule.
    undrawn: usize,
    /// The letter of each line where letters with rules do not draw.
    constant: Option<Symbol>,
    word: Vec<Symbol>,
    inserted: usize,
    /// The edges of the word after two steps.
    taken: Vec<u32>,
    pub(crate) words: Vec<Vec<Symbol>>,
    /// The symbols that were tried.
    pub(crate) symbols: usize,
}

impl<'a> LetterSearch<'a> {
    pub(crate) fn new(
        lattice: &'a Lattice,
        alphabet: Alphabet,
        lines: &'a [Vec<Symbol>],
        undrawn: usize,
        constant: Option<Symbol>,
    ) -> Self {
        let (word, taken, words) = (Vec::new(), Vec::new(), Vec::new());
        Self { lattice, alphabet, lines, undrawn, constant, word, inserted: 0, taken, words, symbols: 0 }
    }

    /// Finds all words with these lines and turns. The first letter with a rule and the start of its word are known.
    pub(crate) fn run(&mut self, lines: &[Symbol], begin: Walker, first: Symbol) {
        self.from(lines, true, Err((begin, first)));
    }

    /// Assigns the letters from here on. `at` is the end of the word after two steps so far, or its start and its first
    /// letter. Two letters that do not draw never stand side by side.
    fn from(&mut self, lines: &[Symbol], may_insert: bool, at: Result<Walker, (Walker, Symbol)>) {
        if self.constant.is_some() && may_insert && self.inserted < self.undrawn {
            self.letters(lines, at);
        }
        let Some((&symbol, rest)) = lines.split_first() else {
            if self.constant.is_none() || self.inserted == self.undrawn {
                self.words.push(self.word.clone());
            }
            return;
        };
        let Some(constant) = self.constant.filter(|_| symbol == LINE) else {
            if symbol == LINE {
                return self.letters(rest, at);
            }
            let turned = at.map(|mut walker| {
                walker.turn(self.alphabet, symbol);
                walker
            });
            self.word.push(symbol);
            self.from(rest, true, turned);
            self.word.pop();
            return;
        };
        // Where a line comes first, the curve does not begin with a word after two steps.
        let Ok(mut walker) = at else { return };
        let before = self.taken.len();
        if self.go(&mut walker) {
            self.word.push(constant);
            self.from(rest, true, Ok(walker));
            self.word.pop();
        }
        self.taken.truncate(before);
    }

    /// Tries each letter with a rule here.
    fn letters(&mut self, rest: &[Symbol], at: Result<Walker, (Walker, Symbol)>) {
        let (begin, letters) = match at {
            Ok(walker) => (walker, 0..self.lines.len() as Symbol),
            Err((walker, first)) => (walker, first..first + 1),
        };
        for letter in letters {
            let (mut walker, before) = (begin, self.taken.len());
            let is_followed = {
                let lines = self.lines;
                lines[usize::from(letter)].iter().all(|&symbol| match symbol {
                    LINE => self.go(&mut walker),
                    turn => {
                        walker.turn(self.alphabet, turn);
                        true
                    }
                })
            };
            if is_followed {
                self.word.push(letter);
                self.inserted += 1;
                self.from(rest, false, Ok(walker));
                self.inserted -= 1;
                self.word.pop();
            }
            self.taken.truncate(before);
        }
    }

    /// Goes along an edge, if it is there and new.
    fn go(&mut self, walker: &mut Walker) -> bool {
        self.symbols += 1;
        let Some(edge) = walker.go(self.lattice).filter(|edge| !self.taken.contains(edge)) else { return false };
        self.taken.push(edge);
        true
    }
}
