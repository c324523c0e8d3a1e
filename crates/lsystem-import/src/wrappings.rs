//! What stands around systems: fences of Markdown, cells of notebooks, elements of HTML, quotations, tables, options of
//! commands. Wrappings are taken off before any reader sees the text; what is inside is read as if it stood alone.

mod notebook;
pub(crate) mod tables;

use crate::mapped::Mapped;
use crate::vocabulary::{Key, key, sign};
use core::ops::Range;
use tables::tables;

/// What is inside the wrappings of a text.
pub(crate) enum Peeled {
    /// Texts of their own. What stands between them may be a text, too.
    Parts(Vec<Mapped>),
    /// Blocks between lines that are no text.
    Fenced(Vec<Fence>),
    /// The whole text in another form.
    Whole(Mapped),
    Nothing,
}

/// A block of Markdown: the place of its lines, and that of its text.
pub(crate) struct Fence {
    pub(crate) whole: Range<usize>,
    pub(crate) inside: Range<usize>,
}

/// Longer tags are none, in bytes.
const LONGEST_TAG: usize = 500;

/// Takes the wrappings off a text. `is_rest`: the blocks of Markdown are taken off already.
pub(crate) fn peel(text: &str, is_rest: bool) -> Peeled {
    if let Some(cells) = notebook::cells(text) {
        return Peeled::Parts(cells);
    }
    let fences = if is_rest { Vec::new() } else { fences(text) };
    if !fences.is_empty() {
        return Peeled::Fenced(fences);
    }
    let elements = elements(text);
    if !elements.is_empty() {
        return Peeled::Parts(elements);
    }
    quotation(text).or_else(|| options(text)).or_else(|| tables(text)).map_or(Peeled::Nothing, Peeled::Whole)
}

/// The lines of a text with their line ends, and their places.
fn lines(text: &str) -> impl Iterator<Item = (Range<usize>, &str)> {
    let mut at = 0;
    text.split_inclusive('\n').map(move |line| {
        at += line.len();
        (at - line.len()..at, line)
    })
}

/// The blocks of Markdown between lines of three or more backquotes or tildes, and texts between lines of three quotes, as
/// programs in Python document themselves.
fn fences(text: &str) -> Vec<Fence> {
    let mut found = Vec::new();
    let mut open: Option<(char, usize, Range<usize>)> = None;
    let is_mark = |sign: Option<char>| matches!(sign, Some('`' | '~'));
    for (place, line) in lines(text) {
        let own = line.trim();
        let sign = own.chars().next().filter(|sign| matches!(sign, '`' | '~' | '"' | '\''));
        let length = sign.map_or(0, |sign| own.len() - own.trim_start_matches(sign).len());
        match &open {
            None if length >= 3 && is_mark(sign) && !own[length..].contains('`') => {
                open = sign.map(|sign| (sign, length, place));
            }
            // Words of a document may stand behind the quotes.
            None if length == 3 && !own[length..].contains("\"\"\"") && !own[length..].contains("'''") => {
                let words = place.end - line.trim_start().len() + length;
                open = sign.map(|sign| (sign, length, place.start..words));
            }
            Some((opened, least, start)) if sign == Some(*opened) && length >= *least && own.len() == length => {
                found.push(Fence { whole: start.start..place.end, inside: start.end..place.start });
                open = None;
            }
            // So do the quotes that close.
            Some((quote @ ('"' | '\''), _, start)) if own.ends_with(&[*quote; 3].map(String::from).concat()) => {
                let end = place.start + line.trim_end().len() - 3;
                found.push(Fence { whole: start.start..place.end, inside: start.end..end });
                open = None;
            }
            _ => {}
        }
    }
    if let Some((sign, _, start)) = open
        && is_mark(Some(sign))
    {
        found.push(Fence { whole: start.start..text.len(), inside: start.end..text.len() });
    }
    found
}

/// The lines of comments of a program that names an axiom there, without the signs before them.
pub(crate) fn comments(text: &str) -> Option<Mapped> {
    let is_comment = |line: &str| {
        let own = line.trim_start();
        own.starts_with(['/', '*', '#', ';', '%']) || own.starts_with("--")
    };
    let is_axiom = |line: &str| line.find([':', '=']).is_some_and(|end| key(&line[..end]) == Some(Key::Axiom));
    let mut inner = Mapped::default();
    let mut has_axiom = false;
    for (place, line) in lines(text).filter(|(_, line)| is_comment(line)) {
        let own = line.trim_start().trim_start_matches(['/', '*', '#', '-', ';', '%', '!', ' ']);
        has_axiom |= is_axiom(own);
        inner.copy(text, place.end - own.len()..place.end);
    }
    has_axiom.then(|| inner.end(text.len()))
}

/// A part of a text.
pub(crate) fn part(text: &str, range: Range<usize>) -> Mapped {
    let mut part = Mapped::default();
    let end = range.end;
    part.copy(text, range);
    part.end(end)
}

/// A text without some of its ranges, which are in order.
pub(crate) fn without(text: &str, ranges: impl Iterator<Item = Range<usize>>) -> Mapped {
    let mut rest = Mapped::default();
    let mut at = 0;
    for range in ranges {
        rest.copy(text, at..range.start);
        // A new line parts what stands before and behind.
        rest.push(range.start, "\n");
        at = range.end;
    }
    rest.copy(text, at..text.len());
    rest.end(text.len())
}

/// The texts of the elements of HTML that keep their lines: programs as they stand, others without tags and entities.
fn elements(text: &str) -> Vec<Mapped> {
    let mut found = Vec::new();
    let mut at = 0;
    while let Some((start, name)) = text[at..].match_indices('<').find_map(|(open, _)| {
        let names = ["script", "pre", "textarea", "table"];
        let rest = &text[at + open + 1..];
        let name =
            names.iter().find(|name| rest.get(..name.len()).is_some_and(|own| own.eq_ignore_ascii_case(name)))?;
        let behind = &rest[name.len()..];
        let near = &behind[..behind.floor_char_boundary(LONGEST_TAG)];
        let close = near.starts_with(['>', ' ', '\n']).then(|| near.find('>')).flatten()?;
        Some((at + open + 1 + name.len() + close + 1, *name))
    }) {
        let end = close_of(&text[start..], name).map_or(text.len(), |end| start + end);
        let mut inner = Mapped::default();
        match name {
            "script" => inner.copy(text, start..end),
            "table" => table(text, start..end, &mut inner),
            _ => plain(text, start..end, &mut inner),
        }
        found.push(inner.end(end));
        at = end;
    }
    found
}

/// Adds a table of HTML as rows of Markdown. One whose first row holds values has no names of columns.
fn table(text: &str, part: Range<usize>, inner: &mut Mapped) {
    let own = &text[part.clone()];
    let starts = |name: &'static str| {
        own.match_indices('<').map(|(at, _)| at).filter(move |at| {
            let tag = &own.as_bytes()[at + 1..];
            tag.get(..2).is_some_and(|tag| tag.eq_ignore_ascii_case(name.as_bytes()))
                && tag.get(2).is_some_and(|next| !next.is_ascii_alphanumeric())
        })
    };
    let rows: Vec<usize> = starts("tr").chain([own.len()]).collect();
    let mut cells: Vec<usize> = starts("td").chain(starts("th")).collect();
    lsystem_base::sorted::sort(&mut cells);
    for (at, row) in rows.windows(2).enumerate() {
        let from = cells.partition_point(|cell| *cell < row[0]);
        let to = cells.partition_point(|cell| *cell < row[1]);
        let has_values = at == 0
            && cells[from..to]
                .iter()
                .any(|cell| own[cell + 1..].starts_with(['t', 'T']) && own[cell + 2..].starts_with(['d', 'D']));
        if has_values {
            inner.push(part.start + row[0], "| |\n|---|\n");
        }
        for next in from + 1..=to {
            let (cell, end) = (cells[next - 1], if next < to { cells[next] } else { row[1] });
            inner.push(part.start + cell, "| ");
            let mut content = Mapped::default();
            plain(text, part.start + cell..part.start + end, &mut content);
            inner.append_line(&content);
        }
        inner.push(part.start + row[1], if at == 0 && !has_values { " |\n|---|\n" } else { " |\n" });
    }
}

/// The place of the tag that closes an element.
fn close_of(text: &str, name: &str) -> Option<usize> {
    text.match_indices("</")
        .map(|(at, _)| at)
        .find(|at| text.get(at + 2..at + 2 + name.len()).is_some_and(|own| own.eq_ignore_ascii_case(name)))
}

/// Adds a part of HTML without its tags, its entities as what they stand for.
fn plain(text: &str, part: Range<usize>, inner: &mut Mapped) {
    let mut at = part.start;
    while let Some(ch) = text[at..part.end].chars().next() {
        let rest = &text[at..part.end];
        let is_tag = ch == '<' && rest[1..].starts_with(|c: char| c.is_ascii_alphabetic() || c == '/');
        let tag = rest[..rest.floor_char_boundary(LONGEST_TAG)].find('>').filter(|_| is_tag);
        let length = match (ch, entity(rest)) {
            (_, Some((sign, length))) => {
                inner.push(at, &sign);
                length
            }
            ('<', _) if tag.is_some() => tag.map_or(1, |end| end + 1),
            _ => {
                inner.copy(text, at..at + ch.len_utf8());
                ch.len_utf8()
            }
        };
        at += length;
    }
}

/// The character that an entity at the start of a text stands for, and the length of the entity.
pub(crate) fn entity(text: &str) -> Option<(String, usize)> {
    let rest = text.strip_prefix('&')?;
    let near = &rest[..rest.floor_char_boundary(10)];
    let name = &near[..near.find(';')?];
    let sign = match name.strip_prefix('#') {
        Some(digits) => char::from_u32(match digits.strip_prefix(['x', 'X']) {
            Some(digits) => u32::from_str_radix(digits, 16).ok()?,
            None => digits.parse().ok()?,
        })?
        .to_string(),
        None => sign(name)?.to_owned(),
    };
    Some((sign, name.len() + 2))
}

/// A text of which every line is quoted, as in mails: `> axiom: F`.
fn quotation(text: &str) -> Option<Mapped> {
    let is_quoted = |line: &str| line.starts_with('>') || line.trim().is_empty();
    if !text.contains("> ") || !text.lines().all(is_quoted) {
        return None;
    }
    let mut inner = Mapped::default();
    for (place, line) in lines(text) {
        let lead = usize::from(line.starts_with('>')) + usize::from(line.starts_with("> "));
        inner.copy(text, place.start + lead..place.end);
    }
    Some(inner.end(text.len()))
}

/// The options of a command as labelled lines: `--axiom "F" --rules="F=FF"`.
fn options(text: &str) -> Option<Mapped> {
    let mut inner = Mapped::default();
    let mut keys = Vec::new();
    let mut at = 0;
    while let Some(found) = text[at..].find(" -").map(|found| at + found + 1) {
        let own = text[found..].trim_start_matches('-');
        let start = text.len() - own.len();
        let end = start + own.find(|c: char| c.is_whitespace() || c == '=').unwrap_or(own.len());
        at = end.max(found + 1);
        let name = &text[start..end];
        let value = text[end..].strip_prefix('=').unwrap_or(&text[end..]).trim_start_matches([' ', '\\', '\n']);
        let from = text.len() - value.len();
        let quote = value.chars().next().filter(|quote| matches!(quote, '"' | '\''));
        let length = match quote {
            Some(quote) => value[1..].find(quote),
            None => Some(value.find(char::is_whitespace).unwrap_or(value.len())),
        };
        let (Some(length), true) = (length, name.starts_with(char::is_alphabetic)) else { continue };
        let from = from + usize::from(quote.is_some());
        inner.copy(text, start..end);
        // Names of one letter mean other things in each program.
        inner.push(end, if name.len() > 1 || name == "n" { ": " } else { " " });
        inner.copy(text, from..from + length);
        inner.push(from + length, "\n");
        at = from + length;
        keys.extend(key(name).filter(|_| name.len() > 1));
    }
    let has_rules = keys.iter().any(|key| matches!(key, Key::Rules | Key::Rule));
    (has_rules && keys.contains(&Key::Axiom)).then(|| inner.end(text.len()))
}
