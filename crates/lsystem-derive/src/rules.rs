//! Compiled productions.

use crate::rewrite::Rewrite;
use core::ops::Range;
use lsystem_syntax::Code;

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

/// A grammar made ready for derivation: letters are small integers, productions tables over them.
#[derive(Clone, Debug, PartialEq)]
pub struct Rules {
    /// Every letter of the axiom and the productions, sorted.
    pub letters: Vec<Letter>,
    /// By letter: whether contexts see it (`ignore:`, `consider:`).
    pub considered: Vec<bool>,
    /// By letter: whether it cuts off the rest of its branch in the next step.
    pub cuts: Vec<bool>,
    /// By letter: its productions, those with a context first, in text order within each class.
    pub by_letter: Vec<Vec<Rule>>,
    /// By letter: its productions below `draw:`, in text order. None where the rules are [plain](Rules::is_plain): the
    /// letters do then what their images do.
    pub images: Vec<Vec<Rule>>,
    /// By letter: what a derivation step does with it, or may do.
    pub rewrites: Vec<Rewrite>,
    /// The axiom; its arguments use no slots.
    pub axiom: Template,
    /// Where the productions stand in the text, then those below `draw:`; may be shorter.
    pub spans: Vec<Range<usize>>,
    pub(crate) plain: bool,
}

/// One production.
#[derive(Clone, Debug, PartialEq)]
pub struct Rule {
    /// Its index in [`Grammar::productions`](lsystem_syntax::Grammar::productions), those of
    /// [`Grammar::images`](lsystem_syntax::Grammar::images) counted on.
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
    pub successor: Template,
}

impl Rule {
    /// Whether it has a context.
    #[must_use]
    pub fn is_context_sensitive(&self) -> bool {
        !self.left.is_empty() || !self.right.is_empty()
    }

    /// Whether it applies by its letters alone, at most one to each side.
    pub(crate) fn is_plain(&self) -> bool {
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

/// Modules to be made.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Template {
    /// Their letters.
    pub letters: Vec<LetterId>,
    /// How their arguments are computed, all of them one after the other.
    pub arguments: Vec<Code>,
}

impl Template {
    /// How many modules, and arguments, it makes.
    pub(crate) fn size(&self) -> [usize; 2] {
        [self.letters.len(), self.arguments.len()]
    }
}

impl Rules {
    /// Whether every letter derives by itself and by its name alone, and chance only as beforehand known weights say.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.plain
    }

    /// The symbol of a letter.
    #[must_use]
    pub fn symbol(&self, letter: LetterId) -> char {
        self.letters[usize::from(letter)].symbol
    }

    /// How many parameters a letter has.
    #[must_use]
    pub fn arity(&self, letter: LetterId) -> usize {
        usize::from(self.letters[usize::from(letter)].arity)
    }

    /// The letter for a symbol with `arity` parameters.
    #[must_use]
    pub fn letter(&self, symbol: char, arity: u8) -> Option<LetterId> {
        self.letters.binary_search(&Letter { symbol, arity }).ok().map(|id| id as LetterId)
    }

    /// Whether random choices or numbers play a part anywhere.
    #[must_use]
    pub fn is_random(&self) -> bool {
        let random = |template: &Template| template.arguments.iter().any(Code::is_random);
        random(&self.axiom)
            || (self.by_letter.iter().chain(&self.images).flatten()).any(|rule| {
                rule.weight.is_some() || rule.condition.as_ref().is_some_and(Code::is_random) || random(&rule.successor)
            })
    }

    /// Whether branches are ever cut.
    #[must_use]
    pub fn is_cutting(&self) -> bool {
        let made = self.by_letter.iter().flatten().map(|rule| &rule.successor).chain([&self.axiom]);
        made.flat_map(|template| &template.letters).any(|&letter| self.cuts[usize::from(letter)])
    }

    /// Whether any module has parameters.
    #[must_use]
    pub fn is_parametric(&self) -> bool {
        self.letters.iter().any(|letter| letter.arity > 0)
    }
}
