//! The check of a drawing's limits, and the search for the largest n within them.

use super::letters::{Census, WalkOutcome};
use crate::drawing::block::{Item, Space};
use crate::turtle::{Score, TurtleOp};
use lsystem_base::{LimitName, Limits, Meter};
use lsystem_derive::{LetterId, Rewrite, Rules};

/// The number of letters added up between two checks of the meter.
const READ: usize = 256;

/// The limit that a drawing exceeds, and the largest n within all limits, if any.
pub(crate) struct Exceeded {
    pub limit: LimitName,
    pub largest: Option<u32>,
}

/// The size of what a letter or a word draws; saturating.
#[derive(Clone, Copy, Debug, Default)]
struct Size {
    segments: u128,
    /// The letters derived on the way.
    letters: u128,
}

/// The numbers of segments and derived letters by generation, counted without derivation. Only for deterministic rules.
#[derive(Clone, Debug)]
pub(crate) struct Forecast {
    /// By letter, after `generation` steps.
    sums: Vec<Size>,
    /// The sums after one more step, for the first letters.
    next: Vec<Size>,
    /// The sums of the axiom; `None` until they are known.
    axiom: Option<Size>,
    /// Whether the axiom's sums have been compared with the limits.
    is_checked: bool,
    /// The position in the word that is being added up, and the sums so far.
    part: (usize, Size),
    generation: u32,
    /// The bytes of a segment.
    bytes: u128,
    /// The last generation within the limits.
    largest: Option<u32>,
}

impl Forecast {
    pub(super) fn new<S: Space>(score: &Score<S>) -> Self {
        let draws = |ops: &Vec<TurtleOp<S>>| ops.iter().map(|op| u128::from(op.segments())).sum();
        let sums = score.ops.iter().map(|ops| Size { segments: draws(ops), letters: 0 }).collect();
        Self {
            sums,
            next: vec![],
            axiom: None,
            is_checked: false,
            part: (0, Size::default()),
            generation: 0,
            bytes: size_of::<Item<S>>() as u128 + u128::from(S::least_picture()),
            largest: None,
        }
    }

    /// Continues for one generation, or until the meter is spent. Returns `Some` when it is known whether generation
    /// `n` fits.
    pub(super) fn step(
        &mut self,
        rules: &Rules,
        limits: &Limits,
        n: u32,
        meter: &mut Meter,
    ) -> Option<Result<(), Exceeded>> {
        let Some(axiom) = self.axiom else {
            self.axiom = self.sum_of(&rules.axiom.letters, meter);
            return None;
        };
        if self.next.is_empty() && !self.is_checked {
            if let Some(known) = self.check(axiom, limits, n) {
                return Some(known);
            }
            self.is_checked = true;
        }
        while let Some(rewrite) = rules.rewrites.get(self.next.len()) {
            let sum = match rewrite {
                Rewrite::Always(word) => self.sum_of(word, meter)?,
                Rewrite::Keep | Rewrite::Choose(_) => self.sums[self.next.len()],
            };
            self.next.push(sum);
        }
        self.sums = core::mem::take(&mut self.next);
        (self.axiom, self.is_checked) = (None, false);
        self.generation += 1;
        None
    }

    /// Compares a generation's segments and work with the limits.
    fn check(&mut self, size: Size, limits: &Limits, n: u32) -> Option<Result<(), Exceeded>> {
        let over = [
            (size.segments, limits.segments, LimitName::Segments),
            (size.letters, limits.work, LimitName::Work),
            (size.segments.saturating_mul(self.bytes), limits.memory, LimitName::Memory),
        ];
        let passed = over.into_iter().find(|&(count, limit, _)| count > u128::from(limit)).map(|(.., name)| name);
        match passed {
            None if self.generation == n => return Some(Ok(())),
            None => self.largest = Some(self.generation),
            // Work never decreases from one generation to the next; the number of segments may.
            Some(limit) if self.generation == n || size.letters > u128::from(limits.work) => {
                return Some(Err(Exceeded { limit, largest: self.largest }));
            }
            Some(_) => {}
        }
        None
    }

    /// The sums of a word's letters; `None` if the meter is spent before the end. The next call then continues.
    fn sum_of(&mut self, word: &[LetterId], meter: &mut Meter) -> Option<Size> {
        loop {
            let (done, mut sum) = self.part;
            let run = &word[done..word.len().min(done + READ)];
            for &symbol in run {
                let Size { segments, letters } = self.sums[usize::from(symbol)];
                sum.segments = sum.segments.saturating_add(segments);
                sum.letters = sum.letters.saturating_add(letters).saturating_add(1);
            }
            self.part = (done + run.len(), sum);
            // Adding a letter takes a quarter of a unit.
            meter.charge(1 + run.len() as u64 / 4);
            if self.part.0 == word.len() {
                self.part = (0, Size::default());
                return Some(sum);
            }
            if meter.is_spent() {
                return None;
            }
        }
    }
}

/// A search for the largest n within the limits, by trials.
#[derive(Clone, Debug)]
pub(super) struct IterationSearch {
    /// The limit that generation `exceeds` exceeds.
    limit: LimitName,
    /// The largest n known to fit.
    fits: Option<u32>,
    /// The smallest n known to exceed a limit.
    exceeds: u32,
    /// The n of the present trial.
    trial: u32,
    census: Census,
}

impl IterationSearch {
    /// A search after generation `n` exceeded `limit`.
    pub(super) fn new(limit: LimitName, n: u32, seed: u32) -> Self {
        Self { limit, fits: None, exceeds: n, trial: 0, census: Census::new(0, seed) }
    }

    /// Continues until the meter is spent or a trial is over. Returns `Some` at the end of the search.
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
        // Blocks and hulls add about an eighth to the bytes of the strokes.
        let bytes = (size_of::<Item<S>>() as u64 + S::least_picture()) * 9 / 8;
        let sure = Limits { segments: limits.segments.min(limits.memory / bytes), ..*limits };
        match self.census.step(rules, score, &sure, meter, |_, _, _| Some(0)) {
            WalkOutcome::Paused => return None,
            WalkOutcome::Ended(()) => self.fits = Some(self.trial),
            WalkOutcome::Passed(limit) => {
                let is_memory = limit == LimitName::Segments && sure.segments < limits.segments;
                (self.exceeds, self.limit) = (self.trial, if is_memory { LimitName::Memory } else { limit });
            }
        }
        // The trial doubles, then bisects. Few trials exceed a limit, and such a trial costs no more than the limit.
        let first = self.fits.map_or(0, |fits| fits + 1);
        self.trial = (first + first.min(self.exceeds.saturating_sub(first) / 2)).max(first);
        self.census = Census::new(self.trial, seed);
        None
    }
}
