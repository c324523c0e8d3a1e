//! Derivation steps in pieces of bounded work.

mod apply;
mod cut;

use super::choices::Choices;
use super::choose::Scratch;
use super::context::{ContextRole, Neighbours};
use super::modules::{Modules, NotFinite};
use super::plan::RewritePlan;
use super::room::held;
use super::table::Sides;
use crate::asking::{Asking, AskingSlot};
use crate::rules::Rules;
use core::ops::Range;
use lsystem_base::{LimitName, Limits, Meter};
use std::sync::Arc;

/// The reason why a derivation stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fault {
    /// A limit was exceeded. The generation reached is the largest within the limit.
    Limit(LimitName),
    /// The production with this index in the grammar gave a number that is not finite; `None` for the axiom.
    NotFinite(Option<usize>),
}

/// Derives one generation after another.
#[derive(Clone, Debug)]
pub struct Rewriter {
    pub(super) plan: RewritePlan,
    pub(super) word: Modules,
    next: Modules,
    pub(super) neighbours: Neighbours,
    sides: Sides,
    scratch: Scratch,
    generation: u32,
    pass: StepPass,
    work: u64,
    /// The units of work of all steps.
    spent: u64,
    /// The records of the present step, if steps are recorded.
    record: Option<Record>,
    /// The interpretation of the word, while its queries are answered.
    asking: AskingSlot,
}

#[derive(Clone, Debug)]
struct Record {
    choices: Choices,
    /// The number of modules, including modules to be cut off.
    length: usize,
    /// The ranges of modules that are not cut off.
    kept: Vec<Range<usize>>,
    /// The index of the first range not fully recorded, and the number of modules in the ranges before it.
    run: (usize, usize),
}

/// The progress of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum StepPass {
    /// The step has not begun.
    Start,
    /// Rightward: removing the modules that are cut off.
    Cut(Cutting),
    /// Counting brackets: the next module, and the numbers of `[` and `]` so far.
    Count(usize, [usize; 2]),
    /// Making places for neighbours: the number of modules that remain.
    Room(usize),
    /// The leftward pass: the numbers of modules and of arguments that remain.
    Leftward(usize, usize),
    /// The rightward pass: the next module, and the index of its first argument.
    Rightward(usize, usize),
    /// Answering the queries of the new word.
    Ask,
}

/// The progress of cutting branches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Cutting {
    /// The next module, and the index of its first argument.
    at: (usize, usize),
    /// The numbers of modules and of arguments kept so far.
    kept: (usize, usize),
    /// During a cut, the number of branches opened since it began; `None` otherwise.
    cut: Option<usize>,
}

/// Modules handled between two checks of the caller's budget.
const PIECE: usize = 4_096;

/// Modules in one unit of work for passes that only count modules or make places for them.
const QUICK: usize = 16;

/// Productions tried and neighbours visited in one unit of work.
const LOOKS: u64 = 4;

impl Rewriter {
    /// A rewriter at the axiom (generation 0).
    ///
    /// # Errors
    /// If an argument of the axiom is not finite.
    pub fn new(rules: Arc<Rules>, seed: u32, limits: Limits) -> Result<Self, Fault> {
        let plan = RewritePlan::new(rules, seed, limits);
        let mut word = Modules::default();
        word.start(&plan.rules.axiom, &plan.arities, seed, plan.random).map_err(|NotFinite| Fault::NotFinite(None))?;
        let mut new = Self {
            plan,
            word,
            next: Modules::default(),
            neighbours: Neighbours::default(),
            sides: Sides::default(),
            scratch: Scratch::default(),
            generation: 0,
            pass: StepPass::Start,
            work: 0,
            spent: 0,
            record: None,
            asking: AskingSlot::default(),
        };
        if let Some(interpreter) = new.plan.rules.interpreter.clone() {
            if interpreter.0.needs_keys() {
                new.remember(None);
            }
            // An axiom is short, so its queries are answered at once.
            while !new.ask(&mut Meter::new(u64::MAX))? {}
        }
        Ok(new)
    }

    /// Goes on answering the queries of the word. Returns whether all are answered.
    fn ask(&mut self, meter: &mut Meter) -> Result<bool, Fault> {
        let Some(interpreter) = &self.plan.rules.interpreter else { return Ok(true) };
        let mut asking = match self.asking.0.take() {
            Some(asking) => asking,
            None => Box::new(Asking::new(interpreter, self)),
        };
        let done = asking.step(self, meter)?;
        self.afford(self.next.bytes() + asking.bytes())?;
        if self.work.saturating_add(asking.work()) > self.plan.limits.work {
            return Err(Fault::Limit(LimitName::Work));
        }
        if done {
            self.work += asking.work();
            asking.fill(&mut self.word.arguments);
        } else {
            self.asking.0 = Some(asking);
        }
        Ok(done)
    }

    /// The rewriter with its axiom taken as this generation. Random choices depend on the generation's number.
    pub fn at(self, generation: u32) -> Self {
        Self { generation, ..self }
    }

    /// Keeps the keys of all modules, and also their ages if `draws` is given: by letter, whether it draws. Call this
    /// before the first step.
    pub fn remember(&mut self, draws: Option<Vec<bool>>) {
        self.word.remember(true, draws.is_some());
        self.plan.random = true;
        self.plan.table = None;
        self.plan.draws = draws.unwrap_or_default();
    }

    /// Lets the modules of `step` grow: a module that continues one of the same letter then has numbers this part of the
    /// way from those of its predecessor. The following steps would go on from there.
    pub fn grow(&mut self, step: u32, part: f64) {
        self.plan.growing = Some((step, part));
    }

    /// Records every step, for a grammar of this many productions. Call this before the first step.
    pub(super) fn record_steps(&mut self, productions: usize) {
        self.record = Some(Record { choices: Choices::new(productions), length: 0, kept: vec![], run: (0, 0) });
    }

    /// Takes the records of the last whole step; `None` if steps are not recorded.
    pub(super) fn take_record(&mut self) -> Option<Choices> {
        let choices = &mut self.record.as_mut()?.choices;
        let empty = choices.emptied();
        Some(core::mem::replace(choices, empty))
    }

    /// The generation of [`Rewriter::word`].
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// The modules of the last whole generation. During the next step, modules that are cut off disappear from it, and
    /// it is the new generation while its queries are answered.
    #[must_use]
    pub fn word(&self) -> &Modules {
        &self.word
    }

    /// The seed of the derivation.
    #[must_use]
    pub fn seed(&self) -> u32 {
        self.plan.seed
    }

    /// The rules of the derivation.
    #[must_use]
    pub fn rules(&self) -> &Arc<Rules> {
        &self.plan.rules
    }

    /// Sets the most bytes that the rewriter may hold from now on.
    pub fn allow(&mut self, memory: u64) {
        self.plan.limits.memory = memory;
    }

    /// The bytes of the rewriter's memory.
    pub fn bytes(&self) -> u64 {
        self.others() + self.next.bytes()
    }

    /// Frees the memory that only deriving needs. The next step allocates it again.
    pub fn rest(&mut self) {
        if self.pass == StepPass::Start {
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

    /// Works on the next generation for about `budget` units of work. Returns true once the generation is complete.
    ///
    /// # Errors
    /// If a limit is exceeded or a number is not finite. The place of the error does not depend on the budgets.
    pub fn step(&mut self, budget: usize) -> Result<bool, Fault> {
        self.advance(&mut Meter::new(budget as u64))
    }

    /// As [`Rewriter::step`], until the meter is spent.
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

    /// Does one piece of a pass.
    fn pass(&mut self, meter: &mut Meter) -> Result<bool, Fault> {
        meter.charge(1);
        let length = self.word.letters.len();
        let piece = usize::try_from(meter.left()).unwrap_or(usize::MAX).clamp(1, PIECE);
        match self.pass {
            StepPass::Start => self.begin()?,
            StepPass::Cut(mut cutting) => {
                let (start, kept) = (cutting.at.0, cutting.kept.0);
                let done = self.cut(&mut cutting, piece)?;
                let passed = cutting.at.0 - start;
                meter.charge(passed as u64);
                // Only modules cut off count here; modules kept count when they are rewritten.
                self.work += (passed - (cutting.kept.0 - kept)) as u64;
                self.pass = if done { self.pass_after_cutting() } else { StepPass::Cut(cutting) };
            }
            StepPass::Count(start, mut brackets) => {
                let end = (start + piece * QUICK).min(length);
                for &letter in &self.word.letters[start..end] {
                    let role = self.plan.roles[usize::from(letter)];
                    brackets[0] += usize::from(role == ContextRole::Open);
                    brackets[1] += usize::from(role == ContextRole::Close);
                }
                meter.charge(((end - start) / QUICK) as u64 + 1);
                self.pass = StepPass::Count(end, brackets);
                if end == length {
                    self.make_places(brackets[0].max(brackets[1]))?;
                }
            }
            StepPass::Room(left) => {
                let count = left.min(piece * QUICK);
                match &self.plan.table {
                    Some(_) => self.sides.extend(count),
                    None => self.neighbours.extend(count),
                }
                meter.charge((count / QUICK) as u64 + 1);
                let whole = (length, self.word.arguments.len());
                self.pass =
                    if count == left { StepPass::Leftward(whole.0, whole.1) } else { StepPass::Room(left - count) };
            }
            StepPass::Leftward(0, _) => {
                self.neighbours.start_pass();
                self.sides.start_pass();
                self.pass = StepPass::Rightward(0, 0);
            }
            StepPass::Leftward(end, arguments) => self.leftward(end, arguments, piece, meter),
            StepPass::Rightward(start, _) if start == length => {
                if let Some(record) = &mut self.record {
                    record.choices.cut(record.length - record.choices.len());
                }
                core::mem::swap(&mut self.word, &mut self.next);
                self.pass = StepPass::Ask;
            }
            StepPass::Ask => {
                if !self.ask(meter)? {
                    return Ok(false);
                }
                self.generation += 1;
                self.pass = StepPass::Start;
                return Ok(true);
            }
            StepPass::Rightward(start, arguments) => self.rightward(start, arguments, piece, meter)?,
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
        self.pass = if self.plan.cutting { StepPass::Cut(Cutting::default()) } else { self.pass_after_cutting() };
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
        self.pass = StepPass::Leftward(start, arguments);
    }

    /// Makes room in the next generation for more modules and arguments, if needed.
    #[inline]
    fn fit(&mut self, modules: usize, arguments: usize) -> Result<(), Fault> {
        if !self.next.fits(modules, arguments, self.plan.limits.modules) {
            let others = self.others();
            make_room(&self.plan, &mut self.next, others, modules, arguments)?;
        }
        Ok(())
    }

    /// The bytes of all memory except the next generation's.
    fn others(&self) -> u64 {
        let asking = self.asking.0.as_ref().map_or(0, |asking| asking.bytes());
        others(&self.word, &self.neighbours, &self.sides, self.record.as_ref()) + asking
    }

    /// Checks that `bytes` fit in the limit, together with all memory except the next generation's.
    fn afford(&self, bytes: u64) -> Result<(), Fault> {
        within(self.others().saturating_add(bytes), &self.plan.limits)
    }

    /// The first pass after the cutting of branches.
    fn pass_after_cutting(&mut self) -> StepPass {
        if self.plan.contexts { StepPass::Count(0, [0, 0]) } else { StepPass::Rightward(0, 0) }
    }

    /// Reserves memory for the neighbours of the word's modules. The word has at most `brackets` of each kind of
    /// bracket.
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
        self.pass = StepPass::Room(length);
        Ok(())
    }
}

/// Makes room in a generation for more modules and arguments, within the limits. `others` are the bytes of all other
/// memory.
#[cold]
fn make_room(
    plan: &RewritePlan,
    next: &mut Modules,
    others: u64,
    modules: usize,
    arguments: usize,
) -> Result<(), Fault> {
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
