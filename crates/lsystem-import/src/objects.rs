//! Systems in programs and data of any language: objects, maps, lists, calls and assignments.
//!
//! ```text
//! new LSystem({axiom: 'F++F++F', productions: {'F': 'F-F++F-F'}})
//! axiom = "F"; rules = {"F": "F+F"}; angle = 60
//! grammar = new Grammar("X"); grammar.addRule('X', "F+X");
//! rules = new Dictionary<char, string> { { 'X', "F+X" } };
//! ```
//!
//! An object with an axiom and rules is a system; so are assignments and calls one after the other, until one of them is
//! repeated. Words are plain characters. Code is not run: what symbols do is known where the text compares a symbol and
//! then calls a usual function of a turtle, as in `case '+': right(25)`; else `F` and `G` draw and `+` turns left, with a
//! remark. An object with `theta` and `alpha` or `step` is of the package lindsvg, whose symbols are known.

mod flat;
mod object;
mod rules;

use crate::assembly::{Angle, Said, Statements, Symbols};
use crate::branches::{Branches, branches};
use crate::draft::Draft;
use crate::prose_words::is_prose;
use crate::rules::split_rule;
use crate::source::Source;
use crate::tokens::{Kind, Node, tree};
use crate::value::{Member, Value, What, elements, members, pairs};
use crate::vocabulary::{Key, key, letter_of, rows};
use core::ops::Range;
use lsystem_base::say;
use object::{angle_of, is_of_symbols, is_sure, lindenmayer, word_of};
use rules::Rules;
use std::collections::HashSet;

/// The most symbols whose branches each system of a text gets.
const MAX_BRANCHES: usize = 256;
/// Words of which a text without an axiom by that name has one.
const FIELD: [&str; 6] = ["axiom", "l-system", "lsystem", "lindenmayer", "l_system", "turtle"];
/// Parts of the names of functions that take an axiom and rules.
const MAKERS: [&str; 6] = ["lsys", "l_sys", "lindenmayer", "grammar", "derivation", SUBSTITUTION];
/// The function of Wolfram's language, which takes rules, an axiom and the number of steps.
const SUBSTITUTION: &str = "substitutionsystem";
/// A type of the crate dcc-lsystem, whose turtle starts to the right. Of several rules for a symbol the last one counts.
const TURTLE_BUILDER: &str = "TurtleLSystemBuilder";

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    // A list with words in backquotes is no program.
    if !text.contains(['{', ';', '"', '\'', '(']) {
        return None;
    }
    let lower = text.to_ascii_lowercase();
    let tree = tree(text);
    let mut reader = Reader {
        text,
        of_field: FIELD.iter().any(|word| lower.contains(word)),
        systems: Vec::new(),
        flat: Flat::default(),
        branches: branches(&tree.nodes),
        // Lists of lists of Asymptote.
        first_counts: lower.contains(SUBSTITUTION) || text.contains("string[][]") && !text.contains("new"),
        is_turtle_builder: text.contains(TURTLE_BUILDER),
    };
    reader.walk(&tree.nodes, "", &[]);
    reader.next_flat();
    let Reader { mut systems, branches, first_counts, is_turtle_builder, .. } = reader;
    // One more than the limit, which is then said.
    systems.truncate(crate::MAX_ENTRIES + 1);
    let is_lindenmayer = text.contains("setProduction");
    for system in systems.iter_mut().filter(|system| system.symbols == Symbols::Program) {
        if first_counts {
            system.keep_one(false);
        }
        if is_lindenmayer {
            lindenmayer(system);
        }
        if is_turtle_builder {
            system.keep_one(true);
            system.heading.get_or_insert(Said::new(0.0, 0..0));
        }
        for (symbol, actions, span) in branches.meanings.iter().take(MAX_BRANCHES) {
            system.mean(*symbol, actions.clone(), span.clone());
        }
        if let Some((.., span)) = branches.meanings.get(MAX_BRANCHES) {
            system.note(span.clone(), say!("This is not carried over"));
        }
    }
    let drafts: Vec<Draft<'a>> = systems.into_iter().map(|system| system.assemble(source, &tree.comments)).collect();
    (!drafts.is_empty()).then_some(drafts)
}

/// Assignments and calls one after the other, of one system.
#[derive(Default)]
struct Flat {
    said: Option<Statements>,
    /// Whether all rules were assigned at once.
    has_all_rules: bool,
    /// Whether the axiom was called so.
    is_sure: bool,
}

struct Reader<'a> {
    text: &'a str,
    /// Whether the text speaks of L-systems.
    of_field: bool,
    systems: Vec<Statements>,
    flat: Flat,
    branches: Branches,
    /// Whether the first of several rules for a symbol is the only one.
    first_counts: bool,
    /// Whether the text builds a system of dcc-lsystem.
    is_turtle_builder: bool,
}

impl Reader<'_> {
    /// Reads what stands in a bracket or in the whole text. `name` is what it is assigned to; `around` are the members of
    /// the object around it.
    fn walk(&mut self, nodes: &[Node], name: &str, around: &[Member<'_>]) {
        let mut at = 0;
        while let Some(node) = nodes.get(at) {
            if let Some(member) = crate::value::member(nodes, at)
                && self.member(nodes, at, &member, around)
            {
                at = member.next.max(at + 1);
                continue;
            }
            let is_bracket = |next: &&Node| match next.kind {
                Kind::Group('(', _) => true,
                Kind::Group('[', _) => node.name().is_some_and(|name| name.eq_ignore_ascii_case(SUBSTITUTION)),
                _ => false,
            };
            let called = nodes.get(at + 1).filter(|next| !next.is_first).filter(is_bracket);
            if let (Some(function), Some(arguments)) = (node.name(), called) {
                // `rules.add(..)`, `rules['F'].push_back(..)`
                let (receiver, index) = match nodes.get(..at) {
                    Some([.., object, Node { kind: Kind::Group('[', index), .. }, dot]) if dot.is(".") => {
                        (object.name(), index.first().and_then(Node::text))
                    }
                    Some([.., object, dot]) if dot.is(".") || dot.is("::") => (object.name(), None),
                    _ => (None, None),
                };
                let span = node.span.start..arguments.span.end;
                if self.call(function, receiver, index, arguments, span) {
                    at += 2;
                    continue;
                }
            }
            if let Kind::Group(_, inside) = &node.kind {
                let mut own = members(inside);
                if own.is_empty() {
                    own = pairs(inside);
                }
                if let Some(system) = self.object(&own, node.span.clone(), name, around) {
                    self.systems.push(system);
                } else {
                    self.walk(inside, "", &own);
                }
            }
            at += 1;
        }
    }

    /// Reads a member outside of a system; whether it is a part of one.
    fn member(&mut self, nodes: &[Node], at: usize, member: &Member<'_>, around: &[Member<'_>]) -> bool {
        if let What::Group(node, function) = &member.value.what {
            let own = member.value.members();
            if let Some(system) = self.object(&own, node.span.clone(), &member.key, around) {
                self.systems.push(system);
                return true;
            }
            // `grammar := New("F")` of Go
            let is_new = |function: &str| ["new", "create", "make"].contains(&&*function.to_ascii_lowercase());
            if let Some(function) = function
                && let function = if is_new(function) { &member.key } else { *function }
                && self.constructor(function, node, member.value.span.clone(), &member.key)
            {
                return true;
            }
        }
        let Some(key) = key(&member.key) else { return false };
        let name = nodes.get(at).and_then(Node::name);
        match key {
            Key::Axiom => {
                let Some(word) = word_of(&member.value).filter(|word| !word.trim().is_empty()) else { return false };
                self.flat_axiom(&word, member.span.clone(), is_sure(&member.key));
            }
            Key::Rules | Key::Rule => {
                if member.index.is_none() && member.value.items().is_some() && !is_of_symbols(&member.value) {
                    return false;
                }
                let mut rules = Rules::new(self.first_counts);
                match member.index {
                    Some(index) => rules.one(index.text(), &member.value, None),
                    // `rules_a = "FF"` says the letter; `rules = {...}` says all.
                    None if let Some(letter) = letter_of(&member.key)
                        && member.value.text().is_some_and(|text| split_rule(text).is_none()) =>
                    {
                        rules.one(Some(letter.encode_utf8(&mut [0; 4])), &member.value, None);
                    }
                    None => rules.all(&member.value),
                }
                // `rules = "X=FX", "F=FF"`
                let mut behind = member.next;
                while let Some([comma, next]) = nodes.get(behind..behind + 2)
                    && comma.is(",")
                    && !next.is_first
                    && let Some(text) = next.text()
                    && !rules.found.is_empty()
                {
                    rules.lines(text, &next.span);
                    behind += 2;
                }
                if rules.found.is_empty() && rules.lines.is_empty() {
                    return false;
                }
                let whole = member.index.is_none() && key == Key::Rules && letter_of(&member.key).is_none();
                let is_key = member.index.is_some_and(|index| index.text().is_some());
                self.flat_rules(rules, member.span.clone(), whole, is_key);
            }
            Key::Angle | Key::LeftAngle | Key::RightAngle | Key::LengthFactor | Key::Iterations => {
                let number = member.value.number().filter(|number| *number != 0.0);
                let Some(number) = number.filter(|n| *n > 0.0 && *n < 1e6 || key != Key::Iterations) else {
                    return false;
                };
                let weak = matches!(member.key.as_str(), "n" | "i" | "steps" | "level" | "order" | "gen" | "size");
                if key == Key::Iterations && (weak && !self.of_field || number.fract() != 0.0) {
                    return false;
                }
                let flat = self.flat_mut(member.span.start);
                let angle = angle_of(&member.key, &member.value);
                let differs = flat.angle.as_ref().is_some_and(|known| Some(known.value) != angle);
                if key == Key::Angle && differs && flat.axiom.is_some() && !flat.rules.is_empty() {
                    self.next_flat();
                }
                let mut said = core::mem::take(self.flat_mut(member.span.start));
                if key != Key::Iterations || said.iterations.is_none() {
                    self.part(&mut said, member);
                    said.extents.push(member.span.clone());
                }
                *self.flat_mut(member.span.start) = said;
            }
            Key::Name if name.is_some_and(|name| matches!(&*name.to_ascii_lowercase(), "name" | "title")) => {
                let Some(text) = member.value.text() else { return false };
                let flat = self.flat_mut(member.span.start);
                if flat.name.is_empty() {
                    text.clone_into(&mut flat.name);
                }
                return false;
            }
            _ => return false,
        }
        true
    }

    /// Reads a call; whether it is a part of a system.
    fn call(
        &mut self,
        function: &str,
        receiver: Option<&str>,
        index: Option<&str>,
        arguments: &Node,
        span: Range<usize>,
    ) -> bool {
        let Some(inside) = arguments.group() else { return false };
        let own = elements(inside);
        let names = rows(function);
        let to_rules = receiver.is_some_and(|receiver| matches!(key(receiver), Some(Key::Rules | Key::Rule)));
        if names.has(Key::AddsRule) || names.has(Key::AddsToList) && to_rules {
            let mut rules = Rules::new(self.first_counts);
            match (index, &own[..]) {
                (Some(letter), [to]) => rules.one(Some(letter), to, None),
                _ => rules.arguments(&own, span.clone()),
            }
            if rules.found.is_empty() {
                return false;
            }
            // A key of a map has one value.
            let is_key = to_rules && own.len() == 2 && own[0].text().is_some();
            self.flat_rules(rules, span, false, is_key || function.to_ascii_lowercase().starts_with("set"));
            return true;
        }
        match (&own[..], receiver) {
            ([word, ..], _) if names.has(Key::SetsAxiom) && word.text().is_some() => {
                self.flat_axiom(word.text().unwrap_or_default(), span, true);
                true
            }
            ([angle], _) if names.has(Key::SetsAngle) && angle.number().is_some() => {
                let angle = angle_of(function, angle).unwrap_or(Angle::Unknown(0.0));
                self.flat_mut(span.start).angle = Some(Said::new(angle, span.clone()));
                self.extend(span);
                true
            }
            ([heading], _) if function == "rotate" && self.is_turtle_builder => {
                let Some(degrees) = heading.number() else { return false };
                self.flat_mut(span.start).heading = Some(Said::new(degrees, span.clone()));
                self.extend(span);
                true
            }
            ([n], _)
                if names.has(Key::Runs)
                    && (function != "step_by" || receiver.is_some())
                    && n.number().is_some_and(|n| n.fract() == 0.0 && n > 0.0) =>
            {
                let n = n.number().unwrap_or_default().to_string();
                if self.flat.said.is_some() {
                    self.flat_mut(span.start).iterations = Some(Said::new(n, span.clone()));
                    self.extend(span);
                } else if let [system] = &mut self.systems[..]
                    && system.iterations.is_none()
                {
                    system.iterations = Some(Said::new(n, span));
                }
                true
            }
            // `LSystem::new(..)`, `LSystem.create(..)`
            (_, Some(receiver)) if matches!(function, "new" | "create" | "build" | "init" | "from") => {
                self.constructor(receiver, arguments, span, "")
            }
            _ => self.constructor(function, arguments, span, ""),
        }
    }

    /// Reads `LSystem("FX", {"X": "F+X"})` and `new Grammar("X")`; whether it is one.
    fn constructor(&mut self, function: &str, arguments: &Node, span: Range<usize>, name: &str) -> bool {
        let lower = function.to_ascii_lowercase();
        if !MAKERS.iter().any(|part| lower.contains(part)) {
            return false;
        }
        let own = arguments.group().map(elements).unwrap_or_default();
        if arguments
            .group()
            .is_some_and(|inside| members(inside).iter().any(|member| key(&member.key) == Some(Key::Axiom)))
        {
            return false;
        }
        let mut words: Vec<&Value<'_>> =
            own.iter().filter(|value| value.text().is_some_and(|text| !is_prose(text))).collect();
        // An alphabet is no rule: `{"+", "-"}`.
        let is_alphabet = |value: &Value<'_>| {
            let own = value.elements();
            own.len() > 1 && own.iter().all(|one| one.text().is_some_and(|text| !text.contains(char::is_alphanumeric)))
        };
        let groups: Vec<&Value<'_>> =
            own.iter().filter(|value| value.items().is_some() && !is_alphabet(value)).collect();
        let mut rules = Rules::new(self.first_counts);
        groups.iter().for_each(|group| rules.all(group));
        // Of several words, the axiom is the only one with a letter that is replaced.
        if words.len() > 1 && !rules.found.is_empty() {
            let replaced: HashSet<char> = rules.found.iter().filter_map(|rule| rule.from.chars().next()).collect();
            words.retain(|word| word.text().is_some_and(|text| text.chars().any(|symbol| replaced.contains(&symbol))));
        }
        let [word] = words[..] else { return false };
        if rules.found.is_empty() {
            if groups.is_empty() {
                self.flat_axiom(word.text().unwrap_or_default(), span, true);
                return true;
            }
            return false;
        }
        let mut said = Statements::new(name, span.start, Symbols::Program);
        said.comments.push(span.start..arguments.span.start);
        said.extents.push(span);
        said.axiom = Some(Said::new(word.text().unwrap_or_default().to_owned(), word.span.clone()));
        rules.into(&mut said, false);
        for member in arguments.group().map(members).unwrap_or_default() {
            self.part(&mut said, &member);
        }
        // Of two numbers, a small whole one can only be the number of iterations, and a large one the angle.
        let numbers: Vec<(f64, &Value<'_>)> = own.iter().filter_map(|value| Some((value.number()?, value))).collect();
        let is_steps = |n: f64| n.fract() == 0.0 && (1.0..=12.0).contains(&n);
        let steps = match numbers[..] {
            [n, (degrees, place)] | [(degrees, place), n]
                if is_steps(n.0) && (15.0..=180.0).contains(&degrees) && said.angle.is_none() =>
            {
                said.angle = Some(Said::new(Angle::Degrees(degrees), place.span.clone()));
                Some(n)
            }
            [n] if lower == SUBSTITUTION => Some(n),
            _ => None,
        };
        match steps {
            Some((n, place)) => said.iterations = Some(Said::new(n.to_string(), place.span.clone())),
            None => {
                for (_, value) in numbers {
                    if said.angle.as_ref().is_none_or(|angle| angle.span.end != value.span.end) {
                        said.note(value.span.clone(), say!("The text does not say what this number is"));
                    }
                }
            }
        }
        self.systems.push(said);
        true
    }
}

#[cfg(test)]
mod tests;
