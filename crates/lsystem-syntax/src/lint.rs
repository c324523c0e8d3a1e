//! Warnings about texts that can be read, but hardly mean what they say: brackets without partners, productions that
//! never apply, and signs of other notations.

use crate::notation::{Places, Reading};
use crate::notes::Notes;
use crate::{Action, Diagnostic, Field, Kind, Module, Production};
use core::ops::Range;
use lsystem_base::decimal;
use lsystem_base::sorted::set;

/// The warnings about texts without errors. `occurring` are the symbols that may occur in some generation, with their
/// numbers of parameters, sorted; `actions` are those of a symbol.
pub fn warnings<'a>(
    reading: &Reading,
    occurring: &[(char, usize)],
    actions: impl Fn(char) -> &'a [Action],
) -> Vec<Diagnostic> {
    let Reading { grammar, .. } = reading;
    let mut axiom_notes = Notes::new(Field::Axiom);
    let mut notes = Notes::new(Field::Rules);

    if grammar.axiom.is_empty() {
        axiom_notes.add(Kind::EmptyAxiom, 0..0);
    } else {
        note_idle(reading, occurring, &mut notes);
        note_arities(reading, &mut axiom_notes, &mut notes);
    }

    let mut words = vec![(&grammar.axiom, &reading.axiom)];
    for (production, places) in productions(reading) {
        words.push((&production.successor, &places.successor));
    }
    // The number of the word, and the index in it.
    let mut opened: Vec<(usize, usize)> = Vec::new();
    let mut closed: Vec<(usize, usize)> = Vec::new();
    let idle = |symbol: char| actions(symbol).is_empty() && !has_production(reading, symbol);
    let arrow_is_idle = idle('>');
    for (number, (word, spans)) in words.iter().enumerate() {
        note_foreign(word, spans, idle, if number == 0 { &mut axiom_notes } else { &mut notes });
        let outside = opened.len();
        for (at, module) in word.iter().enumerate() {
            for action in actions(module.symbol) {
                match action {
                    Action::Push => opened.push((number, at)),
                    Action::Pop if opened.len() == outside => closed.push((number, at)),
                    Action::Pop => opened.truncate(opened.len() - 1),
                    _ => {}
                }
            }
            if is_arrow(word, spans, at) && (follows_separator(word, at) || arrow_is_idle) {
                let notes = if number == 0 { &mut axiom_notes } else { &mut notes };
                notes.add(Kind::ArrowOfSymbols, spans[at].start..spans[at + 1].end);
            }
        }
    }
    let is_open = closed.is_empty();
    // One word may close a branch that another leaves open, so no single bracket is to blame.
    let lone = match opened.is_empty() {
        true => closed,
        false if is_open => opened,
        false => Vec::new(),
    };
    let mut rest = &lone[..];
    while let Some(&(number, first)) = rest.first() {
        let (word, spans) = words[number];
        let symbol = word[first].symbol;
        // One note covers adjacent unmatched brackets.
        let same = |at: usize| rest.get(at) == Some(&(number, first + at)) && word[first + at].symbol == symbol;
        let mut count = 1;
        while same(count) {
            count += 1;
        }
        rest = &rest[count..];
        let kind = if is_open { Kind::UnmatchedOpen { symbol } } else { Kind::UnmatchedClose { symbol } };
        let notes = if number == 0 { &mut axiom_notes } else { &mut notes };
        notes.add(kind, spans[first].start..spans[first + count - 1].end);
    }
    let mut all = axiom_notes.finish();
    all.extend(notes.finish());
    all
}

/// Notes symbols that mean something else in other notations: digits behind a turn or another mark, and `@` with another
/// character.
fn note_foreign(word: &[Module], spans: &[Range<usize>], idle: impl Fn(char) -> bool, notes: &mut Notes) {
    let mut at = 0;
    while let Some(module) = word.get(at) {
        let first = at + 1;
        at = first;
        let marks = matches!(module.symbol, '+' | '-' | '\\' | '/' | '&' | '^' | '|' | '@' | '~' | '?' | '<' | '>');
        let plain = |i: usize| {
            spans[i].start == spans[i - 1].end && spans[i].len() == word[i].symbol.len_utf8() && idle(word[i].symbol)
        };
        if !marks || !module.arguments.is_empty() {
            continue;
        }
        let digit = |i: usize| plain(i) && matches!(word[i].symbol, '0'..='9' | '.');
        let digits: String = (first..word.len()).take_while(|&i| digit(i)).map(|i| word[i].symbol).collect();
        if decimal::read(&digits).is_some() {
            at += digits.len();
            let kind = Kind::DigitsBehind { symbol: module.symbol, digits };
            notes.add(kind, spans[first].start..spans[at - 1].end);
        } else if module.symbol == '@'
            && spans[first - 1].len() == 1
            && idle('@')
            && let Some(second) = word.get(first)
            && spans[first].start == spans[first - 1].end
            && second.symbol.is_ascii_alphanumeric()
        {
            notes.add(Kind::TwoCharacters { second: second.symbol }, spans[first - 1].start..spans[first].end);
        }
    }
}

/// Productions and images, with their places in the text.
fn productions(reading: &Reading) -> impl Iterator<Item = (&Production, &Places)> {
    let Reading { grammar, productions, images, .. } = reading;
    grammar.productions.iter().zip(productions).chain(grammar.images.iter().zip(images))
}

/// Whether plain characters at `at` look like the arrow `->` or `=>`.
fn is_arrow(word: &[Module], spans: &[Range<usize>], at: usize) -> bool {
    matches!(word[at].symbol, '-' | '=')
        && word.get(at + 1).is_some_and(|next| next.symbol == '>')
        && spans[at].len() == 1
        && spans[at].end == spans[at + 1].start
}

/// Whether `,` or `;` and one symbol stand before the arrow at `at`: other notations separate productions so.
fn follows_separator(word: &[Module], at: usize) -> bool {
    at >= 2 && matches!(word[at - 2].symbol, ',' | ';')
}

fn has_production(reading: &Reading, symbol: char) -> bool {
    productions(reading).any(|(production, _)| production.predecessor.symbol == symbol)
}

/// The most letters that get a note of their own.
const MOST_TOLD: usize = 100;

/// Notes modules whose symbol has productions only for another number of parameters.
fn note_arities(reading: &Reading, axiom_notes: &mut Notes, notes: &mut Notes) {
    let Reading { grammar, axiom, productions, .. } = reading;
    let rules = set(grammar.productions.iter().map(|p| (p.predecessor.symbol, p.predecessor.parameters.len())));
    let made = grammar.productions.iter().zip(productions);
    let made = made.flat_map(|(p, places)| p.successor.iter().zip(&places.successor));
    let words = grammar.axiom.iter().zip(axiom).map(|m| (true, m)).chain(made.map(|m| (false, m)));
    let mut told: Vec<(char, usize)> = Vec::new();
    for (is_axiom, (module, span)) in words {
        let (symbol, parameters) = (module.symbol, module.arguments.len());
        let from = rules.partition_point(|rule| *rule < (symbol, 0));
        if let Some(&(_, found)) = rules.get(from).filter(|rule| rule.0 == symbol)
            && rules.binary_search(&(symbol, parameters)).is_err()
            && !told.contains(&(symbol, parameters))
            && told.len() < MOST_TOLD
        {
            told.push((symbol, parameters));
            let notes = if is_axiom { &mut *axiom_notes } else { &mut *notes };
            notes.add(Kind::NoRuleForArity { symbol, parameters, found }, span.clone());
        }
    }
}

/// Notes productions that never apply, because a symbol of their predecessor or contexts never occurs.
fn note_idle(reading: &Reading, occurring: &[(char, usize)], notes: &mut Notes) {
    let seen = reading.grammar.seen.ready();
    for (production, places) in productions(reading) {
        let spans = places.left.iter().chain([&places.predecessor]).chain(&places.right);
        for (at, (pattern, span)) in production.patterns().zip(spans).enumerate() {
            let (symbol, parameters) = (pattern.symbol, pattern.parameters.len());
            let context = at != production.left.len();
            let bracket = context && matches!(symbol, '[' | ']');
            let from = occurring.partition_point(|letter| *letter < (symbol, 0));
            let found = || occurring.get(from).filter(|letter| letter.0 == symbol);
            let kind = if context && !bracket && !seen.contains(symbol) {
                Kind::ContextUnseen { symbol }
            } else if bracket || occurring.binary_search(&(symbol, parameters)).is_ok() {
                continue;
            } else if let Some(&(_, found)) = found() {
                Kind::OtherArity { symbol, parameters, found }
            } else {
                Kind::NeverOccurs { symbol }
            };
            notes.add(kind, span.clone());
            break;
        }
    }
}
