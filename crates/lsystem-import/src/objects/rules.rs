//! Rules in the values of programs.

use super::object::is_key;
use crate::assembly::{Rule, Said, Statements};
use crate::prose_words::alternatives;
use crate::rules::split_rule;
use crate::value::{Member, Value, What, elements, members};
use crate::vocabulary::{Key, words};
use core::ops::Range;
use lsystem_base::{decimal, word};
use lsystem_syntax::{Diagnostic, parse};

/// Rules of any form.
#[derive(Default)]
pub(super) struct Rules {
    pub(super) found: Vec<Rule>,
    remarks: Vec<(Range<usize>, &'static str)>,
    /// Keys before alternatives.
    keys: Vec<Range<usize>>,
    /// Rules with parameters, as lines of our notation.
    pub(super) lines: Vec<Said<String>>,
}

const CODE: &str = word!("This rule is code, which is not read");
const UNREAD: &str = word!("This rule cannot be read");

impl Rules {
    pub(super) fn into(self, said: &mut Statements) {
        said.rules.extend(self.found);
        said.comments.extend(self.keys);
        said.lines.extend(self.lines);
        self.remarks.into_iter().for_each(|(span, why)| said.refuse(span, lsystem_base::words::said(why)));
    }

    pub(super) fn refuse(&mut self, span: &Range<usize>, why: &'static str) {
        self.remarks.push((span.clone(), why));
    }

    pub(super) fn rule(&mut self, from: &str, to: &str, weight: Option<f64>, span: &Range<usize>) {
        let rule = Rule { from: from.trim().to_owned(), to: to.to_owned(), weight, span: span.clone() };
        self.found.push(rule);
    }

    /// All rules of a system.
    pub(super) fn all(&mut self, value: &Value<'_>) {
        match &value.what {
            What::Text(text) => self.lines(text, &value.span),
            What::Group(node, _) => {
                let inside = node.group().unwrap_or_default();
                let own = members(inside);
                // Not of `{A: "B", B: "AB"}`.
                let has = |keys: &[&str]| own.iter().any(|member| member.key.len() > 1 && keys.contains(&&*member.key));
                let is_rule = has(words(Key::Predecessor)) && has(words(Key::Successor)) || is_pair(&own);
                if is_rule {
                    return self.listed(value);
                }
                if !own.is_empty() {
                    return own.iter().for_each(|member| self.keyed_at(&member.key, &member.value, &member.span));
                }
                let list = elements(inside);
                let texts: Vec<&str> = list.iter().filter_map(Value::text).collect();
                // `Map.of('A', "AB", 'B', "A")`, `{"F" "FF"}`
                let paired = texts.len() == list.len()
                    && list.len().is_multiple_of(2)
                    && !list.is_empty()
                    && texts.iter().step_by(2).all(|from| from.trim().chars().count() == 1);
                if paired {
                    for (pair, words) in list.chunks(2).zip(texts.chunks(2)) {
                        if let ([from, to], [head, word]) = (pair, words) {
                            self.rule(head, word, None, &(from.span.start..to.span.end));
                        }
                    }
                    return;
                }
                list.iter().for_each(|one| self.listed(one));
            }
            _ => self.refuse(&value.span, word!("The rules are code, which is not read")),
        }
    }

    /// One element of a list of rules.
    pub(super) fn listed(&mut self, value: &Value<'_>) {
        match &value.what {
            What::Text(text) => self.lines(text, &value.span),
            What::Group(node, _) => {
                let own = value.members();
                if own.is_empty() {
                    return self.arguments(&elements(node.group().unwrap_or_default()), value.span.clone());
                }
                let of = |keys: &[&str]| keys.iter().find_map(|key| own.iter().find(|member| is_key(member, key)));
                if let [from, to] = &own[..]
                    && is_pair(&own)
                {
                    return self.keyed_at(from.value.text().unwrap_or_default(), &to.value, &value.span);
                }
                match (of(words(Key::Predecessor)).and_then(|member| member.value.text()), of(words(Key::Successor))) {
                    (Some(from), Some(to)) => {
                        let weight = of(words(Key::Weight)).and_then(|member| member.value.number());
                        match &to.value.what {
                            What::Text(word) => self.rule(from, word, weight, &value.span),
                            _ => self.keyed(from, &to.value),
                        }
                    }
                    // `[{"F": "FF"}, {"X": "F"}]`
                    _ => own.iter().for_each(|member| self.keyed_at(&member.key, &member.value, &member.span)),
                }
            }
            _ => self.refuse(&value.span, CODE),
        }
    }

    /// The arguments of a call that adds a rule, or the elements of a pair: `'F', "FF"`, perhaps with a weight.
    pub(super) fn arguments(&mut self, own: &[Value<'_>], span: Range<usize>) {
        match own {
            [from, to] if from.text().is_some() => match &to.what {
                What::Text(word) => self.rule(from.text().unwrap_or_default(), word, None, &span),
                _ => self.keyed(from.text().unwrap_or_default(), to),
            },
            [from, to, weight] if from.text().is_some() && to.text().is_some() && weight.number().is_some() => {
                self.rule(from.text().unwrap_or_default(), to.text().unwrap_or_default(), weight.number(), &span);
            }
            [weight, from, to] if from.text().is_some() && to.text().is_some() && weight.number().is_some() => {
                self.rule(from.text().unwrap_or_default(), to.text().unwrap_or_default(), weight.number(), &span);
            }
            // `new Rule('A', "AF", Draw.None)`: what the symbol draws.
            [from, to, last] if from.text().is_some() && to.text().is_some() && last.what == What::Name("None") => {
                self.rule(from.text().unwrap_or_default(), to.text().unwrap_or_default(), None, &span);
            }
            [one] => match &one.what {
                What::Text(text) => self.lines(text, &span),
                What::Group(..) => self.listed(one),
                _ => self.refuse(&span, CODE),
            },
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
        for rule in text.split(separators).map(str::trim).filter(|rule| !rule.is_empty()) {
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

    fn keyed_at(&mut self, key: &str, value: &Value<'_>, span: &Range<usize>) {
        match value.text() {
            Some(to) => self.rule(key, to, None, span),
            None => {
                self.keys.push(span.start..value.span.start);
                self.keyed(key, value);
            }
        }
    }

    /// A rule whose predecessor is a key.
    pub(super) fn keyed(&mut self, key: &str, value: &Value<'_>) {
        let node = match &value.what {
            What::Text(to) => return self.rule(key, to, None, &value.span),
            What::Group(node, _) => *node,
            _ => return self.refuse(&value.span, CODE),
        };
        let own = value.members();
        if own.is_empty() {
            return self.alternatives(key, &elements(node.group().unwrap_or_default()), &value.span);
        }
        let of = |keys: &[&str]| keys.iter().find_map(|key| own.iter().find(|member| is_key(member, key)));
        if let Some(code) = of(&["condition"]) {
            self.keys.push(value.span.start..code.value.span.start);
            return self.refuse(&code.value.span, word!("Conditions are code, which is not read"));
        }
        if let Some(successors) = of(&["successors", "productions", "options"]) {
            self.keys.push(value.span.start..successors.value.span.start);
            return self.keyed(key, &successors.value);
        }
        let context = |keys: &[&str]| of(keys).and_then(|member| member.value.text()).unwrap_or_default().to_owned();
        let (left, right) = (context(&["leftCtx", "left"]), context(&["rightCtx", "right"]));
        let to = of(&["successor", "to", "out", "output", "replacement", "rule", "value", "result"]);
        if let Some(word) = to.and_then(|member| member.value.text()) {
            let mut from = key.to_owned();
            if !left.is_empty() {
                from = format!("{left} < {from}");
            }
            if !right.is_empty() {
                from = format!("{from} > {right}");
            }
            let weight = of(words(Key::Weight)).and_then(|member| member.value.number());
            return self.rule(&from, word, weight, &value.span);
        }
        // `{"F": {"FF": 0.5, "F": 0.5}}`, `{"F": {0.5: "FF"}}`
        if own.iter().all(|member| member.value.number().is_some()) {
            return own.iter().for_each(|member| self.rule(key, &member.key, member.value.number(), &member.span));
        }
        let chance = |member: &Member<'_>| Some((decimal::read(&member.key)?, member.value.text()?.to_owned()));
        if let Some(found) = own.iter().map(chance).collect::<Option<Vec<_>>>() {
            return found.iter().for_each(|(weight, to)| self.rule(key, to, Some(*weight), &value.span));
        }
        self.refuse(&value.span, UNREAD);
    }

    /// Successors of one symbol: `["FF", "F"]`, `[{p: 0.5, rule: "FF"}, ..]`, `[[0.5, "FF"], ..]`, or one word in
    /// single symbols.
    fn alternatives(&mut self, key: &str, list: &[Value<'_>], span: &Range<usize>) {
        let texts: Vec<&str> = list.iter().filter_map(Value::text).collect();
        if texts.len() == list.len() && texts.iter().all(|text| text.chars().count() == 1) {
            return self.rule(key, &texts.concat(), None, span);
        }
        // `("FF", 0.5)` is one successor with its weight.
        if let [one, other] = list
            && let (Some(to), Some(weight)) = (one.text().or(other.text()), one.number().or(other.number()))
        {
            return self.rule(key, to, Some(weight), span);
        }
        for one in list {
            let own = one.members();
            let of = |keys: &[&str]| keys.iter().find_map(|key| own.iter().find(|member| is_key(member, key)));
            let to = one.text().or_else(|| of(words(Key::Successor)).and_then(|member| member.value.text()));
            if let Some(to) = to {
                let weight = of(words(Key::Weight)).and_then(|member| member.value.number());
                self.rule(key, to, weight.or(Some(1.0)), &one.span);
                continue;
            }
            match &one.elements()[..] {
                [p, to] | [to, p] if p.number().is_some() && to.text().is_some() => {
                    self.rule(key, to.text().unwrap_or_default(), p.number(), &one.span);
                }
                _ => self.refuse(&one.span, word!("This successor cannot be read: it has parameters or is code")),
            }
        }
    }
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
