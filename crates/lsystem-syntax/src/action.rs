//! The turtle's actions.

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
    /// Save position, heading, colour, width and length, and go one branch level deeper.
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
    /// In the next derivation step, remove this symbol and the rest of its branch. The turtle ignores the symbol.
    Cut,
}

impl Action {
    /// The action with a module's first argument as its number: a length, degrees, a width or a palette index. Actions
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
            Self::TurnRound
            | Self::RollUpright
            | Self::Push
            | Self::Pop
            | Self::Cut
            | Self::OpenPolygon
            | Self::Vertex
            | Self::ClosePolygon => self,
            // The cast takes the nearest `i32` for numbers out of range.
            Self::SetColour(_) | Self::AddColour(_) => Self::SetColour(libm::floor(number) as i32),
            Self::SetWidth(_) | Self::ScaleWidth(_) => Self::SetWidth(number),
        }
    }

    /// Whether the action draws a segment.
    #[must_use]
    pub fn draws(self) -> bool {
        matches!(self, Self::Draw(_) | Self::DrawUnmarked(_))
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
