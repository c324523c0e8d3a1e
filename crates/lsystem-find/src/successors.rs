//! Successors in order of their symbols, without those that draw the same as another one.

/// A symbol of a successor: a letter, or one of the four below, counted from the number of letters.
pub(crate) type Symbol = u8;

/// The result of a step of a search that reads successors off a picture.
pub(crate) enum Advance {
    More,
    Done,
    /// A successor of the letter whose rule is free.
    Word(Vec<Symbol>),
}

/// The alphabet of successors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Alphabet {
    /// The letters are the symbols below this number.
    pub(crate) letters: u8,
    pub(crate) has_branches: bool,
    /// How many turns make a full one.
    pub(crate) order: usize,
}

impl Alphabet {
    pub(crate) const fn left(self) -> Symbol {
        self.letters
    }

    pub(crate) const fn right(self) -> Symbol {
        self.letters + 1
    }

    pub(crate) const fn open(self) -> Symbol {
        self.letters + 2
    }

    pub(crate) const fn close(self) -> Symbol {
        self.letters + 3
    }

    const fn size(self) -> u8 {
        self.letters + if self.has_branches { 4 } else { 2 }
    }
}

/// All successors with the same number of symbols, one after the other.
///
/// Left out are turns that cancel or that are longer than half a turn, branches without a letter, branches within
/// branches where they begin or end, and branches side by side in the other order.
#[derive(Clone, Debug)]
pub(crate) struct Words {
    alphabet: Alphabet,
    length: usize,
    /// The words have only letters from this one on.
    lowest: Symbol,
    word: Vec<Symbol>,
    is_started: bool,
}

impl Words {
    pub(crate) const fn new(alphabet: Alphabet, length: usize) -> Self {
        Self { alphabet, length, lowest: 0, word: Vec::new(), is_started: false }
    }

    /// The words without the letters before this one.
    pub(crate) fn from(self, lowest: Symbol) -> Self {
        Self { lowest, ..self }
    }

    /// The same words from the first one on.
    pub(crate) const fn again(&self) -> Self {
        Self { alphabet: self.alphabet, length: self.length, lowest: self.lowest, word: Vec::new(), is_started: false }
    }

    pub(crate) const fn length(&self) -> usize {
        self.length
    }

    /// The word of the last call of [`Words::advance`] that found one.
    pub(crate) fn word(&self) -> &[Symbol] {
        &self.word
    }

    /// Moves to the next word, if there is one.
    pub(crate) fn advance(&mut self) -> bool {
        if self.length == 0 {
            return false;
        }
        let mut from = match self.is_started {
            false => 0,
            true => match self.word.pop() {
                Some(last) => last + 1,
                None => return false,
            },
        };
        self.is_started = true;
        loop {
            match (from..self.alphabet.size()).find(|&next| self.allows(next)) {
                Some(next) => {
                    self.word.push(next);
                    if self.word.len() == self.length {
                        return true;
                    }
                    from = 0;
                }
                None => match self.word.pop() {
                    Some(last) => from = last + 1,
                    None => return false,
                },
            }
        }
    }

    /// Whether the next symbol may be this one.
    fn allows(&self, next: Symbol) -> bool {
        let (abc, word) = (self.alphabet, &self.word);
        let last = word.last().copied();
        let depth =
            word.iter().map(|&at| i32::from(at == abc.open()) - i32::from(at == abc.close())).sum::<i32>() as usize;
        // How many symbols a branch needs after this one, and whether it still needs a letter.
        let left = self.length - word.len() - 1;
        let run = || word.iter().rev().take_while(|&&at| at == next).count() + 1;
        if next < abc.letters {
            left >= depth && next >= self.lowest
        } else if next == abc.left() {
            last != Some(abc.right()) && run() * 2 <= abc.order && left >= depth + usize::from(depth > 0)
        } else if next == abc.right() {
            last != Some(abc.left()) && run() * 2 < abc.order && left >= depth + usize::from(depth > 0)
        } else if next == abc.open() {
            last != Some(abc.open()) && left >= depth + 2
        } else {
            depth > 0 && last.is_some_and(|last| last < abc.letters) && left + 1 >= depth && self.is_in_order()
        }
    }

    /// Whether the branch that ends here comes after the branch just before it, if there is one.
    fn is_in_order(&self) -> bool {
        let (abc, word) = (self.alphabet, &self.word);
        let begin_before = |end: usize| {
            let mut depth = 1;
            (0..end).rev().find(|&at| {
                depth += usize::from(word[at] == abc.close());
                depth -= usize::from(word[at] == abc.open());
                depth == 0
            })
        };
        let Some(begin) = begin_before(word.len()) else { return true };
        if begin == 0 || word[begin - 1] != abc.close() {
            return true;
        }
        begin_before(begin - 1).is_none_or(|before| word[before + 1..begin - 1] < word[begin + 1..])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(alphabet: Alphabet, length: usize) -> Vec<String> {
        let mut words = Words::new(alphabet, length);
        let mut all = Vec::new();
        while words.advance() {
            let letters = "FG+-[]".chars().filter(|&at| alphabet.letters == 2 || at != 'G').collect::<Vec<_>>();
            all.push(words.word().iter().map(|&at| letters[usize::from(at)]).collect());
        }
        all
    }

    #[test]
    fn short_words_are_listed() {
        let alphabet = Alphabet { letters: 1, has_branches: true, order: 4 };
        assert_eq!(all(alphabet, 1), ["F", "+", "-"]);
        assert_eq!(all(alphabet, 2), ["FF", "F+", "F-", "+F", "++", "-F"]);
        assert!(all(alphabet, 3).contains(&"[F]".to_owned()));
        assert!(all(Alphabet { letters: 2, ..alphabet }, 3).contains(&"F+G".to_owned()));
    }

    #[test]
    fn words_that_draw_the_same_are_left_out() {
        let alphabet = Alphabet { letters: 1, has_branches: true, order: 6 };
        let words = all(alphabet, 8);
        for kept in ["F[+F]F++", "[+F][-F]", "F[-F]F+F"] {
            assert!(words.iter().any(|word| word == kept), "{kept}");
        }
        for left_out in ["[-F][+F]", "[F][F]FF", "[[F]F]FF", "F[F[F]]F", "F+-FFFFF", "F---FFFF", "F[F+]FFF"] {
            assert!(!words.iter().any(|word| word == left_out), "{left_out}");
        }
    }
}
