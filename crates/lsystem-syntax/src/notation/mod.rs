//! The notation of axioms and rules.
//!
//! ```text
//! F -> FF                                    a production: F becomes FF
//! F -> F[+F]F : 0.33                         one of several, with its weight
//! A < B > C -> D                             if A stands before and C after, along the axis
//! A(l, w) : l > 0.1 -> F(l)A(l*r, w)         with parameters, and a condition
//! r = 0.9                                    a constant; also: #define r 0.9
//! curve taper = (0, 1) (0.4, 0.8) (1, 0.1)   a function of one variable, used as in `taper(x)`
//! ignore: +-F                                symbols that contexts skip; `consider:` lists the symbols they see
//! draw:                                      the productions below apply only to the drawing
//! // a comment                               also: # a comment, and /* anywhere */
//! ```
//!
//! Each production has its own line; a label that ends with a digit may stand before it, as in `p1: F -> FF`. The arrow
//! is `->`, `-->`, `=>` or `→`. White space is never a symbol. An empty successor, `*` or `ε` deletes the predecessor;
//! `*` is also the empty context and the empty condition. A character in backquotes is always a symbol. An invisible
//! character is written by its number, as in `` `U+0A` ``. Parentheses directly after a symbol hold its arguments. The
//! text after the last `:` behind the arrow is the weight. An axiom may have several lines.
//!
//! Arithmetic, from loose to tight: `||` or `or`, `&&` or `and`, `not`, comparisons (`=` is `==`), `+ -`, `* / %`,
//! signs and `!`, `^`; functions as in [`Function`](crate::Function), angles in degrees.
//!
//! A left context follows the path to the root and has no brackets. A right context follows the axis and may contain
//! branches in `[ ]` (ABOP, section 1.8). The same symbol with a different number of parameters is a different letter.

pub(crate) mod arrow;
mod comment;
pub(crate) mod constants;
mod curve;
pub(crate) mod expression;
mod line;
mod production;
mod shape;
pub(crate) mod site;
pub(crate) mod token;
pub(crate) mod word;

use crate::notes::DiagnosticList;
use crate::{Diagnostic, Field, Grammar, Role};
use constants::Constants;
use core::ops::Range;
use lsystem_base::{LimitName, MAX_TEXT};

/// Reads an axiom and rules. The grammar holds all readable parts; it is usable if no diagnostic is an error.
///
/// ```
/// let (grammar, diagnostics) = lsystem_syntax::parse("F", "F -> F[+F]F");
/// assert!(diagnostics.is_empty());
/// assert_eq!(grammar.productions[0].successor.len(), 6);
/// ```
#[must_use]
pub fn parse(axiom: &str, rules: &str) -> (Grammar, Vec<Diagnostic>) {
    let reading = read(axiom, rules);
    (reading.grammar, reading.diagnostics)
}

/// A grammar, its diagnostics, and the spans of its parts in the text, in bytes.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// The grammar.
    pub grammar: Grammar,
    /// Errors and warnings.
    pub diagnostics: Vec<Diagnostic>,
    /// The spans of the axiom's modules.
    pub axiom: Vec<Range<usize>>,
    /// The spans of each production.
    pub productions: Vec<Places>,
    /// The spans of each production below `draw:`.
    pub images: Vec<Places>,
}

/// The spans of a production's modules, in bytes.
#[derive(Clone, Debug, Default)]
pub struct Places {
    /// The modules of the left context.
    pub left: Vec<Range<usize>>,
    /// The strict predecessor.
    pub predecessor: Range<usize>,
    /// The modules of the right context.
    pub right: Vec<Range<usize>>,
    /// The modules of the successor.
    pub successor: Vec<Range<usize>>,
}

/// Reads an axiom and rules with the spans of all parts.
pub fn read(axiom: &str, rules: &str) -> Reading {
    let mut constants = Constants::default();
    let mut notes = [DiagnosticList::new(Field::Axiom), DiagnosticList::new(Field::Rules)];
    let mut reading = read_with(axiom, rules, &mut constants, &mut notes);
    let [notes, mut rules_notes] = notes;
    constants.finish(&mut rules_notes);
    reading.diagnostics = notes.finish();
    reading.diagnostics.extend(rules_notes.finish());
    reading
}

/// Reads an axiom and rules. The diagnostics go to `notes`, first the axiom's, then the rules'.
pub(crate) fn read_with(
    axiom: &str,
    rules: &str,
    constants: &mut Constants,
    notes: &mut [DiagnosticList; 2],
) -> Reading {
    let mut reading = Reading::default();
    let [notes, rules_notes] = notes;
    if is_short_enough(rules, rules_notes) {
        line::read(&comment::without_comments(rules, rules_notes), &mut reading, constants, rules_notes);
    }
    if is_short_enough(axiom, notes) {
        let axiom = comment::without_comments(axiom, notes);
        let tokens = token::tokens(&axiom, 0..axiom.len(), notes);
        let word = word::word(&tokens, Role::Axiom, constants, notes);
        reading.grammar.axiom = word.modules;
        reading.axiom = word.spans;
    }
    reading
}

/// Whether `text` has at most [`MAX_TEXT`] bytes; noted otherwise.
pub(crate) fn is_short_enough(text: &str, notes: &mut DiagnosticList) -> bool {
    let short = text.len() <= MAX_TEXT;
    if !short {
        notes.add(0..0, Diagnostic::limit(LimitName::Text, MAX_TEXT as u64, None));
    }
    short
}

/// The spans of a text's lines without the line ends, in bytes.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Range<usize>> {
    let mut from = 0;
    text.split(['\n', '\r']).map(move |line| {
        let range = from..from + line.len();
        from = range.end + 1;
        range
    })
}

/// Whether a line of rules or overrides is a comment or blank.
pub(crate) fn is_comment(line: &str) -> bool {
    let line = line.trim_matches(crate::characters::is_blank);
    line.is_empty()
        || line.starts_with("//")
        || line.strip_prefix('#').is_some_and(|rest| rest.chars().next().is_none_or(crate::characters::is_blank))
}
