//! What stands to the left and to the right of a module, branches considered (ABOP, section 1.8).
//!
//! The left neighbour is the nearest module on the way to the root: finished branches are skipped, an open one is
//! left through its `[`. The right neighbour is the next module of the same axis: branches that start in between
//! are skipped, and the axis ends at the `]` of its own branch.

use super::room::{held, renew, room_for};
use crate::rules::{ContextPattern, LetterId, Rules};

/// No neighbour.
pub(super) const NONE: u32 = u32::MAX;

/// What a letter is to contexts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Role {
    /// `[`
    Open,
    /// `]`
    Close,
    /// Any other that contexts see.
    Seen,
    /// What `ignore:` or `consider:` hides.
    Ignored,
}

/// By letter: its role.
pub(super) fn roles(rules: &Rules) -> Vec<Role> {
    (rules.letters.iter().zip(&rules.considered))
        .map(|(letter, &considered)| match (letter.symbol, considered) {
            ('[', _) => Role::Open,
            (']', _) => Role::Close,
            (_, true) => Role::Seen,
            (_, false) => Role::Ignored,
        })
        .collect()
}

/// The places of neighbours by module, found in one pass to the left and one to the right, each in pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    /// By module: the nearest on the way to the root.
    pub(super) left: Vec<u32>,
    /// By module: the next of its axis.
    pub(super) right: Vec<u32>,
    /// By module that opens a branch: the place after the branch.
    pub(super) after: Vec<u32>,
    /// By module: where its arguments start.
    pub(super) arguments: Vec<u32>,
    open: Vec<(u32, u32)>,
    nearest: u32,
}

impl Neighbours {
    /// The bytes that it takes for a word of `length` modules with so many brackets of a kind.
    pub(super) fn bytes_for(&self, length: usize, brackets: usize) -> u64 {
        let places = 4 * size_of::<u32>() * self.left.capacity().max(room_for(length));
        let open = size_of::<(u32, u32)>() * self.open.capacity().max(room_for(brackets));
        (places + open) as u64
    }

    /// The bytes that it holds.
    pub(super) fn bytes(&self) -> u64 {
        let places = [&self.left, &self.right, &self.after, &self.arguments];
        places.iter().map(|places| held(places)).sum::<u64>() + held(&self.open)
    }

    /// Forgets everything and takes the memory for a word of `length` modules with so many brackets of a kind.
    pub(super) fn reset(&mut self, length: usize, brackets: usize) {
        for places in [&mut self.left, &mut self.right, &mut self.after, &mut self.arguments] {
            renew(places, length);
        }
        renew(&mut self.open, brackets);
        self.turn();
    }

    /// Makes the next `count` places, which the passes fill.
    pub(super) fn extend(&mut self, count: usize) {
        for places in [&mut self.left, &mut self.right, &mut self.after, &mut self.arguments] {
            places.resize(places.len() + count, NONE);
        }
    }

    /// Starts a pass.
    pub(super) fn turn(&mut self) {
        self.open.clear();
        self.nearest = NONE;
    }

    /// Goes one module to the left, whose arguments start at `argument`, in the pass from the end to the start.
    #[inline]
    pub(super) fn leftward(&mut self, place: usize, argument: usize, role: Role) {
        self.arguments[place] = argument as u32;
        self.right[place] = self.nearest;
        match role {
            Role::Close => {
                self.open.push((self.nearest, place as u32 + 1));
                self.nearest = NONE;
            }
            // The branch of an unmatched `[` ends with the word.
            Role::Open => (self.nearest, self.after[place]) = self.open.pop().unwrap_or((NONE, NONE)),
            Role::Seen => self.nearest = place as u32,
            Role::Ignored => {}
        }
    }

    /// Goes one module to the right in the pass from the start to the end.
    #[inline]
    pub(super) fn rightward(&mut self, place: usize, role: Role) {
        self.left[place] = self.nearest;
        match role {
            Role::Open => self.open.push((self.nearest, 0)),
            Role::Close => self.nearest = self.open.pop().map_or(NONE, |(nearest, _)| nearest),
            Role::Seen => self.nearest = place as u32,
            Role::Ignored => {}
        }
    }

    /// Whether the modules on the way from `place` to the root are `pattern`, nearest last; their places go to
    /// `found` in the order of the pattern. The pass to the right must have come by `place`.
    pub(super) fn match_left(
        &self,
        word: &[LetterId],
        place: usize,
        pattern: &[LetterId],
        found: &mut Vec<u32>,
    ) -> bool {
        let start = found.len();
        let mut at = self.left[place];
        for &letter in pattern.iter().rev() {
            if at == NONE || word[at as usize] != letter {
                return false;
            }
            found.push(at);
            at = self.left[at as usize];
        }
        found[start..].reverse();
        true
    }

    /// Whether what follows `place` is `pattern`; the places of its letters go to `found`. A branch in the pattern
    /// is the first of the branches that start there and match. `work` counts the modules looked at; the search is given
    /// up where it passes `until`, for there may be more ways to match than anybody can try.
    pub(super) fn match_right(
        &self,
        word: &[LetterId],
        roles: &[Role],
        place: usize,
        pattern: &[ContextPattern],
        found: &mut Vec<u32>,
        (work, until): (&mut u64, u64),
    ) -> bool {
        let mut place = place;
        let mut pattern = pattern;
        while let Some((first, rest)) = pattern.split_first() {
            match first {
                ContextPattern::Letter(letter) => {
                    let next = self.right[place];
                    if next == NONE || word[next as usize] != *letter {
                        return false;
                    }
                    found.push(next);
                    place = next as usize;
                }
                ContextPattern::Open => {
                    // Every branch that starts before the axis goes on or ends.
                    let mut at = place + 1;
                    while let Some(&letter) = word.get(at) {
                        *work += 1;
                        if *work > until {
                            return false;
                        }
                        match roles[usize::from(letter)] {
                            Role::Ignored => at += 1,
                            Role::Open => {
                                let start = found.len();
                                if self.match_right(word, roles, at, rest, found, (work, until)) {
                                    return true;
                                }
                                found.truncate(start);
                                at = self.after[at] as usize;
                            }
                            Role::Close | Role::Seen => return false,
                        }
                    }
                    return false;
                }
                ContextPattern::Close => {
                    // To the end of the branch that holds `place`, other branches skipped.
                    let mut at = place + 1;
                    loop {
                        *work += 1;
                        if *work > until {
                            return false;
                        }
                        match word.get(at).map(|&letter| roles[usize::from(letter)]) {
                            // The end of the word closes every branch.
                            None => return rest.iter().all(|piece| *piece == ContextPattern::Close),
                            Some(Role::Close) => break,
                            Some(Role::Open) => at = self.after[at] as usize,
                            Some(Role::Seen | Role::Ignored) => at += 1,
                        }
                    }
                    place = at;
                }
            }
            pattern = rest;
        }
        true
    }
}
