//! The turtle: what each letter of a rules does, and from where it starts.

use crate::Plane;
use crate::room::reserve;
use crate::rotation::Axis;
use crate::space::{Geometry, Tropism, exponent_of, finite};
use crate::style::{ColourChange, StyleChange, WidthChange};
use lsystem_derive::{Fate, LetterId, Purpose, Rule, Rules};
use lsystem_syntax::{Action, Heading};

/// A turtle ready to read a rules's words.
#[derive(Clone, Debug, PartialEq)]
pub struct Turtle {
    /// By letter ([`LetterId`](lsystem_derive::LetterId)): what it does.
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
    /// What a branch multiplies the stroke width by.
    pub width_factor: f64,
    /// What a branch multiplies all lengths by.
    pub length_factor: f64,
    /// What its colour index follows.
    pub colouring: Colouring,
    /// By how much turns differ from what they should be, at most, as a part of them.
    pub angle_variation: f64,
    /// By how much lengths differ from what they should be, at most, as a part of them.
    pub length_variation: f64,
    /// How far the modules that the last derivation step made have grown, from 0 to 1: turns and lengths are this part of
    /// what they will be. Where a module's successor holds its own letter, the first of them goes on in its place, fully
    /// grown; otherwise, if it draws, the first that draws.
    pub growth: f64,
}

/// What the turtle's colour index follows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colouring {
    /// The colour symbols.
    #[default]
    Symbols,
    /// The turns: the index after a turn to the left, and after one to the right.
    Turns([i32; 2]),
    /// The derivation steps: the index is the one in which a module was made. A module of its predecessor's letter goes
    /// on in its place and is as old.
    Generations,
}

/// An action with every default filled in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Op<S: Geometry = Plane> {
    /// Go forward and draw; in units of [`Score::unit`].
    Draw(f64),
    /// Go forward without drawing; in the same units.
    Move(f64),
    Turn(Turning<S>),
    /// Roll until the turtle's left is level.
    Upright,
    /// Turn as a tropism wants.
    Bend(Tropism),
    Push(Deeper),
    Pop,
    Style(StyleChange),
    OpenPolygon,
    Vertex,
    ClosePolygon,
}

/// A rotation about one of the turtle's own axes, also ready for use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning<S: Geometry> {
    pub turn: S::Turn,
    about: Axis,
    by: Heading,
    /// Whether it is against the right-hand rule: half a turn is the same either way, but not a part of it.
    back: bool,
}

/// What a branch multiplies widths and lengths by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Deeper {
    width: f64,
    length: f64,
}

/// A turtle's actions made ready to run, in units that keep every length at most 1.
#[derive(Clone, Debug)]
pub(crate) struct Score<S: Geometry = Plane> {
    /// By letter; empty for letters that are out of reach.
    pub ops: Vec<Vec<Op<S>>>,
    /// A length of 1 is `2^exponent` steps.
    pub exponent: i32,
    /// One step in model units; 1 where the turtle's own step is zero, which the lengths then say.
    pub step: f64,
    /// The width at the start, in multiples of `step`.
    pub width: f64,
    /// How far the youngest modules have grown.
    pub growth: f64,
    /// Of angles and of lengths.
    variations: [f64; 2],
    /// Whether the colour index is the generation.
    pub(crate) dated: bool,
    /// Of lengths, from branch to branch.
    pub(crate) shrinking: f64,
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
            width_factor: 1.0,
            length_factor: 1.0,
            colouring: Colouring::Symbols,
            angle_variation: 0.0,
            length_variation: 0.0,
            growth: 1.0,
        }
    }
}

impl Turtle {
    /// How it is turned at the start.
    pub(crate) fn start_turn<S: Geometry>(&self) -> S::Turn {
        S::turn(Axis::Up, self.heading)
    }

    /// The actions of the `reachable` letters.
    pub(crate) fn score<S: Geometry>(&self, reachable: &[bool]) -> Score<S> {
        let mut ops: Vec<Vec<Op<S>>> = (self.actions.iter().zip(reachable))
            .map(|(actions, &reached)| if reached { self.ops(actions) } else { vec![] })
            .collect();
        let length = |op: &Op<S>| if let Op::Draw(l) | Op::Move(l) = op { l.abs() } else { 0.0 };
        let exponent = exponent_of(ops.iter().flatten().map(length).fold(0.0, f64::max));
        for op in ops.iter_mut().flatten() {
            *op = op.scaled(-exponent);
        }
        Score {
            ops,
            exponent,
            step: self.unit(),
            width: finite(self.width).max(0.0) * self.steps(),
            growth: finite(self.growth).clamp(0.0, 1.0),
            variations: [self.angle_variation, self.length_variation].map(|part| finite(part).clamp(0.0, 1.0)),
            dated: self.colouring == Colouring::Generations,
            shrinking: self.deeper().length,
        }
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
    fn ops<S: Geometry>(&self, actions: &[Action]) -> Vec<Op<S>> {
        let mut ops = Vec::with_capacity(actions.len());
        let corners = self.actions.iter().flatten().any(|action| *action == Action::OpenPolygon);
        for &action in actions {
            let marks = corners && matches!(action, Action::Draw(_) | Action::Move(_));
            ops.extend(marks.then_some(Op::Vertex));
            ops.push(self.op(action));
            ops.extend(marks.then_some(Op::Vertex));
            if let Some(tropism) = self.tropism.filter(|_| action.draws()) {
                ops.push(Op::Bend(tropism));
            }
            let side = match (self.colouring, action) {
                (Colouring::Turns([left, _]), Action::TurnLeft(_)) => Some(left),
                (Colouring::Turns([_, right]), Action::TurnRight(_)) => Some(right),
                _ => None,
            };
            ops.extend(side.map(|index| Op::Style(ColourChange::Set(index).into())));
        }
        ops
    }

    fn deeper(&self) -> Deeper {
        let [width, length] = [self.width_factor, self.length_factor].map(|factor| finite(factor).max(0.0));
        Deeper { width, length }
    }

    /// An action, lengths in steps.
    fn op<S: Geometry>(&self, action: Action) -> Op<S> {
        let turn = |about: Axis, degrees: Option<f64>, own: Heading| {
            Op::Turn(Turning::new(about, degrees.map_or(own, Heading::from_degrees), false))
        };
        let back = |about: Axis, degrees: Option<f64>, own: Heading| {
            Op::Turn(Turning::new(about, degrees.map_or(own, Heading::from_degrees), true))
        };
        let in_steps = |length: Option<f64>| length.map_or(self.steps(), |l| finite(l / self.unit()));
        match action {
            Action::Draw(length) | Action::DrawUnmarked(length) => Op::Draw(in_steps(length)),
            Action::Move(length) | Action::MoveUnmarked(length) => Op::Move(in_steps(length)),
            Action::OpenPolygon => Op::OpenPolygon,
            Action::Vertex => Op::Vertex,
            Action::ClosePolygon => Op::ClosePolygon,
            Action::TurnLeft(degrees) => turn(Axis::Up, degrees, self.left),
            Action::TurnRight(degrees) => back(Axis::Up, degrees, self.right),
            Action::PitchDown(degrees) => turn(Axis::Left, degrees, self.pitch_down),
            Action::PitchUp(degrees) => back(Axis::Left, degrees, self.pitch_up),
            Action::RollLeft(degrees) => turn(Axis::Ahead, degrees, self.roll_left),
            Action::RollRight(degrees) => back(Axis::Ahead, degrees, self.roll_right),
            Action::RollUpright => Op::Upright,
            Action::TurnRound => Op::Turn(Turning::new(Axis::Up, Heading::HALF, false)),
            Action::Push => Op::Push(self.deeper()),
            Action::Pop => Op::Pop,
            // It acts when the word is derived.
            Action::Cut => Op::Style(StyleChange::NONE),
            Action::SetColour(_) | Action::AddColour(_) if self.colouring != Colouring::Symbols => {
                Op::Style(StyleChange::NONE)
            }
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

impl<S: Geometry> Score<S> {
    /// Whether a letter goes anywhere.
    pub(crate) fn goes(&self, letter: LetterId) -> bool {
        self.ops[usize::from(letter)].iter().any(|op| matches!(op, Op::Draw(_) | Op::Move(_)))
    }

    /// What a letter does; with the `number` of a module's first argument in the place of its first action's.
    pub(crate) fn ops_of(&self, turtle: &Turtle, letter: usize, number: Option<f64>) -> impl Iterator<Item = Op<S>> {
        let (ops, first) = (&self.ops[letter], turtle.actions[letter].first());
        // Beside polygons, a vertex comes before every draw and move.
        let leaves = matches!(first, Some(Action::Draw(_) | Action::Move(_))) && matches!(ops[..], [Op::Vertex, ..]);
        let numbered = number.zip(first).map(|(number, action)| (usize::from(leaves), action.with(number)));
        ops.iter().enumerate().map(move |(index, &op)| match numbered {
            Some((place, action)) if place == index => self.op(turtle, action),
            _ => op,
        })
    }

    /// A further action of the turtle that this is the score of; its length may be above 1.
    pub(crate) fn op(&self, turtle: &Turtle, action: Action) -> Op<S> {
        turtle.op(action).scaled(-self.exponent)
    }

    /// What a letter with a number does, by the turtle that this is the score of; lengths may be above 1.
    pub(crate) fn numbered(&self, turtle: &Turtle, actions: &[Action], number: f64, ops: &mut Vec<Op<S>>) {
        ops.clear();
        if let [first, rest @ ..] = actions {
            ops.extend(turtle.ops(&[first.with(number)]));
            ops.extend(turtle.ops::<S>(rest));
        }
        ops.iter_mut().for_each(|op| *op = op.scaled(-self.exponent));
    }

    /// Whether no two modules of a letter are alike.
    pub(crate) fn varies(&self) -> bool {
        self.variations != [0.0; 2]
    }

    /// Whether there are polygons.
    pub(crate) fn fills(&self) -> bool {
        self.ops.iter().flatten().any(|op| matches!(op, Op::OpenPolygon))
    }

    /// Whether it matters which module of its letter one is.
    pub(crate) fn is_personal(&self) -> bool {
        self.varies() || self.dated || self.growth < 1.0
    }

    /// What a module does whose letter does `ops`.
    pub(crate) fn own(&self, ops: &[Op<S>], fate: &Fate, seed: u32, own: &mut Vec<Op<S>>) {
        let grown = if fate.grows { self.growth } else { 1.0 };
        let [angles, lengths] = self.variations;
        // Ways and turns are counted, whatever stands between them.
        let mut slot = 0;
        let mut varied = |most: f64, purpose: Purpose| {
            slot += 1;
            match most {
                0.0 => grown,
                _ => grown * (1.0 + most * fate.key.variation(seed, purpose, slot - 1)),
            }
        };
        own.clear();
        if self.dated {
            own.push(Op::Style(ColourChange::Set(fate.since.cast_signed()).into()));
        }
        own.extend(ops.iter().map(|op| match *op {
            Op::Draw(length) => Op::Draw(length * varied(lengths, Purpose::Length)),
            Op::Move(length) => Op::Move(length * varied(lengths, Purpose::Length)),
            Op::Turn(turning) => {
                // Turning round is meant to lead straight back.
                let most = if turning.by == Heading::HALF { 0.0 } else { angles };
                Op::Turn(turning.part(varied(most, Purpose::Angle)))
            }
            other => other,
        }));
    }

    /// What a letter does that is still growing, in the place of `op`.
    pub(crate) fn growing(&self, op: Op<S>) -> Op<S> {
        match op {
            Op::Draw(length) => Op::Draw(length * self.growth),
            Op::Move(length) => Op::Move(length * self.growth),
            Op::Turn(turning) => Op::Turn(turning.part(self.growth)),
            other => other,
        }
    }

    /// Whether a letter draws.
    pub(crate) fn draws(&self, letter: LetterId) -> bool {
        self.ops[usize::from(letter)].iter().any(|op| matches!(op, Op::Draw(_)))
    }

    /// By letter: whether it, or what is drawn in its place, draws.
    pub(crate) fn shows(&self, rules: &Rules) -> Vec<bool> {
        let shows = |(letter, images): (usize, &Vec<Rule>)| {
            let mut letters = images.iter().flat_map(|image| &image.successor.letters);
            if images.is_empty() { self.draws(letter as LetterId) } else { letters.any(|&letter| self.draws(letter)) }
        };
        rules.images.iter().enumerate().map(shows).collect()
    }

    /// Of the letters that have replaced `former`, the place of the one that goes on in its place.
    pub(crate) fn heir(&self, former: LetterId, successor: &[LetterId]) -> Option<usize> {
        heir(former, successor.iter().copied(), |letter| self.draws(letter))
    }
}

/// Of the letters that have replaced `former`, the place of the one that goes on in its place: the first of that letter, or
/// else the first that draws where that one did.
pub(crate) fn heir(
    former: LetterId,
    mut successor: impl Iterator<Item = LetterId> + Clone,
    draws: impl Fn(LetterId) -> bool,
) -> Option<usize> {
    let same = successor.clone().position(|letter| letter == former);
    same.or_else(|| successor.position(&draws).filter(|_| draws(former)))
}

impl<S: Geometry> Turning<S> {
    fn new(about: Axis, by: Heading, back: bool) -> Self {
        Self { turn: S::turn(about, if back { -by } else { by }), about, by, back }
    }

    fn part(&self, factor: f64) -> Self {
        if factor == 1.0 { *self } else { Self::new(self.about, self.by.part(factor), self.back) }
    }
}

impl<S: Geometry> Op<S> {
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
pub(crate) struct Pen<S: Geometry = Plane> {
    pub at: S::Point,
    pub heading: S::Turn,
    pub style: StyleChange,
    /// What lengths are multiplied by.
    pub scale: f64,
    /// Upwards, in the frame that the pen is in.
    pub vertical: S::Point,
}

/// What a pen draws upon.
pub(crate) trait Paper<S: Geometry> {
    /// A segment.
    fn stroke(&mut self, from: S::Point, to: S::Point, style: &StyleChange);
    /// A polygon begins.
    fn open(&mut self, style: &StyleChange);
    /// A vertex of the polygon that began last, if one is open.
    fn vertex(&mut self, at: S::Point);
    /// The polygon that began last ends, if one is open.
    fn close(&mut self);
}

impl<S: Geometry> Pen<S> {
    /// At the origin.
    pub(crate) fn new(heading: S::Turn, style: StyleChange) -> Self {
        Self { at: S::Point::default(), heading, style, scale: 1.0, vertical: S::UPWARDS }
    }

    /// Acts, with `saved` as the stack of open branches and lengths times `scale`, upon `paper`.
    /// A `Pop` without a branch to return from does nothing.
    pub(crate) fn act(
        &mut self,
        ops: &[Op<S>],
        saved: &mut Vec<Self>,
        scale: f64,
        directions: &mut S::Directions,
        paper: &mut impl Paper<S>,
    ) {
        for &op in ops {
            match op {
                Op::Draw(length) => {
                    let from = self.at;
                    self.forward(length * scale, directions);
                    paper.stroke(from, self.at, &self.style);
                }
                Op::Move(length) => self.forward(length * scale, directions),
                Op::Turn(by) => self.heading = S::then(self.heading, by.turn),
                Op::Upright => self.heading = S::upright(self.heading, &self.vertical),
                Op::Bend(tropism) => self.heading = S::bent(self.heading, &tropism),
                Op::Push(Deeper { width, length }) => {
                    reserve(saved, 1);
                    saved.push(*self);
                    self.style.level = self.style.level.saturating_add(1);
                    self.style.width = self.style.width.then(WidthChange { factor: width, offset: 0.0 });
                    self.scale = (self.scale * length).min(LARGEST);
                }
                Op::Pop => *self = saved.pop().unwrap_or(*self),
                Op::Style(change) => self.style = self.style.then(&change),
                Op::OpenPolygon => paper.open(&self.style),
                Op::Vertex => paper.vertex(self.at),
                Op::ClosePolygon => paper.close(),
            }
        }
    }

    fn forward(&mut self, length: f64, directions: &mut S::Directions) {
        self.at = S::ahead(&S::axes(directions, self.heading), self.at, length * self.scale);
    }
}

/// Branches in branches do not make lengths larger than this many times: far beyond any picture.
pub(crate) const LARGEST: f64 = 1e30;
