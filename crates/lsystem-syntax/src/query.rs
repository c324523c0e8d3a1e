//! Query modules: modules that ask about their place. Before each derivation step the word is interpreted with the
//! turtle, and the answers replace the modules' arguments (Prusinkiewicz, James and Mech, Synthetic Topiary, 1994;
//! as in cpfg).

use core::fmt;
use lsystem_base::word;

/// The question of a query module.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Query {
    /// `?P(x,y,z)`: the turtle's position, in model units.
    Position,
    /// `?H(x,y,z)`: the unit vector ahead.
    Heading,
    /// `?L(x,y,z)`: the unit vector to the turtle's left.
    Left,
    /// `?U(x,y,z)`: the unit vector up from the turtle.
    Up,
    /// `?C(n,r)`: the number of other `?C` modules nearer than `r` model units, up to 100.
    Crowd,
    /// `?S(q,c)`: the part of the sky's light that reaches the module, 0 to 1. Each `?S` module casts a shadow below
    /// itself, in cubes whose sides are `c` model units long.
    Sky,
}

impl Query {
    /// All queries.
    pub const ALL: [Self; 6] = [Self::Position, Self::Heading, Self::Left, Self::Up, Self::Crowd, Self::Sky];

    /// The letter after `?`.
    #[must_use]
    pub fn letter(self) -> char {
        match self {
            Self::Position => 'P',
            Self::Heading => 'H',
            Self::Left => 'L',
            Self::Up => 'U',
            Self::Crowd => 'C',
            Self::Sky => 'S',
        }
    }

    /// The symbol of the query: a letter in a circle.
    #[must_use]
    pub fn symbol(self) -> char {
        match self {
            Self::Position => 'Ⓟ',
            Self::Heading => 'Ⓗ',
            Self::Left => 'Ⓛ',
            Self::Up => 'Ⓤ',
            Self::Crowd => 'Ⓒ',
            Self::Sky => 'Ⓢ',
        }
    }

    /// The query with this letter after `?`.
    #[must_use]
    pub fn of_letter(letter: char) -> Option<Self> {
        Self::ALL.into_iter().find(|query| query.letter() == letter)
    }

    /// The query of a symbol.
    #[must_use]
    pub fn of_symbol(symbol: char) -> Option<Self> {
        // Most symbols are ASCII.
        (!symbol.is_ascii()).then(|| Self::ALL.into_iter().find(|query| query.symbol() == symbol)).flatten()
    }

    /// The module's question in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Position => word!("asks for the position"),
            Self::Heading => word!("asks for the direction ahead"),
            Self::Left => word!("asks for the direction to the left"),
            Self::Up => word!("asks for the direction up from the turtle"),
            Self::Crowd => word!("asks how many of its kind are near"),
            Self::Sky => word!("asks for the light of the sky"),
        }
    }

    /// The most arguments that are answered; further ones stay as they are.
    #[must_use]
    pub fn answers(self) -> usize {
        match self {
            Self::Crowd | Self::Sky => 1,
            _ => 3,
        }
    }
}

impl fmt::Display for Query {
    /// The query as the notation writes it, such as `?P`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "?{}", self.letter())
    }
}
