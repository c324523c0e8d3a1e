//! The turtle: what each letter of a program does, and from where it starts.

use crate::drawing::{StyleChange, WidthChange};
pub(crate) use crate::plane::Directions;
use crate::space::{Axis, Space};
use crate::{Action, ColourChange, Heading, Plane};

/// A turtle ready to read a program's words.
#[derive(Clone, Debug, PartialEq)]
pub struct Turtle {
    /// By letter ([`SymbolId`](crate::SymbolId)): what it does.
    pub actions: Vec<Vec<Action>>,
    /// Of a left turn.
    pub left: Heading,
    /// Of a right turn, clockwise.
    pub right: Heading,
    /// Of pitching down, the heading away from the turtle's up.
    pub pitch_down: Heading,
    /// Of pitching up.
    pub pitch_up: Heading,
    /// Of rolling left: by the right-hand rule about the heading, which lifts the turtle's left.
    pub roll_left: Heading,
    /// Of rolling right.
    pub roll_right: Heading,
    /// What bends the turtle's heading after each segment.
    pub tropism: Option<Tropism>,
    /// At the start.
    pub heading: Heading,
    /// Where it starts, in model units.
    pub start: [f64; 2],
    /// The step length, in model units.
    pub step: f64,
    /// The stroke width at the start, in multiples of the step length.
    pub width: f64,
}

/// A pull upon the turtle's heading (ABOP, section 2.1): after each segment the heading H turns towards the vector T by
/// `elasticity * |H x T|` radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tropism {
    /// T, in the directions of the model: x to the right, y up, z towards the viewer.
    pub vector: [f64; 3],
    /// How easily branches bend.
    pub elasticity: f64,
}

/// An action with every default filled in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Op<S: Space = Plane> {
    /// Go forward and draw; in units of [`Score::unit`].
    Draw(f64),
    /// Go forward without drawing; in the same units.
    Move(f64),
    Turn(S::Turn),
    /// Roll until the turtle's left is level.
    Upright,
    /// Turn as a tropism wants.
    Bend(Tropism),
    Push,
    Pop,
    Style(StyleChange),
}

/// A turtle's actions made ready to run, in units that keep every length at most 1.
#[derive(Clone, Debug)]
pub(crate) struct Score<S: Space = Plane> {
    /// By letter; empty for letters that are out of reach.
    pub(crate) ops: Vec<Vec<Op<S>>>,
    /// A length of 1 is `2^exponent` steps.
    pub(crate) exponent: i32,
    /// One step in model units; 1 where the turtle's own step is zero, which the lengths then say.
    pub(crate) step: f64,
    /// The width at the start, in multiples of `step`.
    pub(crate) width: f64,
}

impl Default for Turtle {
    /// One that heads up from the origin, with steps of length 1, angles of 0, and no letters.
    fn default() -> Self {
        Self {
            actions: vec![],
            left: Heading::EAST,
            right: Heading::EAST,
            pitch_down: Heading::EAST,
            pitch_up: Heading::EAST,
            roll_left: Heading::EAST,
            roll_right: Heading::EAST,
            tropism: None,
            heading: Heading::UP,
            start: [0.0; 2],
            step: 1.0,
            width: 0.0,
        }
    }
}

impl Turtle {
    /// The actions of the `reachable` letters.
    pub(crate) fn score<S: Space>(&self, reachable: &[bool]) -> Score<S> {
        let mut ops: Vec<Vec<Op<S>>> = (self.actions.iter().zip(reachable))
            .map(|(actions, &reached)| if reached { self.ops(actions) } else { vec![] })
            .collect();
        let length = |op: &Op<S>| if let Op::Draw(l) | Op::Move(l) = op { l.abs() } else { 0.0 };
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

    /// What a letter does, lengths in steps.
    fn ops<S: Space>(&self, actions: &[Action]) -> Vec<Op<S>> {
        let mut ops = Vec::with_capacity(actions.len());
        for &action in actions {
            ops.push(self.op(action));
            if let (Action::Draw(_), Some(tropism)) = (action, self.tropism) {
                ops.push(Op::Bend(tropism));
            }
        }
        ops
    }

    /// An action, lengths in steps.
    fn op<S: Space>(&self, action: Action) -> Op<S> {
        let turn = |about: Axis, degrees: Option<f64>, own: Heading| {
            Op::Turn(S::turn(about, degrees.map_or(own, Heading::from_degrees)))
        };
        let back = |about: Axis, degrees: Option<f64>, own: Heading| {
            Op::Turn(S::turn(about, -degrees.map_or(own, Heading::from_degrees)))
        };
        let in_steps = |length: Option<f64>| length.map_or(self.steps(), |l| finite(l / self.unit()));
        match action {
            Action::Draw(length) => Op::Draw(in_steps(length)),
            Action::Move(length) => Op::Move(in_steps(length)),
            Action::TurnLeft(degrees) => turn(Axis::Up, degrees, self.left),
            Action::TurnRight(degrees) => back(Axis::Up, degrees, self.right),
            Action::PitchDown(degrees) => turn(Axis::Left, degrees, self.pitch_down),
            Action::PitchUp(degrees) => back(Axis::Left, degrees, self.pitch_up),
            Action::RollLeft(degrees) => turn(Axis::Ahead, degrees, self.roll_left),
            Action::RollRight(degrees) => back(Axis::Ahead, degrees, self.roll_right),
            Action::RollUpright => Op::Upright,
            Action::TurnRound => Op::Turn(S::turn(Axis::Up, Heading::HALF)),
            Action::Push => Op::Push,
            Action::Pop => Op::Pop,
            // It acts when the word is derived.
            Action::Cut => Op::Turn(S::AHEAD),
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

impl<S: Space> Score<S> {
    /// Whether a letter goes anywhere.
    pub(crate) fn goes(&self, letter: crate::SymbolId) -> bool {
        self.ops[usize::from(letter)].iter().any(|op| matches!(op, Op::Draw(_) | Op::Move(_)))
    }

    /// What a letter does; with the `number` of a module's first argument in the place of its first action's.
    pub(crate) fn ops_of(&self, turtle: &Turtle, letter: usize, number: Option<f64>) -> impl Iterator<Item = Op<S>> {
        self.ops[letter].iter().enumerate().map(move |(index, &op)| match number {
            Some(number) if index == 0 => self.op(turtle, turtle.actions[letter][0].with(number)),
            _ => op,
        })
    }

    /// A further action of the turtle that this is the score of; its length may be above 1.
    pub(crate) fn op(&self, turtle: &Turtle, action: Action) -> Op<S> {
        turtle.op(action).scaled(-self.exponent)
    }
}

impl<S: Space> Op<S> {
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
pub(crate) struct Pen<S: Space = Plane> {
    pub(crate) at: S::Point,
    pub(crate) heading: S::Turn,
    pub(crate) style: StyleChange,
}

impl<S: Space> Pen<S> {
    /// Acts, with `saved` as the stack of open branches and lengths times `scale`; hands each segment to `draw`.
    /// A `Pop` without a branch to return from does nothing.
    pub(crate) fn act(
        &mut self,
        ops: &[Op<S>],
        saved: &mut Vec<Self>,
        scale: f64,
        directions: &mut S::Directions,
        mut draw: impl FnMut(S::Point, S::Point, &StyleChange),
    ) {
        for &op in ops {
            match op {
                Op::Draw(length) => {
                    let from = self.at;
                    self.forward(length * scale, directions);
                    draw(from, self.at, &self.style);
                }
                Op::Move(length) => self.forward(length * scale, directions),
                Op::Turn(by) => self.heading = S::then(self.heading, by),
                Op::Upright => self.heading = S::upright(self.heading),
                Op::Bend(tropism) => self.heading = S::bent(self.heading, &tropism),
                Op::Push => {
                    saved.push(*self);
                    self.style.level = self.style.level.saturating_add(1);
                }
                Op::Pop => *self = saved.pop().unwrap_or(*self),
                Op::Style(change) => self.style = self.style.then(&change),
            }
        }
    }

    fn forward(&mut self, length: f64, directions: &mut S::Directions) {
        self.at = S::ahead(&S::axes(directions, self.heading), self.at, length);
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
