//! One derivation step after the other, in pieces of bounded work.

mod apply;
mod cut;

use super::choices::Choices;
use super::choose::Scratch;
use super::context::{Neighbours, Role, roles};
use super::modules::{Modules, NotFinite};
use super::room::held;
use super::table::{Sides, Table};
use crate::rules::{Rule, Rules};
use core::ops::Range;
use lsystem_syntax::Code;
use lsystem_syntax::{LimitName, Limits, Meter};
use std::sync::Arc;

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
    /// The units of work of all steps.
    spent: u64,
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
    /// The first of those that are not noted yet, and how many have been noted before it.
    run: (usize, usize),
}

/// What does not change from step to step.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    pub(super) rules: Arc<Rules>,
    pub(super) roles: Vec<Role>,
    /// By letter: how many arguments it has.
    pub(super) arities: Vec<u8>,
    /// By letter: whether no production rewrites it.
    inert: Vec<bool>,
    pub(super) seed: u32,
    pub(super) limits: Limits,
    /// By production: what its successor costs, in units.
    pub(super) costs: Vec<u64>,
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
    /// Counting brackets: the next module, and how many begin and end branches so far.
    Count(usize, [usize; 2]),
    /// Making so many more places for what surrounds modules.
    Room(usize),
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

/// Modules handled between two looks at the caller's budget.
const PIECE: usize = 4_096;

/// Modules in one unit of work where they are only counted, or memory is made for them.
const QUICK: usize = 16;

/// Productions, and modules around a module, that are looked at in one unit of work.
const LOOKS: u64 = 4;

impl Rewriter {
    /// Ready to derive from the axiom (generation 0).
    ///
    /// # Errors
    /// Where an argument of the axiom is not finite.
    pub fn new(rules: Arc<Rules>, seed: u32, limits: Limits) -> Result<Self, Fault> {
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
            costs: costs(&rules),
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
            spent: 0,
            record: None,
        })
    }

    /// The same with the axiom taken for this generation, which is what choices go by.
    pub fn at(self, generation: u32) -> Self {
        Self { generation, ..self }
    }

    /// Keeps the keys of all modules, and their ages where it is given which letters draw. Nothing must have been derived
    /// yet.
    pub fn remember(&mut self, draws: Option<Vec<bool>>) {
        self.word.remember(true, draws.is_some());
        self.plan.random = true;
        self.plan.table = None;
        self.plan.draws = draws.unwrap_or_default();
    }

    /// Notes what every step does, among so many productions. Nothing must have been derived yet.
    pub(super) fn note(&mut self, productions: usize) {
        self.record = Some(Record { choices: Choices::new(productions), length: 0, kept: vec![], run: (0, 0) });
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
    pub fn rules(&self) -> &Arc<Rules> {
        &self.plan.rules
    }

    /// The bytes that it may hold from now on, beside others of its owner.
    pub fn allow(&mut self, memory: u64) {
        self.plan.limits.memory = memory;
    }

    /// The bytes that it holds.
    pub fn bytes(&self) -> u64 {
        self.others() + self.next.bytes()
    }

    /// Gives back what only deriving needs. Where another generation follows, it is taken again.
    pub fn rest(&mut self) {
        if self.pass == Pass::Start {
            self.next = Modules::default();
            self.neighbours = Neighbours::default();
            self.sides = Sides::default();
        }
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Works towards the next generation until it is reached (true) or about `budget` units of work are done.
    ///
    /// # Errors
    /// A limit, or a number that is not finite; where, does not depend on the budgets.
    pub fn step(&mut self, budget: usize) -> Result<bool, Fault> {
        self.advance(&mut Meter::new(budget as u64))
    }

    /// The same until the meter is spent.
    ///
    /// # Errors
    /// As [`Rewriter::step`].
    pub fn advance(&mut self, meter: &mut Meter) -> Result<bool, Fault> {
        let before = meter.spent();
        let mut outcome = Ok(false);
        while outcome == Ok(false) && !meter.is_spent() {
            outcome = self.pass(meter);
        }
        self.spent += meter.spent() - before;
        outcome
    }

    /// A piece of a pass.
    fn pass(&mut self, meter: &mut Meter) -> Result<bool, Fault> {
        meter.charge(1);
        let length = self.word.letters.len();
        let piece = usize::try_from(meter.left()).unwrap_or(usize::MAX).clamp(1, PIECE);
        match self.pass {
            Pass::Start => self.begin()?,
            Pass::Cut(mut shears) => {
                let (start, kept) = (shears.at.0, shears.kept.0);
                let done = self.cut(&mut shears, piece)?;
                let passed = shears.at.0 - start;
                meter.charge(passed as u64);
                // What is kept counts when it is rewritten.
                self.work += (passed - (shears.kept.0 - kept)) as u64;
                self.pass = if done { self.look_around() } else { Pass::Cut(shears) };
            }
            Pass::Count(start, mut brackets) => {
                let end = (start + piece * QUICK).min(length);
                for &letter in &self.word.letters[start..end] {
                    let role = self.plan.roles[usize::from(letter)];
                    brackets[0] += usize::from(role == Role::Open);
                    brackets[1] += usize::from(role == Role::Close);
                }
                meter.charge(((end - start) / QUICK) as u64 + 1);
                self.pass = Pass::Count(end, brackets);
                if end == length {
                    self.make_places(brackets[0].max(brackets[1]))?;
                }
            }
            Pass::Room(left) => {
                let count = left.min(piece * QUICK);
                match &self.plan.table {
                    Some(_) => self.sides.extend(count),
                    None => self.neighbours.extend(count),
                }
                meter.charge((count / QUICK) as u64 + 1);
                let whole = (length, self.word.arguments.len());
                self.pass = if count == left { Pass::Leftward(whole.0, whole.1) } else { Pass::Room(left - count) };
            }
            Pass::Leftward(0, _) => {
                self.neighbours.turn();
                self.sides.turn();
                self.pass = Pass::Rightward(0, 0);
            }
            Pass::Leftward(end, arguments) => self.leftward(end, arguments, piece, meter),
            Pass::Rightward(start, _) if start == length => {
                if let Some(record) = &mut self.record {
                    record.choices.cut(record.length - record.choices.len());
                }
                core::mem::swap(&mut self.word, &mut self.next);
                self.generation += 1;
                self.pass = Pass::Start;
                return Ok(true);
            }
            Pass::Rightward(start, arguments) => self.rightward(start, arguments, piece, meter)?,
        }
        Ok(false)
    }

    fn begin(&mut self) -> Result<(), Fault> {
        self.next.clear();
        if let Some(record) = &mut self.record {
            record.choices = record.choices.emptied();
            record.length = self.word.letters.len();
            record.kept.clear();
            record.run = (0, 0);
            let wanted = record.choices.bytes_of(record.length);
            self.afford(self.next.bytes() + wanted)?;
            if let Some(record) = &mut self.record {
                record.choices.reserve(record.length);
            }
        }
        self.pass = if self.plan.cutting { Pass::Cut(Shears::default()) } else { self.look_around() };
        Ok(())
    }

    fn leftward(&mut self, end: usize, mut arguments: usize, piece: usize, meter: &mut Meter) {
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
        meter.charge((end - start) as u64);
        self.pass = Pass::Leftward(start, arguments);
    }

    /// Makes room in the next generation for more modules and arguments, where there is too little.
    #[inline]
    fn fit(&mut self, modules: usize, arguments: usize) -> Result<(), Fault> {
        if !self.next.fits(modules, arguments, self.plan.limits.modules) {
            let others = self.others();
            make_room(&self.plan, &mut self.next, others, modules, arguments)?;
        }
        Ok(())
    }

    /// The bytes that are held beside the next generation.
    fn others(&self) -> u64 {
        others(&self.word, &self.neighbours, &self.sides, self.record.as_ref())
    }

    /// Whether so many bytes may be held, beside all but the next generation.
    fn afford(&self, bytes: u64) -> Result<(), Fault> {
        within(self.others().saturating_add(bytes), &self.plan.limits)
    }

    /// Says which pass comes first where nothing is cut off any more.
    fn look_around(&mut self) -> Pass {
        if self.plan.contexts { Pass::Count(0, [0, 0]) } else { Pass::Rightward(0, 0) }
    }

    /// Takes the memory for what surrounds the modules of the word, in which there are at most so many brackets of a kind.
    fn make_places(&mut self, brackets: usize) -> Result<(), Fault> {
        let length = self.word.letters.len();
        let (wanted, held) = match &self.plan.table {
            Some(_) => (self.sides.bytes_for(length, brackets), self.sides.bytes()),
            None => (self.neighbours.bytes_for(length, brackets), self.neighbours.bytes()),
        };
        self.afford((self.next.bytes() + wanted).saturating_sub(held))?;
        match &self.plan.table {
            Some(_) => self.sides.reset(length, brackets),
            None => self.neighbours.reset(length, brackets),
        }
        self.pass = Pass::Room(length);
        Ok(())
    }
}

/// Makes room in a generation for more modules and arguments, within the limits; `others` are the bytes that are held
/// beside it.
#[cold]
fn make_room(plan: &Plan, next: &mut Modules, others: u64, modules: usize, arguments: usize) -> Result<(), Fault> {
    let (modules, arguments) = (next.letters.len() + modules, next.arguments.len() + arguments);
    if modules.max(arguments) as u64 > plan.limits.modules {
        return Err(Fault::Limit(LimitName::Modules));
    }
    let (keys, ages) = (plan.random, !plan.draws.is_empty());
    within(others.saturating_add(next.bytes_with(modules, arguments, keys, ages)), &plan.limits)?;
    next.make_room(modules, arguments, keys, ages);
    Ok(())
}

fn others(word: &Modules, neighbours: &Neighbours, sides: &Sides, record: Option<&Record>) -> u64 {
    let record = record.map_or(0, |record| record.choices.bytes() + held(&record.kept));
    word.bytes() + neighbours.bytes() + sides.bytes() + record
}

fn within(bytes: u64, limits: &Limits) -> Result<(), Fault> {
    if bytes > limits.memory { Err(Fault::Limit(LimitName::Memory)) } else { Ok(()) }
}

/// By production: what it costs to make its successor once, in units. Even the longest that a text can hold costs no more
/// than half of [`Meter::PIECE`].
fn costs(rules: &Rules) -> Vec<u64> {
    let all = || rules.by_letter.iter().chain(&rules.images).flatten();
    let mut costs = vec![0; all().map(|rule| rule.production + 1).max().unwrap_or(0)];
    for rule in all() {
        let computed: u64 = rule.successor.arguments.iter().map(Code::length).sum();
        costs[rule.production] = rule.successor.letters.len() as u64 / 16 + computed / 8;
    }
    costs
}
