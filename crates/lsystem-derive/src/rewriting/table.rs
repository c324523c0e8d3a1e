//! A look-up table for productions without parameters, conditions or weights, with at most one letter of context on
//! each side.

use super::choices::{Choice, Choices};
use super::context::ContextRole;
use super::room::{held, renew, room_for};
use crate::rules::{ContextPattern, LetterId, Rules};

/// By letter, left neighbour and right neighbour: the successor.
#[derive(Clone, Debug)]
pub(super) struct Table {
    /// The number of bits of a neighbour's number.
    bits: u32,
    /// The successor's index in `successors`, and its number of letters.
    chosen: Vec<(u16, u16)>,
    successors: Vec<[LetterId; LONGEST]>,
    /// By successor: its production.
    productions: Vec<Choice>,
    /// The effect of letters on the nearest neighbour in the leftward pass, and in the rightward pass.
    leftward: Updates,
    rightward: Updates,
}

/// The most letters of a system with a table. A larger table would not fit in the first-level cache.
const MAX_LETTERS: usize = 32;

/// The most letters of a successor. Every copy has this length, which is faster than a copy of variable length.
pub(super) const LONGEST: usize = 8;

/// Modules whose successors are collected before they are appended. A batch stays in the first-level cache.
const BATCH: usize = 512;

/// The effect of each letter on the nearest neighbour that the next letters see: `nearest & keep | put`, which needs no
/// branch, except for brackets.
#[derive(Clone, Debug)]
struct Updates {
    keep: [u8; MAX_LETTERS],
    /// By letter: the new nearest neighbour; [`BEGIN`] or [`END`] for a bracket.
    put: [u8; MAX_LETTERS],
    /// Mask of the nearest neighbour at the start of a branch: all ones in the rightward pass, where the neighbour is
    /// on the path to the root; 0 in the leftward pass.
    inside: u8,
}

/// A branch begins: the nearest neighbour is saved until the branch's end.
const BEGIN: u8 = 0x80;
/// A branch ends: the saved nearest neighbour is restored.
const END: u8 = 0x81;

/// The neighbours of a word's modules. Each is a letter plus 1, or 0 for none.
#[derive(Clone, Debug, Default)]
pub(super) struct Sides {
    /// By module: the right neighbour, found in the leftward pass.
    right: Vec<u8>,
    nearest: u8,
    /// The saved nearest neighbours of open branches.
    open: Vec<u8>,
    /// `nearest` and `open` for recording choices, which runs ahead of the rightward pass.
    noted: (u8, Vec<u8>),
    /// Scratch memory for successors.
    made: Vec<LetterId>,
}

impl Sides {
    /// The bytes for a word of `length` modules with at most `brackets` of each kind of bracket.
    pub(super) fn bytes_for(&self, length: usize, brackets: usize) -> u64 {
        (self.right.capacity().max(room_for(length)) + 2 * self.open.capacity().max(room_for(brackets))) as u64
    }

    /// The bytes of its memory.
    pub(super) fn bytes(&self) -> u64 {
        held(&self.right) + held(&self.open) + held(&self.noted.1) + held(&self.made)
    }

    /// Clears everything and reserves memory for a word of `length` modules with at most `brackets` of each kind.
    pub(super) fn reset(&mut self, length: usize, brackets: usize) {
        renew(&mut self.right, length);
        renew(&mut self.open, brackets);
        renew(&mut self.noted.1, brackets);
        self.start_pass();
    }

    /// Adds `count` places, which the passes fill.
    pub(super) fn extend(&mut self, count: usize) {
        self.right.resize(self.right.len() + count, 0);
    }

    /// Starts a pass.
    pub(super) fn start_pass(&mut self) {
        self.nearest = 0;
        self.open.clear();
        self.noted.0 = 0;
        self.noted.1.clear();
    }
}

impl Updates {
    /// The updates of a pass in which the role `begin` begins a branch.
    fn new(roles: &[ContextRole], begin: ContextRole, inside: u8) -> Self {
        let mut updates = Self { keep: [0; MAX_LETTERS], put: [0; MAX_LETTERS], inside };
        for (letter, &role) in roles.iter().enumerate() {
            (updates.keep[letter], updates.put[letter]) = match role {
                ContextRole::Seen => (0, letter as u8 + 1),
                ContextRole::Ignored => (u8::MAX, 0),
                _ if role == begin => (0, BEGIN),
                ContextRole::Open | ContextRole::Close => (0, END),
            };
        }
        updates
    }

    /// The nearest neighbour after a letter.
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
    /// The table; `None` if the rules have other productions or too many letters.
    pub(super) fn new(rules: &Rules, roles: &[ContextRole]) -> Option<Self> {
        let letters = rules.letters.len();
        let short = |rule: &crate::rules::Rule| rule.is_plain() && rule.successor.letters.len() <= LONGEST;
        if letters > MAX_LETTERS || !rules.by_letter.iter().flatten().all(short) {
            return None;
        }
        // Letters plus 1, because 0 means no neighbour.
        let bits = usize::BITS - letters.leading_zeros();
        // By default, letters stay.
        let stay = |letter: usize| [letter as LetterId; LONGEST];
        let mut table = Self {
            bits,
            chosen: (0..letters << (2 * bits)).map(|slot| ((slot >> (2 * bits)) as u16, 1)).collect(),
            successors: (0..letters).map(stay).collect(),
            productions: vec![Choice::Stayed; letters],
            leftward: Updates::new(roles, ContextRole::Close, 0),
            rightward: Updates::new(roles, ContextRole::Open, u8::MAX),
        };
        for (letter, by_letter) in rules.by_letter.iter().enumerate() {
            // The first matching rule decides, so it is written last.
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

    /// Visits `letters` from last to first in the leftward pass, which finds right neighbours. The first of them is at
    /// place
    /// `start`.
    pub(super) fn leftward(&self, letters: &[LetterId], start: usize, sides: &mut Sides) {
        let Sides { right, open, nearest, .. } = sides;
        let mut near = *nearest;
        for (&letter, right) in letters.iter().zip(&mut right[start..start + letters.len()]).rev() {
            *right = near;
            near = self.leftward.pass(near, letter, open);
        }
        *nearest = near;
    }

    /// Records the choices for `letters`, the first of which is at place `start`. Call this before
    /// [`Table::rightward`].
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

    /// The number of letters in the successor of `letter`, which must be next in the rightward pass.
    pub(super) fn length_at(&self, letter: LetterId, place: usize, contexts: bool, sides: &Sides) -> usize {
        let around =
            if contexts { usize::from(sides.nearest) << self.bits | usize::from(sides.right[place]) } else { 0 };
        usize::from(self.chosen[usize::from(letter) << (2 * self.bits) | around].1)
    }

    /// Appends the successors of `letters` to `next` in the rightward pass. The first of the letters is at place
    /// `start`.
    /// `contexts`: some production has a context.
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
