//! Choosing the production that applies to a module.

use super::context::{ContextSearch, Neighbours};
use super::modules::{Chance, Modules};
use super::plan::RewritePlan;
use crate::rules::Rule;

/// Reused memory.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    /// The places of the modules that match a context.
    found: Vec<u32>,
    /// The parameters of left context, predecessor and right context, if there is a context.
    slots: Vec<f64>,
    /// The weighted rules that apply, with their cumulative weights.
    choices: Vec<(usize, f64)>,
    /// The total work at which the search for one module's production stops.
    pub(super) until: u64,
}

/// The most work of the search for one module's production, in productions tried and neighbours visited. More work
/// would take too long for one step.
pub(super) const MAX_LOOKS: u64 = 3 << 16;

/// A module and its neighbours.
pub(super) struct ModuleInContext<'a> {
    pub(super) plan: &'a RewritePlan,
    pub(super) word: &'a Modules,
    pub(super) neighbours: &'a Neighbours,
    pub(super) place: usize,
    /// The module's arguments.
    pub(super) own: &'a [f64],
    pub(super) chance: Chance,
}

impl<'a> ModuleInContext<'a> {
    /// The production that applies. [`ModuleInContext::slots`] are then its parameters.
    #[inline]
    pub(super) fn choose(&self, rules: &'a [Rule], scratch: &mut Scratch, work: &mut u64) -> Option<&'a Rule> {
        match rules {
            [] => None,
            [rule] if rule.weight.is_none() => self.applies(rule, scratch, work).then_some(rule),
            _ => self.choose_among(rules, scratch, work),
        }
    }

    /// The parameters of a production that applies here, if it was the last one tried.
    #[inline]
    pub(super) fn slots<'s>(&'s self, rule: &Rule, scratch: &'s Scratch) -> &'s [f64] {
        if rule.is_context_sensitive() { &scratch.slots } else { self.own }
    }

    fn choose_among(&self, rules: &'a [Rule], scratch: &mut Scratch, work: &mut u64) -> Option<&'a Rule> {
        scratch.choices.clear();
        let mut total = 0.0;
        let mut class = None;
        for (index, rule) in rules.iter().enumerate() {
            if *work > scratch.until {
                return None;
            }
            // Once a weighted rule applies, only weighted rules of the same class apply: with or without a context.
            if class.is_some_and(|class| rule.weight.is_none() || class != rule.is_context_sensitive()) {
                continue;
            }
            if !self.applies(rule, scratch, work) {
                continue;
            }
            let Some(weight) = &rule.weight else { return Some(rule) };
            class = Some(rule.is_context_sensitive());
            let weight = weight.value(self.slots(rule, scratch), &|at| self.chance.number(at));
            if weight > 0.0 && weight.is_finite() {
                total += weight;
                scratch.choices.push((index, total));
            }
        }
        // Computed as in `Rewrite::plain`, so that both make the same choice.
        let roll = self.chance.key.choice(self.chance.seed, self.chance.step);
        let chosen = scratch.choices.partition_point(|(_, until)| roll >= until / total);
        let &(index, _) = scratch.choices.get(chosen).or(scratch.choices.last())?;
        // Rules tried later have overwritten the parameters, so they are bound again.
        self.applies(&rules[index], scratch, work).then_some(&rules[index])
    }

    /// Whether a production applies here. [`ModuleInContext::slots`] are then its parameters.
    #[inline]
    fn applies(&self, rule: &Rule, scratch: &mut Scratch, work: &mut u64) -> bool {
        *work += 1;
        if rule.is_context_sensitive() && !self.matches_contexts(rule, scratch, work) {
            return false;
        }
        let Some(condition) = &rule.condition else { return true };
        *work += condition.length() / 8;
        let value = condition.value(self.slots(rule, scratch), &|at| self.chance.number(at));
        value != 0.0 && !value.is_nan()
    }

    /// Whether the contexts of a production match. Its parameters are then in the scratch memory.
    fn matches_contexts(&self, rule: &Rule, scratch: &mut Scratch, work: &mut u64) -> bool {
        let Self { plan, word, neighbours, place, .. } = *self;
        let Scratch { found, slots, until, .. } = scratch;
        *work += (rule.left.len() + rule.right.len()) as u64 / 8;
        found.clear();
        if !neighbours.match_left(&word.letters, place, &rule.left, found) {
            return false;
        }
        let mut search = ContextSearch { found, work, until: *until };
        if !neighbours.match_right(&word.letters, &plan.roles, place, &rule.right, &mut search) {
            return false;
        }
        slots.clear();
        if !word.arguments.is_empty() {
            let (left, right) = found.split_at(rule.left.len());
            let of = |&at: &u32| {
                let start = neighbours.arguments[at as usize] as usize;
                let arity = plan.arities[usize::from(word.letters[at as usize])];
                &word.arguments[start..start + usize::from(arity)]
            };
            left.iter().for_each(|at| slots.extend_from_slice(of(at)));
            slots.extend_from_slice(self.own);
            right.iter().for_each(|at| slots.extend_from_slice(of(at)));
        }
        true
    }
}
