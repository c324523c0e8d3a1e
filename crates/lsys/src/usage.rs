//! Errors of usage in the reader's language. In English the words are those of clap.

use clap::Error;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use lsystem::base::words::{said, say};
use lsystem::base::{say, word};
use std::error::Error as _;
use std::fmt::Display;

/// The texts of clap and of the standard library that come as texts, without kind or context.
const FOREIGN: [&str; 10] = [
    word!("to pass '{}' as a value, use '{}'"),
    word!("'{}' exists"),
    word!("subcommand '{}' exists; to use it, remove the '{}' before it"),
    word!("{} is not in {}"),
    word!("invalid digit found in string"),
    word!("cannot parse integer from empty string"),
    word!("number too large to fit in target type"),
    word!("number too small to fit in target type"),
    word!("invalid float literal"),
    word!("cannot parse float from empty string"),
];

/// The report of an error.
pub(crate) fn report(error: &Error) -> String {
    let Some(message) = message(error) else { return error.to_string() };
    let usage = match error.get(ContextKind::Usage) {
        Some(ContextValue::StyledStr(usage)) => Some(usage.to_string()),
        _ => None,
    };
    written(&message, &tips(error), usage.as_deref())
}

/// The report of a message about a command, with `Usage:` as clap writes it.
pub(crate) fn written(message: &str, tips: &[String], usage: Option<&str>) -> String {
    let mut text = say!("error: {}", message);
    if !tips.is_empty() {
        text.push('\n');
    }
    for tip in tips {
        text += &format!("\n  {}", say!("tip: {}", tip));
    }
    if let Some(usage) = usage {
        text += &format!("\n\n{} {}", say!("Usage:"), usage.strip_prefix("Usage: ").unwrap_or(usage));
    }
    format!("{text}\n\n{}\n", say!("For more information, try '{}'.", "--help"))
}

/// What is wrong. `None` for kinds that these commands do not meet.
fn message(error: &Error) -> Option<String> {
    let text = |kind| match error.get(kind) {
        Some(ContextValue::String(text)) => Some(text.as_str()),
        _ => None,
    };
    let list = |kind| match error.get(kind) {
        Some(ContextValue::Strings(list)) => list.as_slice(),
        _ => &[],
    };
    let arg = || text(ContextKind::InvalidArg);
    let value = || text(ContextKind::InvalidValue);
    Some(match error.kind() {
        ErrorKind::ArgumentConflict => match (arg()?, text(ContextKind::PriorArg)) {
            (arg, Some(prior)) if prior == arg => say!("the argument '{}' cannot be used multiple times", arg),
            (arg, Some(prior)) => say!("the argument '{}' cannot be used with '{}'", arg, prior),
            (arg, None) => say!("the argument '{}' cannot be used with:", arg) + &lines(list(ContextKind::PriorArg)),
        },
        ErrorKind::NoEquals => say!("equal sign is needed when assigning values to '{}'", arg()?),
        ErrorKind::InvalidValue => {
            let message = match value()? {
                "" => say!("a value is required for '{}' but none was supplied", arg()?),
                value => say!("invalid value '{}' for '{}'", value, arg()?),
            };
            message + &choice(word!("[possible values: {}]"), list(ContextKind::ValidValue))
        }
        ErrorKind::ValueValidation => {
            let message = say!("invalid value '{}' for '{}'", value()?, arg()?);
            match error.source() {
                Some(source) => format!("{message}: {}", reason(&source.to_string())),
                None => message,
            }
        }
        ErrorKind::TooManyValues => {
            say!("unexpected value '{}' for '{}' found; no more were expected", value()?, arg()?)
        }
        ErrorKind::InvalidSubcommand => say!("unrecognized subcommand '{}'", text(ContextKind::InvalidSubcommand)?),
        ErrorKind::MissingSubcommand => {
            let name = text(ContextKind::InvalidSubcommand)?;
            say!("'{}' requires a subcommand but one was not provided", name)
                + &choice(word!("[subcommands: {}]"), list(ContextKind::ValidSubcommand))
        }
        ErrorKind::MissingRequiredArgument => {
            say!("the following required arguments were not provided:") + &lines(list(ContextKind::InvalidArg))
        }
        ErrorKind::UnknownArgument => say!("unexpected argument '{}' found", arg()?),
        ErrorKind::InvalidUtf8 => say!("invalid UTF-8 was detected in one or more arguments"),
        _ => return None,
    })
}

fn lines(list: &[String]) -> String {
    list.iter().map(|one| format!("\n  {one}")).collect()
}

/// The line with the values to choose from, if there are any.
fn choice(text: &str, values: &[String]) -> String {
    let quoted = |value: &String| match value.is_empty() || value.contains(char::is_whitespace) {
        true => format!("{value:?}"),
        false => value.clone(),
    };
    match values {
        [] => String::new(),
        _ => format!("\n  {}", say(text, &[&values.iter().map(quoted).collect::<Vec<_>>().join(", ")])),
    }
}

/// Why a value was refused: words of this program, of clap or of the standard library.
fn reason(text: &str) -> String {
    match text.split_once(" is not in ") {
        Some((value, range)) => say!("{} is not in {}", value, range),
        None if FOREIGN.contains(&text) => said(text),
        None => text.to_owned(),
    }
}

fn tips(error: &Error) -> Vec<String> {
    let similar = |kind, one: &str, some: &str| match error.get(kind) {
        Some(ContextValue::String(name)) => Some(say(one, &[&format!("'{name}'")])),
        Some(ContextValue::Strings(names)) if !names.is_empty() => {
            let quoted: Vec<_> = names.iter().map(|name| format!("'{name}'")).collect();
            Some(say(if names.len() == 1 { one } else { some }, &[&quoted.join(", ")]))
        }
        _ => None,
    };
    let commands = [word!("a similar subcommand exists: {}"), word!("some similar subcommands exist: {}")];
    let arguments = [word!("a similar argument exists: {}"), word!("some similar arguments exist: {}")];
    let values = [word!("a similar value exists: {}"), word!("some similar values exist: {}")];
    let known = [
        (ContextKind::SuggestedSubcommand, commands),
        (ContextKind::SuggestedArg, arguments),
        (ContextKind::SuggestedValue, values),
    ];
    let mut tips: Vec<_> = known.into_iter().filter_map(|(kind, [one, some])| similar(kind, one, some)).collect();
    if let Some(ContextValue::StyledStrs(others)) = error.get(ContextKind::Suggested) {
        tips.extend(others.iter().map(|tip| quoting(&tip.to_string())));
    }
    tips
}

/// The translation of a text by its form with `{}` for what it quotes.
fn quoting(text: &str) -> String {
    let parts: Vec<&str> = text.split('\'').collect();
    let shape: Vec<&str> = parts.iter().enumerate().map(|(at, part)| if at % 2 == 1 { "{}" } else { part }).collect();
    let shape = shape.join("'");
    let quoted: Vec<&dyn Display> = parts.iter().skip(1).step_by(2).map(|part| part as &dyn Display).collect();
    if FOREIGN.contains(&&*shape) { say(&shape, &quoted) } else { text.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::help;

    #[test]
    fn in_english_the_words_are_those_of_clap() {
        let mut kinds = Vec::new();
        for line in [
            "",
            "--nothing",
            "inof a.json",
            "info",
            "info a.json --jsn",
            "info a.json --json --growth",
            "info a.json --growth text",
            "info a.json --growth=txt",
            "info a.json --language",
            "info a.json --language xx",
            "draw a.json --format",
            "draw a.json --format pgn",
            "draw a.json --size big",
            "draw a.json --dpi 1x",
            "view a.json --port 0",
            "view a.json --port x",
            "view a.json --port 70000",
            "view a.json b.json",
            "view a.json --no-browser=yes",
            "animate a.json",
            "animate a.json --to b --fps -",
            "breed",
            "info -- a.json -x",
            "scorm a --lesson --to b",
            "import a --account --to b",
            "--language en",
            "expand a.json --list",
            "check",
        ] {
            let words = std::iter::once("lsys").chain(line.split(' ').filter(|word| !word.is_empty()));
            let Err(error) = help::command().try_get_matches_from(words) else { continue };
            if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
                continue;
            }
            assert!(message(&error).is_some(), "{line}: {}", error.kind());
            assert_eq!(report(&error), error.to_string(), "{line}");
            kinds.push(error.kind());
        }
        kinds.sort_by_key(|kind| format!("{kind:?}"));
        kinds.dedup();
        assert!(kinds.len() >= 8, "{kinds:?}");
    }

    #[test]
    fn tips_of_clap_are_known_by_their_form() {
        for text in ["to pass '-x' as a value, use '-- -x'", "'info --json' exists"] {
            assert_eq!(quoting(text), text);
        }
    }
}
