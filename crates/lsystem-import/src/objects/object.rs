//! An object with an axiom and rules.

use super::Reader;
use super::rules::Rules;
use crate::assembly::{Angle, EARLIER, Rule, Said, Statements, Symbols, sides};
use crate::draft::turtle;
use crate::prose_words::is_prose;
use crate::rules::split_rule;
use crate::tokens::Node;
use crate::value::{Member, Unit, Value, What};
use crate::vocabulary::{Key, key, letter_of, words};
use core::ops::Range;
use lsystem_base::{decimal, say};
use std::collections::{HashMap, HashSet};

impl Reader<'_> {
    /// The system of an object; `None` if it is none.
    pub(super) fn object(
        &self,
        own: &[Member<'_>],
        span: Range<usize>,
        name: &str,
        around: &[Member<'_>],
    ) -> Option<Statements> {
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
        let last: HashMap<&str, usize> = own.iter().enumerate().map(|(at, member)| (&*member.key, at)).collect();
        for (at, member) in own.iter().enumerate().filter(|(_, member)| member.span != axiom.span) {
            if last.get(&*member.key) != Some(&at) && key(&member.key) != Some(Key::Rule) {
                said.note(member.span.clone(), say!("A later `{}` replaces this one", member.key));
                continue;
            }
            if is_lindsvg && member.key == "alpha" {
                continue;
            }
            self.part(&mut said, member);
        }
        // The package lsys of Python.
        if self.text[..span.start].ends_with("Lsys") {
            said.keep_one(true);
        }
        if own.iter().any(|member| member.key == "productions") {
            lindenmayer(&mut said);
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
    pub(super) fn part(&self, said: &mut Statements, member: &Member<'_>) {
        let (span, value) = (member.span.clone(), &member.value);
        said.comments.push(span.start..value.span.start);
        let key = key(&member.key);
        match key {
            Some(Key::Rules | Key::Rule) => {
                let mut rules = Rules::new(self.first_counts);
                match (letter_of(&member.key), value.text()) {
                    (Some(letter), Some(text)) if split_rule(text).is_none() => {
                        // A key may write the letter small.
                        let axiom = said.axiom.as_ref().map_or("", |axiom| &axiom.value);
                        let large = letter.to_ascii_uppercase();
                        let is_small = !axiom.contains(letter) && axiom.contains(large);
                        let letter = if is_small { large } else { letter };
                        rules.rule(letter.encode_utf8(&mut [0; 4]), text, None, &value.span);
                    }
                    _ => rules.all(value),
                }
                rules.into(said, false);
            }
            Some(Key::Angle | Key::LeftAngle | Key::RightAngle) => {
                let angle = angle_of(&member.key, value);
                let Some(angle) = angle else { return said.refuse(span, say!("The angle is code, which is not read")) };
                if said.angle.is_some() && value.number() == Some(0.0) {
                    said.note(span, say!("`{}` is not carried over", member.key));
                } else {
                    said.say_angle(key.unwrap_or(Key::Angle), &member.key, Said::new(angle, span));
                }
            }
            Some(Key::Iterations) => match (value.number(), value.text()) {
                (Some(n), _) => said.iterations = Some(Said::new(n.to_string(), span)),
                (None, Some(text)) => said.iterations = Some(Said::new(text.to_owned(), span)),
                _ => said.note(span, say!("The number of iterations is code, which is not read")),
            },
            Some(Key::Ignore) if let Some(symbols) = value.text() => {
                said.lines.push(Said::new(format!("ignore: {symbols}"), span));
            }
            Some(Key::LengthFactor) if value.number().is_some() => {
                said.factor = value.number().map(|factor| Said::new(factor, span));
            }
            Some(Key::Name) if value.text().is_some() => said.note_name(span),
            Some(Key::Step) if value.number().is_some() => {
                said.note(span, say!("The length of a step changes only the size, which is fitted"));
            }
            Some(Key::Meanings) if member.key == "draw" && word_of(value).is_some() => {
                let letters = word_of(value).unwrap_or_default();
                letters.chars().for_each(|letter| said.mean(letter, "draw", span.clone()));
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
pub(super) fn is_of_symbols(value: &Value<'_>) -> bool {
    let own = value.members();
    let has = |keys: &[&str]| own.iter().any(|member| keys.contains(&&*member.key));
    let is_predecessor = |key: &str| (1..=2).contains(&key.trim().chars().count()) || key.contains(['<', '>', '(']);
    own.is_empty()
        || has(words(Key::Predecessor)) && has(words(Key::Successor))
        || own.iter().any(|member| is_predecessor(&member.key))
}

/// Whether a key can only be that of an axiom.
pub(super) fn is_sure(key: &str) -> bool {
    key.to_ascii_lowercase().contains("axiom")
}

/// The word of a value: a string, or a list of symbols.
pub(super) fn word_of(value: &Value<'_>) -> Option<String> {
    match &value.what {
        What::Text(text) => Some(text.clone()),
        What::Group(_, None | Some("list" | "Array" | "of" | "from" | "vec")) => {
            let parts = value.elements();
            let symbol = |part: &Value<'_>| part.text().filter(|text| text.chars().count() <= 2).map(str::to_owned);
            let word = parts.iter().map(symbol).collect::<Option<String>>();
            let own = value.members();
            // `{string: "F", generation: 0}`
            let mut named = own.iter().filter(|member| words(Key::Successor).contains(&&*member.key));
            let inner = named.next().and_then(|member| member.value.text()).map(str::to_owned);
            inner.or(word.filter(|word| !word.is_empty()))
        }
        _ => None,
    }
}

/// The angle of a member, with the unit that its value or its key says.
pub(super) fn angle_of(key: &str, value: &Value<'_>) -> Option<Angle> {
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

/// The order and the contexts of the package lindenmayer: keys that are whole numbers come first, an earlier rule without a
/// context hides later ones of its symbol, and contexts skip `+-&^/|\`.
pub(super) fn lindenmayer(said: &mut Statements) {
    lsystem_base::sorted::sort_by_key(&mut said.rules, |rule| rule.from.parse::<u32>().is_err());
    let mut always: HashMap<String, String> = HashMap::new();
    said.leave_out(EARLIER, |rule| {
        let [left, symbol, right] = sides(&rule.from).map(str::trim);
        let is_hidden = always.get(symbol).is_some_and(|from| *from != rule.from);
        if !is_hidden && left.is_empty() && right.is_empty() {
            always.insert(symbol.to_owned(), rule.from.clone());
        }
        is_hidden
    });
    let empty: Vec<Range<usize>> =
        said.rules.iter().filter(|rule| rule.to.is_empty()).map(|rule| rule.span.clone()).collect();
    for span in empty {
        said.note(span, say!("Here this symbol vanishes; in the package lindenmayer it stays"));
    }
    let has_contexts = said.rules.iter().any(|rule| sides(&rule.from)[1] != rule.from);
    said.lines.retain(|line| has_contexts || !line.value.starts_with("ignore:"));
    if has_contexts && said.lines.is_empty() {
        said.lines.push(Said::new("ignore: +-&^/|\\".to_owned(), 0..0));
    }
}

/// Sets the heading, the angle and the symbols of lindsvg. Its y goes down.
pub(super) fn lindsvg(said: &mut Statements, own: &[Member<'_>]) {
    let of = |key: &str| own.iter().rev().find(|member| member.key == key);
    let degrees = |member: &Member<'_>| match member.value.what {
        What::Number(value, Unit::Degrees) => Some(value),
        What::Number(value, Unit::Radians) => Some(crate::angle::tidy(value.to_degrees())),
        What::Number(value, Unit::Unknown) => crate::angle::by_value(value).ok().map(|(degrees, _)| degrees),
        _ => None,
    };
    match of("alpha").map(|member| (degrees(member), member.span.clone())) {
        Some((Some(alpha), span)) => said.heading = Some(Said::new(0.0 - alpha, span)),
        Some((None, span)) => said.refuse(span, say!("The angle alpha is code, which is not read")),
        None => said.heading = Some(Said::new(0.0, 0..0)),
    }
    if let Some(Said { value, .. }) = &mut said.angle
        && let Angle::Unknown(number) = *value
        && let Ok((degrees, _)) = crate::angle::by_value(number)
    {
        *value = Angle::Degrees(degrees);
    }
    if said.iterations.is_none() {
        said.iterations = Some(Said::new("3".to_owned(), 0..0));
    }
    said.symbols = Symbols::Said;
    turtle("lindsvg").for_each(|(symbol, actions)| said.mean(symbol, actions, 0..0));
    // lindsvg drops letters without a rule at the next iteration.
    let words = said.rules.iter().map(|rule| &*rule.to).chain(said.axiom.iter().map(|axiom| &*axiom.value));
    let letters = lsystem_base::sorted::set(words.flat_map(str::chars));
    let replaced: HashSet<char> = said.rules.iter().filter_map(|rule| rule.from.trim().chars().next()).collect();
    for letter in letters {
        if !"+-[]".contains(letter) && !letter.is_whitespace() && !replaced.contains(&letter) {
            said.rules.push(Rule { from: letter.to_string(), to: String::new(), weight: None, span: 0..0 });
        }
    }
}

/// Whether a member has this key. Single letters are other keys in another case.
pub(super) fn is_key(member: &Member<'_>, key: &str) -> bool {
    member.key == key || key.len() > 1 && member.key.eq_ignore_ascii_case(key)
}
