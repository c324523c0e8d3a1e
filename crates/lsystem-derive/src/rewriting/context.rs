//! The left and right neighbours of a module, with regard to branches (ABOP, section 1.8).
//!
//! The left neighbour is the nearest module on the path to the root: closed branches are skipped, and an open branch is
//! left through its `[`. The right neighbour is the next module of the same axis: branches in between are skipped, and
//! the axis ends at the `]` of its own branch.

use super::room::{held, renew, room_for};
use crate::rules::{ContextPattern, LetterId, Rules};

/// The place of a missing neighbour.
pub(super) const NONE: u32 = u32::MAX;

/// The role of a letter in contexts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ContextRole {
    /// `[`
    Open,
    /// `]`
    Close,
    /// Any other letter that contexts see.
    Seen,
    /// A letter that `ignore:` or `consider:` hides.
    Ignored,
}

/// By letter: its role.
pub(super) fn roles(rules: &Rules) -> Vec<ContextRole> {
    (rules.letters.iter().zip(&rules.considered))
        .map(|(letter, &considered)| match (letter.symbol, considered) {
            ('[', _) => ContextRole::Open,
            (']', _) => ContextRole::Close,
            (_, true) => ContextRole::Seen,
            (_, false) => ContextRole::Ignored,
        })
        .collect()
}

/// The places of each module's neighbours, found in a leftward and a rightward pass. Passes run in pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Neighbours {
    /// By module: the place of its left neighbour.
    pub(super) left: Vec<u32>,
    /// By module: the place of its right neighbour.
    pub(super) right: Vec<u32>,
    /// By module `[`: the place after its branch.
    pub(super) after: Vec<u32>,
    /// By module: the index of its first argument.
    pub(super) arguments: Vec<u32>,
    open: Vec<(u32, u32)>,
    nearest: u32,
}

/// The search for a right context.
pub(super) struct ContextSearch<'a> {
    /// The places of the pattern's letters.
    pub(super) found: &'a mut Vec<u32>,
    /// The modules visited.
    pub(super) work: &'a mut u64,
    /// The search stops when `work` exceeds this, because the number of ways to match grows exponentially with the
    /// branches of the pattern.
    pub(super) until: u64,
}

impl ContextSearch<'_> {
    /// Counts a module. Returns whether the search may go on.
    fn goes_on(&mut self) -> bool {
        *self.work += 1;
        *self.work <= self.until
    }
}

impl Neighbours {
    /// The bytes for a word of `length` modules with at most `brackets` of each kind of bracket.
    pub(super) fn bytes_for(&self, length: usize, brackets: usize) -> u64 {
        let places = 4 * size_of::<u32>() * self.left.capacity().max(room_for(length));
        let open = size_of::<(u32, u32)>() * self.open.capacity().max(room_for(brackets));
        (places + open) as u64
    }

    /// The bytes of its memory.
    pub(super) fn bytes(&self) -> u64 {
        let places = [&self.left, &self.right, &self.after, &self.arguments];
        places.iter().map(|places| held(places)).sum::<u64>() + held(&self.open)
    }

    /// Clears everything and reserves memory for a word of `length` modules with at most `brackets` of each kind.
    pub(super) fn reset(&mut self, length: usize, brackets: usize) {
        for places in [&mut self.left, &mut self.right, &mut self.after, &mut self.arguments] {
            renew(places, length);
        }
        renew(&mut self.open, brackets);
        self.start_pass();
    }

    /// Adds `count` places, which the passes fill.
    pub(super) fn extend(&mut self, count: usize) {
        for places in [&mut self.left, &mut self.right, &mut self.after, &mut self.arguments] {
            places.resize(places.len() + count, NONE);
        }
    }

    /// Starts a pass.
    pub(super) fn start_pass(&mut self) {
        self.open.clear();
        self.nearest = NONE;
    }

    /// Visits one module in the leftward pass; its arguments start at `argument`.
    #[inline]
    pub(super) fn leftward(&mut self, place: usize, argument: usize, role: ContextRole) {
        self.arguments[place] = argument as u32;
        self.right[place] = self.nearest;
        match role {
            ContextRole::Close => {
                self.open.push((self.nearest, place as u32 + 1));
                self.nearest = NONE;
            }
            // An unmatched `[` opens a branch to the end of the word.
            ContextRole::Open => (self.nearest, self.after[place]) = self.open.pop().unwrap_or((NONE, NONE)),
            ContextRole::Seen => self.nearest = place as u32,
            ContextRole::Ignored => {}
        }
    }

    /// Visits one module in the rightward pass.
    #[inline]
    pub(super) fn rightward(&mut self, place: usize, role: ContextRole) {
        self.left[place] = self.nearest;
        match role {
            ContextRole::Open => self.open.push((self.nearest, 0)),
            ContextRole::Close => self.nearest = self.open.pop().map_or(NONE, |(nearest, _)| nearest),
            ContextRole::Seen => self.nearest = place as u32,
            ContextRole::Ignored => {}
        }
    }

    /// Whether the modules on the path from `place` to the root match `pattern`, nearest last. Their places go to
    /// `found` in the order of the pattern. The rightward pass must have visited `place`.
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

    /// Whether the modules after `place` match `pattern`. A branch in the pattern is the first matching branch
    /// that starts there.
    pub(super) fn match_right(
        &self,
        word: &[LetterId],
        roles: &[ContextRole],
        place: usize,
        pattern: &[ContextPattern],
        search: &mut ContextSearch<'_>,
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
                    search.found.push(next);
                    place = next as usize;
                }
                ContextPattern::Open => {
                    // Tries each branch that starts before the next module of the axis.
                    let mut at = place + 1;
                    while let Some(&letter) = word.get(at) {
                        if !search.goes_on() {
                            return false;
                        }
                        match roles[usize::from(letter)] {
                            ContextRole::Ignored => at += 1,
                            ContextRole::Open => {
                                let start = search.found.len();
                                if self.match_right(word, roles, at, rest, search) {
                                    return true;
                                }
                                search.found.truncate(start);
                                at = self.after[at] as usize;
                            }
                            ContextRole::Close | ContextRole::Seen => return false,
                        }
                    }
                    return false;
                }
                ContextPattern::Close => {
                    // Goes to the end of the branch that contains `place`, and skips branches within it.
                    let mut at = place + 1;
                    loop {
                        if !search.goes_on() {
                            return false;
                        }
                        match word.get(at).map(|&letter| roles[usize::from(letter)]) {
                            // The end of the word closes every branch.
                            None => return rest.iter().all(|piece| *piece == ContextPattern::Close),
                            Some(ContextRole::Close) => break,
                            Some(ContextRole::Open) => at = self.after[at] as usize,
                            Some(ContextRole::Seen | ContextRole::Ignored) => at += 1,
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
