//! The places of commas, comments and line ends around the elements of a JSON list or object.

use super::diff::{Fate, Plan};
use core::ops::Range;
use jsonc_parser::common::Ranged;
use jsonc_parser::tokens::{Token, TokenAndRange};

/// New text for a part of the text.
pub(super) type Edit = (Range<usize>, String);

/// A JSON text and its tokens, comments among them.
pub(super) struct Layout<'a> {
    pub(super) text: &'a str,
    pub(super) tokens: &'a [TokenAndRange<'a>],
    /// Whether there is no blank between a key's colon and its value.
    pub(super) is_tight: bool,
}

/// What ends a line; JSON's comments end there, too.
pub(super) const LINE_ENDS: [char; 2] = ['\r', '\n'];

impl Layout<'_> {
    /// The edits that carry out a plan for the elements of a list or object.
    pub(super) fn edits(&self, outer: &impl Ranged, elements: &[impl Ranged], plan: Plan) -> Vec<Edit> {
        let mut edits = Vec::new();
        let elements: Vec<_> = elements.iter().map(place).collect();
        let stays = |at: &usize| !matches!(plan.slots[*at].fate, Fate::Goes);
        let last = (0..elements.len()).rev().find(stays);
        let trailing = elements.last().is_some_and(|last| self.comma(last.end).is_some());
        let all_new = || plan.first.iter().chain(plan.slots.iter().flat_map(|slot| &slot.after));
        let is_empty = last.is_none() && all_new().next().is_some();
        if is_empty {
            let new: Vec<&str> = all_new().map(String::as_str).collect();
            edits.push((outer.start() + 1..outer.start() + 1, new.join(", ")));
        } else if let Some(start) = elements.first().map(|first| first.start).filter(|_| !plan.first.is_empty()) {
            let gap = self.gap(start);
            edits.push((start..start, plan.first.iter().map(|new| format!("{new},{gap}")).collect()));
        }
        // Elements that go one after the other.
        let mut run: Option<Range<usize>> = None;
        for (at, (element, slot)) in elements.iter().zip(plan.slots).enumerate() {
            let is_next = |run: &Range<usize>| self.text[run.end..element.start].trim() == ",";
            match slot.fate {
                Fate::Goes if run.as_ref().is_some_and(is_next) => {
                    run = run.map(|run| run.start..element.end);
                    continue;
                }
                Fate::Goes => {
                    edits.extend(run.replace(element.clone()).iter().flat_map(|run| self.removed(run)));
                    continue;
                }
                Fate::Stays => {}
                Fate::Becomes(text) => edits.push((element.clone(), text)),
                Fate::Changes(changes) => edits.extend(changes),
            }
            let is_last = last == Some(at);
            if !slot.after.is_empty() {
                self.insert(element, &slot.after, !is_last || trailing, &mut edits);
            } else if let Some(comma) = self.comma(element.end).filter(|_| is_last && !trailing) {
                edits.push((comma..comma + 1, String::new()));
            }
            edits.extend(run.take().iter().flat_map(|run| self.removed(run)));
        }
        edits.extend(run.iter().flat_map(|run| self.removed(run)));
        edits
    }

    /// Inserts new elements after an element that stays.
    fn insert(&self, element: &Range<usize>, new: &[String], ends_with_comma: bool, edits: &mut Vec<Edit>) {
        let gap = self.gap(element.start);
        let mut text = new.iter().map(|new| format!("{gap}{new}")).collect::<Vec<_>>().join(",");
        if ends_with_comma {
            text.push(',');
        }
        let comma = self.comma(element.end);
        let end = comma.map_or(element.end, |comma| comma + 1);
        // A comment at the end of a line belongs to the element on that line.
        let place = if gap.contains(LINE_ENDS) { self.end_of_comments(end) } else { end };
        if comma.is_some() {
            edits.push((place..place, text));
        } else if place == end {
            edits.push((end..end, format!(",{text}")));
        } else {
            edits.extend([(end..end, ",".to_owned()), (place..place, text)]);
        }
    }

    /// The edits that remove an element with the comma behind it: the whole line if there is nothing else.
    fn removed(&self, element: &Range<usize>) -> Vec<Edit> {
        let comma = self.comma(element.end);
        let start = element.start - blank_before(self.text, element.start);
        let begins_line = self.text[..start].ends_with(LINE_ENDS);
        let is_near = |&comma: &usize| blank_after(self.text, element.end) == comma - element.end;
        let near_end = comma.filter(is_near).map_or(element.end, |comma| comma + 1);
        let end = near_end + blank_after(self.text, near_end);
        let line_end = ["\r\n", "\n", "\r"].iter().find(|end_of_line| self.text[end..].starts_with(**end_of_line));
        let range = match line_end {
            Some(line_end) if begins_line => start..end + line_end.len(),
            _ if self.text[end..].starts_with([']', '}']) => start..near_end,
            _ => element.start..end,
        };
        let far_comma = comma.filter(|comma| *comma >= near_end).map(|comma| (comma..comma + 1, String::new()));
        [(range, String::new())].into_iter().chain(far_comma).collect()
    }

    /// The place of the comma after an element that ends here.
    fn comma(&self, end: usize) -> Option<usize> {
        let next = self.tokens.partition_point(|token| token.start() < end);
        let next = self.tokens[next..].iter().find(|token| !is_comment(&token.token))?;
        (next.token == Token::Comma).then(|| next.start())
    }

    /// The end of the comments that stand on the same line after `end`, with nothing else after them; otherwise `end`.
    fn end_of_comments(&self, end: usize) -> usize {
        let next = self.tokens.partition_point(|token| token.start() < end);
        let mut place = end;
        for token in &self.tokens[next..] {
            let is_blank = self.text[place..token.start()].bytes().all(|byte| matches!(byte, b' ' | b'\t'));
            if !is_blank {
                break;
            }
            if !is_comment(&token.token) || self.text[token.start()..token.end()].contains(LINE_ENDS) {
                return end;
            }
            place = token.end();
        }
        let rest = &self.text[place + blank_after(self.text, place)..];
        if rest.is_empty() || rest.starts_with(LINE_ENDS) { place } else { end }
    }

    /// What stands between the element that starts here and the one before it: a line end with the indentation, or
    /// blanks.
    pub(super) fn gap(&self, start: usize) -> String {
        let blank = blank_before(self.text, start);
        let indent = &self.text[start - blank..start];
        let before = &self.text[..start - blank];
        match ["\r\n", "\n", "\r"].into_iter().find(|line_end| before.ends_with(line_end)) {
            Some(line_end) => format!("{line_end}{indent}"),
            None if before.ends_with(',') => indent.to_owned(),
            None if self.is_tight => String::new(),
            None => " ".to_owned(),
        }
    }
}

/// The place of a part of the text.
pub(super) fn place(part: &impl Ranged) -> Range<usize> {
    part.start()..part.end()
}

pub(super) fn is_comment(token: &Token<'_>) -> bool {
    matches!(token, Token::CommentLine(_) | Token::CommentBlock(_))
}

/// The number of blanks before a place.
fn blank_before(text: &str, place: usize) -> usize {
    text[..place].len() - text[..place].trim_end_matches([' ', '\t']).len()
}

/// The number of blanks from a place on.
fn blank_after(text: &str, place: usize) -> usize {
    text[place..].len() - text[place..].trim_start_matches([' ', '\t']).len()
}
