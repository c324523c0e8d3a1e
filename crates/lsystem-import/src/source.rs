//! A text as it was given, and the places of its parts.

use core::ops::Range;

/// A text that is read. It is never changed before, so every part of it is a slice with a place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Source<'a> {
    pub(crate) text: &'a str,
    lines: &'a Lines,
}

impl<'a> Source<'a> {
    /// `lines` are those of `text`.
    pub(crate) fn new(text: &'a str, lines: &'a Lines) -> Self {
        Self { text, lines }
    }

    /// The place of a slice of the text; `None` for any other text.
    pub(crate) fn place(&self, part: &str) -> Option<Range<usize>> {
        let start = part.as_ptr().addr().checked_sub(self.text.as_ptr().addr())?;
        let end = start + part.len();
        (end <= self.text.len()).then_some(start..end)
    }

    /// The line of a byte, from 1.
    pub(crate) fn line_of(&self, at: usize) -> usize {
        self.lines.of(at)
    }

    /// The place of a part of a line: of `part` itself if it is a slice of the text, else of the first equal text in the
    /// line, else of the whole line without white space around it.
    pub(crate) fn place_in_line(&self, line: usize, part: &str) -> Range<usize> {
        if let Some(place) = self.place(part).filter(|place| !place.is_empty()) {
            return place;
        }
        let whole = self.lines.range(line, self.text.len());
        let text = self.text.get(whole.clone()).unwrap_or_default();
        let (from, length) = match text.find(part.trim()) {
            Some(at) if !part.trim().is_empty() => (at, part.trim().len()),
            _ => (text.len() - text.trim_start().len(), text.trim().len()),
        };
        whole.start + from..whole.start + from + length
    }
}

/// The places of a text's line ends, to find lines fast. A line ends with `\n`, `\r\n` or `\r`.
#[derive(Debug)]
pub(crate) struct Lines(Vec<usize>);

impl Lines {
    pub(crate) fn new(text: &str) -> Self {
        let bytes = text.as_bytes();
        let ends = |at: &usize| bytes[*at] == b'\n' || (bytes[*at] == b'\r' && bytes.get(at + 1) != Some(&b'\n'));
        Self((0..bytes.len()).filter(ends).collect())
    }

    /// The line of a place in the text, from 1.
    pub(crate) fn of(&self, at: usize) -> usize {
        self.0.partition_point(|end| *end < at) + 1
    }

    /// The first byte of a line, from 1.
    pub(crate) fn start(&self, line: usize) -> usize {
        line.checked_sub(2).and_then(|before| self.0.get(before)).map_or(0, |end| end + 1)
    }

    /// The bytes of a line, from 1, in a text of `length` bytes; empty at the end for a line that the text does not have.
    fn range(&self, line: usize, length: usize) -> Range<usize> {
        let start = match line.checked_sub(2) {
            None => 0,
            Some(before) => self.0.get(before).map_or(length, |end| end + 1),
        };
        let end = self.0.get(line.max(1) - 1).copied().unwrap_or(length);
        start..end.max(start)
    }
}
