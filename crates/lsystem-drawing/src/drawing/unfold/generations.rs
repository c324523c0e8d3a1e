//! Drawing by whole generations, for rules with contexts or parameters.

use super::counts::DrawingCounts;
use crate::drawing::block::{BlockId, Space};
use crate::drawing::builder::Builder;
use crate::drawing::task::{Outcome, Task};
use crate::drawing::tree::Tree;
use crate::room::bytes_of;
use crate::space::unit_of;
use crate::turtle::{Pen, TurtleOp, work_of};
use lsystem_base::{LimitName, Limits, Meter};
use lsystem_derive::{Age, Fault, Image, ModuleAge, Rewriter, fault};
use lsystem_syntax::Diagnostic;

/// The most modules read between two checks of the meter.
const PIECE: usize = 1 << 12;

/// A drawing in the making: derives generation after generation, measures the last, and draws it.
#[derive(Clone, Debug)]
pub(crate) struct Generations<S: Space> {
    rewriter: Rewriter,
    reader: TurtleOpReader<S>,
    stage: Stage<S>,
}

#[derive(Clone, Debug)]
enum Stage<S: Space> {
    Derive,
    Measure(GenerationSize),
    Draw(Box<Draft<S>>),
    /// After a limit was exceeded: find the last generation before `before` that is within all limits.
    Recount {
        passed: LimitName,
        before: u32,
        /// The generation of the present trial.
        next: u32,
        /// The last generation known to fit.
        fits: Option<u32>,
        measure: GenerationSize,
    },
}

/// The last generation as far as it is drawn.
#[derive(Clone, Debug)]
struct Draft<S: Space> {
    pen: Pen<S>,
    saved: Vec<Pen<S>>,
    tree: Tree<S>,
    /// The factor from the score's lengths to units of the tree.
    scale: f64,
}

impl<S: Space> Generations<S> {
    /// Prepares to draw from the axiom on.
    pub(super) fn new(Task { rules, score, seed, n, limits, .. }: &Task<S>) -> Result<Self, Diagnostic> {
        let mut rewriter =
            Rewriter::new(rules.clone(), *seed, *limits).map_err(|fault_| fault(rules, fault_, 0, limits, None))?;
        if score.differs_by_module() {
            rewriter.remember(score.differs_by_age().then(|| score.shows(rules)));
        }
        if score.growth < 1.0 {
            rewriter.grow(*n, score.growth);
        }
        Ok(Self { rewriter, reader: TurtleOpReader::default(), stage: Stage::Derive })
    }

    /// The number of symbols of the last complete generation.
    pub(super) fn symbols(&self) -> u64 {
        self.rewriter.word().letters.len() as u64
    }

    /// The bytes that the work occupies, without the builder.
    pub(super) fn bytes(&self) -> u64 {
        let drawn = match &self.stage {
            Stage::Draw(draft) => bytes_of(&draft.saved) + draft.tree.bytes(),
            _ => 0,
        };
        self.rewriter.bytes() + drawn
    }

    /// Continues until the meter is spent or a stage is over.
    pub(super) fn step(
        &mut self,
        task: &Task<S>,
        builder: &mut Builder<S>,
        meter: &mut Meter,
    ) -> Outcome<Option<BlockId>> {
        match &self.stage {
            Stage::Derive if self.rewriter.generation() < task.n => self.derive(task, builder, meter),
            Stage::Derive => {
                self.rewriter.rest();
                self.stage = Stage::Measure(GenerationSize::default());
                Outcome::Paused
            }
            Stage::Measure(_) => self.measure(task, meter),
            Stage::Draw(_) => self.draw(task, builder, meter),
            Stage::Recount { .. } => self.try_less(task, builder, meter),
        }
    }

    fn derive(&mut self, task: &Task<S>, builder: &Builder<S>, meter: &mut Meter) -> Outcome<Option<BlockId>> {
        let (rewriter, limits) = (&mut self.rewriter, &task.limits);
        rewriter.allow(limits.memory.saturating_sub(builder.bytes()));
        let Err(passed) = rewriter.advance(meter) else { return Outcome::Paused };
        let reached = rewriter.generation();
        match passed {
            Fault::Limit(passed) => self.recount(passed, reached + 1, task),
            Fault::NotFinite(_) => Outcome::Failed(fault(rewriter.rules(), passed, reached, limits, None)),
        }
    }

    /// Measures the last generation: compares it with the limits and finds the longest length.
    fn measure(&mut self, task: &Task<S>, meter: &mut Meter) -> Outcome<Option<BlockId>> {
        let Self { rewriter, reader, stage } = self;
        let Task { turtle, score, limits, .. } = task;
        let Stage::Measure(measure) = stage else { return Outcome::Paused };
        let done = reader.read(rewriter, task, meter, &mut |_, _, ops| {
            measure.add(ops);
            Some(0)
        });
        let generation = rewriter.generation();
        match (measure.passed(limits), done) {
            (Some(passed), _) => return self.recount(passed, task.n, task),
            (None, Err(error)) => {
                return Outcome::Failed(fault(rewriter.rules(), error, generation, limits, None));
            }
            (None, Ok(false)) => {}
            (None, Ok(true)) => {
                let shift = unit_of(measure.longest);
                *reader = TurtleOpReader::default();
                *stage = Stage::Draw(Box::new(Draft {
                    pen: Pen::start(turtle, score),
                    saved: Vec::new(),
                    tree: Tree::new(score.exponent.saturating_add(shift), score.tapers),
                    scale: libm::scalbn(1.0, -shift),
                }));
            }
        }
        Outcome::Paused
    }

    fn draw(&mut self, task: &Task<S>, builder: &mut Builder<S>, meter: &mut Meter) -> Outcome<Option<BlockId>> {
        let Self { rewriter, reader, stage } = self;
        let limits = &task.limits;
        let Stage::Draw(draft) = stage else { return Outcome::Paused };
        let Draft { pen, saved, tree, scale } = &mut **draft;
        let derived = rewriter.bytes();
        let mut act = |place: usize, _: usize, ops: &[TurtleOp<S>]| {
            tree.draw(builder, place as u64, |paper, directions| pen.act(ops, saved, *scale, directions, paper));
            let bytes = builder.bytes() + derived + bytes_of(saved) + tree.bytes();
            let is_full = builder.is_full || bytes > limits.memory;
            (!is_full).then(|| builder.take_work())
        };
        match reader.read(rewriter, task, meter, &mut act) {
            Ok(false) => Outcome::Paused,
            Ok(true) => {
                tree.end(builder, true);
                let finished = tree.finish_one(builder);
                meter.charge(builder.take_work());
                finished.map_or(Outcome::Paused, Outcome::Ended)
            }
            Err(error) => Outcome::Failed(fault(rewriter.rules(), error, rewriter.generation(), limits, None)),
        }
    }

    /// Continues the search for a smaller n within the limits.
    fn try_less(&mut self, task: &Task<S>, builder: &Builder<S>, meter: &mut Meter) -> Outcome<Option<BlockId>> {
        let Self { rewriter, reader, stage } = self;
        let limits = &task.limits;
        let Stage::Recount { passed, before, next, fits, measure } = stage else { return Outcome::Paused };
        let over = Diagnostic::limit(*passed, limits.value(*passed), *fits);
        if next >= before {
            return Outcome::Failed(over);
        }
        if rewriter.generation() < *next {
            rewriter.allow(limits.memory.saturating_sub(builder.bytes()));
            return if rewriter.advance(meter).is_ok() { Outcome::Paused } else { Outcome::Failed(over) };
        }
        let done = reader.read(rewriter, task, meter, &mut |_, _, ops| {
            measure.add(ops);
            Some(0)
        });
        let within = measure.passed(limits).is_none();
        if within && done == Ok(false) {
            return Outcome::Paused;
        }
        if within && done == Ok(true) {
            *fits = Some(*next);
        }
        *measure = GenerationSize::default();
        *reader = TurtleOpReader::default();
        *next += 1;
        Outcome::Paused
    }

    /// Starts again from the axiom, to find the last generation before `before` that is within all limits.
    fn recount(&mut self, passed: LimitName, before: u32, task: &Task<S>) -> Outcome<Option<BlockId>> {
        let Task { rules, seed, limits, .. } = task;
        let failed = || Outcome::Failed(Diagnostic::limit(passed, limits.value(passed), None));
        let Ok(rewriter) = Rewriter::new(rules.clone(), *seed, *limits) else { return failed() };
        self.rewriter = rewriter;
        self.reader = TurtleOpReader::default();
        self.stage = Stage::Recount { passed, before, next: 0, fits: None, measure: GenerationSize::default() };
        Outcome::Paused
    }
}

/// The size of a generation's drawing.
#[derive(Clone, Debug, Default)]
struct GenerationSize {
    counts: DrawingCounts,
    /// The longest draw or move, in units of the score.
    longest: f64,
}

impl GenerationSize {
    fn add<S: Space>(&mut self, ops: &[TurtleOp<S>]) {
        for op in ops {
            self.counts.add(op);
            self.longest = op.length().map_or(self.longest, |length| self.longest.max(length.abs()));
        }
    }

    /// The limit that the drawing exceeds, if any.
    fn passed(&self, limits: &Limits) -> Option<LimitName> {
        if self.counts.segments > limits.segments {
            Some(LimitName::Segments)
        } else if self.counts.work() > limits.work {
            Some(LimitName::Work)
        } else {
            None
        }
    }
}

/// Receives the place, the index of the first argument and the operations of a module. Returns the units of work, or
/// `None` to pause.
type Act<'a, S> = &'a mut dyn FnMut(usize, usize, &[TurtleOp<S>]) -> Option<u64>;

/// Reads the operations of a generation's modules, in order.
#[derive(Clone, Debug)]
pub(super) struct TurtleOpReader<S: Space> {
    /// Whether modules without operations are handed on as well.
    visits_all: bool,
    /// The index of the next module.
    at: usize,
    /// The index of its first argument.
    argument: usize,
    image: Image,
    /// While an image is read: the number of its modules and of its arguments read so far.
    inside: Option<(usize, usize)>,
    /// A reusable buffer for the operations of a letter with an argument.
    ops: Vec<TurtleOp<S>>,
    /// A reusable buffer for the operations of one module.
    own: Vec<TurtleOp<S>>,
}

impl<S: Space> Default for TurtleOpReader<S> {
    fn default() -> Self {
        Self { visits_all: false, at: 0, argument: 0, image: Image::default(), inside: None, ops: vec![], own: vec![] }
    }
}

impl<S: Space> TurtleOpReader<S> {
    /// A reader that hands on modules without operations as well.
    pub(super) fn of_all() -> Self {
        Self { visits_all: true, ..Self::default() }
    }

    /// Hands the places and operations of up to [`PIECE`] modules to `act`. Stops earlier if the work exceeds 4 units
    /// per module, or if `act` returns `None`. Returns whether the generation is at its end.
    pub(super) fn read(
        &mut self,
        rewriter: &Rewriter,
        Task { turtle, score, seed, .. }: &Task<S>,
        meter: &mut Meter,
        act: Act<'_, S>,
    ) -> Result<bool, Fault> {
        let Self { visits_all, at, argument, image, inside, ops, own } = self;
        let (word, rules) = (rewriter.word(), rewriter.rules());
        let end = (*at + PIECE).min(word.letters.len());
        meter.charge(1);
        let mut one = |place: usize, first: usize, letter: u16, arguments: &[f64], fate: Option<&ModuleAge>| {
            let mut plain = score.ops[usize::from(letter)].as_slice();
            if let ([number, ..], [_, ..]) = (arguments, plain) {
                score.numbered(turtle, &turtle.actions[usize::from(letter)], *number, ops);
                plain = ops;
            }
            match fate {
                _ if plain.is_empty() && !*visits_all => Some(0),
                None => Some(work_of(plain) + act(place, first, plain)?),
                Some(fate) => {
                    score.own(plain, fate, *seed, own);
                    Some(work_of(own) + act(place, first, own)?)
                }
            }
        };
        // If modules take much work, fewer of them are read.
        let until = meter.spent() + 4 * PIECE as u64;
        while *at < end && meter.spent() < until {
            meter.charge(2);
            let letter = word.letters[*at];
            let arity = |letter: u16| usize::from(rules.letters[usize::from(letter)].arity);
            let after = *argument + arity(letter);
            let mut fate = score.differs_by_module().then(|| {
                let age = word.age_of(*at).unwrap_or(Age { since: 0, made: 0 });
                let grows = age.made > 0 && u32::from(age.made) == rewriter.generation();
                let since = u32::from(age.since);
                // A module that may be rewritten is a module of the last step, whether or not a production applied.
                let step = if rules.by_letter[usize::from(letter)].is_empty() { since } else { rewriter.generation() };
                ModuleAge { key: word.key_of(*at), since, step, grows }
            });
            if rules.images[usize::from(letter)].is_empty() {
                let Some(work) = one(*at, *argument, letter, &word.arguments[*argument..after], fate.as_ref()) else {
                    return Ok(false);
                };
                meter.charge(work);
            } else {
                if inside.is_none() {
                    let made = rewriter.image(*at, *argument, image).map(|_| ());
                    meter.charge(image.take_spent());
                    made?;
                }
                let (modules, key) = (image.modules(), word.key_of(*at));
                let (done, read) = inside.get_or_insert((0, 0));
                while let Some(&letter) = modules.letters.get(*done) {
                    if meter.spent() >= until {
                        return Ok(false);
                    }
                    let own = &modules.arguments[*read..*read + arity(letter)];
                    if let Some(fate) = &mut fate {
                        fate.key = key.child(u32::MAX, *done as u64);
                    }
                    let Some(work) = one(*at, *argument, letter, own, fate.as_ref()) else { return Ok(false) };
                    meter.charge(1 + work);
                    (*done, *read) = (*done + 1, *read + own.len());
                }
                *inside = None;
            }
            *argument = after;
            *at += 1;
        }
        Ok(*at == word.letters.len())
    }
}
