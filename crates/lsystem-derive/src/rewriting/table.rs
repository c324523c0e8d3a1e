//! Productions without parameters, conditions or weights, and with one letter of context at most to each side,
//! decided by a look into a table.

use super::choices::{Choice, Choices};
use super::context::Role;
use super::room::{held, renew, room_for};
use crate::rules::{ContextPattern, LetterId, Rules};

/// By letter, left neighbour and right neighbour: the successor.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// How many bits tell neighbours apart.
    bits: u32,
    /// The successor's place, and how many letters it has.
    chosen: Vec<(u16, u16)>,
    successors: Vec<[LetterId; LONGEST]>,
    /// By successor's place: which production it is of.
    productions: Vec<Choice>,
    /// By letter: what it does to neighbours in the pass to the left, and to the right.
    leftward: Turns,
    rightward: Turns,
}

/// A table of more letters would not stay in the nearest cache.
const MAX_LETTERS: usize = 32;

/// The most letters of a successor: all are copied as if they were as many, which is quicker than to count.
pub(super) const LONGEST: usize = 8;

/// Modules whose successors are put together before they are appended: they stay in the nearest cache.
const BATCH: usize = 512;

/// What letters do to the nearest neighbour that those behind them see: `nearest & keep | put`, which needs no decision,
/// unless a bracket says otherwise.
#[derive(Clone, Debug)]
struct Turns {
    keep: [u8; MAX_LETTERS],
    /// By letter: what the nearest is from now on; [`BEGIN`] or [`END`] for a bracket.
    put: [u8; MAX_LETTERS],
    /// What is kept of the nearest inside of a branch, which sees it where it is the way to the root.
    inside: u8,
}

/// A branch begins: the nearest waits for its end.
const BEGIN: u8 = 0x80;
/// A branch ends: the nearest is again what it was before.
const END: u8 = 0x81;

/// The neighbours of a word's modules as letters, each one more than the letter, or 0 for none.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    /// By module, in a pass to the left: what is to the right of it.
    right: Vec<u8>,
    nearest: u8,
    /// What waits for the ends of open branches.
    open: Vec<u8>,
    /// The same two for whoever notes what is chosen, which goes ahead.
    noted: (u8, Vec<u8>),
    /// Room for successors.
    made: Vec<LetterId>,
}

impl Sides {
    /// The bytes that it takes for a word of `length` modules with so many brackets of a kind.
    pub(super) fn bytes_for(&self, length: usize, brackets: usize) -> u64 {
        (self.right.capacity().max(room_for(length)) + 2 * self.open.capacity().max(room_for(brackets))) as u64
    }

    /// The bytes that it holds.
    pub(super) fn bytes(&self) -> u64 {
        held(&self.right) + held(&self.open) + held(&self.noted.1) + held(&self.made)
    }

    /// Takes the memory for a word of `length` modules with so many brackets of a kind.
    pub(super) fn reset(&mut self, length: usize, brackets: usize) {
        renew(&mut self.right, length);
        renew(&mut self.open, brackets);
        renew(&mut self.noted.1, brackets);
        self.turn();
    }

    /// Makes the next `count` places, which the passes fill.
    pub(super) fn extend(&mut self, count: usize) {
        self.right.resize(self.right.len() + count, 0);
    }

    /// Starts a pass.
    pub(super) fn turn(&mut self) {
        self.nearest = 0;
        self.open.clear();
        self.noted.0 = 0;
        self.noted.1.clear();
    }
}

impl Turns {
    /// Of the pass where `begin` begins a branch.
    fn new(roles: &[Role], begin: Role, inside: u8) -> Self {
        let mut turns = Self { keep: [0; MAX_LETTERS], put: [0; MAX_LETTERS], inside };
        for (letter, &role) in roles.iter().enumerate() {
            (turns.keep[letter], turns.put[letter]) = match role {
                Role::Seen => (0, letter as u8 + 1),
                Role::Ignored => (u8::MAX, 0),
                _ if role == begin => (0, BEGIN),
                Role::Open | Role::Close => (0, END),
            };
        }
        turns
    }

    /// What is nearest behind a letter.
    #[inline(always)]
    fn pass(&self, nearest: u8, letter: LetterId, open: &mut Vec<u8>) -> u8 {
        let letter = usize::from(letter) % MAX_LETTERS;
        match self.put[letter] {
            BEGIN => {
                open.push(nearest);
                nearest & self.inside
            }
            END => open.pop().unwrap_or(0),
            put => nearest & self.keep[letter] | put,
        }
    }
}

impl Table {
    /// The table, where the rules allow one.
    pub(super) fn new(rules: &Rules, roles: &[Role]) -> Option<Self> {
        let letters = rules.letters.len();
        let short = |rule: &crate::rules::Rule| rule.is_plain() && rule.successor.letters.len() <= LONGEST;
        if letters > MAX_LETTERS || !rules.by_letter.iter().flatten().all(short) {
            return None;
        }
        // One more than the letters: 0 stands for no neighbour.
        let bits = usize::BITS - letters.leading_zeros();
        // Letters stay where nothing else is said.
        let stay = |letter: usize| [letter as LetterId; LONGEST];
        let mut table = Self {
            bits,
            chosen: (0..letters << (2 * bits)).map(|slot| ((slot >> (2 * bits)) as u16, 1)).collect(),
            successors: (0..letters).map(stay).collect(),
            productions: vec![Choice::Stayed; letters],
            leftward: Turns::new(roles, Role::Close, 0),
            rightward: Turns::new(roles, Role::Open, u8::MAX),
        };
        for (letter, by_letter) in rules.by_letter.iter().enumerate() {
            // The first that applies decides.
            for rule in by_letter.iter().rev() {
                let number = u16::try_from(table.successors.len()).ok()?;
                let mut letters = [0; LONGEST];
                letters[..rule.successor.letters.len()].copy_from_slice(&rule.successor.letters);
                table.successors.push(letters);
                table.productions.push(Choice::Made(rule.production));
                let left = rule.left.first().map(|&letter| usize::from(letter) + 1);
                let right = rule.right.first().and_then(|pattern| match pattern {
                    ContextPattern::Letter(letter) => Some(usize::from(*letter) + 1),
                    ContextPattern::Open | ContextPattern::Close => None,
                });
                for l in left.map_or(0..1 << bits, |l| l..l + 1) {
                    for r in right.map_or(0..1 << bits, |r| r..r + 1) {
                        table.chosen[(letter << bits | l) << bits | r] = (number, rule.successor.letters.len() as u16);
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
        let mut near = *nearest;
        for (&letter, right) in letters.iter().zip(&mut right[start..start + letters.len()]).rev() {
            *right = near;
            near = self.leftward.pass(near, letter, open);
        }
        *nearest = near;
    }

    /// Notes what will become of `letters`, the first of which is at `start`, before [`Table::rightward`] goes through them.
    pub(super) fn note(
        &self,
        letters: &[LetterId],
        start: usize,
        contexts: bool,
        sides: &mut Sides,
        choices: &mut Choices,
    ) {
        let Sides { right, noted: (near, open), .. } = sides;
        for (place, &letter) in (start..).zip(letters) {
            let around = if contexts { usize::from(*near) << self.bits | usize::from(right[place]) } else { 0 };
            let (successor, _) = self.chosen[usize::from(letter) << (2 * self.bits) | around];
            choices.push(self.productions[usize::from(successor)]);
            *near = self.rightward.pass(*near, letter, open);
        }
    }

    /// How many letters come of `letter`, which is the next in the pass to the right.
    pub(super) fn length_at(&self, letter: LetterId, place: usize, contexts: bool, sides: &Sides) -> usize {
        let around =
            if contexts { usize::from(sides.nearest) << self.bits | usize::from(sides.right[place]) } else { 0 };
        usize::from(self.chosen[usize::from(letter) << (2 * self.bits) | around].1)
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
                let (successor, length) = self.chosen[usize::from(letter) << (2 * self.bits)];
                next.extend_from_slice(&self.successors[usize::from(successor)][..usize::from(length)]);
            }
            return;
        }
        let Sides { right, open, nearest, made, .. } = sides;
        made.resize((BATCH + 1) * LONGEST, 0);
        let made = made.as_mut_slice();
        let (bits, chosen, successors) = (self.bits, self.chosen.as_slice(), self.successors.as_slice());
        let mut near = *nearest;
        for (letters, right) in letters.chunks(BATCH).zip(right[start..].chunks(BATCH)) {
            let mut at = 0;
            for (&letter, &right) in letters.iter().zip(right) {
                let slot = (usize::from(letter) << bits | usize::from(near)) << bits | usize::from(right);
                let (successor, length) = chosen[slot];
                made[at..at + LONGEST].copy_from_slice(&successors[usize::from(successor)]);
                at += usize::from(length);
                near = self.rightward.pass(near, letter, open);
            }
            next.extend_from_slice(&made[..at]);
        }
        *nearest = near;
    }
}
