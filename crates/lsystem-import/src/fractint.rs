//! Fractint's `.l` files.
//!
//! ```text
//! Bush { ; a comment
//!   Angle 16
//!   Axiom ++++F
//!   F=FF-[-F+F+F]+[+F-F-F]
//! }
//! ```
//!
//! Case is ignored. Several rules for one letter are joined. `Angle n` is 360/n degrees. Fractint keeps two headings:
//! `F` and `G` go along the first, which `+ - |` turn; `D` and `M` go along the second, which `\nn` and `/nn` turn. Both
//! start to the right. Our turtle has one heading, so a system with both is read only if every group of turns changes
//! both headings alike. Typographic look-alikes, as on web pages, are read as what they look like, with a remark.

mod translate;

use crate::MAX_ENTRIES;
use crate::draft::Draft;
use crate::source::Source;
use core::ops::Range;
use lsystem_base::{decimal, number::number, say};
use lsystem_syntax::look_alike;
use std::collections::{HashMap, HashSet};
use translate::{translate, upper};

/// A symbol of Fractint.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Token {
    /// A single character, in lower case.
    Plain(char),
    /// A character with a number: `@ \ / c < >`.
    Number(char, f64),
}

/// An entry of a file.
#[derive(Debug)]
struct Block<'a> {
    name: &'a str,
    line: usize,
    /// Whether the braces are missing.
    is_bare: bool,
    span: Range<usize>,
    /// The lines without comments.
    lines: Vec<&'a str>,
    comments: Vec<&'a str>,
}

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let blocks = entries(source).or_else(|| bare(source))?;
    Some(blocks.iter().map(|block| entry(source, block)).collect())
}

/// The character that a character stands for: itself, or what it looks like; a blank for invisible ones.
fn plain(ch: char) -> char {
    look_alike(ch).unwrap_or(ch)
}

/// The text of a line before its comment, and the comment.
fn split_comment(line: &str) -> (&str, &str) {
    let (own, comment) = line.split_at(line.find(|c| plain(c) == ';').unwrap_or(line.len()));
    (own.trim(), comment.trim_end())
}

/// Whether a character separates the first word of a line from the rest.
fn is_end(c: char) -> bool {
    plain(c) == '=' || c.is_whitespace()
}

/// The first word of a line, and the rest without `=` and white space at its start.
fn first_word(line: &str) -> (&str, &str) {
    let at = line.find(is_end).unwrap_or(line.len());
    (&line[..at], line[at..].trim_start_matches(is_end))
}

/// Whether a line gives an axiom, as in `Axiom F` or `axiom=F`.
fn is_axiom(line: &str) -> bool {
    let (word, rest) = first_word(line);
    // Scripts have strings, as in `axiom = "F"`.
    word.eq_ignore_ascii_case("axiom") && !rest.is_empty() && !rest.starts_with([':', '"', '\'', '`'])
}

/// Whether a line gives an angle, as in `Angle 6`.
fn is_angle(line: &str) -> bool {
    let (word, rest) = first_word(line);
    word.eq_ignore_ascii_case("angle") && rest.starts_with(|c: char| c.is_ascii_digit())
}

/// Whether a line is a rule, as in `F=FF`.
fn is_rule(line: &str) -> bool {
    let (word, rest) = first_word(line);
    only(word).is_some() && word.len() < line.len() && !rest.starts_with(['>', '=', ':'])
}

/// The character of a text with one character.
fn only(word: &str) -> Option<char> {
    let mut chars = word.chars();
    let first = chars.next()?;
    chars.next().is_none().then_some(first)
}

/// The digits at the start of an angle, which Fractint reads, and the rest.
fn digits(text: &str) -> (&str, &str) {
    text.split_at(text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len()))
}

/// The entries of a file that give an axiom or an angle; `None` if no entry gives an axiom.
fn entries(source: Source<'_>) -> Option<Vec<Block<'_>>> {
    let start = |part: &str| source.place(part).unwrap_or_default().start;
    let mut found: Vec<Block<'_>> = Vec::new();
    let mut open: Option<Block<'_>> = None;
    let mut is_sure = false;
    let mut title = "";
    for line in source.text.lines() {
        let (mut line, comment) = split_comment(line);
        loop {
            let Some(block) = &mut open else {
                let Some(brace) = line.find('{') else {
                    title = if line.is_empty() { title } else { line };
                    break;
                };
                let own = line[..brace].trim();
                let name = core::mem::take(&mut title);
                let name = if own.is_empty() { name } else { own }.trim_end_matches('=').trim();
                let (from, at) = (start(if own.is_empty() { &line[brace..] } else { own }), start(line));
                let (line_number, span) = (source.line_of(at), from..source.text.len());
                let (lines, comments) = (Vec::new(), Vec::new());
                open = Some(Block { name, line: line_number, is_bare: false, span, lines, comments });
                line = line[brace + 1..].trim();
                continue;
            };
            let end = line.find('}');
            let own = line[..end.unwrap_or(line.len())].trim();
            if !own.is_empty() {
                block.lines.push(own);
            }
            let Some(end) = end else { break };
            block.span.end = start(&line[end..]) + 1;
            found.extend(open.take().and_then(|block| kept(block, &mut is_sure)));
            line = line[end + 1..].trim();
        }
        match &mut open {
            Some(block) if !comment.is_empty() => block.comments.push(comment),
            _ => {}
        }
        if found.len() > MAX_ENTRIES {
            break;
        }
    }
    found.extend(open.and_then(|block| kept(block, &mut is_sure)));
    is_sure.then_some(found)
}

/// A block if it gives an axiom or an angle; `is_sure` is set if it is an entry without doubt.
fn kept<'a>(block: Block<'a>, is_sure: &mut bool) -> Option<Block<'a>> {
    let has = |is: fn(&str) -> bool| block.lines.iter().any(|line| is(line));
    *is_sure |= has(is_axiom) && (has(is_angle) || has(is_rule));
    (has(is_axiom) || has(is_angle)).then_some(block)
}

/// The inside of an entry alone: an angle that Fractint accepts, an axiom, and otherwise only rules.
fn bare(source: Source<'_>) -> Option<Vec<Block<'_>>> {
    let all = source.text.lines().map(split_comment);
    let lines: Vec<&str> = all.clone().map(|(line, _)| line).filter(|line| !line.is_empty()).collect();
    let has = |is: fn(&str) -> bool| lines.iter().any(|line| is(line));
    let is_one = |line: &&str| is_axiom(line) || is_angle(line) || is_rule(line);
    let is_accepted = |line: &&str| digits(first_word(line).1).0.parse().is_ok_and(|n: u32| (3..=50).contains(&n));
    let mut angles = lines.iter().filter(|line| is_angle(line));
    // `angle = 25` is of other texts, in degrees.
    let is_other = |line: &&str| (is_axiom(line) || is_angle(line)) && line.contains('=');
    if !has(is_axiom)
        || !has(is_angle)
        || lines.iter().any(is_other)
        || !lines.iter().all(is_one)
        || !angles.all(is_accepted)
    {
        return None;
    }
    let line = source.line_of(source.place(lines.first()?)?.start);
    let comments = all.map(|(_, comment)| comment).filter(|comment| !comment.is_empty()).collect();
    Some(vec![Block { name: "", line, is_bare: true, span: 0..source.text.len(), lines, comments }])
}

/// Splits a word into symbols.
fn tokens(word: &str) -> Vec<Token> {
    let chars = word.chars().map(|c| plain(c).to_ascii_lowercase()).filter(|c| !c.is_whitespace());
    let mut chars = chars.peekable();
    let mut found = Vec::new();
    while let Some(ch) = chars.next() {
        if !matches!(ch, '@' | '\\' | '/' | 'c' | '<' | '>') {
            found.push(Token::Plain(ch));
            continue;
        }
        let (mut root, mut inverse) = (false, false);
        for _ in 0..2 {
            match chars.next_if(|c| matches!(c, 'q' | 'i')) {
                Some('q') => root = true,
                Some(_) => inverse = true,
                None => break,
            }
        }
        let mut digits = String::new();
        while let Some(digit) = chars.next_if(|c| c.is_ascii_digit() || *c == '.') {
            digits.push(digit);
        }
        found.push(Token::Number(ch, value(&digits, root, inverse)));
    }
    found
}

/// The number after `@`, `\` and so on. Fractint reads up to a second decimal point and takes 0 for no number.
fn value(digits: &str, root: bool, inverse: bool) -> f64 {
    let mut points = 0;
    let until_second_point = |c: &char| {
        points += usize::from(*c == '.');
        points < 2
    };
    let text: String = digits.chars().take_while(until_second_point).take(30).collect();
    let mut value = decimal::read(&text).unwrap_or(0.0);
    if value <= 0.0 {
        return 0.0;
    }
    if root {
        value = value.sqrt();
    }
    if inverse { 1.0 / value } else { value }
}

/// The axiom or one line of a rule.
#[derive(Debug, Default)]
struct Word<'a> {
    /// The letter of a rule, in lower case; `None` for the axiom.
    letter: Option<char>,
    /// The whole line, and the word in it.
    line: &'a str,
    text: &'a str,
    tokens: Vec<Token>,
}

/// The parts of a system.
#[derive(Debug, Default)]
struct Parts<'a> {
    /// The number after `Angle`.
    angle: u32,
    axiom: Option<Word<'a>>,
    /// The lines of rules, in the order of the file.
    rules: Vec<Word<'a>>,
}

impl<'a> Parts<'a> {
    fn words(&self) -> impl Iterator<Item = &Word<'a>> + Clone {
        self.axiom.iter().chain(&self.rules)
    }

    fn words_mut(&mut self) -> impl Iterator<Item = &mut Word<'a>> {
        self.axiom.iter_mut().chain(&mut self.rules)
    }

    /// The symbols that can occur.
    fn reachable(&self) -> HashSet<char> {
        let mut by_letter: HashMap<char, Vec<&Word<'_>>> = HashMap::new();
        for rule in &self.rules {
            by_letter.entry(rule.letter.unwrap_or_default()).or_default().push(rule);
        }
        let mut seen = HashSet::new();
        let mut words: Vec<&Word<'_>> = self.axiom.iter().collect();
        while let Some(word) = words.pop() {
            for token in &word.tokens {
                let (Token::Plain(ch) | Token::Number(ch, _)) = *token;
                if seen.insert(ch) {
                    words.extend(by_letter.remove(&ch).unwrap_or_default());
                }
            }
        }
        seen
    }

    /// The joined words of the axiom and of each letter, in the order of the file.
    fn joined(&self) -> Vec<(Option<char>, Vec<Token>)> {
        let mut places: HashMap<Option<char>, usize> = HashMap::new();
        let mut joined: Vec<(Option<char>, Vec<Token>)> = Vec::new();
        for word in self.words() {
            let place = *places.entry(word.letter).or_insert(joined.len());
            match joined.get_mut(place) {
                Some((_, tokens)) => tokens.extend_from_slice(&word.tokens),
                None => joined.push((word.letter, word.tokens.clone())),
            }
        }
        joined
    }

    /// The text of the first word with one of these characters; of the axiom if there is none.
    fn place(&self, chars: &[char]) -> &'a str {
        let has = |text: &str| text.chars().any(|c| chars.contains(&plain(c).to_ascii_lowercase()));
        let found = self.words().find(|word| has(word.text));
        found.or_else(|| self.words().next()).map_or("", |word| word.text)
    }
}

/// The symbols that turn.
#[derive(Clone, Copy, PartialEq)]
enum Turns {
    /// `+ - |`, for `F` and `G`.
    Fixed,
    /// `\` and `/`, for `D` and `M`.
    Degrees,
}

/// Reads an entry.
fn entry<'a>(source: Source<'a>, block: &Block<'a>) -> Draft<'a> {
    let mut draft = Draft::new(source, block.name, block.line);
    draft.covers(block.span.clone());
    block.comments.iter().for_each(|comment| draft.pass(draft.place(comment)));
    if !block.name.is_empty() {
        draft.read(draft.place(block.name), say!("name {}", block.name));
    }
    let mut parts = statements(block, &mut draft);
    if !draft.is_refused() {
        translate(&mut parts, &mut draft);
    }
    draft
}

/// Reads the lines of an entry.
fn statements<'a>(block: &Block<'a>, draft: &mut Draft<'a>) -> Parts<'a> {
    let mut parts = Parts::default();
    let mut angle: Option<&str> = None;
    for &line in &block.lines {
        let (word, rest) = first_word(line);
        let (first, extra) = rest.split_at(rest.find(char::is_whitespace).unwrap_or(rest.len()));
        let extra = extra.trim();
        if word.eq_ignore_ascii_case("axiom") {
            let axiom = word_of(None, line, first, draft);
            if let Some(old) = parts.axiom.replace(axiom) {
                draft.note_at(draft.place(old.line), say!("A later Axiom replaces this one"));
            }
        } else if word.eq_ignore_ascii_case("angle") {
            let (number, more) = digits(first);
            parts.angle = number.parse().unwrap_or(0);
            if let Some(old) = angle.replace(line) {
                draft.note_at(draft.place(old), say!("A later Angle replaces this one"));
            }
            let n = parts.angle;
            draft.read(draft.place(line), say!("angle {}", number_of(360.0 / f64::from(n.max(1)))));
            if !(3..=50).contains(&n) && n > 0 {
                let why = say!("Fractint accepts angles from 3 to 50 only; 360 is divided by this number");
                draft.note_at(draft.place(line), why);
            } else if block.is_bare && n > 12 {
                let degrees = number_of(360.0 / f64::from(n));
                draft.note_at(draft.place(line), say!("As in Fractint, this is 360/{} = {} degrees", n, degrees));
            }
            if !more.is_empty() {
                draft.note_at(draft.place(line), say!("Fractint reads only the digits at the start of the number"));
            }
        } else if let Some(letter) = only(word).map(|letter| plain(letter).to_ascii_lowercase()) {
            if "+-/\\@|c<>][".contains(letter) {
                draft.refuse_at(draft.place(line), say!("Fractint does not allow a rule for this symbol"));
                continue;
            }
            // `F==FF` is read as `F=FF`.
            let (successor, second) = first.split_at(first.find(is_end).unwrap_or(first.len()));
            if second.len() > 1 {
                draft.refuse_at(draft.place(line), say!("Fractint does not allow a second `=` in a rule"));
            }
            let rule = word_of(Some(letter), line, successor, draft);
            parts.rules.push(rule);
        } else {
            draft.refuse_at(draft.place(line), say!("Fractint cannot read this line"));
            continue;
        }
        if !extra.is_empty() {
            draft.refuse_at(draft.place(extra), say!("Fractint does not allow more text after a blank"));
        }
    }
    if parts.axiom.is_none() {
        draft.refuse(block.line, "", say!("There is no Axiom"));
    }
    if angle.is_none() || parts.angle == 0 {
        draft.refuse(block.line, "", say!("There is no Angle from 3 to 50"));
    }
    look_alikes(&parts, draft);
    parts
}

/// A number in few characters.
fn number_of(value: f64) -> String {
    number(libm::round(value * 1e6) / 1e6)
}

/// Notes the first of each kind of look-alike in the words.
fn look_alikes(parts: &Parts<'_>, draft: &mut Draft<'_>) {
    let mut seen = HashSet::new();
    let mut places = Vec::new();
    for word in parts.words() {
        let from = draft.place(word.line).start;
        for (at, ch) in word.line.char_indices().filter(|(_, ch)| !ch.is_ascii()) {
            if let Some(read) = look_alike(ch).filter(|_| seen.insert(ch)) {
                places.push((from + at..from + at + ch.len_utf8(), read));
            }
        }
    }
    for (place, read) in places {
        let message =
            if read == ' ' { say!("This invisible character is left out") } else { say!("Read as `{}`", read) };
        draft.note_at(place, message);
    }
}

/// Reads a word. Brackets must match within it.
fn word_of<'a>(letter: Option<char>, line: &'a str, text: &'a str, draft: &mut Draft<'a>) -> Word<'a> {
    let mut depth = 0_usize;
    let mut end = text.len();
    for (at, ch) in text.char_indices() {
        match plain(ch) {
            '[' => depth += 1,
            ']' if depth == 0 => {
                end = at;
                break;
            }
            ']' => depth -= 1,
            _ => {}
        }
    }
    let (text, rest) = text.split_at(end);
    // A comment seems to begin at the end of `&minus;`.
    if let Some(at) = text.rfind('&').filter(|at| is_entity(&text[at + 1..])) {
        draft.refuse_at(
            draft.place(&text[at..]),
            say!("This is a character’s name in HTML; write the character itself"),
        );
    }
    let became = match letter {
        None => format!("axiom {}", text.to_ascii_uppercase()),
        Some(letter) => format!("{} -> {}", upper(letter), text.to_ascii_uppercase()),
    };
    draft.read(draft.place(line), became);
    if !rest.is_empty() {
        draft.note_at(draft.place(rest), say!("Fractint ignores the rest of a word after a `]` that closes nothing"));
    } else if depth > 0 {
        draft.refuse_at(draft.place(text), say!("Fractint needs the `]` of a branch in the same word as its `[`"));
    }
    Word { letter, line, text, tokens: tokens(text) }
}

/// Whether a text is the name of a usual character in HTML, or its number.
fn is_entity(name: &str) -> bool {
    let number = name.strip_prefix('#').map(|digits| digits.trim_start_matches(['x', 'X']));
    number.is_some_and(|digits| !digits.is_empty() && digits.chars().all(|c| c.is_ascii_hexdigit()))
        || ["minus", "plus", "lt", "gt", "amp", "ndash", "mdash", "nbsp", "quot", "vert", "lbrack", "rbrack", "num"]
            .contains(&name)
}

#[cfg(test)]
mod tests;
