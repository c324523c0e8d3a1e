//! A text as a person reads it: markup and commands of LaTeX and HTML are read where they stand. Every character keeps
//! its place in the source.

use crate::keys::{Key, key};
use core::ops::Range;

/// Characters with their places.
#[derive(Debug, Default)]
pub(super) struct Decoded {
    pub(super) text: String,
    /// By byte of the text: the place in the source; and the end of the source.
    places: Vec<usize>,
    /// The places of line breaks in the text, in order.
    breaks: Vec<usize>,
    /// The places in the source of markup that stands for nothing or for a blank, in order.
    pub(super) markup: Vec<Range<usize>>,
}

/// Commands of LaTeX that stand for a character or for nothing, longer ones first.
const COMMANDS: [(&str, &str); 40] = [
    ("longrightarrow", "→"),
    ("xrightarrow", "→"),
    ("Rightarrow", "→"),
    ("rightarrow", "→"),
    ("mapsto", "→"),
    ("lbrack", "["),
    ("rbrack", "]"),
    ("degree", "°"),
    ("omega", "ω"),
    ("delta", "δ"),
    ("theta", "θ"),
    ("alpha", "α"),
    ("quad", " "),
    ("qquad", " "),
    ("circ", "°"),
    ("left", ""),
    ("right", ""),
    ("mathrm", ""),
    ("mathtt", ""),
    ("mathit", ""),
    ("texttt", ""),
    ("textbf", ""),
    ("textit", ""),
    ("text", ""),
    ("emph", ""),
    ("item", "\n"),
    ("par", "\n"),
    ("colon", ":"),
    ("pi", "π"),
    ("to", "→"),
    ("gt", ">"),
    ("lt", "<"),
    ("newline", "\n"),
    ("hspace", " "),
    ("vert", "|"),
    ("wedge", "^"),
    ("frac", ""),
    ("ast", "*"),
    ("varepsilon", "ε"),
    ("epsilon", "ε"),
];

/// Signs of HTML.
const ENTITIES: [(&str, &str); 8] = [
    ("&gt;", ">"),
    ("&lt;", "<"),
    ("&amp;", "&"),
    ("&nbsp;", " "),
    ("&rarr;", "→"),
    ("&deg;", "°"),
    ("&quot;", "\""),
    ("&#8594;", "→"),
];

impl Decoded {
    pub(super) fn new(source: &str) -> Self {
        let commands = [
            "\\rightarrow",
            "\\to ",
            "\\to\\",
            "\\mapsto",
            "\\Rightarrow",
            "\\longrightarrow",
            "\\begin{",
            "\\omega",
            "\\delta",
            "\\texttt{",
            "\\item",
        ];
        let is_latex = commands.iter().any(|command| source.contains(command));
        let is_html = ["</", "<br", "<p>", "<li>", "/>"].iter().any(|tag| source.contains(tag));
        let mut decoded = Self {
            text: String::with_capacity(source.len()),
            places: Vec::with_capacity(source.len() + 1),
            breaks: Vec::new(),
            markup: Vec::new(),
        };
        let mut aligned = 0_usize;
        let mut at = 0;
        while let Some(ch) = source[at..].chars().next() {
            let rest = &source[at..];
            let (read, length) = match ch {
                '&' => match ENTITIES.iter().find(|(name, _)| rest.starts_with(name)) {
                    Some((name, sign)) => (*sign, name.len()),
                    None if is_latex && aligned > 0 => (" ", 1),
                    None => ("&", 1),
                },
                '<' if is_html => match tag(rest) {
                    Some((pieces, length)) => {
                        for (place, piece) in pieces {
                            decoded.text.push_str(&piece);
                            decoded.places.extend(core::iter::repeat_n(at + place, piece.len()));
                        }
                        ("", length)
                    }
                    None => ("<", 1),
                },
                '\\' if is_latex => {
                    aligned += usize::from(rest.starts_with("\\begin{"));
                    aligned = aligned.saturating_sub(usize::from(rest.starts_with("\\end{")));
                    command(rest)
                }
                '$' if is_latex => ("", 1),
                '^' if is_latex && (rest.starts_with("^\\circ") || rest.starts_with("^{\\circ}")) => {
                    ("°", if rest.starts_with("^\\") { 6 } else { 8 })
                }
                '{' | '}' if is_latex => ("", 1),
                '\u{feff}' | '\u{200b}' => ("", ch.len_utf8()),
                '\u{a0}' => (" ", ch.len_utf8()),
                '\r' => ("", 1),
                _ => (&rest[..ch.len_utf8()], ch.len_utf8()),
            };
            if read.trim().is_empty() && !ch.is_whitespace() {
                decoded.markup.push(at..at + length);
            }
            decoded.text.push_str(read);
            decoded.places.extend(core::iter::repeat_n(at, read.len()));
            at += length;
        }
        decoded.places.push(source.len());
        decoded.breaks = decoded.text.match_indices('\n').map(|(at, _)| at).collect();
        decoded
    }

    /// The place in the source of a range of the text.
    pub(super) fn span(&self, range: &Range<usize>) -> Range<usize> {
        let place = |at: usize| self.places.get(at).copied().unwrap_or_default();
        // Up to where the next character begins; of one character, its whole sign.
        let start = place(range.start);
        start..if range.is_empty() { start } else { place(range.end).max(start) }
    }

    /// The whole lines of the text around a span of the source, as a span of the source.
    pub(super) fn lines_around(&self, span: Range<usize>) -> Range<usize> {
        let (start, end) = (self.place_of(span.start), self.place_of(span.end));
        let start = self.break_before(start).map_or(0, |at| at + 1);
        let next = self.breaks.partition_point(|at| *at < end);
        let end = self.breaks.get(next).copied().unwrap_or(self.text.len());
        let found = self.span(&(start..end));
        found.start.min(span.start)..found.end.max(span.end)
    }

    /// The last line break before a place in the text.
    pub(super) fn break_before(&self, place: usize) -> Option<usize> {
        self.breaks.partition_point(|at| *at < place).checked_sub(1).map(|last| self.breaks[last])
    }

    /// The place in the text of a place in the source.
    pub(super) fn place_of(&self, at: usize) -> usize {
        self.places.partition_point(|place| *place < at).min(self.text.len())
    }
}

/// What a command of LaTeX at the start of a text stands for, and its length.
fn command(text: &str) -> (&'static str, usize) {
    let rest = &text[1..];
    if rest.starts_with("begin{") || rest.starts_with("end{") {
        return ("\n", 1 + rest.find('}').map_or(rest.len(), |end| end + 1));
    }
    match rest.chars().next() {
        Some('\\') => return ("\n", 2),
        Some(',' | ';' | ' ' | ':' | '!') => return (" ", 2),
        Some('{') => return ("{", 2),
        Some('}') => return ("}", 2),
        Some('%') => return ("%", 2),
        Some('&') => return ("&", 2),
        Some('#') => return ("#", 2),
        Some('_') => return ("_", 2),
        Some('(' | ')' | '[' | ']') => return ("", 2),
        _ => {}
    }
    let length = rest.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(rest.len());
    match COMMANDS.iter().find(|(name, _)| *name == &rest[..length]) {
        Some((_, sign)) => (sign, 1 + length),
        None => (" ", 1 + length),
    }
}

/// Tags of HTML that stand inside a line.
const INLINE: [&str; 14] =
    ["code", "b", "i", "strong", "em", "span", "sub", "sup", "tt", "kbd", "a", "var", "font", "u"];
/// Attributes for the sides of a rule.
const FROM: [&str; 9] = ["char", "symbol", "from", "predecessor", "key", "letter", "left", "input", "lhs"];
const TO: [&str; 9] = ["to", "successor", "value", "replacement", "right", "output", "rhs", "result", "string"];

/// What a tag of HTML or XML at the start of a text says, in pieces with their places in it, and its length. The name of a
/// part of a system becomes a label: `<axiom>X</axiom>`, `<rule from="F" to="FF"/>`.
fn tag(text: &str) -> Option<(Vec<(usize, String)>, usize)> {
    let name = text[1..].strip_prefix('/').unwrap_or(&text[1..]);
    if !name.starts_with(|c: char| c.is_ascii_alphabetic() || matches!(c, '!' | '?')) {
        return None;
    }
    let end = text[1..].find(['<', '>'])? + 1;
    if !text[end..].starts_with('>') {
        return None;
    }
    let letters = name.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(name.len());
    let word = name[..letters].to_ascii_lowercase();
    let behind = &name[letters..];
    // A comparison or a context is no tag.
    if !behind.starts_with(|c: char| c.is_whitespace() || matches!(c, '>' | '/' | '!' | '-' | '?' | ':'))
        && !behind.is_empty()
    {
        return None;
    }
    let whole = text[..end].trim_end_matches('/');
    let mut pieces = Vec::new();
    if text.starts_with("</") || INLINE.contains(&&*word) {
        let blank = if INLINE.contains(&&*word) { "" } else { "\n" };
        return Some((vec![(0, blank.to_owned())], end + 1));
    }
    pieces.push((0, if matches!(&*word, "td" | "th") { " ".to_owned() } else { "\n".to_owned() }));
    if let Some(key) = key(&word).filter(|_| word.len() > 1) {
        let label = if matches!(key, Key::Rule) { "rule" } else { &word };
        pieces.push((1, format!("{label}: ")));
    }
    let mut at = text.len() - behind.len();
    while let Some(sign) = whole.get(at..).and_then(|rest| rest.find('=')).map(|found| at + found) {
        let before = whole[at..sign].trim_end();
        let name = before.rsplit(char::is_whitespace).next().unwrap_or_default().to_ascii_lowercase();
        let rest = &whole[sign + 1..];
        let Some(quote) = rest.chars().next().filter(|c| matches!(c, '"' | '\'')) else { break };
        let Some(close) = rest[1..].find(quote) else { break };
        let (value, place) = (&rest[1..=close], sign + 2);
        if FROM.contains(&&*name) {
            pieces.push((place, format!("{value} → ")));
        } else if TO.contains(&&*name) {
            pieces.push((place, value.to_owned()));
        } else if key(&name).is_some() {
            pieces.push((place, format!("\n{name}: {value}\n")));
        }
        at = sign + 2 + close + 1;
    }
    Some((pieces, end + 1))
}
