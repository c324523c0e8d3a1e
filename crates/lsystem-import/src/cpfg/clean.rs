//! A text with blanks in place of its comments, so that every other part keeps its place.

use super::Kind;
use core::ops::Range;

/// The text without comments and with continued lines joined, and the places of the comments. Blanks stand for every
/// byte that is left out.
pub(super) fn clean(text: &str, kind: Kind) -> (String, Vec<Range<usize>>) {
    let mut out = text.as_bytes().to_vec();
    let mut comments = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text.as_bytes()[at..];
        let length = match kind {
            Kind::Cpfg => comment(text, at),
            Kind::LPy => python_comment(text, at),
        };
        if let Some(length) = length {
            out[at..at + length].fill(b' ');
            comments.push(at..at + length);
            at += length;
            continue;
        }
        at += match rest {
            [b'\\', b'\r', b'\n', ..] => blank(&mut out, at, 3),
            [b'\\', b'\n', ..] => blank(&mut out, at, 2),
            [b'"' | b'\'', ..] if kind == Kind::LPy => quoted(rest),
            _ => 1,
        };
    }
    // Only whole characters are replaced.
    (String::from_utf8(out).unwrap_or_default(), comments)
}

fn blank(out: &mut [u8], at: usize, length: usize) -> usize {
    out[at..at + length].fill(b' ');
    length
}

/// The length of a comment of cpfg that begins here. Two slashes are two rolls, unless words stand behind them.
fn comment(text: &str, at: usize) -> Option<usize> {
    let rest = text.get(at..)?;
    if let Some(inside) = rest.strip_prefix("/*") {
        return Some(inside.find("*/").map_or(rest.len(), |end| end + 4));
    }
    let inside = rest.strip_prefix("//")?;
    let before = text[..at].trim_end_matches([' ', '\t']);
    let starts = before.is_empty() || before.ends_with('\n');
    let has_words = || {
        // The search is short, so that many slashes do not cost long searches.
        let letters: Vec<char> = inside.chars().take(80).take_while(|c| *c != '\n').collect();
        letters.windows(3).any(|word| word.iter().all(char::is_ascii_lowercase))
    };
    let words = before.len() < at && inside.starts_with([' ', '\t']) && has_words();
    (starts || words).then(|| inside.find('\n').unwrap_or(inside.len()) + 2)
}

/// The length of a comment of L-Py, or of a text in three quotes, that begins here.
fn python_comment(text: &str, at: usize) -> Option<usize> {
    let rest = text.get(at..)?;
    if rest.starts_with('#') {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    let quotes = ["\"\"\"", "'''"].into_iter().find(|quotes| rest.starts_with(quotes))?;
    Some(rest[3..].find(quotes).map_or(rest.len(), |end| end + 6))
}

/// The length of a short text in quotes that begins here and ends on its line; 1 if it does not end.
fn quoted(rest: &[u8]) -> usize {
    const LONGEST: usize = 1000;
    let mut at = 1;
    while let Some(&byte) = rest.get(at).filter(|byte| at < LONGEST && **byte != b'\n') {
        at += 1 + usize::from(byte == b'\\');
        if byte == rest[0] {
            return at;
        }
    }
    1
}
