//! The turtle: the actions of each letter, and the turtle's state at the start.

use crate::Plane;
use crate::course::{By, Leg, Spot};
use crate::room::{bytes_of, reserve};
use crate::rotation::Axis;
use crate::space::{Geometry, Tropism, exponent_of, finite, unit_of};
use crate::style::{ColourChange, StyleChange, WidthChange};
use crate::sway::{Sway, WAVE};
use crate::tube::TubeEnd;
use lsystem_derive::{Fate, LetterId, Rule, Rules, Varied};
use lsystem_syntax::{Action, CIRCLE_SIDES, ColourBy, Heading, Outline, Style, SurfacePoint, TUBE_STROKES};
use std::sync::Arc;

/// The corners of a triangle of a surface of size 1: ahead, left and up.
pub type Triangle = [SurfacePoint; 3];

/// The actions of all letters and the settings of the turtle.
#[derive(Clone, Debug, PartialEq)]
pub struct Turtle {
    /// The actions by letter ([`LetterId`]).
    pub actions: Vec<Vec<Action>>,
    /// The triangles of the surfaces that letters draw, by name.
    pub surfaces: Vec<(char, Arc<[Triangle]>)>,
    /// The wireframes of shapes that are drawn after all else, in model units.
    pub wires: Arc<[[[f64; 3]; 2]]>,
    /// The angle of a left turn, counter-clockwise.
    pub left: Heading,
    /// The angle of a right turn, clockwise.
    pub right: Heading,
    /// The angle of pitching down: the heading turns away from the turtle's up.
    pub pitch_down: Heading,
    /// The angle of pitching up.
    pub pitch_up: Heading,
    /// The angle of rolling left: by the right-hand rule about the heading, which lifts the turtle's left.
    pub roll_left: Heading,
    /// The angle of rolling right.
    pub roll_right: Heading,
    /// The tropism that bends the heading after each segment.
    pub tropism: Option<Tropism>,
    /// The sway of branches.
    pub sway: Option<Sway>,
    /// The heading at the start.
    pub heading: Heading,
    /// The position at the start, in model units.
    pub start: [f64; 2],
    /// The step length, in model units.
    pub step: f64,
    /// The stroke width at the start, in multiples of the step length.
    pub width: f64,
    /// The greatest stroke width, as a fraction of the drawing's longest side: if the widest stroke exceeds it, all
    /// strokes are thinner by the same factor. 0 for no limit.
    pub max_width: f64,
    /// Whether a stroke tapers to the width with which its branch goes on.
    pub tapers: bool,
    /// The factor of the stroke width in a branch.
    pub width_factor: f64,
    /// The factor of all lengths in a branch.
    pub length_factor: f64,
    /// The rule for the colour index.
    pub colouring: Colouring,
    /// The largest random deviation of an angle, as a fraction of the angle.
    pub angle_variation: f64,
    /// The largest random deviation of a length, as a fraction of the length.
    pub length_variation: f64,
    /// The growth of the modules that the last derivation step made, from 0 to 1: their angles and lengths times this
    /// factor. One module of a successor continues its predecessor and is fully grown: the first of the predecessor's
    /// letter, whose numbers then are this part of the way from the predecessor's; or else, if the predecessor draws,
    /// the first that draws.
    pub growth: f64,
}

/// The rule for the turtle's colour index.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Colouring {
    /// The colour symbols set the index.
    #[default]
    Symbols,
    /// Turns set the index: to the first number after a left turn, to the second after a right turn.
    Turns([i32; 2]),
    /// The index is the derivation step that made the module. A module of its predecessor's letter keeps the
    /// predecessor's index.
    Generations,
}

/// An action with every default filled in.
#[derive(Clone, Copy, Debug)]
pub(crate) enum TurtleOp<S: Geometry = Plane> {
    /// Go forward and draw; the length in units of `2^`[`Score::exponent`] steps.
    Draw(f64),
    /// Go forward without drawing; the length in the same units.
    Move(f64),
    Turn(Turning<S>),
    /// Exchange left and right turns from here on.
    SwapTurns,
    /// Multiply lengths from here on.
    ScaleLength(f64),
    /// Draw a circle around the turtle; the diameter in the same units as lengths.
    Circle(f64),
    /// Fill an outline; the size in the same units.
    Fill(Outline, f64),
    /// Fill a triangle of a surface; the size in the same units. `follows`: the triangle is not the surface's first.
    Triangle {
        corners: Triangle,
        size: f64,
        follows: bool,
    },
    /// Roll until the turtle's left is level.
    Upright,
    /// Turn the heading by a tropism.
    Bend(Tropism),
    Push(BranchFactors),
    /// Turn the heading of a new branch by a sway. In a [`Score`] the turn is open: it depends on the step that made
    /// the module ([`Score::changed`]).
    Sway(S::Turn),
    Pop,
    Style(StyleChange),
    /// Set the colour index after a turn: to the first number, or to the second while turns are exchanged.
    TurnColour([i32; 2]),
    OpenPolygon,
    /// Record the turtle's position as a vertex if the innermost open polygon has none yet.
    FirstVertex,
    Vertex,
    ClosePolygon,
    /// Begin a tube.
    OpenTube,
    /// Draw a part of a tube.
    Tube,
}

/// A rotation about one of the turtle's own axes, as an angle and as a turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning<S: Geometry> {
    pub turn: S::Turn,
    about: Axis,
    by: Heading,
    /// Whether the rotation goes against the right-hand rule. A half turn is the same both ways, but a fraction of a
    /// half turn is not.
    back: bool,
    /// For a left or right turn: the angle of the other, which replaces this turn while turns are exchanged.
    other: Option<Heading>,
}

/// The factors of widths and lengths in a branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BranchFactors {
    width: f64,
    length: f64,
}

/// A turtle's actions compiled to operations, in units that keep the lengths of its symbols below 1.
#[derive(Clone, Debug)]
pub(crate) struct Score<S: Geometry = Plane> {
    /// By letter; empty for unreachable letters.
    pub ops: Vec<Vec<TurtleOp<S>>>,
    /// A length of 1 is `2^exponent` steps.
    pub exponent: i32,
    /// One step in model units; 1 if the turtle's own step is zero, and the default length is then 0.
    pub step: f64,
    /// The width at the start, in multiples of `step`.
    pub width: f64,
    /// As [`Turtle::growth`].
    pub growth: f64,
    /// Whether strokes taper: the turtle wants it, and widths may change.
    pub tapers: bool,
    /// The largest deviations of angles and of lengths, as fractions.
    variations: [f64; 2],
    /// Whether the colour index is the derivation step that made the module.
    pub(crate) colours_by_generation: bool,
    /// By derivation step, modulo [`WAVE`]: the turn of a branch that the step made. `None` without a sway.
    sways: Option<[S::Turn; WAVE]>,
}

impl Default for Turtle {
    /// A turtle at the origin with heading +y, step length 1, angles of 0 degrees, and no letters.
    fn default() -> Self {
        Self {
            actions: vec![],
            surfaces: vec![],
            wires: Arc::default(),
            left: Heading::EAST,
            right: Heading::EAST,
            pitch_down: Heading::EAST,
            pitch_up: Heading::EAST,
            roll_left: Heading::EAST,
            roll_right: Heading::EAST,
            tropism: None,
            sway: None,
            heading: Heading::UP,
            start: [0.0; 2],
            step: 1.0,
            width: 0.0,
            max_width: 0.0,
            tapers: false,
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
    /// Takes widths and the rule for colours from a style.
    pub(crate) fn take_style(&mut self, style: &Style) {
        (self.width, self.max_width, self.width_factor) = (style.width, style.max_width / 100.0, style.width_factor);
        self.tapers = style.tapers;
        self.colouring = match style.colour_by {
            ColourBy::Turn => Colouring::Turns(style.turn_colours),
            ColourBy::Generation => Colouring::Generations,
            _ => Colouring::Symbols,
        };
    }

    /// The orientation at the start, and the vertical.
    pub(crate) fn start<S: Geometry>(&self) -> (S::Turn, S::Point) {
        let mut pen = Pen::<S>::new(S::turn(Axis::Up, self.heading), StyleChange::NONE);
        if let Some(sway) = self.sway {
            pen.sway(sway.at_root::<S>(), &mut S::directions());
        }
        (pen.heading, pen.vertical)
    }

    /// The compiled actions of the letters that may be drawn.
    pub(crate) fn score<S: Geometry>(&self, drawn: &[bool]) -> Score<S> {
        let mut ops: Vec<Vec<TurtleOp<S>>> = (self.actions.iter().zip(drawn))
            .map(|(actions, &drawn)| if drawn { self.ops(actions) } else { vec![] })
            .collect();
        let lengths = ops.iter().flatten().filter_map(TurtleOp::length);
        let exponent = exponent_of(lengths.map(f64::abs).fold(0.0, f64::max));
        for op in ops.iter_mut().flatten() {
            *op = op.scaled(-exponent);
        }
        Score {
            tapers: self.tapers && self.changes_width(drawn),
            ops,
            exponent,
            step: self.unit(),
            width: finite(self.width).max(0.0) * self.steps(),
            growth: finite(self.growth).clamp(0.0, 1.0),
            variations: [self.angle_variation, self.length_variation].map(|part| finite(part).clamp(0.0, 1.0)),
            colours_by_generation: self.colouring == Colouring::Generations,
            sways: self.sway.map(|sway| core::array::from_fn(|step| sway.after::<S>(step))),
        }
    }

    /// Whether a letter that may be drawn changes the width.
    fn changes_width(&self, drawn: &[bool]) -> bool {
        self.actions.iter().zip(drawn).filter(|(_, drawn)| **drawn).flat_map(|(actions, _)| actions).any(|action| {
            match action {
                Action::SetWidth(_) | Action::ScaleWidth(_) => true,
                Action::Push => self.width_factor != 1.0,
                _ => false,
            }
        })
    }

    /// The default length in units of [`Turtle::unit`]: 0 if the step is zero or not finite, 1 otherwise.
    fn steps(&self) -> f64 {
        if self.step == 0.0 || !self.step.is_finite() { 0.0 } else { 1.0 }
    }

    /// The step length in model units; 1 if the step is zero or not finite.
    fn unit(&self) -> f64 {
        if self.steps() == 0.0 { 1.0 } else { self.step }
    }

    /// The operations of a letter; lengths in units of [`Turtle::unit`].
    fn ops<S: Geometry>(&self, actions: &[Action]) -> Vec<TurtleOp<S>> {
        let mut ops = Vec::with_capacity(actions.len());
        let corners = self.actions.iter().flatten().any(|action| *action == Action::OpenPolygon);
        for &action in actions {
            let marks = corners && matches!(action, Action::Draw(_) | Action::Move(_));
            ops.extend(marks.then_some(TurtleOp::FirstVertex));
            if let Action::Surface(name, size) = action {
                let triangles = self.surface(name).iter().enumerate();
                ops.extend(triangles.map(|(at, &corners)| {
                    let size = self.in_steps(size);
                    TurtleOp::Triangle { corners, size, follows: at > 0 }
                }));
            } else {
                ops.push(self.op(action));
            }
            ops.extend(marks.then_some(TurtleOp::Vertex));
            ops.extend((self.sway.is_some() && action == Action::Push).then_some(TurtleOp::Sway(S::AHEAD)));
            if let Some(tropism) = self.tropism.filter(|_| action.draws()) {
                ops.push(TurtleOp::Bend(tropism));
            }
            let sides = match (self.colouring, action) {
                (Colouring::Turns([left, right]), Action::TurnLeft(_)) => Some([left, right]),
                (Colouring::Turns([left, right]), Action::TurnRight(_)) => Some([right, left]),
                _ => None,
            };
            ops.extend(sides.map(TurtleOp::TurnColour));
        }
        ops
    }

    /// The triangles of a surface; none if the system has no surface of this name.
    fn surface(&self, name: char) -> &[Triangle] {
        self.surfaces.iter().find(|(own, _)| *own == name).map_or(&[], |(_, triangles)| triangles)
    }

    /// A length in units of [`Turtle::unit`]; the step if there is none.
    fn in_steps(&self, length: Option<f64>) -> f64 {
        length.map_or(self.steps(), |length| finite(length / self.unit()))
    }

    fn branch_factors(&self) -> BranchFactors {
        let [width, length] = [self.width_factor, self.length_factor].map(|factor| finite(factor).max(0.0));
        BranchFactors { width, length }
    }

    /// The operation of an action; lengths in units of [`Turtle::unit`].
    fn op<S: Geometry>(&self, action: Action) -> TurtleOp<S> {
        let angle = |degrees: Option<f64>, own: Heading| degrees.map_or(own, Heading::from_degrees);
        let turn = |about: Axis, degrees: Option<f64>, own: Heading| {
            TurtleOp::Turn(Turning::new(about, angle(degrees, own), false))
        };
        let back = |about: Axis, degrees: Option<f64>, own: Heading| {
            TurtleOp::Turn(Turning::new(about, angle(degrees, own), true))
        };
        let side = |degrees: Option<f64>, [own, other]: [Heading; 2], back: bool| {
            let other = Some(angle(degrees, other));
            TurtleOp::Turn(Turning { other, ..Turning::new(Axis::Up, angle(degrees, own), back) })
        };
        let in_steps = |length: Option<f64>| self.in_steps(length);
        match action {
            Action::Draw(length) | Action::DrawUnmarked(length) => TurtleOp::Draw(in_steps(length)),
            Action::Move(length) | Action::MoveUnmarked(length) => TurtleOp::Move(in_steps(length)),
            Action::OpenPolygon => TurtleOp::OpenPolygon,
            Action::Vertex => TurtleOp::Vertex,
            Action::ClosePolygon => TurtleOp::ClosePolygon,
            Action::OpenTube => TurtleOp::OpenTube,
            Action::TubePoint | Action::CloseTube => TurtleOp::Tube,
            Action::TurnLeft(degrees) => side(degrees, [self.left, self.right], false),
            Action::TurnRight(degrees) => side(degrees, [self.right, self.left], true),
            Action::SwapTurns => TurtleOp::SwapTurns,
            Action::ScaleLength(factor) => TurtleOp::ScaleLength(finite(factor).max(0.0)),
            Action::Circle(diameter) => TurtleOp::Circle(in_steps(diameter)),
            Action::Fill(outline, size) => TurtleOp::Fill(outline, in_steps(size)),
            Action::PitchDown(degrees) => turn(Axis::Left, degrees, self.pitch_down),
            Action::PitchUp(degrees) => back(Axis::Left, degrees, self.pitch_up),
            Action::RollLeft(degrees) => turn(Axis::Ahead, degrees, self.roll_left),
            Action::RollRight(degrees) => back(Axis::Ahead, degrees, self.roll_right),
            Action::RollUpright => TurtleOp::Upright,
            Action::TurnRound => TurtleOp::Turn(Turning::new(Axis::Up, Heading::HALF, false)),
            Action::Push => TurtleOp::Push(self.branch_factors()),
            Action::Pop => TurtleOp::Pop,
            // A cut acts during the derivation, and a surface has several operations.
            Action::Cut | Action::Surface(..) => TurtleOp::Style(StyleChange::NONE),
            Action::SetColour(_) | Action::AddColour(_) if self.colouring != Colouring::Symbols => {
                TurtleOp::Style(StyleChange::NONE)
            }
            Action::SetColour(index) => TurtleOp::Style(ColourChange::Set(index).into()),
            Action::AddColour(by) => TurtleOp::Style(ColourChange::Add(by).into()),
            Action::SetWidth(width) => {
                TurtleOp::Style(WidthChange { factor: 0.0, offset: finite(width).max(0.0) * self.steps() }.into())
            }
            Action::ScaleWidth(factor) => {
                TurtleOp::Style(WidthChange { factor: finite(factor).max(0.0), offset: 0.0 }.into())
            }
        }
    }
}

impl<S: Geometry> Score<S> {
    /// The operations of a letter. `number`, a module's first argument, replaces the number of the letter's first
    /// action.
    pub(crate) fn ops_of(
        &self,
        turtle: &Turtle,
        letter: usize,
        number: Option<f64>,
    ) -> impl Iterator<Item = TurtleOp<S>> {
        let (ops, first) = (&self.ops[letter], turtle.actions[letter].first());
        // In systems with polygons, an operation for the first vertex comes before a draw or move.
        let marks = matches!(ops[..], [TurtleOp::FirstVertex, ..]);
        // A surface has an operation for each triangle.
        let surface = if let Some(&Action::Surface(name, _)) = first { Some(turtle.surface(name).len()) } else { None };
        let numbered = number.zip(first).map(|(number, action)| (usize::from(marks), action.with(number)));
        ops.iter().enumerate().map(move |(index, &op)| match numbered {
            Some((_, action)) if surface.is_some_and(|count| index < count) => {
                let size = finite(libm::scalbn(turtle.in_steps(action.length().flatten()), -self.exponent));
                op.map_length(|_| size)
            }
            Some((place, action)) if surface.is_none() && place == index => self.op(turtle, action),
            _ => op,
        })
    }

    /// The operation of an action of `turtle`, from which this score was made; its length may be above 1.
    pub(crate) fn op(&self, turtle: &Turtle, action: Action) -> TurtleOp<S> {
        turtle.op(action).scaled(-self.exponent)
    }

    /// Replaces `ops` by the operations of `actions`, the first of them with `number`. `turtle` is the one from which
    /// this score was made. Lengths may be above 1.
    pub(crate) fn numbered(&self, turtle: &Turtle, actions: &[Action], number: f64, ops: &mut Vec<TurtleOp<S>>) {
        ops.clear();
        if let [first, rest @ ..] = actions {
            ops.extend(turtle.ops(&[first.with(number)]));
            ops.extend(turtle.ops::<S>(rest));
        }
        ops.iter_mut().for_each(|op| *op = op.scaled(-self.exponent));
    }

    /// Whether angles or lengths vary from module to module.
    pub(crate) fn varies(&self) -> bool {
        self.variations != [0.0; 2]
    }

    /// Whether a letter opens a polygon or fills a disc.
    pub(crate) fn fills(&self) -> bool {
        self.ops
            .iter()
            .flatten()
            .any(|op| matches!(op, TurtleOp::OpenPolygon | TurtleOp::Fill(..) | TurtleOp::Triangle { .. }))
    }

    /// Whether a letter draws a part of a tube, which begins at an earlier symbol.
    pub(crate) fn has_tubes(&self) -> bool {
        self.ops.iter().flatten().any(|op| matches!(op, TurtleOp::Tube))
    }

    /// Whether a letter exchanges left and right turns.
    pub(crate) fn swaps(&self) -> bool {
        self.ops.iter().flatten().any(|op| matches!(op, TurtleOp::SwapTurns))
    }

    /// Whether modules of the same letter may do different things: by variation, colour, growth
    /// or sway.
    pub(crate) fn differs_by_module(&self) -> bool {
        self.varies() || self.differs_by_age()
    }

    /// Whether modules of the same letter may do different things by their age.
    pub(crate) fn differs_by_age(&self) -> bool {
        self.colours_by_generation || self.growth < 1.0 || self.sways()
    }

    /// Whether branches sway.
    pub(crate) fn sways(&self) -> bool {
        self.sways.is_some()
    }

    /// Replaces `own` by the operations of one module. `ops` are the operations of its letter.
    pub(crate) fn own(&self, ops: &[TurtleOp<S>], fate: &Fate, seed: u32, own: &mut Vec<TurtleOp<S>>) {
        let grown = if fate.grows { self.growth } else { 1.0 };
        let [angles, lengths] = self.variations;
        // The slot counts lengths and angles only, so that other operations do not change the random numbers.
        let mut slot = 0;
        let mut varied = |most: f64, what: Varied| {
            slot += 1;
            match most {
                0.0 => grown,
                _ => grown * (1.0 + most * fate.key.variation(seed, what, slot - 1)),
            }
        };
        let mut of_surface = 1.0;
        own.clear();
        if self.colours_by_generation {
            own.push(TurtleOp::Style(ColourChange::Set(fate.since.cast_signed()).into()));
        }
        own.extend(ops.iter().map(|&op| match op {
            TurtleOp::Turn(turning) => {
                // A half turn leads straight back and does not vary.
                let most = if turning.by == Heading::HALF { 0.0 } else { angles };
                TurtleOp::Turn(turning.part(varied(most, Varied::Angle)))
            }
            TurtleOp::Sway(_) => self.swaying(op, fate.step),
            // All triangles of a surface change alike.
            TurtleOp::Triangle { follows: true, .. } => op.map_length(|size| size * of_surface),
            other => other.map_length(|length| {
                of_surface = varied(lengths, Varied::Length);
                length * of_surface
            }),
        }));
    }

    /// The operation `op` of a module that derivation step `step` made and that may still grow.
    pub(crate) fn changed(&self, op: TurtleOp<S>, grows: bool, step: u32) -> TurtleOp<S> {
        if grows { self.growing(self.swaying(op, step)) } else { self.swaying(op, step) }
    }

    /// The operation `op` of a module that derivation step `step` made.
    fn swaying(&self, op: TurtleOp<S>, step: u32) -> TurtleOp<S> {
        match (op, &self.sways) {
            (TurtleOp::Sway(_), Some(turns)) => TurtleOp::Sway(turns[step as usize % WAVE]),
            _ => op,
        }
    }

    /// The operation `op` of a module that still grows.
    fn growing(&self, op: TurtleOp<S>) -> TurtleOp<S> {
        match op {
            TurtleOp::Turn(turning) => TurtleOp::Turn(turning.part(self.growth)),
            other => other.map_length(|length| length * self.growth),
        }
    }

    /// Whether a letter draws.
    pub(crate) fn draws(&self, letter: LetterId) -> bool {
        self.ops[usize::from(letter)].iter().any(|op| matches!(op, TurtleOp::Draw(_)))
    }

    /// By letter: whether the letter, or one of its images, draws.
    pub(crate) fn shows(&self, rules: &Rules) -> Vec<bool> {
        let shows = |(letter, images): (usize, &Vec<Rule>)| {
            let mut letters = images.iter().flat_map(|image| &image.successor.letters);
            if images.is_empty() { self.draws(letter as LetterId) } else { letters.any(|&letter| self.draws(letter)) }
        };
        rules.images.iter().enumerate().map(shows).collect()
    }

    /// The index in `successor` of the letter that continues `former`.
    pub(crate) fn continuation(&self, former: LetterId, successor: &[LetterId]) -> Option<usize> {
        continuation(former, successor.iter().copied(), |letter| self.draws(letter))
    }
}

/// The index in `successor` of the letter that continues `former`: the first of the same letter, or else, if `former`
/// draws, the first that draws.
pub(crate) fn continuation(
    former: LetterId,
    mut successor: impl Iterator<Item = LetterId> + Clone,
    draws: impl Fn(LetterId) -> bool,
) -> Option<usize> {
    let same = successor.clone().position(|letter| letter == former);
    same.or_else(|| successor.position(&draws).filter(|_| draws(former)))
}

impl<S: Geometry> Turning<S> {
    fn new(about: Axis, by: Heading, back: bool) -> Self {
        Self { turn: S::turn(about, if back { -by } else { by }), about, by, back, other: None }
    }

    fn part(&self, factor: f64) -> Self {
        if factor == 1.0 {
            return *self;
        }
        let other = self.other.map(|other| other.part(factor));
        Self { other, ..Self::new(self.about, self.by.part(factor), self.back) }
    }

    /// The turn, or while turns are exchanged the turn to the other side.
    fn turn(&self, swapped: bool) -> S::Turn {
        match self.other {
            Some(other) if swapped => S::turn(self.about, if self.back { other } else { -other }),
            _ => self.turn,
        }
    }
}

impl<S: Geometry> TurtleOp<S> {
    /// The operation with its length times `2^exponent`.
    fn scaled(self, exponent: i32) -> Self {
        self.map_length(|length| finite(libm::scalbn(length, exponent)))
    }

    /// The operation with another length or diameter, if it has one.
    fn map_length(self, change: impl FnOnce(f64) -> f64) -> Self {
        match self {
            Self::Draw(length) => Self::Draw(change(length)),
            Self::Move(length) => Self::Move(change(length)),
            Self::Circle(diameter) => Self::Circle(change(diameter)),
            Self::Fill(outline, size) => Self::Fill(outline, change(size)),
            Self::Triangle { corners, size, follows } => Self::Triangle { corners, size: change(size), follows },
            other => other,
        }
    }

    /// The operation's length or diameter.
    pub(crate) fn length(&self) -> Option<f64> {
        match *self {
            Self::Draw(length) | Self::Move(length) | Self::Circle(length) | Self::Fill(_, length) => Some(length),
            Self::Triangle { size, .. } => Some(size),
            _ => None,
        }
    }

    /// The number of segments that the operation draws.
    pub(crate) fn segments(&self) -> u64 {
        match self {
            Self::Draw(_) => 1,
            Self::Circle(_) => u64::from(CIRCLE_SIDES),
            Self::Tube => u64::from(TUBE_STROKES),
            _ => 0,
        }
    }

    /// The units of work of the operation, and an upper bound on the number of its items.
    pub(crate) fn work(&self) -> u64 {
        match self {
            Self::Circle(_) => u64::from(CIRCLE_SIDES),
            Self::Tube => u64::from(TUBE_STROKES),
            Self::Fill(outline, _) => u64::from(outline.sides()),
            Self::Triangle { .. } => 3,
            _ => 1,
        }
    }
}

/// The units of work of operations.
pub(crate) fn work_of<S: Geometry>(ops: &[TurtleOp<S>]) -> u64 {
    ops.iter().map(TurtleOp::work).sum()
}

/// The corners of a circle with radius 1, counter-clockwise from +x.
const CORNERS: [[f64; 2]; CIRCLE_SIDES as usize] = {
    // The cosines of multiples of 11.25 degrees, from 0 to 90 degrees.
    const COSINES: [f64; 9] = [
        1.0,
        0.980_785_280_403_230_4,
        0.923_879_532_511_286_7,
        0.831_469_612_302_545_2,
        core::f64::consts::FRAC_1_SQRT_2,
        0.555_570_233_019_602_2,
        0.382_683_432_365_089_8,
        0.195_090_322_016_128_28,
        0.0,
    ];
    let mut corners = [[0.0; 2]; CIRCLE_SIDES as usize];
    let mut at = 0;
    while at < 8 {
        let [c, s] = [COSINES[at], COSINES[8 - at]];
        corners[at] = [c, s];
        corners[at + 8] = [-s, c];
        corners[at + 16] = [-c, -s];
        corners[at + 24] = [s, -c];
        at += 1;
    }
    corners
};

/// The state of the turtle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pen<S: Geometry = Plane> {
    pub at: S::Point,
    /// The place, exactly.
    pub spot: Spot,
    pub heading: S::Turn,
    pub style: StyleChange,
    /// The factor of lengths, by branches and by [`TurtleOp::ScaleLength`].
    pub scale: f64,
    /// Whether left and right turns are exchanged.
    pub swapped: bool,
    /// The upward direction of the model, in the pen's frame. A sway turns it with the branch.
    pub vertical: S::Point,
    /// The last point of the tube.
    pub tube: TubeEnd<S>,
}

/// A receiver of segments and polygons.
pub(crate) trait Paper<S: Geometry> {
    /// Notes a leg of the turtle's way. Returns the place at its end.
    fn go(&mut self, leg: Leg<S>) -> Spot;
    /// Adds a segment of the branch.
    fn stroke(&mut self, ends: [S::Point; 2], spot: Spot, style: &StyleChange);
    /// Adds a segment beside the branch.
    fn side(&mut self, ends: [S::Point; 2], spot: Spot, style: &StyleChange);
    /// Adds a stroke of a tube, which tapers to the width `style.next`.
    fn tube(&mut self, ends: [S::Point; 2], style: &StyleChange);
    /// Interrupts the branch: the turtle moves.
    fn gap(&mut self);
    /// Opens a branch.
    fn branch(&mut self);
    /// Ends a branch and returns to the outer one.
    fn rejoin(&mut self);
    /// Opens a polygon.
    fn open(&mut self, style: &StyleChange);
    /// Adds a vertex to the innermost open polygon, if any, unless the polygon has vertices already.
    fn first_vertex(&mut self, at: S::Point, spot: Spot);
    /// Adds a vertex to the innermost open polygon, if any.
    fn vertex(&mut self, at: S::Point, spot: Spot);
    /// Closes the innermost open polygon, if any.
    fn close(&mut self);
}

impl<S: Geometry> Pen<S> {
    /// A pen at the start of a drawing.
    pub(crate) fn start(turtle: &Turtle, score: &Score<S>) -> Self {
        let (heading, vertical) = turtle.start::<S>();
        Self { vertical, ..Self::new(heading, StyleChange::start(score.width)) }
    }

    /// A pen at the origin.
    pub(crate) fn new(heading: S::Turn, style: StyleChange) -> Self {
        let at = S::Point::default();
        let tube = TubeEnd { at, heading, width: style.width };
        Self { at, spot: Spot::ENTRY, heading, style, scale: 1.0, swapped: false, vertical: S::UPWARDS, tube }
    }

    /// Performs operations, with lengths times `scale`, and draws on `paper`. `saved` is the stack of open branches. A
    /// `Pop` without an open branch does nothing.
    pub(crate) fn act(
        &mut self,
        ops: &[TurtleOp<S>],
        saved: &mut Vec<Self>,
        scale: f64,
        directions: &mut S::Directions,
        paper: &mut impl Paper<S>,
    ) {
        for &op in ops {
            match op {
                TurtleOp::Draw(length) => {
                    let from = self.at;
                    self.forward(length, scale, directions, paper);
                    paper.stroke([from, self.at], self.spot, &self.style);
                }
                TurtleOp::Move(length) => {
                    self.forward(length, scale, directions, paper);
                    paper.gap();
                }
                TurtleOp::Turn(by) => self.heading = S::then(self.heading, by.turn(self.swapped)),
                TurtleOp::Sway(turn) => self.sway(turn, directions),
                TurtleOp::SwapTurns => self.swapped = !self.swapped,
                TurtleOp::ScaleLength(factor) => self.scale_by(factor),
                TurtleOp::Circle(diameter) => {
                    let axes = self.axes(0.5 * diameter * scale, directions);
                    let mut corner = [CORNERS[0][0], CORNERS[0][1], 0.0];
                    let (mut from, mut spot) = self.corner(&axes, corner, 0.5 * diameter, paper);
                    for [x, y] in CORNERS.into_iter().cycle().skip(1).take(CORNERS.len()) {
                        let by = By::Corner([x - corner[0], y - corner[1]]);
                        corner = [x, y, 0.0];
                        let to = S::transform(&axes, self.at, S::point(corner));
                        let factor = 0.5 * diameter * self.scale;
                        spot = paper.go(Leg { from: spot, by, heading: self.heading, factor });
                        paper.side([from, to], spot, &self.style);
                        from = to;
                    }
                }
                TurtleOp::Fill(outline, size) => {
                    paper.open(&self.style);
                    if let Some(corners) = outline.leaf() {
                        self.fill(corners.map(|[x, y]| [x, y, 0.0]), size, scale, directions, paper);
                    } else {
                        self.fill(CORNERS.iter().map(|[x, y]| [*x, *y, 0.0]), 0.5 * size, scale, directions, paper);
                    }
                    paper.close();
                }
                TurtleOp::Triangle { corners, size, .. } => {
                    paper.open(&self.style);
                    self.fill(corners.iter().copied(), size, scale, directions, paper);
                    paper.close();
                }
                TurtleOp::Upright => self.heading = S::upright(self.heading, &self.vertical),
                TurtleOp::Bend(tropism) => self.heading = S::bent(self.heading, &tropism),
                TurtleOp::Push(BranchFactors { width, length }) => {
                    reserve(saved, 1);
                    saved.push(*self);
                    paper.branch();
                    self.style.level = self.style.level.saturating_add(1);
                    self.style.width = self.style.width.then(WidthChange { factor: width, offset: 0.0 });
                    self.scale_by(length);
                }
                TurtleOp::Pop => {
                    if let Some(outer) = saved.pop() {
                        *self = outer;
                        paper.rejoin();
                    }
                }
                TurtleOp::Style(change) => self.style = self.style.then(&change),
                TurtleOp::TurnColour(sides) => {
                    self.style.colour = ColourChange::Set(sides[usize::from(self.swapped)]);
                }
                TurtleOp::OpenPolygon => paper.open(&self.style),
                TurtleOp::FirstVertex => paper.first_vertex(self.at, self.spot),
                TurtleOp::Vertex => paper.vertex(self.at, self.spot),
                TurtleOp::ClosePolygon => paper.close(),
                TurtleOp::OpenTube => self.tube = self.tube_end(),
                TurtleOp::Tube => {
                    let end = self.tube_end();
                    let curve = self.tube.curve(&end, directions);
                    self.tube = end;
                    paper.gap();
                    for ends in curve.windows(2) {
                        let [(from, width), (to, next)] = [ends[0], ends[1]];
                        paper.tube([from, to], &StyleChange { width, next: Some(next), ..self.style });
                    }
                }
            }
        }
    }

    /// The turtle's place as a point of a tube.
    fn tube_end(&self) -> TubeEnd<S> {
        TubeEnd { at: self.at, heading: self.heading, width: self.style.width }
    }

    /// Turns the heading by a sway. The vertical turns too: all of a branch moves as one, and pieces with `$` stay equal.
    fn sway(&mut self, turn: S::Turn, directions: &mut S::Directions) {
        let still = self.heading;
        self.heading = S::then(still, turn);
        if !S::LEVEL {
            let axes = S::axes(directions, self.heading);
            self.vertical = S::transform(&axes, S::Point::default(), S::seen(still, self.vertical));
        }
    }

    /// Multiplies lengths from here on.
    pub(crate) fn scale_by(&mut self, factor: f64) {
        self.scale = scaled(self.scale, factor);
    }

    /// The turtle's axes times `size`.
    fn axes(&self, size: f64, directions: &mut S::Directions) -> S::Axes {
        S::scaled(S::axes(directions, self.heading), size * self.scale)
    }

    /// A corner of a shape of this size around the turtle, with these axes.
    fn corner(&self, axes: &S::Axes, corner: [f64; 3], size: f64, paper: &mut impl Paper<S>) -> (S::Point, Spot) {
        let by = By::Corner([corner[0], corner[1]]);
        let spot = paper.go(Leg { from: self.spot, by, heading: self.heading, factor: size * self.scale });
        (S::transform(axes, self.at, S::point(corner)), spot)
    }

    /// Adds corners of a shape of this size to the open polygon.
    fn fill(
        &self,
        corners: impl Iterator<Item = [f64; 3]>,
        size: f64,
        scale: f64,
        directions: &mut S::Directions,
        paper: &mut impl Paper<S>,
    ) {
        let axes = self.axes(size * scale, directions);
        corners.for_each(|corner| {
            let (at, spot) = self.corner(&axes, corner, size, paper);
            paper.vertex(at, spot);
        });
    }

    fn forward(&mut self, length: f64, scale: f64, directions: &mut S::Directions, paper: &mut impl Paper<S>) {
        let (heading, factor) = (self.heading, length * self.scale);
        self.at = S::ahead(&S::axes(directions, heading), self.at, length * scale * self.scale);
        self.spot = paper.go(Leg { from: self.spot, by: By::Ahead, heading, factor });
    }
}

/// A scale times `factor`, at most [`LARGEST_SCALE`].
pub(crate) fn scaled(scale: f64, factor: f64) -> f64 {
    (scale * factor).min(LARGEST_SCALE)
}

/// The factor of lengths along a word, without the rest of the turtle's state.
#[derive(Clone, Debug)]
pub(crate) struct ScaleTrace {
    pub scale: f64,
    saved: Vec<f64>,
}

impl ScaleTrace {
    /// The scale at the start of a word.
    pub(crate) fn new() -> Self {
        Self { scale: 1.0, saved: vec![] }
    }

    /// Applies an operation.
    pub(crate) fn follow<S: Geometry>(&mut self, op: &TurtleOp<S>) {
        match op {
            TurtleOp::Push(BranchFactors { length, .. }) => {
                reserve(&mut self.saved, 1);
                self.saved.push(self.scale);
                self.scale = scaled(self.scale, *length);
            }
            TurtleOp::Pop => self.scale = self.saved.pop().unwrap_or(self.scale),
            TurtleOp::ScaleLength(factor) => self.scale = scaled(self.scale, *factor),
            _ => {}
        }
    }

    /// The exponent of the scale; 0 without scaling.
    pub(crate) fn exponent(&self) -> i32 {
        if self.scale == 1.0 { 0 } else { unit_of(self.scale) }
    }

    /// The bytes that the saved scales occupy.
    pub(crate) fn bytes(&self) -> u64 {
        bytes_of(&self.saved)
    }
}

/// The largest factor of lengths: far beyond any picture.
pub(crate) const LARGEST_SCALE: f64 = 1e30;
