//! Productions without parameters, conditions or weights, and with one letter of context at most to each side,
//! decided by a look into a table.

use super::rules::{ContextPattern, LetterId, Rules};

/// By letter, left neighbour and right neighbour: the successor.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// One more than the letters: 0 stands for no neighbour.
    sides: usize,
    /// One more than the successor's place, or 0 where the letter stays.
    chosen: Vec<u16>,
    successors: Vec<Vec<LetterId>>,
}

/// A table of more letters would not stay in the nearest cache.
const MAX_LETTERS: usize = 32;

impl Table {
    /// The table, where the rules allow one.
    pub(super) fn new(rules: &Rules) -> Option<Self> {
        let letters = rules.letters.len();
        let plain = rules.by_letter.iter().flatten().all(super::Rule::is_plain);
        if letters > MAX_LETTERS || !plain {
            return None;
        }
        let sides = letters + 1;
        let mut table = Self { sides, chosen: vec![0; letters * sides * sides], successors: Vec::new() };
        for (letter, by_letter) in rules.by_letter.iter().enumerate() {
            for rule in by_letter {
                table.successors.push(rule.successor.iter().map(|template| template.letter).collect());
                let number = u16::try_from(table.successors.len()).ok()?;
                let left = rule.left.first().map(|&letter| usize::from(letter) + 1);
                let right = rule.right.first().and_then(|pattern| match pattern {
                    ContextPattern::Letter(letter) => Some(usize::from(*letter) + 1),
                    ContextPattern::Open | ContextPattern::Close => None,
                });
                for l in left.map_or(0..sides, |l| l..l + 1) {
                    for r in right.map_or(0..sides, |r| r..r + 1) {
                        // The first that applies decides.
                        let slot = &mut table.chosen[(letter * sides + l) * sides + r];
                        if *slot == 0 {
                            *slot = number;
                        }
                    }
                }
            }
        }
        Some(table)
    }

    /// What replaces a letter between two neighbours, each one more than its letter, or 0 for none.
    #[inline]
    pub(super) fn successor(&self, letter: LetterId, left: usize, right: usize) -> Option<&[LetterId]> {
        let number = self.chosen[(usize::from(letter) * self.sides + left) * self.sides + right];
        (number > 0).then(|| self.successors[usize::from(number) - 1].as_slice())
    }
}
