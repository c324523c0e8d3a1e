//! Successors of curves, read from the edges that a turtle walks along.
//!
//! A curve that goes along each edge of a lattice once begins with the word of a letter after one step. So the lines
//! and turns of a word are read from the first edges. The letters of these lines, and the places of letters that do not
//! draw, follow from the edges after them: there the curve is the same word after two steps. Then the whole curve is
//! derived along the edges. The number of edges gives the number of letters of a word.

use crate::curve_letters::{LINE, LetterSearch};
use crate::family::{Family, Rule, mirrored};
use crate::lattice::{Lattice, Walker};
use crate::successors::{Advance, Alphabet, Symbol};
use lsystem_base::sorted;
use std::collections::HashSet;
use std::iter::once;
use std::sync::Arc;

/// The most letters of a word that draw, and the most that do not.
const MAX_DRAWN: usize = 40;
const MAX_UNDRAWN: usize = 12;
/// The symbols that a step of the search tries.
const SHARE: usize = 200_000;

/// A search for the words of one family on one lattice, in steps.
#[derive(Clone, Debug)]
pub(crate) struct CurveSearch {
    lattice: Arc<Lattice>,
    alphabet: Alphabet,
    axiom: Vec<Symbol>,
    letters: Vec<Letter>,
    /// The derivation steps and the numbers of letters that are still to be tried.
    shapes: Vec<Shape>,
    /// Where the turtle may begin.
    starts: Vec<u32>,
    /// The start and the first heading of the words that are tried now.
    at: (usize, usize),
    /// The lines and turns of a word.
    lines: Vec<Symbol>,
    /// Where the turtle is before each of them, and after the last one.
    walk: Vec<Place>,
    is_begun: bool,
    known: HashSet<Vec<Symbol>>,
    words: Vec<Vec<Symbol>>,
    /// The edges that are taken, and how many.
    taken: Vec<bool>,
    count: usize,
    /// The symbols of all curves.
    symbols: usize,
}

/// The kind of a letter.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Letter {
    /// Its word is searched, or that word as a mirror shows it, maybe from its end.
    Own,
    Mirrored {
        is_reversed: bool,
    },
    Constant,
}

/// How many letters a word has, and after how many derivation steps it is the whole curve.
#[derive(Clone, Copy, Debug)]
struct Shape {
    n: u32,
    drawn: usize,
    undrawn: usize,
}

/// A turtle on the lattice after some lines.
#[derive(Clone, Copy, Debug)]
struct Place {
    walker: Walker,
    drawn: usize,
    /// The edge of the last line, if it came last.
    edge: Option<u32>,
}

impl CurveSearch {
    /// A search for words of a family without branches, if the family has one free rule and other letters that are its
    /// mirror image or constant, and begins with a letter that has a rule.
    pub(crate) fn new(lattice: &Arc<Lattice>, family: &Family, steps: &[u32]) -> Option<Self> {
        let letter = |at: usize| match &family.letters[at].2 {
            Rule::Free if at == 0 => Some(Letter::Own),
            Rule::Mirrored { is_reversed } => Some(Letter::Mirrored { is_reversed: *is_reversed }),
            Rule::Fixed(word) if *word == [at as Symbol] => Some(Letter::Constant),
            _ => None,
        };
        let letters: Vec<Letter> = (0..family.letters.len()).map(letter).collect::<Option<_>>()?;
        let abc = family.alphabet;
        let has_rule = |at: Symbol| letters[usize::from(at)] != Letter::Constant;
        let of_axiom = || family.axiom.iter().copied().filter(|&at| at < abc.letters);
        let is_alike =
            (0..letters.len()).zip(0..).all(|(at, symbol)| has_rule(symbol) != (family.draws[at] != family.draws[0]));
        if !is_alike || !of_axiom().next().is_some_and(has_rule) || family.axiom.iter().any(|&at| at > abc.right()) {
            return None;
        }
        let with_rules = of_axiom().filter(|&at| has_rule(at)).count();
        let constant = of_axiom().count() - with_rules;
        // All words have as many letters of each kind.
        let edges = |n: u32, drawn: usize, undrawn: usize| match family.draws[0] {
            true => drawn.saturating_pow(n).saturating_mul(with_rules),
            false => {
                let words = (0..n).map(|n| undrawn.saturating_pow(n)).fold(0, usize::saturating_add);
                words.saturating_mul(with_rules * drawn).saturating_add(constant)
            }
        };
        let all = if family.draws[0] { 0..=0 } else { 1..=MAX_UNDRAWN };
        let shape = |n: u32, undrawn: usize| {
            let drawn = (1..=MAX_DRAWN).find(|&drawn| edges(n, drawn, undrawn) == lattice.edges)?;
            (drawn + undrawn > 1).then_some(Shape { n, drawn, undrawn })
        };
        let mut shapes: Vec<Shape> =
            steps.iter().flat_map(|&n| all.clone().filter_map(move |undrawn| shape(n, undrawn))).collect();
        // The last ones are tried first.
        sorted::sort_by_key(&mut shapes, |shape| std::cmp::Reverse(shape.drawn + shape.undrawn));
        Some(Self {
            lattice: lattice.clone(),
            alphabet: abc,
            axiom: family.axiom.clone(),
            letters,
            shapes,
            starts: lattice.starts(),
            at: (0, 0),
            lines: Vec::new(),
            walk: Vec::new(),
            is_begun: false,
            known: HashSet::new(),
            words: Vec::new(),
            taken: vec![false; lattice.edges],
            count: 0,
            symbols: 0,
        })
    }

    /// Does a few milliseconds of work.
    pub(crate) fn advance(&mut self) -> Advance {
        self.symbols = 0;
        while self.symbols < SHARE {
            if let Some(word) = self.words.pop() {
                return Advance::Word(word);
            }
            self.symbols += 1;
            let Some(&shape) = self.shapes.last() else { return Advance::Done };
            let Some(&node) = self.starts.get(self.at.0) else {
                self.shapes.pop();
                self.at = (0, 0);
                continue;
            };
            if self.at.1 == self.alphabet.order {
                self.at = (self.at.0 + 1, 0);
                continue;
            }
            if !self.is_begun {
                let walker = Walker { node, heading: self.at.1 };
                self.walk = vec![Place { walker, drawn: 0, edge: None }];
                self.is_begun = true;
            } else if !self.next(shape) {
                self.is_begun = false;
                self.at.1 += 1;
                continue;
            }
            if self.walk.last().is_some_and(|place| place.drawn == shape.drawn) {
                self.find_words(shape, node);
            }
        }
        Advance::More
    }

    /// Goes to the next lines and turns; each comes before the longer ones that begin with it.
    fn next(&mut self, shape: Shape) -> bool {
        let symbols = [LINE, self.alphabet.left(), self.alphabet.right()];
        let mut from = 0;
        loop {
            let next = (from..symbols.len()).find_map(|at| Some((symbols[at], self.after(symbols[at], shape)?)));
            if let Some((symbol, walker)) = next {
                self.lines.push(symbol);
                self.walk.push(walker);
                return true;
            }
            let Some(last) = self.lines.pop() else { return false };
            self.walk.pop();
            from = symbols.iter().position(|&symbol| symbol == last).unwrap_or(0) + 1;
        }
    }

    /// The turtle after one more line or turn, if it may come.
    fn after(&self, symbol: Symbol, shape: Shape) -> Option<Place> {
        let abc = self.alphabet;
        let mut place = *self.walk.last()?;
        if symbol == LINE {
            let edge = place.walker.go(&self.lattice)?;
            let is_new = place.drawn < shape.drawn && self.walk.iter().all(|place| place.edge != Some(edge));
            return is_new.then_some(Place { drawn: place.drawn + 1, edge: Some(edge), ..place });
        }
        let run = self.lines.iter().rev().take_while(|&&at| at == symbol).count() + 1;
        let other = if symbol == abc.left() { abc.right() } else { abc.left() };
        let is_short = run * 2 < abc.order || (run * 2 == abc.order && symbol == abc.left());
        place.walker.turn(abc, symbol);
        (is_short && self.lines.last() != Some(&other)).then_some(Place { edge: None, ..place })
    }

    /// Finds the words with the present lines that derive the whole curve.
    fn find_words(&mut self, shape: Shape, start: u32) {
        let mirror = self.letters.iter().find_map(|letter| match *letter {
            Letter::Mirrored { is_reversed } => Some(is_reversed),
            _ => None,
        });
        let lines_mirrored = mirror.map(|is_reversed| {
            let lines = mirrored(self.alphabet, &self.lines, is_reversed);
            lines.into_iter().map(|symbol| if symbol < self.alphabet.letters { LINE } else { symbol }).collect()
        });
        let begin = Walker { node: start, heading: self.at.1 };
        let count = 1 + usize::from(mirror.is_some());
        let constant = self.letters.iter().position(|&letter| letter == Letter::Constant).map(|at| at as Symbol);
        // The curve begins with the word of a letter after one step, and of one after two steps.
        for first in 0..count {
            let mut lines: Vec<Vec<Symbol>> = once(self.lines.clone()).chain(lines_mirrored.clone()).collect();
            lines.rotate_left(first);
            for second in 0..if shape.n == 1 { 1 } else { count } {
                let words = match shape.n {
                    1 => vec![lines[second].clone()],
                    _ => {
                        let mut search =
                            LetterSearch::new(&self.lattice, self.alphabet, &lines, shape.undrawn, constant);
                        search.run(&lines[second], begin, first as Symbol);
                        self.symbols += search.symbols;
                        search.words
                    }
                };
                for word in words {
                    let word = match mirror {
                        Some(is_reversed) if second == 1 => mirrored(self.alphabet, &word, is_reversed),
                        _ => word,
                    };
                    if !self.known.contains(&word) && self.is_whole(&word, shape.n, start) {
                        self.known.insert(word.clone());
                        self.words.push(word);
                    }
                }
            }
        }
    }

    /// Whether a curve with this word goes along each edge once.
    fn is_whole(&mut self, word: &[Symbol], n: u32, start: u32) -> bool {
        let words: Vec<Vec<Symbol>> = (self.letters.iter().zip(0..))
            .map(|(letter, at)| match *letter {
                Letter::Own => word.to_vec(),
                Letter::Mirrored { is_reversed } => mirrored(self.alphabet, word, is_reversed),
                Letter::Constant => vec![at],
            })
            .collect();
        let axiom = self.axiom.clone();
        // The axiom's heading may be any one that has the same lattice.
        (0..self.alphabet.order).any(|heading| {
            self.taken.fill(false);
            self.count = 0;
            let mut walker = Walker { node: start, heading };
            self.follow(&axiom, &words, n, &mut walker).is_some() && self.count == self.lattice.edges
        })
    }

    /// Goes along the edges of a word whose letters are `n` steps deep, if they are there and new.
    fn follow(&mut self, word: &[Symbol], words: &[Vec<Symbol>], n: u32, walker: &mut Walker) -> Option<()> {
        let draws_itself = !self.letters.contains(&Letter::Constant);
        for &symbol in word {
            self.symbols += 1;
            if symbol >= self.alphabet.letters {
                walker.turn(self.alphabet, symbol);
            } else if n > 0 && self.letters[usize::from(symbol)] != Letter::Constant {
                self.follow(&words[usize::from(symbol)], words, n - 1, walker)?;
            } else if draws_itself || self.letters[usize::from(symbol)] == Letter::Constant {
                let edge = walker.go(&self.lattice)?;
                if std::mem::replace(&mut self.taken[edge as usize], true) {
                    return None;
                }
                self.count += 1;
            }
        }
        Some(())
    }
}
