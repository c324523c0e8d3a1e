//! Texts of programs and data as trees of brackets: strings, numbers, names and marks, with their places.
//!
//! The rules hold for most languages at once: JavaScript, JSON, Python, Java, C#, Lua, Ruby, Lisp. Code is not run.

use core::ops::Range;
use lsystem_base::decimal;

/// A part of a text.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    pub(super) kind: Kind,
    pub(super) span: Range<usize>,
    /// Whether a line ends between the part before and this one.
    pub(super) is_first: bool,
}

/// The kind of a part.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// A string without its quotes and escapes.
    Text(String),
    /// A string that a program fills in, such as `` `${a}` ``.
    Code,
    /// A number, and the letters behind it, such as `25f` or `30deg`.
    Number(f64, String),
    Name(String),
    /// A character, or one of `=> -> := :: == != <= >= += <- ..`.
    Mark(&'static str),
    /// A bracket with what stands inside.
    Group(char, Vec<Node>),
}

impl Node {
    pub(super) fn text(&self) -> Option<&str> {
        if let Kind::Text(text) = &self.kind { Some(text) } else { None }
    }

    pub(super) fn name(&self) -> Option<&str> {
        if let Kind::Name(name) = &self.kind { Some(name) } else { None }
    }

    pub(super) fn is(&self, mark: &str) -> bool {
        matches!(self.kind, Kind::Mark(own) if own == mark)
    }

    pub(super) fn group(&self) -> Option<&[Node]> {
        if let Kind::Group(_, inside) = &self.kind { Some(inside) } else { None }
    }
}

/// A text as a tree.
#[derive(Debug, Default)]
pub(super) struct Tree {
    pub(super) nodes: Vec<Node>,
    /// The comments, in order.
    pub(super) comments: Vec<Range<usize>>,
}

/// Marks of several characters, longer ones first.
const LONG: [&str; 16] =
    ["===", "!==", "=>", "->", ":=", "::", "==", "!=", "<=", ">=", "+=", "-=", "<-", "..", "&&", "||"];
/// Marks of one character.
const SHORT: [&str; 28] = [
    "=", ":", ",", ";", ".", "+", "-", "*", "/", "<", ">", "|", "&", "!", "?", "@", "#", "$", "%", "^", "~", "\\", "'",
    "\"", "`", "°", "π", "→",
];
/// The most brackets inside one another; deeper ones are read as if they closed at once.
const DEEPEST: usize = 32;

/// Reads a text. Work and memory are in proportion to it.
pub(super) fn tree(text: &str) -> Tree {
    let mut lexer = Lexer { text, at: 0, is_first: true, comments: Vec::new() };
    // The brackets that are open, the innermost last: what stands inside so far, the place, the character.
    let mut open: Vec<(Vec<Node>, usize, char, bool)> = Vec::new();
    let mut nodes: Vec<Node> = Vec::new();
    while let Some(token) = lexer.next() {
        match token {
            Token::Open(ch, at, is_first) if open.len() < DEEPEST => {
                open.push((core::mem::take(&mut nodes), at, ch, is_first));
            }
            Token::Close(ch, at) => {
                // A bracket that closes nothing is left out; those inside it that nothing closes end here.
                let Some(level) = open.iter().rposition(|(_, _, own, _)| *own == ch) else { continue };
                while open.len() > level {
                    let Some((mut before, start, own, is_first)) = open.pop() else { break };
                    let inside = core::mem::take(&mut nodes);
                    before.push(Node { kind: Kind::Group(own, inside), span: start..at + 1, is_first });
                    nodes = before;
                }
            }
            Token::Open(..) => {}
            Token::Part(node) => nodes.push(node),
        }
    }
    while let Some((mut before, start, own, is_first)) = open.pop() {
        // A bracket that is never closed holds nothing; what follows it stands beside it.
        before.push(Node { kind: Kind::Group(own, Vec::new()), span: start..start + 1, is_first });
        before.append(&mut nodes);
        nodes = before;
    }
    Tree { nodes, comments: lexer.comments }
}

enum Token {
    /// An opening bracket by its character.
    Open(char, usize, bool),
    /// A closing bracket by the character that opens it.
    Close(char, usize),
    Part(Node),
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    is_first: bool,
    comments: Vec<Range<usize>>,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// The character before the place.
    fn before(&self) -> char {
        self.text.get(..self.at).and_then(|text| text.chars().next_back()).unwrap_or('\n')
    }

    fn next(&mut self) -> Option<Token> {
        self.blank();
        let rest = self.rest();
        let ch = rest.chars().next()?;
        let (start, is_first) = (self.at, core::mem::take(&mut self.is_first));
        let part = |kind, span| Token::Part(Node { kind, span, is_first });
        match ch {
            '{' | '[' | '(' => {
                self.at += 1;
                return Some(Token::Open(ch, start, is_first));
            }
            '}' | ']' | ')' => {
                self.at += 1;
                let open = if ch == '}' {
                    '{'
                } else if ch == ']' {
                    '['
                } else {
                    '('
                };
                return Some(Token::Close(open, start));
            }
            '"' | '\'' | '`' | '“' | '‘' => {
                if let Some((kind, end)) = string(rest) {
                    self.at += end;
                    return Some(part(kind, start..self.at));
                }
            }
            '0'..='9' => return Some(self.number(is_first)),
            '.' | ','
                if rest[1..].starts_with(|c: char| c.is_ascii_digit())
                    && ch == '.'
                    && !self.before().is_alphanumeric() =>
            {
                return Some(self.number(is_first));
            }
            _ => {}
        }
        if ch.is_alphabetic() && ch != 'π' || ch == '_' || ch == '$' {
            let end = rest.find(|c: char| !c.is_alphanumeric() && !matches!(c, '_' | '$')).unwrap_or(rest.len());
            let name = &rest[..end];
            // The prefix of a string, as in `r"F"`.
            let is_prefix = name.len() <= 2 && name.chars().all(|c| "rbufRBUFL".contains(c));
            if is_prefix
                && rest[end..].starts_with(['"', '\''])
                && let Some((kind, length)) = string(&rest[end..])
            {
                let filled = name.contains(['f', 'F']) && matches!(&kind, Kind::Text(text) if text.contains('{'));
                self.at += end + length;
                return Some(part(if filled { Kind::Code } else { kind }, start..self.at));
            }
            let name = name.to_owned();
            self.at += end;
            return Some(part(Kind::Name(name), start..self.at));
        }
        let mark = LONG.iter().chain(&SHORT).find(|mark| rest.starts_with(**mark));
        self.at += mark.map_or(ch.len_utf8(), |mark| mark.len());
        Some(part(Kind::Mark(mark.copied().unwrap_or("?")), start..self.at))
    }

    /// Passes white space and comments.
    fn blank(&mut self) {
        loop {
            let rest = self.rest();
            let Some(ch) = rest.chars().next() else { return };
            if ch == '\n' || ch.is_whitespace() || ch == '\u{feff}' {
                self.is_first |= ch == '\n';
                self.at += ch.len_utf8();
                continue;
            }
            let Some(length) = self.comment() else { return };
            self.is_first |= rest[..length].contains('\n');
            self.comments.push(self.at..self.at + length);
            self.at += length;
        }
    }

    /// The length of a comment at the place.
    fn comment(&self) -> Option<usize> {
        let rest = self.rest();
        let line = || rest.find('\n').unwrap_or(rest.len());
        let until = |end: &str| rest.find(end).map_or(rest.len(), |at| at + end.len());
        let opens = self.is_first || self.before().is_whitespace();
        match rest.as_bytes() {
            [b'/', b'/', ..] if self.before() != ':' => Some(line()),
            [b'/', b'*', ..] => Some(until("*/")),
            [b'<', b'!', b'-', b'-', ..] => Some(until("-->")),
            [b'-', b'-', b'[', b'[', ..] => Some(until("]]")),
            [b'-', b'-', b' ', ..] if opens => Some(line()),
            // `#` before a word is a directive of C, before a bracket an attribute of Rust or a map of Clojure.
            [b'#', next, ..] if opens && !matches!(next, b'{' | b'[' | b'(') && !is_directive(&rest[1..]) => {
                Some(line())
            }
            [b';', b';', ..] if opens => Some(line()),
            _ => None,
        }
    }

    fn number(&mut self, is_first: bool) -> Token {
        let (rest, start) = (self.rest(), self.at);
        let bytes = rest.as_bytes();
        let mut end = 0;
        let mut points = 0;
        while end < bytes.len() {
            let next_is_digit = bytes.get(end + 1).is_some_and(u8::is_ascii_digit);
            match bytes[end] {
                b'0'..=b'9' => {}
                b'_' if next_is_digit => {}
                // Not of `0..5`.
                b'.' if points == 0 && bytes.get(end + 1) != Some(&b'.') => points += 1,
                _ => break,
            }
            end += 1;
        }
        let exponent = &rest[end..];
        let sign = exponent.strip_prefix(['e', 'E']).map(|rest| rest.strip_prefix(['+', '-']).unwrap_or(rest));
        if let Some(digits) = sign.filter(|digits| digits.starts_with(|c: char| c.is_ascii_digit())) {
            let length = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
            end += exponent.len() - digits.len() + length;
        }
        let value: String = rest[..end].chars().filter(|c| *c != '_').collect();
        // `60.0_f32`
        end += usize::from(rest[end..].starts_with('_'));
        let unit = &rest[end..];
        let length = unit.find(|c: char| !c.is_alphanumeric() && c != '°' || c == 'π').unwrap_or(unit.len());
        let unit = unit[..length].to_owned();
        self.at += end + length;
        let kind = match decimal::read(&value) {
            Some(value) => Kind::Number(value, unit),
            None => Kind::Code,
        };
        Token::Part(Node { kind, span: start..self.at, is_first })
    }
}

/// Whether a word behind `#` is one of a preprocessor.
fn is_directive(rest: &str) -> bool {
    ["define", "include", "if", "endif", "else", "lang", "pragma", "undef"].iter().any(|word| rest.starts_with(word))
}

/// The string at the start of a text, and its length; `None` if it is never closed.
fn string(text: &str) -> Option<(Kind, usize)> {
    let quote = text.chars().next()?;
    let triple = ["\"\"\"", "'''"].into_iter().find(|triple| text.starts_with(triple));
    let close = match quote {
        '“' => '”',
        '‘' => '’',
        other => other,
    };
    let start = triple.map_or(quote.len_utf8(), str::len);
    let (mut content, mut is_filled) = (String::new(), false);
    let mut chars = text[start..].char_indices();
    // A string on one line has at most this many bytes: a lone apostrophe does not read on for ever.
    while let Some((at, ch)) = chars.next() {
        if triple.is_some_and(|triple| text[start + at..].starts_with(triple)) {
            return Some((Kind::Text(content), start + at + 3));
        }
        match ch {
            '\\' => match chars.next()?.1 {
                'n' => content.push('\n'),
                't' => content.push('\t'),
                'r' => {}
                '\n' => {}
                other => content.push(other),
            },
            '\n' if quote != '`' && triple.is_none() => return None,
            '$' if quote == '`' && text[start + at + 1..].starts_with('{') => {
                is_filled = true;
                content.push(ch);
            }
            _ if ch == close && triple.is_none() => {
                let kind = if is_filled { Kind::Code } else { Kind::Text(content) };
                return Some((kind, start + at + ch.len_utf8()));
            }
            _ => content.push(ch),
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(nodes: &[Node]) -> String {
        let one = |node: &Node| match &node.kind {
            Kind::Text(text) => format!("{text:?}"),
            Kind::Code => "code".into(),
            Kind::Number(value, unit) => format!("{value}{unit}"),
            Kind::Name(name) => name.clone(),
            Kind::Mark(mark) => (*mark).into(),
            Kind::Group(open, inside) => format!("{open}{}", shown(inside)) + "…",
        };
        nodes.iter().map(one).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn parts_of_many_languages() {
        for (text, expected) in [
            ("a = {F: 'F+\\'F'}; // x", "a = {F : \"F+'F\"… ;"),
            ("`${s.n}-${s.d}` + r'\\F' 25f 3e-2 1_000", "code + \"F\" 25f 0.03 1000"),
            ("it's (a] b)", "it ' s (a b…"),
            ("-- x\nn--", "n - -"),
            ("{ {a", "{… {… a"),
            ("# comment\n#define A\nx /* y */ : 2π", "# define A x : 2 π"),
            ("\"\"\"a\n\"b\"\"\"\" 0..5", "\"a\\n\\\"b\" \" 0 .. 5"),
        ] {
            assert_eq!(shown(&tree(text).nodes), expected, "{text}");
        }
    }
}
