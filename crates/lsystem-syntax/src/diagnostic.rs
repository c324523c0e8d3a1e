//! Problems in a system or a file, as values: kind, text and span. Their words stand in `message.rs`.

use crate::value::Value;
use crate::{Colour, Function, SurfaceProblem};
use core::ops::Range;
use lsystem_base::LimitName;
use lsystem_base::MAX_PALETTE;

/// One problem in a system, a file or a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The problem, with its arguments.
    pub kind: Kind,
    /// The text that contains the problem.
    pub field: Field,
    /// The place in the text, in bytes; empty where something is missing, 0..0 if no place applies.
    pub span: Range<usize>,
}

/// A thing that TikZ's library `lindenmayersystems` lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TikzObstacle {
    /// Weights of productions, or varied angles and lengths.
    Random,
    /// Contexts.
    Contexts,
    /// Parameters, conditions or arguments.
    Parameters,
    /// Productions below `draw:`.
    Images,
    /// A symbol that is no letter, digit or bracket, and none of `+ - |`.
    Symbol(char),
    /// A symbol with an action other than forward steps, turns in the plane and branches.
    Action(char),
    /// Brackets that are rewritten, or are not closed in the text where they are opened.
    Branches,
    /// Branches in branches, more than TeX can nest.
    Nesting,
    /// More than one colour.
    Colours,
    /// Widths or lengths that depend on the branch level.
    Levels,
    /// A tropism, or a sway in the wind.
    Tropism,
    /// A last derivation step that is partly grown.
    Growth,
}

/// Whether the system is usable in spite of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The system is usable, but may not mean what its author intended.
    Warning,
    /// The system is not usable.
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
    /// The definition's numbers. They have no text, so the span is 0..0.
    Numbers,
}

impl Field {
    /// The field's name in reports: `axiom`, `rules`, `overrides`, `file` or `numbers`.
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

/// The kinds of diagnostics. Their words stand in the message table (`message.rs`).
///
/// Texts in a kind are excerpts of at most about 40 characters.
#[derive(Clone, Debug, PartialEq)]
pub enum Kind {
    /// A line of the surfaces that is wrong.
    Surface {
        /// The line, from 1.
        line: usize,
        /// What is wrong.
        problem: SurfaceProblem,
    },
    /// An action draws a surface that the system does not have.
    UnknownSurface {
        /// The surface's name.
        name: char,
    },
    /// A limit is passed.
    Limit {
        /// The limit's name.
        limit: LimitName,
        /// The limit's value.
        value: u64,
        /// The largest number of iterations within the limit, if known.
        largest: Option<u32>,
    },
    /// A file that is neither UTF-8 text nor a picture made by this library.
    NotText {
        /// The first line (1-based) that is not UTF-8.
        line: usize,
    },
    /// A picture without a system in it.
    NoSystem {
        /// The picture's format.
        picture: &'static str,
    },
    /// A picture that opens slowly, because viewers have to copy many blocks.
    Instances {
        /// The number of copies.
        count: u128,
    },
    /// A file format with opaque ink only, for a drawing with additive ink.
    CoveringInk,
    /// A system that TikZ's library `lindenmayersystems` cannot express.
    NotInTikz {
        /// The first thing that the library lacks.
        obstacle: TikzObstacle,
    },
    /// The diagnostics beyond the most that are listed.
    More {
        /// The number of diagnostics left out.
        left_out: usize,
    },

    // Characters.
    /// A typographic character that is read as the plain character it resembles.
    LookAlike {
        /// The character in the text.
        found: char,
        /// The plain character.
        read_as: char,
    },
    /// Backquotes that do not hold exactly one character.
    LiteralLength,
    /// A backquote without its partner.
    LiteralUnclosed,
    /// `(` without `)`.
    ParenthesisUnclosed,
    /// A parenthesis that is read as a symbol because it does not directly follow a symbol.
    ParenthesisSymbol {
        /// The parenthesis.
        symbol: char,
    },

    // Lines.
    /// `F()`.
    ParenthesesEmpty,
    /// A line that is neither a production, a constant nor a comment.
    NoArrow {
        /// The line as a production or a constant, if a guess is possible.
        suggestion: Option<String>,
    },
    /// `F = FF`.
    EqualsForArrow {
        /// The text before the `=`.
        left: String,
        /// The text after the `=`.
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
        /// The symbols.
        text: String,
    },
    /// A parameter before the arrow that is not a name.
    ParameterName {
        /// The text in place of the name.
        text: String,
    },
    /// Two parameters with the same name before the arrow.
    ParameterTwice {
        /// The name.
        name: String,
    },
    /// More than one `<` or `>` before the arrow, or in the wrong order.
    ContextOrder,
    /// Nothing before `<` or after `>`.
    ContextMissing {
        /// The mark without a context, `<` or `>`.
        mark: char,
    },
    /// `<` or `>` before the arrow that is probably a comparison, but is read as the mark of a context.
    ContextForCondition,
    /// A condition after the successor. It is read as symbols.
    ConditionBehind,
    /// A comment after the successor. It is read as symbols.
    CommentBehind,
    /// A comment that begins with `/*` and is never closed.
    CommentUnclosed,
    /// Quotes around an axiom or a successor. They are read as symbols.
    Quotes {
        /// The text between the quotes.
        inside: String,
    },
    /// A comma behind an axiom or a successor. It is read as a symbol.
    CommaBehind,
    /// Digits behind a turn or another mark. They are read as symbols.
    DigitsBehind {
        /// The symbol before the digits.
        symbol: char,
        /// The digits, with a point, if any.
        digits: String,
    },
    /// `@` and a character, which are one symbol elsewhere. They are read as two.
    TwoCharacters {
        /// The character behind `@`.
        second: char,
    },
    /// Parentheses that probably mean a branch.
    ParenthesesForBranch {
        /// The text in parentheses.
        inside: String,
    },
    /// A number at one end of a successor that is probably a weight, but is read as symbols.
    WeightOfSymbols,
    /// A bracket in a left context.
    ContextBracketLeft,
    /// A bracket without its partner in a right context, or with parameters.
    ContextBracket,
    /// A symbol in a context that `ignore:` or `consider:` hides from contexts.
    ContextUnseen {
        /// The symbol.
        symbol: char,
    },
    /// A context below `draw:`.
    DrawContext,
    /// Both `ignore:` and `consider:`.
    IgnoreAndConsider,
    /// `=>` in a condition.
    ArrowForComparison,
    /// A second arrow in a line.
    SecondArrow,
    /// An arrow in the axiom.
    ArrowInAxiom,
    /// An unweighted production that never applies, because an earlier unweighted production always applies instead.
    NeverApplies {
        /// The predecessor.
        symbol: char,
        /// Whether the later production has a condition and the earlier one has none.
        conditional: bool,
    },
    /// Weighted and unweighted productions for the same symbol.
    MixedWeights {
        /// The predecessor.
        symbol: char,
        /// Whether the weighted productions apply, because the first production is weighted.
        weighted: bool,
    },

    // Numbers in the text.
    /// A weight that is zero, negative or too large.
    WeightRange {
        /// The weight.
        value: f64,
    },
    /// A number is missing.
    NumberExpected,
    /// A malformed number.
    NumberMalformed {
        /// The number as written.
        text: String,
    },
    /// A number too large for double precision.
    NumberRange {
        /// The number as written.
        text: String,
    },
    /// A character that is unexpected in arithmetic.
    ArithmeticUnexpected {
        /// The character.
        found: char,
        /// The role of the arithmetic.
        role: Role,
    },
    /// `(` without `)` in arithmetic.
    ArithmeticUnclosed,
    /// Arithmetic nested too deeply.
    ArithmeticDepth,
    /// Arithmetic whose result is infinite or undefined.
    ArithmeticRange,
    /// A name that is neither a constant nor a parameter.
    UnknownConstant {
        /// The name.
        name: String,
        /// A similar name.
        similar: Option<String>,
        /// Whether a later line defines the constant.
        below: bool,
        /// The role of the arithmetic.
        role: Role,
    },
    /// A name before `(` that is not a function.
    UnknownFunction {
        /// The name.
        name: String,
        /// A similar function.
        similar: Option<&'static str>,
    },
    /// A parameter or constant before `(`.
    NotAFunction {
        /// The parameter's or constant's name.
        name: String,
    },
    /// A function without `(`.
    FunctionBare {
        /// The function's name.
        name: String,
    },
    /// A function with a wrong number of arguments.
    FunctionArity {
        /// The function.
        function: Function,
        /// The number of arguments that the function takes.
        expected: usize,
        /// The number of arguments given.
        found: usize,
    },
    /// A function of a shape whose first argument is not the name of one.
    ShapeExpected {
        /// The text in place of the name.
        found: String,
    },
    /// A shape that no rule names.
    ShapeUnused {
        /// The shape's name.
        name: String,
    },
    /// A curve that no rule names.
    CurveUnused {
        /// The curve's name.
        name: String,
    },
    /// In a curve: something else in place of a point.
    CurvePoint {
        /// The text there.
        found: String,
    },
    /// In a curve: a point whose x is less than that of the point before.
    CurveBack,
    /// A curve with too few or too many points, or with no two different x.
    CurveCount {
        /// The number of points.
        found: usize,
    },
    /// In a shape: something else in place of a solid with its numbers.
    SolidExpected {
        /// The text there; empty at the end of the line.
        found: String,
    },
    /// A solid with a wrong number of numbers.
    SolidNumbers {
        /// The solid's name.
        name: &'static str,
        /// How many it has; `None` for a list.
        expected: Option<usize>,
        /// How many are given.
        found: usize,
    },
    /// `a < b < c`.
    ComparisonChain,
    /// A comparison in a weight.
    WeightCondition,
    /// A condition that is always true or always false.
    ConditionConstant {
        /// Whether the condition is true.
        holds: bool,
    },
    /// A constant with `random`.
    ConstantRandom,
    /// A constant whose name is not a name, before `=` or after `#define`.
    ConstantName {
        /// The text in place of the name.
        text: String,
    },
    /// A constant defined a second time.
    ConstantTwice {
        /// The constant's name.
        name: String,
    },
    /// A constant that is never used.
    ConstantUnused {
        /// The constant's name.
        name: String,
        /// The value as written.
        value: String,
    },

    // Overrides.
    /// An override without `:` after its symbol.
    OverrideColon {
        /// The line with a colon, if a guess is possible.
        suggestion: Option<String>,
    },
    /// Not exactly one symbol before the `:` of an override.
    OverrideSymbol {
        /// The text before the `:`.
        text: String,
    },
    /// A second override of the same symbol. The last one counts.
    OverrideTwice {
        /// The symbol.
        symbol: char,
    },
    /// An unknown action.
    UnknownAction {
        /// The action as written.
        text: String,
        /// A similar action.
        similar: Option<&'static str>,
    },
    /// `nothing` together with other actions.
    NothingElse,
    /// A number in an action is missing, malformed or out of range.
    ActionNumber {
        /// The number that the action takes.
        expected: Expected,
    },

    // The system as a whole.
    /// The axiom is empty.
    EmptyAxiom,
    /// One or more adjacent symbols, such as `]`, that close no branch.
    UnmatchedClose {
        /// The symbol.
        symbol: char,
    },
    /// One or more adjacent symbols, such as `[`, that open branches which no generation closes.
    UnmatchedOpen {
        /// The symbol.
        symbol: char,
    },
    /// `->` that is read as symbols but was probably meant as an arrow, as in `X->F,F->FF`.
    ArrowOfSymbols,
    /// A production with a predecessor or a context that occurs in no generation.
    NeverOccurs {
        /// The predecessor, or the symbol in the context.
        symbol: char,
    },
    /// A pattern with a number of parameters that its symbol never has.
    OtherArity {
        /// The symbol.
        symbol: char,
        /// The number of parameters of the pattern.
        parameters: usize,
        /// The number of arguments of the symbol where it occurs.
        found: usize,
    },
    /// A module with a number of arguments that no production for its symbol takes.
    NoRuleForArity {
        /// The symbol.
        symbol: char,
        /// The number of arguments of the module.
        parameters: usize,
        /// The number of parameters of a production for the symbol.
        found: usize,
    },
    /// A number that became infinite or undefined during derivation.
    NotFinite {
        /// The derivation step, 1-based; 0 for the axiom.
        step: u32,
    },
    /// No view around a segment: the drawing has fewer, or its parts are not shared.
    NoCloseup,
    /// A field of the definition is out of its range.
    Range {
        /// The field's label on the page.
        label: &'static str,
        /// The field's range.
        expected: Expected,
    },

    // Files.
    /// Not JSON.
    Json(JsonError),
    /// A value of another type than expected.
    WrongType {
        /// The key, or the role of the value.
        key: String,
        /// The expected type.
        expected: Expected,
        /// The type found, in words.
        found: &'static str,
    },
    /// A value outside its range.
    WrongValue {
        /// The key.
        key: String,
        /// The expected range.
        expected: Expected,
    },
    /// An unknown key. Its value is not read.
    UnknownKey {
        /// The key.
        key: String,
        /// A similar key.
        similar: Option<&'static str>,
    },
    /// A key that stands twice in the same object. The last value counts.
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
    /// A list of outcomes without any that is possible.
    NoOutcome,
    /// An outcome with probability 0.
    ProbabilityZero,
}

/// The role of an expression.
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

/// The expected type and range of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// No value at all.
    Nothing,
    /// A finite number.
    Number,
    /// A finite number from the first to the second.
    Between(f64, f64),
    /// A finite number above 0, at most this.
    PositiveUpTo(f64),
    /// A whole number from the first to the second.
    Whole(i64, i64),
    /// `true` or `false`.
    Boolean,
    /// A string.
    String,
    /// A string of at most this many UTF-16 units.
    Text(usize),
    /// One of these words.
    Word(&'static [&'static str]),
    /// An object.
    Object,
    /// A list of this many values, each as expected.
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
    /// From 1 to [`MAX_PALETTE`] colours.
    Palette,
}

impl Expected {
    /// Whether a number is within the range; `false` if no number is expected.
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

    /// Whether a field's value has the expected type. The range is not checked.
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

    /// Whether a field's value has the expected type and is within the range.
    #[must_use]
    pub fn admits_value(self, value: &Value) -> bool {
        match (self, value) {
            (_, Value::Number(number)) => self.admits(*number),
            (Self::Boolean, Value::Flag(_)) | (Self::String, Value::Text(_)) => true,
            // Each UTF-16 unit takes at least one byte of UTF-8, so a short text need not be counted.
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
    /// Only white space and comments.
    Empty,
    /// An object without any key that a system needs.
    NoSystem,
    /// An unexpected token.
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

impl Diagnostic {
    /// The diagnostic for an exceeded limit. `largest` is the largest number of derivation steps within the limit, if
    /// known.
    #[must_use]
    pub fn limit(limit: LimitName, value: u64, largest: Option<u32>) -> Self {
        Self { kind: Kind::Limit { limit, value, largest }, field: Field::Numbers, span: 0..0 }
    }

    /// Whether the diagnostic is a warning or an error.
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
            | Kind::ShapeUnused { .. }
            | Kind::CurveUnused { .. }
            | Kind::OverrideTwice { .. }
            | Kind::UnknownSurface { .. }
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
            | Kind::CommentUnclosed
            | Kind::Quotes { .. }
            | Kind::CommaBehind
            | Kind::DigitsBehind { .. }
            | Kind::TwoCharacters { .. }
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

    /// Whether the diagnostic is an error: the system is not usable.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.severity() == Severity::Error
    }
}
