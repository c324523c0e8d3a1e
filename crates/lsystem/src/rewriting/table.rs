//! Productions without parameters, conditions or weights, and with one letter of context at most to each side,
//! decided by a look into a table.

use super::context::Role;
use super::rules::{ContextPattern, LetterId, Rules};

/// By letter, left neighbour and right neighbour: the successor.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// How many bits tell neighbours apart.
    bits: u32,
    /// The successor's place.
    chosen: Vec<u16>,
    successors: Vec<Successor>,
    /// By letter: what it does to neighbours in the pass to the left, and to the right.
    leftward: Vec<Turn>,
    rightward: Vec<Turn>,
}

/// A table of more letters would not stay in the nearest cache.
const MAX_LETTERS: usize = 32;

/// The most letters of a successor: all are copied as if they were as many, which is quicker than to count.
const LONGEST: usize = 8;

/// Modules whose successors are put together before they are appended: they stay in the nearest cache.
const BATCH: usize = 512;

#[derive(Clone, Copy, Debug)]
struct Successor {
    letters: [LetterId; LONGEST],
    length: u8,
}

/// What a letter does to the nearest neighbour that those behind it see.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Turn {
    /// It is kept or replaced: `nearest & keep | put`, which needs no decision.
    Pass { keep: u8, put: u8 },
    /// A branch begins: the nearest waits for its end, and is seen inside where it is the way to the root.
    Begin { keep: u8 },
    /// A branch ends: the nearest is again what it was before.
    End,
}

/// The neighbours of a word's modules as letters, each one more than the letter, or 0 for none.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    /// By module, in a pass to the left: what is to the right of it.
    right: Vec<u8>,
    /// What waits for the ends of open branches.
    open: Vec<u8>,
    nearest: u8,
    /// Room for successors.
    made: Vec<LetterId>,
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
}

/// Goes by a letter.
#[inline]
fn pass(nearest: &mut u8, open: &mut Vec<u8>, turn: Turn) {
    match turn {
        Turn::Pass { keep, put } => *nearest = *nearest & keep | put,
        Turn::Begin { keep } => {
            open.push(*nearest);
            *nearest &= keep;
        }
        Turn::End => *nearest = open.pop().unwrap_or(0),
    }
}

impl Table {
    /// The table, where the rules allow one.
    pub(super) fn new(rules: &Rules, roles: &[Role]) -> Option<Self> {
        let letters = rules.letters.len();
        let short = |rule: &super::rules::Rule| rule.is_plain() && rule.successor.letters.len() <= LONGEST;
        if letters > MAX_LETTERS || !rules.by_letter.iter().flatten().all(short) {
            return None;
        }
        // One more than the letters: 0 stands for no neighbour.
        let bits = usize::BITS - letters.leading_zeros();
        // Letters stay where nothing else is said.
        let stay = |letter: usize| Successor { letters: [letter as LetterId; LONGEST], length: 1 };
        let turns = |begin: Role, keep: u8| -> Vec<Turn> {
            let turn = |(letter, &role): (usize, &Role)| match role {
                Role::Seen => Turn::Pass { keep: 0, put: letter as u8 + 1 },
                Role::Ignored => Turn::Pass { keep: u8::MAX, put: 0 },
                Role::Open | Role::Close if role == begin => Turn::Begin { keep },
                Role::Open | Role::Close => Turn::End,
            };
            roles.iter().enumerate().map(turn).collect()
        };
        let mut table = Self {
            bits,
            chosen: (0..letters << (2 * bits)).map(|slot| (slot >> (2 * bits)) as u16).collect(),
            successors: (0..letters).map(stay).collect(),
            leftward: turns(Role::Close, 0),
            rightward: turns(Role::Open, u8::MAX),
        };
        for (letter, by_letter) in rules.by_letter.iter().enumerate() {
            // The first that applies decides.
            for rule in by_letter.iter().rev() {
                let number = u16::try_from(table.successors.len()).ok()?;
                let mut letters = [0; LONGEST];
                letters[..rule.successor.letters.len()].copy_from_slice(&rule.successor.letters);
                table.successors.push(Successor { letters, length: rule.successor.letters.len() as u8 });
                let left = rule.left.first().map(|&letter| usize::from(letter) + 1);
                let right = rule.right.first().and_then(|pattern| match pattern {
                    ContextPattern::Letter(letter) => Some(usize::from(*letter) + 1),
                    ContextPattern::Open | ContextPattern::Close => None,
                });
                for l in left.map_or(0..1 << bits, |l| l..l + 1) {
                    for r in right.map_or(0..1 << bits, |r| r..r + 1) {
                        table.chosen[(letter << bits | l) << bits | r] = number;
                    }
                }
            }
        }
        Some(table)
    }

    /// Goes from the end of `letters`, the first of which is at `start`, to their start, in the pass that finds what is
    /// to the right.
    pub(super) fn leftward(&self, letters: &[LetterId], start: usize, sides: &mut Sides) {
        let Sides { right, open, nearest, .. } = sides;
        let right = &mut right[start..start + letters.len()];
        let mut near = *nearest;
        for (&letter, right) in letters.iter().zip(right).rev() {
            *right = near;
            pass(&mut near, open, self.leftward[usize::from(letter)]);
        }
        *nearest = near;
    }

    /// Goes through `letters`, the first of which is at `start`, and appends what they become to `next`. Without
    /// `contexts` no production has one.
    pub(super) fn rightward(
        &self,
        letters: &[LetterId],
        start: usize,
        contexts: bool,
        sides: &mut Sides,
        next: &mut Vec<LetterId>,
    ) {
        if !contexts {
            for &letter in letters {
                let successor = &self.successors[usize::from(self.chosen[usize::from(letter) << (2 * self.bits)])];
                next.extend_from_slice(&successor.letters[..usize::from(successor.length)]);
            }
            return;
        }
        let Sides { right, open, nearest, made } = sides;
        made.resize((BATCH + 1) * LONGEST, 0);
        let bits = self.bits;
        let mut near = *nearest;
        for (batch, right) in letters.chunks(BATCH).zip(right[start..].chunks(BATCH)) {
            let mut at = 0;
            for (&letter, &right) in batch.iter().zip(right) {
                let slot = (usize::from(letter) << bits | usize::from(near)) << bits | usize::from(right);
                let successor = &self.successors[usize::from(self.chosen[slot])];
                made[at..at + LONGEST].copy_from_slice(&successor.letters);
                at += usize::from(successor.length);
                pass(&mut near, open, self.rightward[usize::from(letter)]);
            }
            next.extend_from_slice(&made[..at]);
        }
        *nearest = near;
    }
}
