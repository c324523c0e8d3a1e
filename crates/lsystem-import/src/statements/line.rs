//! The parts of a line: labels, arrows, predecessors and successors.

use super::{LONGEST, QUOTES};
use crate::angle::angle;
use crate::prose_words::{is_language, is_prose, weight, weighted};
use crate::rules::ARROWS;
use crate::vocabulary::{Key, Rows, key, rows, words};
use core::ops::Range;
use lsystem_base::decimal;

/// A label at the start of a text: its length, key and word, and where its value begins.
pub(super) fn label_at(text: &str, before: char) -> Option<(usize, Key, String, usize)> {
    // Up to four words.
    let mut ends = Vec::new();
    let mut at = 0;
    for _ in 0..4 {
        let word = text[at..]
            .find(|c: char| !c.is_alphanumeric() && !matches!(c, '_' | '’' | '\''))
            .unwrap_or(text.len() - at);
        if word == 0 || word > 40 {
            break;
        }
        ends.push(at + word);
        at += word;
        let blank = text[at..].len() - text[at..].trim_start_matches([' ', '-']).len();
        if blank == 0 || blank > 2 {
            break;
        }
        at += blank;
    }
    for end in ends.into_iter().rev() {
        let word = &text[..end];
        let Some(key) = key(word) else { continue };
        // A sign behind the label, perhaps behind markup and an explanation in parentheses.
        let mut behind =
            end + text[end..].len() - text[end..].trim_start_matches(['*', '_', '`', '"', ' ', '”', '\t']).len();
        if text[behind..].starts_with('(')
            && let Some(close) = text[behind..].find(')').filter(|close| *close < 40)
            && text[behind + close + 1..].trim_start().starts_with([':', '='])
        {
            behind += close + 1;
            behind += text[behind..].len() - text[behind..].trim_start().len();
        }
        let rest = &text[behind..];
        let sign = [":=", "::=", ":", "=", "≈"].iter().find(|sign| rest.starts_with(**sign));
        let is_sign =
            |sign: &str| !(rest.starts_with("=>") || rest.starts_with("==") || rest.starts_with("::") && sign == ":");
        // `rules X=FX, F=FF` is the label `rules`.
        let is_listed = rows(word) != Rows::default();
        let is_rule = sign == Some(&"=") && word.contains(' ') && !is_listed;
        if let Some(sign) = sign.filter(|sign| is_sign(sign) && !is_rule) {
            let value = behind + sign.len();
            let value = value + text[value..].len() - text[value..].trim_start_matches(['*', ' ', '_', '\t']).len();
            // `A: ...` of a rule is no label; single letters are, where a number follows.
            let single = word.chars().count() == 1;
            // Not of the rule `N=-FY`.
            let digits = text[value..].trim_start_matches(['-', '.', '(', '~', '≈', ' ']);
            let number = digits.starts_with(|c: char| c.is_ascii_digit() || c == 'π');
            if single && !number && !matches!(word, "ω") {
                continue;
            }
            return Some((end, key, word.to_owned(), value));
        }
        // `rule F -> FF` is the label `rule`.
        if !is_listed || word.chars().count() < 3 && word != "n" || before == '"' && key != Key::Axiom {
            continue;
        }
        // Without a sign, only words that can be nothing else, before a value that fits.
        let rest = ["is ", "are ", "of ", "ist ", "est ", "es "]
            .iter()
            .find_map(|word| rest.strip_prefix(word))
            .unwrap_or(rest);
        let value = text.len() - rest.len() + (rest.len() - rest.trim_start().len());
        let rest = &text[value..];
        let lower = word.to_lowercase();
        let fits = match key {
            Key::Axiom => {
                let near = &rest[..rest.floor_char_boundary(LONGEST)];
                let first = near.split_whitespace().next().unwrap_or_default();
                lower.contains("axiom")
                    && !first.is_empty()
                    && !rows(first).has(Key::Filler)
                    && !is_language(first, 3)
                    && first.chars().any(char::is_alphabetic)
            }
            Key::Angle | Key::LeftAngle | Key::RightAngle => {
                rest.starts_with(|c: char| c.is_ascii_digit() || c == 'π' || c == '.') && angle(rest).is_ok()
            }
            Key::Iterations => {
                let is_number = rest.trim_end().bytes().all(|digit| digit.is_ascii_digit());
                rest.starts_with(|c: char| c.is_ascii_digit()) && (lower.len() > 4 || is_number)
            }
            Key::Rules | Key::Rule => true,
            _ => false,
        };
        if fits {
            return Some((end, key, word.to_owned(), value));
        }
    }
    None
}

/// The arrows of rules in a text. An arrow inside a word is none: `X -> XFX-F>X->`.
pub(super) fn arrows(text: &str) -> Vec<Range<usize>> {
    let mut found: Vec<Range<usize>> = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let in_words = || {
            words(Key::Arrow).iter().find(|arrow| {
                text[..at].ends_with(' ') && rest.strip_prefix(**arrow).is_some_and(|rest| rest.starts_with(' '))
            })
        };
        let Some(arrow) = ARROWS.iter().find(|arrow| rest.starts_with(**arrow)).or_else(in_words) else {
            at += rest.chars().next().map_or(1, char::len_utf8);
            continue;
        };
        let place = at..at + arrow.len();
        at = place.end;
        let before = &text[found.last().map_or(0, |last| last.end)..place.start];
        let head = before.trim_end();
        if head.is_empty() {
            continue;
        }
        if found.is_empty() || !arrow.is_ascii() || arrow.contains(' ') {
            found.push(place);
            continue;
        }
        // A further arrow stands behind a predecessor that is apart, and before a successor.
        let near = &head[head.floor_char_boundary(head.len().saturating_sub(LONGEST))..];
        let own = near.rsplit([' ', ',', ';', '(', '\t']).next().unwrap_or_default().trim_matches(QUOTES);
        let apart = near.len() > own.len() && (own.chars().count() == 1 || own.ends_with(')'));
        if apart && !text[place.end..].trim().is_empty() {
            found.push(place);
        }
    }
    found
}

/// The tokens of a text: parted by blanks outside of parentheses.
pub(super) fn tokens(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut start = None;
    let mut depth = 0_usize;
    let last = text.rfind(')').unwrap_or_default();
    for (at, ch) in text.char_indices() {
        match ch {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        // Parentheses that nothing closes join nothing.
        if ch.is_whitespace() && (depth == 0 || last < at) {
            if let Some(start) = start.take() {
                found.push(start..at);
            }
        } else if start.is_none() {
            start = Some(at);
        }
        if found.len() > 100_000 {
            break;
        }
    }
    if let Some(start) = start {
        found.push(start..text.len());
    }
    found
}

/// The predecessor at the end of a text, with its contexts and its condition, and a weight before the arrow.
pub(super) fn predecessor(before: &str) -> (Range<usize>, Option<f64>) {
    // `F (0.9) →`, `F .9→`, but not `x > .9 →`
    let text = before.trim_end();
    let ends = |head: &str| text.starts_with(head) && head.ends_with(|c: char| c.is_alphanumeric() || c == ')');
    let (text, mut weighted) = match weighted(text) {
        (head, Some(weight)) if ends(head) => (head, Some(weight)),
        _ => (text, None),
    };
    let end = text.len();
    let all = tokens(text);
    let Some(last) = all.last() else { return (end..end, weighted) };
    let mut start = last.start;
    let mut index = all.len() - 1;
    let own = |index: usize| &text[all[index].clone()];
    // Contexts in blanks: `B < A > C`.
    while index >= 2 && matches!(own(index - 1), "<" | ">") {
        index -= 2;
        start = all[index].start;
    }
    // A condition: `A(x) : x > 2`.
    if let Some(colon) = text.rfind(':') {
        let module = text[..colon].trim_end();
        let rest = text[colon + 1..].trim();
        let is_condition = module.ends_with(')') || rest == "*" || module.contains(['<', '>']);
        if is_condition && !rest.is_empty() {
            let (head, _) = predecessor(module);
            return (head.start..if rest == "*" { head.end } else { end }, weighted);
        }
    }
    // A weight before the predecessor: `0.3: F`.
    if index >= 1
        && own(index - 1).ends_with(':')
        && let Some(found) = weight(own(index - 1).trim_end_matches(':'))
    {
        weighted = Some(found);
    }
    let mut token = &text[start..end];
    // Behind a label, a bracket or a separator in the same token.
    for separator in [": ", ", ", "; "] {
        // Not inside the parentheses of a module.
        if let Some(at) = token.rfind(separator).filter(|at| !token[..*at].contains('(')) {
            start += at + separator.len();
            token = &text[start..end];
        }
    }
    if let Some(at) =
        token.rfind([',', ';', ':', '{']).filter(|at| *at + 1 < token.len() && !token.contains('(') && token.len() > 1)
    {
        let found = weight(&token[..at]).filter(|_| token[at..].starts_with(':'));
        weighted = weighted.or(found);
        start += at + 1;
        token = &text[start..end];
    }
    let has_context = token.contains(['<', '>']);
    let opened = token.starts_with('(') && token.len() > 1 && !token.ends_with(')');
    let trimmed = token.trim_start_matches(|c: char| {
        c == '(' && opened || "\"'`“‘•*".contains(c) && !(c == '*' && has_context) && token.chars().count() > 1
    });
    start += token.len() - trimmed.len();
    let trimmed =
        if trimmed.chars().count() > 1 { trimmed.trim_end_matches(['"', '\'', '`', '”', '’']) } else { trimmed };
    (start..start + trimmed.len(), weighted)
}

/// The successor at the start of a text, its end, and the words that stand in its place. An apostrophe is a quote only
/// where one stands around the predecessor, too.
pub(super) fn successor(after: &str, opened: bool, more: bool, quoted: bool) -> (String, usize, Option<String>) {
    let lead = after.len() - after.trim_start().len();
    let text = &after[lead..];
    for (open, close) in [('"', '"'), ('`', '`'), ('“', '”'), ('\'', '\'')] {
        if (quoted || open != '\'')
            && let Some(inside) = text.strip_prefix(open)
            && let Some(end) = inside.find(close)
        {
            let rest = &inside[end + close.len_utf8()..];
            // What stands behind the quotes may be a weight.
            let (_, weight) = weighted(rest.trim_start().split(", ").next().unwrap_or_default());
            let plain = weight.is_none() || rest.trim().is_empty();
            if plain {
                return (inside[..end].to_owned(), lead + open.len_utf8() + end + close.len_utf8(), None);
            }
        }
    }
    // In running text a rule ends at its bracket.
    let mut depth = 0_i32;
    let mut limit = text.len();
    for (at, ch) in text.char_indices() {
        depth += i32::from(ch == '(') - i32::from(ch == ')');
        if ch == ')' && depth < 0 && opened {
            limit = at;
            break;
        }
    }
    let text = &text[..limit];
    let all = tokens(text);
    let mut end = 0;
    for (index, token) in all.iter().enumerate() {
        let own = &text[token.clone()];
        let is_weight = || weight(own.trim_matches(['(', ')'])).is_some();
        let weight_follows =
            index > 0 && (matches!(own, "with" | "probability" | "prob." | "prob" | "weight") || is_weight());
        if (is_language(own.trim_start_matches('('), 3)
            || own.starts_with('(') && is_prose(own)
            || matches!(own, "and" | "is" | "where" | "for" | "in" | "to" | "or"))
            && !weight_follows
        {
            if index == 0 && !own.starts_with('(') {
                let words = text[..text.find(". ").unwrap_or(text.len())].to_owned();
                return (String::new(), lead + words.len(), Some(words));
            }
            break;
        }
        end = token.end;
        let separated = own.ends_with([',', ';']) && own.chars().count() > 1 && index + 1 < all.len();
        let stops = own.ends_with('.') && own.len() > 1;
        let next_is_weight =
            all.get(index + 1).is_some_and(|next| weight(&text[next.clone()]).is_some() && index + 2 == all.len());
        if separated && !next_is_weight || stops && (more || index + 1 < all.len()) {
            break;
        }
    }
    let word = text[..end].trim_end();
    // A brace that only closes: `P = {F → FF}`.
    let word = if word.contains('{') { word } else { word.trim_end_matches(['}', ' ']) };
    let cut = word.trim_end_matches([',', ';', '.']);
    let word = if cut.is_empty() {
        word
    } else if word.ends_with(['.']) || more || end < text.trim_end().len() {
        cut
    } else {
        word.trim_end_matches('.')
    };
    (word.to_owned(), lead + end, None)
}

pub(super) type Weak = (String, String);

/// A rule whose sign is weak: one symbol, `=`, `:` or `>`, and a word.
pub(super) fn weak(text: &str) -> Option<Weak> {
    let text = text.trim();
    let bare = text.trim_start_matches(['"', '\'', '`']);
    let mut chars = bare.chars();
    let from = chars.next()?;
    if from.is_whitespace() || matches!(from, '=' | '<' | '(' | '#') {
        return None;
    }
    // A module with parameters: `A(x) = ..`.
    let mut head = from.to_string();
    let mut rest = chars.as_str();
    if rest.starts_with('(')
        && let Some(close) = rest.find(')')
    {
        head.push_str(&rest[..=close]);
        rest = &rest[close + 1..];
    }
    let rest = rest.trim_start_matches(['"', '\'', '`']).trim_start();
    let to = ["=", ":", ">"].iter().find_map(|sign| rest.strip_prefix(sign))?;
    // A call is no word: `t = Turtle()`.
    if to.starts_with(['=', '>']) || to.contains("()") {
        return None;
    }
    let to = to.trim().trim_end_matches(',').trim_matches(['"', '\'', '`', '“', '”']);
    Some((head, to.to_owned()))
}

/// A number of a constant.
pub(super) fn constant(text: &str) -> Option<String> {
    let text = text.trim().trim_end_matches([';', ',']);
    decimal::read(text).filter(|number| number.is_finite()).map(|_| text.to_owned())
}

/// Whether a line is a title: words without an arrow and without a label.
pub(super) fn is_title(line: &str) -> bool {
    // `variables : F G` is none.
    if line.split_once(':').is_some_and(|(_, rest)| !rest.trim().is_empty() && !is_prose(rest)) {
        return false;
    }
    line.chars().filter(|ch| ch.is_alphabetic()).count() > 3
        && line.len() < 100
        && !line.contains(['→', '=', '{', ',', '>'])
        && !line.contains("->")
        && !line.trim_end().ends_with('.')
        && is_prose(line)
}

pub(super) fn squeezed(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).collect()
}
