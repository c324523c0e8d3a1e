//! Compiled productions.

use crate::expr::Code;
use core::ops::Range;

/// A letter's place in [`Rules::letters`].
pub type LetterId = u16;

/// A symbol with a number of parameters: `F` and `F(l)` are different letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Letter {
    /// The symbol.
    pub symbol: char,
    /// How many parameters it has.
    pub arity: u8,
}

/// A compiled grammar with contexts or parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Rules {
    /// Every letter of the axiom and the productions, sorted.
    pub letters: Vec<Letter>,
    /// By letter: whether contexts see it (`ignore:`, `consider:`).
    pub considered: Vec<bool>,
    /// By letter: its productions, those with a context first, in text order within each class.
    pub by_letter: Vec<Vec<Rule>>,
    /// By letter: its productions below `draw:`, in text order.
    pub images: Vec<Vec<Rule>>,
    /// The axiom; its arguments use no slots.
    pub axiom: Vec<Template>,
    /// Where the productions stand in the text, then those below `draw:`; may be shorter.
    pub spans: Vec<Range<usize>>,
}

/// One production.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Its index in [`Grammar::productions`](crate::Grammar::productions), those of
    /// [`Grammar::images`](crate::Grammar::images) counted on.
    pub production: usize,
    /// The left context, nearest last, as it is written.
    pub left: Vec<LetterId>,
    /// The right context, nearest first, as it is written.
    pub right: Vec<ContextPattern>,
    /// Applies only where this is true.
    pub condition: Option<Code>,
    /// Its weight among those that match.
    pub weight: Option<Code>,
    /// What replaces the module. Slots number the parameters of left context, predecessor and right context, in the
    /// order they are written.
    pub successor: Vec<Template>,
}

impl Rule {
    /// Whether it has a context.
    #[must_use]
    pub fn is_context_sensitive(&self) -> bool {
        !self.left.is_empty() || !self.right.is_empty()
    }

    /// Whether it applies by its letters alone, at most one to each side.
    pub(super) fn is_plain(&self) -> bool {
        self.left.len() <= 1
            && matches!(self.right.as_slice(), [] | [ContextPattern::Letter(_)])
            && self.condition.is_none()
            && self.weight.is_none()
    }
}

/// A piece of a right context.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContextPattern {
    /// The next module of the axis, branches skipped.
    Letter(LetterId),
    /// A branch that starts here.
    Open,
    /// Leave the branch, whatever else it holds.
    Close,
}

/// A module to be made: a letter and how its arguments are computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Template {
    /// The letter.
    pub letter: LetterId,
    /// Its arguments.
    pub arguments: Vec<Code>,
}

impl Rules {
    /// The letter for a symbol with `arity` parameters.
    #[must_use]
    pub fn letter(&self, symbol: char, arity: u8) -> Option<LetterId> {
        self.letters.binary_search(&Letter { symbol, arity }).ok().map(|id| id as LetterId)
    }

    /// Whether random choices or numbers play a part anywhere.
    #[must_use]
    pub fn is_random(&self) -> bool {
        let random = |template: &Template| template.arguments.iter().any(Code::is_random);
        let axiom = self.axiom.iter().any(random);
        axiom
            || (self.by_letter.iter().chain(&self.images).flatten()).any(|rule| {
                rule.weight.is_some()
                    || rule.condition.as_ref().is_some_and(Code::is_random)
                    || rule.successor.iter().any(random)
            })
    }

    /// Whether any module has parameters.
    #[must_use]
    pub fn is_parametric(&self) -> bool {
        self.letters.iter().any(|letter| letter.arity > 0)
    }
}
