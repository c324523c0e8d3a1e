//! Drawing module by module, without shared pieces. Plain letters are derived depth-first, one at a time. Rules with
//! contexts or parameters are derived by whole generations.

mod asking;
mod counts;
mod generations;
mod letters;
mod limits;

pub(crate) use self::asking::TurtleInterpreter;
use self::generations::Generations;
use self::letters::{LetterUnfolding, WalkOutcome};
use self::limits::{Exceeded, Forecast, IterationSearch};
use super::block::Space;
use super::builder::Builder;
use super::pieces::Pieces;
use super::task::{Made, Outcome, Task};
use lsystem_base::{LimitName, Meter};
use lsystem_syntax::{Diagnostic, Kind};

/// A drawing in the making.
#[derive(Clone, Debug)]
pub(crate) struct Unfold<S: Space> {
    stage: Stage<S>,
    /// The largest n that sharing could draw within the limits, if sharing was tried.
    shared: Option<u32>,
}

#[derive(Clone, Debug)]
enum Stage<S: Space> {
    /// Check the limits by counting.
    Forecast(Forecast),
    /// Derive and draw letter by letter.
    Letters(Box<LetterUnfolding<S>>),
    /// After a limit was exceeded: find the largest n within the limits.
    Search(IterationSearch),
    /// Derive whole generations, and draw the last.
    Generations(Box<Generations<S>>),
}

impl<S: Space> Unfold<S> {
    /// Prepares to draw from the axiom on. `shared` is the largest n that sharing could draw, if sharing was tried.
    pub(super) fn new(task: &Task<S>, shared: Option<u32>) -> Result<Self, Diagnostic> {
        let stage = if !task.rules.is_plain() {
            Stage::Generations(Box::new(Generations::new(task)?))
        } else if task.rules.is_deterministic() {
            Stage::Forecast(Forecast::new(&task.score))
        } else {
            Stage::Letters(Box::new(LetterUnfolding::new(task)))
        };
        Ok(Self { stage, shared })
    }

    /// The bytes that the work occupies, without the builder.
    pub(super) fn bytes(&self) -> u64 {
        match &self.stage {
            Stage::Letters(letters) => letters.bytes(),
            Stage::Generations(generations) => generations.bytes(),
            Stage::Forecast(_) | Stage::Search(_) => 0,
        }
    }

    /// After memory ran out: begins the search for the largest n that fits. Returns false if this stage has no search.
    pub(super) fn begin_search(&mut self, task: &Task<S>) -> bool {
        let draws = matches!(self.stage, Stage::Letters(_));
        if draws {
            self.stage = Stage::Search(IterationSearch::new(LimitName::Memory, task.n, task.seed));
        }
        draws
    }

    /// Continues until the meter is spent or a stage is over.
    pub(super) fn step(&mut self, task: &Task<S>, builder: &mut Builder<S>, meter: &mut Meter) -> Outcome<Made<S>> {
        let made = |root, symbols| Outcome::Ended(Made { root, pieces: Pieces::None, symbols: Some(symbols) });
        let failed =
            |Exceeded { limit, largest }| Outcome::Failed(Diagnostic::limit(limit, task.limits.value(limit), largest));
        match &mut self.stage {
            Stage::Forecast(forecast) => match forecast.step(&task.rules, &task.limits, task.n, meter) {
                None => {}
                Some(Err(exceeded)) => return failed(exceeded),
                Some(Ok(())) => self.stage = Stage::Letters(Box::new(LetterUnfolding::new(task))),
            },
            Stage::Letters(letters) => match letters.step(task, builder, meter) {
                WalkOutcome::Paused => {}
                WalkOutcome::Ended(root) => return made(root, letters.symbols()),
                WalkOutcome::Passed(limit) => {
                    *builder = Builder::within(task.limits.memory);
                    self.stage = Stage::Search(IterationSearch::new(limit, task.n, task.seed));
                }
            },
            Stage::Search(search) => {
                if let Some(exceeded) = search.step(&task.rules, &task.score, &task.limits, task.seed, meter) {
                    return failed(exceeded);
                }
            }
            Stage::Generations(generations) => match generations.step(task, builder, meter) {
                Outcome::Ended(root) => return made(root, generations.symbols()),
                Outcome::Failed(diagnostic) => {
                    return Outcome::Failed(match diagnostic.kind {
                        Kind::Limit { limit, value, largest } => {
                            Diagnostic::limit(limit, value, largest.max(self.shared))
                        }
                        _ => diagnostic,
                    });
                }
                Outcome::Paused | Outcome::NotShareable(_) => {}
            },
        }
        Outcome::Paused
    }
}
