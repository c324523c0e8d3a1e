//! Productions without parameters, conditions or weights, and with one letter of context at most to each side,
//! decided by a look into a table.

use super::context::Role;
use super::rules::{ContextPattern, LetterId, Rules};

/// By letter, left neighbour and right neighbour: the successor.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// One more than the letters: 0 stands for no neighbour.
    sides: usize,
    /// The successor's place.
    chosen: Vec<u16>,
    successors: Vec<Successor>,
    /// By letter.
    roles: Vec<Role>,
}

/// A table of more letters would not stay in the nearest cache.
const MAX_LETTERS: usize = 32;

/// The most letters of a successor: all are copied as if they were as many, which is quicker than to count.
const LONGEST: usize = 8;

#[derive(Clone, Copy, Debug)]
struct Successor {
    letters: [LetterId; LONGEST],
    length: u8,
}

/// The neighbours of a word's modules as letters, each one more than the letter, or 0 for none.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    /// By module, in a pass to the left: what is to the right of it.
    right: Vec<u8>,
    /// What waits for the ends of open branches.
    open: Vec<u8>,
    nearest: u8,
}

impl Sides {
    /// Makes room for a word of `length` modules.
    pub(super) fn reset(&mut self, length: usize) {
        self.right.resize(length, 0);
        self.turn();
    }

    /// Starts a pass.
    pub(super) fn turn(&mut self) {
        self.open.clear();
        self.nearest = 0;
    }

    /// Goes by a bracket; what it is passed from, a branch begins at `start` and ends at the other.
    #[inline]
    fn bracket(&mut self, role: Role, start: Role) {
        if role == start {
            self.open.push(self.nearest);
            if role == Role::Close {
                self.nearest = 0;
            }
        } else {
            self.nearest = self.open.pop().unwrap_or(0);
        }
    }

    /// Goes by a module.
    #[inline]
    fn pass(&mut self, letter: LetterId, role: Role, start: Role) {
        match role {
            Role::Open | Role::Close => self.bracket(role, start),
            Role::Seen => self.nearest = letter as u8 + 1,
            Role::Ignored => {}
        }
    }
}

impl Table {
    /// The table, where the rules allow one.
    pub(super) fn new(rules: &Rules, roles: &[Role]) -> Option<Self> {
        let letters = rules.letters.len();
        let plain = (rules.by_letter.iter().flatten()).all(|rule| rule.is_plain() && rule.successor.len() <= LONGEST);
        if letters > MAX_LETTERS || !plain {
            return None;
        }
        let sides = letters + 1;
        // Letters stay where nothing else is said.
        let stay = |letter: usize| Successor { letters: [letter as LetterId; LONGEST], length: 1 };
        let mut table = Self {
            sides,
            chosen: (0..letters * sides * sides).map(|slot| (slot / (sides * sides)) as u16).collect(),
            successors: (0..letters).map(stay).collect(),
            roles: roles.to_vec(),
        };
        for (letter, by_letter) in rules.by_letter.iter().enumerate() {
            // The first that applies decides.
            for rule in by_letter.iter().rev() {
                let number = u16::try_from(table.successors.len()).ok()?;
                let mut letters = [0; LONGEST];
                for (into, template) in letters.iter_mut().zip(&rule.successor) {
                    *into = template.letter;
                }
                table.successors.push(Successor { letters, length: rule.successor.len() as u8 });
                let left = rule.left.first().map(|&letter| usize::from(letter) + 1);
                let right = rule.right.first().and_then(|pattern| match pattern {
                    ContextPattern::Letter(letter) => Some(usize::from(*letter) + 1),
                    ContextPattern::Open | ContextPattern::Close => None,
                });
                for l in left.map_or(0..sides, |l| l..l + 1) {
                    for r in right.map_or(0..sides, |r| r..r + 1) {
                        table.chosen[(letter * sides + l) * sides + r] = number;
                    }
                }
            }
        }
        Some(table)
    }

    /// Goes from `end` to `start`, in the pass that finds what is to the right.
    pub(super) fn leftward(&self, word: &[LetterId], start: usize, end: usize, sides: &mut Sides) {
        for place in (start..end).rev() {
            let letter = word[place];
            sides.right[place] = sides.nearest;
            sides.pass(letter, self.roles[usize::from(letter)], Role::Close);
        }
    }

    /// Goes from `start` to `end` and appends what the modules become to `next`.
    pub(super) fn rightward(
        &self,
        word: &[LetterId],
        start: usize,
        end: usize,
        contexts: bool,
        sides: &mut Sides,
        next: &mut Vec<LetterId>,
    ) {
        let mut at = next.len();
        next.resize(at + (end - start) * LONGEST, 0);
        for (place, &letter) in (start..end).zip(&word[start..end]) {
            let mut slot = usize::from(letter) * self.sides * self.sides;
            if contexts {
                slot += usize::from(sides.nearest) * self.sides + usize::from(sides.right[place]);
                sides.pass(letter, self.roles[usize::from(letter)], Role::Open);
            }
            let successor = &self.successors[usize::from(self.chosen[slot])];
            next[at..at + LONGEST].copy_from_slice(&successor.letters);
            at += usize::from(successor.length);
        }
        next.truncate(at);
    }
}
