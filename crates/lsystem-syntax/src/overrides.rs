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
//! The words of all actions are in [`ACTIONS`], and `docs/notation.md` describes them for users.

use crate::action::MAX;
use crate::notation::token::{Token, span_of, text_of, tokens};
use crate::notation::{is_comment, is_short_enough, lines};
use crate::notes::{DiagnosticList, named, similar};
use crate::print::symbol;
use crate::{ACTIONS, Action, ActionRow, Class, Diagnostic, Expected, Field, NumberForm};
use core::ops::Range;
use lsystem_base::number::number;
use lsystem_base::sorted::repeated;
use lsystem_base::{LimitName, MAX_ACTIONS, say};

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
    let mut notes = DiagnosticList::new(Field::Overrides);
    let found = read(text, &mut notes);
    (found, notes.finish())
}

/// Reads overrides; the diagnostics go to `notes`.
pub(crate) fn read(text: &str, notes: &mut DiagnosticList) -> Vec<Override> {
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
            notes.add(place, Diagnostic::warning(say!("This replaces the line for {} above", named(*symbol))));
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
        let mut quiet = DiagnosticList::new(Field::Overrides);
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
    let row = action.row();
    let words = row.words[0];
    match action {
        _ if matches!(row.form, NumberForm::Plain(_)) => words.to_owned(),
        Action::SetColour(index) => format!("{words} {index}"),
        Action::AddColour(1 | -1) => words.to_owned(),
        Action::AddColour(by) => format!("{words} {}", by.unsigned_abs()),
        Action::Surface(name, size) => optional(&format!("{words} {name}"), size),
        _ => optional(words, action.number()),
    }
}

/// Reads the symbol before the colon at the start of a line. Returns the symbol and its span, in bytes.
fn head(tokens: &[Token], end: usize, notes: &mut DiagnosticList) -> Option<(char, Range<usize>)> {
    let &first = tokens.first()?;
    if tokens.get(1).is_some_and(|t| t.is(':')) {
        return Some((first.ch, first.span()));
    }
    // A colon further on: more or less than one symbol stands before it.
    if let Some(colon) = tokens.iter().position(|t| t.is(':')) {
        let before = &tokens[..colon];
        let place = if colon == 0 { &tokens[..1] } else { before };
        let (message, hint) = match text_of(before) {
            text if text.is_empty() => (say!("There is no symbol before the `:`"), say!("Write one, as in `G: move`.")),
            text => {
                (say!("`{}` is not one symbol", text), say!("Give each symbol a line of its own, as in `G: move`."))
            }
        };
        notes.error(span_of(place, end), message, hint);
        return None;
    }
    let rest = tokens[1..].iter().position(|t| !matches!(t.ch, '=' | '-' | '>' | '→'));
    let suggestion = rest.and_then(|from| {
        let phrase = phrase(&tokens[1 + from..]).to_ascii_lowercase();
        let known = action(&phrase, false).is_ok() && !tokens[1 + from].joined;
        known.then(|| format!("{}: {phrase}", first.ch))
    });
    let after = first.span().end;
    let hint = say!("Write `{}`.", suggestion.as_deref().unwrap_or("G: move"));
    notes.error(after..after.min(end), say!("There is no `:` after the symbol"), hint);
    None
}

/// Reads the actions after the colon.
fn actions(tokens: &[Token], end: usize, notes: &mut DiagnosticList) -> Vec<Action> {
    let mut found = Vec::new();
    let mut nothing = None;
    let mut parts: Vec<&[Token]> = tokens.split(|t| t.is(',')).collect();
    if let Some(&more) = parts.get(MAX_ACTIONS) {
        let limit = Diagnostic::limit(LimitName::Actions, MAX_ACTIONS as u64, None);
        notes.add(span_of(more, end).start..end, limit);
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
            Err(error) => notes.add(span, error),
        }
    }
    if let Some(span) = nothing
        && parts.len() > 1
    {
        let hint = say!("Leave `nothing` out, or the others.");
        notes.error(span, say!("`nothing` stands together with other actions"), hint);
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

/// The form of the number after these words of an action.
fn form(words: &str) -> Option<NumberForm> {
    spellings().find(|(name, _)| name.eq_ignore_ascii_case(words)).map(|(_, form)| form)
}

/// The words of all actions that need no name, in all spellings.
fn spellings() -> impl Iterator<Item = (&'static str, NumberForm)> {
    let rows = ACTIONS.iter().filter(|row| !matches!(row.form, NumberForm::Surface));
    rows.flat_map(|row| row.words.iter().map(|words| (*words, row.form)))
}

/// The name in `surface l`.
fn surface(words: &str) -> Option<char> {
    let (word, name) = words.split_once(' ')?;
    let mut letters = name.chars();
    let name = letters.next().filter(|name| name.is_alphabetic() && letters.next().is_none())?;
    word.eq_ignore_ascii_case("surface").then_some(name)
}

/// Reads one action: words, then perhaps a number. With `hint`, an error names a similar action.
fn action(phrase: &str, hint: bool) -> Result<Action, Diagnostic> {
    let number_at = phrase.find(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.')).unwrap_or(phrase.len());
    let (words, digits) = (phrase[..number_at].trim_end(), &phrase[number_at..]);
    let surface = surface(words);
    let Some(form) = form(words).or(surface.map(|_| NumberForm::Surface)) else {
        return Err(unknown(phrase, words, hint));
    };
    let wrong = |expected: Expected| match expected {
        Expected::Nothing => Err(Diagnostic::error(say!("This action takes no number"))),
        _ => Err(Diagnostic::error(say!("This action needs {}", expected.words()))),
    };
    let value = lsystem_base::decimal::read(digits);
    let whole = digits.parse::<i64>().ok();
    const WHOLE: Expected = Expected::Whole(i32::MIN as i64, i32::MAX as i64);
    match form {
        NumberForm::Plain(action) if digits.is_empty() => Ok(action),
        NumberForm::Plain(_) => wrong(Expected::Nothing),
        NumberForm::Length(_) | NumberForm::Angle(_) | NumberForm::Surface => {
            let number = match value {
                _ if digits.is_empty() => None,
                Some(value) if value.abs() <= MAX => Some(value),
                _ => return wrong(Expected::Between(-MAX, MAX)),
            };
            match (form, surface) {
                (NumberForm::Length(make) | NumberForm::Angle(make), _) => Ok(make(number)),
                (_, Some(name)) => Ok(Action::Surface(name, number)),
                _ => wrong(Expected::Nothing),
            }
        }
        NumberForm::Number(make, expected, _) => match value {
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

/// The error for a phrase whose words are no action.
fn unknown(phrase: &str, words: &str, hint: bool) -> Diagnostic {
    let known = spellings().map(|(name, _)| name).chain(["nothing"]);
    let similar = if hint { similar(words, known) } else { None };
    let message = match crate::notes::excerpt(phrase) {
        text if text.is_empty() => say!("An action is missing here"),
        text => say!("`{}` is not an action", text),
    };
    let hint = match similar {
        Some(similar) => say!("Did you mean `{}`?", similar),
        None => {
            let all = ACTIONS.iter().map(ActionRow::example).map(|(words, number)| words + number);
            say!("Actions are {}.", all.chain(["nothing".to_owned()]).collect::<Vec<_>>().join(", "))
        }
    };
    Diagnostic::error(message).hint(hint).fix(similar.map(str::to_owned))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hint_for_an_unknown_action_names_all_actions() {
        let hint = parse_overrides("X: qqqqqq").1[0].hint.clone().unwrap();
        let all = "Actions are draw, move, draw unmarked, move unmarked, turn left, turn right, turn round, pitch down, \
                   pitch up, roll left, roll right, roll upright, open branch, close branch, cut branch, open polygon, \
                   vertex, close polygon, open tube, tube point, close tube, colour 2, next colour, previous colour, \
                   width 2, width times 0.5, thicker, thinner, length times 0.5, swap turns, circle, disc, leaf lance, \
                   leaf heart, leaf oak, leaf needle, leaf petal, surface l, nothing.";
        assert_eq!(hint, all);
    }

    #[test]
    fn all_rows_are_read_and_written() {
        for row in &ACTIONS {
            for words in row.words {
                let number = match row.form {
                    NumberForm::Plain(_) => "",
                    NumberForm::Surface => " l 2",
                    _ => " 2",
                };
                let action = action(&format!("{words}{number}"), false).unwrap();
                assert_eq!(print_action(action), format!("{}{number}", row.words[0]));
                assert!(core::ptr::eq(action.row(), row), "{words}");
            }
        }
    }
}
