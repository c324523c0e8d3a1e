//! Drawing letter by letter, where no two pieces need be alike.

use super::builder::Builder;
use super::tree::Tree;
use super::{BlockId, StyleChange};
use crate::space::Space;
use crate::turtle::{Op, Pen, Score};
use crate::walk::{Next, Walk};
use crate::{LimitName, Limits, Program};

/// What an open branch costs in units of work: its turtle's state takes the memory of as many letters.
pub(super) const BRANCH: u64 = 32;

/// What a derivation has cost so far.
#[derive(Clone, Debug)]
pub(crate) struct Census {
    walk: Walk,
    symbols: u64,
    segments: u64,
    /// Branches open now, and at most so far.
    open: u64,
    deepest: u64,
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
        Self { walk: Walk::new(n, seed), symbols: 0, segments: 0, open: 0, deepest: 0 }
    }

    pub(crate) fn fraction(&self, program: &Program) -> f64 {
        self.walk.fraction(program)
    }

    /// Goes on for `left` letters, handing the actions of each of the last generation to `act`.
    pub(crate) fn step<S: Space>(
        &mut self,
        program: &Program,
        score: &Score<S>,
        limits: &Limits,
        left: &mut u64,
        mut act: impl FnMut(&[Op<S>]),
    ) -> Outcome<()> {
        let began = self.walk.work;
        let until = began.saturating_add(*left).min(limits.work);
        let outcome = loop {
            match self.walk.next(program, |_| false, until) {
                Next::Letter(symbol, _) => {
                    let ops = &score.ops[usize::from(symbol)];
                    self.symbols += 1;
                    self.count(ops);
                    if self.segments > limits.segments {
                        break Outcome::Passed(LimitName::Segments);
                    }
                    act(ops);
                }
                Next::End => break Outcome::Ended(()),
                Next::Pause if self.walk.work >= limits.work => break Outcome::Passed(LimitName::Work),
                Next::Pause => break Outcome::Paused,
            }
        };
        *left = left.saturating_sub((self.walk.work - began).max(1));
        outcome
    }

    fn count<S: Space>(&mut self, ops: &[Op<S>]) {
        for op in ops {
            match op {
                Op::Draw(_) => self.segments += 1,
                Op::Push => {
                    self.open += 1;
                    if self.open > self.deepest {
                        self.deepest = self.open;
                        self.walk.work += BRANCH;
                    }
                }
                Op::Pop => self.open = self.open.saturating_sub(1),
                Op::Move(_) | Op::Turn(_) | Op::Upright | Op::Bend(_) | Op::Style(_) => {}
            }
        }
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
}

impl<S: Space> Materialiser<S> {
    pub(crate) fn new(heading: S::Turn, score: &Score<S>, seed: u32, n: u32) -> Self {
        Self {
            census: Census::new(n, seed),
            pen: Pen { at: S::Point::default(), heading, style: StyleChange::start(score.width) },
            saved: vec![],
            tree: Tree::new(score.exponent),
            directions: S::directions(),
        }
    }

    pub(crate) fn fraction(&self, program: &Program) -> f64 {
        self.census.fraction(program)
    }

    /// The symbols met so far.
    pub(crate) fn symbols(&self) -> u64 {
        self.census.symbols
    }

    /// Goes on for `left` letters.
    pub(crate) fn step(
        &mut self,
        program: &Program,
        score: &Score<S>,
        builder: &mut Builder<S>,
        limits: &Limits,
        left: &mut u64,
    ) -> Outcome<Option<BlockId>> {
        let Self { census, pen, saved, tree, directions } = self;
        let outcome = census.step(program, score, limits, left, |ops| {
            pen.act(ops, saved, 1.0, directions, |from, to, style| tree.push(builder, from, to, style));
        });
        match outcome {
            Outcome::Paused => Outcome::Paused,
            Outcome::Passed(limit) => Outcome::Passed(limit),
            Outcome::Ended(()) => Outcome::Ended(tree.finish(builder)),
        }
    }
}
