//! Drawing in resumable steps: planned and shared where blocks memoise, derived letter by letter otherwise.

use super::Drawing;
use super::budget::{Exceeded, Forecast, Search};
use super::builder::Builder;
use super::graph::{self, Level, Origin, Plan, Word, Writing};
use super::materialise::{Materialiser, Outcome};
use super::modules::{self, Modular};
use super::parametric::{self, Parametric};
use crate::drawing::block::{BlockId, Space};
use crate::room::bytes_of;
use crate::turtle::Score;
use crate::{Plane, System, Turtle};
use lsystem_derive::{LetterId, Rules};
use lsystem_syntax::{Diagnostic, Kind, LimitName, Limits, MAX_ITERATIONS, Meter, Progress};
use std::sync::{Arc, OnceLock};

/// Draws generation `n`.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit): [`Limits::segments`], [`Limits::work`] or [`Limits::modules`] would be passed, or
/// `n` is above [`MAX_ITERATIONS`]. [`Kind::NotFinite`](lsystem_syntax::Kind::NotFinite): a production computes no finite number.
pub fn draw(system: &System, n: u32, limits: &Limits) -> Result<Drawing, Diagnostic> {
    Drawer::new(system, n, *limits).finish()
}

/// A drawing in the making. It keeps what it needs of its system, so it can wait for its next step as long as
/// anybody likes; one that is superseded is simply dropped.
#[derive(Clone, Debug)]
pub struct Drawer<S: Space = Plane> {
    rules: Arc<Rules>,
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
    /// The bytes of complete levels of pieces.
    held: u64,
}

#[derive(Clone, Debug)]
enum State<S: Space> {
    /// Finding which letters are needed at which depth.
    Plan(Plan),
    /// Making the blocks of one depth after the other; the last level may be incomplete.
    Build {
        needed: Vec<Vec<LetterId>>,
        pieces: Vec<Level<S>>,
        /// The next piece.
        writing: Option<Box<Writing<S>>>,
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
    /// Finding the extent of what is made.
    Survey {
        survey: Box<S::Survey>,
        root: BlockId,
        pieces: Vec<Level<S>>,
    },
    Done {
        root: Option<BlockId>,
        pieces: Vec<Level<S>>,
        extent: Option<S::Extent>,
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
        let (rules, turtle, seed) = (system.rules.clone(), system.turtle.clone(), system.seed);
        // What is drawn below `draw:` is in no generation.
        let reachable = if rules.is_plain() { rules.reachable() } else { vec![true; turtle.actions.len()] };
        let score = turtle.score(&reachable);
        let memoises =
            if rules.is_plain() { graph::memoises(&rules, &score) } else { parametric::memoises(&rules, &score) };
        let state = if n > MAX_ITERATIONS {
            State::Failed(Diagnostic::limit(LimitName::Iterations, u64::from(MAX_ITERATIONS), Some(MAX_ITERATIONS)))
        } else if !rules.is_plain() {
            match memoises {
                true => planned(&rules, (&turtle, &score), seed, &limits, n),
                false => whole(&rules, seed, &limits, &score),
            }
        } else if memoises {
            State::Plan(Plan::new(&rules))
        } else if rules.is_deterministic() {
            State::Forecast(Forecast::new(&score))
        } else {
            State::Materialise(Box::new(Materialiser::new(turtle.start_turn::<S>(), &score, seed, n)))
        };
        Self {
            rules,
            turtle,
            score,
            memoises,
            seed,
            n,
            limits,
            builder: Builder::within(limits.memory),
            memoised: None,
            symbols: None,
            state,
            spent: 0,
            held: 0,
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
            if self.builder.is_full || self.bytes() > self.limits.memory {
                self.builder = Builder::new();
                self.state = match self.state {
                    State::Materialise(_) => State::Search(Search::new(LimitName::Memory, self.n, self.seed)),
                    _ => State::Failed(Diagnostic::limit(LimitName::Memory, self.limits.memory, None)),
                };
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

    /// The bytes that the drawing in the making takes, as [`Limits::memory`] counts them: in space, with what its pictures
    /// will be made from.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let state = match &self.state {
            State::Build { writing, .. } => writing.as_ref().map_or(0, |writing| writing.bytes()),
            State::Materialise(materialiser) => materialiser.bytes(),
            State::Parametric(memo) => memo.bytes(),
            State::Modules(modular) => modular.bytes(),
            _ => 0,
        };
        self.builder.bytes() + self.builder.scene.bytes(self.memoises) + self.held + state
    }

    /// Does all that is left, and returns the drawing.
    ///
    /// # Errors
    /// As [`draw`].
    pub fn finish(mut self) -> Result<Drawing<S>, Diagnostic> {
        while self.step(1 << 20) == Progress::More {}
        let (root, pieces, extent) = match self.state {
            State::Failed(diagnostic) => return Err(diagnostic),
            State::Done { root, pieces, extent } => (root, pieces, extent),
            _ => (None, vec![], None),
        };
        self.builder.shrink();
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
            scene: self.builder.scene,
            extent: extent.map_or_else(OnceLock::new, |extent| OnceLock::from(Some(extent))),
        })
    }

    /// Finds which letters are needed at which depth.
    fn plan(&mut self, meter: &mut Meter) -> Option<State<S>> {
        let Self { rules, n, limits, .. } = self;
        let State::Plan(plan) = &mut self.state else { return None };
        let Some(depths) = plan.depths() else {
            plan.step(rules, meter);
            return None;
        };
        if plan.cost > limits.segments {
            let largest = depths.checked_sub(1);
            return Some(State::Failed(Diagnostic::limit(LimitName::Segments, limits.segments, largest)));
        }
        if depths < *n {
            plan.step(rules, meter);
            return None;
        }
        Some(State::Build { needed: plan.levels(), pieces: vec![], writing: None })
    }

    /// Makes the pieces of one depth after the other.
    fn build(&mut self, meter: &mut Meter) -> Option<State<S>> {
        let Self { rules, turtle, score, n, builder, held, .. } = self;
        let State::Build { needed, pieces, writing } = &mut self.state else { return None };
        let depth = pieces.len().saturating_sub(1);
        let done = pieces.last().map_or(0, Vec::len);
        let mut write = |word: Word<'_, S>| {
            let piece = writing.get_or_insert_with(|| Box::new(Writing::new(&word))).step(builder, &word, meter)?;
            *writing = None;
            meter.charge(8);
            Some(piece)
        };
        match needed.get(depth).and_then(|letters| letters.get(done)) {
            Some(&symbol) => {
                let letters = rules.rewrites[usize::from(symbol)].always().unwrap_or_default();
                let below = depth.checked_sub(1).map(|below| &pieces[below]);
                let origin = Origin { former: Some(symbol), step: n.saturating_sub(depth as u32) };
                let piece = write(Word { score, below, letters, origin, heading: S::AHEAD })?;
                if pieces.is_empty() {
                    pieces.push(vec![]);
                }
                pieces[depth].push((symbol, piece));
                None
            }
            None if pieces.len() < needed.len() => {
                *held += pieces.last().map_or(0, bytes_of);
                pieces.push(vec![]);
                meter.charge(8);
                None
            }
            None => {
                let (letters, origin) = (rules.axiom.letters.as_slice(), Origin { former: None, step: 0 });
                let heading = turtle.start_turn::<S>();
                let root = write(Word { score, below: pieces.last(), letters, origin, heading })?.block;
                Some(made(root, core::mem::take(pieces)))
            }
        }
    }

    /// Works on in the present state; returns the next one when this one is over.
    // Once is enough in the wasm.
    #[inline(never)]
    fn advance(&mut self, meter: &mut Meter) -> Option<State<S>> {
        match self.state {
            State::Plan(_) => return self.plan(meter),
            State::Build { .. } => return self.build(meter),
            _ => {}
        }
        let Self { rules, turtle, score, memoises, seed, n, limits, builder, memoised, symbols, .. } = self;
        match &mut self.state {
            State::Forecast(forecast) => match forecast.step(rules, limits, *n, meter)? {
                Ok(segments) => {
                    builder.expect(segments);
                    Some(State::Materialise(Box::new(Materialiser::new(turtle.start_turn::<S>(), score, *seed, *n))))
                }
                Err(exceeded) => Some(failed(&exceeded, limits)),
            },
            State::Materialise(materialiser) => match materialiser.step(rules, score, builder, limits, meter) {
                Outcome::Paused => None,
                Outcome::Ended(root) => {
                    *symbols = Some(materialiser.symbols());
                    Some(made(root, vec![]))
                }
                Outcome::Passed(name) => {
                    *builder = Builder::within(limits.memory);
                    Some(State::Search(Search::new(name, *n, *seed)))
                }
            },
            State::Parametric(memo) => match memo.step((turtle, score), builder, limits, meter) {
                parametric::Outcome::Paused => None,
                parametric::Outcome::Ended(root, count) => {
                    *symbols = u64::try_from(count).ok();
                    Some(made(root, vec![]))
                }
                parametric::Outcome::TooMany(largest) => {
                    (*memoises, *memoised) = (false, largest);
                    Some(whole(rules, *seed, limits, score))
                }
                parametric::Outcome::Failed(diagnostic) => Some(State::Failed(diagnostic)),
            },
            State::Modules(modular) => match modular.step((turtle, score), builder, limits, *n, meter) {
                modules::Outcome::Paused => None,
                modules::Outcome::Ended(root) => {
                    *symbols = Some(modular.symbols());
                    Some(made(root, vec![]))
                }
                modules::Outcome::Failed(mut diagnostic) => {
                    if let Kind::Limit { largest, .. } = &mut diagnostic.kind {
                        *largest = (*largest).max(*memoised);
                    }
                    Some(State::Failed(diagnostic))
                }
            },
            State::Search(search) => {
                let exceeded = search.step(rules, score, limits, *seed, meter)?;
                Some(failed(&exceeded, limits))
            }
            State::Survey { survey, root, pieces } => {
                let extent = S::advance(survey, builder.contents(), meter)?;
                Some(State::Done { root: Some(*root), pieces: core::mem::take(pieces), extent: Some(extent) })
            }
            State::Plan(_) | State::Build { .. } | State::Done { .. } | State::Failed(_) => None,
        }
    }
}

/// What comes when all blocks are made.
fn made<S: Space>(root: Option<BlockId>, pieces: Vec<Level<S>>) -> State<S> {
    match root {
        None => State::Done { root, pieces, extent: None },
        Some(root) => State::Survey { survey: Box::new(S::survey(root)), root, pieces },
    }
}

/// Modules with parameters, whose pieces are shared.
fn planned<S: Space>(rules: &Arc<Rules>, with: (&Turtle, &Score<S>), seed: u32, limits: &Limits, n: u32) -> State<S> {
    match Parametric::new(rules, with, seed, limits, n) {
        Ok(parametric) => State::Parametric(Box::new(parametric)),
        Err(diagnostic) => State::Failed(diagnostic),
    }
}

/// Whole generations.
fn whole<S: Space>(rules: &Arc<Rules>, seed: u32, limits: &Limits, score: &Score<S>) -> State<S> {
    match Modular::new(rules, seed, limits, score) {
        Ok(modular) => State::Modules(Box::new(modular)),
        Err(diagnostic) => State::Failed(diagnostic),
    }
}

fn failed<S: Space>(exceeded: &Exceeded, limits: &Limits) -> State<S> {
    State::Failed(Diagnostic::limit(exceeded.limit, limits.value(exceeded.limit), exceeded.largest))
}
