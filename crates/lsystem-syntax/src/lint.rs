//! Warnings about texts that can be read, but hardly mean what they say: brackets without partners, productions that
//! never apply, and signs of other notations.

use crate::notation::{Places, Reading};
use crate::notes::{DiagnosticList, named};
use crate::{Action, Diagnostic, Field, Module, Production};
use core::ops::Range;
use lsystem_base::sorted::set;
use lsystem_base::words::said;
use lsystem_base::{counted, decimal, say, word};

/// The warnings about texts without errors. `occurring` are the symbols that may occur in some generation, with their
/// numbers of parameters, sorted; `actions` are those of a symbol.
pub fn warnings<'a>(
    reading: &Reading,
    occurring: &[(char, usize)],
    actions: impl Fn(char) -> &'a [Action],
) -> Vec<Diagnostic> {
    let Reading { grammar, .. } = reading;
    let mut axiom_notes = DiagnosticList::new(Field::Axiom);
    let mut notes = DiagnosticList::new(Field::Rules);

    if grammar.axiom.is_empty() {
        axiom_notes.warn(
            0..0,
            say!("The axiom is empty, so there is nothing to derive"),
            say!("Write the symbols to start from, as in `F`."),
        );
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
                let message = say!("This arrow is read as two symbols");
                notes.warn(spans[at].start..spans[at + 1].end, message, say!("Write each rule on a line of its own."));
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
        let warning = if is_open {
            Diagnostic::warning(say!("This {} is never closed", named(symbol)))
                .hint(say!("Close the branch where it ends."))
        } else {
            Diagnostic::warning(say!("This {} closes no branch and is ignored in the drawing", named(symbol)))
                .hint(say!("Remove it, or open the branch before it."))
        };
        let notes = if number == 0 { &mut axiom_notes } else { &mut notes };
        notes.add(spans[first].start..spans[first + count - 1].end, warning.fix(String::new()));
    }
    let mut all = axiom_notes.finish();
    all.extend(notes.finish());
    all
}

/// The hint for marks without a meaning.
const CUSTOM: &str = word!("A custom symbol of one character can mean this, as in `K: turn left 90, draw 5`.");

/// Notes symbols that mean something else in other notations: digits behind a turn or another mark, and `@` with another
/// character.
fn note_foreign(word: &[Module], spans: &[Range<usize>], idle: impl Fn(char) -> bool, notes: &mut DiagnosticList) {
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
            let span = spans[first].start..spans[at - 1].end;
            let warning = Diagnostic::warning(say!("The digits after {} are read as symbols", named(module.symbol)));
            let warning = match module.symbol {
                '@' | '~' | '?' => warning.hint(said(CUSTOM)),
                symbol => warning
                    .hint(say!("A number stands in parentheses, as in `{}({})`.", symbol, digits))
                    .fix(format!("({digits})")),
            };
            notes.add(span, warning);
        } else if module.symbol == '@'
            && spans[first - 1].len() == 1
            && idle('@')
            && let Some(second) = word.get(first)
            && spans[first].start == spans[first - 1].end
            && second.symbol.is_ascii_alphanumeric()
        {
            let span = spans[first - 1].start..spans[first].end;
            notes.warn(span, say!("`@{}` is read as two symbols", second.symbol), said(CUSTOM));
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
const MAX_TOLD: usize = 100;

/// Notes modules whose symbol has productions only for another number of parameters.
fn note_arities(reading: &Reading, axiom_notes: &mut DiagnosticList, notes: &mut DiagnosticList) {
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
            && told.len() < MAX_TOLD
        {
            told.push((symbol, parameters));
            let notes = if is_axiom { &mut *axiom_notes } else { &mut *notes };
            let hint = match parameters {
                2 => say!("Write decimals with a point, as in A(0.5); a comma separates arguments."),
                _ => say!("A symbol with another number of parameters is another letter."),
            };
            let message = say!("No rule applies to this: those for {} have {}", named(symbol), or_none(found));
            notes.warn(span.clone(), message, hint);
        }
    }
}

fn or_none(parameters: usize) -> String {
    if parameters == 0 { say!("no parameters") } else { counted_parameters(parameters) }
}

fn counted_parameters(count: usize) -> String {
    counted!(count, "{} parameter", "{} parameters")
}

/// Notes productions that never apply, because a symbol of their predecessor or contexts never occurs.
fn note_idle(reading: &Reading, occurring: &[(char, usize)], notes: &mut DiagnosticList) {
    let seen = reading.grammar.seen.ready();
    for (production, places) in productions(reading) {
        let spans = places.left.iter().chain([&places.predecessor]).chain(&places.right);
        for (at, (pattern, span)) in production.patterns().zip(spans).enumerate() {
            let (symbol, parameters) = (pattern.symbol, pattern.parameters.len());
            let context = at != production.left.len();
            let bracket = context && matches!(symbol, '[' | ']');
            let from = occurring.partition_point(|letter| *letter < (symbol, 0));
            let found = || occurring.get(from).filter(|letter| letter.0 == symbol);
            let (message, hint) = if context && !bracket && !seen.contains(symbol) {
                (
                    say!("Contexts do not see {}, so this rule never applies", named(symbol)),
                    say!("Take it out of the context, or change `ignore:` or `consider:`."),
                )
            } else if bracket || occurring.binary_search(&(symbol, parameters)).is_ok() {
                continue;
            } else if let Some(&(_, found)) = found() {
                (
                    say!("This rule never applies: {} occurs with {} only", named(symbol), or_none(found)),
                    say!(
                        "A symbol with {} is another letter: give it as many everywhere.",
                        counted_parameters(parameters)
                    ),
                )
            } else {
                (
                    say!("{} never occurs, so this rule never applies", named(symbol)),
                    say!("Use the symbol in the axiom or in a rule that applies, or remove this one."),
                )
            };
            notes.warn(span.clone(), message, hint);
            break;
        }
    }
}
