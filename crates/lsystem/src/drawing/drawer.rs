//! Drawing in resumable steps: planned and shared where blocks memoise, derived letter by letter otherwise.

use super::budget::{Exceeded, Forecast, Search};
use super::builder::Builder;
use super::graph::{self, Level, Origin, Plan};
use super::materialise::{Materialiser, Outcome};
use super::modules::{self, Modular};
use super::parametric::{self, Parametric};
use super::{BlockId, Drawing};
use crate::derivation::limit;
use crate::space::Axis;
use crate::turtle::Score;
use crate::{
    Diagnostic, Kind, LimitName, Limits, MAX_ITERATIONS, Meter, Plane, Program, Progress, Rewrite, Rules, Space,
    SymbolId, System, Turtle,
};
use std::sync::OnceLock;

/// Draws generation `n`.
///
/// # Errors
/// [`Kind::Limit`](crate::Kind::Limit): [`Limits::segments`], [`Limits::work`] or [`Limits::modules`] would be passed, or
/// `n` is above [`MAX_ITERATIONS`]. [`Kind::NotFinite`](crate::Kind::NotFinite): a production computes no finite number.
pub fn draw(system: &System, n: u32, limits: &Limits) -> Result<Drawing, Diagnostic> {
    Drawer::new(system, n, *limits).finish()
}

/// A drawing in the making. It keeps what it needs of its system, so it can wait for its next step as long as
/// anybody likes; one that is superseded is simply dropped.
#[derive(Clone, Debug)]
pub struct Drawer<S: Space = Plane> {
    program: Program,
    turtle: Turtle,
    score: Score<S>,
    memoises: bool,
    seed: u32,
    n: u32,
    limits: Limits,
    builder: Builder<S>,
    /// The largest n that memoises within the limits, where that has been too much.
    memoised: Option<u32>,
    /// The symbols of the generation, where it has been gone through.
    symbols: Option<u64>,
    state: State<S>,
    /// The units of work of all steps.
    spent: u64,
}

#[derive(Clone, Debug)]
enum State<S: Space> {
    /// Finding which letters are needed at which depth.
    Plan(Plan),
    /// Making the blocks of one depth after the other; the last level may be incomplete.
    Build {
        needed: Vec<Vec<SymbolId>>,
        pieces: Vec<Level<S>>,
    },
    /// Counting whether it will fit.
    Forecast(Forecast),
    /// Deriving and drawing letter by letter.
    Materialise(Box<Materialiser<S>>),
    /// Planning states of modules with parameters, and making their pieces.
    Parametric(Box<Parametric<S>>),
    /// Deriving whole generations, and drawing the last.
    Modules(Box<Modular<S>>),
    /// A limit was passed: finding the largest n that is within.
    Search(Search),
    Done {
        root: Option<BlockId>,
        pieces: Vec<Level<S>>,
    },
    Failed(Diagnostic),
}

impl Drawer {
    /// Prepares to draw generation `n` in the plane.
    #[must_use]
    pub fn new(system: &System, n: u32, limits: Limits) -> Self {
        Self::within(system, n, limits)
    }
}

impl<S: Space> Drawer<S> {
    /// Prepares to draw generation `n`.
    pub(super) fn within(system: &System, n: u32, limits: Limits) -> Self {
        let (program, turtle, seed) = (system.program.clone(), system.turtle.clone(), system.seed);
        // What is drawn below `draw:` is in no generation.
        let reachable = if system.rules.is_some() { vec![true; turtle.actions.len()] } else { program.reachable() };
        let score = turtle.score(&reachable);
        let memoises = match &system.rules {
            None => graph::memoises(&program, &score),
            Some(rules) => parametric::memoises(rules, &score),
        };
        let state = if n > MAX_ITERATIONS {
            State::Failed(limit(LimitName::Iterations, u64::from(MAX_ITERATIONS), Some(MAX_ITERATIONS)))
        } else if let Some(rules) = &system.rules {
            if memoises {
                planned(rules, (&turtle, &score), seed, &limits, n)
            } else {
                whole(rules, seed, &limits, &score)
            }
        } else if memoises {
            State::Plan(Plan::new(&program))
        } else if program.is_deterministic() {
            State::Forecast(Forecast::new(&score))
        } else {
            State::Materialise(Box::new(Materialiser::new(start::<S>(&turtle), &score, seed, n)))
        };
        Self {
            program,
            turtle,
            score,
            memoises,
            seed,
            n,
            limits,
            builder: Builder::new(),
            memoised: None,
            symbols: None,
            state,
            spent: 0,
        }
    }

    /// Works on, for about `work` letters (some hundred thousand take a few milliseconds), and says whether there is
    /// more to do.
    // Twice in the wasm, once in `draw` and once by itself, it would be a tenth of what the page loads.
    #[inline(never)]
    pub fn step(&mut self, work: u64) -> Progress {
        let mut meter = Meter::new(work);
        let mut progress = Progress::More;
        while progress == Progress::More && !meter.is_spent() {
            if let Some(next) = self.advance(&mut meter) {
                self.state = next;
            }
            if matches!(self.state, State::Done { .. } | State::Failed(_)) {
                progress = Progress::Done;
            }
        }
        self.spent = self.spent.saturating_add(meter.spent());
        progress
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Does all that is left, and returns the drawing.
    ///
    /// # Errors
    /// As [`draw`].
    pub fn finish(mut self) -> Result<Drawing<S>, Diagnostic> {
        while self.step(1 << 20) == Progress::More {}
        let (root, pieces) = match self.state {
            State::Failed(diagnostic) => return Err(diagnostic),
            State::Done { root, pieces } => (root, pieces),
            _ => (None, vec![]),
        };
        Ok(Drawing {
            blocks: self.builder.blocks,
            items: self.builder.items,
            corners: self.builder.corners,
            vertices: self.builder.vertices,
            styles: self.builder.styles.list,
            root,
            start: S::point([self.turtle.start[0], self.turtle.start[1], 0.0]),
            step: self.score.step,
            width: self.score.width,
            pieces,
            memoised: self.memoises,
            places: vec![],
            symbols: self.symbols,
            extent: OnceLock::new(),
        })
    }

    /// Works on in the present state; returns the next one when this one is over.
    // Once is enough in the wasm.
    #[inline(never)]
    fn advance(&mut self, meter: &mut Meter) -> Option<State<S>> {
        let Self { program, turtle, score, memoises, seed, n, limits, builder, memoised, symbols, .. } = self;
        match &mut self.state {
            State::Plan(plan) => {
                let depths = plan.depths();
                if plan.cost > limits.segments {
                    let largest = depths.checked_sub(1);
                    return Some(State::Failed(limit(LimitName::Segments, limits.segments, largest)));
                }
                if depths < *n {
                    plan.step(program, meter);
                    return None;
                }
                Some(State::Build { needed: plan.levels(), pieces: vec![] })
            }
            State::Build { needed, pieces } => {
                let depth = pieces.len().saturating_sub(1);
                let done = pieces.last().map_or(0, Vec::len);
                match needed.get(depth).and_then(|letters| letters.get(done)) {
                    Some(&symbol) => {
                        let word: &[SymbolId] = match &program.rewrites[usize::from(symbol)] {
                            Rewrite::Always(word) => word,
                            Rewrite::Keep | Rewrite::Choose(_) => &[],
                        };
                        let below = depth.checked_sub(1).map(|below| &pieces[below]);
                        let origin = Origin { former: Some(symbol), step: n.saturating_sub(depth as u32) };
                        let piece = graph::piece(builder, score, below, word, origin, S::AHEAD);
                        meter.charge(S::ITEM * (1 + word.len() as u64));
                        if pieces.is_empty() {
                            pieces.push(vec![]);
                        }
                        pieces[depth].push((symbol, piece));
                        None
                    }
                    None if pieces.len() < needed.len() => {
                        pieces.push(vec![]);
                        meter.charge(S::ITEM);
                        None
                    }
                    None => {
                        let axiom = &program.axiom;
                        let origin = Origin { former: None, step: 0 };
                        let root = graph::piece(builder, score, pieces.last(), axiom, origin, start::<S>(turtle)).block;
                        meter.charge(S::ITEM * (1 + axiom.len() as u64));
                        Some(State::Done { root, pieces: core::mem::take(pieces) })
                    }
                }
            }
            State::Forecast(forecast) => match forecast.step(program, limits, *n, meter)? {
                Ok(()) => Some(State::Materialise(Box::new(Materialiser::new(start::<S>(turtle), score, *seed, *n)))),
                Err(exceeded) => Some(failed(&exceeded, limits)),
            },
            State::Materialise(materialiser) => match materialiser.step(program, score, builder, limits, meter) {
                Outcome::Paused => None,
                Outcome::Ended(root) => {
                    *symbols = Some(materialiser.symbols());
                    Some(State::Done { root, pieces: vec![] })
                }
                Outcome::Passed(name) => {
                    *builder = Builder::new();
                    Some(State::Search(Search::new(name, *n, *seed)))
                }
            },
            State::Parametric(memo) => match memo.step((turtle, score), builder, limits, meter) {
                parametric::Outcome::Paused => None,
                parametric::Outcome::Ended(root, count) => {
                    *symbols = u64::try_from(count).ok();
                    Some(State::Done { root, pieces: vec![] })
                }
                parametric::Outcome::TooMany(largest) => {
                    (*memoises, *memoised) = (false, largest);
                    Some(whole(memo.rules(), *seed, limits, score))
                }
                parametric::Outcome::Failed(diagnostic) => Some(State::Failed(diagnostic)),
            },
            State::Modules(modular) => match modular.step((turtle, score), builder, limits, *n, meter) {
                modules::Outcome::Paused => None,
                modules::Outcome::Ended(root) => {
                    *symbols = Some(modular.symbols());
                    Some(State::Done { root, pieces: vec![] })
                }
                modules::Outcome::Failed(mut diagnostic) => {
                    if let Kind::Limit { largest, .. } = &mut diagnostic.kind {
                        *largest = (*largest).max(*memoised);
                    }
                    Some(State::Failed(diagnostic))
                }
            },
            State::Search(search) => {
                let exceeded = search.step(program, score, limits, *seed, meter)?;
                Some(failed(&exceeded, limits))
            }
            State::Done { .. } | State::Failed(_) => None,
        }
    }
}

/// Modules with parameters, whose pieces are shared.
fn planned<S: Space>(rules: &Rules, with: (&Turtle, &Score<S>), seed: u32, limits: &Limits, n: u32) -> State<S> {
    match Parametric::new(rules, with, seed, limits, n) {
        Ok(parametric) => State::Parametric(Box::new(parametric)),
        Err(diagnostic) => State::Failed(diagnostic),
    }
}

/// Whole generations.
fn whole<S: Space>(rules: &Rules, seed: u32, limits: &Limits, score: &Score<S>) -> State<S> {
    match Modular::new(rules, seed, limits, score) {
        Ok(modular) => State::Modules(Box::new(modular)),
        Err(diagnostic) => State::Failed(diagnostic),
    }
}

fn failed<S: Space>(exceeded: &Exceeded, limits: &Limits) -> State<S> {
    State::Failed(limit(exceeded.limit, limits.value(exceeded.limit), exceeded.largest))
}

/// How the turtle starts.
pub(super) fn start<S: Space>(turtle: &Turtle) -> S::Turn {
    S::turn(Axis::Up, turtle.heading)
}
