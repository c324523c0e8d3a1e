//! The turtle's actions.

use crate::Outline;

/// The number of sides of a circle and of a disc. With 32 sides, the sides stay within half a pixel of a true circle
/// with a diameter of up to 200 pixels.
pub const CIRCLE_SIDES: u32 = 32;

/// The number of strokes of a part of a tube. With 8 strokes, a part whose headings differ from its chord by up to 60
/// degrees stays within 1/90 of the length of the chord of the true curve.
pub const TUBE_STROKES: u32 = 8;

/// One action of the turtle. Each symbol has a list of actions, from the [`Dialect`](crate::Dialect) or an override.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Go forward and draw. The length is in model units, times the length scale; `None` is the system's step length.
    /// The end becomes a vertex of an open polygon; the start, too, if the polygon has no vertex yet.
    Draw(Option<f64>),
    /// Go forward without drawing. Length and vertices as in [`Action::Draw`].
    Move(Option<f64>),
    /// As [`Action::Draw`], without recording a vertex of an open polygon.
    DrawUnmarked(Option<f64>),
    /// As [`Action::Move`], without recording a vertex of an open polygon.
    MoveUnmarked(Option<f64>),
    /// Open a polygon, filled in the turtle's current colour. Strokes drawn before it is closed lie on top of it.
    OpenPolygon,
    /// Record the turtle's position as a vertex of the innermost open polygon.
    Vertex,
    /// Fill the innermost open polygon, and continue with the polygon around it.
    ClosePolygon,
    /// Turn counter-clockwise, by degrees; `None` is the system's left angle.
    TurnLeft(Option<f64>),
    /// Turn clockwise, by degrees; `None` is the system's right angle.
    TurnRight(Option<f64>),
    /// Turn by 180 degrees.
    TurnRound,
    /// Pitch the heading down, away from the turtle's up, by degrees; `None` is the system's pitch angle.
    PitchDown(Option<f64>),
    /// Pitch the heading up, towards the turtle's up, by degrees; `None` is the system's pitch angle.
    PitchUp(Option<f64>),
    /// Roll about the heading so that the turtle's left rises, by degrees; `None` is the system's roll angle.
    RollLeft(Option<f64>),
    /// Roll about the heading so that the turtle's left sinks, by degrees; `None` is the system's roll angle.
    RollRight(Option<f64>),
    /// Roll about the heading until the turtle's left is level and its up does not point below the horizon.
    RollUpright,
    /// Save position, heading, colour, width, length and the exchange of turns, and go one branch level deeper.
    Push,
    /// Restore the state that the matching [`Action::Push`] saved.
    Pop,
    /// Set the palette index, 0-based.
    SetColour(i32),
    /// Add to the palette index.
    AddColour(i32),
    /// Set the stroke width, in multiples of the step length.
    SetWidth(f64),
    /// Multiply the stroke width.
    ScaleWidth(f64),
    /// Multiply all lengths from here on.
    ScaleLength(f64),
    /// From here on, exchange left and right turns: [`Action::TurnLeft`] and [`Action::TurnRight`] do what the other
    /// does. A second exchange ends the first.
    SwapTurns,
    /// Draw a circle around the turtle, in the plane of its heading and its left. The diameter is in model units, times
    /// the length scale; `None` is the system's step length. The circle is drawn as [`CIRCLE_SIDES`] segments.
    Circle(Option<f64>),
    /// Fill an outline in the turtle's current colour, in the plane of its heading and its left. The size is in model
    /// units, times the length scale; `None` is the system's step length.
    Fill(Outline, Option<f64>),
    /// Begin a tube here: a generalized cylinder, as `@Gs` of cpfg.
    OpenTube,
    /// Draw the tube up to here, as `@Gc` of cpfg: a smooth curve from the last point of the tube on this branch, which
    /// may be in the branch around it. The curve leaves the last point and reaches this one along the turtle's headings
    /// there. The width changes evenly from the one to the other. The curve is drawn as [`TUBE_STROKES`] segments.
    /// Without [`Action::OpenTube`], the tube begins where the turtle starts.
    TubePoint,
    /// Draw the tube up to here and end it, as `@Ge` of cpfg.
    CloseTube,
    /// Draw the surface of this name at the turtle, in its current colour. The size is in model units, times the length
    /// scale; `None` is the system's step length.
    Surface(char, Option<f64>),
    /// In the next derivation step, remove this symbol and the rest of its branch. The turtle ignores the symbol.
    Cut,
}

impl Action {
    /// The action with a module's first argument as its number: a length, degrees, a width, a factor or a palette
    /// index. Actions
    /// without a number stay the same. [`Action::AddColour`] and [`Action::ScaleWidth`] become [`Action::SetColour`]
    /// and [`Action::SetWidth`].
    #[must_use]
    pub fn with(self, number: f64) -> Self {
        match self {
            Self::Draw(_) => Self::Draw(Some(number)),
            Self::Move(_) => Self::Move(Some(number)),
            Self::DrawUnmarked(_) => Self::DrawUnmarked(Some(number)),
            Self::MoveUnmarked(_) => Self::MoveUnmarked(Some(number)),
            Self::TurnLeft(_) => Self::TurnLeft(Some(number)),
            Self::TurnRight(_) => Self::TurnRight(Some(number)),
            Self::PitchDown(_) => Self::PitchDown(Some(number)),
            Self::PitchUp(_) => Self::PitchUp(Some(number)),
            Self::RollLeft(_) => Self::RollLeft(Some(number)),
            Self::RollRight(_) => Self::RollRight(Some(number)),
            Self::ScaleLength(_) => Self::ScaleLength(number),
            Self::Circle(_) => Self::Circle(Some(number)),
            Self::Fill(outline, _) => Self::Fill(outline, Some(number)),
            Self::Surface(name, _) => Self::Surface(name, Some(number)),
            Self::TurnRound
            | Self::SwapTurns
            | Self::RollUpright
            | Self::Push
            | Self::Pop
            | Self::Cut
            | Self::OpenPolygon
            | Self::Vertex
            | Self::ClosePolygon
            | Self::OpenTube
            | Self::TubePoint
            | Self::CloseTube => self,
            // The cast takes the nearest `i32` for numbers out of range.
            Self::SetColour(_) | Self::AddColour(_) => Self::SetColour(libm::floor(number) as i32),
            Self::SetWidth(_) | Self::ScaleWidth(_) => Self::SetWidth(number),
        }
    }

    /// Whether the action goes forward and draws.
    #[must_use]
    pub fn draws(self) -> bool {
        matches!(self, Self::Draw(_) | Self::DrawUnmarked(_))
    }

    /// The number of segments that the action draws.
    #[must_use]
    pub fn segments(self) -> u64 {
        match self {
            Self::Draw(_) | Self::DrawUnmarked(_) => 1,
            Self::Circle(_) => u64::from(CIRCLE_SIDES),
            Self::TubePoint | Self::CloseTube => u64::from(TUBE_STROKES),
            _ => 0,
        }
    }

    /// The action's length or diameter, if the action has one: `Some(None)` is the system's step length.
    #[must_use]
    pub fn length(self) -> Option<Option<f64>> {
        match self {
            Self::Draw(length) | Self::DrawUnmarked(length) => Some(length),
            Self::Move(length) | Self::MoveUnmarked(length) => Some(length),
            Self::Circle(length) | Self::Fill(_, length) | Self::Surface(_, length) => Some(length),
            _ => None,
        }
    }

    /// The action without recording vertices.
    #[must_use]
    pub fn unmarked(self) -> Self {
        match self {
            Self::Draw(length) => Self::DrawUnmarked(length),
            Self::Move(length) => Self::MoveUnmarked(length),
            other => other,
        }
    }

    /// Whether the action leads out of the plane: a pitch or a roll.
    #[must_use]
    pub fn is_solid(self) -> bool {
        use Action::{PitchDown, PitchUp, RollLeft, RollRight, RollUpright};
        matches!(self, PitchDown(_) | PitchUp(_) | RollLeft(_) | RollRight(_) | RollUpright)
    }
}
