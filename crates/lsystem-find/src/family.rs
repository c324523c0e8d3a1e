//! Families of systems: those with the same letters, whose rules are free, fixed, or the mirror image of another one.

use crate::successors::{Alphabet, Symbol, Words};
use lsystem_base::{say, word};

/// The most symbols of the successors.
pub(crate) const MAX_SYMBOLS: usize = 24;
/// The most symbols of the axiom.
const MAX_AXIOM: usize = 200;
/// Other letters that draw, and letters that do not.
const DRAWN: [char; 2] = ['F', 'G'];
const UNDRAWN: [char; 2] = ['X', 'Y'];

/// How the rule of a letter is found.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Rule {
    /// All successors are tried.
    Free,
    /// All successors are tried that have no other letters.
    Own,
    Fixed(Vec<Symbol>),
    /// The successor of the first letter with both letters exchanged, as a mirror shows it; also from its end.
    Mirrored {
        is_reversed: bool,
    },
}

/// Systems with the same letters.
#[derive(Clone, Debug)]
pub(crate) struct Family {
    pub(crate) name: String,
    pub(crate) letters: Vec<(char, bool, Rule)>,
    pub(crate) draws: Vec<bool>,
    pub(crate) axiom: Vec<Symbol>,
    pub(crate) alphabet: Alphabet,
    /// The symbols of all free successors in this round.
    pub(crate) round: usize,
    /// The successors of the free letters.
    words: Vec<Words>,
    pub(crate) tried: u64,
    /// The divisor of the family's share of the work; 1 for the most common families.
    pub(crate) rank: u64,
}

impl Family {
    pub(crate) fn character(&self, symbol: Symbol) -> char {
        match self.letters.get(usize::from(symbol)) {
            Some((letter, ..)) => *letter,
            None => ['+', '-', '[', ']'][usize::from(symbol - self.alphabet.letters)],
        }
    }

    /// Moves to the next system. The first word changes fastest, so that the blocks of the second one are reused.
    pub(crate) fn advance(&mut self) {
        self.tried += 1;
        while self.round <= MAX_SYMBOLS {
            if self.words[0].advance() {
                return;
            }
            if self.words.len() > 1 && self.words[1].advance() {
                self.words[0] = self.words[0].again();
            } else {
                self.share();
            }
        }
    }

    /// Moves one symbol from the second word to the first one, or begins the next round.
    fn share(&mut self) {
        let first = match &self.words[..] {
            [first, second] if second.length() > 1 => first.length() + 1,
            _ => {
                self.round += 1;
                1
            }
        };
        let second = self.letters.iter().position(|(_, _, rule)| *rule == Rule::Own).unwrap_or(0);
        let free = self.letters.iter().filter(|(_, _, rule)| matches!(rule, Rule::Free | Rule::Own)).count();
        self.words = match free {
            1 => vec![Words::new(self.alphabet, self.round)],
            _ => {
                let rest = Words::new(self.alphabet, self.round.saturating_sub(first)).from(second as Symbol);
                vec![Words::new(self.alphabet, first), rest]
            }
        };
        if let [_, rest] = &mut self.words[..] {
            rest.advance();
        }
    }

    /// The successors of all letters if the first one's is this. Other letters without a rule of their own are
    /// constant.
    pub(crate) fn successors(&self, first: &[Symbol]) -> Vec<Vec<Symbol>> {
        let successor = |(at, (_, _, rule)): (usize, &(char, bool, Rule))| match rule {
            Rule::Fixed(word) => word.clone(),
            Rule::Mirrored { is_reversed } => mirrored(self.alphabet, first, *is_reversed),
            _ if at == 0 => first.to_vec(),
            _ => vec![at as Symbol],
        };
        self.letters.iter().enumerate().map(successor).collect()
    }

    /// The same system with half as many lines of twice the length, if the second letter is doubled in each step and stands
    /// in pairs only: `X -> FF[+X]FFX` becomes `X -> F[+X]FX`.
    pub(crate) fn halved(&self, words: &[Vec<Symbol>]) -> Option<Vec<Vec<Symbol>>> {
        let line = 1;
        let is_doubled = matches!(self.letters.get(1), Some((_, _, Rule::Fixed(word))) if *word == [line, line]);
        let first = words.first().filter(|_| is_doubled)?;
        let runs: Vec<&[Symbol]> = first.chunk_by(|a, b| *a == line && *b == line).collect();
        let has_lines = first.contains(&line);
        if !has_lines || runs.iter().any(|run| run[0] == line && run.len() % 2 == 1) {
            return None;
        }
        let half = |run: &&[Symbol]| run[..if run[0] == line { run.len() / 2 } else { run.len() }].to_vec();
        let first = runs.iter().flat_map(half).collect();
        Some(std::iter::once(first).chain(words[1..].iter().cloned()).collect())
    }

    /// Which letters the axiom or a successor of a used letter has.
    pub(crate) fn used(&self, words: &[Vec<Symbol>]) -> Vec<bool> {
        let mut used = vec![false; self.letters.len()];
        let mut open = self.axiom.clone();
        while let Some(symbol) = open.pop() {
            if let Some(used) = used.get_mut(usize::from(symbol)).filter(|used| !**used) {
                *used = true;
                open.extend(words.get(usize::from(symbol)).into_iter().flatten());
            }
        }
        used
    }

    /// Writes the successors of all letters. Whether the system is worth a try: all letters with rules that are
    /// searched are used.
    pub(crate) fn set_successors(&self, all: &mut Vec<Vec<Symbol>>) -> bool {
        let mut free = self.words.iter();
        let Some(first) = self.words.first().map(Words::word) else { return false };
        let abc = self.alphabet;
        all.resize(self.letters.len(), Vec::new());
        for (at, ((_, _, rule), word)) in self.letters.iter().zip(&mut *all).enumerate() {
            let is_used = self.axiom.contains(&(at as Symbol)) || first.contains(&(at as Symbol));
            if !is_used {
                return false;
            }
            word.clear();
            match rule {
                Rule::Free | Rule::Own => word.extend_from_slice(free.next().map_or(&[], Words::word)),
                Rule::Fixed(fixed) => word.extend_from_slice(fixed),
                Rule::Mirrored { is_reversed: true } => word.extend(first.iter().rev().map(|&at| swapped(abc, at))),
                Rule::Mirrored { is_reversed: false } => word.extend(first.iter().map(|&at| swapped(abc, at))),
            }
            // A letter that becomes itself is no rule, and another family has it.
            if word.len() == 1 && matches!(rule, Rule::Free | Rule::Own) {
                return false;
            }
        }
        true
    }
}

/// A word as a mirror shows it, with the first two letters exchanged; also from its end.
pub(crate) fn mirrored(abc: Alphabet, word: &[Symbol], is_reversed: bool) -> Vec<Symbol> {
    let mut word: Vec<Symbol> = word.iter().map(|&symbol| swapped(abc, symbol)).collect();
    if is_reversed {
        word.reverse();
    }
    word
}

/// Exchanges the first two letters, and the two turns.
const fn swapped(abc: Alphabet, symbol: Symbol) -> Symbol {
    match symbol {
        0 => 1,
        1 => 0,
        turn if turn == abc.left() => abc.right(),
        turn if turn == abc.right() => abc.left(),
        other => other,
    }
}

/// A rule and its mirror image, in words.
fn pair_words(letter: char, is_reversed: bool, other: char) -> String {
    if is_reversed {
        say!("a rule for {} and its mirror image from its end for {}", letter, other)
    } else {
        say!("a rule for {} and its mirror image for {}", letter, other)
    }
}

/// The letters of an axiom, in the order in which they first occur.
fn letters_of(axiom: &str) -> Result<Vec<char>, &'static str> {
    let mut letters: Vec<char> = Vec::new();
    for symbol in axiom.chars().filter(|symbol| !symbol.is_whitespace()) {
        match symbol {
            '+' | '-' | '[' | ']' => {}
            _ if symbol.is_ascii_alphabetic() && !letters.contains(&symbol) => letters.push(symbol),
            _ if symbol.is_ascii_alphabetic() => {}
            _ => return Err(word!("an axiom of letters, turns + and -, and branches [ ] is expected")),
        }
    }
    let depths = axiom.chars().scan(0, |depth, at| {
        *depth += i32::from(at == '[') - i32::from(at == ']');
        Some(*depth)
    });
    if depths.clone().any(|depth| depth < 0) || depths.last().is_some_and(|depth| depth != 0) || axiom.len() > MAX_AXIOM
    {
        return Err(word!("an axiom of at most 200 symbols whose branches are closed is expected"));
    }
    Ok(letters)
}

/// The families of systems with an axiom.
pub(crate) fn families(axiom: &str, order: usize) -> Result<Vec<Family>, &'static str> {
    let letters = letters_of(axiom)?;
    let other = |names: [char; 2]| names.into_iter().find(|name| !letters.contains(name)).unwrap_or('Z');
    let (drawn, undrawn) = (other(DRAWN), other(UNDRAWN));
    let mut families = Vec::new();
    let mut add = |rank: u64, name: String, letters: Vec<(char, bool, Rule)>, has_branches: bool| {
        let alphabet = Alphabet { letters: letters.len() as u8, has_branches, order };
        let symbol = |at: char| match letters.iter().position(|(letter, ..)| *letter == at) {
            Some(letter) => letter as Symbol,
            None => alphabet.letters + "+-[]".find(at).unwrap_or(0) as Symbol,
        };
        let axiom = axiom.chars().filter(|at| !at.is_whitespace()).map(symbol).collect();
        families.push(Family {
            name,
            draws: letters.iter().map(|(_, draws, _)| *draws).collect(),
            letters,
            axiom,
            alphabet,
            round: 1,
            words: vec![Words::new(alphabet, 0)],
            tried: 0,
            rank,
        });
    };
    let (constant, doubled) = (|at| Rule::Fixed(vec![at]), |at| Rule::Fixed(vec![at, at]));
    match letters[..] {
        [a] => {
            if DRAWN.contains(&a) || !UNDRAWN.contains(&a) {
                let rank = if DRAWN.contains(&a) { 1 } else { 3 };
                add(rank, say!("one rule for {}", a), vec![(a, true, Rule::Free)], true);
                // Without branches there are so few successors that much longer ones are reached.
                add(2 * rank, say!("one rule for {} without branches", a), vec![(a, true, Rule::Free)], false);
                for is_reversed in [false, true] {
                    let pair = vec![(a, true, Rule::Free), (drawn, true, Rule::Mirrored { is_reversed })];
                    add(4 * rank, pair_words(a, is_reversed, drawn), pair, false);
                }
                let pair = vec![(a, true, Rule::Free), (drawn, true, Rule::Free)];
                add(4 * rank, say!("rules for {} and {}", a, drawn), pair, true);
            }
            if !DRAWN.contains(&a) {
                for draws in [false, true] {
                    // By custom, X and Y do not draw.
                    let rank = if draws && UNDRAWN.contains(&a) { 8 } else { 2 };
                    let rule = if draws { say!("a rule for {}, which draws", a) } else { say!("a rule for {}", a) };
                    let pair = vec![(a, draws, Rule::Free), (drawn, true, doubled(1))];
                    add(rank, say!("{} and {}", format!("{drawn} -> {drawn}{drawn}"), rule), pair, true);
                    let pair = vec![(a, draws, Rule::Free), (drawn, true, constant(1))];
                    add(2 * rank, say!("{}, with {}", rule, drawn), pair, true);
                }
                let pair = vec![(a, false, Rule::Free), (drawn, true, Rule::Own)];
                add(
                    1,
                    say!("rules for {} and {}, {} without drawing, {} without {}", a, drawn, a, drawn, a),
                    pair,
                    true,
                );
                let pair = vec![(a, false, Rule::Free), (drawn, true, Rule::Free)];
                add(4, say!("rules for {} and {}, {} without drawing", a, drawn, a), pair, true);
                for is_reversed in [false, true] {
                    let image = (undrawn, false, Rule::Mirrored { is_reversed });
                    let three = vec![(a, false, Rule::Free), image, (drawn, true, constant(2))];
                    let name = say!("{}, with {}", pair_words(a, is_reversed, undrawn), drawn);
                    add(8, name, three, false);
                }
            }
        }
        [a, b] => {
            let (f, x) = if DRAWN.contains(&b) { (b, a) } else { (a, b) };
            let draws = DRAWN.contains(&x);
            let pair = |rule: Rule| vec![(x, draws, Rule::Free), (f, true, rule)];
            add(4, say!("{}, with {}", say!("a rule for {}", x), f), pair(constant(1)), true);
            add(2, say!("{} and {}", format!("{f} -> {f}{f}"), say!("a rule for {}", x)), pair(doubled(1)), true);
            add(1, say!("rules for {} and {}, {} without {}", f, x, f, x), pair(Rule::Own), true);
            add(4, say!("rules for {} and {}", f, x), pair(Rule::Free), true);
            if !draws {
                for is_reversed in [false, true] {
                    let image = (undrawn, false, Rule::Mirrored { is_reversed });
                    let three = vec![(x, false, Rule::Free), image, (f, true, constant(2))];
                    add(8, say!("{}, with {}", pair_words(x, is_reversed, undrawn), f), three, false);
                }
            }
        }
        _ => return Err(word!("an axiom with one or two letters is expected")),
    }
    Ok(families)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_that_no_word_has_are_not_used() {
        let families = families("F", 6).expect("families");
        let pair = families.iter().find(|family| family.name.contains("mirror image")).expect("a pair");
        let word = |text: &str| -> Vec<Symbol> { text.chars().map(|at| "FG+-".find(at).unwrap() as Symbol).collect() };
        assert_eq!(pair.used(&[word("F+F--F+F"), word("G-G++G-G")]), [true, false]);
        assert_eq!(pair.used(&[word("F+G"), word("G-F")]), [true, true]);
    }

    #[test]
    fn pairs_of_lines_are_halved() {
        let family = &families("X", 14).expect("families")[2];
        let letters = "XF+-[]";
        let word = |text: &str| -> Vec<Symbol> { text.chars().map(|at| letters.find(at).unwrap() as Symbol).collect() };
        for (from, to) in [
            ("FF[+X][-X]FFX", Some("F[+X][-X]FX")),
            ("FFFF[+FFX]X", Some("FF[+FX]X")),
            ("FF[+X]FX", None),
            ("FFF[+X]X", None),
            ("[+X]X", None),
        ] {
            let halved = family.halved(&[word(from), word("FF")]);
            assert_eq!(halved, to.map(|to| vec![word(to), word("FF")]), "{from} in {}", family.name);
        }
        // Where a line stays one line, it would be another drawing.
        let constant = families("X", 14).expect("families");
        let constant = constant.iter().find(|family| family.name == "a rule for X, with F").expect("a family");
        assert_eq!(constant.halved(&[word("FF[+X]X"), word("F")]), None);
    }
}
