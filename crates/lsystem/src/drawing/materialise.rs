//! Drawing letter by letter, where no two pieces need be alike.

use super::builder::Builder;
use super::tally::Tally;
use super::tree::Tree;
use super::{BlockId, StyleChange};
use crate::space::Space;
use crate::turtle::{Op, Pen, Score};
use crate::walk::{Next, Walk};
use crate::{LimitName, Limits, Meter, Program, SymbolId};

/// What a derivation has cost so far.
#[derive(Clone, Debug)]
pub(crate) struct Census {
    walk: Walk,
    symbols: u64,
    tally: Tally,
}

/// What came of working on.
pub(crate) enum Outcome<T> {
    /// The work allowed is done; there is more.
    Paused,
    /// The whole derivation has been gone through.
    Ended(T),
    /// One segment or letter more would pass a limit.
    Passed(LimitName),
}

impl Census {
    pub(crate) fn new(n: u32, seed: u32) -> Self {
        Self { walk: Walk::new(n, seed), symbols: 0, tally: Tally::default() }
    }

    /// Goes on for as many letters as the meter allows, handing the actions of each of the last generation to `act`, with its place there.
    pub(crate) fn step<S: Space>(
        &mut self,
        program: &Program,
        score: &Score<S>,
        limits: &Limits,
        meter: &mut Meter,
        mut act: impl FnMut(&Walk, (u64, SymbolId), &[Op<S>]),
    ) -> Outcome<()> {
        let began = self.walk.work;
        let until = began.saturating_add(meter.left()).min(limits.work);
        let outcome = loop {
            match self.walk.next(program, |_| false, until) {
                Next::Letter(symbol, _) => {
                    let ops = &score.ops[usize::from(symbol)];
                    let place = self.symbols;
                    self.symbols += 1;
                    let before = self.tally.work();
                    ops.iter().for_each(|op| self.tally.add(op));
                    self.walk.work += self.tally.work() - before;
                    if self.tally.segments > limits.segments {
                        break Outcome::Passed(LimitName::Segments);
                    }
                    act(&self.walk, (place, symbol), ops);
                }
                Next::End => break Outcome::Ended(()),
                Next::Pause if self.walk.work >= limits.work => break Outcome::Passed(LimitName::Work),
                Next::Pause => break Outcome::Paused,
            }
        };
        meter.charge((self.walk.work - began).max(1));
        outcome
    }
}

/// A tree of blocks in the making.
#[derive(Clone, Debug)]
pub(crate) struct Materialiser<S: Space> {
    census: Census,
    pen: Pen<S>,
    saved: Vec<Pen<S>>,
    tree: Tree<S>,
    directions: S::Directions,
    seed: u32,
    /// What a module does that is not like the others of its letter.
    own: Vec<Op<S>>,
}

impl<S: Space> Materialiser<S> {
    pub(crate) fn new(heading: S::Turn, score: &Score<S>, seed: u32, n: u32) -> Self {
        Self {
            census: Census::new(n, seed),
            pen: Pen::new(heading, StyleChange::start(score.width)),
            saved: vec![],
            tree: Tree::new(score.exponent),
            directions: S::directions(),
            seed,
            own: vec![],
        }
    }

    /// The symbols met so far.
    pub(crate) fn symbols(&self) -> u64 {
        self.census.symbols
    }

    /// Goes on for as many letters as the meter allows.
    pub(crate) fn step(
        &mut self,
        program: &Program,
        score: &Score<S>,
        builder: &mut Builder<S>,
        limits: &Limits,
        meter: &mut Meter,
    ) -> Outcome<Option<BlockId>> {
        let Self { census, pen, saved, tree, directions, seed, own } = self;
        let outcome = census.step(program, score, limits, meter, |walk, (place, symbol), ops| {
            let mut ops = ops;
            if score.is_personal() {
                let fate = walk.fate(program, symbol, |former, successor| score.heir(former, successor));
                score.own(ops, &fate, *seed, own);
                ops = own;
            }
            tree.draw(builder, place, |desk| pen.act(ops, saved, 1.0, directions, desk));
        });
        match outcome {
            Outcome::Paused => Outcome::Paused,
            Outcome::Passed(limit) => Outcome::Passed(limit),
            Outcome::Ended(()) => Outcome::Ended(tree.finish(builder)),
        }
    }
}
