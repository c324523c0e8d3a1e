//! Systems as JSON files.
//!
//! A file is one object. Comments, trailing commas and unquoted keys are accepted. It needs `initial`, `rules`,
//! `turtle` or `style`, to differ from other JSON; all other keys are optional. [`FIELDS`] lists them with their
//! defaults and ranges, and docs/files.md shows the list. The objects `turtle` and `style` are members of the file's object.
//! The key `stochastic` has no effect, because the rules decide.
//!
//! In the course's files `rules` is an object: `{"F": "F+F", "X": [{"p": 0.5, "e": "XF"}, {"p": 0.5, "e": "X"}]}`. The
//! strings in it and `initial` are then plain characters: each character is a symbol, including white space.
//! Probabilities that do not sum to 1 are read as weights. In other files `rules` and `initial` are each a list of
//! lines, or one string, in this library's notation.
//!
//! A file without `turtle` is a course file: every letter draws ([`Dialect::EveryLetter`]), and the style is
//! [`Style::course`]. With `turtle`, the default style is [`Style::for_dialect`]. `overrides` is an object, as in
//! `{"G": "move", "A": "draw 10"}`, or a list of lines `"G: move"`.
//!
//! Unknown keys are reported and skipped.
//!
//! Scripts hold a system as one flat object with the names of [`FIELDS`]. [`read_fields`] reads such an object, too.

mod value;

use core::ops::Range;
use jsonc_parser::ast::{Object, ObjectProp, Value};
use jsonc_parser::common::Ranged;
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use jsonc_parser::{CollectOptions, ParseOptions, ParseStringErrorKind, parse_to_ast};
use lsystem_base::number::number;
use lsystem_base::sorted::repeated;
use lsystem_base::words::said;
use lsystem_base::{LimitName, MAX_FILE, say, word};
use lsystem_syntax::Value as Held;
use lsystem_syntax::fields::{FieldSpec, Section, field};
use lsystem_syntax::notes::{DiagnosticList, excerpt, similar};
use lsystem_syntax::{
    Definition, Diagnostic, Dialect, Expected, FIELDS, Field, Grammar, Kind, Module, Production, Style, print_axiom,
    print_rules,
};

/// The keys of an outcome.
const OUTCOME_KEYS: [&str; 2] = ["p", "e"];

/// A system has at least one of these keys.
const SYSTEM_KEYS: [&str; 4] = ["initial", "rules", "turtle", "style"];

/// Names of keys in other programs, with the keys here.
const ALIASES: [(&str, &str); 9] = [
    ("axiom", "initial"),
    ("angle", "angle_deg"),
    ("delta", "angle_deg"),
    ("iterations", "num_iters"),
    ("n", "num_iters"),
    ("productions", "rules"),
    ("right_angle", "right_angle_deg"),
    ("heading", "heading_deg"),
    ("color_by", "colour_by"),
];

/// The range of a probability or weight.
const WEIGHT: Expected = Expected::Between(0.0, 1e100);

/// What JSON may have here.
pub(super) const PARSING: ParseOptions = ParseOptions {
    allow_comments: true,
    allow_loose_object_property_names: true,
    allow_trailing_commas: true,
    allow_missing_commas: false,
    allow_single_quoted_strings: true,
    allow_hexadecimal_numbers: false,
    allow_unary_plus_numbers: true,
    allow_bare_decimal_point_numbers: true,
    allow_non_finite_numbers: false,
    allow_extended_string_escapes: false,
};

/// Reads a system from a JSON text. The definition is `None` if a diagnostic is an error. A definition may still have
/// errors in its texts, which [`System::new`](lsystem_drawing::System::new) reports.
#[must_use]
pub fn read_json(text: &str) -> (Option<Definition>, Vec<Diagnostic>) {
    read(text, |_| Names::Keys)
}

/// Reads a system from an object as scripts hold it, as a JSON text: with the names of [`FIELDS`], or with the keys of a
/// file. An object with `initial`, `turtle` or `style`, and without `axiom`, is one of a file. `rules` and `overrides`
/// have the same forms in both; beside an object of rules, `axiom` is plain characters, too.
///
/// The definition is also `None` if a key is unknown. Keys of a file that resemble no known key may be those of others.
#[must_use]
pub fn read_fields(text: &str) -> (Option<Definition>, Vec<Diagnostic>) {
    let mut is_flat = true;
    let (definition, diagnostics) = read(text, |object| {
        let has = |key: &&str| last(object, key).is_some();
        is_flat = has(&"axiom") || !["initial", "turtle", "style"].iter().any(has);
        if is_flat { Names::Fields } else { Names::Keys }
    });
    let is_unknown =
        |d: &Diagnostic| matches!(d.kind, Kind::UnknownKey { is_like_another } if is_flat || is_like_another);
    (definition.filter(|_| !diagnostics.iter().any(is_unknown)), diagnostics)
}

fn read(text: &str, names: impl FnOnce(&Object<'_>) -> Names) -> (Option<Definition>, Vec<Diagnostic>) {
    let mut file = JsonFile { notes: DiagnosticList::new(Field::File), base: 0, names: Names::Keys };
    let definition = file.read(text, names);
    let diagnostics = file.notes.finish();
    let definition = definition.filter(|_| !diagnostics.iter().any(Diagnostic::is_error));
    (definition, diagnostics)
}

/// The names of fields in an object.
#[derive(Clone, Copy, PartialEq)]
enum Names {
    /// The keys of files.
    Keys,
    /// The names of [`FIELDS`].
    Fields,
}

struct JsonFile {
    notes: DiagnosticList,
    /// The bytes of the byte order mark, which the parser does not see.
    base: usize,
    names: Names,
}

impl JsonFile {
    fn read(&mut self, text: &str, names: impl FnOnce(&Object<'_>) -> Names) -> Option<Definition> {
        if text.len() > MAX_FILE {
            self.notes.add(0..0, Diagnostic::limit(LimitName::Text, MAX_FILE as u64, None));
            return None;
        }
        let body = text.strip_prefix('\u{feff}').unwrap_or(text);
        self.base = text.len() - body.len();
        match parse_to_ast(body, &CollectOptions::default(), &PARSING) {
            Ok(parsed) => match parsed.value {
                Some(Value::Object(object)) => {
                    self.names = names(&object);
                    self.system(&object)
                }
                Some(other) => {
                    self.wrong_type("", Expected::Object, &other);
                    None
                }
                None => {
                    self.notes.error(
                        text.len()..text.len(),
                        say!("The file holds nothing"),
                        said(word!("It must hold an object: {\"initial\": \"F\"}.")),
                    );
                    None
                }
            },
            Err(error) => {
                let (error, span) = json_error(&error, body);
                self.notes.add(span.start + self.base..span.end + self.base, error);
                None
            }
        }
    }

    fn system(&mut self, object: &Object<'_>) -> Option<Definition> {
        if self.names == Names::Fields {
            return Some(self.flat(object));
        }
        if SYSTEM_KEYS.iter().all(|key| last(object, key).is_none()) {
            let span = self.span(object);
            self.notes.error(
                span.start..span.start + 1,
                say!("This is no L-system: it has neither an axiom nor rules"),
                say!("A system has the keys `initial` and `rules`."),
            );
            return None;
        }
        Some(self.definition(object))
    }

    fn definition(&mut self, object: &Object<'_>) -> Definition {
        let mut definition = Definition::default();
        self.check_keys(object, &[keys(Section::File), vec!["stochastic", "turtle", "style"]].concat());
        self.section(object, Section::File, &mut definition);
        if let Some(value) = last(object, "stochastic")
            && !matches!(value, Value::BooleanLit(_))
        {
            self.wrong_type("stochastic", Expected::Boolean, value);
        }
        self.rules(object, &mut definition);
        let turtle = self.object(object, "turtle");
        if let Some(turtle) = turtle {
            self.check_keys(turtle, &keys(Section::Turtle));
            self.section(turtle, Section::Turtle, &mut definition);
            self.overrides(turtle, &mut definition);
        }
        match last(object, "turtle") {
            Some(_) => definition.style = Style::for_dialect(definition.dialect),
            None => (definition.dialect, definition.style) = (Dialect::EveryLetter, Style::course()),
        }
        if let Some(style) = self.object(object, "style") {
            self.check_keys(style, &keys(Section::Style));
            self.section(style, Section::Style, &mut definition);
        }
        definition
    }

    /// Reads an object with the names of [`FIELDS`].
    fn flat(&mut self, object: &Object<'_>) -> Definition {
        let mut definition = Definition::default();
        let defined = || FIELDS.iter().filter(|spec| spec.is_defined());
        self.check_keys(object, &defined().map(|spec| spec.name).collect::<Vec<_>>());
        for spec in defined() {
            match last(object, spec.name) {
                Some(Value::NullKeyword(_)) if spec.optional => {}
                _ => self.field(object, spec, spec.name, &mut definition),
            }
        }
        self.rules(object, &mut definition);
        self.overrides(object, &mut definition);
        definition
    }

    /// Reads all fields of an object of a file.
    fn section(&mut self, object: &Object<'_>, section: Section, definition: &mut Definition) {
        for spec in &FIELDS {
            if let Some((place, key)) = spec.file
                && place == section
            {
                self.field(object, spec, key, definition);
            }
        }
    }

    /// Reads a field, unless it is one of [`OWN_FORMS`].
    fn field(&mut self, object: &Object<'_>, spec: &FieldSpec, key: &str, definition: &mut Definition) {
        if !OWN_FORMS.contains(&spec.name)
            && let Some(value) = last(object, key)
            && let Some(value) = self.value(key, spec.expected, value)
        {
            spec.set(definition, &value);
        }
    }

    /// The object under a key.
    fn object<'a, 'b>(&mut self, object: &'b Object<'a>, key: &str) -> Option<&'b Object<'a>> {
        match last(object, key)? {
            Value::Object(object) => Some(object),
            other => {
                self.wrong_type(key, Expected::Object, other);
                None
            }
        }
    }

    fn rules(&mut self, object: &Object<'_>, definition: &mut Definition) {
        let mut grammar = Grammar::default();
        match last(object, "rules") {
            None if self.names == Names::Fields => return,
            None => {}
            Some(Value::Object(rules)) => self.plain_rules(rules, &mut grammar),
            Some(other) => {
                if let Some(text) = self.lines("rules", Expected::Rules, other) {
                    definition.rules = self.text("rules", text, object);
                }
                return;
            }
        }
        let key = if self.names == Names::Keys { "initial" } else { "axiom" };
        if let Some(initial) = last(object, key) {
            grammar.axiom = self.plain_word(&definition.axiom, initial);
        }
        definition.axiom = self.text("axiom", print_axiom(&grammar), object);
        definition.rules = self.text("rules", print_rules(&grammar), object);
    }

    /// Reads the course's rules: each key is a symbol, and its value a successor or a list of outcomes.
    fn plain_rules(&mut self, rules: &Object<'_>, grammar: &mut Grammar) {
        self.check_keys(rules, &[]);
        // If a key stands twice, the last value counts.
        let replaced = repeated(rules.properties.iter().rev().map(|p| p.name.as_str()));
        for (property, replaced) in rules.properties.iter().zip(replaced.into_iter().rev()) {
            let Some(symbol) = self.symbol(property).filter(|_| !replaced) else { continue };
            match &property.value {
                Value::StringLit(successor) => {
                    let successor = self.plain_word(&successor.value, &property.value);
                    grammar.productions.push(Production::new(symbol, successor));
                }
                Value::Array(outcomes) => {
                    let mut sum = 0.0;
                    let mut sound = !outcomes.elements.is_empty();
                    for outcome in &outcomes.elements {
                        let Some((p, successor)) = self.outcome(outcome) else {
                            sound = false;
                            continue;
                        };
                        sum += p;
                        if p > 0.0 {
                            grammar.productions.push(Production::new(symbol, successor).weighted(p));
                        }
                    }
                    let span = self.span(outcomes);
                    if outcomes.elements.is_empty() || (sound && sum == 0.0) {
                        self.notes.error(
                            span,
                            say!("None of these outcomes can happen"),
                            say!("Write a string, or outcomes as {{\"p\": 0.5, \"e\": \"F+F\"}}."),
                        );
                    } else if sound && (sum - 1.0).abs() > 1e-5 {
                        self.notes.warn(
                            span,
                            say!("The probabilities sum to {}, not to 1", rounded(sum)),
                            say!("They are read as weights: each is divided by the sum."),
                        );
                    }
                }
                other => self.wrong_type(property.name.as_str(), Expected::Successor, other),
            }
        }
    }

    /// Reads an outcome, `{"p": 0.5, "e": "F"}`: its probability and successor.
    fn outcome(&mut self, value: &Value<'_>) -> Option<(f64, Vec<Module>)> {
        let Value::Object(outcome) = value else {
            self.wrong_type("rules", Expected::Outcome, value);
            return None;
        };
        self.check_keys(outcome, &OUTCOME_KEYS);
        for key in OUTCOME_KEYS {
            if last(outcome, key).is_none() {
                let hint = say!("An outcome is written as {{\"p\": 0.5, \"e\": \"F+F\"}}.");
                self.notes.error(self.span(outcome), say!("`{}` is missing", key), hint);
            }
        }
        let mut read = |key, expected| self.value(key, expected, last(outcome, key)?);
        let (p, successor) = (read("p", WEIGHT), read("e", Expected::String));
        let mut p = if let Some(Held::Number(p)) = p { p } else { f64::NAN };
        let successor = if let Some(Held::Text(text)) = successor { text } else { String::new() };
        let successor = self.plain_word(&successor, last(outcome, "e")?);
        // Weights this small count as 0.
        if p < 1e-100 {
            p = 0.0;
            let warning = Diagnostic::warning(say!("An outcome with probability 0 never happens"));
            self.notes.add(self.span(last(outcome, "p")?), warning);
        }
        (p >= 0.0).then_some((p, successor))
    }

    fn overrides(&mut self, turtle: &Object<'_>, definition: &mut Definition) {
        let text = match last(turtle, "overrides") {
            None => return,
            Some(Value::Object(overrides)) => self.override_lines(overrides),
            Some(other) => self.lines("overrides", Expected::Overrides, other).unwrap_or_default(),
        };
        definition.overrides = self.text("overrides", text, turtle);
    }

    fn override_lines(&mut self, overrides: &Object<'_>) -> String {
        self.check_keys(overrides, &[]);
        let mut lines = Vec::new();
        for property in &overrides.properties {
            let Some(symbol) = self.symbol(property) else { continue };
            match &property.value {
                Value::StringLit(actions) => lines.push(lsystem_syntax::overrides::line(symbol, &actions.value)),
                other => self.wrong_type(property.name.as_str(), Expected::String, other),
            }
        }
        lines.join("\n")
    }
}

/// Fields whose values have special forms in files.
const OWN_FORMS: [&str; 2] = ["rules", "overrides"];

/// The keys of an object.
fn keys(section: Section) -> Vec<&'static str> {
    FIELDS.iter().filter_map(|spec| spec.file).filter(|file| file.0 == section).map(|file| file.1).collect()
}

/// Whether a key is of unused data in the course's files.
fn is_disused(key: &str) -> bool {
    key.ends_with("_old") || key.starts_with('$')
}

/// The last property called `key`: if a key stands twice, the last value counts.
pub(super) fn last_property<'a, 'b>(object: &'b Object<'a>, key: &str) -> Option<&'b ObjectProp<'a>> {
    object.properties.iter().rev().find(|p| p.name.as_str() == key)
}

/// The value of the last property called `key`.
fn last<'a, 'b>(object: &'b Object<'a>, key: &str) -> Option<&'b Value<'a>> {
    last_property(object, key).map(|p| &p.value)
}

/// A number with at most six decimals.
fn rounded(value: f64) -> String {
    if value.abs() < 1e9 { number(libm::round(value * 1e6) / 1e6) } else { number(value) }
}

/// Why a text is not JSON, and where.
fn json_error(error: &ParseError, text: &str) -> (Diagnostic, Range<usize>) {
    use ParseErrorKind as E;
    let range = error.range();
    // The parser's ranges may exceed the text, so they are clamped.
    let floor = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = floor(range.start);
    // An unclosed part would be underlined to the end of the file, so only its first characters are marked.
    let first = |count: usize| floor(start + count);
    let (message, hint, end) = match error.kind() {
        E::ExpectedColonAfterObjectKey => (say!("A colon is missing after the key"), None, start),
        E::ExpectedComma => (say!("A comma is missing"), None, floor(range.end)),
        E::UnterminatedArray => (say!("This list is never closed"), Some(say!("Add `]`.")), first(1)),
        E::UnterminatedObject => (say!("This object is never closed"), Some(said(word!("Add `}`."))), first(1)),
        E::UnterminatedCommentBlock => (say!("This comment is never closed"), Some(say!("Add `*/`.")), first(2)),
        E::NestingDepthExceeded => (say!("The file is nested too deeply"), None, floor(range.end)),
        E::String(ParseStringErrorKind::UnterminatedStringLiteral) => {
            (say!("This string is never closed"), Some(say!("Add the closing quote.")), first(1))
        }
        E::String(_) => (
            say!("This escape is not known"),
            Some(say!("A backslash in a string is written twice: \"\\\\\".")),
            floor(range.end),
        ),
        E::ExpectedDigit
        | E::ExpectedDigitFollowingNegativeSign
        | E::ExpectedPlusMinusOrDigitInNumberLiteral
        | E::HexadecimalNumbersNotAllowed
        | E::NonFiniteNumbersNotAllowed => (say!("This is not a number"), None, floor(range.end)),
        // Of a text in no known notation, such as a program.
        _ if !text.trim_start().starts_with(['{', '[', '/']) => {
            (say!("This is no L-system: it has neither an axiom nor rules"), None, first(1))
        }
        _ => (
            say!("This has no place in JSON"),
            Some(say!("Is a quote or a comma missing before it?")),
            floor(range.end),
        ),
    };
    (Diagnostic::error(message).hint(hint), start..end.max(start))
}
