//! Deriving the generations of a history, and recording their steps.

use super::super::choices::{Choice, Choices};
use super::super::image::Image;
use super::super::modules::Modules;
use super::super::step::Rewriter;
use super::{History, Kept, PIECE, PrefixSums, SPARE, Stage, StepRecord, made_of};
use lsystem_base::{Meter, Progress};

impl History {
    /// Does one piece of work.
    pub(super) fn piece(&mut self, meter: &mut Meter) -> Progress {
        let outcome = match &mut self.stage {
            Stage::Done => return Progress::Done,
            Stage::Derive(rewriter) if rewriter.generation() < self.n => match rewriter.advance(meter) {
                Ok(false) => return Progress::More,
                Ok(true) => self.begin_sum(),
                Err(_) => None,
            },
            Stage::Derive(_) => self.begin_count(),
            Stage::Sum(..) => self.sum(meter),
            Stage::Keep(..) => self.keep(meter),
            Stage::Count { .. } => self.count(meter),
        };
        meter.charge(1);
        if outcome.is_none() {
            self.stage = Stage::Done;
            return Progress::Done;
        }
        Progress::More
    }

    /// Claims `bytes` more for the records, if the limit allows them beside the rewriter's memory.
    fn take(&mut self, bytes: u64, rewriter: &mut Rewriter) -> Option<()> {
        self.bytes = self.bytes.saturating_add(bytes);
        let left = self.memory.checked_sub(self.bytes.saturating_add(SPARE))?;
        rewriter.allow(left);
        (rewriter.bytes() <= left).then_some(())
    }

    fn begin_sum(&mut self) -> Option<()> {
        let Stage::Derive(mut rewriter) = core::mem::replace(&mut self.stage, Stage::Done) else { return None };
        let choices = rewriter.take_record()?;
        let sums = PrefixSums::of(*self.lengths.last()?);
        self.take(choices.bytes() + sums.bytes(), &mut rewriter)?;
        self.stage = Stage::Sum(rewriter, StepRecord { choices, sums: sums.ready() });
        Some(())
    }

    /// Counts the modules that the last step made, and records the step.
    fn sum(&mut self, meter: &mut Meter) -> Option<()> {
        let Stage::Sum(_, StepRecord { choices, sums }) = &mut self.stage else { return None };
        let former = *self.lengths.last()?;
        let end = (sums.count + left(meter)).min(former);
        meter.charge((end - sums.count) as u64);
        for place in sums.count..end {
            sums.add(made_of(&self.productions, choices.get(place)));
        }
        if end < former {
            return Some(());
        }
        let Stage::Sum(rewriter, step) = core::mem::replace(&mut self.stage, Stage::Done) else { return None };
        self.lengths.push(rewriter.word().letters.len());
        self.steps.push(step);
        self.begin_keep(rewriter)
    }

    /// Reserves memory for a generation, if generations are kept.
    pub(super) fn begin_keep(&mut self, mut rewriter: Box<Rewriter>) -> Option<()> {
        if self.words.is_none() {
            self.stage = Stage::Derive(rewriter);
            return Some(());
        }
        let (modules, arguments) = (rewriter.word().letters.len(), rewriter.word().arguments.len());
        let sums = PrefixSums::of(modules);
        self.take((2 * modules + 8 * arguments) as u64 + sums.bytes(), &mut rewriter)?;
        let mut word = Modules::default();
        word.letters.reserve_exact(modules);
        word.arguments.reserve_exact(arguments);
        self.stage = Stage::Keep(rewriter, Kept { word, arguments: sums.ready() }, 0);
        Some(())
    }

    /// Keeps a piece of a generation.
    fn keep(&mut self, meter: &mut Meter) -> Option<()> {
        let Stage::Keep(rewriter, kept, argument) = &mut self.stage else { return None };
        let from = rewriter.word();
        let start = kept.word.letters.len();
        let end = (start + left(meter)).min(from.letters.len());
        meter.charge((end - start) as u64);
        for &letter in &from.letters[start..end] {
            let arity = self.rules.letters[usize::from(letter)].arity;
            kept.arguments.add(u64::from(arity));
            *argument += usize::from(arity);
        }
        kept.word.letters.extend_from_slice(&from.letters[start..end]);
        kept.word.arguments.extend_from_slice(&from.arguments[kept.word.arguments.len()..*argument]);
        if end < from.letters.len() {
            return Some(());
        }
        let Stage::Keep(rewriter, kept, _) = core::mem::replace(&mut self.stage, Stage::Done) else { return None };
        self.words.as_mut()?.push(kept);
        self.stage = Stage::Derive(rewriter);
        Some(())
    }

    fn begin_count(&mut self) -> Option<()> {
        let Stage::Derive(mut rewriter) = core::mem::replace(&mut self.stage, Stage::Done) else { return None };
        let modules = rewriter.word().letters.len();
        let (mut choices, sums) = (Choices::new(self.productions.len()), PrefixSums::of(modules));
        let images = if self.has_images() { choices.bytes_of(modules) } else { 0 };
        self.take(images + sums.bytes(), &mut rewriter)?;
        if images > 0 {
            choices.reserve(modules);
        }
        self.stage = Stage::Count { rewriter, sums: sums.ready(), choices, argument: 0 };
        Some(())
    }

    fn has_images(&self) -> bool {
        self.rules.images.iter().any(|images| !images.is_empty())
    }

    /// Counts the segments of the last generation. Returns `None` at its end.
    fn count(&mut self, meter: &mut Meter) -> Option<()> {
        let imagined = self.has_images();
        let Stage::Count { rewriter, sums, choices, argument } = &mut self.stage else { return None };
        let letters = &rewriter.word().letters;
        let mut image = Image::default();
        let end = (sums.count + left(meter)).min(letters.len());
        let start = sums.count;
        for (place, &letter) in letters.iter().enumerate().take(end).skip(start) {
            let letter = usize::from(letter);
            let own = if imagined { rewriter.image_rule(place, *argument, &mut image) } else { None };
            let source = own.and_then(|production| self.productions.get(production).copied().flatten());
            if imagined {
                choices.push(own.map_or(Choice::Stayed, Choice::Made));
            }
            sums.add(source.map_or(self.drawn[letter], |source| source.segments));
            *argument += usize::from(self.rules.letters[letter].arity);
            meter.charge(1 + image.take_spent());
            if meter.is_spent() {
                break;
            }
        }
        if sums.count < letters.len() {
            return Some(());
        }
        self.images = Some(StepRecord { choices: core::mem::take(choices), sums: core::mem::take(sums) });
        None
    }
}

/// The number of modules to handle before the next check of the meter.
fn left(meter: &Meter) -> usize {
    usize::try_from(meter.left()).unwrap_or(usize::MAX).clamp(1, PIECE)
}
