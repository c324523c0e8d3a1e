//! One derivation step after the other, in pieces of bounded work.

use super::context::{Neighbours, Role, roles};
use super::rules::{LetterId, Rule, Rules, Template};
use super::table::{Sides, Table};
use crate::{Key, LimitName, Limits};

/// A word of modules.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Modules {
    /// The letters.
    pub letters: Vec<LetterId>,
    /// All modules' arguments, one after the other.
    pub arguments: Vec<f64>,
    /// By module: where its arguments start; kept only where some letter has parameters.
    starts: Vec<u32>,
    /// By module: its place in the derivation; kept only where chance plays a part.
    keys: Vec<Key>,
}

/// Why a derivation cannot go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A limit was passed; the generation that was reached is the largest within it.
    Limit(LimitName),
    /// A number that is not finite came out of a production, by its index in the grammar; `None` for the axiom.
    NotFinite(Option<usize>),
}

/// Derives one generation after the other.
#[derive(Clone, Debug)]
pub struct Rewriter {
    pub(super) plan: Plan,
    pub(super) word: Modules,
    next: Modules,
    pub(super) neighbours: Neighbours,
    sides: Sides,
    scratch: Scratch,
    generation: u32,
    pass: Pass,
    work: u64,
}

/// What does not change from step to step.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) rules: Rules,
    roles: Vec<Role>,
    pub(super) seed: u32,
    limits: Limits,
    pub(super) random: bool,
    parametric: bool,
    contexts: bool,
    /// By letter: whether no production rewrites it.
    inert: Vec<bool>,
    /// Decides by three letters alone, where that is possible.
    table: Option<Table>,
}

/// How far a step has come.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Pass {
    /// Nothing done yet.
    Start,
    /// From the end to the start; this many modules are left.
    Leftward(usize),
    /// From the start to the end; this is the next module.
    Rightward(usize),
}

/// Memory that is used again.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    /// The places of a context's modules.
    found: Vec<u32>,
    /// The parameters of left context, predecessor and right context.
    pub(super) slots: Vec<f64>,
    /// The weighted rules that apply.
    choices: Vec<(usize, f64)>,
}

/// Modules handled between two looks at the limits and the caller's budget.
const PIECE: usize = 4_096;

impl Rewriter {
    /// Ready to derive from the axiom (generation 0).
    ///
    /// # Errors
    /// Where an argument of the axiom is not finite.
    pub fn new(rules: Rules, seed: u32, limits: Limits) -> Result<Self, Fault> {
        let random = rules.is_random();
        let parametric = rules.is_parametric();
        let mut word = Modules::default();
        for (index, template) in rules.axiom.iter().enumerate() {
            let key = Key::root(index as u64);
            word.push(template, (key, key), &[], (seed, 0), (parametric, random))
                .map_err(|NotFinite| Fault::NotFinite(None))?;
        }
        let roles = roles(&rules);
        let plan = Plan {
            seed,
            limits,
            random,
            parametric,
            contexts: rules.by_letter.iter().flatten().any(Rule::is_context_sensitive),
            table: if parametric || random { None } else { Table::new(&rules, &roles) },
            inert: rules.by_letter.iter().map(Vec::is_empty).collect(),
            roles,
            rules,
        };
        Ok(Self {
            plan,
            word,
            next: Modules::default(),
            neighbours: Neighbours::default(),
            sides: Sides::default(),
            scratch: Scratch::default(),
            generation: 0,
            pass: Pass::Start,
            work: 0,
        })
    }

    /// The generation that [`Rewriter::word`] is.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// The modules of the last whole generation.
    #[must_use]
    pub fn word(&self) -> &Modules {
        &self.word
    }

    /// By how much it is spent, 0 to 1: how far the next generation has come.
    pub(crate) fn fraction(&self) -> f64 {
        match self.pass {
            Pass::Rightward(at) => at as f64 / self.word.letters.len().max(1) as f64,
            Pass::Start | Pass::Leftward(_) => 0.0,
        }
    }

    /// The rules it derives by.
    #[must_use]
    pub fn rules(&self) -> &Rules {
        &self.plan.rules
    }

    /// Works towards the next generation until it is reached (true) or about `budget` modules have been handled.
    ///
    /// # Errors
    /// A limit, or a number that is not finite. The last whole generation stays.
    pub fn step(&mut self, budget: usize) -> Result<bool, Fault> {
        let mut left = budget.max(1);
        loop {
            let length = self.word.letters.len();
            match self.pass {
                Pass::Start => {
                    self.next.clear();
                    match (self.plan.contexts, &self.plan.table) {
                        (true, Some(_)) => self.sides.reset(length),
                        (true, None) => self.neighbours.reset(length),
                        (false, _) => {}
                    }
                    self.pass = if self.plan.contexts { Pass::Leftward(length) } else { Pass::Rightward(0) };
                }
                Pass::Leftward(0) => {
                    self.neighbours.turn();
                    self.sides.turn();
                    self.pass = Pass::Rightward(0);
                }
                Pass::Leftward(end) => {
                    let start = end.saturating_sub(left.min(PIECE));
                    if let Some(table) = &self.plan.table {
                        table.leftward(&self.word.letters, start, end, &mut self.sides);
                    } else {
                        for place in (start..end).rev() {
                            self.neighbours.leftward(place, self.plan.roles[usize::from(self.word.letters[place])]);
                        }
                    }
                    left -= (end - start).min(left);
                    self.pass = Pass::Leftward(start);
                }
                Pass::Rightward(start) if start == length => {
                    core::mem::swap(&mut self.word, &mut self.next);
                    self.generation += 1;
                    self.pass = Pass::Start;
                    return Ok(true);
                }
                Pass::Rightward(start) => {
                    let end = (start + left.min(PIECE)).min(length);
                    self.work += (end - start) as u64;
                    if let Some(table) = &self.plan.table {
                        let next = &mut self.next.letters;
                        table.rightward(&self.word.letters, start, end, self.plan.contexts, &mut self.sides, next);
                    } else {
                        self.by_rules(start, end)?;
                    }
                    if self.work > self.plan.limits.work {
                        return Err(Fault::Limit(LimitName::Work));
                    }
                    left -= (end - start).min(left);
                    self.pass = Pass::Rightward(end);
                }
            }
            if left == 0 {
                return Ok(false);
            }
            let size = self.next.letters.len().max(self.next.arguments.len());
            if size as u64 > self.plan.limits.modules {
                return Err(Fault::Limit(LimitName::Modules));
            }
        }
    }

    fn by_rules(&mut self, start: usize, end: usize) -> Result<(), Fault> {
        let Self { plan, word, next, neighbours, scratch, generation, work, .. } = self;
        let step = *generation + 1;
        let mut place = start;
        while place < end {
            let letter = word.letters[place];
            if plan.inert[usize::from(letter)] && !plan.contexts {
                let length = word.letters[place..end].iter().take_while(|&&l| plan.inert[usize::from(l)]).count();
                next.keep_all(word, place, place + length);
                place += length;
                continue;
            }
            if plan.contexts {
                neighbours.rightward(place, plan.roles[usize::from(letter)]);
            }
            let key = word.keys.get(place).copied().unwrap_or(Key::root(0));
            let at = Place { plan, word, neighbours, place, key, step };
            match at.choose(&plan.rules.by_letter[usize::from(letter)], scratch, work) {
                None => next.keep(word, place, &plan.rules),
                Some(rule) => {
                    for (child, template) in rule.successor.iter().enumerate() {
                        let kept = (plan.parametric, plan.random);
                        let child = if plan.random { key.child(step, child as u64) } else { key };
                        next.push(template, (key, child), &scratch.slots, (plan.seed, step), kept)
                            .map_err(|NotFinite| Fault::NotFinite(Some(rule.production)))?;
                    }
                }
            }
            place += 1;
        }
        Ok(())
    }
}

/// A module in its surroundings.
pub(super) struct Place<'a> {
    pub(super) plan: &'a Plan,
    pub(super) word: &'a Modules,
    pub(super) neighbours: &'a Neighbours,
    pub(super) place: usize,
    pub(super) key: Key,
    pub(super) step: u32,
}

impl<'a> Place<'a> {
    /// The production that applies; its parameters are then in the scratch.
    pub(super) fn choose(&self, rules: &'a [Rule], scratch: &mut Scratch, work: &mut u64) -> Option<&'a Rule> {
        scratch.choices.clear();
        let mut class = None;
        for (index, rule) in rules.iter().enumerate() {
            // Once a weighted one applies, only weighted ones of its class do.
            if class.is_some_and(|class| rule.weight.is_none() || class != rule.is_context_sensitive()) {
                continue;
            }
            if !self.applies(rule, scratch, work) {
                continue;
            }
            let Some(weight) = &rule.weight else { return Some(rule) };
            class = Some(rule.is_context_sensitive());
            let weight = weight.value(&scratch.slots, &|at| self.number(at));
            if weight > 0.0 && weight.is_finite() {
                scratch.choices.push((index, weight));
            }
        }
        let total: f64 = scratch.choices.iter().map(|(_, weight)| weight).sum();
        let mut roll = self.key.choice(self.plan.seed, self.step) * total;
        let chosen = scratch.choices.iter().find(|(_, weight)| {
            let here = roll < *weight;
            roll -= weight;
            here
        });
        let &(index, _) = chosen.or(scratch.choices.last())?;
        // Others have been looked at since: its parameters are bound once more.
        self.applies(&rules[index], scratch, work).then_some(&rules[index])
    }

    /// Whether a production applies here; its parameters are then in the scratch.
    fn applies(&self, rule: &Rule, scratch: &mut Scratch, work: &mut u64) -> bool {
        let Self { plan, word, neighbours, place, .. } = *self;
        *work += 1;
        scratch.found.clear();
        if rule.is_context_sensitive() {
            let letters = &word.letters;
            if !neighbours.match_left(letters, place, &rule.left, &mut scratch.found)
                || !neighbours.match_right(letters, &plan.roles, place, &rule.right, &mut scratch.found, work)
            {
                return false;
            }
        }
        if plan.parametric {
            scratch.slots.clear();
            let (left, right) = scratch.found.split_at(rule.left.len().min(scratch.found.len()));
            for &at in left.iter().chain([&(place as u32)]).chain(right) {
                scratch.slots.extend_from_slice(word.arguments_of(at as usize, &plan.rules));
            }
        }
        let Some(condition) = &rule.condition else { return true };
        let value = condition.value(&scratch.slots, &|at| self.number(at));
        value != 0.0 && !value.is_nan()
    }

    fn number(&self, place: u16) -> f64 {
        self.key.number(self.plan.seed, self.step, place)
    }
}

/// A number that is not finite.
pub(super) struct NotFinite;

impl Modules {
    pub(super) fn clear(&mut self) {
        self.letters.clear();
        self.arguments.clear();
        self.starts.clear();
        self.keys.clear();
    }

    /// The arguments of the module at `place`.
    #[must_use]
    pub fn arguments_of(&self, place: usize, rules: &Rules) -> &[f64] {
        let Some(&start) = self.starts.get(place) else { return &[] };
        let arity = usize::from(rules.letters[usize::from(self.letters[place])].arity);
        &self.arguments[start as usize..start as usize + arity]
    }

    /// The key of the module at `place`; without meaning where chance plays no part.
    #[must_use]
    pub fn key_of(&self, place: usize) -> Key {
        self.keys.get(place).copied().unwrap_or(Key::root(place as u64))
    }

    /// Appends the module of another word that stays as it is.
    pub(super) fn keep(&mut self, word: &Self, place: usize, rules: &Rules) {
        self.letters.push(word.letters[place]);
        if !word.starts.is_empty() {
            self.starts.push(self.arguments.len() as u32);
            self.arguments.extend_from_slice(word.arguments_of(place, rules));
        }
        if let Some(key) = word.keys.get(place) {
            self.keys.push(*key);
        }
    }

    /// Appends modules of another word that stay as they are.
    fn keep_all(&mut self, word: &Self, start: usize, end: usize) {
        self.letters.extend_from_slice(&word.letters[start..end]);
        if let Some(&first) = word.starts.get(start) {
            let after = word.starts.get(end).map_or(word.arguments.len(), |&after| after as usize);
            let moved = (self.arguments.len() as u32).wrapping_sub(first);
            self.starts.extend(word.starts[start..end].iter().map(|at| at.wrapping_add(moved)));
            self.arguments.extend_from_slice(&word.arguments[first as usize..after]);
        }
        if !word.keys.is_empty() {
            self.keys.extend_from_slice(&word.keys[start..end]);
        }
    }

    /// Appends a module: its maker's key and its own, the slots to compute its arguments from, seed and step, and
    /// whether arguments and keys are kept.
    pub(super) fn push(
        &mut self,
        template: &Template,
        (maker, own): (Key, Key),
        slots: &[f64],
        (seed, step): (u32, u32),
        (parametric, random): (bool, bool),
    ) -> Result<(), NotFinite> {
        self.letters.push(template.letter);
        if random {
            self.keys.push(own);
        }
        if parametric {
            self.starts.push(self.arguments.len() as u32);
            for code in &template.arguments {
                let value = code.value(slots, &|place| maker.number(seed, step, place));
                if !value.is_finite() {
                    return Err(NotFinite);
                }
                self.arguments.push(value);
            }
        }
        Ok(())
    }
}
