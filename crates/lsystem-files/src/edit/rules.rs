//! Edits of rules, of the axiom beside them, and of overrides: in lists of lines, and in the course's objects.

use super::diff::{Fate, Plan};
use super::layout::{Edit, place};
use super::{Editor, block};
use crate::json::last_property;
use crate::json_write::{json_number, string};
use core::ops::Range;
use jsonc_parser::ast::{Array, Object, ObjectProp, Value as Json};
use jsonc_parser::common::Ranged;
use lsystem_syntax::overrides::{entries, line};
use lsystem_syntax::{Grammar, Module, Production, parse};

/// The outcomes of one symbol: weights and successors.
type Outcomes = Vec<(Option<f64>, String)>;

impl Editor<'_> {
    /// The edit of the axiom, which is plain characters beside an object of rules.
    pub(super) fn axiom(&self, file: &Object<'_>, property: &ObjectProp<'_>) -> Option<Vec<Edit>> {
        let rules = last_property(file, "rules").map(|property| &property.value);
        let was_plain = matches!(rules, None | Some(Json::Object(_)));
        let is_plain = match rules {
            None => self.new.rules.is_empty(),
            _ => was_plain && !self.as_lines,
        };
        let Json::StringLit(held) = &property.value else { return None };
        let unchanged =
            if was_plain == is_plain { self.former.axiom == self.new.axiom } else { held.value == self.new.axiom };
        let axiom = match is_plain {
            true => plain(&parse(&self.new.axiom, &self.new.rules).0.axiom),
            false => self.new.axiom.clone(),
        };
        (!unchanged).then(|| vec![(place(held), string(&axiom))])
    }

    pub(super) fn rules(&self, property: &ObjectProp<'_>) -> Option<Vec<Edit>> {
        match &property.value {
            Json::Object(rules) if !self.as_lines => {
                (self.former.rules != self.new.rules).then(|| self.course_rules(rules))
            }
            Json::Object(rules) => {
                let (grammar, _) = parse(&self.former.axiom, &self.former.rules);
                let counts = outcomes(&grammar);
                let mut lines = self.former.rules.split('\n').map(str::to_owned);
                let old = rules.properties.iter().map(|property| {
                    let is_read = last_property(rules, property.name.as_str()) == Some(property);
                    let count = counts.iter().find(|(symbol, _)| is_read && *symbol == property.name.as_str());
                    lines.by_ref().take(count.map_or(0, |(_, outcomes)| outcomes.len())).collect()
                });
                let old: Vec<Vec<String>> = old.collect();
                Some(self.object_as_lines(rules, &old, &self.new.rules))
            }
            _ if self.former.rules == self.new.rules => None,
            other => Some(self.line_list(property, other, &self.new.rules)),
        }
    }

    pub(super) fn overrides(&self, property: &ObjectProp<'_>) -> Vec<Edit> {
        let text = &self.new.overrides;
        let Json::Object(object) = &property.value else { return self.line_list(property, &property.value, text) };
        let new = if text.is_empty() { Some(Vec::new()) } else { entries(text) };
        if let Some(new) = new.filter(|_| !self.as_lines) {
            let new: Vec<_> = new.into_iter().map(|(symbol, actions)| (symbol.to_string(), actions)).collect();
            return self.members(
                object,
                &new,
                |actions| string(actions),
                |_, actions, held| match held {
                    Json::StringLit(held) if held.value == *actions => Fate::Stays,
                    held => Fate::Changes(vec![(place(held), string(actions))]),
                },
            );
        }
        let old = object.properties.iter().map(|property| match &property.value {
            Json::StringLit(actions) => {
                property.name.as_str().chars().map(|symbol| line(symbol, &actions.value)).collect()
            }
            _ => Vec::new(),
        });
        self.object_as_lines(object, &old.collect::<Vec<_>>(), text)
    }

    /// Edits of a list of lines, or of one text.
    fn line_list(&self, property: &ObjectProp<'_>, value: &Json<'_>, text: &str) -> Vec<Edit> {
        let range = place(value);
        let Json::Array(list) = value else { return vec![(range, string(text))] };
        if list.elements.is_empty() && self.layout.text[range.start + 1..range.end - 1].trim().is_empty() {
            return vec![(range, self.lines(text, &self.layout.gap(property.start())))];
        }
        let held = list.elements.iter().map(|element| match element {
            Json::StringLit(text) => text.value.split('\n').map(str::to_owned).collect(),
            _ => Vec::new(),
        });
        let held: Vec<Vec<String>> = held.collect();
        let new: Vec<_> = text.split('\n').filter(|_| !text.is_empty()).map(str::to_owned).collect();
        self.layout.edits(list, &list.elements, quoted(Plan::new(&held, &new)))
    }

    /// Makes an object, whose members stand for the lines `old`, into a list of lines.
    fn object_as_lines(&self, object: &Object<'_>, old: &[Vec<String>], text: &str) -> Vec<Edit> {
        let new: Vec<_> = text.split('\n').filter(|_| !text.is_empty()).map(str::to_owned).collect();
        let mut plan = quoted(Plan::new(old, &new));
        for (slot, lines) in plan.slots.iter_mut().zip(old) {
            if matches!(slot.fate, Fate::Stays) {
                let lines: Vec<_> = lines.iter().map(|line| string(line)).collect();
                slot.fate = if lines.is_empty() { Fate::Goes } else { Fate::Becomes(lines.join(", ")) };
            }
        }
        let Range { start, end } = place(object);
        let mut edits = vec![(start..start + 1, "[".to_owned()), (end - 1..end, "]".to_owned())];
        edits.extend(self.layout.edits(object, &object.properties, plan));
        edits
    }

    /// Edits of rules as the course has them: an object with a member for each symbol.
    fn course_rules(&self, rules: &Object<'_>) -> Vec<Edit> {
        let former = outcomes(&parse(&self.former.axiom, &self.former.rules).0);
        let gap = self.gap(rules);
        let fresh = |outcomes: &Outcomes| match &outcomes[..] {
            [(None, successor)] => string(successor),
            _ => {
                let outcomes: Vec<_> = outcomes.iter().map(|outcome| self.outcome(outcome)).collect();
                block('[', &outcomes, ']', &gap, self.indent)
            }
        };
        let new = outcomes(&parse(&self.new.axiom, &self.new.rules).0);
        self.members(rules, &new, fresh, |symbol, outcomes, held| {
            let old = former.iter().find(|(other, _)| other == symbol).map(|(_, outcomes)| outcomes);
            match (old, held) {
                (Some(old), _) if old == outcomes => Fate::Stays,
                (Some(old), Json::Array(list)) if old.len() == list.elements.len() && outcomes[0].0.is_some() => {
                    Fate::Changes(self.outcome_list(list, old, outcomes))
                }
                _ => Fate::Changes(vec![(place(held), fresh(outcomes))]),
            }
        })
    }

    /// Edits of a list of outcomes.
    fn outcome_list(&self, list: &Array<'_>, old: &Outcomes, new: &Outcomes) -> Vec<Edit> {
        let keys = |outcomes: &Outcomes| outcomes.iter().map(|outcome| vec![self.outcome(outcome)]).collect::<Vec<_>>();
        let items: Vec<_> = keys(new).concat();
        let mut plan = Plan::new(&keys(old), &items);
        for (at, slot) in plan.slots.iter_mut().enumerate() {
            let Fate::Becomes(text) = &slot.fate else { continue };
            let Some(now) = items.iter().position(|item| item == text).map(|item| &new[item]) else { continue };
            let Json::Object(outcome) = &list.elements[at] else { continue };
            let mut changes = Vec::new();
            let mut change = |key: &str, is_new: bool, text: String| {
                if let Some(property) = last_property(outcome, key).filter(|_| is_new) {
                    changes.push((place(&property.value), text));
                }
            };
            change("p", old[at].0 != now.0, json_number(now.0.unwrap_or(1.0)));
            change("e", old[at].1 != now.1, string(&now.1));
            slot.fate = Fate::Changes(changes);
        }
        self.layout.edits(list, &list.elements, plan)
    }

    fn outcome(&self, (weight, successor): &(Option<f64>, String)) -> String {
        let [p, e] = [json_number(weight.unwrap_or(1.0)), string(successor)];
        let members = [self.member("p", &p), self.member("e", &e)];
        block('{', &members, '}', if self.layout.is_tight { "" } else { " " }, "")
    }

    /// Edits that give an object exactly these members. `fresh` is a value as JSON, and `fate` tells what becomes of one
    /// that is there.
    fn members<T>(
        &self,
        object: &Object<'_>,
        wanted: &[(String, T)],
        fresh: impl Fn(&T) -> String,
        fate: impl Fn(&str, &T, &Json<'_>) -> Fate,
    ) -> Vec<Edit> {
        let mut plan = Plan::unchanged(object.properties.len());
        for (property, slot) in object.properties.iter().zip(&mut plan.slots) {
            let key = property.name.as_str();
            slot.fate = match wanted.iter().find(|(wanted, _)| wanted == key) {
                Some((_, value)) if last_property(object, key) == Some(property) => fate(key, value, &property.value),
                Some(_) => Fate::Stays,
                None => Fate::Goes,
            };
        }
        // A new member stands after the one that comes before it.
        let mut place = None;
        for (key, value) in wanted {
            match object.properties.iter().rposition(|property| property.name.as_str() == key) {
                Some(at) => place = Some(at),
                None => {
                    let list = place.map_or(&mut plan.first, |at: usize| &mut plan.slots[at].after);
                    list.push(self.member(key, &fresh(value)));
                }
            }
        }
        self.layout.edits(object, &object.properties, plan)
    }
}

/// The plan with its new lines as JSON.
fn quoted(mut plan: Plan) -> Plan {
    let quote = |lines: &mut Vec<String>| lines.iter_mut().for_each(|line| *line = string(line));
    quote(&mut plan.first);
    for slot in &mut plan.slots {
        quote(&mut slot.after);
        if let Fate::Becomes(line) = &mut slot.fate {
            *line = string(line);
        }
    }
    plan
}

/// The outcomes of each symbol, in the order of the rules.
fn outcomes(grammar: &Grammar) -> Vec<(String, Outcomes)> {
    let groups = grammar.productions.chunk_by(|a, b| a.predecessor == b.predecessor);
    let outcome = |production: &Production| {
        let weight = production.weight.as_ref().and_then(|weight| grammar.value(weight));
        (weight, plain(&production.successor))
    };
    groups.map(|group| (group[0].predecessor.symbol.to_string(), group.iter().map(outcome).collect())).collect()
}

fn plain(word: &[Module]) -> String {
    word.iter().map(|module| module.symbol).collect()
}
