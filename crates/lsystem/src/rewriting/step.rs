//! One derivation step after the other, in pieces of bounded work.

use super::choices::{Choice, Choices};
use super::choose::{Place, Scratch};
use super::context::{Neighbours, Role, roles};
use super::modules::{Chance, Modules, NotFinite};
use super::rules::{Rule, Rules};
use super::table::{Sides, Table};
use crate::{LimitName, Limits};
use core::ops::Range;

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
    /// What the present step does with every module, where that is noted.
    record: Option<Record>,
}

#[derive(Clone, Debug)]
struct Record {
    choices: Choices,
    /// How many modules there are, those to be cut off counted.
    length: usize,
    /// Those that are not cut off.
    kept: Vec<Range<usize>>,
}

/// What does not change from step to step.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) rules: Rules,
    pub(super) roles: Vec<Role>,
    /// By letter: how many arguments it has.
    pub(super) arities: Vec<u8>,
    /// By letter: whether no production rewrites it.
    inert: Vec<bool>,
    pub(super) seed: u32,
    limits: Limits,
    pub(super) random: bool,
    /// By letter: whether it draws; empty where ages are not kept.
    draws: Vec<bool>,
    contexts: bool,
    cutting: bool,
    /// Decides by three letters alone, where that is possible.
    table: Option<Table>,
}

/// How far a step has come.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Pass {
    /// Nothing done yet.
    Start,
    /// From the start to the end: what is cut off is left out.
    Cut(Shears),
    /// From the end to the start; this many modules, and arguments, are left.
    Leftward(usize, usize),
    /// From the start to the end; the next module, and its arguments.
    Rightward(usize, usize),
}

/// How far the cutting of branches has come.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Shears {
    /// The next module, and its arguments.
    at: (usize, usize),
    /// How many modules, and arguments, are kept so far.
    kept: (usize, usize),
    /// Branches open since the cut, where one is going on.
    cut: Option<usize>,
}

/// Modules handled between two looks at the limits and the caller's budget.
const PIECE: usize = 4_096;

/// Productions that are looked at between two looks at the caller's budget, and those of one module more.
const MUCH: u64 = 1 << 15;

impl Rewriter {
    /// Ready to derive from the axiom (generation 0).
    ///
    /// # Errors
    /// Where an argument of the axiom is not finite.
    pub fn new(rules: Rules, seed: u32, limits: Limits) -> Result<Self, Fault> {
        let random = rules.is_random();
        let arities: Vec<u8> = rules.letters.iter().map(|letter| letter.arity).collect();
        let mut word = Modules::default();
        word.start(&rules.axiom, &arities, seed, random).map_err(|NotFinite| Fault::NotFinite(None))?;
        let roles = roles(&rules);
        let plan = Plan {
            contexts: rules.by_letter.iter().flatten().any(Rule::is_context_sensitive),
            table: if rules.is_parametric() || random { None } else { Table::new(&rules, &roles) },
            inert: rules.by_letter.iter().map(Vec::is_empty).collect(),
            cutting: rules.is_cutting(),
            seed,
            limits,
            random,
            draws: vec![],
            arities,
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
            record: None,
        })
    }

    /// The same with the axiom taken for this generation, which is what choices go by.
    pub(crate) fn at(self, generation: u32) -> Self {
        Self { generation, ..self }
    }

    /// Keeps the keys of all modules, and their ages where it is given which letters draw. Nothing must have been derived
    /// yet.
    pub(crate) fn remember(&mut self, draws: Option<Vec<bool>>) {
        self.word.remember(true, draws.is_some());
        self.plan.random = true;
        self.plan.table = None;
        self.plan.draws = draws.unwrap_or_default();
    }

    /// Notes what every step does, among so many productions. Nothing must have been derived yet.
    pub(super) fn note(&mut self, productions: usize) {
        self.record = Some(Record { choices: Choices::new(productions), length: 0, kept: vec![] });
    }

    /// What the step that ended last did with every module, where that is noted.
    pub(super) fn noted(&mut self) -> Option<Choices> {
        let choices = &mut self.record.as_mut()?.choices;
        let empty = choices.emptied();
        Some(core::mem::replace(choices, empty))
    }

    /// The generation that [`Rewriter::word`] is.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// The modules of the last whole generation; while the next is in the making, without what is cut off.
    #[must_use]
    pub fn word(&self) -> &Modules {
        &self.word
    }

    /// The rules it derives by.
    #[must_use]
    pub fn rules(&self) -> &Rules {
        &self.plan.rules
    }

    /// Works towards the next generation until it is reached (true) or about `budget` modules have been handled.
    ///
    /// # Errors
    /// A limit, or a number that is not finite.
    pub fn step(&mut self, budget: usize) -> Result<bool, Fault> {
        let mut left = budget.max(1);
        loop {
            let length = self.word.letters.len();
            let piece = left.min(PIECE);
            match self.pass {
                Pass::Start => {
                    self.next.clear();
                    if let Some(record) = &mut self.record {
                        record.choices = record.choices.emptied();
                        record.length = length;
                        record.kept.clear();
                    }
                    self.pass = if self.plan.cutting { Pass::Cut(Shears::default()) } else { self.look_around() };
                }
                Pass::Cut(mut shears) => {
                    let start = shears.at.0;
                    let done = self.cut(&mut shears, piece);
                    left -= (shears.at.0 - start).min(left);
                    self.pass = if done { self.look_around() } else { Pass::Cut(shears) };
                }
                Pass::Leftward(0, _) => {
                    self.neighbours.turn();
                    self.sides.turn();
                    self.pass = Pass::Rightward(0, 0);
                }
                Pass::Leftward(end, mut arguments) => {
                    let start = end.saturating_sub(piece);
                    let letters = &self.word.letters[start..end];
                    if let Some(table) = &self.plan.table {
                        table.leftward(letters, start, &mut self.sides);
                    } else {
                        for (place, &letter) in (start..end).zip(letters).rev() {
                            arguments -= usize::from(self.plan.arities[usize::from(letter)]);
                            self.neighbours.leftward(place, arguments, self.plan.roles[usize::from(letter)]);
                        }
                    }
                    left -= end - start;
                    self.pass = Pass::Leftward(start, arguments);
                }
                Pass::Rightward(start, _) if start == length => {
                    if let Some(record) = self.record.as_mut().filter(|_| self.plan.cutting) {
                        record.choices.spread(&record.kept, record.length);
                    }
                    core::mem::swap(&mut self.word, &mut self.next);
                    self.generation += 1;
                    self.pass = Pass::Start;
                    return Ok(true);
                }
                Pass::Rightward(start, mut arguments) => {
                    let mut end = (start + piece).min(length);
                    let before = self.work;
                    if let Some(table) = &self.plan.table {
                        let letters = &self.word.letters[start..end];
                        if let Some(record) = &mut self.record {
                            table.note(letters, start, self.plan.contexts, &self.sides, &mut record.choices);
                        }
                        let next = &mut self.next.letters;
                        table.rightward(letters, start, self.plan.contexts, &mut self.sides, next);
                    } else {
                        end = self.by_rules(start..end, &mut arguments)?;
                    }
                    self.work += (end - start) as u64;
                    if self.work > self.plan.limits.work {
                        return Err(Fault::Limit(LimitName::Work));
                    }
                    left = left.saturating_sub((self.work - before) as usize);
                    self.pass = Pass::Rightward(end, arguments);
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

    /// Makes room for what surrounds the modules of the word, and says which pass comes first.
    fn look_around(&mut self) -> Pass {
        let (modules, arguments) = (self.word.letters.len(), self.word.arguments.len());
        if !self.plan.contexts {
            return Pass::Rightward(0, 0);
        }
        match &self.plan.table {
            Some(_) => self.sides.reset(modules),
            None => self.neighbours.reset(modules),
        }
        Pass::Leftward(modules, arguments)
    }

    /// Goes on for `budget` modules leaving out of the word what its symbols cut off: each, and all that follows it up to
    /// the end of its branch (ABOP's `%`). Says whether the end is reached.
    fn cut(&mut self, shears: &mut Shears, budget: usize) -> bool {
        let Self { plan, word, record, .. } = self;
        let Shears { at: (at, argument), kept: (kept, kept_arguments), cut } = shears;
        let end = (*at + budget).min(word.letters.len());
        let (from, from_argument) = (*at, *argument);
        // Modules are kept in runs.
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
                (Some(0), Role::Close) => {
                    (*cut, run, run_arguments) = (None, *at, *argument);
                }
                (Some(deep), Role::Open) => *cut = Some(deep + 1),
                (Some(deep), Role::Close) => *cut = Some(deep - 1),
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
        done
    }

    /// Rewrites modules one by one, fewer of them where many productions have to be looked at; `arguments` is where
    /// theirs are. Returns the place of the first that it has left.
    fn by_rules(&mut self, Range { start, end }: Range<usize>, arguments: &mut usize) -> Result<usize, Fault> {
        let Self { plan, word, next, neighbours, scratch, generation, work, record, .. } = self;
        let step = *generation + 1;
        let enough = *work + MUCH;
        let mut place = start;
        while place < end && *work < enough {
            // What stays is copied in runs.
            let (run, run_arguments) = (place, *arguments);
            while place < end && plan.inert[usize::from(word.letters[place])] {
                let letter = usize::from(word.letters[place]);
                if plan.contexts {
                    neighbours.rightward(place, plan.roles[letter]);
                }
                *arguments += usize::from(plan.arities[letter]);
                place += 1;
            }
            if place > run {
                if let Some(record) = record {
                    record.choices.keep(place - run);
                }
                next.keep(word, run..place, run_arguments..*arguments);
            }
            if place == end {
                break;
            }
            let letter = usize::from(word.letters[place]);
            if plan.contexts {
                neighbours.rightward(place, plan.roles[letter]);
            }
            let own = *arguments..*arguments + usize::from(plan.arities[letter]);
            *arguments = own.end;
            let chance = Chance { key: word.key_of(place), seed: plan.seed, step };
            let at = Place { plan, word, neighbours, place, own: &word.arguments[own.clone()], chance };
            let chosen = at.choose(&plan.rules.by_letter[letter], scratch, work);
            if let Some(record) = record {
                record.choices.push(chosen.map_or(Choice::Stayed, |rule| Choice::Made(rule.production)));
            }
            match chosen {
                None => next.keep(word, place..place + 1, own),
                Some(rule) => {
                    let from = next.letters.len();
                    next.make(&rule.successor, at.slots(rule, scratch), &chance, plan.random)
                        .map_err(|NotFinite| Fault::NotFinite(Some(rule.production)))?;
                    if let Some(age) = word.age_of(place).filter(|_| !plan.draws.is_empty()) {
                        next.grow(from, (word.letters[place], age), step, &plan.draws);
                    }
                }
            }
            place += 1;
        }
        Ok(place)
    }
}
