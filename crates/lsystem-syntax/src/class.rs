//! What a character of a text belongs to, for showing texts in colours.

/// What a character of a text belongs to. Each class is also a letter, so that the classes of a text make a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Class {
    /// White space, symbols that have no class of their own, and what could not be read.
    #[default]
    Plain = b'_',
    /// A comment.
    Comment = b'c',
    /// A heading: `ignore:`, `consider:`, `draw:`, `#define`.
    Heading = b'h',
    /// The arrow, and what separates contexts, condition, weight and values: `<`, `>`, `:`, `=`.
    Mark = b'm',
    /// The strict predecessor, or the symbol whose actions follow.
    Predecessor = b'p',
    /// A left or right context.
    Context = b'x',
    /// A condition.
    Condition = b'i',
    /// A weight.
    Weight = b'w',
    /// A named constant, where it is given a value and where it is used.
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
    /// Its letter.
    #[must_use]
    pub fn letter(self) -> char {
        char::from(self as u8)
    }

    /// What a symbol of an axiom or a successor is.
    pub(crate) fn of_symbol(symbol: char) -> Self {
        match symbol {
            '[' | ']' | '{' | '}' => Self::Bracket,
            '+' | '-' | '&' | '^' | '\\' | '/' | '|' | '<' | '>' | '$' => Self::Turn,
            _ => Self::Plain,
        }
    }
}
