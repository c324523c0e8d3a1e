//! What a symbol makes the turtle do.

/// One thing the turtle does. A symbol has a list of them, in a [`Dialect`](crate::Dialect) or overridden one by one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Go forward and draw. Length in model units, times the length scale; `None` for the system's step length. Both
    /// ends are vertices of a polygon that is open.
    Draw(Option<f64>),
    /// Go forward without drawing; length as in [`Action::Draw`].
    Move(Option<f64>),
    /// As [`Action::Draw`], without recording a vertex of an open polygon.
    DrawUnmarked(Option<f64>),
    /// As [`Action::Move`], without recording a vertex of an open polygon.
    MoveUnmarked(Option<f64>),
    /// Begin a polygon, filled in the colour that the turtle has now. What is drawn before it is closed lies upon it.
    OpenPolygon,
    /// Record where the turtle is as a vertex of the polygon that was opened last.
    Vertex,
    /// Fill the polygon that was opened last, and go on with the one around it.
    ClosePolygon,
    /// Turn counter-clockwise, by degrees or by the system's left angle.
    TurnLeft(Option<f64>),
    /// Turn clockwise, by degrees or by the system's right angle.
    TurnRight(Option<f64>),
    /// Turn by 180 degrees.
    TurnRound,
    /// Pitch the heading down, away from the turtle's up, by degrees or by the system's angle for it.
    PitchDown(Option<f64>),
    /// Pitch the heading up.
    PitchUp(Option<f64>),
    /// Roll about the heading so that the turtle's left rises.
    RollLeft(Option<f64>),
    /// Roll about the heading so that the turtle's left sinks.
    RollRight(Option<f64>),
    /// Roll about the heading until the turtle's left is level and its up is not below it.
    RollUpright,
    /// Save position, heading, colour, width and length, and go one branch level deeper.
    Push,
    /// Return to what the matching [`Action::Push`] saved.
    Pop,
    /// Use the palette's colour at this index.
    SetColour(i32),
    /// Go this many places along the palette, backwards when negative.
    AddColour(i32),
    /// Set the stroke width, in multiples of the step length.
    SetWidth(f64),
    /// Multiply the stroke width.
    ScaleWidth(f64),
    /// In the next derivation step the branch ends here: this symbol and all that follows it in its branch is gone. Does
    /// nothing when drawn.
    Cut,
}

impl Action {
    /// The same by this number, a module's first argument: a length, degrees, a width, a palette index. What has no
    /// number stays; what changes a width or a colour by steps sets it instead.
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
            // Out of range it is the nearest that there is.
            Self::SetColour(_) | Self::AddColour(_) => Self::SetColour(libm::floor(number) as i32),
            Self::SetWidth(_) | Self::ScaleWidth(_) => Self::SetWidth(number),
        }
    }

    /// Whether it draws a segment.
    #[must_use]
    pub fn draws(self) -> bool {
        matches!(self, Self::Draw(_) | Self::DrawUnmarked(_))
    }

    /// The same without recording vertices.
    #[must_use]
    pub fn unmarked(self) -> Self {
        match self {
            Self::Draw(length) => Self::DrawUnmarked(length),
            Self::Move(length) => Self::MoveUnmarked(length),
            other => other,
        }
    }

    /// Whether it leads out of the plane.
    #[must_use]
    pub fn is_solid(self) -> bool {
        use Action::{PitchDown, PitchUp, RollLeft, RollRight, RollUpright};
        matches!(self, PitchDown(_) | PitchUp(_) | RollLeft(_) | RollRight(_) | RollUpright)
    }
}
