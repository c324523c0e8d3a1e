//! What an L-system's axiom and productions say: the result of reading the notation, the input of everything else.

/// An L-system's grammar: axiom, productions and named constants, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grammar {
    /// The axiom (generation 0).
    pub axiom: Vec<Module>,
    /// Productions in text order, which decides between those that match.
    pub productions: Vec<Production>,
    /// Named constants in text order; a later one may use an earlier one.
    pub constants: Vec<Constant>,
}

/// One letter of the derived word.
#[derive(Clone, Debug, PartialEq)]
pub struct Module {
    /// The letter: any character that is not white space, and white space only as a literal.
    pub symbol: char,
}

/// `predecessor -> successor : weight`.
#[derive(Clone, Debug, PartialEq)]
pub struct Production {
    /// The module that is replaced.
    pub predecessor: Module,
    /// What replaces it; empty deletes it.
    pub successor: Vec<Module>,
    /// Positive and finite; `None` for a deterministic production. Weights need not sum to 1.
    pub weight: Option<f64>,
}

/// `name = value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// A letter or `_`, then letters, digits or `_`.
    pub name: String,
    /// Finite.
    pub value: f64,
}

impl From<char> for Module {
    fn from(symbol: char) -> Self {
        Self { symbol }
    }
}
