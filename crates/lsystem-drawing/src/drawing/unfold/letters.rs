//! Drawing letter by letter, without shared pieces.

use super::counts::DrawingCounts;
use crate::drawing::block::{BlockId, Item, Space};
use crate::drawing::builder::Builder;
use crate::drawing::task::Task;
use crate::drawing::tree::Tree;
use crate::room::bytes_of;
use crate::turtle::{Pen, Score, TurtleOp, work_of};
use lsystem_base::{LimitName, Limits, Meter};
use lsystem_derive::{DepthFirst, LetterId, Next, Rules};

/// A walk through the last generation that counts symbols and segments.
#[derive(Clone, Debug)]
pub(crate) struct Census {
    walk: DepthFirst,
    symbols: u64,
    counts: DrawingCounts,
}

/// The outcome of a step of a walk.
pub(super) enum WalkOutcome<T> {
    /// The budget is spent; there is more to do.
    Paused,
    /// The walk is at the end.
    Ended(T),
    /// The walk has exceeded a limit.
    Passed(LimitName),
}

impl Census {
    pub(super) fn new(n: u32, seed: u32) -> Self {
        Self { walk: DepthFirst::new(n, seed), symbols: 0, counts: DrawingCounts::default() }
    }

    /// Continues until the meter is spent. Hands the place and the operations of each letter of the last generation to
    /// `act`. `act` returns the units of work, or `None` to pause.
    pub(super) fn step<S: Space>(
        &mut self,
        rules: &Rules,
        score: &Score<S>,
        limits: &Limits,
        meter: &mut Meter,
        mut act: impl FnMut(&DepthFirst, (u64, LetterId), &[TurtleOp<S>]) -> Option<u64>,
    ) -> WalkOutcome<()> {
        let began = self.walk.work;
        let mut acted = 0_u64;
        let outcome = loop {
            let until = began.saturating_add(meter.left().saturating_sub(acted)).min(limits.work);
            match self.walk.next(rules, |_| false, until) {
                Next::Letter(symbol, _) => {
                    let ops = &score.ops[usize::from(symbol)];
                    let place = self.symbols;
                    self.symbols += 1;
                    let before = self.counts.work();
                    ops.iter().for_each(|op| self.counts.add(op));
                    self.walk.work += self.counts.work() - before;
                    if self.counts.segments > limits.segments {
                        break WalkOutcome::Passed(LimitName::Segments);
                    }
                    if self.counts.segments.saturating_mul(size_of::<Item<S>>() as u64) > limits.memory {
                        break WalkOutcome::Passed(LimitName::Memory);
                    }
                    match act(&self.walk, (place, symbol), ops) {
                        Some(work) => acted += work,
                        None => break WalkOutcome::Paused,
                    }
                }
                Next::End => break WalkOutcome::Ended(()),
                Next::Pause if self.walk.work >= limits.work => break WalkOutcome::Passed(LimitName::Work),
                Next::Pause => break WalkOutcome::Paused,
            }
        };
        meter.charge((self.walk.work - began).max(1) + acted);
        outcome
    }
}

/// A tree of blocks in the making.
#[derive(Clone, Debug)]
pub(crate) struct LetterUnfolding<S: Space> {
    census: Census,
    pen: Pen<S>,
    saved: Vec<Pen<S>>,
    tree: Tree<S>,
    seed: u32,
    /// A cache for the last successor (predecessor, address, length): the index of the letter that continues the
    /// predecessor.
    continuation: Option<((LetterId, usize, usize), Option<usize>)>,
    /// A reusable buffer for the operations of one module.
    own: Vec<TurtleOp<S>>,
}

impl<S: Space> LetterUnfolding<S> {
    pub(super) fn new(Task { turtle, score, seed, n, .. }: &Task<S>) -> Self {
        Self {
            census: Census::new(*n, *seed),
            pen: Pen::start(turtle, score),
            saved: vec![],
            tree: Tree::new(score.exponent, score.tapers),
            seed: *seed,
            continuation: None,
            own: vec![],
        }
    }

    /// The number of symbols read so far.
    pub(super) fn symbols(&self) -> u64 {
        self.census.symbols
    }

    /// The bytes that the work occupies, without the builder.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.saved) + self.tree.bytes()
    }

    /// Continues until the meter is spent.
    pub(super) fn step(
        &mut self,
        Task { rules, score, limits, .. }: &Task<S>,
        builder: &mut Builder<S>,
        meter: &mut Meter,
    ) -> WalkOutcome<Option<BlockId>> {
        let Self { census, pen, saved, tree, seed, continuation, own } = self;
        let outcome = census.step(rules, score, limits, meter, |walk, (place, symbol), ops| {
            let mut ops = ops;
            if score.differs_by_module() {
                let fate = walk.fate(rules, symbol, |former, successor| {
                    let word = (former, successor.as_ptr().addr(), successor.len());
                    match continuation {
                        Some((of, at)) if *of == word => *at,
                        _ => continuation.insert((word, score.continuation(former, successor))).1,
                    }
                });
                score.own(ops, &fate, *seed, own);
                ops = own;
            }
            tree.draw(builder, place, |paper, directions| pen.act(ops, saved, 1.0, directions, paper));
            let is_full = builder.is_full || builder.bytes() + bytes_of(saved) + tree.bytes() > limits.memory;
            (!is_full).then(|| work_of(ops) + builder.take_work())
        });
        let outcome = match outcome {
            WalkOutcome::Paused => WalkOutcome::Paused,
            WalkOutcome::Passed(limit) => WalkOutcome::Passed(limit),
            WalkOutcome::Ended(()) => {
                tree.end(builder, true);
                tree.finish_one(builder).map_or(WalkOutcome::Paused, WalkOutcome::Ended)
            }
        };
        meter.charge(builder.take_work());
        outcome
    }
}
