//! Words: axioms and successors.

use super::arrow;
use super::token::{Token, span_of};
use crate::notes::Notes;
use crate::{Feature, Kind, Module};
use core::ops::Range;

/// The modules of a word and where each stands.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Word {
    pub(crate) modules: Vec<Module>,
    pub(crate) spans: Vec<Range<usize>>,
}

/// Reads a word. `*` or `ε` alone is the empty word; an arrow that stands apart is noted as `stray_arrow`.
pub(crate) fn word(tokens: &[Token], stray_arrow: &Kind, notes: &mut Notes) -> Word {
    let mut word = Word::default();
    if let [only] = tokens
        && (only.is('*') || only.is('ε'))
    {
        return word;
    }
    if let Some(arrow) = stray(tokens) {
        notes.add(stray_arrow.clone(), arrow);
    }
    let mut told = false;
    let mut at = 0;
    while let Some(&token) = tokens.get(at) {
        at += 1;
        if token.is('(') && token.joined {
            let Some(end) = closing(&tokens[at - 1..]) else {
                notes.add(Kind::ParenthesisUnclosed, token.span());
                return word;
            };
            at += end;
            if !told {
                let from = at.saturating_sub(end + 2);
                notes.add(Kind::NotYet(Feature::Parameters), span_of(&tokens[from..at], 0));
                told = true;
            }
            continue;
        }
        if token.is('(') || token.is(')') {
            notes.add(Kind::ParenthesisSymbol { symbol: token.ch }, token.span());
        }
        word.modules.push(Module::from(token.ch));
        word.spans.push(token.span());
    }
    word
}

/// The distance from the parenthesis that opens `tokens` to the one that closes it.
pub(crate) fn closing(tokens: &[Token]) -> Option<usize> {
    let mut depth = 0_usize;
    tokens.iter().position(|t| {
        depth += usize::from(t.is('('));
        depth -= usize::from(t.is(')'));
        depth == 0
    })
}

/// An arrow with white space on both sides, or one that is no plain characters: nobody means symbols by it.
fn stray(tokens: &[Token]) -> Option<Range<usize>> {
    let mut at = 0;
    while at < tokens.len() {
        let Some(length) = arrow::length(&tokens[at..]) else {
            at += 1;
            continue;
        };
        let apart = !tokens[at].joined && at > 0 && tokens.get(at + length).is_some_and(|t| !t.joined);
        if apart || tokens[at].is('→') {
            return Some(span_of(&tokens[at..at + length], 0));
        }
        at += length;
    }
    None
}
