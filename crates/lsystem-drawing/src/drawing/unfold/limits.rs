//! Whether a drawing stays within its limits, and up to which n it would.

use super::letters::{Census, Gone};
use crate::drawing::block::{Item, Space};
use crate::turtle::{Op, Score};
use lsystem_derive::{LetterId, Rewrite, Rules};
use lsystem_syntax::{LimitName, Limits, Meter};

/// Letters added up between two looks at the meter.
const READ: usize = 256;

/// What a limit was passed by, and the largest n within.
pub(crate) struct Exceeded {
    pub limit: LimitName,
    pub largest: Option<u32>,
}

/// Segments and letters of one generation after the other, known without deriving them where nothing is random.
#[derive(Clone, Debug)]
pub(crate) struct Forecast {
    /// By letter: segments of what it derives, and letters derived on the way.
    sums: Vec<(u128, u128)>,
    /// The same one generation later, as far as it is known.
    next: Vec<(u128, u128)>,
    /// Of the axiom, and whether that has been looked at.
    axiom: Option<(u128, u128)>,
    is_looked_at: bool,
    /// The letters of a word that are added up, and their sums.
    part: (usize, (u128, u128)),
    generation: u32,
    /// Of a segment in memory.
    bytes: u128,
    /// The last generation within the limits.
    largest: Option<u32>,
}

impl Forecast {
    pub(super) fn new<S: Space>(score: &Score<S>) -> Self {
        let draws = |ops: &Vec<Op<S>>| ops.iter().filter(|op| matches!(op, Op::Draw(_))).count() as u128;
        let sums = score.ops.iter().map(|ops| (draws(ops), 0)).collect();
        Self {
            sums,
            next: vec![],
            axiom: None,
            is_looked_at: false,
            part: (0, (0, 0)),
            generation: 0,
            bytes: size_of::<Item<S>>() as u128 + u128::from(S::least_picture()),
            largest: None,
        }
    }

    /// Looks at generations until the meter is spent; `Some` when it is known whether generation `n` fits.
    pub(super) fn step(
        &mut self,
        rules: &Rules,
        limits: &Limits,
        n: u32,
        meter: &mut Meter,
    ) -> Option<Result<(), Exceeded>> {
        let Some(axiom) = self.axiom else {
            self.axiom = self.of(&rules.axiom.letters, meter);
            return None;
        };
        if self.next.is_empty() && !self.is_looked_at {
            if let Some(known) = self.look(axiom, limits, n) {
                return Some(known);
            }
            self.is_looked_at = true;
        }
        while let Some(rewrite) = rules.rewrites.get(self.next.len()) {
            let sum = match rewrite {
                Rewrite::Always(word) => self.of(word, meter)?,
                Rewrite::Keep | Rewrite::Choose(_) => self.sums[self.next.len()],
            };
            self.next.push(sum);
        }
        self.sums = core::mem::take(&mut self.next);
        (self.axiom, self.is_looked_at) = (None, false);
        self.generation += 1;
        None
    }

    /// Looks at a generation that has so many segments after so much work.
    fn look(&mut self, (segments, work): (u128, u128), limits: &Limits, n: u32) -> Option<Result<(), Exceeded>> {
        let over = [
            (segments, limits.segments, LimitName::Segments),
            (work, limits.work, LimitName::Work),
            (segments.saturating_mul(self.bytes), limits.memory, LimitName::Memory),
        ];
        let passed = over.into_iter().find(|&(count, limit, _)| count > u128::from(limit)).map(|(.., name)| name);
        match passed {
            None if self.generation == n => return Some(Ok(())),
            None => self.largest = Some(self.generation),
            // Work never shrinks; segments may.
            Some(limit) if self.generation == n || work > u128::from(limits.work) => {
                return Some(Err(Exceeded { limit, largest: self.largest }));
            }
            Some(_) => {}
        }
        None
    }

    /// Of what a word derives; `None` where the meter is spent before its end, which is where this goes on.
    fn of(&mut self, word: &[LetterId], meter: &mut Meter) -> Option<(u128, u128)> {
        loop {
            let (done, mut sum) = self.part;
            let run = &word[done..word.len().min(done + READ)];
            for &symbol in run {
                let (segments, work) = self.sums[usize::from(symbol)];
                sum = (sum.0.saturating_add(segments), sum.1.saturating_add(work).saturating_add(1));
            }
            self.part = (done + run.len(), sum);
            // Adding takes a quarter of what handling a symbol does.
            meter.charge(1 + run.len() as u64 / 4);
            if self.part.0 == word.len() {
                self.part = (0, (0, 0));
                return Some(sum);
            }
            if meter.is_spent() {
                return None;
            }
        }
    }
}

/// Tries smaller n, each within the limits, until one fits and the next does not.
#[derive(Clone, Debug)]
pub(super) struct Search {
    limit: LimitName,
    fits: Option<u32>,
    exceeds: u32,
    trial: u32,
    census: Census,
}

impl Search {
    /// Generation `n` passed `limit`.
    pub(super) fn new(limit: LimitName, n: u32, seed: u32) -> Self {
        Self { limit, fits: None, exceeds: n, trial: 0, census: Census::new(0, seed) }
    }

    /// Works on for as many letters as the meter allows; `Some` at the end.
    pub(super) fn step<S: Space>(
        &mut self,
        rules: &Rules,
        score: &Score<S>,
        limits: &Limits,
        seed: u32,
        meter: &mut Meter,
    ) -> Option<Exceeded> {
        let first = self.fits.map_or(0, |fits| fits + 1);
        if first >= self.exceeds {
            return Some(Exceeded { limit: self.limit, largest: self.fits });
        }
        // Blocks and their hulls take little beside their strokes.
        let bytes = (size_of::<Item<S>>() as u64 + S::least_picture()) * 9 / 8;
        let sure = Limits { segments: limits.segments.min(limits.memory / bytes), ..*limits };
        match self.census.step(rules, score, &sure, meter, |_, _, _| Some(0)) {
            Gone::Paused => return None,
            Gone::Ended(()) => self.fits = Some(self.trial),
            Gone::Passed(limit) => {
                let is_memory = limit == LimitName::Segments && sure.segments < limits.segments;
                (self.exceeds, self.limit) = (self.trial, if is_memory { LimitName::Memory } else { limit });
            }
        }
        // Twice as far while nothing stops it, then halfway: few trials pass a limit, and those that do cost no
        // more than the limit.
        let first = self.fits.map_or(0, |fits| fits + 1);
        self.trial = (first + first.min(self.exceeds.saturating_sub(first) / 2)).max(first);
        self.census = Census::new(self.trial, seed);
        None
    }
}
