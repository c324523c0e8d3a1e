//! The pass that makes the next generation: by a table of letters, or module by module.

use super::super::choices::Choice;
use super::super::choose::{MAX_LOOKS, ModuleInContext};
use super::super::modules::{Chance, NotFinite};
use super::super::table::LONGEST;
use super::{Fault, LOOKS, Rewriter, StepPass, make_room, others};
use core::ops::Range;
use lsystem_base::{LimitName, Meter};

impl Rewriter {
    /// Does one piece of the rightward pass, which makes the next generation.
    pub(super) fn rightward(
        &mut self,
        start: usize,
        mut arguments: usize,
        piece: usize,
        meter: &mut Meter,
    ) -> Result<(), Fault> {
        let work_left = self.plan.limits.work.saturating_sub(self.work);
        if work_left == 0 {
            return Err(Fault::Limit(LimitName::Work));
        }
        let piece = usize::try_from(work_left).unwrap_or(usize::MAX).min(piece);
        let mut end = (start + piece).min(self.word.letters.len());
        if self.plan.cutting
            && let Some(record) = &mut self.record
        {
            end = end.min(record.note_cut(start));
        }
        if self.plan.table.is_some() {
            end = self.by_table(start..end)?;
            meter.charge((end - start) as u64);
            self.work += (end - start) as u64;
        } else {
            end = self.by_rules(start..end, &mut arguments, meter)?;
        }
        self.pass = StepPass::Rightward(end, arguments);
        Ok(())
    }

    /// Rewrites modules by the table, as many as there is room for, but at least one. Returns the place of the next
    /// module.
    fn by_table(&mut self, Range { start, end }: Range<usize>) -> Result<usize, Fault> {
        let Some(table) = &self.plan.table else { return Ok(end) };
        let contexts = self.plan.contexts;
        let room = self.next.room()[0].min(usize::try_from(self.plan.limits.modules).unwrap_or(usize::MAX));
        let mut end = end;
        let safe = room.saturating_sub(self.next.letters.len()) / LONGEST;
        if safe < end - start {
            end = start + safe.max(1);
            if safe == 0 {
                let made = table.length_at(self.word.letters[start], start, contexts, &self.sides);
                self.fit(made, 0)?;
            }
        }
        let Some(table) = &self.plan.table else { return Ok(end) };
        let letters = &self.word.letters[start..end];
        if let Some(record) = &mut self.record {
            table.note(letters, start, contexts, &mut self.sides, &mut record.choices);
        }
        table.rightward(letters, start, contexts, &mut self.sides, &mut self.next.letters);
        Ok(end)
    }

    /// Rewrites modules one by one until the meter is spent. `arguments` is the index of their first argument. Returns
    /// the place of the next module.
    fn by_rules(
        &mut self,
        Range { start, end }: Range<usize>,
        arguments: &mut usize,
        meter: &mut Meter,
    ) -> Result<usize, Fault> {
        let mut place = start;
        while place < end && (place == start || !meter.is_spent()) {
            // Modules that stay are copied in runs.
            let (run, run_arguments) = (place, *arguments);
            place = self.skip_inert(place..end, arguments);
            if place > run {
                self.fit(place - run, *arguments - run_arguments)?;
                if let Some(record) = &mut self.record {
                    record.choices.keep(place - run);
                }
                self.next.keep(&self.word, run..place, run_arguments..*arguments);
                self.work += (place - run) as u64;
                meter.charge((place - run) as u64);
            }
            if place == end {
                break;
            }
            if self.work >= self.plan.limits.work {
                return Err(Fault::Limit(LimitName::Work));
            }
            self.rewrite(place, arguments, meter)?;
            place += 1;
        }
        Ok(place)
    }

    /// Skips modules without a production. Returns the place of the first module that has one.
    fn skip_inert(&mut self, Range { start, end }: Range<usize>, arguments: &mut usize) -> usize {
        let Self { plan, word, neighbours, .. } = self;
        let mut place = start;
        while place < end && plan.inert[usize::from(word.letters[place])] {
            let letter = usize::from(word.letters[place]);
            if plan.contexts {
                neighbours.rightward(place, plan.roles[letter]);
            }
            *arguments += usize::from(plan.arities[letter]);
            place += 1;
        }
        place
    }

    /// Rewrites the module at `place`.
    #[inline]
    fn rewrite(&mut self, place: usize, arguments: &mut usize, meter: &mut Meter) -> Result<(), Fault> {
        let Self { plan, word, next, neighbours, sides, scratch, generation, work, record, .. } = self;
        let letter = usize::from(word.letters[place]);
        if plan.contexts {
            neighbours.rightward(place, plan.roles[letter]);
        }
        let own = *arguments..*arguments + usize::from(plan.arities[letter]);
        *arguments = own.end;
        let step = *generation + 1;
        let chance = Chance { key: word.key_of(place), seed: plan.seed, step };
        let at = ModuleInContext { plan, word, neighbours, place, own: &word.arguments[own.clone()], chance };
        let before = *work;
        scratch.until = before + MAX_LOOKS;
        let chosen = at.choose(&plan.rules.by_letter[letter], scratch, work);
        meter.charge(1 + (*work - before) / LOOKS);
        if *work > scratch.until {
            return Err(Fault::Limit(LimitName::Work));
        }
        *work += 1;
        let [made, computed] = chosen.map_or([1, own.len()], |rule| rule.successor.size());
        if !next.fits(made, computed, plan.limits.modules) {
            make_room(plan, next, others(word, neighbours, sides, record.as_ref()), made, computed)?;
        }
        if let Some(record) = record {
            record.choices.push(chosen.map_or(Choice::Stayed, |rule| Choice::Made(rule.production)));
        }
        let Some(rule) = chosen else {
            next.keep(word, place..place + 1, own);
            return Ok(());
        };
        meter.charge(plan.costs[rule.production]);
        let (from, first) = (next.letters.len(), next.arguments.len());
        next.make(&rule.successor, at.slots(rule, scratch), &chance, plan.random)
            .map_err(|NotFinite| Fault::NotFinite(Some(rule.production)))?;
        if let Some(age) = word.age_of(place).filter(|_| !plan.draws.is_empty()) {
            next.grow(from, word.letters[place], age, step, &plan.draws);
        }
        if let Some((_, part)) = plan.growing.filter(|&(growing, _)| growing == step) {
            next.blend((from, first), word.letters[place], &word.arguments[own], part, &plan.arities);
        }
        Ok(())
    }
}
