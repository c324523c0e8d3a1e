//! The account of a text: what became of every byte of it.

use core::ops::Range;
use lsystem_base::sorted;

/// A part of a text, and what became of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The bytes of the text.
    pub span: Range<usize>,
    /// What became of them.
    pub fate: Fate,
    /// The system that the part belongs to, an index of the entries; `None` outside of all systems.
    pub entry: Option<usize>,
    /// For parts that are read, what they became, such as `F -> FF` or `angle 60`; for noted and refused parts the reason.
    pub words: String,
}

/// What became of a part of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fate {
    /// Outside of any system, or without a meaning inside one: prose, markup, comments, white space.
    Passed,
    /// Read into the definition.
    Read,
    /// Understood as a part of the system, but not carried over.
    Noted,
    /// The system is refused because of it.
    Refused,
}

/// A statement of a reader about a place.
#[derive(Clone, Debug)]
pub(crate) struct Mark {
    pub(crate) span: Range<usize>,
    pub(crate) fate: Fate,
    pub(crate) words: String,
}

/// The account of a text of `length` bytes: parts that cover it in order, without gaps and overlaps. Of marks that
/// overlap, the one that begins last counts; of those, the shortest; of those, the graver one.
pub(crate) fn account(length: usize, marks: Vec<(usize, Mark)>) -> Vec<Part> {
    let mut marks: Vec<(usize, Mark)> =
        marks.into_iter().filter(|(_, mark)| !mark.span.is_empty() && mark.span.end <= length).collect();
    sorted::sort_by(&mut marks, |(_, a), (_, b)| {
        (a.span.start, b.span.end, a.fate).cmp(&(b.span.start, a.span.end, b.fate))
    });
    let mut parts: Vec<Part> = Vec::new();
    // The marks that are open, the innermost last.
    let mut open: Vec<usize> = Vec::new();
    let mut at = 0;
    let put = |parts: &mut Vec<Part>, span: Range<usize>, of: Option<usize>| {
        if span.is_empty() {
            return;
        }
        let mut part = match of.and_then(|of| marks.get(of)) {
            Some((entry, mark)) => {
                Part { span: span.clone(), fate: mark.fate, entry: Some(*entry), words: mark.words.clone() }
            }
            None => Part { span: span.clone(), fate: Fate::Passed, entry: None, words: String::new() },
        };
        match parts.last_mut() {
            Some(last) if (last.fate, last.entry, &last.words) == (part.fate, part.entry, &part.words) => {
                last.span.end = span.end;
            }
            _ => {
                part.span = span;
                parts.push(part);
            }
        }
    };
    for index in 0..marks.len() {
        let start = marks[index].1.span.start;
        // Marks that end before this one begins.
        while let Some(&top) = open.last() {
            let end = marks[top].1.span.end;
            if end > start {
                break;
            }
            put(&mut parts, at..end.max(at), Some(top));
            at = at.max(end);
            open.pop();
        }
        put(&mut parts, at..start.max(at), open.last().copied());
        at = at.max(start);
        open.push(index);
    }
    while let Some(top) = open.pop() {
        let end = marks[top].1.span.end;
        put(&mut parts, at..end.max(at), Some(top));
        at = at.max(end);
    }
    put(&mut parts, at..length, None);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_the_text_without_overlap() {
        let mark = |span: Range<usize>, fate: Fate, words: &str| (0, Mark { span, fate, words: words.to_owned() });
        let marks = vec![
            mark(2..10, Fate::Noted, "a"),
            mark(4..6, Fate::Read, "b"),
            mark(5..8, Fate::Read, "c"),
            mark(12..14, Fate::Refused, "d"),
            mark(12..14, Fate::Read, "e"),
            mark(20..30, Fate::Read, "beyond the text"),
        ];
        let parts: Vec<(Range<usize>, String)> =
            account(16, marks).into_iter().map(|part| (part.span, part.words)).collect();
        let expected: Vec<(Range<usize>, &str)> = vec![
            (0..2, ""),
            (2..4, "a"),
            (4..5, "b"),
            (5..8, "c"),
            (8..10, "a"),
            (10..12, ""),
            (12..14, "d"),
            (14..16, ""),
        ];
        assert_eq!(parts, expected.into_iter().map(|(span, words)| (span, words.to_owned())).collect::<Vec<_>>());
        assert_eq!(account(0, Vec::new()), []);
    }
}
