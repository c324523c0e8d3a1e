//! Places in a text by line.

/// The number of the line, from 1, in which byte `at` of a text stands.
pub(crate) fn line_of(text: &str, at: usize) -> usize {
    text.as_bytes()[..at.min(text.len())].iter().filter(|&&byte| byte == b'\n').count() + 1
}
