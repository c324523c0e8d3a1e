//! A parsed L-system: its axiom and productions.

use crate::code::{Code, Meaning};
use crate::curve::Curve;
use crate::expr::Expr;
use crate::shape::Shape;
use lsystem_base::sorted::{set, sort};
use std::sync::Arc;

/// An L-system's grammar: axiom, productions and named constants, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Grammar {
    /// The axiom (generation 0). Its arguments name constants only.
    pub axiom: Vec<Module>,
    /// Productions in text order. The order decides between productions that match.
    pub productions: Vec<Production>,
    /// Productions below `draw:`, in text order: a homomorphism, applied once to the modules of the last generation
    /// before they are drawn. They have no contexts.
    pub images: Vec<Production>,
    /// Named constants in text order. A constant may use earlier constants.
    pub constants: Vec<Constant>,
    /// Named shapes in text order.
    pub shapes: Vec<NamedShape>,
    /// Named curves in text order.
    pub curves: Vec<NamedCurve>,
    /// The symbols that contexts see.
    pub seen: Seen,
}

/// The symbols that contexts see. `[` and `]` always delimit branches.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Seen {
    /// All symbols.
    #[default]
    All,
    /// All symbols except these: `ignore: +-F`.
    Except(Vec<char>),
    /// Only these symbols: `consider: AB`.
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

/// The symbols that contexts see, sorted for fast look-up.
pub struct SeenSymbols {
    listed: Vec<char>,
    /// Whether contexts see the symbols that are not in the list.
    others: bool,
}

impl Seen {
    /// Sorts the symbols for fast look-up.
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
    /// Whether contexts see `symbol`.
    pub fn contains(&self, symbol: char) -> bool {
        self.listed.binary_search(&symbol).is_ok() != self.others
    }
}

/// The values of constants, sorted by name for fast look-up, the shapes and the curves.
pub struct Values<'a>(Vec<(&'a str, usize, f64)>, &'a [NamedShape], &'a [NamedCurve]);

impl Values<'_> {
    /// The value of a constant.
    pub fn of(&self, name: &str) -> Option<f64> {
        let at = self.0.partition_point(|&(known, ..)| known < name);
        self.0.get(at).filter(|&&(known, ..)| known == name).map(|&(.., value)| value)
    }

    /// The meaning of a name.
    #[must_use]
    pub fn meaning(&self, name: &str) -> Option<Meaning> {
        let shape = || self.1.iter().find(|shape| shape.name == name).map(|found| Meaning::Shape(found.shape.clone()));
        let curve = || self.2.iter().find(|curve| curve.name == name).map(|found| Meaning::Curve(found.curve.clone()));
        self.of(name).map(Meaning::Constant).or_else(shape).or_else(curve)
    }

    /// The value of an expression of constants; `None` if it has parameters, random numbers or unknown names.
    pub fn value(&self, expr: &Expr) -> Option<f64> {
        match Code::new(expr, &|name: &str| self.meaning(name), &mut 0) {
            Ok(Code::Constant(value)) => Some(value),
            _ => None,
        }
    }
}

/// One module of an axiom or a successor.
#[derive(Clone, Debug, PartialEq)]
pub struct Module {
    /// The symbol: any character. The notation has white space only as a literal.
    pub symbol: char,
    /// The arguments, at most [`MAX_PARAMETERS`](lsystem_base::MAX_PARAMETERS). The same symbol with a different number of
    /// arguments is a different letter.
    pub arguments: Vec<Expr>,
}

/// A module of a predecessor or a context.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// The symbol.
    pub symbol: char,
    /// The names of its parameters, each unique in the production.
    pub parameters: Vec<String>,
}

/// `left < predecessor > right : condition -> successor : weight`.
#[derive(Clone, Debug, PartialEq)]
pub struct Production {
    /// The left context, along the path to the root, nearest last; empty if there is none.
    pub left: Vec<Pattern>,
    /// The module that is replaced: the strict predecessor.
    pub predecessor: Pattern,
    /// The right context, nearest first, with `[` and `]` around branches; empty if there is none.
    pub right: Vec<Pattern>,
    /// The condition: the production applies only if its value is neither 0 nor NaN.
    pub condition: Option<Expr>,
    /// The successor; an empty successor deletes the module.
    pub successor: Vec<Module>,
    /// The weight; `None` for a deterministic production. Weights need not sum to 1; a weight below 0 counts as 0.
    pub weight: Option<Expr>,
}

/// `name = value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// The name: a letter or `_`, then letters, digits or `_`.
    pub name: String,
    /// The value, always finite.
    pub value: f64,
}

/// `shape name = ball(0, 10, 0, 5) - …`
#[derive(Clone, Debug, PartialEq)]
pub struct NamedShape {
    /// The name, as that of a constant.
    pub name: String,
    /// The shape.
    pub shape: Arc<Shape>,
}

/// `curve name = (0, 1) (0.4, 0.8) …`
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCurve {
    /// The name, as that of a constant.
    pub name: String,
    /// The curve.
    pub curve: Arc<Curve>,
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
    /// A production `predecessor -> successor` without contexts, condition and weight.
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

    /// The production with this weight.
    #[must_use]
    pub fn weighted(self, weight: f64) -> Self {
        Self { weight: Some(Expr::Number(weight)), ..self }
    }

    /// The patterns of left context, predecessor and right context, in text order.
    pub fn patterns(&self) -> impl Iterator<Item = &Pattern> {
        self.left.iter().chain([&self.predecessor]).chain(&self.right)
    }

    /// Whether the production has a context.
    #[must_use]
    pub fn is_context_sensitive(&self) -> bool {
        !self.left.is_empty() || !self.right.is_empty()
    }

    /// Whether the production has no contexts, parameters, condition or arguments.
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

    /// The constants, sorted for fast look-up.
    pub fn values(&self) -> Values<'_> {
        let constants = self.constants.iter().enumerate();
        // Sorted by name, then by place.
        let mut order: Vec<(&str, usize)> = constants.map(|(at, constant)| (constant.name.as_str(), at)).collect();
        sort(&mut order);
        let values = order.into_iter().map(|(name, at)| (name, at, self.constants[at].value));
        Values(values.collect(), &self.shapes, &self.curves)
    }

    /// The value of an expression of constants; `None` if it has parameters, random numbers or unknown names.
    #[must_use]
    pub fn value(&self, expr: &Expr) -> Option<f64> {
        self.values().value(expr)
    }

    /// The modules of the axiom and of all successors, except successors for drawing.
    pub fn made(&self) -> impl Iterator<Item = &Module> {
        self.axiom.iter().chain(self.productions.iter().flat_map(|production| &production.successor))
    }

    /// Whether each symbol derives independently of its neighbours. This is so if the grammar has no contexts,
    /// parameters or conditions, all weights are constant, and productions for drawing have no weights.
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
