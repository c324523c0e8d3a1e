//! Systems as JSON files.
//!
//! An object; comments, trailing commas and unquoted keys are accepted. All keys may be missing.
//!
//! | key | type, default | meaning |
//! |---|---|---|
//! | `name`, `title`, `source`, `notes` | string, `""` | words about the system |
//! | `stochastic` | boolean | says nothing: the rules decide |
//! | `initial` | string, `""` | the axiom |
//! | `angle_deg` | number, 0 | the angle of a turn, in degrees |
//! | `num_iters` | whole number, 1 | derivation steps |
//! | `rules` | see below | productions |
//! | `seed` | whole number, 0 | selects among the outcomes of stochastic productions |
//! | `turtle` | object | what symbols do; see below |
//! | `style` | object | colours and widths; see below |
//!
//! `rules` is an object in the course's files: `{"F": "F+F", "X": [{"p": 0.5, "e": "XF"}, {"p": 0.5, "e": "X"}]}`. Its
//! strings and `initial` are plain characters then, each a symbol, white space included; nothing in them has another
//! meaning. Probabilities that do not sum to 1 are read as weights. Otherwise `rules` is a list of lines, or one string,
//! in our notation, and so is `initial`.
//!
//! A file without `turtle` is one of the course's: every letter draws ([`Dialect::EveryLetter`]), the style is
//! [`Style::course`]. `turtle` holds
//!
//! | key | type, default | meaning |
//! |---|---|---|
//! | `dialect` | `"abop"` (the default), `"every-letter"`, `"practical"`, `"lowercase"`, `"axes"` | what symbols do |
//! | `overrides` | object, `{}` | exceptions, as in `{"G": "move", "A": "draw 10"}`; or a list of lines `"G: move"` |
//! | `right_angle_deg` | number | the angle of a right turn, where it is not `angle_deg` |
//! | `pitch_down_deg`, `pitch_up_deg` | number | the angle of pitching down, where it is not `angle_deg`; of pitching up, where that is another |
//! | `roll_left_deg`, `roll_right_deg` | number | of rolling left and right, in the same way |
//! | `heading_deg` | number, 90 | at the start, degrees counter-clockwise from +x |
//! | `step` | number, 1 | the step length, in model units |
//! | `start` | `[x, y]`, `[0, 0]` | where the turtle starts, in model units, y up |
//! | `tropism` | `[x, y, z]`, `[0, -1, 0]` | what branches bend towards, z towards the viewer |
//! | `elasticity` | number, 0 | how easily they bend |
//! | `length_factor` | number, 1 | what every branch multiplies lengths by |
//! | `angle_variation`, `length_variation` | number, 0 | by how much angles and lengths differ at random, at most; percent |
//! | `growth` | number, 1 | how far what the last derivation step made has grown |
//!
//! and `style`, whose defaults are those of [`Style::for_dialect`],
//!
//! | key | type | meaning |
//! |---|---|---|
//! | `palette` | list of colours such as `"#1f5c3a"` | the stroke colours |
//! | `colour_by` | `"symbol"`, `"single"`, `"level"`, `"turn"`, `"generation"`, `"path"`, `"density"` | what the colour follows |
//! | `palette_holds` | bool | whether by level and by generation what is beyond the palette has its last colour |
//! | `turn_colours` | `[left, right]` | the palette's indices that turns choose, by turn |
//! | `background` | colour | behind the drawing |
//! | `width` | number | the stroke width, in multiples of the step length |
//! | `width_factor` | number | what every branch multiplies it by |
//! | `min_width` | number | the least stroke width, in CSS pixels |
//! | `ink` | `"solid"`, `"density"` | whether strokes cover each other or their ink adds up |
//! | `exposure` | number | how much of the ink shows where it adds up, in stops |
//!
//! Unknown keys are reported and skipped.

mod value;

use core::ops::Range;
use jsonc_parser::ast::{Object, ObjectProp, Value};
use jsonc_parser::common::Ranged;
use jsonc_parser::errors::{ParseError, ParseErrorKind};
use jsonc_parser::{CollectOptions, ParseOptions, ParseStringErrorKind, parse_to_ast};
use lsystem_syntax::notes::{Notes, excerpt, similar};
use lsystem_syntax::sorted::repeated;
use lsystem_syntax::{
    Colour, ColourBy, Definition, Diagnostic, Dialect, Expected, Field, Grammar, Ink, JsonError, Kind, LimitName,
    MAX_ITERATIONS, MAX_PALETTE, Module, Production, Quantity, Style, plain_word, print_axiom, print_rules,
};

/// The keys of a file.
const KEYS: [&str; 12] = [
    "name",
    "title",
    "source",
    "notes",
    "stochastic",
    "initial",
    "angle_deg",
    "num_iters",
    "rules",
    "seed",
    "turtle",
    "style",
];
/// The keys of `turtle`.
const TURTLE_KEYS: [&str; 16] = [
    "dialect",
    "overrides",
    "right_angle_deg",
    "pitch_down_deg",
    "pitch_up_deg",
    "roll_left_deg",
    "roll_right_deg",
    "heading_deg",
    "step",
    "start",
    "tropism",
    "elasticity",
    "length_factor",
    "angle_variation",
    "length_variation",
    "growth",
];
/// The keys of `style`.
const STYLE_KEYS: [&str; 10] = [
    "palette",
    "colour_by",
    "palette_holds",
    "turn_colours",
    "background",
    "width",
    "width_factor",
    "min_width",
    "ink",
    "exposure",
];
/// The keys of an outcome.
const OUTCOME_KEYS: [&str; 2] = ["p", "e"];

/// What other programs call them.
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

/// Reads a file. There is a definition unless a diagnostic is an error; whether it makes a system is for
/// [`System::new`](lsystem_drawing::System::new) to say.
#[must_use]
pub fn read_json(text: &str) -> (Option<Definition>, Vec<Diagnostic>) {
    let mut file = File { notes: Notes::new(Field::File), base: 0 };
    let definition = file.read(text);
    let diagnostics = file.notes.finish();
    let definition = definition.filter(|_| !diagnostics.iter().any(Diagnostic::is_error));
    (definition, diagnostics)
}

struct File {
    notes: Notes,
    /// Bytes before the text that the parser sees.
    base: usize,
}

impl File {
    fn read(&mut self, text: &str) -> Option<Definition> {
        if !lsystem_syntax::notation::is_short_enough(text, &mut self.notes) {
            return None;
        }
        let body = text.strip_prefix('\u{feff}').unwrap_or(text);
        self.base = text.len() - body.len();
        let options = ParseOptions {
            allow_missing_commas: false,
            allow_hexadecimal_numbers: false,
            allow_non_finite_numbers: false,
            allow_extended_string_escapes: false,
            ..ParseOptions::default()
        };
        match parse_to_ast(body, &CollectOptions::default(), &options) {
            Ok(parsed) => match parsed.value {
                Some(Value::Object(object)) => Some(self.definition(&object)),
                Some(other) => {
                    self.wrong_type("", Expected::Object, &other);
                    None
                }
                None => {
                    self.notes.add(Kind::Json(JsonError::Empty), text.len()..text.len());
                    None
                }
            },
            Err(error) => {
                let (error, mut span) = json_error(&error, body);
                span = span.start + self.base..span.end + self.base;
                self.notes.add(Kind::Json(error), span);
                None
            }
        }
    }

    fn definition(&mut self, object: &Object<'_>) -> Definition {
        self.check_keys(object, &KEYS);
        let mut definition = Definition::default();
        for (key, text) in [
            ("name", &mut definition.name),
            ("title", &mut definition.title),
            ("source", &mut definition.source),
            ("notes", &mut definition.notes),
            ("initial", &mut definition.axiom),
        ] {
            self.string(object, key, text);
        }
        if let Some(value) = last(object, "stochastic")
            && !matches!(value, Value::BooleanLit(_))
        {
            self.wrong_type("stochastic", Expected::Boolean, value);
        }
        self.number(object, "angle_deg", Quantity::Angle.expected(), &mut definition.angle);
        let mut iterations = f64::from(definition.iterations);
        self.number(object, "num_iters", Expected::Whole(0, i64::from(MAX_ITERATIONS)), &mut iterations);
        definition.iterations = iterations as u32;
        let mut seed = 0.0;
        self.number(object, "seed", Expected::Whole(0, i64::from(u32::MAX)), &mut seed);
        definition.seed = seed as u32;

        self.rules(object, &mut definition);
        if let Some(turtle) = last(object, "turtle") {
            match turtle {
                Value::Object(turtle) => self.turtle(turtle, &mut definition),
                other => self.wrong_type("turtle", Expected::Object, other),
            }
            definition.style = Style::for_dialect(definition.dialect);
        } else {
            definition.dialect = Dialect::EveryLetter;
            definition.style = Style::course();
        }
        match last(object, "style") {
            None => {}
            Some(Value::Object(style)) => self.style(style, &mut definition.style),
            Some(other) => self.wrong_type("style", Expected::Object, other),
        }
        definition
    }

    fn rules(&mut self, object: &Object<'_>, definition: &mut Definition) {
        let mut grammar = Grammar::default();
        match last(object, "rules") {
            None => {}
            Some(Value::Object(rules)) => self.plain_rules(rules, &mut grammar),
            Some(other) => {
                if let Some(text) = self.lines("rules", Expected::Rules, other) {
                    definition.rules = text;
                }
                return;
            }
        }
        if let Some(initial) = last(object, "initial") {
            self.check_spaces(&definition.axiom, initial);
        }
        grammar.axiom = plain_word(&definition.axiom);
        definition.axiom = print_axiom(&grammar);
        definition.rules = print_rules(&grammar);
    }

    /// The course's rules: symbol -> successor, or symbol -> outcomes.
    fn plain_rules(&mut self, rules: &Object<'_>, grammar: &mut Grammar) {
        self.check_keys(rules, &[]);
        // Where a key stands twice, the last counts.
        let replaced = repeated(rules.properties.iter().rev().map(|p| p.name.as_str()));
        for (property, replaced) in rules.properties.iter().zip(replaced.into_iter().rev()) {
            let Some(symbol) = self.symbol(property).filter(|_| !replaced) else { continue };
            match &property.value {
                Value::StringLit(successor) => {
                    self.check_spaces(&successor.value, &property.value);
                    let successor = plain_word(&successor.value);
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
                        self.notes.add(Kind::NoOutcome, span);
                    } else if sound && (sum - 1.0).abs() > 1e-5 {
                        self.notes.add(Kind::ProbabilitySum { sum }, span);
                    }
                }
                other => self.wrong_type(property.name.as_str(), Expected::Successor, other),
            }
        }
    }

    /// `{"p": 0.5, "e": "F"}`.
    fn outcome(&mut self, value: &Value<'_>) -> Option<(f64, Vec<Module>)> {
        let Value::Object(outcome) = value else {
            self.wrong_type("rules", Expected::Outcome, value);
            return None;
        };
        self.check_keys(outcome, &OUTCOME_KEYS);
        for key in OUTCOME_KEYS {
            if last(outcome, key).is_none() {
                self.notes.add(Kind::MissingKey { key }, self.span(outcome));
            }
        }
        let (mut p, mut successor) = (f64::NAN, String::new());
        self.number(outcome, "p", WEIGHT, &mut p);
        self.string(outcome, "e", &mut successor);
        self.check_spaces(&successor, last(outcome, "e")?);
        // Weights this small cannot be told from none.
        if p < 1e-100 {
            p = 0.0;
            self.notes.add(Kind::ProbabilityZero, self.span(last(outcome, "p")?));
        }
        (p >= 0.0).then(|| (p, plain_word(&successor)))
    }

    fn turtle(&mut self, turtle: &Object<'_>, definition: &mut Definition) {
        self.check_keys(turtle, &TURTLE_KEYS);
        if let Some(dialect) = self.word(turtle, "dialect", &Dialect::NAMES) {
            definition.dialect = Dialect::ALL[dialect];
        }
        let usual = definition.angle;
        for (key, quantity, into) in [
            ("right_angle_deg", Quantity::RightAngle, &mut definition.right_angle),
            ("pitch_down_deg", Quantity::Pitch, &mut definition.pitch_down),
            ("pitch_up_deg", Quantity::Pitch, &mut definition.pitch_up),
            ("roll_left_deg", Quantity::Roll, &mut definition.roll_left),
            ("roll_right_deg", Quantity::Roll, &mut definition.roll_right),
        ] {
            if last(turtle, key).is_some() {
                self.number(turtle, key, quantity.expected(), into.insert(usual));
            }
        }
        self.number(turtle, "heading_deg", Quantity::Heading.expected(), &mut definition.heading);
        self.number(turtle, "step", Quantity::Step.expected(), &mut definition.step);
        self.point(turtle, "start", Quantity::Start, Expected::Point, &mut definition.start);
        self.point(turtle, "tropism", Quantity::Tropism, Expected::Vector, &mut definition.tropism);
        for (key, quantity, into) in [
            ("elasticity", Quantity::Elasticity, &mut definition.elasticity),
            ("length_factor", Quantity::LengthFactor, &mut definition.length_factor),
            ("angle_variation", Quantity::AngleVariation, &mut definition.angle_variation),
            ("length_variation", Quantity::LengthVariation, &mut definition.length_variation),
            ("growth", Quantity::Growth, &mut definition.growth),
        ] {
            self.number(turtle, key, quantity.expected(), into);
        }
        match last(turtle, "overrides") {
            None => {}
            Some(Value::Object(overrides)) => definition.overrides = self.overrides(overrides),
            Some(other) => {
                definition.overrides = self.lines("overrides", Expected::Overrides, other).unwrap_or_default();
            }
        }
    }

    fn overrides(&mut self, overrides: &Object<'_>) -> String {
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

    fn style(&mut self, object: &Object<'_>, style: &mut Style) {
        self.check_keys(object, &STYLE_KEYS);
        if let Some(value) = last(object, "palette") {
            match value {
                Value::Array(colours) if colours.elements.is_empty() => {
                    self.notes.add(Kind::EmptyPalette, self.span(value));
                }
                Value::Array(colours) if colours.elements.len() > MAX_PALETTE => {
                    let kind = Kind::Limit { limit: LimitName::Palette, value: MAX_PALETTE as u64, largest: None };
                    self.notes.add(kind, self.span(value));
                }
                Value::Array(colours) => {
                    style.palette = colours.elements.iter().filter_map(|c| self.colour("palette", c)).collect();
                }
                other => self.wrong_type("palette", Expected::List, other),
            }
        }
        if let Some(by) = self.word(object, "colour_by", &ColourBy::NAMES) {
            style.colour_by = ColourBy::ALL[by];
        }
        if let Some(value) = last(object, "background") {
            style.background = self.colour("background", value).unwrap_or(style.background);
        }
        match last(object, "palette_holds") {
            None => {}
            Some(Value::BooleanLit(value)) => style.palette_holds = value.value,
            Some(other) => self.wrong_type("palette_holds", Expected::Boolean, other),
        }
        let mut turns = style.turn_colours.map(f64::from);
        self.point(object, "turn_colours", Quantity::TurnColour, Expected::Point, &mut turns);
        style.turn_colours = turns.map(|index| index as i32);
        self.number(object, "width", Quantity::Width.expected(), &mut style.width);
        self.number(object, "width_factor", Quantity::WidthFactor.expected(), &mut style.width_factor);
        self.number(object, "min_width", Quantity::MinWidth.expected(), &mut style.min_width);
        if let Some(ink) = self.word(object, "ink", &Ink::NAMES) {
            style.ink = Ink::ALL[ink];
        }
        self.number(object, "exposure", Quantity::Exposure.expected(), &mut style.exposure);
    }

    fn colour(&mut self, key: &str, value: &Value<'_>) -> Option<Colour> {
        let Value::StringLit(text) = value else {
            self.wrong_type(key, Expected::Colour, value);
            return None;
        };
        let colour = text.value.parse().ok();
        if colour.is_none() {
            self.wrong_value(key, Expected::Colour, value);
        }
        colour
    }
}

/// Keys in which the course's files keep what they no longer use.
fn is_disused(key: &str) -> bool {
    key.ends_with("_old") || key.starts_with('$')
}

/// The value of the last property called `key`: where a key stands twice, the last counts.
fn last<'a, 'b>(object: &'b Object<'a>, key: &str) -> Option<&'b Value<'a>> {
    object.properties.iter().rev().find(|p| p.name.as_str() == key).map(|p| &p.value)
}

fn json_error(error: &ParseError, text: &str) -> (JsonError, Range<usize>) {
    use ParseErrorKind as E;
    let kind = match error.kind() {
        E::ExpectedColonAfterObjectKey => JsonError::MissingColon,
        E::ExpectedComma => JsonError::MissingComma,
        E::UnterminatedArray => JsonError::UnclosedArray,
        E::UnterminatedObject => JsonError::UnclosedObject,
        E::UnterminatedCommentBlock => JsonError::UnclosedComment,
        E::NestingDepthExceeded => JsonError::Depth,
        E::String(ParseStringErrorKind::UnterminatedStringLiteral) => JsonError::UnclosedString,
        E::String(_) => JsonError::Escape,
        E::ExpectedDigit
        | E::ExpectedDigitFollowingNegativeSign
        | E::ExpectedPlusMinusOrDigitInNumberLiteral
        | E::HexadecimalNumbersNotAllowed
        | E::NonFiniteNumbersNotAllowed => JsonError::Number,
        _ => JsonError::Unexpected,
    };
    let range = error.range();
    // The parser's ranges are trusted only as far as the text goes.
    let floor = |mut at: usize| {
        at = at.min(text.len());
        while !text.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = floor(range.start);
    let end = match kind {
        // What is not closed would be underlined to the end of the file: its first character is enough.
        JsonError::UnclosedObject | JsonError::UnclosedArray | JsonError::UnclosedString => floor(start + 1),
        JsonError::UnclosedComment => floor(start + 2),
        JsonError::MissingColon => start,
        _ => floor(range.end),
    };
    (kind, start..end.max(start))
}
