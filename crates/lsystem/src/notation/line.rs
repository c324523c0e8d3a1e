//! The lines of a text of rules: productions, constants and headings.

use super::expression::{self, Names};
use super::token::{Token, span_of, text_of, tokens};
use super::word::{closing, word};
use super::{Reading, arrow};
use crate::notes::{Notes, excerpt, similar};
use crate::{Constant, Feature, Kind, Module, Production};
use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};

/// Reads all lines of `text` into `reading`.
pub(crate) fn read(text: &str, reading: &mut Reading, notes: &mut Notes) {
    let mut rules =
        Rules { text, reading, notes, constants: Constants::default(), weights: Vec::new(), drawing: false };
    for line in super::lines(text) {
        if !super::is_comment(&text[line.clone()]) {
            rules.line(line);
        }
    }
    rules.finish();
}

struct Rules<'a> {
    text: &'a str,
    reading: &'a mut Reading,
    notes: &'a mut Notes,
    constants: Constants,
    /// Productions whose weight is read when all constants are known.
    weights: Vec<Weight>,
    /// Below `draw:`.
    drawing: bool,
}

struct Weight {
    production: usize,
    tokens: Vec<Token>,
    end: usize,
}

#[derive(Default)]
struct Constants {
    values: BTreeMap<String, f64>,
    /// In text order.
    defined: Vec<Defined>,
    used: BTreeSet<String>,
}

struct Defined {
    name: String,
    value: String,
    span: Range<usize>,
}

impl Names for Constants {
    fn value(&mut self, name: &str) -> Option<f64> {
        let value = self.values.get(name).copied();
        if value.is_some() && !self.used.contains(name) {
            self.used.insert(name.to_owned());
        }
        value
    }

    fn similar(&self, name: &str) -> Option<String> {
        similar(name, self.values.keys().map(String::as_str)).map(str::to_owned)
    }
}

impl Rules<'_> {
    fn line(&mut self, line: Range<usize>) {
        let text = self.text[line.clone()].trim_start_matches(super::token::is_blank);
        let define = "#define";
        if let Some(rest) = text.strip_prefix(define)
            && rest.starts_with(super::token::is_blank)
        {
            let tokens = tokens(self.text, line.end - rest.len()..line.end, self.notes);
            return self.define(&tokens, line.end);
        }
        let tokens = tokens(self.text, line.clone(), self.notes);
        if tokens.is_empty() {
            return;
        }
        if let Some((word, after)) = heading(&tokens)
            && self.heading(&word, &tokens, after)
        {
            return;
        }
        if let Some(arrow) = arrow::find(&tokens) {
            self.production(&tokens, arrow, line.end);
        } else if let Some(equals) = tokens.iter().position(|t| t.is('=')) {
            self.constant(&tokens, equals, line.end);
        } else {
            self.no_arrow(&tokens);
        }
    }

    /// `word:` at the start of a line. Whether it was one that means something.
    fn heading(&mut self, word: &str, tokens: &[Token], after: usize) -> bool {
        let kind = match word {
            "ignore" | "consider" => Kind::NotYet(Feature::ContextLists),
            "draw" => {
                self.drawing = true;
                Kind::NotYet(Feature::DrawProductions)
            }
            "axiom" | "initial" | "start" | "omega" | "angle" | "delta" | "iterations" | "generations" | "depth"
            | "step" | "seed"
                if arrow::find(&tokens[after..]).is_none() =>
            {
                Kind::OtherField { word: word.to_owned() }
            }
            _ => return false,
        };
        self.notes.add(kind, span_of(&tokens[..after], 0));
        true
    }

    /// `#define name value`, from the name on.
    fn define(&mut self, tokens: &[Token], end: usize) {
        let name = tokens.iter().skip(1).position(|t| !t.joined).map_or(tokens.len(), |at| at + 1);
        let (name, mut value) = tokens.split_at(name);
        // `#define r = 0.9` is a common slip.
        if let [equals, rest @ ..] = value
            && equals.is('=')
        {
            value = rest;
        }
        self.add_constant(name, value, end);
    }

    /// `name = value`.
    fn constant(&mut self, tokens: &[Token], equals: usize, end: usize) {
        let (name, value) = (&tokens[..equals], &tokens[equals + 1..]);
        let arithmetic = value.first().is_some_and(|t| t.ch.is_ascii_digit() || t.ch == '.' || t.ch == '(');
        let mut quiet = Notes::new(crate::Field::Rules);
        let named = is_name(name);
        let mut is_number = || expression::evaluate(value, end, false, &mut self.constants, &mut quiet).is_some();
        // One symbol before the sign and no number after it: a production is meant.
        if name.len() == 1 && !value.is_empty() && (!named || (!arithmetic && !is_number())) {
            let kind = Kind::EqualsForArrow { left: text_of(name), right: text_of(value) };
            return self.notes.add(kind, tokens[equals].span());
        }
        // `F := FF` and the like.
        if !named && name.iter().skip(1).any(|t| is_mark(*t)) {
            return self.no_arrow(tokens);
        }
        self.add_constant(name, value, end);
    }

    fn no_arrow(&mut self, tokens: &[Token]) {
        self.notes.add(Kind::NoArrow { suggestion: suggestion(tokens) }, span_of(tokens, 0));
    }

    fn add_constant(&mut self, name: &[Token], value: &[Token], end: usize) {
        let span = span_of(name, value.first().map_or(end, |t| t.span().start));
        if !is_name(name) {
            return self.notes.add(Kind::ConstantName { text: text_of(name) }, span);
        }
        let text = text_of(value);
        let value = expression::evaluate(value, end, false, &mut self.constants, self.notes);
        let name: String = name.iter().map(|t| t.ch).collect();
        if self.constants.values.contains_key(&name) {
            return self.notes.add(Kind::ConstantTwice { name: excerpt(&name) }, span);
        }
        // A value that is wrong is noted already; the name is known nevertheless.
        let value = value.unwrap_or(1.0);
        self.constants.values.insert(name.clone(), value);
        self.constants.defined.push(Defined { name: name.clone(), value: text, span });
        self.reading.grammar.constants.push(Constant { name, value });
    }

    fn production(&mut self, tokens: &[Token], arrow: Range<usize>, end: usize) {
        let (before, after) = (&tokens[..arrow.start], &tokens[arrow.end..]);
        let predecessor = self.predecessor(before, &span_of(&tokens[arrow.clone()], end));
        let (successor, weight) = match weight_colon(after) {
            Some(colon) => (&after[..colon], Some(&after[colon + 1..])),
            None => (after, None),
        };
        let successor = word(successor, &Kind::SecondArrow, self.notes);
        let Some((predecessor, span)) = predecessor.filter(|_| !self.drawing) else {
            // Its weight is looked at all the same, so that all errors come at once.
            if let Some(weight) = weight {
                self.weights.push(Weight { production: usize::MAX, tokens: weight.to_vec(), end });
            }
            return;
        };
        let production = self.reading.grammar.productions.len();
        if let Some(weight) = weight {
            self.weights.push(Weight { production, tokens: weight.to_vec(), end });
        }
        let weight = weight.map(|_| 1.0);
        self.reading.grammar.productions.push(Production { predecessor, successor: successor.modules, weight });
        self.reading.predecessor_spans.push(span);
        self.reading.successor_spans.push(successor.spans);
    }

    /// What stands before the arrow: contexts, the strict predecessor, and a condition.
    fn predecessor(&mut self, tokens: &[Token], arrow: &Range<usize>) -> Option<(Module, Range<usize>)> {
        let (head, condition) = match outside(tokens, ':') {
            Some(colon) => (&tokens[..colon], Some(&tokens[colon..])),
            None => (tokens, None),
        };
        let context = outside(head, '<').or_else(|| outside(head, '>'));
        let arguments = head.iter().position(|t| t.is('(') && t.joined);
        let feature = if context.is_some() && head.len() > 1 {
            Some((Feature::Context, span_of(head, arrow.start)))
        } else if let Some(open) = arguments {
            let Some(length) = closing(&head[open..]) else {
                self.notes.add(Kind::ParenthesisUnclosed, head[open].span());
                return None;
            };
            Some((Feature::Parameters, span_of(&head[open - 1..=open + length], arrow.start)))
        } else {
            None
        };
        if let Some((feature, span)) = feature.clone() {
            self.notes.add(Kind::NotYet(feature), span);
        }
        if let Some(condition) = condition
            && !head.is_empty()
        {
            self.notes.add(Kind::NotYet(Feature::Condition), span_of(condition, arrow.start));
            return None;
        }
        match head {
            _ if feature.is_some() => None,
            [] => {
                self.notes.add(Kind::NoPredecessor, arrow.clone());
                None
            }
            [only] if context.is_some() => {
                self.notes.add(Kind::NoPredecessor, only.span());
                None
            }
            [only] => {
                if only.is('(') || only.is(')') {
                    self.notes.add(Kind::ParenthesisSymbol { symbol: only.ch }, only.span());
                }
                Some((Module::from(only.ch), only.span()))
            }
            _ => {
                self.notes.add(Kind::LongPredecessor { text: text_of(head) }, span_of(head, arrow.start));
                None
            }
        }
    }

    fn finish(mut self) {
        for Weight { production, tokens, end } in core::mem::take(&mut self.weights) {
            let Some(value) = expression::evaluate(&tokens, end, true, &mut self.constants, self.notes) else {
                continue;
            };
            // A sum of weights must stay finite too.
            if !(1e-100..=1e100).contains(&value) {
                self.notes.add(Kind::WeightRange { value }, span_of(&tokens, end));
            } else if let Some(production) = self.reading.grammar.productions.get_mut(production) {
                production.weight = Some(value);
            }
        }
        let constants = &mut self.constants;
        self.notes.each(|d| {
            if let Kind::UnknownConstant { name, below, .. } = &mut d.kind {
                *below = constants.value(name).is_some();
            }
        });
        for Defined { name, value, span } in core::mem::take(&mut self.constants.defined) {
            if !self.constants.used.contains(&name) {
                self.notes.add(Kind::ConstantUnused { name: excerpt(&name), value }, span);
            }
        }
        self.weigh_up();
    }

    /// Notes productions that never apply because of an earlier one for the same symbol.
    fn weigh_up(&mut self) {
        let mut firsts = BTreeMap::new();
        for (production, span) in self.reading.grammar.productions.iter().zip(&self.reading.predecessor_spans) {
            let (symbol, weighted) = (production.predecessor.symbol, production.weight.is_some());
            let kind = match (firsts.get(&symbol), weighted) {
                (None, _) => {
                    firsts.insert(symbol, weighted);
                    continue;
                }
                (Some(true), true) => continue,
                (Some(false), false) => Kind::NeverApplies { symbol },
                (Some(&first), _) => Kind::MixedWeights { symbol, weighted: first },
            };
            self.notes.add(kind, span.clone());
        }
    }
}

/// The place of the first `ch` outside parentheses.
fn outside(tokens: &[Token], ch: char) -> Option<usize> {
    let mut depth = 0_usize;
    tokens.iter().position(|t| {
        depth = (depth + usize::from(t.is('('))).saturating_sub(usize::from(t.is(')')));
        depth == 0 && t.is(ch)
    })
}

/// The place of the last `:` outside parentheses.
fn weight_colon(tokens: &[Token]) -> Option<usize> {
    let mut depth = 0_usize;
    let mut last = None;
    for (at, token) in tokens.iter().enumerate() {
        depth = (depth + usize::from(token.is('('))).saturating_sub(usize::from(token.is(')')));
        if depth == 0 && token.is(':') {
            last = Some(at);
        }
    }
    last
}

fn is_name(tokens: &[Token]) -> bool {
    match tokens {
        [first, rest @ ..] => {
            !first.literal
                && expression::is_name_start(first.ch)
                && rest.iter().all(|t| t.joined && !t.literal && expression::is_name_part(t.ch))
        }
        [] => false,
    }
}

/// A word and a colon at the start of a line, with a `#` before it or not: the word, and how many tokens they take.
fn heading(tokens: &[Token]) -> Option<(String, usize)> {
    let from = usize::from(tokens.first()?.is('#'));
    let colon = tokens.iter().take(16).position(|t| t.is(':'))?;
    let word = tokens.get(from..colon)?;
    is_name(word).then(|| (word.iter().flat_map(|t| t.ch.to_lowercase()).collect(), colon + 1))
}

/// Whether a character may be part of what was meant as an arrow.
fn is_mark(token: Token) -> bool {
    !token.literal && matches!(token.ch, ':' | '-' | '>' | '<' | '~' | '|' | '=')
}

/// `tokens` with an arrow in the place of what looks like one.
fn suggestion(tokens: &[Token]) -> Option<String> {
    let [first, rest @ ..] = tokens else { return None };
    let marks = rest.iter().take_while(|t| is_mark(**t)).count();
    let word = &rest[marks..];
    let apart = rest.first().is_some_and(|t| !t.joined);
    (!word.is_empty() && (marks > 0 || apart)).then(|| format!("{} -> {}", first.ch, text_of(word)))
}
