//! What an L-system's axiom and productions say: the result of reading the notation, the input of everything else.

use crate::code::{Code, Meaning};
use crate::expr::Expr;
use crate::sorted::{set, sort};

/// An L-system's grammar: axiom, productions and named constants, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grammar {
    /// The axiom (generation 0). Its arguments name constants only.
    pub axiom: Vec<Module>,
    /// Productions in text order, which decides between those that match.
    pub productions: Vec<Production>,
    /// Productions below `draw:`, in text order: applied once to the modules of the last generation, when it is drawn
    /// (a homomorphism). They have no contexts.
    pub images: Vec<Production>,
    /// Named constants in text order; a later one may use an earlier one.
    pub constants: Vec<Constant>,
    /// Which symbols contexts see.
    pub seen: Seen,
}

/// Which symbols contexts see; `[` and `]` are branches to them in any case.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Seen {
    /// All.
    #[default]
    All,
    /// All but these: `ignore: +-F`.
    Except(Vec<char>),
    /// These: `consider: AB`.
    Only(Vec<char>),
}

impl Seen {
    /// Whether contexts see `symbol`.
    #[must_use]
    pub fn contains(&self, symbol: char) -> bool {
        match self {
            Self::All => true,
            Self::Except(list) => !list.contains(&symbol),
            Self::Only(list) => list.contains(&symbol),
        }
    }
}

/// A list of symbols, or none, ready to be looked into often.
pub struct SeenSymbols {
    listed: Vec<char>,
    /// What it says of those that are not in the list.
    others: bool,
}

impl Seen {
    /// The same, ready to be looked into often.
    pub fn ready(&self) -> SeenSymbols {
        let (list, others) = match self {
            Self::All => (&[][..], true),
            Self::Except(list) => (&list[..], true),
            Self::Only(list) => (&list[..], false),
        };
        SeenSymbols { listed: set(list.iter().copied()), others }
    }
}

impl SeenSymbols {
    /// As [`Seen::contains`].
    pub fn contains(&self, symbol: char) -> bool {
        self.listed.binary_search(&symbol).is_ok() != self.others
    }
}

/// Values by name, ready to be looked into often.
pub struct Values<'a>(Vec<(&'a str, usize, f64)>);

impl Values<'_> {
    /// The value of a constant.
    pub fn of(&self, name: &str) -> Option<f64> {
        let at = self.0.partition_point(|&(known, ..)| known < name);
        self.0.get(at).filter(|&&(known, ..)| known == name).map(|&(.., value)| value)
    }

    /// The value of an expression of constants; `None` where parameters or chance play a part.
    pub fn value(&self, expr: &Expr) -> Option<f64> {
        match Code::new(expr, &|name: &str| self.of(name).map(Meaning::Constant), &mut 0) {
            Ok(Code::Constant(value)) => Some(value),
            _ => None,
        }
    }
}

/// One letter of the derived word.
#[derive(Clone, Debug, PartialEq)]
pub struct Module {
    /// The symbol: any character that is not white space, and white space only as a literal.
    pub symbol: char,
    /// Its arguments, at most [`MAX_PARAMETERS`](crate::MAX_PARAMETERS). A symbol with another number of arguments is
    /// another letter.
    pub arguments: Vec<Expr>,
}

/// A module to be matched.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// The symbol.
    pub symbol: char,
    /// The names of its parameters, each different from all others of the production.
    pub parameters: Vec<String>,
}

/// `left < predecessor > right : condition -> successor : weight`.
#[derive(Clone, Debug, PartialEq)]
pub struct Production {
    /// What must stand on the way to the root, nearest last; empty where it does not matter.
    pub left: Vec<Pattern>,
    /// The module that is replaced: the strict predecessor.
    pub predecessor: Pattern,
    /// What must follow, nearest first, with `[` and `]` around branches; empty where it does not matter.
    pub right: Vec<Pattern>,
    /// Applies only where this is not 0.
    pub condition: Option<Expr>,
    /// What replaces it; empty deletes it.
    pub successor: Vec<Module>,
    /// `None` for a deterministic production. Weights need not sum to 1; one that is not above 0 counts as 0.
    pub weight: Option<Expr>,
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
        Self { symbol, arguments: Vec::new() }
    }
}

impl From<char> for Pattern {
    fn from(symbol: char) -> Self {
        Self { symbol, parameters: Vec::new() }
    }
}

impl Production {
    /// `predecessor -> successor` without anything else.
    #[must_use]
    pub fn new(predecessor: char, successor: Vec<Module>) -> Self {
        Self {
            left: Vec::new(),
            predecessor: predecessor.into(),
            right: Vec::new(),
            condition: None,
            successor,
            weight: None,
        }
    }

    /// The same with a weight.
    #[must_use]
    pub fn weighted(self, weight: f64) -> Self {
        Self { weight: Some(Expr::Number(weight)), ..self }
    }

    /// Left context, predecessor and right context, in the order they are written.
    pub fn patterns(&self) -> impl Iterator<Item = &Pattern> {
        self.left.iter().chain([&self.predecessor]).chain(&self.right)
    }

    /// Whether it has a context.
    #[must_use]
    pub fn is_context_sensitive(&self) -> bool {
        !self.left.is_empty() || !self.right.is_empty()
    }

    /// Whether its symbol alone decides where it applies, and what it makes are symbols alone.
    fn is_plain(&self) -> bool {
        !self.is_context_sensitive()
            && self.predecessor.parameters.is_empty()
            && self.condition.is_none()
            && self.successor.iter().all(|module| module.arguments.is_empty())
    }
}

impl Grammar {
    /// The value of a constant.
    #[must_use]
    pub fn constant(&self, name: &str) -> Option<f64> {
        self.constants.iter().find(|constant| constant.name == name).map(|constant| constant.value)
    }

    /// The constants, ready to be looked up often.
    pub fn values(&self) -> Values<'_> {
        let constants = self.constants.iter().enumerate();
        // Names and places order them; values need not.
        let mut order: Vec<(&str, usize)> = constants.map(|(at, constant)| (constant.name.as_str(), at)).collect();
        sort(&mut order);
        Values(order.into_iter().map(|(name, at)| (name, at, self.constants[at].value)).collect())
    }

    /// The value of an expression of constants; `None` where parameters or chance play a part.
    #[must_use]
    pub fn value(&self, expr: &Expr) -> Option<f64> {
        self.values().value(expr)
    }

    /// The modules of the axiom and of all successors but those for drawing.
    pub fn made(&self) -> impl Iterator<Item = &Module> {
        self.axiom.iter().chain(self.productions.iter().flat_map(|production| &production.successor))
    }

    /// Whether it is context-free and without parameters, so that every symbol derives by itself: with conditions
    /// nowhere, weights that are numbers, and each symbol drawn in one way only.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        let values = self.values();
        self.axiom.iter().all(|module| module.arguments.is_empty())
            && self
                .productions
                .iter()
                .all(|p| p.is_plain() && p.weight.as_ref().is_none_or(|w| values.value(w).is_some()))
            && self.images.iter().all(|p| p.is_plain() && p.weight.is_none())
    }
}
