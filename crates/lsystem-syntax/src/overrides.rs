//! Custom symbols as text: actions that replace a dialect's.
//!
//! ```text
//! G: move
//! A: draw 10
//! B: turn left 90, draw 5
//! E: nothing
//! ```
//!
//! Each line has one symbol and its actions in order, separated by commas. Comments are as in rules.
//!
//! | action | meaning |
//! |---|---|
//! | `draw`, `draw 10` | forward with a line, by the step or by this length |
//! | `move`, `move 10` | forward without a line |
//! | `draw unmarked`, `move unmarked` | the same without vertices of an open polygon |
//! | `open polygon`, `vertex`, `close polygon` | a filled polygon: its vertices are where the first `draw` or `move` begins, where every `draw` and `move` ends, and where `vertex` stands |
//! | `turn left`, `turn left 90` | counter-clockwise, by the left angle or by these degrees |
//! | `turn right`, `turn right 90` | clockwise |
//! | `turn round` | by 180 degrees |
//! | `pitch down`, `pitch up 30` | the heading away from the turtle's up, or towards it |
//! | `roll left`, `roll right 30` | about the heading: the turtle's left rises, or sinks |
//! | `roll upright` | about the heading, until the turtle's left is level |
//! | `open branch`, `push`; `close branch`, `pop` | save and restore the turtle |
//! | `colour 3`, `next colour`, `next colour 2`, `previous colour` | choose from the palette, counted from 0 |
//! | `width 2`, `width times 0.5`, `thicker`, `thinner` | stroke width in steps, or by a factor (√2, 1/√2) |
//! | `circle`, `circle 2`, `disc`, `disc 2` | a circle or a filled disc around the turtle, with the step or this number as diameter |
//! | `leaf lance`, `leaf heart`, `leaf oak`, `leaf needle`, `leaf petal 2` | the filled outline of a leaf ahead of the turtle, with the step or this number as length |
//! | `open tube`, `tube point`, `close tube` | a smooth tube through the places of these symbols, along the turtle's headings there |
//! | `surface l`, `surface l 2` | the surface `l` of the system ([`parse_surfaces`](crate::parse_surfaces)) at the turtle, with the step or this number as size |
//! | `length times 0.5` | multiply all lengths from here on |
//! | `swap turns` | from here on, left turns go right and right turns go left |
//! | `cut branch` | in the next derivation step it and the rest of its branch are gone |
//! | `nothing` | no action at all |

use crate::notation::token::{Token, span_of, text_of, tokens};
use crate::notation::{is_comment, is_short_enough, lines};
use crate::notes::{Notes, similar};
use crate::print::symbol;
use crate::{Action, Class, Diagnostic, Expected, Field, Kind, Outline};
use core::f64::consts::{FRAC_1_SQRT_2, SQRT_2};
use core::ops::Range;
use lsystem_base::number::number;
use lsystem_base::sorted::repeated;
use lsystem_base::{LimitName, MAX_ACTIONS};

/// A symbol whose actions replace the dialect's.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// The symbol.
    pub symbol: char,
    /// The symbol's actions, in order; empty for none.
    pub actions: Vec<Action>,
}

/// Reads overrides, one on each line, with all diagnostics. If a symbol stands twice, the last line counts.
#[must_use]
pub fn parse_overrides(text: &str) -> (Vec<Override>, Vec<Diagnostic>) {
    let mut notes = Notes::new(Field::Overrides);
    let found = read(text, &mut notes);
    (found, notes.finish())
}

/// Reads overrides; the diagnostics go to `notes`.
pub(crate) fn read(text: &str, notes: &mut Notes) -> Vec<Override> {
    let (mut found, mut places) = (Vec::new(), Vec::new());
    if is_short_enough(text, notes) {
        for line in lines(text) {
            if is_comment(&text[line.clone()]) {
                notes.class(Class::Comment, line);
                continue;
            }
            let tokens = tokens(text, line.clone(), notes);
            if let Some((symbol, place)) = head(&tokens, line.end, notes) {
                notes.class(Class::Predecessor, place.clone());
                notes.class(Class::Mark, tokens[1].span());
                found.push(Override { symbol, actions: actions(&tokens[2..], line.end, notes) });
                places.push(place);
            }
        }
    }
    for ((Override { symbol, .. }, place), repeated) in found.iter().zip(places).zip(repeated(symbols(&found))) {
        if repeated {
            notes.add(Kind::OverrideTwice { symbol: *symbol }, place);
        }
    }
    let mut replaced = repeated(symbols(&found).rev());
    found.retain(|_| replaced.pop() == Some(false));
    found
}

fn symbols(overrides: &[Override]) -> impl DoubleEndedIterator<Item = char> {
    overrides.iter().map(|o| o.symbol)
}

/// Overrides as text that reads back as the same overrides.
#[must_use]
pub fn print_overrides(overrides: &[Override]) -> String {
    let lines: Vec<String> = overrides.iter().map(|o| line(o.symbol, &print_actions(&o.actions))).collect();
    lines.join("\n")
}

/// One line of overrides.
pub fn line(ch: char, actions: &str) -> String {
    let mut line = String::new();
    symbol(ch, ch == '#', &mut line);
    line.push_str(": ");
    line.push_str(actions);
    line
}

/// The symbols and actions of a text that [`line()`] could have written, each symbol once; `None` for other texts.
pub fn entries(text: &str) -> Option<Vec<(char, &str)>> {
    let mut entries = Vec::new();
    for place in text.split('\n').scan(0, |from, l| Some(core::mem::replace(from, *from + l.len() + 1)..*from - 1)) {
        let mut quiet = Notes::new(Field::Overrides);
        let tokens = tokens(text, place.clone(), &mut quiet);
        let (symbol, _) = head(&tokens, place.end, &mut quiet)?;
        let actions = text[tokens[1].span().end..place.end].trim_start();
        if line(symbol, actions) != text[place] {
            return None;
        }
        entries.push((symbol, actions));
    }
    let repeated = repeated(entries.iter().map(|entry| entry.0));
    (!repeated.contains(&true)).then_some(entries)
}

/// A symbol's actions in words: `draw`, `turn left 90, draw 5`, `nothing`.
#[must_use]
pub fn print_actions(actions: &[Action]) -> String {
    if actions.is_empty() {
        return "nothing".to_owned();
    }
    actions.iter().map(|&a| print_action(a)).collect::<Vec<_>>().join(", ")
}

fn print_action(action: Action) -> String {
    let optional = |words: &str, value: Option<f64>| match value {
        Some(value) => format!("{words} {}", number(value)),
        None => words.to_owned(),
    };
    match action {
        Action::Draw(length) => optional("draw", length),
        Action::Move(length) => optional("move", length),
        Action::DrawUnmarked(length) => optional("draw unmarked", length),
        Action::MoveUnmarked(length) => optional("move unmarked", length),
        Action::OpenPolygon => "open polygon".to_owned(),
        Action::Vertex => "vertex".to_owned(),
        Action::ClosePolygon => "close polygon".to_owned(),
        Action::OpenTube => "open tube".to_owned(),
        Action::TubePoint => "tube point".to_owned(),
        Action::CloseTube => "close tube".to_owned(),
        Action::TurnLeft(angle) => optional("turn left", angle),
        Action::TurnRight(angle) => optional("turn right", angle),
        Action::TurnRound => "turn round".to_owned(),
        Action::Cut => "cut branch".to_owned(),
        Action::PitchDown(angle) => optional("pitch down", angle),
        Action::PitchUp(angle) => optional("pitch up", angle),
        Action::RollLeft(angle) => optional("roll left", angle),
        Action::RollRight(angle) => optional("roll right", angle),
        Action::RollUpright => "roll upright".to_owned(),
        Action::Push => "open branch".to_owned(),
        Action::Pop => "close branch".to_owned(),
        Action::SetColour(index) => format!("colour {index}"),
        Action::AddColour(1) => "next colour".to_owned(),
        Action::AddColour(-1) => "previous colour".to_owned(),
        Action::AddColour(by) if by < 0 => format!("previous colour {}", by.unsigned_abs()),
        Action::AddColour(by) => format!("next colour {by}"),
        Action::SetWidth(width) => format!("width {}", number(width)),
        Action::ScaleWidth(SQRT_2) => "thicker".to_owned(),
        Action::ScaleWidth(FRAC_1_SQRT_2) => "thinner".to_owned(),
        Action::ScaleWidth(factor) => format!("width times {}", number(factor)),
        Action::ScaleLength(factor) => format!("length times {}", number(factor)),
        Action::SwapTurns => "swap turns".to_owned(),
        Action::Circle(diameter) => optional("circle", diameter),
        Action::Fill(outline, size) => optional(outline.words(), size),
        Action::Surface(name, size) => optional(&format!("surface {name}"), size),
    }
}

/// Reads the symbol before the colon at the start of a line. Returns the symbol and its span, in bytes.
fn head(tokens: &[Token], end: usize, notes: &mut Notes) -> Option<(char, Range<usize>)> {
    let &first = tokens.first()?;
    if tokens.get(1).is_some_and(|t| t.is(':')) {
        return Some((first.ch, first.span()));
    }
    // A colon further on: more or less than one symbol stands before it.
    if let Some(colon) = tokens.iter().position(|t| t.is(':')) {
        let before = &tokens[..colon];
        let place = if colon == 0 { &tokens[..1] } else { before };
        notes.add(Kind::OverrideSymbol { text: text_of(before) }, span_of(place, end));
        return None;
    }
    let rest = tokens[1..].iter().position(|t| !matches!(t.ch, '=' | '-' | '>' | '→'));
    let suggestion = rest.and_then(|from| {
        let phrase = phrase(&tokens[1 + from..]).to_ascii_lowercase();
        let known = action(&phrase, false).is_ok() && !tokens[1 + from].joined;
        known.then(|| format!("{}: {phrase}", first.ch))
    });
    let after = first.span().end;
    notes.add(Kind::OverrideColon { suggestion }, after..after.min(end));
    None
}

/// Reads the actions after the colon.
fn actions(tokens: &[Token], end: usize, notes: &mut Notes) -> Vec<Action> {
    let mut found = Vec::new();
    let mut nothing = None;
    let mut parts: Vec<&[Token]> = tokens.split(|t| t.is(',')).collect();
    if let Some(&more) = parts.get(MAX_ACTIONS) {
        let kind = Kind::Limit { limit: LimitName::Actions, value: MAX_ACTIONS as u64, largest: None };
        notes.add(kind, span_of(more, end).start..end);
        parts.truncate(MAX_ACTIONS);
    }
    let mut missing_at = end;
    for part in parts.iter().rev() {
        let span = span_of(part, missing_at);
        missing_at = part.first().map_or(missing_at, |t| t.span().start);
        let phrase = phrase(part);
        if phrase.eq_ignore_ascii_case("nothing") || phrase.eq_ignore_ascii_case("none") {
            nothing = Some(span);
            continue;
        }
        match action(&phrase, !notes.is_full()) {
            Ok(action) => found.push(action),
            Err(kind) => notes.add(kind, span),
        }
    }
    if let Some(span) = nothing
        && parts.len() > 1
    {
        notes.add(Kind::NothingElse, span);
    }
    found.reverse();
    found
}

/// The words of an action with single spaces between them.
fn phrase(tokens: &[Token]) -> String {
    let mut phrase = String::new();
    for (at, token) in tokens.iter().enumerate() {
        if at > 0 && !token.joined {
            phrase.push(' ');
        }
        phrase.push(token.ch);
    }
    phrase
}

/// The number after the words of an action.
#[derive(Clone, Copy)]
enum NumberForm {
    /// No number.
    Plain(Action),
    /// An optional number between -[`MOST`] and [`MOST`].
    Optional(fn(Option<f64>) -> Action),
    /// As `Optional`: the size of an outline that is filled.
    Size(Outline),
    /// As `Optional`: the size of a surface.
    Surface(char),
    /// A number in this range.
    Number(fn(f64) -> Action, Expected),
    /// A palette index.
    Index,
    /// An optional number of places along the palette, 1 by default, times this direction.
    Along(i64),
}

/// The largest length, angle, width or factor that is accepted.
const MOST: f64 = 1e9;

/// The words of all actions except `nothing`.
const FORMS: [(&str, NumberForm); 44] = [
    ("draw", NumberForm::Optional(Action::Draw)),
    ("move", NumberForm::Optional(Action::Move)),
    ("draw unmarked", NumberForm::Optional(Action::DrawUnmarked)),
    ("move unmarked", NumberForm::Optional(Action::MoveUnmarked)),
    ("open polygon", NumberForm::Plain(Action::OpenPolygon)),
    ("vertex", NumberForm::Plain(Action::Vertex)),
    ("close polygon", NumberForm::Plain(Action::ClosePolygon)),
    ("open tube", NumberForm::Plain(Action::OpenTube)),
    ("tube point", NumberForm::Plain(Action::TubePoint)),
    ("close tube", NumberForm::Plain(Action::CloseTube)),
    ("turn left", NumberForm::Optional(Action::TurnLeft)),
    ("turn right", NumberForm::Optional(Action::TurnRight)),
    ("turn round", NumberForm::Plain(Action::TurnRound)),
    ("turn around", NumberForm::Plain(Action::TurnRound)),
    ("cut branch", NumberForm::Plain(Action::Cut)),
    ("pitch down", NumberForm::Optional(Action::PitchDown)),
    ("pitch up", NumberForm::Optional(Action::PitchUp)),
    ("roll left", NumberForm::Optional(Action::RollLeft)),
    ("roll right", NumberForm::Optional(Action::RollRight)),
    ("roll upright", NumberForm::Plain(Action::RollUpright)),
    ("open branch", NumberForm::Plain(Action::Push)),
    ("push", NumberForm::Plain(Action::Push)),
    ("close branch", NumberForm::Plain(Action::Pop)),
    ("pop", NumberForm::Plain(Action::Pop)),
    ("colour", NumberForm::Index),
    ("color", NumberForm::Index),
    ("next colour", NumberForm::Along(1)),
    ("next color", NumberForm::Along(1)),
    ("previous colour", NumberForm::Along(-1)),
    ("previous color", NumberForm::Along(-1)),
    ("width", NumberForm::Number(Action::SetWidth, Expected::Between(0.0, MOST))),
    ("width times", NumberForm::Number(Action::ScaleWidth, Expected::PositiveUpTo(MOST))),
    ("thicker", NumberForm::Plain(Action::ScaleWidth(SQRT_2))),
    ("thinner", NumberForm::Plain(Action::ScaleWidth(FRAC_1_SQRT_2))),
    ("length times", NumberForm::Number(Action::ScaleLength, Expected::Between(0.0, MOST))),
    ("swap turns", NumberForm::Plain(Action::SwapTurns)),
    ("circle", NumberForm::Optional(Action::Circle)),
    ("disc", NumberForm::Size(Outline::Disc)),
    ("disk", NumberForm::Size(Outline::Disc)),
    ("leaf lance", NumberForm::Size(Outline::Lance)),
    ("leaf heart", NumberForm::Size(Outline::Heart)),
    ("leaf oak", NumberForm::Size(Outline::Oak)),
    ("leaf needle", NumberForm::Size(Outline::Needle)),
    ("leaf petal", NumberForm::Size(Outline::Petal)),
];

fn form(words: &str) -> Option<NumberForm> {
    FORMS.iter().find(|(name, _)| name.eq_ignore_ascii_case(words)).map(|&(_, form)| form)
}

/// The name in `surface l`.
fn surface(words: &str) -> Option<char> {
    let (word, name) = words.split_once(' ')?;
    let mut letters = name.chars();
    let name = letters.next().filter(|name| name.is_alphabetic() && letters.next().is_none())?;
    word.eq_ignore_ascii_case("surface").then_some(name)
}

/// Reads one action: words, then perhaps a number. With `hint`, an error names a similar action.
fn action(phrase: &str, hint: bool) -> Result<Action, Kind> {
    let number_at = phrase.find(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.')).unwrap_or(phrase.len());
    let (words, digits) = (phrase[..number_at].trim_end(), &phrase[number_at..]);
    let Some(form) = form(words).or_else(|| surface(words).map(NumberForm::Surface)) else {
        let known = FORMS.iter().map(|&(name, _)| name).chain(["nothing"]);
        return Err(Kind::UnknownAction {
            text: crate::notes::excerpt(phrase),
            similar: if hint { similar(words, known) } else { None },
        });
    };
    let wrong = |expected| Err(Kind::ActionNumber { expected });
    let value = lsystem_base::decimal::read(digits);
    let whole = digits.parse::<i64>().ok();
    const WHOLE: Expected = Expected::Whole(i32::MIN as i64, i32::MAX as i64);
    match form {
        NumberForm::Plain(action) if digits.is_empty() => Ok(action),
        NumberForm::Plain(_) => wrong(Expected::Nothing),
        NumberForm::Optional(_) | NumberForm::Size(_) | NumberForm::Surface(_) => {
            let number = match value {
                _ if digits.is_empty() => None,
                Some(value) if value.abs() <= MOST => Some(value),
                _ => return wrong(Expected::Between(-MOST, MOST)),
            };
            match form {
                NumberForm::Size(outline) => Ok(Action::Fill(outline, number)),
                NumberForm::Surface(name) => Ok(Action::Surface(name, number)),
                NumberForm::Optional(make) => Ok(make(number)),
                _ => wrong(Expected::Nothing),
            }
        }
        NumberForm::Number(make, expected) => match value {
            Some(v) if expected.admits(v) => Ok(make(v)),
            _ => wrong(expected),
        },
        NumberForm::Index => match whole.and_then(|v| i32::try_from(v).ok()) {
            Some(index) => Ok(Action::SetColour(index)),
            None => wrong(WHOLE),
        },
        NumberForm::Along(direction) => {
            let by = if digits.is_empty() { Some(1) } else { whole };
            match by.and_then(|by| by.checked_mul(direction)).and_then(|by| i32::try_from(by).ok()) {
                Some(by) => Ok(Action::AddColour(by)),
                None => wrong(WHOLE),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hint_for_an_unknown_action_names_all_actions() {
        let hint = parse_overrides("X: qqqqqq").1[0].hint().unwrap();
        let spelt_otherwise = ["turn around", "push", "pop", "color", "next color", "previous color", "disk"];
        for (name, _) in FORMS.iter().filter(|(name, _)| !spelt_otherwise.contains(name)) {
            assert!(hint.contains(name), "{name}: {hint}");
        }
    }
}
