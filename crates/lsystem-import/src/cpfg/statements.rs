//! The statements of a file for cpfg: lines, with the lines that continue them.

use crate::vocabulary::{Key, words};

/// A statement without its comments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Statement<'c> {
    pub(super) text: &'c str,
    pub(super) class: Class,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Class {
    /// A line of the preprocessor.
    Directive,
    Keyword(&'static str),
    /// A production, or a line that is none.
    Other,
}

/// The keyword at the start of a line, in lower case, and the text behind its colon.
pub(super) fn keyword(line: &str) -> Option<(&'static str, &str)> {
    let line = line.trim();
    let (word, rest) = match line.find(':') {
        Some(at) => (&line[..at], &line[at + 1..]),
        None => (line, &line[line.len()..]),
    };
    // Trimmed once, not for each of the known words: every line of a text is looked at.
    let word = word.trim_end();
    let known = |word: &str| words(Key::Cpfg).iter().copied().find(|known| known.eq_ignore_ascii_case(word));
    if let Some(word) = known(word) {
        return (is_alone(word) || line.contains(':')).then_some((word, rest.trim()));
    }
    // `group 1:`, and words behind `homomorphism`.
    let (first, rest) = word.split_once(char::is_whitespace)?;
    let number = rest.trim().parse::<u32>().is_ok();
    match known(first)? {
        "group" if number => Some(("group", rest.trim())),
        word @ ("homomorphism" | "decomposition") if matches!(rest.trim(), "warnings" | "no warnings") => {
            Some((word, ""))
        }
        _ => None,
    }
}

/// Whether nothing stands behind a keyword.
pub(super) fn is_alone(word: &str) -> bool {
    matches!(
        word,
        "homomorphism" | "interpretation" | "decomposition" | "endlsystem" | "production" | "ring lsystem" | "endgroup"
    )
}

/// The statements of a text without comments.
pub(super) fn statements(clean: &str) -> Vec<Statement<'_>> {
    let place = |part: &str| part.as_ptr().addr() - clean.as_ptr().addr();
    let mut found: Vec<Open> = Vec::new();
    let mut lines = clean.lines().peekable();
    while let Some(line) = lines.next() {
        let text = line.trim();
        let next = lines.peek().map_or("", |next| next.trim());
        let (start, end) = (place(text), place(text) + text.len());
        match found.last_mut() {
            Some(open) if open.braces > 0 || (!text.is_empty() && open.continues(line, next)) => {
                open.add(text);
                open.end = end.max(open.end);
            }
            Some(open) if text.is_empty() => open.closed = true,
            _ if text.is_empty() => {}
            _ => found.push(Open::new(text, start)),
        }
    }
    found.into_iter().map(|open| Statement { text: &clean[open.start..open.end], class: open.class }).collect()
}

/// A statement whose lines are gathered.
struct Open {
    start: usize,
    end: usize,
    class: Class,
    /// How many braces, and how many brackets and parentheses, are open.
    braces: usize,
    brackets: usize,
    has_arrow: bool,
    /// Whether the last line ends in the middle of arithmetic.
    halfway: bool,
    /// Whether an empty line stands behind it.
    closed: bool,
}

impl Open {
    fn new(text: &str, start: usize) -> Self {
        let class = match keyword(text) {
            Some((word, _)) => Class::Keyword(word),
            None if is_directive(text) => Class::Directive,
            None => Class::Other,
        };
        let mut open = Self {
            start,
            end: start + text.len(),
            class,
            braces: 0,
            brackets: 0,
            has_arrow: false,
            halfway: false,
            closed: false,
        };
        open.add(text);
        open
    }

    fn add(&mut self, text: &str) {
        let code = matches!(self.class, Class::Keyword("start" | "end" | "starteach" | "endeach" | "define"))
            || matches!(self.class, Class::Keyword("start each" | "end each"))
            || (self.class == Class::Other && !self.has_arrow);
        let arrow = arrow(text).map_or(text.len(), |(at, _)| at);
        for (at, ch) in text.char_indices() {
            match ch {
                '{' if code && at < arrow => self.braces += 1,
                '}' if code && at < arrow => self.braces = self.braces.saturating_sub(1),
                '[' | '(' => self.brackets += 1,
                ']' | ')' => self.brackets = self.brackets.saturating_sub(1),
                _ => {}
            }
        }
        self.has_arrow |= arrow < text.len();
        self.halfway = ends_halfway(text);
    }

    /// Whether a line continues the statement. `next` is the line behind it.
    fn continues(&self, line: &str, next: &str) -> bool {
        let text = line.trim();
        let is_code = matches!(self.class, Class::Keyword(_)) && self.class != Class::Keyword("axiom");
        if keyword(text).is_some() || is_directive(text) || self.closed {
            return false;
        }
        if is_code || self.class == Class::Directive {
            let block = matches!(self.class, Class::Keyword(word) if word.contains("start") || word.contains("end"));
            return (block || self.class == Class::Keyword("define")) && text.starts_with('{');
        }
        let indented = line.starts_with([' ', '\t']);
        if self.class == Class::Other && !self.has_arrow {
            return indented || self.halfway || self.brackets > 0 || begins_halfway(text);
        }
        let is_rule = arrow(text).is_some();
        let is_head = begins_halfway(next) || (ends_halfway(text) && text.contains(':') && arrow(next).is_some());
        !is_rule && if indented { !is_head } else { self.brackets > 0 }
    }
}

/// The place and the length of the arrow of a production.
pub(super) fn arrow(text: &str) -> Option<(usize, usize)> {
    text.find("-->").or_else(|| text.find("-o>")).map(|at| (at, 3))
}

fn ends_halfway(text: &str) -> bool {
    text.ends_with(['&', '|', '<', '>', '=', '+', '*', ',', '(', ':']) && !text.ends_with("->")
}

fn begins_halfway(text: &str) -> bool {
    ["-->", "-o>", "&&", "||", ":"].iter().any(|mark| text.starts_with(mark))
}

/// Whether a line is one of the preprocessor: `#` is also a symbol.
fn is_directive(text: &str) -> bool {
    let Some(rest) = text.strip_prefix('#') else { return false };
    let rest = rest.trim_start_matches([' ', '\t']);
    let word = rest.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default();
    let words =
        ["define", "undef", "include", "if", "ifdef", "ifndef", "else", "elif", "endif", "line", "pragma", "error"];
    words.contains(&word) || (text.starts_with("# ") && word.starts_with(|c: char| c.is_ascii_digit()))
}
