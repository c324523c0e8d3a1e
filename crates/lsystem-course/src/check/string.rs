//! Strings, compared symbol by symbol.

use super::{Check, LIMITS, Output, SymbolDifference, Verdict, candidates};
use lsystem_base::{Limits, decimal};
use lsystem_derive::Word;
use lsystem_drawing::{System, count_symbols, expand};
use lsystem_syntax::{Diagnostic, Grammar, print_rules};
use std::borrow::Cow;

/// The symbols of a page of a long string.
const PAGE: usize = 1 << 16;
/// The number of symbols quoted on each side of a difference.
const NEAR: usize = 24;
/// The most units of work for applying rules one after another: symbols read and written.
const MAX_REPLACED: usize = 1 << 25;

pub(super) fn check(system: &System, n: u32, output: &str) -> Check {
    let is_plain = system.rules.is_plain();
    let has_blanks = system.rules.letters.iter().any(|letter| letter.symbol.is_whitespace());
    let output = output.strip_prefix('\u{feff}').unwrap_or(output);
    let found: String = match has_blanks {
        true => output.trim_end_matches(['\n', '\r']).to_owned(),
        false => output.chars().filter(|c| !c.is_whitespace()).collect(),
    };
    let count = Symbols::new(&found, is_plain).count() as u64;
    let checked = |expected, verdict| Check { output: Output::Text, generation: n, expected, found: count, verdict };
    let string = match GenerationString::new(system, n, LIMITS.symbols) {
        Ok(string) => string,
        Err(limit) => return checked(None, Verdict::Failed(vec![limit])),
    };
    let expected = Some(string.symbols(is_plain));
    let Some(difference) = string.compare(&found, is_plain, system) else { return checked(expected, Verdict::Same) };
    let is_generation = |&other: &u32| {
        let string = GenerationString::new(system, other, count.saturating_add(1));
        string.is_ok_and(|string| string.compare(&found, is_plain, system).is_none())
    };
    if let Some(other) = candidates(n, count, |other| count_symbols(system, other)).find(is_generation) {
        return checked(expected, Verdict::Generation(other));
    }
    if one_after_another(system, n, found.len()).is_some_and(|string| string == found) {
        return checked(expected, Verdict::OneAfterAnother);
    }
    checked(expected, Verdict::Symbol(difference))
}

/// The string of a generation: readable in pages, or as a whole.
enum GenerationString<'a> {
    Word(Word<'a>),
    Whole(String),
}

impl<'a> GenerationString<'a> {
    /// # Errors
    /// The limit, if the string has to be derived as a whole and has more than `most` symbols.
    fn new(system: &'a System, n: u32, most: u64) -> Result<Self, Diagnostic> {
        match system.word(n) {
            Some(word) => Ok(Self::Word(word)),
            None => expand(system, n, &Limits { symbols: most.min(LIMITS.symbols), ..LIMITS }).map(Self::Whole),
        }
    }

    fn symbols(&self, is_plain: bool) -> u128 {
        match self {
            Self::Word(word) => word.symbols(),
            Self::Whole(text) => Symbols::new(text, is_plain).count() as u128,
        }
    }

    /// The symbols from `index` on: a page, or all of them; empty at the end.
    fn page(&self, index: u64) -> Cow<'_, str> {
        match self {
            Self::Word(word) => word.slice(index.into(), PAGE).into(),
            Self::Whole(text) if index == 0 => text.as_str().into(),
            Self::Whole(_) => "".into(),
        }
    }

    /// The first difference from a string.
    fn compare(&self, found: &str, is_plain: bool, system: &System) -> Option<SymbolDifference> {
        let mut symbols = Symbols::new(found, is_plain);
        let mut index = 0;
        loop {
            let page = self.page(index);
            if page.is_empty() {
                return (!symbols.rest.is_empty()).then(|| self.difference(index, found, &symbols, system));
            }
            for expected in Symbols::new(&page, is_plain) {
                let here = symbols.clone();
                if !symbols.next().is_some_and(|symbol| is_equal(expected, symbol)) {
                    return Some(self.difference(index, found, &here, system));
                }
                index += 1;
            }
        }
    }

    /// The difference at `index`, where `rest` of the symbols found are left.
    fn difference(&self, index: u64, found: &str, rest: &Symbols<'_>, system: &System) -> SymbolDifference {
        let is_plain = rest.is_plain;
        SymbolDifference {
            index,
            before: last_symbols(&found[..found.len() - rest.rest.len()], is_plain),
            expected: match self {
                Self::Word(word) => word.slice(index.into(), NEAR),
                Self::Whole(text) => Symbols::new(text, is_plain).skip(index as usize).take(NEAR).collect(),
            },
            found: rest.clone().take(NEAR).collect(),
            made_by: self.made_by(index, system),
        }
    }

    /// The generation and the production that made a symbol.
    fn made_by(&self, index: u64, system: &System) -> Option<(u32, String)> {
        let Self::Word(word) = self else { return None };
        let chain = word.ancestry(index.into());
        let made = chain.iter().rev().find(|ancestor| ancestor.production.is_some())?;
        let production = system.grammar.productions.get(made.production?)?.clone();
        Some((made.generation, print_rules(&Grammar { productions: vec![production], ..Grammar::default() })))
    }
}

/// The symbols of a text: characters, or modules with their arguments.
#[derive(Clone)]
struct Symbols<'a> {
    rest: &'a str,
    is_plain: bool,
}

impl<'a> Symbols<'a> {
    fn new(text: &'a str, is_plain: bool) -> Self {
        Self { rest: text, is_plain }
    }
}

impl<'a> Iterator for Symbols<'a> {
    type Item = &'a str;

    fn next(&mut self) -> Option<&'a str> {
        let first = self.rest.chars().next()?;
        let mut end = first.len_utf8();
        if !self.is_plain {
            // A symbol in backquotes, then arguments.
            if first == '`'
                && let Some(close) = self.rest[1..].find('`')
            {
                end = close + 2;
            }
            if self.rest[end..].starts_with('(')
                && let Some(close) = self.rest[end..].find(')')
            {
                end += close + 1;
            }
        }
        let (symbol, rest) = self.rest.split_at(end);
        self.rest = rest;
        Some(symbol)
    }
}

/// The last symbols of a text.
fn last_symbols(text: &str, is_plain: bool) -> String {
    // A module takes at most a few dozen characters; a cut module at the start is only shown.
    let reach = if is_plain { NEAR } else { 4 * NEAR };
    let start = text.char_indices().rev().take(reach).last().map_or(text.len(), |(at, _)| at);
    text[start..].to_owned()
}

/// Whether two symbols are equal. Arguments are compared as numbers, to six digits, as programs print them.
fn is_equal(a: &str, b: &str) -> bool {
    let parts = |text: &'_ str| -> Option<(String, Vec<f64>)> {
        let (symbol, arguments) = text.strip_suffix(')')?.split_once('(')?;
        let numbers = arguments.split(',').map(|number| decimal::read(number.trim())).collect::<Option<_>>()?;
        Some((symbol.trim_matches('`').to_owned(), numbers))
    };
    if a == b {
        return true;
    }
    match (parts(a), parts(b)) {
        (Some((a, numbers)), Some((b, others))) => {
            let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-5 * a.abs().max(b.abs()).max(1e-6);
            a == b && numbers.len() == others.len() && numbers.iter().zip(&others).all(near)
        }
        _ => false,
    }
}

/// The string of `n` steps in which the rules are applied one after another, a usual mistake. `None` if the rules are
/// not plain and deterministic, or if the string becomes longer than `most` bytes.
fn one_after_another(system: &System, n: u32, most: usize) -> Option<String> {
    let productions = &system.grammar.productions;
    let is_simple = system.rules.is_plain() && productions.iter().all(|production| production.weight.is_none());
    if !is_simple || productions.len() < 2 || system.rules.is_random() {
        return None;
    }
    let mut text: String = system.grammar.axiom.iter().map(|module| module.symbol).collect();
    let mut left = MAX_REPLACED;
    for _ in 0..n {
        for production in productions {
            let successor: String = production.successor.iter().map(|module| module.symbol).collect();
            let symbol = production.predecessor.symbol;
            let times = text.matches(symbol).count();
            let length = text.len() + times * successor.len();
            left = left.checked_sub(text.len() + length)?;
            text = text.replace(symbol, &successor);
            if text.len() > most {
                return None;
            }
        }
    }
    Some(text)
}
