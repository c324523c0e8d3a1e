//! The operations of the turtle: actions with every default filled in.

use crate::Plane;
use crate::rotation::Axis;
use crate::space::{Geometry, Tropism, finite};
use crate::style::{ColourChange, StyleChange, WidthChange};
use crate::turtle::settings::{Colouring, Triangle, Turtle};
use lsystem_syntax::{Action, CIRCLE_SIDES, Heading, Outline, TUBE_STROKES};

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
    Wind(S::Turn),
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

/// A rotation about one of the turtle's own axes, as an angle.
#[derive(Clone, Copy, Debug)]
pub struct AxisTurn {
    /// The axis.
    pub about: Axis,
    /// The angle.
    pub by: Heading,
    /// Whether the rotation goes against the right-hand rule. A half turn is the same both ways, but a fraction of a
    /// half turn is not.
    pub back: bool,
}

impl AxisTurn {
    /// The angle by the right-hand rule.
    #[must_use]
    pub fn signed(self) -> Heading {
        if self.back { -self.by } else { self.by }
    }
}

/// A rotation about one of the turtle's own axes, as an angle and as a turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turning<S: Geometry> {
    pub turn: S::Turn,
    pub(in crate::turtle) angle: AxisTurn,
    /// For a left or right turn: the angle of the other, which replaces this turn while turns are exchanged.
    other: Option<Heading>,
}

/// The factors of widths and lengths in a branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BranchFactors {
    pub(in crate::turtle) width: f64,
    pub(in crate::turtle) length: f64,
}

impl Turtle {
    /// The rotation of a turn by an angle; `None` for other actions and for [`Action::RollUpright`].
    #[must_use]
    pub fn rotation(&self, action: Action) -> Option<AxisTurn> {
        let (about, own, usual, back) = match action {
            Action::TurnLeft(own) => (Axis::Up, own, self.left, false),
            Action::TurnRight(own) => (Axis::Up, own, self.right, true),
            Action::PitchDown(own) => (Axis::Left, own, self.pitch_down, false),
            Action::PitchUp(own) => (Axis::Left, own, self.pitch_up, true),
            Action::RollLeft(own) => (Axis::Ahead, own, self.roll_left, false),
            Action::RollRight(own) => (Axis::Ahead, own, self.roll_right, true),
            Action::TurnRound => (Axis::Up, None, Heading::HALF, false),
            _ => return None,
        };
        Some(AxisTurn { about, by: own.map_or(usual, Heading::from_degrees), back })
    }

    /// The angle of a turn; 0 for other actions.
    #[must_use]
    pub fn angle(&self, action: Action) -> Heading {
        self.rotation(action).map_or(Heading::EAST, |turn| turn.by)
    }

    fn branch_factors(&self) -> BranchFactors {
        let [width, length] = [self.width_factor, self.length_factor].map(|factor| finite(factor).max(0.0));
        BranchFactors { width, length }
    }

    /// The operations of a letter; lengths in units of [`Turtle::unit`].
    pub(in crate::turtle) fn ops<S: Geometry>(&self, actions: &[Action]) -> Vec<TurtleOp<S>> {
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
            ops.extend((self.wind.is_some() && action == Action::Push).then_some(TurtleOp::Wind(S::AHEAD)));
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

    /// The operation of an action; lengths in units of [`Turtle::unit`].
    pub(in crate::turtle) fn op<S: Geometry>(&self, action: Action) -> TurtleOp<S> {
        if let Some(turn) = self.rotation(action) {
            let other = (action != action.mirrored()).then(|| self.angle(action.mirrored()));
            return TurtleOp::Turn(Turning { other, ..Turning::new(turn) });
        }
        let in_steps = |length: Option<f64>| self.in_steps(length);
        match action {
            Action::Draw(length) | Action::DrawUnmarked(length) => TurtleOp::Draw(in_steps(length)),
            Action::Move(length) | Action::MoveUnmarked(length) => TurtleOp::Move(in_steps(length)),
            Action::OpenPolygon => TurtleOp::OpenPolygon,
            Action::Vertex => TurtleOp::Vertex,
            Action::ClosePolygon => TurtleOp::ClosePolygon,
            Action::OpenTube => TurtleOp::OpenTube,
            Action::TubePoint | Action::CloseTube => TurtleOp::Tube,
            Action::SwapTurns => TurtleOp::SwapTurns,
            Action::ScaleLength(factor) => TurtleOp::ScaleLength(finite(factor).max(0.0)),
            Action::Circle(diameter) => TurtleOp::Circle(in_steps(diameter)),
            Action::Fill(outline, size) => TurtleOp::Fill(outline, in_steps(size)),
            Action::RollUpright => TurtleOp::Upright,
            Action::Push => TurtleOp::Push(self.branch_factors()),
            Action::Pop => TurtleOp::Pop,
            // A surface has several operations, turns have theirs above, and a cut acts during the derivation.
            Action::Surface(..)
            | Action::TurnLeft(_)
            | Action::TurnRight(_)
            | Action::TurnRound
            | Action::PitchDown(_)
            | Action::PitchUp(_)
            | Action::RollLeft(_)
            | Action::RollRight(_)
            | Action::Cut => TurtleOp::Style(StyleChange::NONE),
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

impl<S: Geometry> Turning<S> {
    fn new(angle: AxisTurn) -> Self {
        Self { turn: S::turn(angle.about, angle.signed()), angle, other: None }
    }

    pub(in crate::turtle) fn part(&self, factor: f64) -> Self {
        if factor == 1.0 {
            return *self;
        }
        let other = self.other.map(|other| other.part(factor));
        Self { other, ..Self::new(AxisTurn { by: self.angle.by.part(factor), ..self.angle }) }
    }

    /// The turn, or while turns are exchanged the turn to the other side.
    pub(in crate::turtle) fn turn(&self, swapped: bool) -> S::Turn {
        match self.other {
            Some(by) if swapped => {
                S::turn(self.angle.about, AxisTurn { by, back: !self.angle.back, ..self.angle }.signed())
            }
            _ => self.turn,
        }
    }
}

impl<S: Geometry> TurtleOp<S> {
    /// The operation with its length times `2^exponent`.
    pub(in crate::turtle) fn scaled(self, exponent: i32) -> Self {
        self.map_length(|length| finite(libm::scalbn(length, exponent)))
    }

    /// The operation with another length or diameter, if it has one.
    pub(in crate::turtle) fn map_length(self, change: impl FnOnce(f64) -> f64) -> Self {
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
