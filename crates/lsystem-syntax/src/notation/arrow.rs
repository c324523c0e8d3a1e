//! Finding the arrow of a production.

use super::token::Token;
use core::ops::Range;

/// The number of tokens of the arrow at the start of `tokens`: `->`, `-->`, `=>` or `→`; `None` if there is none.
pub(crate) fn length(tokens: &[Token]) -> Option<usize> {
    let is = |at: usize, ch: char| tokens.get(at).is_some_and(|t: &Token| t.is(ch) && (at == 0 || t.joined));
    if is(0, '→') {
        Some(1)
    } else if (is(0, '-') || is(0, '=')) && is(1, '>') {
        Some(2)
    } else if is(0, '-') && is(1, '-') && is(2, '>') {
        Some(3)
    } else {
        None
    }
}

/// The first arrow outside parentheses, or the first arrow if all are inside, as a range of tokens.
pub(crate) fn find(tokens: &[Token]) -> Option<Range<usize>> {
    let mut depth = 0_usize;
    let mut inside = None;
    for (at, token) in tokens.iter().enumerate() {
        if token.is('(') {
            depth += 1;
        } else if token.is(')') {
            depth = depth.saturating_sub(1);
        } else if let Some(length) = length(&tokens[at..]) {
            if depth == 0 {
                return Some(at..at + length);
            }
            inside = inside.or(Some(at..at + length));
        }
    }
    inside
}
