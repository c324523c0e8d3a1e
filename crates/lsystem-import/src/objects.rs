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

use crate::assembly::{Angle, Rule, Said, Statements, Symbols};
use crate::branches::{Branches, branches};
use crate::draft::Draft;
use crate::keys::{Key, key, letter_of};
use crate::rules::split_rule;
use crate::source::Source;
use crate::tokens::{Kind, Node, tree};
use crate::value::{Member, Unit, Value, What, elements, members};
use crate::words::{is_prose, weighted};
use core::ops::Range;
use lsystem_base::words;
use lsystem_base::{decimal, say, word};
use lsystem_syntax::{Diagnostic, parse};

/// Words of which a text without an axiom by that name has one.
const FIELD: [&str; 6] = ["axiom", "l-system", "lsystem", "lindenmayer", "l_system", "turtle"];
/// A weight of a random choice.
const WEIGHT: &[&str] = &["weight", "p", "prob", "probability", "chance", "w", "odds"];
/// A successor.
const TO: &[&str] = &[
    "successor",
    "out",
    "to",
    "output",
    "replacement",
    "replace",
    "b",
    "body",
    "value",
    "result",
    "string",
    "rule",
    "right",
    "production",
    "rhs",
    "e",
    "after",
    "then",
    "successors",
    "productions",
    "options",
    "next",
];
/// A predecessor.
const FROM: &[&str] = &[
    "predecessor",
    "in",
    "from",
    "input",
    "symbol",
    "a",
    "key",
    "letter",
    "char",
    "character",
    "left",
    "lhs",
    "head",
    "before",
    "match",
    "find",
    "variable",
    "name",
];

/// Parts of the names of functions that take an axiom and rules.
const MAKERS: [&str; 5] = ["lsys", "l_sys", "lindenmayer", "grammar", "derivation"];

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let lower = text.to_ascii_lowercase();
    let has = |words: &[&str]| words.iter().any(|word| lower.contains(word));
    let has_axiom = has(&["axiom", "start", "init", "omega", "seed", "s0"]);
    let has_rules = has(&["rule", "prod", "repl", "case", "==", "sub", "rewrit", "mapp", "transf"]);
    if !(has(&MAKERS) || has_axiom && has_rules) {
        return None;
    }
    let tree = tree(text);
    let mut reader = Reader {
        text,
        of_field: FIELD.iter().any(|word| lower.contains(word)),
        systems: Vec::new(),
        flat: Flat::default(),
        branches: branches(&tree.nodes),
    };
    reader.walk(&tree.nodes, "", &[]);
    reader.finish_flat();
    let Reader { mut systems, branches, .. } = reader;
    for system in &mut systems {
        if system.symbols == Symbols::Program {
            for (symbol, actions, span) in &branches.meanings {
                system.mean(*symbol, actions.clone(), span.clone());
            }
        }
    }
    // One more than the limit, which is then said.
    systems.truncate(crate::MAX_ENTRIES + 1);
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
            let called = nodes.get(at + 1).filter(|next| !next.is_first && matches!(next.kind, Kind::Group('(', _)));
            if let (Some(function), Some(arguments)) = (node.name(), called) {
                let receiver = match nodes.get(..at) {
                    Some([.., object, dot]) if dot.is(".") || dot.is("::") => object.name(),
                    _ => None,
                };
                let span = node.span.start..arguments.span.end;
                if self.call(function, receiver, arguments, span) {
                    at += 2;
                    continue;
                }
            }
            if let Kind::Group(_, inside) = &node.kind {
                let own = members(inside);
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
            if let Some(function) = function
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
                let mut rules = Rules::default();
                match member.index {
                    Some(index) if index.text().is_some() => {
                        rules.keyed(index.text().unwrap_or_default(), &member.value);
                    }
                    Some(_) => rules.listed(&member.value),
                    None if key == Key::Rule
                        && letter_of(&member.key).is_some()
                        && member.value.text().is_some_and(|text| split_rule(text).is_none()) =>
                    {
                        let letter = letter_of(&member.key).unwrap_or_default();
                        rules.keyed(letter.encode_utf8(&mut [0; 4]), &member.value);
                    }
                    // `rules_a = "FF"` says the letter; `rules = {...}` says all.
                    None if member.value.text().is_some() && letter_of(&member.key).is_some() => {
                        let letter = letter_of(&member.key).unwrap_or_default();
                        rules.keyed(letter.encode_utf8(&mut [0; 4]), &member.value);
                    }
                    None => rules.all(&member.value),
                }
                if rules.found.is_empty() && rules.lines.is_empty() {
                    return false;
                }
                let whole = member.index.is_none() && key == Key::Rules && letter_of(&member.key).is_none();
                self.flat_rules(rules, member.span.clone(), whole);
            }
            Key::Angle | Key::LeftAngle | Key::RightAngle | Key::LengthFactor | Key::Heading => {
                let Some(number) = member.value.number().filter(|number| *number != 0.0) else { return false };
                let angle = angle_of(&member.key, &member.value);
                let said = Said::new(angle.unwrap_or(Angle::Unknown(number)), member.span.clone());
                let differs =
                    |known: &Option<Said<Angle>>| known.as_ref().is_some_and(|known| known.value != said.value);
                let flat = self.flat_mut(member.span.start);
                match key {
                    Key::Angle if differs(&flat.angle) => {
                        let first = flat.angle.clone();
                        if flat.axiom.is_some() && !flat.rules.is_empty() {
                            self.next_flat();
                            self.flat_mut(member.span.start).angle = Some(said);
                        } else if let Some(first) = first {
                            contradict(self.flat_mut(member.span.start), &first.span, &member.span);
                        }
                    }
                    Key::Angle => flat.angle = Some(said),
                    Key::LeftAngle => flat.left = Some(said),
                    Key::RightAngle => flat.right = Some(said),
                    Key::LengthFactor => flat.factor = Some(Said::new(number, member.span.clone())),
                    _ => return false,
                }
                self.extend(member.span.clone());
            }
            Key::Iterations => {
                let Some(number) = member.value.number().filter(|n| n.fract() == 0.0 && *n > 0.0 && *n < 1e6) else {
                    return false;
                };
                let weak = matches!(member.key.as_str(), "n" | "i" | "steps" | "level" | "order" | "gen" | "size");
                if weak && !self.of_field {
                    return false;
                }
                let flat = self.flat_mut(member.span.start);
                if flat.iterations.is_none() {
                    flat.iterations = Some(Said::new(number.to_string(), member.span.clone()));
                    self.extend(member.span.clone());
                }
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
    fn call(&mut self, function: &str, receiver: Option<&str>, arguments: &Node, span: Range<usize>) -> bool {
        let Some(inside) = arguments.group() else { return false };
        let own = elements(inside);
        let name: String = function.chars().filter(|c| *c != '_').collect::<String>().to_ascii_lowercase();
        let to_rules = receiver.is_some_and(|receiver| matches!(key(receiver), Some(Key::Rules | Key::Rule)));
        let adds_rule = matches!(
            &*name,
            "addrule"
                | "setrule"
                | "rule"
                | "addproduction"
                | "production"
                | "withrule"
                | "addrules"
                | "newrule"
                | "defrule"
        );
        let fills = matches!(&*name, "put" | "insert" | "set" | "add" | "push" | "append" | "emplace" | "pushback");
        if adds_rule || fills && to_rules {
            let mut rules = Rules::default();
            rules.arguments(&own, span.clone());
            if rules.found.is_empty() {
                return false;
            }
            self.flat_rules(rules, span, false);
            return true;
        }
        match (&*name, &own[..]) {
            ("setaxiom" | "axiom" | "withaxiom" | "initiator" | "setstart" | "startwith", [word, ..])
                if word.text().is_some() =>
            {
                self.flat_axiom(word.text().unwrap_or_default(), span, true);
                true
            }
            ("setangle" | "angle" | "withangle" | "setturnangle" | "setdelta" | "turnangle", [angle])
                if angle.number().is_some() =>
            {
                let angle = angle_of(function, angle).unwrap_or(Angle::Unknown(0.0));
                self.flat_mut(span.start).angle = Some(Said::new(angle, span.clone()));
                self.extend(span);
                true
            }
            (
                "iterate" | "iterations" | "setiterations" | "generations" | "setdepth" | "withiterations" | "simulate"
                | "generate",
                [n],
            ) if n.number().is_some_and(|n| n.fract() == 0.0 && n > 0.0) => {
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
            ("new" | "create" | "build" | "init" | "from", _) if receiver.is_some() => {
                self.constructor(receiver.unwrap_or_default(), arguments, span, "")
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
        let words: Vec<&Value<'_>> =
            own.iter().filter(|value| value.text().is_some_and(|text| !is_prose(text))).collect();
        let groups: Vec<&Value<'_>> = own.iter().filter(|value| value.items().is_some()).collect();
        let Some(word) = words.last().filter(|_| words.len() <= 2) else { return false };
        let mut rules = Rules::default();
        groups.iter().for_each(|group| rules.all(group));
        if rules.found.is_empty() {
            if groups.is_empty() && words.len() == 1 {
                self.flat_axiom(word.text().unwrap_or_default(), span, true);
                return true;
            }
            return false;
        }
        let mut said = Statements::new(name, span.start, Symbols::Program);
        said.extents.push(span);
        said.axiom = Some(Said::new(word.text().unwrap_or_default().to_owned(), word.span.clone()));
        rules.into(&mut said);
        for member in arguments.group().map(members).unwrap_or_default() {
            self.part(&mut said, &member);
        }
        for value in &own {
            if value.number().is_some() && said.angle.as_ref().is_none_or(|angle| angle.span.end != value.span.end) {
                said.note(value.span.clone(), say!("The text does not say what this number is"));
            }
        }
        self.systems.push(said);
        true
    }

    fn flat_mut(&mut self, start: usize) -> &mut Statements {
        self.flat.said.get_or_insert_with(|| Statements::new("", start, Symbols::Program))
    }

    fn extend(&mut self, span: Range<usize>) {
        self.flat_mut(span.start).extents.push(span);
    }

    fn flat_axiom(&mut self, word: &str, span: Range<usize>, is_sure: bool) {
        if is_prose(word) {
            return;
        }
        let known = self.flat.said.as_ref().and_then(|said| said.axiom.clone());
        match known {
            Some(known) if known.value == word && self.flat_mut(span.start).rules.is_empty() => return,
            // What is called an axiom counts more than a start or a seed.
            Some(_) if self.flat.is_sure && !is_sure => return,
            Some(_) => self.next_flat(),
            None => {}
        }
        self.flat.is_sure = is_sure;
        self.flat_mut(span.start).axiom = Some(Said::new(word.to_owned(), span.clone()));
        self.extend(span);
    }

    fn flat_rules(&mut self, rules: Rules, span: Range<usize>, whole: bool) {
        // What stands before the rules themselves: `rules = {`, `rules.push(`.
        let first = rules.found.iter().map(|rule| rule.span.start).min().unwrap_or(span.end);
        if whole && self.flat.has_all_rules {
            self.next_flat();
        }
        self.flat.has_all_rules |= whole;
        self.extend(span.clone());
        self.flat_mut(span.start).comments.push(span.start..first.max(span.start));
        rules.into(self.flat_mut(span.start));
    }

    /// Ends the system of assignments, if it is one.
    fn next_flat(&mut self) {
        let Flat { said, is_sure, .. } = core::mem::take(&mut self.flat);
        let Some(mut said) = said else { return };
        if said.rules.is_empty() && said.axiom.is_some() && (is_sure || self.of_field) {
            for (symbol, word, span) in &self.branches.rules {
                said.rules.push(Rule { from: symbol.to_string(), to: word.clone(), weight: None, span: span.clone() });
                said.extents.push(span.clone());
            }
        }
        let strict = |rule: &Rule| rule.from.trim().chars().count() == 1;
        let Some(axiom) = &said.axiom else {
            // What stands behind a complete system belongs to it, and contradicts it if it says something else.
            if let (Some(last), Some(angle)) = (self.systems.last_mut(), &said.angle)
                && let Some(first) = last.angle.clone()
                && said.rules.is_empty()
            {
                contradict(last, &first.span, &angle.span);
            }
            return;
        };
        let occurs = |rule: &Rule| rule.from.trim().chars().next().is_some_and(|symbol| axiom.value.contains(symbol));
        let plausible = is_sure || !said.lines.is_empty() || self.of_field && said.rules.iter().any(occurs);
        if said.rules.is_empty() && said.lines.is_empty()
            || !(plausible || said.rules.iter().all(strict) && said.rules.iter().any(occurs))
        {
            return;
        }
        self.systems.push(said);
    }

    fn finish_flat(&mut self) {
        self.next_flat();
    }

    /// The system of an object; `None` if it is none.
    fn object(&self, own: &[Member<'_>], span: Range<usize>, name: &str, around: &[Member<'_>]) -> Option<Statements> {
        let of = |wanted: Key| own.iter().rev().find(|member| key(&member.key) == Some(wanted));
        let axiom = own.iter().rev().filter(|member| key(&member.key) == Some(Key::Axiom));
        let axiom = axiom.max_by_key(|member| is_sure(&member.key))?;
        let word = word_of(&axiom.value)?;
        let has_rules = own.iter().any(|member| match key(&member.key) {
            Some(Key::Rules) => match &member.value.what {
                // Not of `rules = new HashMap<>()`, which is filled later.
                What::Group(node, name) => {
                    let is_call = name.is_some() && node.group().is_some_and(<[Node]>::is_empty);
                    !is_call && is_of_symbols(&member.value)
                }
                What::Text(text) => text.contains(['=', '>', '→', ':']) || letter_of(&member.key).is_some(),
                _ => false,
            },
            Some(Key::Rule) => member.value.text().is_some() || member.value.items().is_some(),
            _ => false,
        });
        // The course's own form has a reader of its own.
        let ours = own.iter().any(|member| member.key == "initial")
            && own.iter().any(|member| matches!(&*member.key, "turtle" | "style" | "num_iters" | "angle_deg"));
        if !has_rules || ours || is_prose(&word) {
            return None;
        }
        let mut said = Statements::new(name, span.start, Symbols::Program);
        said.extents.push(span.clone());
        said.axiom = Some(Said::new(word, axiom.span.clone()));
        let theta = own.iter().any(|member| member.key == "theta");
        let is_lindsvg = theta
            && own.iter().any(|member| member.key == "axiom")
            && (own.iter().any(|member| member.key == "alpha") || self.text.contains("lindsvg"));
        if let Some(name) =
            own.iter().find(|member| key(&member.key) == Some(Key::Name)).and_then(|member| member.value.text())
        {
            name.clone_into(&mut said.name);
        }
        for member in own.iter().filter(|member| member.span != axiom.span) {
            if is_lindsvg && matches!(&*member.key, "alpha" | "theta" | "step") {
                continue;
            }
            self.part(&mut said, member);
        }
        if is_lindsvg {
            lindsvg(&mut said, own);
        } else {
            // What the object around says, as `{angle: 60, system: {axiom, rules}}`.
            for member in around {
                let (key, number) = (key(&member.key), member.value.number());
                let missing = match key {
                    Some(Key::Angle) => said.angle.is_none() && of(Key::Angle).is_none() && number.is_some(),
                    Some(Key::Iterations) => said.iterations.is_none() && number.is_some(),
                    Some(Key::Name) if said.name.is_empty() || said.name == name => {
                        member.value.text().unwrap_or(name).clone_into(&mut said.name);
                        false
                    }
                    _ => false,
                };
                if missing {
                    self.part(&mut said, member);
                }
            }
        }
        Some(said)
    }

    /// Reads a member of a system.
    fn part(&self, said: &mut Statements, member: &Member<'_>) {
        let (span, value) = (member.span.clone(), &member.value);
        said.comments.push(span.start..value.span.start);
        let key = key(&member.key);
        match key {
            Some(Key::Rules | Key::Rule) => {
                let mut rules = Rules::default();
                match (letter_of(&member.key), value.text()) {
                    (Some(letter), Some(text)) if split_rule(text).is_none() => {
                        // A key may write the letter small.
                        let axiom = said.axiom.as_ref().map_or("", |axiom| &axiom.value);
                        let large = letter.to_ascii_uppercase();
                        let is_small = !axiom.contains(letter) && axiom.contains(large);
                        let letter = if is_small { large } else { letter };
                        rules.keyed(letter.encode_utf8(&mut [0; 4]), value);
                    }
                    _ => rules.all(value),
                }
                rules.into(said);
            }
            Some(Key::Angle | Key::LeftAngle | Key::RightAngle) => {
                let angle = angle_of(&member.key, value);
                let Some(angle) = angle else { return said.refuse(span, say!("The angle is code, which is not read")) };
                let said_angle = Some(Said::new(angle, span.clone()));
                match key {
                    Some(Key::LeftAngle) => said.left = said_angle,
                    Some(Key::RightAngle) => said.right = said_angle,
                    // `alpha` beside `theta` is another angle.
                    _ if member.key == "alpha" && said.angle.is_some() => {
                        said.note(span, say!("`alpha` is not carried over"));
                    }
                    _ => said.angle = said_angle,
                }
            }
            Some(Key::Iterations) => match (value.number(), value.text()) {
                (Some(n), _) => said.iterations = Some(Said::new(n.to_string(), span)),
                (None, Some(text)) => said.iterations = Some(Said::new(text.to_owned(), span)),
                _ => said.note(span, say!("The number of iterations is code, which is not read")),
            },
            Some(Key::LengthFactor) if value.number().is_some() => {
                said.factor = value.number().map(|factor| Said::new(factor, span));
            }
            Some(Key::Name) if value.text().is_some() => said.note_name(span),
            Some(Key::Step) if value.number().is_some() => {
                said.note(span, say!("The length of a step changes only the size, which is fitted"));
            }
            Some(Key::Meanings) => {
                let known: Vec<&(char, String, Range<usize>)> =
                    self.branches.meanings.iter().filter(|(_, _, own)| span.contains(&own.start)).collect();
                if known.is_empty() {
                    said.note(span, say!("`{}` is not carried over", member.key));
                }
                for (symbol, actions, span) in known {
                    said.mean(*symbol, actions.clone(), span.clone());
                }
            }
            _ => said.note(value_span(member), say!("`{}` is not carried over", member.key)),
        }
    }
}

impl Statements {
    fn note_name(&mut self, span: Range<usize>) {
        let name = self.name.clone();
        self.names.push(Said::new(name, span));
    }
}

fn value_span(member: &Member<'_>) -> Range<usize> {
    if member.value.span.is_empty() { member.span.clone() } else { member.value.span.clone() }
}

/// Whether a bracket may hold rules: no keys, or keys for the sides of a rule, or predecessors.
fn is_of_symbols(value: &Value<'_>) -> bool {
    let own = value.members();
    let has = |keys: &[&str]| own.iter().any(|member| keys.contains(&&*member.key));
    let is_predecessor = |key: &str| (1..=2).contains(&key.trim().chars().count()) || key.contains(['<', '>', '(']);
    own.is_empty() || has(FROM) && has(TO) || own.iter().any(|member| is_predecessor(&member.key))
}

/// Whether a key can only be that of an axiom.
fn is_sure(key: &str) -> bool {
    key.to_ascii_lowercase().contains("axiom")
}

/// Refuses a system in which two statements contradict each other.
fn contradict(said: &mut Statements, first: &Range<usize>, second: &Range<usize>) {
    let why = say!("Two statements contradict each other");
    said.refuse(first.clone(), why.clone());
    said.refuse(second.clone(), why);
}

/// The word of a value: a string, or a list of symbols.
fn word_of(value: &Value<'_>) -> Option<String> {
    match &value.what {
        What::Text(text) => Some(text.clone()),
        What::Group(_, None | Some("list" | "Array" | "of" | "from" | "vec")) => {
            let parts = value.elements();
            let symbol = |part: &Value<'_>| part.text().filter(|text| text.chars().count() <= 2).map(str::to_owned);
            let word = parts.iter().map(symbol).collect::<Option<String>>();
            word.filter(|word| !word.is_empty())
        }
        _ => None,
    }
}

/// The angle of a member, with the unit that its value or its key says.
fn angle_of(key: &str, value: &Value<'_>) -> Option<Angle> {
    let lower = key.to_ascii_lowercase();
    let by_key = |number: f64| {
        if lower.contains("deg") {
            Angle::Degrees(number)
        } else if lower.contains("rad") && !lower.contains("grad") {
            Angle::Radians(number)
        } else {
            Angle::Unknown(number)
        }
    };
    match &value.what {
        What::Number(number, Unit::Radians) => Some(Angle::Radians(*number)),
        What::Number(number, Unit::Degrees) => Some(Angle::Degrees(*number)),
        What::Number(number, Unit::Unknown) => Some(by_key(*number)),
        What::Text(text) => {
            let trimmed = text.trim();
            if let Some(number) = decimal::read(trimmed) {
                return Some(by_key(number));
            }
            let (degrees, _, end) = crate::angle::angle(trimmed).ok()?;
            (end == trimmed.len()).then_some(Angle::Degrees(degrees))
        }
        _ => None,
    }
}

/// Sets the heading, the angle and the symbols of lindsvg. Its y goes down.
fn lindsvg(said: &mut Statements, own: &[Member<'_>]) {
    let of = |key: &str| own.iter().rev().find(|member| member.key == key);
    let degrees = |member: &Member<'_>| match member.value.what {
        What::Number(value, Unit::Degrees) => Some(value),
        What::Number(value, Unit::Radians) => Some(crate::angle::tidy(value.to_degrees())),
        What::Number(value, Unit::Unknown) if value.abs() <= 6.3 => Some(crate::angle::tidy(value.to_degrees())),
        What::Number(value, Unit::Unknown) => Some(value),
        _ => None,
    };
    match of("alpha").map(|member| (degrees(member), member.span.clone())) {
        Some((Some(alpha), span)) => said.heading = Some(Said::new(0.0 - alpha, span)),
        Some((None, span)) => said.refuse(span, say!("The angle alpha is code, which is not read")),
        None => said.heading = Some(Said::new(0.0, 0..0)),
    }
    match of("theta").map(|member| (degrees(member), member.span.clone())) {
        Some((Some(theta), span)) => said.angle = Some(Said::new(Angle::Degrees(theta), span)),
        Some((None, span)) => said.refuse(span, say!("The angle theta is code, which is not read")),
        None => {}
    }
    if let Some(step) = of("step") {
        said.note(step.span.clone(), say!("The length of a step changes only the size, which is fitted"));
    }
    if said.iterations.is_none() {
        said.iterations = Some(Said::new("3".to_owned(), 0..0));
    }
    said.symbols = Symbols::Said;
    let meanings = [("F", "draw"), ("B", "move"), ("+", "turn right"), ("-", "turn left")];
    for (symbol, actions) in meanings.into_iter().chain([("[", "open branch"), ("]", "close branch")]) {
        said.mean(symbol.chars().next().unwrap_or_default(), actions, 0..0);
    }
    // lindsvg drops letters without a rule at the next iteration.
    let words = said.rules.iter().map(|rule| &*rule.to).chain(said.axiom.iter().map(|axiom| &*axiom.value));
    let letters = lsystem_base::sorted::set(words.flat_map(str::chars));
    for letter in letters {
        let has_rule = said.rules.iter().any(|rule| rule.from.trim().starts_with(letter));
        if !"+-[]".contains(letter) && !letter.is_whitespace() && !has_rule {
            said.rules.push(Rule { from: letter.to_string(), to: String::new(), weight: None, span: 0..0 });
        }
    }
}

/// Whether a member has this key. Single letters are other keys in another case.
fn is_key(member: &Member<'_>, key: &str) -> bool {
    member.key == key || key.len() > 1 && member.key.eq_ignore_ascii_case(key)
}

/// Rules of any form.
#[derive(Default)]
struct Rules {
    found: Vec<Rule>,
    remarks: Vec<(Range<usize>, &'static str)>,
    /// Keys before alternatives.
    keys: Vec<Range<usize>>,
    /// Rules with parameters, as lines of our notation.
    lines: Vec<Said<String>>,
}

const CODE: &str = word!("This rule is code, which is not read");
const UNREAD: &str = word!("This rule cannot be read");

impl Rules {
    fn into(self, said: &mut Statements) {
        said.rules.extend(self.found);
        said.comments.extend(self.keys);
        said.lines.extend(self.lines);
        self.remarks.into_iter().for_each(|(span, why)| said.refuse(span, words::said(why)));
    }

    fn refuse(&mut self, span: &Range<usize>, why: &'static str) {
        self.remarks.push((span.clone(), why));
    }

    fn rule(&mut self, from: &str, to: &str, weight: Option<f64>, span: &Range<usize>) {
        let rule = Rule { from: from.trim().to_owned(), to: to.to_owned(), weight, span: span.clone() };
        self.found.push(rule);
    }

    /// All rules of a system.
    fn all(&mut self, value: &Value<'_>) {
        match &value.what {
            What::Text(text) => self.lines(text, &value.span),
            What::Group(node, _) => {
                let inside = node.group().unwrap_or_default();
                let own = members(inside);
                // Not of `{A: "B", B: "AB"}`.
                let has = |keys: &[&str]| own.iter().any(|member| member.key.len() > 1 && keys.contains(&&*member.key));
                let is_rule = has(FROM) && has(TO);
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
    fn listed(&mut self, value: &Value<'_>) {
        match &value.what {
            What::Text(text) => self.lines(text, &value.span),
            What::Group(node, _) => {
                let own = value.members();
                if own.is_empty() {
                    return self.arguments(&elements(node.group().unwrap_or_default()), value.span.clone());
                }
                let of = |keys: &[&str]| keys.iter().find_map(|key| own.iter().find(|member| is_key(member, key)));
                match (of(FROM).and_then(|member| member.value.text()), of(TO)) {
                    (Some(from), Some(to)) => {
                        let weight = of(WEIGHT).and_then(|member| member.value.number());
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
    fn arguments(&mut self, own: &[Value<'_>], span: Range<usize>) {
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
            [one] => match &one.what {
                What::Text(text) => self.lines(text, &span),
                What::Group(..) => self.listed(one),
                _ => self.refuse(&span, CODE),
            },
            _ => self.refuse(&span, UNREAD),
        }
    }

    /// Rules in the lines of a string.
    fn lines(&mut self, text: &str, span: &Range<usize>) {
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
                    let (to, weight) = weighted(to);
                    self.rule(from, to, weight, span);
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
    fn keyed(&mut self, key: &str, value: &Value<'_>) {
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
            let weight = of(WEIGHT).and_then(|member| member.value.number());
            return self.rule(&from, word, weight, &value.span);
        }
        // `{"F": {"FF": 0.5, "F": 0.5}}`, `{"F": {0.5: "FF"}}`
        if own.iter().all(|member| member.value.number().is_some()) {
            return own.iter().for_each(|member| self.rule(key, &member.key, member.value.number(), &member.span));
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
        if let [to, weight] = list
            && let (Some(to), Some(weight)) = (to.text(), weight.number())
        {
            return self.rule(key, to, Some(weight), span);
        }
        for one in list {
            let own = one.members();
            let of = |keys: &[&str]| keys.iter().find_map(|key| own.iter().find(|member| is_key(member, key)));
            let to = one.text().or_else(|| of(TO).and_then(|member| member.value.text()));
            if let Some(to) = to {
                let weight = of(WEIGHT).and_then(|member| member.value.number());
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

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn packages() {
        check(
            "var koch = new LSystem({\n  axiom: 'F++F++F',\n  productions: {'F': 'F-F++F-F'}\n})\nkoch.iterate(2)",
            expect![[r#"
                a program
                []
                n 2, angle 90, heading 90, abop
                  F++F++F
                  F -> F-F++F-F
                note 1 "": The text gives no angle; 90 degrees is chosen
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "new LSystem({axiom: 'X', productions: {'X': 'F-X', 'A<B>C': 'D', 'F': {successors: [{weight: 50, successor: 'FF'}, {weight: 50, successor: 'F'}]}}, finals: {'+': () => { ctx.rotate((Math.PI/180) * 60) }, 'F': function() { ctx.fillRect(0, 0, 10, 40) }}})",
            expect![[r#"
                a program
                []
                n 5, angle 60, heading 90, abop
                  X
                  X -> F-X
                  A < B > C -> D
                  F -> FF : 50
                  F -> F : 50
                  | -: turn left
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                note 1 "}, 'F': function() { ctx.fillRect(0, 0, …": This is not understood
                note 1 "": The text gives no number of iterations; 5 is chosen by the size"#]],
        );
        check(
            "let lsParams = {\n  axiom: \"A---A\", // start\n  rules: {\n    F: \"F\",\n    A: \"B-F+Z+F-BA\",\n    Z: \"F-FF\"\n  },\n  alpha: 90 * Math.PI / 180,\n  theta: Math.PI / 3,\n  step: 15,\n  iterations: 7,\n};",
            expect![[r#"
                a program
                [lsParams]
                n 7, angle 60, heading -90, abop
                  A---A
                  F -> F
                  A -> B-F+Z+F-BA
                  Z -> F-FF
                  B -> *
                  | +: turn right
                  | -: turn left
                  | B: move
                note 10 "step: 15": The length of a step changes only the size, which is fitted"#]],
        );
        check(
            "lindsvg.getSVGCode({axiom: 'F-F', rules: {}, theta: 1.0471975511965976})",
            expect![[r#"
                a program
                []
                n 3, angle 60, heading 0, abop
                  F-F
                  F -> *
                  | -: turn left"#]],
        );
    }

    #[test]
    fn functions_of_an_axiom_and_rules() {
        for text in [
            "derivation('X', {'F':'FF', 'X':'F[+X][-X]FX'})",
            "print(derivation(\"X\", {'F': 'FF', 'X': 'F[+X][-X]FX'}, 5))",
            "plant = LSystem(\"X\", {\"F\": \"FF\", \"X\": \"F[+X][-X]FX\"}, angle=25.7)",
        ] {
            let source = crate::import(text).unwrap_or_else(|| panic!("{text}"));
            let [entry] = &source.entries[..] else { panic!("{text}: {:?}", source.entries) };
            let definition = entry.definition.as_ref().unwrap_or_else(|| panic!("{text}: {:?}", entry.remarks));
            assert_eq!((&*definition.axiom, &*definition.rules), ("X", "F -> FF\nX -> F[+X][-X]FX"), "{text}");
        }
        assert_eq!(crate::import("the derivation(s) of it: {'a': 'b'}"), None);
    }

    #[test]
    fn forms_of_rules() {
        check(
            r#"{"start": "F", "rules": [{"in": "F", "out": "F+F"}], "angle": 60, "n": 3, "color": "red"}"#,
            expect![[r#"
                a program
                []
                n 3, angle 60, heading 90, abop
                  F
                  F -> F+F
                note 1 "\"red\"": `color` is not carried over
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            r#"{"axiom": "F", "rules": [["F", "F+F"], ["X", "F"]], "delta": "25.7", "depth": 3}"#,
            expect![[r#"
                a program
                []
                n 3, angle 25.7, heading 90, abop
                  F
                  F -> F+F
                  X -> F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "const tree = { axiom: 'F', rules: ['F -> F[+F]', 'X=>F'], angle: radians(25), generations: 4 }",
            expect![[r#"
                a program
                [tree]
                n 4, angle 25, heading 90, abop
                  F
                  F -> F[+F]
                  X -> F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "{axiom: 'F', rules: {F: [{p: 0.5, rule: 'FF'}, {p: 0.5, rule: 'F'}]}, angle: 0.5}",
            expect![[r#"
                a program
                []
                n 14, angle 28.647889757, heading 90, abop
                  F
                  F -> FF : 0.5
                  F -> F : 0.5
                note 1 "angle: 0.5": This angle is read as radians
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                note 1 "": The text gives no number of iterations; 14 is chosen by the size"#]],
        );
        check(
            "{axiom: 'A', rules: {A: 'B-A-B', B: 'A+B+A'}, angle: 60}",
            expect![[r#"
                a program
                []
                n 8, angle 60, heading 90, every-letter
                  A
                  A -> B-A-B
                  B -> A+B+A
                note 1 "": The text does not say what symbols do; here every letter draws, + turns left
                note 1 "": The text gives no number of iterations; 8 is chosen by the size"#]],
        );
        check(
            "axiom = \"F--F\"\nrules = {\"F\": \"F+F\"}\niters = 4\nangle=75",
            expect![[r#"
                a program
                []
                n 4, angle 75, heading 90, abop
                  F--F
                  F -> F+F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "const all = { koch: {axiom: 'F', rules: {F: 'F+F'}, angle: 60, n: 1}, other: {axiom: 'G', rules: {G: 'G-G'}, angle: 90, n: 2} };",
            expect![[r#"
                a program
                [koch]
                n 1, angle 60, heading 90, abop
                  F
                  F -> F+F
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left
                [other]
                n 2, angle 90, heading 90, abop
                  G
                  G -> G-G
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
    }

    #[test]
    fn refused() {
        check(
            "{axiom: 'F', rules: {F: () => 'FF'}, angle: 60, n: 1}",
            expect![[r#"
                a program
                []
                refused 1 "() => 'FF'": This rule is code, which is not read
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "{axiom: 'F', rules: {FX: 'FF'}, angle: a, n: 1}",
            expect![[r#"
                a program
                []
                refused 1 "angle: a": The angle is code, which is not read
                refused 1 "FX: 'FF'": The left side of a rule must be one symbol
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            "{axiom: 'F', rules: {F: {successor: 'FF', condition: () => true}}, angle: 60, n: 1}",
            expect![[r#"
                a program
                []
                refused 1 "() => true": Conditions are code, which is not read
                note 1 "": The text does not say what symbols do; here F and G draw, f moves, + turns left"#]],
        );
        check(
            r#"{"initial": "F", "rules": {"F": "F+F"}, "angle_deg": 60, "num_iters": 2}"#,
            expect![[r#"
                our own JSON
                []
                n 2, angle 60, heading 90, every-letter
                  F
                  F -> F+F"#]],
        );
        check(
            r#"{"initial": "F", "rules": ["F -> F+F"], "turtle": {}}"#,
            expect![[r#"
                our own JSON
                []
                n 1, angle 0, heading 90, abop
                  F
                  F -> F+F"#]],
        );
        check(
            r#"{"initial": "F", "rules": {"F": "FF"}"#,
            expect![[r#"
                our own JSON
                []
                refused 1 "{": This object is never closed. Add `}`."#]],
        );
    }
}
