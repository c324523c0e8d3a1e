//! The characters of a line as tokens: literals unwrapped, white space dropped, look-alikes replaced, and the two
//! characters of cpfg's discs and of queries joined.

use crate::Diagnostic;
use crate::characters::{disc, is_blank, look_alike};
use crate::notes::DiagnosticList;
use core::ops::Range;
use lsystem_base::say;

/// One character other than white space.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Token {
    /// The character, after look-alikes are replaced.
    pub(crate) ch: char,
    /// Whether the character stood in backquotes and is therefore always a symbol.
    pub(crate) literal: bool,
    /// Whether no white space separates the token from the token before.
    pub(crate) joined: bool,
    start: u32,
    end: u32,
}

impl Token {
    /// The token's span in the text, in bytes.
    pub(crate) fn span(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Whether the token is this character and not a literal.
    pub(crate) fn is(self, ch: char) -> bool {
        self.ch == ch && !self.literal
    }
}

/// The span from the first token to the last, in bytes; empty at `otherwise` if there are no tokens.
pub(crate) fn span_of(tokens: &[Token], otherwise: usize) -> Range<usize> {
    match tokens {
        [] => otherwise..otherwise,
        [first, .., last] => first.span().start..last.span().end,
        [only] => only.span(),
    }
}

/// An excerpt of the tokens' characters, without white space.
pub(crate) fn text_of(tokens: &[Token]) -> String {
    crate::notes::excerpt(&tokens.iter().map(|t| t.ch).collect::<String>())
}

/// The tokens of `text` in `range`, in bytes. Look-alikes and broken literals are noted.
pub(crate) fn tokens(text: &str, range: Range<usize>, notes: &mut DiagnosticList) -> Vec<Token> {
    let mut found = Vec::new();
    let mut at = range.start;
    let mut joined = false;
    while let Some(ch) = text[at..range.end].chars().next() {
        let start = at;
        at += ch.len_utf8();
        if is_blank(ch) {
            joined = false;
            continue;
        }
        let (ch, literal) = match look_alike(ch) {
            Some(meant) => {
                notes.look_alike(ch, meant, start..at);
                if is_blank(meant) {
                    joined = false;
                    continue;
                }
                (meant, false)
            }
            None if ch == '`' => match literal(&text[at..range.end]) {
                Ok((ch, length)) => {
                    at += length;
                    (ch, true)
                }
                Err(Broken { error, length }) => {
                    at += length;
                    notes.add(start..at, *error);
                    joined = false;
                    continue;
                }
            },
            None if ch == '@' => match text[at..range.end].chars().next().and_then(disc) {
                Some(disc) => {
                    at += 1;
                    (disc, false)
                }
                None => (ch, false),
            },
            None if ch == '?' => match query(&text[at..range.end]) {
                Some(symbol) => {
                    at += 1;
                    (symbol, false)
                }
                None => (ch, false),
            },
            None => (ch, false),
        };
        found.push(Token { ch, literal, joined, start: start as u32, end: at as u32 });
        joined = true;
    }
    found
}

/// The symbol for `?` before this text: a letter of a query, then its arguments.
fn query(rest: &str) -> Option<char> {
    let mut chars = rest.chars();
    let letter = chars.next()?;
    (chars.next() == Some('(')).then(|| crate::Query::of_letter(letter).map(crate::Query::symbol)).flatten()
}

struct Broken {
    error: Box<Diagnostic>,
    length: usize,
}

/// Reads the text after an opening backquote. Returns the character and the number of bytes including the closing
/// backquote. A character may be written by its number, as in `` `U+0A` ``.
fn literal(rest: &str) -> Result<(char, usize), Broken> {
    let mut chars = rest.chars();
    let (first, after) = (chars.next(), chars.next());
    if let (Some(ch), Some('`')) = (first, after) {
        return Ok((ch, ch.len_utf8() + 1));
    }
    // The search is short: literals are short, and many lone backquotes must not cost long searches.
    const LONGEST: usize = 16;
    let Some(length) = rest.bytes().take(LONGEST).position(|b| b == b'`') else {
        let error = Diagnostic::error(say!("This backquote is never closed"))
            .hint(say!("Backquotes make one character a symbol: `:`. The backquote itself is ```."));
        return Err(Broken { error: Box::new(error), length: 0 });
    };
    let number = rest[..length].strip_prefix("U+").filter(|n| n.len() <= 6);
    number.and_then(|n| u32::from_str_radix(n, 16).ok()).and_then(char::from_u32).map(|ch| (ch, length + 1)).ok_or_else(
        || {
            let error = Diagnostic::error(say!("Backquotes hold exactly one character"))
                .hint(say!("Write each symbol in its own backquotes, or by its number, as in `U+0A`."));
            Broken { error: Box::new(error), length: length + 1 }
        },
    )
}
