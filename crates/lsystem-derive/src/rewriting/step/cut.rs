//! The pass that cuts off branches.

use super::super::context::ContextRole;
use super::super::modules::Modules;
use super::super::room::{room_for, while_growing};
use super::{Cutting, Fault, Record, Rewriter};
use core::ops::Range;

impl Rewriter {
    /// Handles `budget` modules of the cut. A cutting symbol removes itself and all modules after it up to the end of
    /// its branch (ABOP's `%`). Returns whether the end of the word is reached.
    pub(super) fn cut(&mut self, cutting: &mut Cutting, budget: usize) -> Result<bool, Fault> {
        if let Some(record) = self.record.as_ref().filter(|record| record.kept.capacity() - record.kept.len() < budget)
        {
            let more = room_for(record.kept.len() + budget) - record.kept.len();
            self.afford(self.next.bytes() + while_growing((more * size_of::<Range<usize>>()) as u64))?;
            if let Some(record) = &mut self.record {
                record.kept.reserve_exact(more);
            }
        }
        let Self { plan, word, record, .. } = self;
        let Cutting { at: (at, argument), kept: (kept, kept_arguments), cut } = cutting;
        let end = (*at + budget).min(word.letters.len());
        let (from, from_argument) = (*at, *argument);
        // Modules move in runs.
        let (mut run, mut run_arguments) = (from, from_argument);
        let mut keep = |word: &mut Modules, run: usize, run_arguments: usize, at: usize, argument: usize| {
            if let Some(record) = record.as_mut().filter(|_| run < at) {
                record.kept.push(run..at);
            }
            word.move_down(run..at, *kept, run_arguments..argument, *kept_arguments);
            *kept += at - run;
            *kept_arguments += argument - run_arguments;
        };
        while *at < end {
            let letter = usize::from(word.letters[*at]);
            match (*cut, plan.roles[letter]) {
                (Some(0), ContextRole::Close) => {
                    (*cut, run, run_arguments) = (None, *at, *argument);
                }
                (Some(deep), ContextRole::Open) => *cut = Some(deep + 1),
                (Some(deep), ContextRole::Close) => *cut = Some(deep - 1),
                (None, _) if plan.rules.cuts[letter] => {
                    keep(word, run, run_arguments, *at, *argument);
                    *cut = Some(0);
                }
                _ => {}
            }
            *at += 1;
            *argument += usize::from(plan.arities[letter]);
        }
        if cut.is_none() {
            keep(word, run, run_arguments, *at, *argument);
        }
        let done = *at == word.letters.len();
        if done {
            word.truncate(*kept, *kept_arguments);
        }
        Ok(done)
    }
}

impl Record {
    /// Records the modules cut off before the kept module at `place`. Returns the end of that module's range, counted
    /// in kept modules: up to there nothing more is cut off.
    pub(super) fn note_cut(&mut self, place: usize) -> usize {
        let (run, before) = &mut self.run;
        while let Some(kept) = self.kept.get(*run) {
            if place < *before + kept.len() {
                let start = kept.start + place - *before;
                self.choices.cut(start - self.choices.len());
                return *before + kept.len();
            }
            *before += kept.len();
            *run += 1;
        }
        usize::MAX
    }
}
