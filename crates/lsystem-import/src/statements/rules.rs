//! Axioms, rules, constants and meanings of symbols in a line.

use super::line::{Weak, arrows, constant, predecessor, squeezed, successor, tokens, weak};
use super::{LONGEST, Label, QUOTES, Reader, Section};
use crate::assembly::{Rule, Said};
use crate::phrases::{actions, pair, symbols};
use crate::prose_words::{alternatives, is_language, is_prose, weight, weighted_symbol};
use crate::vocabulary::{Key, rows};
use core::ops::Range;
use lsystem_base::decimal;

impl Reader<'_> {
    pub(super) fn axiom(&mut self, label: &Label, value: &Range<usize>) {
        let (inner, end) = self.word(value);
        let text: String = self.text(&inner).to_owned();
        if text.is_empty() || !label.word.to_lowercase().contains("axiom") && is_prose(&text) {
            return;
        }
        if is_prose(&text) && text.split_whitespace().count() > 2 {
            return;
        }
        match &self.said.axiom {
            Some(known) if squeezed(&known.value) == squeezed(&text) && self.said.rules.is_empty() => return,
            Some(_) => self.next_system(),
            None => {}
        }
        let span = self.span(&(label.start..inner.end));
        self.extent(&span);
        self.said.axiom = Some(Said::new(text, span));
        let rest = end..value.end;
        self.rest(&rest, true);
    }

    /// The word of symbols at the start of a range, and where it ends.
    pub(super) fn word(&self, range: &Range<usize>) -> (Range<usize>, usize) {
        let range = self.trimmed(range, &[]);
        let text = self.text(&range);
        // In quotes, exactly what stands there.
        for (open, close) in [('`', '`'), ('"', '"'), ('“', '”'), ('\'', '\''), ('«', '»')] {
            if let Some(inside) = text.strip_prefix(open)
                && let Some(end) = inside.find(close)
            {
                let start = range.start + open.len_utf8();
                return (start..start + end, start + end + close.len_utf8());
            }
        }
        // In parentheses as a whole.
        if let Some(inside) = text.strip_prefix('(')
            && let Some(end) = inside.find(')')
            && inside[end + 1..].trim_matches(['.', ',', ' ', ';']).is_empty()
        {
            return (range.start + 1..range.start + 1 + end, range.end);
        }
        let start = range.start + text.len() - text.trim_start_matches(['*', '`']).len();
        let text = &text[start - range.start..];
        let tokens = tokens(text);
        let mut end = 0;
        let mut separated = false;
        for token in &tokens {
            let own = &text[token.clone()];
            if is_language(own, 3)
                || separated
                || matches!(own, "and" | "is" | "with" | "where" | "at" | "to" | "in" | "–" | "—")
            {
                break;
            }
            end = token.end;
            separated = own.ends_with([',', ';', '.']) && own.len() > 1;
        }
        let word = text[..end].trim_end_matches(['.', ',', ';', '"', '`', '*', ' ', '”']);
        // Brackets and braces that only close.
        let word = if word.ends_with('}') && !word.contains('{') { word.trim_end_matches('}') } else { word };
        let word = if word.ends_with(')') && !word.contains('(') { word.trim_end_matches(')') } else { word };
        (start..start + word.len(), start + end)
    }

    /// Reads rules and meanings in a range of a line.
    pub(super) fn region(&mut self, range: &Range<usize>, section: Section, alone: bool) {
        let range = self.trimmed(range, &[]);
        let text = self.text(&range).to_owned();
        if text.is_empty() {
            return;
        }
        if section == Section::Meanings {
            return self.meanings(&range);
        }
        let arrows = arrows(&text);
        self.arrows += arrows.len();
        if !arrows.is_empty() {
            return self.rules(&range, &text, &arrows);
        }
        if !alone {
            return self.meanings(&range);
        }
        if self.pending.is_some()
            && let Some((name, value)) = text.split_once(':')
            && rows(name).has(Key::Weight)
        {
            self.chance = weight(value);
            return self.cover(&range);
        }
        // Rules with a weak sign: the whole text must be such rules.
        let mut pieces: Vec<Range<usize>> = Vec::new();
        let mut from = 0;
        for (at, ch) in text.char_indices().filter(|(_, ch)| matches!(ch, ';' | ',')) {
            let behind = text[at + 1..].trim_start();
            let next_is_rule = behind.chars().nth(1).is_some_and(|c| matches!(c, '=' | ':' | '>' | ' '));
            let head = &behind[..behind.floor_char_boundary(LONGEST)];
            if ch == ';' && section == Section::Rules || next_is_rule && weak(head).is_some() {
                pieces.push(from..at);
                from = at + 1;
            }
        }
        pieces.push(from..text.len());
        let found: Option<Vec<(Range<usize>, Weak)>> = pieces
            .into_iter()
            .filter(|piece| !text[piece.clone()].trim().is_empty())
            .map(|piece| weak(&text[piece.clone()]).map(|weak| (piece, weak)))
            .collect();
        // The successors stand below: `X:` and `- production: F[+X]`.
        let is_open = section == Section::Rules && !text.contains('=');
        match found.filter(|found| !found.is_empty()) {
            Some(found) => {
                for (piece, (from, to)) in found {
                    let place = range.start + piece.start..range.start + piece.end;
                    let place = self.trimmed(&place, &[]);
                    if let Some(number) =
                        constant(&to).filter(|_| section != Section::Rules && from.chars().all(char::is_alphabetic))
                    {
                        self.constants.push(Said::new(format!("{from} = {number}"), self.span(&place)));
                        continue;
                    }
                    // `F=FF and run it`, but `]: pop the state`
                    let word = if is_prose(&to) { successor(&to, false, false, false).0 } else { to.clone() };
                    let is_word = |word: &str| !word.chars().all(|c| c.is_lowercase() || c.is_whitespace());
                    if is_prose(&to) && !is_word(&word) || !is_word(&to) && actions(&to).is_some() {
                        self.meanings(&place);
                    } else if to.is_empty() && is_open {
                        self.pending = Some(from);
                        self.cover(&place);
                    } else {
                        self.push_rule(&from, &word, None, &place);
                    }
                }
            }
            None => {
                self.constant_line(&range, &text);
                self.meanings(&range);
            }
        }
    }

    /// A constant of rules with parameters: `#define r 2`, `ratio = 0.9`.
    fn constant_line(&mut self, range: &Range<usize>, text: &str) {
        let define = text.strip_prefix("#define").or_else(|| text.strip_prefix("define")).map(str::trim);
        let pair = match define {
            Some(rest) => rest.split_once(char::is_whitespace),
            None => text.split_once('='),
        };
        let Some((name, value)) = pair else { return };
        let name = name.trim();
        if !name.is_empty()
            && name.len() < 30
            && name.chars().all(|c| c.is_alphanumeric() || c == '_')
            && let Some(number) = constant(value.trim())
        {
            self.constants.push(Said::new(format!("{name} = {number}"), self.span(range)));
        }
    }

    /// Adds a rule, or one for each alternative: `F[+F] | F[-F]`.
    pub(super) fn push_rule(&mut self, from: &str, to: &str, weight: Option<f64>, place: &Range<usize>) {
        // `*` stands for any context.
        let bare = from.trim();
        let bare = bare.strip_prefix('*').map_or(bare, |rest| rest.trim_start().strip_prefix('<').unwrap_or(bare));
        let bare = bare.strip_suffix('*').map_or(bare, |rest| rest.trim_end().strip_suffix('>').unwrap_or(bare));
        let (from, own) = weighted_symbol(bare.trim());
        let span = self.span(place);
        self.extent(&span);
        for (to, weight) in alternatives(to, weight.or(own)) {
            let (from, to, span) = (from.to_owned(), to.to_owned(), span.clone());
            if self.section == Section::Images {
                self.said.images.push(Said::new(format!("{from} -> {to}"), span));
            } else {
                self.said.rules.push(Rule { from, to, weight, span });
            }
        }
    }

    /// Reads the rules of a text with arrows.
    pub(super) fn rules(&mut self, range: &Range<usize>, text: &str, arrows: &[Range<usize>]) {
        let mut from = 0;
        for (index, arrow) in arrows.iter().enumerate() {
            let before = &text[from..arrow.start];
            let (head, head_weight) = predecessor(before);
            let start = arrow.start - (before.len() - head.start);
            let own = before[head.clone()].to_owned();
            let limit = arrows.get(index + 1).map_or(text.len(), |next| {
                let between = &text[arrow.end..next.start];
                arrow.end + predecessor(between).0.start
            });
            let after = &text[arrow.end..limit];
            // Marks and numbers between rules: `, p_2 :`.
            let between = before[..head.start].trim_matches(|c: char| c.is_whitespace() || ",;:({.".contains(c));
            let is_number = between.trim_start_matches(['p', 'r', 'P', 'R', '_']).chars().all(|c| c.is_ascii_digit());
            if is_number && from + head.start > from {
                self.cover(&(range.start + from..range.start + from + head.start));
            }
            let opened = before[..head.start].trim_end().ends_with(['(', '{']);
            let quoted = before.trim_end().ends_with('\'');
            let (to, end, said) = successor(after, opened, index + 1 < arrows.len(), quoted);
            let place = range.start + start..range.start + arrow.end + end;
            from = arrow.end + end;
            if own.is_empty() || is_prose(&own) && !own.contains('(') {
                continue;
            }
            if let Some(phrase) = said {
                let place = range.start + start..range.start + limit;
                self.meaning(&own.chars().filter(|c| !QUOTES.contains(c)).collect::<Vec<_>>(), &phrase, &place);
                from = limit;
                continue;
            }
            self.push_rule(&own, &to, head_weight, &place);
        }
        let rest = range.start + from..range.end;
        let rest = self.trimmed(&rest, &[',', ';', '.', ')', '(']);
        self.meanings(&rest);
    }

    /// Reads what symbols do, in the sentences of a range.
    pub(super) fn meanings(&mut self, range: &Range<usize>) {
        let text = self.text(range).to_owned();
        let mut from = 0;
        let ends = text.match_indices(['.', ';', ',']).map(|(at, _)| at).chain([text.len()]);
        // A sentence ends at a point before a blank, at a semicolon, or at a comma before further symbols.
        for end in ends.collect::<Vec<_>>() {
            if end < from {
                continue;
            }
            let behind = &text[(end + 1).min(text.len())..];
            let cut = end == text.len()
                || text[end..].starts_with(';')
                || text[end..].starts_with('.') && behind.starts_with(char::is_whitespace)
                || text[end..].starts_with(',') && symbols(behind).is_some();
            if !cut {
                continue;
            }
            // `A mean draw forward and B mean move forward`
            let sentence = &text[from..end];
            let mut part = from;
            let joints = sentence.match_indices(" and ").filter(|_| sentence.len() <= LONGEST);
            for (at, _) in joints.map(|(at, word)| (from + at, word)).collect::<Vec<_>>() {
                if symbols(&text[at + 5..end]).is_some_and(|(_, begins)| actions(&text[at + 5 + begins..end]).is_some())
                    && symbols(&text[part..at]).is_some_and(|(_, begins)| actions(&text[part + begins..at]).is_some())
                {
                    self.sentence(range.start + part..range.start + at);
                    part = at + 5;
                }
            }
            self.sentence(range.start + part..range.start + end);
            from = end + 1;
        }
    }

    fn sentence(&mut self, range: Range<usize>) {
        let range = self.trimmed(&range, &['•']);
        let text = self.text(&range).to_owned();
        let Some((symbols, at)) = symbols(&text) else { return };
        self.meaning(&symbols, &text[at..], &range);
    }

    fn meaning(&mut self, symbols: &[char], phrase: &str, place: &Range<usize>) {
        if let [first, second] = symbols
            && let Some((one, other)) = pair(phrase)
        {
            self.meaning(&[*first], &one, place);
            return self.meaning(&[*second], &other, place);
        }
        let Some((actions, degrees)) = actions(phrase) else { return };
        let span = self.span(place);
        self.extent(&span);
        for symbol in symbols {
            let symbol = lsystem_syntax::look_alike(*symbol).unwrap_or(*symbol);
            let with_angle = |action: &&str| match degrees {
                Some(degrees) if action.starts_with("turn ") && **action != *"turn round" => {
                    format!("{action} {}", lsystem_base::number::number(degrees))
                }
                _ => (*action).to_owned(),
            };
            let words: Vec<String> = actions.iter().map(with_angle).collect();
            self.said.mean(symbol, words.join(", "), span.clone());
        }
    }

    /// Keeps the first number before a sign of degrees, for texts without a labelled angle.
    pub(super) fn note_degrees(&mut self, line: &Range<usize>, text: &str) {
        if self.degrees.is_some() {
            return;
        }
        let Some(sign) =
            ["°", " degrees", "-degree", " deg", " degree"].iter().filter_map(|sign| text.find(sign)).min()
        else {
            return;
        };
        let digits = &text[..sign];
        let start = digits
            .rfind(|ch: char| !ch.is_ascii_digit() && !matches!(ch, '.' | ','))
            .map_or(0, |at| at + digits[at..].chars().next().map_or(1, char::len_utf8));
        if let Some(number) = decimal::read(&digits[start..].replace(',', ".")) {
            let span = self.span(&(line.start + start..line.start + sign));
            self.degrees = Some(Said::new(number, span));
        }
    }
}
