//! Named tables of the symbols' actions.

use crate::{Action, Outline};
use lsystem_base::named;

/// A named table from symbols to actions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
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

named!(Dialect: Abop "abop", EveryLetter "every-letter", Practical "practical", Lowercase "lowercase", Axes "axes");

impl Dialect {
    /// The dialect's title and a description of its symbols, in English.
    #[must_use]
    pub const fn words(self) -> [&'static str; 2] {
        match self {
            Self::Abop => [
                "Algorithmic Beauty of Plants",
                "F and G draw, f and g move; + and − turn, | turns round, [ and ] branch; ! thins and # thickens the \
                 stroke, ; and , step through the colours. { and } fill the polygon whose corners F, f and . mark, ● and ○ \
                 draw a disc and a circle. In space & and ^ pitch down and up, \\ and / roll left and right, and $ rolls \
                 upright. Other symbols do nothing.",
            ],
            Self::EveryLetter => [
                "Every letter draws",
                "Every symbol draws one step, except + and −, which turn, and [ and ], which branch.",
            ],
            Self::Practical => [
                "Practical: F and G draw",
                "F and G draw; + turns left and − turns right, each by its own angle; in space > and < pitch down and \
                 up, & and ^ roll left and right; [ and ] branch. Other symbols do nothing.",
            ],
            Self::Lowercase => [
                "Lower-case letters draw",
                "Every lower-case letter draws; + turns left and takes the second colour, − turns right and takes the \
                 third; [ and ] branch.",
            ],
            Self::Axes => [
                "Turns about axes",
                "F draws; > and < turn left and right, v and ^ pitch up and down, + and − roll left and right: turns \
                 about the z, x and y axes of a turtle that goes along its y; [ and ] branch. Other symbols do nothing.",
            ],
        }
    }

    /// The actions of `symbol`; empty for a symbol without action.
    #[must_use]
    pub fn actions(self, symbol: char) -> &'static [Action] {
        use Action::{Draw, Move, PitchDown, PitchUp, Pop, Push, RollLeft, RollRight, TurnLeft, TurnRight};
        match (self, symbol) {
            (Self::Lowercase, '+') => &[TurnLeft(None), Action::SetColour(1)],
            (Self::Lowercase, '-') => &[TurnRight(None), Action::SetColour(2)],
            // This turtle goes along its y axis; x points to its right and z up. `+` and `-` turn about y: a roll.
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
            // As in cpfg and L-Py: `;` raises the palette index and `,` lowers it. `'` is ABOP's own.
            (Self::Abop, '\'' | ';') => &[Action::AddColour(1)],
            (Self::Abop, ',') => &[Action::AddColour(-1)],
            (Self::Abop, '○') => &[Action::Circle(None)],
            (Self::Abop, '●') => &[Action::Fill(Outline::Disc, None)],
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
