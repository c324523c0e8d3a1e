//! The plan of a shared drawing: the letters that each depth needs.
use lsystem_base::Meter;
use lsystem_derive::{LetterId, Rewrite, Rules};

/// The letters that each depth needs.
#[derive(Clone, Debug)]
pub(crate) struct LetterPlan {
    /// By depth from `n` down to 1: the rewritten letters, sorted.
    levels: Vec<Vec<LetterId>>,
    /// The letters of the next level; `None` while the axiom is read.
    next: Option<Vec<LetterId>>,
    /// The position of reading: an index in `next`, and an index in that letter's successor.
    at: (usize, usize),
    /// By letter: whether the letter is rewritten and occurs in a successor read for this level.
    made: Vec<bool>,
    /// The number of letters in the axiom and in the successors of all levels.
    pub cost: u64,
}

/// The number of letters read between two checks of the meter.
const READ: usize = 256;

impl LetterPlan {
    pub(super) fn new(rules: &Rules) -> Self {
        let (made, cost) = (vec![false; rules.rewrites.len()], rules.axiom.letters.len() as u64);
        Self { levels: vec![], next: None, at: (0, 0), made, cost }
    }

    /// The number of depths planned; `None` while the axiom is read.
    pub(super) fn depths(&self) -> Option<u32> {
        self.next.is_some().then_some(self.levels.len() as u32)
    }

    /// Continues with the next depth until the depth is planned or the meter is spent.
    pub(super) fn step(&mut self, rules: &Rules, meter: &mut Meter) {
        loop {
            let word = match &self.next {
                None if self.at.0 == 0 => rules.axiom.letters.as_slice(),
                None => break,
                Some(next) => match next.get(self.at.0) {
                    Some(&symbol) => successor(rules, symbol),
                    None => break,
                },
            };
            let run = &word[self.at.1..word.len().min(self.at.1 + READ)];
            if self.at.1 == 0 && self.next.is_some() {
                self.cost += word.len() as u64;
            }
            for &symbol in run {
                self.made[usize::from(symbol)] |= is_rewritten(rules, symbol);
            }
            self.at.1 += run.len();
            if self.at.1 == word.len() {
                self.at = (self.at.0 + 1, 0);
            }
            // Reading a letter takes a quarter of a unit.
            meter.charge(1 + run.len() as u64 / 4);
            if meter.is_spent() {
                return;
            }
        }
        let is_made = |letter: &usize| self.made[*letter];
        let needed = (0..self.made.len()).filter(is_made).map(|letter| letter as LetterId).collect();
        meter.charge(1 + self.made.len() as u64 / 8);
        self.levels.extend(self.next.replace(needed));
        self.made.fill(false);
        self.at = (0, 0);
    }

    /// Takes the letters that need pieces, by depth from 1.
    pub(super) fn levels(&mut self) -> Vec<Vec<LetterId>> {
        let mut levels = core::mem::take(&mut self.levels);
        levels.reverse();
        levels
    }
}

fn is_rewritten(rules: &Rules, symbol: LetterId) -> bool {
    !matches!(rules.rewrites[usize::from(symbol)], Rewrite::Keep)
}

/// The deterministic successor of a letter; empty if there is none.
fn successor(rules: &Rules, symbol: LetterId) -> &[LetterId] {
    rules.rewrites[usize::from(symbol)].always().unwrap_or_default()
}
