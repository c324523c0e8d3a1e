//! Named tables of what symbols do.

use crate::Action;
use serde::{Deserialize, Serialize};

/// A named table symbol -> actions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Dialect {
    /// The Algorithmic Beauty of Plants, section 1.3 and 1.5, and cpfg's additions.
    #[default]
    Abop,
    /// Every symbol except `+ - [ ]` draws (the course in C++).
    EveryLetter,
    /// `F` and `G` draw, with a left and a right angle (the course in Python).
    Practical,
    /// Lower-case letters draw; `+` also sets red and `-` green, from blue.
    Lowercase,
    /// `F` draws; turns about the x, y and z axes of a turtle that goes along its y (Of Trees and Turtles).
    Axes,
}

impl Dialect {
    /// All dialects, in the order to offer them.
    pub const ALL: [Self; 5] = [Self::Abop, Self::EveryLetter, Self::Practical, Self::Lowercase, Self::Axes];

    /// Their names in files, in the same order.
    pub const NAMES: [&str; 5] = ["abop", "every-letter", "practical", "lowercase", "axes"];

    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// What `symbol` does; empty for a symbol without action.
    #[must_use]
    pub fn actions(self, symbol: char) -> &'static [Action] {
        use Action::{Draw, Move, PitchDown, PitchUp, Pop, Push, RollLeft, RollRight, TurnLeft, TurnRight};
        match (self, symbol) {
            (Self::Lowercase, '+') => &[TurnLeft(None), Action::SetColour(1)],
            (Self::Lowercase, '-') => &[TurnRight(None), Action::SetColour(2)],
            // About its y, along which it goes; x is to its right, z above it.
            (Self::Axes, '+') => &[RollLeft(None)],
            (Self::Axes, '-') => &[RollRight(None)],
            (Self::Axes, 'v') => &[PitchUp(None)],
            (Self::Axes, '^') => &[PitchDown(None)],
            (Self::Axes, '>') => &[TurnLeft(None)],
            (Self::Axes, '<') => &[TurnRight(None)],
            (Self::Axes, 'F') => &[Draw(None)],
            (_, '+') => &[TurnLeft(None)],
            (_, '-') => &[TurnRight(None)],
            (_, '[') => &[Push],
            (_, ']') => &[Pop],
            (Self::Abop | Self::Practical, 'F' | 'G') => &[Draw(None)],
            (Self::Abop, 'f' | 'g') => &[Move(None)],
            (Self::Abop, '|') => &[Action::TurnRound],
            (Self::Abop, '&') => &[PitchDown(None)],
            (Self::Abop, '^') => &[PitchUp(None)],
            (Self::Abop, '\\') => &[RollLeft(None)],
            (Self::Abop, '/') => &[RollRight(None)],
            (Self::Abop, '$') => &[Action::RollUpright],
            // The course's matrices R_L and R_H turn about the x and y of a turtle that goes along its x.
            (Self::Practical, '&') => &[RollLeft(None)],
            (Self::Practical, '^') => &[RollRight(None)],
            (Self::Practical, '>') => &[PitchDown(None)],
            (Self::Practical, '<') => &[PitchUp(None)],
            (Self::Abop, '!') => &[Action::ScaleWidth(core::f64::consts::FRAC_1_SQRT_2)],
            (Self::Abop, '#') => &[Action::ScaleWidth(core::f64::consts::SQRT_2)],
            (Self::Abop, '\'' | ',') => &[Action::AddColour(1)],
            (Self::Abop, ';') => &[Action::AddColour(-1)],
            (Self::Abop, '%') => &[Action::Cut],
            (Self::Abop, '{') => &[Action::OpenPolygon],
            (Self::Abop, '.') => &[Action::Vertex],
            (Self::Abop, '}') => &[Action::ClosePolygon],
            (Self::EveryLetter, _) => &[Draw(None)],
            (Self::Lowercase, c) if c.is_lowercase() => &[Draw(None)],
            _ => &[],
        }
    }
}
