//! A text as a person reads it: markup and commands of LaTeX and HTML are read where they stand. Every character keeps
//! its place in the source.

use crate::mapped::Mapped;
use crate::vocabulary::sign;
use crate::vocabulary::{Key, key, rows};
use crate::wrappings::entity;
use core::ops::Range;

/// Characters with their places.
#[derive(Debug, Default)]
pub(super) struct Decoded {
    pub(super) mapped: Mapped,
    /// The places of line breaks in the text, in order.
    breaks: Vec<usize>,
    /// The places in the source of markup that stands for nothing or for a blank, in order.
    pub(super) markup: Vec<Range<usize>>,
}

impl Decoded {
    pub(super) fn new(source: &str) -> Self {
        let commands = r"\to\ \mapsto \Rightarrow \longrightarrow \begin{ \omega \delta \texttt{ \item \rightarrow";
        let is_latex = source.contains("\\to ") || commands.split(' ').any(|command| source.contains(command));
        let is_html = ["</", "<br", "<p>", "<li>", "/>"].iter().any(|tag| source.contains(tag));
        let mut decoded = Self::default();
        // Markdown writes a backslash before signs of its own: `F\[+F\]`. As a symbol it stands before few brackets.
        let is_escaped =
            !is_latex && source.contains("\\]") && source.matches("\\]").count() == source.matches(']').count();
        let mut pairs = Pairs::default();
        let mut aligned = 0_usize;
        let mut at = 0;
        while let Some(ch) = source[at..].chars().next() {
            let rest = &source[at..];
            let mut buffer = [0; 4];
            let named: String;
            let mark = if is_latex { None } else { pairs.mark(source, at) };
            let (read, length) = match ch {
                '&' => match entity(rest) {
                    Some((sign, length)) => {
                        named = sign;
                        (&*named, length)
                    }
                    None if is_latex && aligned > 0 => (" ", 1),
                    None => ("&", 1),
                },
                '<' if is_html => match tag(rest) {
                    Some((pieces, length)) => {
                        for (place, piece) in pieces {
                            decoded.mapped.push(at + place, &piece);
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
                '\\' if is_escaped && rest[1..].starts_with(|c: char| c.is_ascii_punctuation()) => (&rest[1..2], 2),
                '$' if is_latex => ("", 1),
                _ if mark.is_some() => ("", mark.unwrap_or_default()),
                '^' if is_latex && (rest.starts_with("^\\circ") || rest.starts_with("^{\\circ}")) => {
                    ("°", if rest.starts_with("^\\") { 6 } else { 8 })
                }
                '{' | '}' if is_latex => ("", 1),
                '\u{feff}' | '\u{200b}' => ("", ch.len_utf8()),
                '\u{a0}' => (" ", ch.len_utf8()),
                '。' => (".", ch.len_utf8()),
                '、' => (",", ch.len_utf8()),
                // Wide forms of ASCII.
                '\u{ff01}'..='\u{ff5e}' => match char::from_u32(u32::from(ch) - 0xfee0) {
                    Some(sign) => (&*sign.encode_utf8(&mut buffer), ch.len_utf8()),
                    None => ("", ch.len_utf8()),
                },
                '\r' => ("", 1),
                _ => (&rest[..ch.len_utf8()], ch.len_utf8()),
            };
            if read.trim().is_empty() && !ch.is_whitespace() {
                decoded.markup.push(at..at + length);
            }
            decoded.mapped.push(at, read);
            at += length;
        }
        decoded.mapped = decoded.mapped.end(source.len());
        decoded.breaks = decoded.mapped.text.match_indices('\n').map(|(at, _)| at).collect();
        decoded
    }

    /// The whole lines of the text around a span of the source, as a span of the source.
    pub(super) fn lines_around(&self, span: Range<usize>) -> Range<usize> {
        let (start, end) = (self.mapped.at(span.start), self.mapped.at(span.end));
        let start = self.break_before(start).map_or(0, |at| at + 1);
        let next = self.breaks.partition_point(|at| *at < end);
        let end = self.breaks.get(next).copied().unwrap_or(self.mapped.text.len());
        let found = self.mapped.span(&(start..end));
        found.start.min(span.start)..found.end.max(span.end)
    }

    /// The last line break before a place in the text.
    pub(super) fn break_before(&self, place: usize) -> Option<usize> {
        self.breaks.partition_point(|at| *at < place).checked_sub(1).map(|last| self.breaks[last])
    }
}

/// Marks of Markdown that stand in pairs: code, formulas of one name, bold words.
#[derive(Default)]
struct Pairs {
    /// The place of the mark that closes, and its length.
    close: Option<(usize, usize)>,
}

impl Pairs {
    /// The length of the mark at a place; `None` if the characters stand for themselves, as symbols do.
    fn mark(&mut self, source: &str, at: usize) -> Option<usize> {
        if let Some((close, length)) = self.close
            && close >= at
        {
            return (close == at).then_some(length);
        }
        let rest = &source[at..];
        let mark = ["`", "$", "**", "__"].into_iter().find(|mark| rest.starts_with(mark))?;
        let before = source[..at].chars().next_back().unwrap_or(' ');
        let after = &rest[mark.len()..];
        let inside = &after[..after.find(['\n', char::from(mark.as_bytes()[0])])?];
        let behind = after[inside.len()..].strip_prefix(mark)?.chars().next().unwrap_or(' ');
        let is_apart = |c: char| c.is_whitespace() || "().,;:|*_=°>-–".contains(c);
        let fits = is_apart(before)
            && is_apart(behind)
            && !inside.is_empty()
            && inside.trim() == inside
            && (mark != "$" || inside.len() <= 5 && inside.chars().all(|c| c.is_alphanumeric() || c == '_'));
        self.close = fits.then_some((at + mark.len() + inside.len(), mark.len()));
        fits.then_some(mark.len())
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
    (sign(&rest[..length]).unwrap_or(" "), 1 + length)
}

/// Tags of HTML that stand inside a line.
const INLINE: [&str; 14] =
    ["code", "b", "i", "strong", "em", "span", "sub", "sup", "tt", "kbd", "a", "var", "font", "u"];
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
        if rows(&name).has(Key::Predecessor) {
            pieces.push((place, format!("{value} → ")));
        } else if rows(&name).has(Key::Successor) {
            pieces.push((place, value.to_owned()));
        } else if key(&name).is_some() {
            pieces.push((place, format!("\n{name}: {value}\n")));
        }
        at = sign + 2 + close + 1;
    }
    Some((pieces, end + 1))
}
