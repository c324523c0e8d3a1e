//! Compiled productions.

use crate::asking::Interpreter;
use core::ops::Range;
use lsystem_syntax::{Code, Query};

/// A letter's index in [`Rules::letters`].
pub type LetterId = u16;

/// A symbol and its number of parameters: `F` and `F(l)` are different letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Letter {
    /// The symbol.
    pub symbol: char,
    /// The number of parameters.
    pub arity: u8,
}

/// A compiled grammar: letters are small integers, and tables list the productions of each letter.
#[derive(Clone, Debug, PartialEq)]
pub struct Rules {
    /// Every letter of the axiom and the productions, sorted.
    pub letters: Vec<Letter>,
    /// By letter: whether contexts see the letter (`ignore:`, `consider:`).
    pub considered: Vec<bool>,
    /// By letter: whether the letter cuts off the rest of its branch in the next step.
    pub cuts: Vec<bool>,
    /// By letter: its productions in text order, productions with a context first.
    pub by_letter: Vec<Vec<Rule>>,
    /// By letter: its productions below `draw:`, in text order. Empty if the rules are [plain](Rules::is_plain),
    /// because the letters then have the actions of their images.
    pub images: Vec<Vec<Rule>>,
    /// By letter: its rewriting in a derivation step, or its possible rewritings.
    pub rewrites: Vec<Rewrite>,
    /// The axiom; its arguments use no slots.
    pub axiom: Template,
    /// The spans of the productions in the text, in bytes, then the spans of the productions below `draw:`. The list
    /// may be shorter.
    pub spans: Vec<Range<usize>>,
    pub(crate) plain: bool,
    /// The interpreter that answers the queries; `None` if there are none.
    pub interpreter: Option<Interpreter>,
}

/// A compiled production.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// The index in [`Grammar::productions`](lsystem_syntax::Grammar::productions), continued by
    /// [`Grammar::images`](lsystem_syntax::Grammar::images).
    pub production: usize,
    /// The left context in text order, nearest last.
    pub left: Vec<LetterId>,
    /// The right context in text order, nearest first.
    pub right: Vec<ContextPattern>,
    /// The condition: the production applies only if its value is neither 0 nor NaN.
    pub condition: Option<Code>,
    /// The weight among matching productions; `None` for a deterministic production.
    pub weight: Option<Code>,
    /// The successor. Slots number the parameters of left context, predecessor and right context in text order.
    pub successor: Template,
}

impl Rule {
    /// Whether the production has a context.
    #[must_use]
    pub fn is_context_sensitive(&self) -> bool {
        !self.left.is_empty() || !self.right.is_empty()
    }

    /// Whether the production has no condition, no weight, and at most one letter of context on each side.
    pub(crate) fn is_plain(&self) -> bool {
        self.left.len() <= 1
            && matches!(self.right.as_slice(), [] | [ContextPattern::Letter(_)])
            && self.condition.is_none()
            && self.weight.is_none()
    }
}

/// An element of a right context.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContextPattern {
    /// The next module of the axis, branches skipped.
    Letter(LetterId),
    /// The start of a branch.
    Open,
    /// The end of a branch. The rest of the branch may hold any modules.
    Close,
}

/// The compiled modules of a successor or an axiom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Template {
    /// The letters.
    pub letters: Vec<LetterId>,
    /// The compiled arguments of all modules, in order.
    pub arguments: Vec<Code>,
}

impl Template {
    /// The numbers of modules and of arguments.
    pub(crate) fn size(&self) -> [usize; 2] {
        [self.letters.len(), self.arguments.len()]
    }
}

impl Rules {
    /// Whether each letter derives independently of its neighbours, without parameters or conditions, and with constant
    /// weights.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.plain
    }

    /// The symbol of a letter.
    #[must_use]
    pub fn symbol(&self, letter: LetterId) -> char {
        self.letters[usize::from(letter)].symbol
    }

    /// The number of parameters of a letter.
    #[must_use]
    pub fn arity(&self, letter: LetterId) -> usize {
        usize::from(self.letters[usize::from(letter)].arity)
    }

    /// The letter of a symbol with `arity` parameters; `None` if the rules have no such letter.
    #[must_use]
    pub fn letter(&self, symbol: char, arity: u8) -> Option<LetterId> {
        self.letters.binary_search(&Letter { symbol, arity }).ok().map(|id| id as LetterId)
    }

    /// Whether any production has a weight or a random number, or the axiom has a random number.
    #[must_use]
    pub fn is_random(&self) -> bool {
        let random = |template: &Template| template.arguments.iter().any(Code::is_random);
        random(&self.axiom)
            || (self.by_letter.iter().chain(&self.images).flatten()).any(|rule| {
                rule.weight.is_some() || rule.condition.as_ref().is_some_and(Code::is_random) || random(&rule.successor)
            })
    }

    /// Whether the axiom or any successor contains a letter that cuts off its branch.
    #[must_use]
    pub fn is_cutting(&self) -> bool {
        let made = self.by_letter.iter().flatten().map(|rule| &rule.successor).chain([&self.axiom]);
        made.flat_map(|template| &template.letters).any(|&letter| self.cuts[usize::from(letter)])
    }

    /// By letter: the query that its modules ask, if any.
    #[must_use]
    pub fn query(&self, letter: LetterId) -> Option<Query> {
        let Letter { symbol, arity } = self.letters[usize::from(letter)];
        Query::of_symbol(symbol).filter(|_| arity > 0)
    }

    /// Whether any letter asks about its place.
    #[must_use]
    pub fn asks(&self) -> bool {
        (0..self.letters.len()).any(|letter| self.query(letter as LetterId).is_some())
    }

    /// Whether any letter has parameters.
    #[must_use]
    pub fn is_parametric(&self) -> bool {
        self.letters.iter().any(|letter| letter.arity > 0)
    }
}

/// The rewriting of a letter in one derivation step. It is exact if the rules are [plain](Rules::is_plain). Otherwise
/// it lists the possible successors with equal chances, without regard to contexts, conditions and weights.
#[derive(Clone, Debug, PartialEq)]
pub enum Rewrite {
    /// The letter has no production. The letter and its key stay.
    Keep,
    /// Always the same successor.
    Always(Vec<LetterId>),
    /// One of several successors, by weight.
    Choose(Vec<Alternative>),
}

/// One possible successor of a letter.
#[derive(Clone, Debug, PartialEq)]
pub struct Alternative {
    /// The cumulative normalised weight, including this alternative; 1.0 for the last.
    pub until: f64,
    /// The successor.
    pub successor: Vec<LetterId>,
}

impl Alternative {
    /// The index of the alternative that `roll` (uniform in `0.0..1.0`) selects, by binary search.
    #[must_use]
    pub fn of(alternatives: &[Self], roll: f64) -> usize {
        alternatives.partition_point(|alternative| alternative.until <= roll).min(alternatives.len().saturating_sub(1))
    }
}

impl Rewrite {
    /// The successor that `roll` (uniform in `0.0..1.0`) selects; `None` if the letter stays.
    #[must_use]
    pub fn successor(&self, roll: impl FnOnce() -> f64) -> Option<&[LetterId]> {
        match self {
            Self::Keep => None,
            Self::Always(successor) => Some(successor),
            Self::Choose(alternatives) => alternatives
                .get(Alternative::of(alternatives, roll()))
                .map(|alternative| alternative.successor.as_slice()),
        }
    }

    /// The only successor; `None` if the letter stays or has several possible successors.
    #[must_use]
    pub fn always(&self) -> Option<&[LetterId]> {
        if let Self::Always(word) = self { Some(word) } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_roll_chooses_by_weight() {
        let alternatives = [0.25, 0.25, 0.75, 1.0].map(|until| Alternative { until, successor: vec![] });
        let chosen = [0.0, 0.2, 0.25, 0.7, 0.75, 0.99, 1.0].map(|roll| Alternative::of(&alternatives, roll));
        assert_eq!(chosen, [0, 0, 2, 2, 3, 3, 3]);
    }
}
