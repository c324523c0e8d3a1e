//! Sentences in the language of the reader.
//!
//! The English text stands in the program and is the key of its translations, as in gettext. `{}` in it stands for an
//! argument; a translation may number them, from `{0}`, to put them in another order. `{{` is a brace. A text with a
//! number has a form for one and a form for other numbers; a translation has as many forms as its language.

use std::fmt::{Display, Write as _};
use std::sync::OnceLock;

/// Finds the translation of an English text. The number decides about its plural form.
pub type Reader = fn(text: &str, number: Option<u64>) -> Option<String>;

static READER: OnceLock<Reader> = OnceLock::new();

/// Sets where translations come from, once for the whole program. Without it, all texts are English.
pub fn set_reader(reader: Reader) {
    let _ = READER.set(reader);
}

/// A sentence with its arguments in the reader's language: `say!("There is no function `{}`", name)`.
#[macro_export]
macro_rules! say {
    ($text:expr $(, $argument:expr)* $(,)?) => {
        $crate::words::say($text, &[$(&$argument as &dyn ::std::fmt::Display),*])
    };
}

/// A text with a number in the reader's language: `counted!(found, "{} point", "{} points")`. The number is the first
/// argument; others may follow.
#[macro_export]
macro_rules! counted {
    ($number:expr, $one:literal, $other:literal $(, $argument:expr)* $(,)?) => {
        $crate::words::counted($number as u64, $one, $other, &[$(&$argument as &dyn ::std::fmt::Display),*])
    };
}

/// A text that [`said`] translates where it is shown: it marks texts in tables.
#[macro_export]
macro_rules! word {
    ($text:literal) => {
        $text
    };
}

/// The translation of a text from a table.
#[must_use]
pub fn said(text: &str) -> String {
    found(text, None).unwrap_or_else(|| text.to_owned())
}

/// Called by [`say!`](crate::say).
#[must_use]
pub fn say(text: &str, arguments: &[&dyn Display]) -> String {
    fill(&said(text), arguments)
}

/// Called by [`counted!`](crate::counted).
#[must_use]
pub fn counted(number: u64, one: &str, other: &str, more: &[&dyn Display]) -> String {
    let text = found(other, Some(number)).unwrap_or_else(|| if number == 1 { one } else { other }.to_owned());
    let digits = grouped(&number.to_string());
    let mut arguments: Vec<&dyn Display> = vec![&digits];
    arguments.extend(more);
    fill(&text, &arguments)
}

fn found(text: &str, number: Option<u64>) -> Option<String> {
    READER.get()?(text, number)
}

/// A text with its arguments. What has no argument stays as it is.
fn fill(text: &str, arguments: &[&dyn Display]) -> String {
    let mut out = String::with_capacity(text.len() + 16);
    let mut rest = text;
    let mut next = 0;
    while let Some(at) = rest.find(['{', '}']) {
        let (before, mark) = rest.split_at(at);
        out.push_str(before);
        let brace = &mark[..1];
        rest = &mark[1..];
        if let Some(behind) = rest.strip_prefix(brace) {
            out.push_str(brace);
            rest = behind;
            continue;
        }
        let inside = rest.find('}').filter(|_| brace == "{").map(|end| (&rest[..end], &rest[end + 1..]));
        let argument = inside.and_then(|(number, behind)| {
            let index = if number.is_empty() { next } else { number.parse().ok()? };
            Some((arguments.get(index)?, behind))
        });
        match argument {
            Some((argument, behind)) => {
                let _ = write!(out, "{argument}");
                next += 1;
                rest = behind;
            }
            None => out.push_str(brace),
        }
    }
    out.push_str(rest);
    out
}

/// Digits of a whole number in groups of three, with the mark of the reader's language.
#[must_use]
pub fn grouped(digits: &str) -> String {
    // The text shows the marks of the language.
    let marks = said("1,234.5");
    let mark = marks.trim_start_matches('1').split('2').next().unwrap_or(",").to_owned();
    let mut out = String::new();
    for (at, digit) in digits.chars().enumerate() {
        if at > 0 && (digits.len() - at).is_multiple_of(3) {
            out.push_str(&mark);
        }
        out.push(digit);
    }
    out
}

/// A number that [`number`](crate::number::number) wrote, with the decimal mark of the reader's language. For sentences
/// only: files and what readers type back have points.
#[must_use]
pub fn shown(number: &str) -> String {
    let marks = said("1,234.5");
    match marks.trim_end_matches('5').rsplit('4').next() {
        Some(mark) if mark != "." => number.replace('.', mark),
        _ => number.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arguments_stand_in_order_or_where_their_numbers_are() {
        assert_eq!(say!("`{}` is read as `{}`", 'a', 2), "`a` is read as `2`");
        assert_eq!(fill("{1} {0} {{}}", &[&1, &2]), "2 1 {}");
        assert_eq!(fill("{7} {x} { }", &[&1]), "{7} {x} { }");
    }

    #[test]
    fn a_number_chooses_the_form() {
        assert_eq!(counted!(1, "{} point", "{} points"), "1 point");
        assert_eq!(counted!(12_345, "{} point of {}", "{} points of {}", "F"), "12,345 points of F");
    }
}
