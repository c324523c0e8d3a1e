//! The turtle: what each letter of a program does, and from where it starts.

use crate::drawing::{StyleChange, WidthChange};
use crate::{Action, ColourChange, Heading};

/// A turtle ready to read a program's words.
#[derive(Clone, Debug, PartialEq)]
pub struct Turtle {
    /// By letter ([`SymbolId`](crate::SymbolId)): what it does.
    pub actions: Vec<Vec<Action>>,
    /// Of a left turn.
    pub left: Heading,
    /// Of a right turn, clockwise.
    pub right: Heading,
    /// At the start.
    pub heading: Heading,
    /// Where it starts, in model units.
    pub start: [f64; 2],
    /// The step length, in model units.
    pub step: f64,
    /// The stroke width at the start, in multiples of the step length.
    pub width: f64,
}

/// An action with every default filled in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Op {
    /// Go forward and draw; in units of [`Score::unit`].
    Draw(f64),
    /// Go forward without drawing; in the same units.
    Move(f64),
    Turn(Heading),
    Push,
    Pop,
    Style(StyleChange),
}

/// A turtle's actions made ready to run, in units that keep every length at most 1.
#[derive(Clone, Debug)]
pub(crate) struct Score {
    /// By letter; empty for letters that are out of reach.
    pub(crate) ops: Vec<Vec<Op>>,
    /// A length of 1 is `2^exponent` steps.
    pub(crate) exponent: i32,
    /// One step in model units; 1 where the turtle's own step is zero, which the lengths then say.
    pub(crate) step: f64,
    /// The width at the start, in multiples of `step`.
    pub(crate) width: f64,
}

impl Turtle {
    /// The actions of the `reachable` letters.
    pub(crate) fn score(&self, reachable: &[bool]) -> Score {
        let mut ops: Vec<Vec<Op>> = (self.actions.iter().zip(reachable))
            .map(|(actions, &reached)| if reached { actions.iter().map(|&a| self.op(a)).collect() } else { vec![] })
            .collect();
        let length = |op: &Op| if let Op::Draw(l) | Op::Move(l) = op { l.abs() } else { 0.0 };
        let exponent = exponent_of(ops.iter().flatten().map(length).fold(0.0, f64::max));
        for op in ops.iter_mut().flatten() {
            *op = op.scaled(-exponent);
        }
        Score { ops, exponent, step: self.unit(), width: finite(self.width).max(0.0) * self.steps() }
    }

    /// 1 where a step has a length, 0 otherwise.
    fn steps(&self) -> f64 {
        if self.step == 0.0 || !self.step.is_finite() { 0.0 } else { 1.0 }
    }

    /// The step length; 1 where it is zero.
    fn unit(&self) -> f64 {
        if self.steps() == 0.0 { 1.0 } else { self.step }
    }

    /// An action, lengths in steps.
    fn op(&self, action: Action) -> Op {
        let in_steps = |length: Option<f64>| length.map_or(self.steps(), |l| finite(l / self.unit()));
        match action {
            Action::Draw(length) => Op::Draw(in_steps(length)),
            Action::Move(length) => Op::Move(in_steps(length)),
            Action::TurnLeft(degrees) => Op::Turn(degrees.map_or(self.left, Heading::from_degrees)),
            Action::TurnRight(degrees) => Op::Turn(-degrees.map_or(self.right, Heading::from_degrees)),
            Action::TurnRound => Op::Turn(Heading::HALF),
            Action::Push => Op::Push,
            Action::Pop => Op::Pop,
            // It acts when the word is derived.
            Action::Cut => Op::Turn(Heading::EAST),
            Action::SetColour(index) => Op::Style(ColourChange::Set(index).into()),
            Action::AddColour(by) => Op::Style(ColourChange::Add(by).into()),
            Action::SetWidth(width) => {
                Op::Style(WidthChange { factor: 0.0, offset: finite(width).max(0.0) * self.steps() }.into())
            }
            Action::ScaleWidth(factor) => {
                Op::Style(WidthChange { factor: finite(factor).max(0.0), offset: 0.0 }.into())
            }
        }
    }
}

impl Score {
    /// A further action of the turtle that this is the score of; its length may be above 1.
    pub(crate) fn op(&self, turtle: &Turtle, action: Action) -> Op {
        turtle.op(action).scaled(-self.exponent)
    }
}

impl Op {
    /// The same with lengths times `2^exponent`.
    fn scaled(self, exponent: i32) -> Self {
        match self {
            Self::Draw(length) => Self::Draw(finite(libm::scalbn(length, exponent))),
            Self::Move(length) => Self::Move(finite(libm::scalbn(length, exponent))),
            other => other,
        }
    }
}

/// Where the turtle is and how it draws.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen {
    pub(crate) at: [f64; 2],
    pub(crate) heading: Heading,
    pub(crate) style: StyleChange,
}

impl Pen {
    /// Acts, with `saved` as the stack of open branches and lengths times `scale`; hands each segment to `draw`.
    /// A `Pop` without a branch to return from does nothing.
    pub(crate) fn act(
        &mut self,
        ops: &[Op],
        saved: &mut Vec<Self>,
        scale: f64,
        directions: &mut Directions,
        mut draw: impl FnMut([f64; 2], [f64; 2], &StyleChange),
    ) {
        for &op in ops {
            match op {
                Op::Draw(length) => {
                    let from = self.at;
                    self.forward(length * scale, directions);
                    draw(from, self.at, &self.style);
                }
                Op::Move(length) => self.forward(length * scale, directions),
                Op::Turn(by) => self.heading += by,
                Op::Push => {
                    saved.push(*self);
                    self.style.level = self.style.level.saturating_add(1);
                }
                Op::Pop => *self = saved.pop().unwrap_or(*self),
                Op::Style(change) => self.style = self.style.then(&change),
            }
        }
    }

    fn forward(&mut self, length: f64, directions: &mut Directions) {
        let (c, s) = directions.cos_sin(self.heading);
        self.at = [self.at[0] + length * c, self.at[1] + length * s];
    }
}

/// Cosines and sines of the headings met last: a turtle has few, and meets them again at once.
#[derive(Clone, Debug)]
pub(crate) struct Directions {
    slots: Vec<(Heading, f64, f64)>,
}

impl Directions {
    /// Enough for all multiples of most angles.
    const BITS: u32 = 9;

    pub(crate) fn new() -> Self {
        Self { slots: vec![(Heading::EAST, 1.0, 0.0); 1 << Self::BITS] }
    }

    pub(crate) fn cos_sin(&mut self, heading: Heading) -> (f64, f64) {
        let hash = heading.units().wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - Self::BITS);
        let slot = &mut self.slots[hash as usize];
        if slot.0 != heading {
            let (c, s) = heading.cos_sin();
            *slot = (heading, c, s);
        }
        (slot.1, slot.2)
    }
}

/// The least `e` with `size < 2^e`; 0 for zero.
pub(crate) fn exponent_of(size: f64) -> i32 {
    libm::frexp(size).1
}

/// `value`, or the nearest finite number; 0 where there is none.
pub(crate) fn finite(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value.clamp(-f64::MAX, f64::MAX) }
}
