//! Classes of characters, for syntax colours.

/// The part of the notation that a character belongs to. Each class has a letter, so that a string holds all classes of
/// a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Class {
    /// White space, symbols without a class of their own, and unreadable text.
    #[default]
    Plain = b'_',
    /// A comment.
    Comment = b'c',
    /// A heading: `ignore:`, `consider:`, `draw:`, `#define`.
    Heading = b'h',
    /// The arrow, and the separators of contexts, conditions, weights and values: `<`, `>`, `:`, `=`.
    Mark = b'm',
    /// The strict predecessor, or the symbol of an override.
    Predecessor = b'p',
    /// A left or right context.
    Context = b'x',
    /// A condition.
    Condition = b'i',
    /// A weight.
    Weight = b'w',
    /// A named constant, at its definition and at its uses.
    Constant = b'k',
    /// A parameter.
    Parameter = b'a',
    /// A function.
    Function = b'f',
    /// A number in a value or an argument.
    Number = b'n',
    /// A bracket of an axiom or a successor: `[ ] { }`.
    Bracket = b'b',
    /// A symbol that turns in most dialects, in an axiom or a successor.
    Turn = b't',
}

impl Class {
    /// The letter of the class.
    #[must_use]
    pub fn letter(self) -> char {
        char::from(self as u8)
    }

    /// The class of a symbol in an axiom or a successor.
    pub(crate) fn of_symbol(symbol: char) -> Self {
        match symbol {
            '[' | ']' | '{' | '}' => Self::Bracket,
            '+' | '-' | '&' | '^' | '\\' | '/' | '|' | '<' | '>' | '$' => Self::Turn,
            _ => Self::Plain,
        }
    }
}
