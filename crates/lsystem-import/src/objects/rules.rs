//! Rules in the values of programs.

use super::object::is_key;
use crate::assembly::{EARLIER, REPLACED, Rule, Said, Statements};
use crate::prose_words::alternatives;
use crate::rules::split_rule;
use crate::value::{Member, Value, What, elements, members};
use crate::vocabulary::{Key, words};
use core::ops::Range;
use lsystem_base::{decimal, word};
use lsystem_syntax::{Diagnostic, parse};
use std::collections::HashMap;

/// Rules of any form.
#[derive(Default)]
pub(super) struct Rules {
    /// Whether the first value of a key that stands twice is the only one, not the last.
    first_counts: bool,
    pub(super) found: Vec<Rule>,
    /// Remarks, and whether they refuse the system.
    remarks: Vec<(Range<usize>, &'static str, bool)>,
    /// Keys before alternatives.
    keys: Vec<Range<usize>>,
    /// Rules with parameters, as lines of our notation.
    pub(super) lines: Vec<Said<String>>,
}

const CODE: &str = word!("This rule is code, which is not read");
const UNREAD: &str = word!("This rule cannot be read");

impl Rules {
    pub(super) fn new(first_counts: bool) -> Self {
        Self { first_counts, ..Self::default() }
    }

    /// Adds the rules to a system. If they replace others, the last rule of a symbol is the only one.
    pub(super) fn into(self, said: &mut Statements, replaces: bool) {
        if replaces {
            said.leave_out(REPLACED, |rule| self.found.iter().any(|new| new.from == rule.from));
        }
        said.rules.extend(self.found);
        said.comments.extend(self.keys);
        said.lines.extend(self.lines);
        said.remarks.extend(
            self.remarks.into_iter().map(|(span, why, refuses)| (span, lsystem_base::words::said(why), refuses)),
        );
    }

    fn refuse(&mut self, span: &Range<usize>, why: &'static str) {
        self.remarks.push((span.clone(), why, true));
    }

    pub(super) fn rule(&mut self, from: &str, to: &str, weight: Option<f64>, span: &Range<usize>) {
        let rule = Rule { from: from.trim().to_owned(), to: to.to_owned(), weight, span: span.clone() };
        self.found.push(rule);
    }

    /// All rules of a system.
    pub(super) fn all(&mut self, value: &Value<'_>) {
        let list = value.items().filter(|inside| members(inside).is_empty()).map(elements);
        match list {
            Some(list) if pairs(&list) => {
                for pair in list.chunks(2) {
                    self.arguments(pair, pair[0].span.start..pair[1].span.end);
                }
            }
            Some(list) => list.iter().for_each(|one| self.one(None, one, None)),
            None => self.one(None, value, None),
        }
    }

    /// Rules in a value: those in its text, its pairs or its members, or the successors of a symbol.
    pub(super) fn one(&mut self, from: Option<&str>, value: &Value<'_>, weight: Option<f64>) {
        let span = &value.span;
        match (&value.what, from) {
            (What::Text(to), Some(from)) => self.rule(from, to, weight, span),
            (What::Text(text), None) => self.lines(text, span),
            (What::Group(node, _), _) => {
                let inside = node.group().unwrap_or_default();
                let own = members(inside);
                match from {
                    _ if !own.is_empty() => self.object(from, &own, span, weight),
                    Some(from) => self.alternatives(from, &elements(inside), span),
                    None => self.arguments(&elements(inside), span.clone()),
                }
            }
            _ => self.refuse(span, CODE),
        }
    }

    /// The members of an object: the sides of a rule, alternatives with their weights, or rules by their predecessors.
    fn object(&mut self, from: Option<&str>, own: &[Member<'_>], span: &Range<usize>, weight: Option<f64>) {
        let of = |keys: &[&str]| keys.iter().find_map(|key| own.iter().find(|member| is_key(member, key)));
        let has = |keys: &[&str]| own.iter().any(|member| member.key.len() > 1 && keys.contains(&&*member.key));
        // Not of `{A: "B", B: "AB"}`.
        let is_rule = has(words(Key::Predecessor)) && has(words(Key::Successor));
        let (head, to) = match own {
            [head, to] if is_pair(own) && from.is_none() => (Some(head), Some(to)),
            _ => (of(words(Key::Predecessor)).filter(|_| from.is_none() && is_rule), of(words(Key::Successor))),
        };
        if let (Some(from), Some(to)) = (from.or_else(|| head?.value.text()), to) {
            if let Some(code) = of(&["condition"]) {
                self.keys.push(span.start..code.value.span.start);
                return self.refuse(&code.value.span, word!("Conditions are code, which is not read"));
            }
            let weight = of(words(Key::Weight)).and_then(|member| member.value.number()).or(weight);
            let context = |keys: &[&str], sign: [&str; 2]| {
                let is_side =
                    |member: &Member<'_>| [Some(to), head].iter().flatten().any(|side| side.span == member.span);
                let word = of(keys)
                    .filter(|member| !is_side(member))
                    .and_then(|member| member.value.text())
                    .filter(|word| !word.is_empty());
                word.map_or(String::new(), |word| [sign[0], word, sign[1]].concat())
            };
            let left = context(&["leftCtx", "leftContext", "left"], ["", " < "]);
            let from = left + from + &context(&["rightCtx", "rightContext", "right"], [" > ", ""]);
            return match to.value.text() {
                Some(word) => self.rule(&from, word, weight, span),
                None => {
                    self.keys.push(span.start..to.value.span.start);
                    self.one(Some(&from), &to.value, weight);
                }
            };
        }
        if let Some(from) = from {
            // `{"F": {"FF": 0.5, "F": 0.5}}`, `{"F": {0.5: "FF"}}`
            for member in own {
                match (member.value.number(), decimal::read(&member.key).zip(member.value.text())) {
                    (Some(weight), _) => self.rule(from, &member.key, Some(weight), &member.span),
                    (None, Some((weight, to))) => self.rule(from, to, Some(weight), &member.span),
                    _ => self.refuse(&member.span, UNREAD),
                }
            }
            return;
        }
        // Of a key that stands twice, one value counts.
        let mut kept: HashMap<&str, usize> = HashMap::new();
        for (at, member) in own.iter().enumerate() {
            let place = kept.entry(&member.key).or_insert(at);
            *place = if self.first_counts { *place } else { at };
        }
        for (at, member) in own.iter().enumerate() {
            match member.value.text() {
                _ if kept.get(&*member.key) != Some(&at) => {
                    let why = if self.first_counts { EARLIER } else { REPLACED };
                    self.remarks.push((member.span.clone(), why, false));
                }
                Some(to) => self.rule(&member.key, to, None, &member.span),
                None => {
                    self.keys.push(member.span.start..member.value.span.start);
                    self.one(Some(&member.key), &member.value, None);
                }
            }
        }
    }

    /// The arguments of a call that adds a rule, or the elements of a pair: `'F', "FF"`, perhaps with a weight.
    pub(super) fn arguments(&mut self, own: &[Value<'_>], span: Range<usize>) {
        let weight = own.iter().find_map(Value::number).filter(|_| own.len() == 3);
        let rest: Vec<&Value<'_>> = own.iter().filter(|value| weight.is_none() || value.number().is_none()).collect();
        match rest[..] {
            // `new Rule('A', "AF", Draw.None)`: what the symbol draws.
            [_, _, last] if last.what != What::Name("None") => self.refuse(&span, UNREAD),
            [from, to] | [from, to, _] if let Some(from) = from.text() => match to.text() {
                Some(word) => self.rule(from, word, weight, &span),
                None => self.one(Some(from), to, weight),
            },
            [one] if let Some(text) = one.text() => self.lines(text, &span),
            _ if !own.is_empty() && own.iter().all(|one| one.items().is_some()) => {
                own.iter().for_each(|one| self.one(None, one, None));
            }
            [one] => self.one(None, one, None),
            _ => self.refuse(&span, UNREAD),
        }
    }

    /// Rules in the lines of a string.
    pub(super) fn lines(&mut self, text: &str, span: &Range<usize>) {
        let sections = ["draw:", "ignore", "consider"];
        let is_section = |line: &str| sections.iter().any(|section| line.trim_start().starts_with(section));
        if text.contains('(') || text.lines().any(is_section) {
            let (grammar, problems) = parse("", text);
            if !grammar.productions.is_empty() && !problems.iter().any(Diagnostic::is_error) {
                return self.lines.push(Said::new(text.to_owned(), span.clone()));
            }
        }
        let separators: &[char] = if text.contains('\n') { &['\n', ';'] } else { &[';', ','] };
        for rule in text.split(separators).map(|rule| rule.trim().trim_end_matches(',')).filter(|rule| !rule.is_empty())
        {
            match split_rule(rule) {
                Some((from, to)) => {
                    for (to, weight) in alternatives(to, None) {
                        self.rule(from, to, weight, span);
                    }
                }
                None => self.refuse(span, word!("This rule has no arrow")),
            }
        }
    }

    /// Successors of one symbol: `["FF", "F"]`, `[{p: 0.5, rule: "FF"}, ..]`, `[[0.5, "FF"], ..]`, or one word in
    /// single symbols.
    fn alternatives(&mut self, from: &str, list: &[Value<'_>], span: &Range<usize>) {
        let texts: Vec<&str> = list.iter().filter_map(Value::text).collect();
        if texts.len() == list.len() && texts.iter().all(|text| text.chars().count() == 1) {
            return self.rule(from, &texts.concat(), None, span);
        }
        // `("FF", 0.5)` is one successor with its weight.
        if let ([to], [one, other]) = (&texts[..], list)
            && let Some(weight) = one.number().or(other.number())
        {
            return self.rule(from, to, Some(weight), span);
        }
        for one in list {
            match one.what {
                What::Text(_) | What::Group(..) => self.one(Some(from), one, Some(1.0)),
                _ => self.refuse(&one.span, word!("This successor cannot be read: it has parameters or is code")),
            }
        }
    }
}

/// Whether values are predecessors and successors by turns: `Map.of('A', "AB", 'B', "A")`, `{"F" "FF"}`.
fn pairs(list: &[Value<'_>]) -> bool {
    let is_symbol = |value: &Value<'_>| value.text().is_some_and(|text| text.trim().chars().count() == 1);
    list.len().is_multiple_of(2)
        && !list.is_empty()
        && list.iter().all(|value| value.text().is_some())
        && list.iter().step_by(2).all(is_symbol)
}

/// Whether members are the sides of one rule that are called `a` and `b`, not rules of `a` and `b`.
fn is_pair(own: &[Member<'_>]) -> bool {
    let [from, to] = own else { return false };
    let (Some(symbol), Some(word)) = (from.value.text(), to.value.text()) else { return false };
    let names = [&*from.key, &*to.key];
    (names == ["a", "b"] || names == ["A", "B"])
        && symbol.chars().count() == 1
        && !names.iter().any(|name| symbol == *name || word.contains(name))
}
