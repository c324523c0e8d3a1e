//! Places of diagnostics: as printed source with carets, and in UTF-16 units.

use crate::{Class, Diagnostic, Severity};
use core::ops::Range;
use lsystem_base::say;

/// Converts a span of bytes of `text` to a span of UTF-16 units, the units of JavaScript. The span is cut to the text;
/// a bound inside a character moves to the character's start.
#[must_use]
pub fn utf16_span(text: &str, span: Range<usize>) -> Range<usize> {
    let start = floor(text, span.start);
    let end = floor(text, span.end).max(start);
    // A character of one to three bytes is one UTF-16 unit; a character of four bytes is two.
    let units =
        |part: &str| part.bytes().map(|b| usize::from(b & 0xc0 != 0x80) + usize::from(b >= 0xf0)).sum::<usize>();
    let before = units(&text[..start]);
    before..before + units(&text[start..end])
}

/// Converts an offset in UTF-16 units to the byte offset of the character there; the text's length for later offsets.
#[must_use]
pub fn byte_offset(text: &str, utf16: usize) -> usize {
    let mut end = 0;
    let mut ends = text.char_indices().map(|(at, ch)| {
        end += ch.len_utf16();
        (at, end)
    });
    ends.find(|&(_, end)| end > utf16).map_or(text.len(), |(at, _)| at)
}

/// The letters of classes, one for each UTF-16 unit of `text`. `classes` has one class for each byte of `text`.
#[must_use]
pub fn utf16_letters(text: &str, classes: &[Class]) -> String {
    let of = |at: usize| classes.get(at).copied().unwrap_or_default().letter();
    text.char_indices().flat_map(|(at, ch)| core::iter::repeat_n(of(at), ch.len_utf16())).collect()
}

/// A diagnostic for a terminal, with its line of the text and carets below its place. `text` is the text of
/// [`Diagnostic::field`]; `source` is its name for the user, for example the name of a file.
///
/// ```
/// let rules = "F = FF";
/// let (_, diagnostics) = lsystem_syntax::parse("F", rules);
/// let shown = lsystem_syntax::render_diagnostic(&diagnostics[0], "plant.txt", rules);
/// assert_eq!(shown, "\
/// error: `=` gives a constant its value, and `FF` is not a number
///  --> plant.txt:1:3
///   |
/// 1 | F = FF
///   |   ^
///   = help: For a rule write `F -> FF`.
/// ");
/// ```
#[must_use]
pub fn render_diagnostic(diagnostic: &Diagnostic, source: &str, text: &str) -> String {
    let message = visible(&diagnostic.message);
    let mut out = match diagnostic.severity {
        Severity::Warning => say!("warning: {}", message),
        Severity::Error => say!("error: {}", message),
    };
    out.push('\n');
    let mut margin = 1;
    if diagnostic.span == (0..0) {
        out.push_str(&format!(" --> {}\n", visible(source)));
    } else {
        let place = TextPlace::new(text, diagnostic.span.clone());
        let number = place.number.to_string();
        margin = number.len();
        let blank = " ".repeat(margin);
        out.push_str(&format!("{blank}--> {}:{number}:{}\n", visible(source), place.column));
        out.push_str(&format!("{blank} |\n{number} | {}\n", place.line));
        out.push_str(&format!("{blank} | {}{}\n", " ".repeat(place.indent), "^".repeat(place.carets)));
    }
    if let Some(hint) = &diagnostic.hint {
        out.push_str(&format!("{} = {}\n", " ".repeat(margin), say!("help: {}", visible(hint))));
    }
    out
}

/// A place in a text, ready to be printed.
struct TextPlace {
    /// The line's number, 1-based.
    number: usize,
    /// The column in characters, 1-based.
    column: usize,
    /// The line as printed, shortened if long.
    line: String,
    /// Columns before the carets.
    indent: usize,
    /// How many carets; at least one.
    carets: usize,
}

/// Columns printed before the place and from its start on.
const BEFORE: usize = 40;
const AFTER: usize = 80;

impl TextPlace {
    fn new(text: &str, span: Range<usize>) -> Self {
        let start = floor(text, span.start);
        let end = floor(text, span.end).max(start);
        let line_start = text[..start].rfind(['\n', '\r']).map_or(0, |at| at + 1);
        let rest = &text[start..];
        let line_end = start + rest.find(['\n', '\r']).unwrap_or(rest.len());
        // `\r\n` is one line end, a lone `\r` is one too.
        let mut number = 1;
        let mut last = ' ';
        for ch in text[..line_start].chars() {
            number += usize::from(ch == '\r' || (ch == '\n' && last != '\r'));
            last = ch;
        }
        let (before, after) = (&text[line_start..start], &text[start..line_end]);
        let (head, cut) = last_columns(before, BEFORE);
        let mut line = String::from(if cut { "…" } else { "" });
        line.push_str(&head);
        let indent = width(&line);
        let tail = shown(after);
        let mut room = AFTER;
        let kept = tail.char_indices().find(|&(_, ch)| {
            let fits = columns(ch) <= room;
            room = room.saturating_sub(columns(ch));
            !fits
        });
        let tail_end = kept.map_or(tail.len(), |(at, _)| at);
        line.push_str(&tail[..tail_end]);
        if tail_end < tail.len() {
            line.push('…');
        }
        let under = width(&shown(&text[start..end.min(line_end)])).min(AFTER);
        Self { number, column: before.chars().count() + 1, line, indent, carets: under.max(1) }
    }
}

/// The end of `text` as printed, at most `most` columns wide, and whether the start was cut off.
fn last_columns(text: &str, most: usize) -> (String, bool) {
    let text = shown(text);
    let mut room = most;
    let mut from = text.len();
    for (at, ch) in text.char_indices().rev() {
        if columns(ch) > room {
            return (text[from..].to_owned(), true);
        }
        room -= columns(ch);
        from = at;
    }
    (text, false)
}

/// Text as printed: tabs become four spaces, control characters become visible.
fn shown(text: &str) -> String {
    text.replace('\t', "    ").chars().map(visible_char).collect()
}

/// A text that is safe to print in a terminal. Control characters, and characters that change the direction of text,
/// are each replaced by one visible character.
///
/// ```
/// assert_eq!(lsystem_syntax::visible("a\u{1b}[31m\n\u{202e}b"), "a␛[31m␊\u{fffd}b");
/// ```
#[must_use]
pub fn visible(text: &str) -> String {
    text.chars().map(visible_char).collect()
}

fn visible_char(ch: char) -> char {
    match ch {
        '\0'..='\u{1f}' => char::from_u32(0x2400 + u32::from(ch)).unwrap_or(' '),
        '\u{7f}' => '\u{2421}',
        _ if ch.is_control() || crate::characters::is_invisible(ch) || matches!(ch, '\u{2028}' | '\u{2029}') => {
            '\u{fffd}'
        }
        _ => ch,
    }
}

fn width(text: &str) -> usize {
    text.chars().map(columns).sum()
}

/// A character's width in a terminal, in columns: 0 for combining marks, 2 for East Asian wide characters and emoji
/// (Unicode Standard Annex 11, large ranges only).
fn columns(ch: char) -> usize {
    match u32::from(ch) {
        0x300..=0x36f | 0x483..=0x489 | 0x591..=0x5bd | 0x20d0..=0x20ff | 0xfe00..=0xfe0f | 0xfe20..=0xfe2f => 0,
        0x1100..=0x115f
        | 0x2e80..=0x303e
        | 0x3041..=0xa4cf
        | 0xa960..=0xa97c
        | 0xac00..=0xd7a3
        | 0xf900..=0xfaff
        | 0xfe30..=0xfe6f
        | 0xff00..=0xff60
        | 0xffe0..=0xffe6
        | 0x1f300..=0x1f64f
        | 0x1f680..=0x1f6ff
        | 0x1f900..=0x1faff
        | 0x20000..=0x3fffd => 2,
        _ => 1,
    }
}

fn floor(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// The number of the line, from 1, in which byte `at` of a text stands.
#[must_use]
pub fn line_of(text: &str, at: usize) -> usize {
    text.as_bytes()[..at.min(text.len())].iter().filter(|&&byte| byte == b'\n').count() + 1
}
