//! A text that was taken out of another one, with the place of every byte in it.

use crate::account::Mark;
use crate::source::Lines;
use crate::{Entry, Found};
use core::ops::Range;

/// A text in which every byte has its place in the text around it, in order.
#[derive(Debug, Default)]
pub(crate) struct Mapped {
    pub(crate) text: String,
    places: Vec<usize>,
}

impl Mapped {
    /// Adds characters that stand for what begins at a place.
    pub(crate) fn push(&mut self, at: usize, text: &str) {
        self.text.push_str(text);
        self.places.extend(core::iter::repeat_n(at, text.len()));
    }

    /// Adds a part of the text around as it is.
    pub(crate) fn copy(&mut self, around: &str, part: Range<usize>) {
        self.text.push_str(&around[part.clone()]);
        self.places.extend(part);
    }

    /// Adds another text in one line.
    pub(crate) fn append_line(&mut self, other: &Self) {
        for (at, ch) in other.text.char_indices() {
            let mut buffer = [0; 4];
            let sign: &str = if ch == '\n' { " " } else { ch.encode_utf8(&mut buffer) };
            self.push(other.place(at), sign);
        }
    }

    /// Ends the text; `end` is the place behind its last byte.
    pub(crate) fn end(mut self, end: usize) -> Self {
        self.places.push(end);
        self
    }

    /// The place of a byte, or of the end.
    pub(crate) fn place(&self, at: usize) -> usize {
        self.places.get(at).or(self.places.last()).copied().unwrap_or_default()
    }

    /// The place of a range. It ends where the next character begins: of one character, it is the whole sign.
    pub(crate) fn span(&self, range: &Range<usize>) -> Range<usize> {
        let start = self.place(range.start);
        start..if range.is_empty() { start } else { self.place(range.end).max(start) }
    }

    /// The byte at a place of the text around.
    pub(crate) fn at(&self, place: usize) -> usize {
        self.places.partition_point(|own| *own < place).min(self.text.len())
    }

    /// Moves what was found in this text to its places in the text around.
    pub(crate) fn moved(&self, found: Found, around: &Lines) -> Found {
        let lines = Lines::new(&self.text);
        let remark = |mut remark: crate::Remark| {
            let at = if remark.span.is_empty() { lines.start(remark.line) } else { remark.span.start };
            (remark.line, remark.span) = (around.of(self.place(at)), self.span(&remark.span));
            remark
        };
        let entry = |entry: Entry| Entry { remarks: entry.remarks.into_iter().map(remark).collect(), ..entry };
        let mark = |(at, mark): (usize, Mark)| (at, Mark { span: self.span(&mark.span), ..mark });
        let (entries, marks) = (found.entries.into_iter().map(entry), found.marks.into_iter().map(mark));
        Found { notation: found.notation, entries: entries.collect(), marks: marks.collect() }
    }
}
