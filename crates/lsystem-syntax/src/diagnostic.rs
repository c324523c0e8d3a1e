//! What is wrong with what somebody typed, as values: kind, place, and words from one table.

use crate::value::Value;
use crate::{Colour, Function, MAX_PALETTE};
use core::ops::Range;

/// One thing to tell the author of a system.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What it is about, with its arguments.
    pub kind: Kind,
    /// Which text it is in.
    pub field: Field,
    /// Where in that text, in bytes; empty at the place where something is missing, 0..0 when no place applies.
    pub span: Range<usize>,
}

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The system works, perhaps not as meant.
    Warning,
    /// The system cannot be used.
    Error,
}

/// The text that a diagnostic's span points into.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Field {
    /// [`Definition::axiom`](crate::Definition::axiom).
    Axiom,
    /// [`Definition::rules`](crate::Definition::rules).
    Rules,
    /// [`Definition::overrides`](crate::Definition::overrides).
    Overrides,
    /// A file that was read.
    File,
    /// The definition's numbers: no text, no span.
    Numbers,
}

impl Field {
    /// Its name, as in reports: `axiom`, `rules`, `overrides`, `file` or `numbers`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Axiom => "axiom",
            Self::Rules => "rules",
            Self::Overrides => "overrides",
            Self::File => "file",
            Self::Numbers => "numbers",
        }
    }
}

/// What a diagnostic is about. The words are in the message table (`message.rs`).
///
/// Texts in it are excerpts: long ones are cut.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A limit is passed.
    Limit {
        /// Which limit.
        limit: LimitName,
        /// Its value.
        value: u64,
        /// The largest number of iterations within it, where known.
        largest: Option<u32>,
    },
    /// A file that is neither text nor a picture of ours.
    NotText {
        /// The first line (1-based) that is not UTF-8.
        line: usize,
    },
    /// A picture without a system in it.
    NoSystem {
        /// Which kind of picture.
        picture: &'static str,
    },
    /// A picture that takes whoever shows it long.
    Instances {
        /// How many copies of blocks have to be made.
        count: u128,
    },
    /// A picture whose ink covers, of a drawing whose ink adds up.
    CoveringInk,
    /// More diagnostics than are worth listing.
    More {
        /// How many were left out.
        left_out: usize,
    },

    // Characters.
    /// A character pasted from a typeset text is read as the one it looks like.
    LookAlike {
        /// What stands in the text.
        found: char,
        /// What it is read as.
        read_as: char,
    },
    /// Backquotes that do not hold exactly one character.
    LiteralLength,
    /// A backquote without its partner.
    LiteralUnclosed,
    /// `(` without `)`.
    ParenthesisUnclosed,
    /// A parenthesis that is read as a symbol because it does not directly follow one.
    ParenthesisSymbol {
        /// Which.
        symbol: char,
    },

    // Lines.
    /// `F()`.
    ParenthesesEmpty,
    /// A line that is neither a production, a constant nor a comment.
    NoArrow {
        /// The line as a production, where a guess can be made.
        suggestion: Option<String>,
    },
    /// `F = FF`.
    EqualsForArrow {
        /// What stands before the `=`.
        left: String,
        /// What stands after it.
        right: String,
    },
    /// `axiom: F` or `angle: 25` among the productions.
    OtherField {
        /// The word before the colon.
        word: String,
    },
    /// Nothing before the arrow.
    NoPredecessor,
    /// More than one symbol before the arrow.
    LongPredecessor {
        /// They.
        text: String,
    },
    /// Something else than a name for a parameter before the arrow.
    ParameterName {
        /// It.
        text: String,
    },
    /// Two parameters of one name before the arrow.
    ParameterTwice {
        /// The name.
        name: String,
    },
    /// More than one `<` or `>` before the arrow, or in the wrong order.
    ContextOrder,
    /// Nothing before `<` or after `>`.
    ContextMissing {
        /// `<` or `>`.
        mark: char,
    },
    /// A comparison that is read as a context.
    ContextForCondition,
    /// A condition behind the successor, which is read as symbols.
    ConditionBehind,
    /// A comment behind the successor, which is read as symbols.
    CommentBehind,
    /// A number in a successor that was meant as its weight.
    WeightOfSymbols,
    /// A bracket in a left context.
    ContextBracketLeft,
    /// A bracket without its partner in a right context, or with parameters.
    ContextBracket,
    /// A symbol in a context that contexts do not see.
    ContextUnseen {
        /// Which.
        symbol: char,
    },
    /// A context below `draw:`.
    DrawContext,
    /// `ignore:` as well as `consider:`.
    IgnoreAndConsider,
    /// `=>` in a condition.
    ArrowForComparison,
    /// A further arrow in a line.
    SecondArrow,
    /// An arrow in the axiom.
    ArrowInAxiom,
    /// An unweighted production after an unweighted one that applies wherever this one does.
    NeverApplies {
        /// The predecessor.
        symbol: char,
        /// Whether this one has a condition that the other has not.
        conditional: bool,
    },
    /// Weighted and unweighted productions for one symbol.
    MixedWeights {
        /// The predecessor.
        symbol: char,
        /// Whether the weighted ones apply, because one of them comes first.
        weighted: bool,
    },

    // Numbers in the text.
    /// A weight that is zero, negative or too large.
    WeightRange {
        /// Its value.
        value: f64,
    },
    /// A number is missing.
    NumberExpected,
    /// Digits that are no number.
    NumberMalformed {
        /// They.
        text: String,
    },
    /// Digits that are a number too large to be held.
    NumberRange {
        /// They.
        text: String,
    },
    /// A character that has no place in arithmetic.
    ArithmeticUnexpected {
        /// Which.
        found: char,
        /// What the arithmetic is for.
        role: Role,
    },
    /// `(` without `)` in arithmetic.
    ArithmeticUnclosed,
    /// Arithmetic nested too deeply.
    ArithmeticDepth,
    /// Arithmetic whose result is infinite or undefined.
    ArithmeticRange,
    /// A name that no constant has.
    UnknownConstant {
        /// The name.
        name: String,
        /// A similar one.
        similar: Option<String>,
        /// Whether a constant below has it.
        below: bool,
        /// What the arithmetic is for.
        role: Role,
    },
    /// A name before `(` that no function has.
    UnknownFunction {
        /// The name.
        name: String,
        /// A similar one.
        similar: Option<&'static str>,
    },
    /// A parameter or constant before `(`.
    NotAFunction {
        /// Its name.
        name: String,
    },
    /// A function without `(`.
    FunctionBare {
        /// Its name.
        name: String,
    },
    /// A function with another number of arguments than it takes.
    FunctionArity {
        /// Which.
        function: Function,
        /// How many it takes.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// `a < b < c`.
    ComparisonChain,
    /// A comparison in a weight.
    WeightCondition,
    /// A condition that does not depend on anything.
    ConditionConstant {
        /// Whether it is true.
        holds: bool,
    },
    /// A constant with `random`.
    ConstantRandom,
    /// Something else than a name before `=` or after `#define`.
    ConstantName {
        /// It.
        text: String,
    },
    /// A constant defined a second time.
    ConstantTwice {
        /// Its name.
        name: String,
    },
    /// A constant that nothing uses.
    ConstantUnused {
        /// Its name.
        name: String,
        /// Its value, as written.
        value: String,
    },

    // Overrides.
    /// An override without `:` after its symbol.
    OverrideColon {
        /// The line with one, where a guess can be made.
        suggestion: Option<String>,
    },
    /// Not exactly one symbol before the `:` of an override.
    OverrideSymbol {
        /// What stands there.
        text: String,
    },
    /// A second override of a symbol: it replaces the first.
    OverrideTwice {
        /// The symbol.
        symbol: char,
    },
    /// An action that nobody knows.
    UnknownAction {
        /// It.
        text: String,
        /// A similar one.
        similar: Option<&'static str>,
    },
    /// `nothing` together with other actions.
    NothingElse,
    /// A number in an action is missing, malformed or out of range.
    ActionNumber {
        /// What the action takes.
        expected: Expected,
    },

    // The system as a whole.
    /// The axiom is empty.
    EmptyAxiom,
    /// Symbols next to each other, as `]`, that close no branch.
    UnmatchedClose {
        /// The symbol.
        symbol: char,
    },
    /// Symbols next to each other, as `[`, whose branches nothing closes in any generation.
    UnmatchedOpen {
        /// The symbol.
        symbol: char,
    },
    /// `->` among symbols where nobody means symbols by it, as in `X->F,F->FF`.
    ArrowOfSymbols,
    /// A production with a predecessor or a context that is in no generation.
    NeverOccurs {
        /// The predecessor, or the symbol in the context.
        symbol: char,
    },
    /// A pattern with another number of parameters than its symbol ever has.
    OtherArity {
        /// The symbol.
        symbol: char,
        /// How many parameters the pattern has.
        parameters: usize,
        /// How many it has where it occurs.
        found: usize,
    },
    /// A module with another number of parameters than the productions for its symbol.
    NoRuleForArity {
        /// The symbol.
        symbol: char,
        /// How many parameters the module has.
        parameters: usize,
        /// How many a production for it has.
        found: usize,
    },
    /// A number that became infinite or undefined while deriving.
    NotFinite {
        /// The derivation step, 1-based; 0 for the axiom.
        step: u32,
    },
    /// A field of the definition is out of its range.
    Range {
        /// What the page calls it.
        label: &'static str,
        /// What it may be.
        expected: Expected,
    },

    // Files.
    /// Not JSON.
    Json(JsonError),
    /// A value of another type than expected.
    WrongType {
        /// The key, or what the value is for.
        key: String,
        /// What is expected.
        expected: Expected,
        /// What is there.
        found: &'static str,
    },
    /// A value outside its range.
    WrongValue {
        /// The key.
        key: String,
        /// What is expected.
        expected: Expected,
    },
    /// A key that nothing reads.
    UnknownKey {
        /// The key.
        key: String,
        /// A similar one.
        similar: Option<&'static str>,
    },
    /// A key that stands a second time: the last counts.
    DuplicateKey {
        /// The key.
        key: String,
    },
    /// A key that is missing from an outcome of a stochastic rule.
    MissingKey {
        /// The key.
        key: &'static str,
    },
    /// A key in `rules` or `overrides` that is not one symbol.
    RuleKey {
        /// The key.
        key: String,
    },
    /// White space in the plain characters of a course file.
    SpaceSymbol,
    /// Probabilities that do not sum to 1.
    ProbabilitySum {
        /// Their sum.
        sum: f64,
    },
    /// A list of outcomes of which none can happen.
    NoOutcome,
    /// An outcome with probability 0.
    ProbabilityZero,
}

/// What an expression is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Role {
    /// The value of a constant.
    Constant,
    /// The weight of a production.
    Weight,
    /// The condition of a production.
    Condition,
    /// An argument of a production's module.
    Argument,
    /// An argument of the axiom.
    Axiom,
}

/// What is expected of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// No value at all.
    Nothing,
    /// A finite number.
    Number,
    /// A finite number from the first to the second.
    Between(f64, f64),
    /// A finite number above zero up to this.
    PositiveUpTo(f64),
    /// A whole number from the first to the second.
    Whole(i64, i64),
    /// `true` or `false`.
    Boolean,
    /// A string.
    String,
    /// A string of at most so many UTF-16 units.
    Text(usize),
    /// One of these words.
    Word(&'static [&'static str]),
    /// An object.
    Object,
    /// A list of so many values.
    Each(usize, &'static Expected),
    /// An object with these members.
    Record(&'static [(&'static str, Expected)]),
    /// An object, or a list of lines.
    Rules,
    /// An object, or a list of lines.
    Overrides,
    /// A string, or a list of outcomes.
    Successor,
    /// An outcome `{"p": 0.5, "e": "F"}`.
    Outcome,
    /// A colour.
    Colour,
    /// From one to [`MAX_PALETTE`](crate::MAX_PALETTE) colours.
    Palette,
}

impl Expected {
    /// Whether a number is as expected; `false` where no number is expected.
    #[must_use]
    pub fn admits(self, value: f64) -> bool {
        match self {
            Self::Number => value.is_finite(),
            Self::Between(least, most) => (least..=most).contains(&value),
            Self::PositiveUpTo(most) => value > 0.0 && value <= most,
            Self::Whole(least, most) => value == libm::trunc(value) && (least as f64..=most as f64).contains(&value),
            _ => false,
        }
    }

    /// Whether a field's value is of the type, whatever its range.
    #[must_use]
    pub fn takes(self, value: &Value) -> bool {
        match self {
            Self::Number | Self::Between(..) | Self::PositiveUpTo(_) | Self::Whole(..) => {
                matches!(value, Value::Number(_))
            }
            Self::Boolean => matches!(value, Value::Flag(_)),
            Self::String | Self::Text(_) | Self::Word(_) | Self::Colour => matches!(value, Value::Text(_)),
            Self::Each(..) | Self::Palette => matches!(value, Value::List(_)),
            _ => false,
        }
    }

    /// Whether a field's value is as expected.
    #[must_use]
    pub fn admits_value(self, value: &Value) -> bool {
        match (self, value) {
            (_, Value::Number(number)) => self.admits(*number),
            (Self::Boolean, Value::Flag(_)) | (Self::String, Value::Text(_)) => true,
            // A UTF-16 unit takes at least a byte.
            (Self::Text(most), Value::Text(text)) => text.len() <= most || text.encode_utf16().count() <= most,
            (Self::Word(words), Value::Text(text)) => words.contains(&text.as_str()),
            (Self::Colour, Value::Text(text)) => text.parse::<Colour>().is_ok(),
            (Self::Each(count, each), Value::List(list)) => {
                list.len() == count && list.iter().all(|value| each.admits_value(value))
            }
            (Self::Palette, Value::List(list)) => {
                (1..=MAX_PALETTE).contains(&list.len()) && list.iter().all(|value| Self::Colour.admits_value(value))
            }
            _ => false,
        }
    }
}

/// Why a text is not JSON.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum JsonError {
    /// Nothing but white space and comments.
    Empty,
    /// A token that has no place there.
    Unexpected,
    /// A string without its closing quote.
    UnclosedString,
    /// A comment without its end.
    UnclosedComment,
    /// An object without its `}`.
    UnclosedObject,
    /// An array without its `]`.
    UnclosedArray,
    /// A comma is missing.
    MissingComma,
    /// A colon is missing after a key.
    MissingColon,
    /// A bad escape in a string.
    Escape,
    /// A malformed number.
    Number,
    /// Nested too deeply.
    Depth,
}

/// The limits, by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LimitName {
    /// Symbols of a string held in memory ([`Limits::symbols`](crate::Limits::symbols)).
    Symbols,
    /// Modules of one generation held in memory ([`Limits::modules`](crate::Limits::modules)).
    Modules,
    /// Segments of a drawing that does not memoise ([`Limits::segments`](crate::Limits::segments)).
    Segments,
    /// Derivation work of a system that does not memoise ([`Limits::work`](crate::Limits::work)).
    Work,
    /// Bytes of a drawing in the making ([`Limits::memory`](crate::Limits::memory)).
    Memory,
    /// Iterations (1,000).
    Iterations,
    /// Bytes of a text to be read ([`MAX_TEXT`](crate::MAX_TEXT)).
    Text,
    /// Different symbols in a system (65,536).
    Letters,
    /// Parameters of a module ([`MAX_PARAMETERS`](crate::MAX_PARAMETERS)).
    Parameters,
    /// Modules in a context (`MAX_CONTEXT`).
    Context,
    /// Actions of a symbol ([`MAX_ACTIONS`](crate::MAX_ACTIONS)).
    Actions,
}

impl Diagnostic {
    /// A limit that was passed; `largest` is the most derivation steps within it, where that is known.
    #[must_use]
    pub fn limit(limit: LimitName, value: u64, largest: Option<u32>) -> Self {
        Self { kind: Kind::Limit { limit, value, largest }, field: Field::Numbers, span: 0..0 }
    }

    /// How bad it is.
    #[must_use]
    pub fn severity(&self) -> Severity {
        match self.kind {
            Kind::LookAlike { .. }
            | Kind::Instances { .. }
            | Kind::CoveringInk
            | Kind::More { .. }
            | Kind::ParenthesisSymbol { .. }
            | Kind::NeverApplies { .. }
            | Kind::MixedWeights { .. }
            | Kind::ConstantUnused { .. }
            | Kind::OverrideTwice { .. }
            | Kind::EmptyAxiom
            | Kind::UnmatchedClose { .. }
            | Kind::UnmatchedOpen { .. }
            | Kind::ArrowOfSymbols
            | Kind::NeverOccurs { .. }
            | Kind::OtherArity { .. }
            | Kind::NoRuleForArity { .. }
            | Kind::ContextUnseen { .. }
            | Kind::ContextForCondition
            | Kind::ConditionBehind
            | Kind::CommentBehind
            | Kind::WeightOfSymbols
            | Kind::ConditionConstant { .. }
            | Kind::UnknownKey { .. }
            | Kind::DuplicateKey { .. }
            | Kind::SpaceSymbol
            | Kind::ProbabilitySum { .. }
            | Kind::ProbabilityZero => Severity::Warning,
            _ => Severity::Error,
        }
    }

    /// Whether the system cannot be used.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity() == Severity::Error
    }
}
