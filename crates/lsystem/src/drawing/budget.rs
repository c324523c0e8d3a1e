//! Whether a drawing stays within its limits, and up to which n it would.

use super::materialise::{Census, Outcome};
use crate::space::Space;
use crate::turtle::{Op, Score};
use crate::{LimitName, Limits, Meter, Program, Rewrite, SymbolId};

/// What a limit was passed by, and the largest n within.
pub(crate) struct Exceeded {
    pub(crate) limit: LimitName,
    pub(crate) largest: Option<u32>,
}

/// Segments and letters of one generation after the other, known without deriving them where nothing is random.
#[derive(Clone, Debug)]
pub(crate) struct Forecast {
    /// By letter: segments of what it derives, and letters derived on the way.
    sums: Vec<(u128, u128)>,
    generation: u32,
    /// The last generation within the limits.
    largest: Option<u32>,
}

impl Forecast {
    pub(crate) fn new<S: Space>(score: &Score<S>) -> Self {
        let draws = |ops: &Vec<Op<S>>| ops.iter().filter(|op| matches!(op, Op::Draw(_))).count() as u128;
        Self { sums: score.ops.iter().map(|ops| (draws(ops), 0)).collect(), generation: 0, largest: None }
    }

    /// Looks at one generation; `Some` when it is known whether generation `n` fits.
    pub(crate) fn step(
        &mut self,
        program: &Program,
        limits: &Limits,
        n: u32,
        meter: &mut Meter,
    ) -> Option<Result<(), Exceeded>> {
        let (segments, work) = self.of(&program.axiom, meter);
        let over = [(segments, limits.segments, LimitName::Segments), (work, limits.work, LimitName::Work)];
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
        self.sums = (program.rewrites.iter().zip(&self.sums))
            .map(|(rewrite, own)| match rewrite {
                Rewrite::Always(word) => self.of(word, meter),
                Rewrite::Keep | Rewrite::Choose(_) => *own,
            })
            .collect();
        self.generation += 1;
        None
    }

    fn of(&self, word: &[SymbolId], meter: &mut Meter) -> (u128, u128) {
        meter.charge(1 + word.len() as u64);
        word.iter().fold((0, 0), |sum: (u128, u128), &symbol| {
            let (segments, work) = self.sums[usize::from(symbol)];
            (sum.0.saturating_add(segments), sum.1.saturating_add(work).saturating_add(1))
        })
    }
}

/// Tries smaller n, each within the limits, until one fits and the next does not.
#[derive(Clone, Debug)]
pub(crate) struct Search {
    limit: LimitName,
    fits: Option<u32>,
    exceeds: u32,
    trial: u32,
    census: Census,
}

impl Search {
    /// Generation `n` passed `limit`.
    pub(crate) fn new(limit: LimitName, n: u32, seed: u32) -> Self {
        Self { limit, fits: None, exceeds: n, trial: 0, census: Census::new(0, seed) }
    }

    /// Works on for as many letters as the meter allows; `Some` at the end.
    pub(crate) fn step<S: Space>(
        &mut self,
        program: &Program,
        score: &Score<S>,
        limits: &Limits,
        seed: u32,
        meter: &mut Meter,
    ) -> Option<Exceeded> {
        let first = self.fits.map_or(0, |fits| fits + 1);
        if first >= self.exceeds {
            return Some(Exceeded { limit: self.limit, largest: self.fits });
        }
        match self.census.step(program, score, limits, meter, |_, _, _| {}) {
            Outcome::Paused => return None,
            Outcome::Ended(()) => self.fits = Some(self.trial),
            Outcome::Passed(limit) => (self.exceeds, self.limit) = (self.trial, limit),
        }
        // Twice as far while nothing stops it, then halfway: few trials pass a limit, and those that do cost no
        // more than the limit.
        let first = self.fits.map_or(0, |fits| fits + 1);
        self.trial = (first + first.min(self.exceeds.saturating_sub(first) / 2)).max(first);
        self.census = Census::new(self.trial, seed);
        None
    }
}
