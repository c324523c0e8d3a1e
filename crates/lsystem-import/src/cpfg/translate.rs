//! From the parts of a system to a definition in our notation.

use super::file::split;
use super::macros::{Replaced, is_part};
use super::parts::{Parts, Rule};
use super::recursion::{decompose, every_step, homomorphism};
use super::symbols::{Role, Symbols, parenthesised};
use super::{Kind, Places};
use crate::draft::Draft;
use core::ops::Range;
use lsystem_base::{counted, say, words::said};
use lsystem_syntax::parse;
use std::collections::BTreeSet;

/// The most bytes of a name.
pub(super) const LONGEST_NAME: usize = 60;
/// The most numbers with names.
const MAX_CONSTANTS: usize = 5000;
/// The most bytes of all rules.
const LONGEST: usize = 200_000;

pub(super) fn translate(parts: &Parts<'_>, places: &Places<'_>, draft: &mut Draft<'_>) {
    let axiom = parts.axiom.unwrap_or_default();
    if axiom.is_empty() {
        draft.refuse(1, "", say!("There is no axiom"));
    }
    let size = parts.all_rules().map(|rule| rule.head.len() + rule.successor.len()).sum::<usize>() + axiom.len();
    if size > LONGEST {
        draft.refuse(1, "", say!("The rules are too long"));
    }
    if parts.constants.len() > MAX_CONSTANTS {
        draft.refuse(1, "", say!("At most {} numbers with names are read", MAX_CONSTANTS));
    }
    if draft.is_refused() {
        // What is understood is told all the same.
        parts.all_rules().for_each(|rule| draft.read(rule.place.clone(), say!("a rule")));
        let others = [parts.axiom, parts.length].into_iter().flatten().chain(parts.seen.iter().map(|seen| seen.1));
        return others.for_each(|text| draft.read(places.of(text), text.to_owned()));
    }
    let mut names = parts.names.clone();
    for rule in parts.all_rules() {
        let name = name_of(strict(rule.head));
        if is_word(name, parts.arithmetic.kind) && name.len() <= LONGEST_NAME && names.len() < 500 {
            names.insert(name.to_owned());
        }
    }
    let mut symbols = Symbols::new(&parts.arithmetic, *places, &names, &parts.surfaces);
    let words = parts.all_rules().flat_map(|rule| [rule.head, &*rule.successor]);
    symbols.free.add_used(&words.chain([axiom]).collect::<String>());
    let mut known = BTreeSet::new();
    let several = parts.rules.iter().map(name_and_arity).filter(|name| !known.insert(name.clone()));
    let chosen = several.filter(|_| parts.is_stochastic).collect();
    let mut words = Translation { parts, places: *places, symbols, chosen };
    let axiom_place = places.of(axiom);
    draft.definition.axiom = protected(words.word(words.turned(axiom, draft), &axiom_place, draft));
    draft.read(axiom_place, say!("axiom {}", draft.definition.axiom));
    let mut lines = |rules: &[Rule<'_>], draft: &mut Draft<'_>| -> Vec<String> {
        rules.iter().filter_map(|rule| words.rule(rule, draft)).collect()
    };
    let mut rules = lines(&parts.rules, draft);
    let images = lines(&parts.images, draft);
    let decompositions = lines(&parts.decompositions, draft);
    rules.extend(words.of_surfaces(&rules));
    words.symbols.check_bare(draft);
    if words.symbols.has_tubes && parts.arithmetic.kind == Kind::LPy {
        // A line inside of a tube is a part of the tube. A move interrupts it.
        draft.meaning('F', "move, tube point");
        draft.meaning('f', "move, open tube");
    }
    let seen: Vec<String> = parts.seen.iter().map(|(word, list)| words.seen(word, list, draft)).collect();
    let mut used: BTreeSet<&str> = identifiers(&draft.definition.axiom).collect();
    used.extend([&rules[..], &images, &decompositions].into_iter().flatten().flat_map(|line| identifiers(line)));
    let code = &parts.every_step;
    used.extend(code.before.iter().chain(&code.after).flat_map(|(_, value)| identifiers(value)));
    let constants = parts.constants.iter().filter(|(name, _)| used.contains(name.as_str()));
    let mut text: Vec<String> = constants.map(|(name, value)| format!("{name} = {value}")).collect();
    let curves = parts.curves.iter().filter(|(name, _)| used.contains(name.as_str()));
    text.extend(curves.map(|(name, points)| format!("curve {name} = {points}")));
    let decompositions = [&text[..], &decompositions].concat().join("\n");
    text.extend(seen);
    text.extend(rules);
    if !images.is_empty() {
        text.push("draw:".to_owned());
        text.extend(images);
    }
    draft.definition.rules = text.join("\n");
    length(parts, places, draft);
    if draft.is_refused() {
        return;
    }
    every_step(parts, &decompositions, &mut words.symbols, draft);
    if let Some(place) = &parts.decomposed {
        decompose(parts, place, &decompositions, draft);
    }
    homomorphism(parts, draft);
    angle(parts, draft);
}

/// The translation of the parts.
struct Translation<'p> {
    parts: &'p Parts<'p>,
    places: Places<'p>,
    symbols: Symbols<'p>,
    /// The predecessors, as [`name_and_arity`] writes them, of several rules that are chosen from at random.
    chosen: BTreeSet<String>,
}

impl Translation<'_> {
    /// A word in our notation, with its macros replaced.
    fn word(&mut self, text: &str, place: &Range<usize>, draft: &mut Draft<'_>) -> String {
        match self.expanded(text) {
            Ok(None) => self.symbols.read(text, Role::Word, place, draft),
            Ok(Some(expanded)) => self.symbols.read(&expanded, Role::Word, place, draft),
            Err(why) => {
                draft.refuse_at(place.clone(), said(why));
                String::new()
            }
        }
    }

    /// A word with macros replaced where symbols stand; arithmetic is read later. `None` if there are none.
    fn expanded(&self, text: &str) -> Result<Option<String>, &'static str> {
        let macros = &self.parts.arithmetic.macros;
        let mut out = String::new();
        let mut rest = text;
        while !rest.is_empty() {
            let open = rest.find('(').unwrap_or(rest.len());
            let (word, behind) = rest.split_at(open);
            let Some((inside, behind)) = parenthesised(behind) else {
                out.push_str(rest);
                break;
            };
            // A macro with parameters takes its parentheses.
            let whole = &rest[..rest.len() - behind.len()];
            let name = word.trim_end().rsplit(|c: char| !is_part(c)).next().unwrap_or_default();
            if macros.has_parameters(name) && self.parts.arithmetic.kind == Kind::Cpfg {
                out.push_str(&macros.expand(whole, Replaced::All)?);
            } else {
                match self.parts.arithmetic.kind {
                    Kind::Cpfg => out.push_str(&macros.expand(word, Replaced::All)?),
                    Kind::LPy => out.push_str(word),
                }
                if let Some(inside) = inside {
                    out.extend(["(", inside, ")"]);
                }
            }
            rest = behind;
        }
        Ok((out != text).then_some(out))
    }

    /// The axiom without the places and headings that it begins with, which become the heading of the definition.
    fn turned<'t>(&self, axiom: &'t str, draft: &mut Draft<'_>) -> &'t str {
        let mut rest = axiom.trim_start();
        while self.parts.arithmetic.kind == Kind::Cpfg
            && let Some(behind) = rest.strip_prefix("@M").or_else(|| rest.strip_prefix("@R"))
            && let Some((Some(inside), behind)) = parenthesised(behind)
        {
            let place = self.places.of(&rest[..rest.len() - behind.len()]);
            if rest.starts_with("@M") {
                let values: Option<Vec<f64>> =
                    inside.split(',').map(|value| self.parts.arithmetic.value(value)).collect();
                let asks = self.parts.all_rules().any(|rule| rule.head.contains("?P"));
                match values.as_deref() {
                    Some(&[x, y] | &[x, y, 0.0]) => {
                        draft.definition.start = [x, y];
                        draft.read(place, say!("start {}, {}", x, y));
                    }
                    _ if asks => draft.refuse_at(place, say!("Queries of positions need a start in the plane z = 0")),
                    _ => draft.note_at(
                        place,
                        say!("The place where the turtle starts is not carried over; it only moves the picture"),
                    ),
                }
            } else {
                let values: Option<Vec<f64>> =
                    inside.split(',').map(|value| self.parts.arithmetic.value(value)).collect();
                let (x, y) = match values.as_deref() {
                    Some(&[x, y] | &[x, y, 0.0]) if x != 0.0 || y != 0.0 => (x, y),
                    _ => break,
                };
                draft.definition.heading = libm::atan2(y, x).to_degrees();
                draft.read(place, say!("heading {}", draft.definition.heading));
            }
            rest = behind.trim_start();
        }
        rest
    }

    /// The rules for surfaces that rules of their letters are: in cpfg, `~b` is two modules, and `b(s) --> b(2*s)` makes a
    /// surface of twice the size.
    fn of_surfaces(&self, rules: &[String]) -> Vec<String> {
        let surfaces: Vec<(char, char)> = self.symbols.surface_letters().collect();
        let of = |rule: &String| {
            let (head, successor) = rule.split_once(" --> ")?;
            let (letter, own) = surfaces.iter().find(|(letter, _)| strict(head).starts_with(*letter))?;
            let is_bare = !head.contains(['<', '>']) && head.starts_with(*letter);
            let behind = successor.strip_prefix(*letter).filter(|_| is_bare)?;
            Some(format!("{own}{} --> {own}{behind}", &head[letter.len_utf8()..]))
        };
        rules.iter().filter_map(of).collect()
    }

    /// A rule in our notation; `None` if it is refused.
    fn rule(&mut self, rule: &Rule<'_>, draft: &mut Draft<'_>) -> Option<String> {
        if self.never_applies(rule) {
            draft.note_at(
                rule.place.clone(),
                say!("This rule never applies: nothing makes a symbol of its predecessor"),
            );
            return None;
        }
        let read = self.read(rule, draft);
        let line = read.map_err(|(part, why)| draft.refuse_at(self.places.or(part, &rule.place), why)).ok();
        draft.read(rule.place.clone(), line.clone().unwrap_or_else(|| say!("a rule")));
        line
    }

    /// Whether the predecessor is a group with a letter that stands in no word.
    fn never_applies(&self, rule: &Rule<'_>) -> bool {
        let strict = strict(rule.head);
        let name = name_of(strict);
        let letters = strict[..name.len()].chars().filter(|c| c.is_alphabetic());
        let words = || self.parts.all_rules().map(|rule| &*rule.successor).chain(self.parts.axiom);
        let is_group = self.parts.arithmetic.kind == Kind::Cpfg && name.len() > 1 && !is_word(name, Kind::Cpfg);
        is_group
            && self.parts.arithmetic.macros.expand(name, Replaced::All).is_ok_and(|own| own == name)
            && letters.into_iter().any(|letter| !words().any(|word| word.contains(letter)))
    }

    fn read<'r>(&mut self, rule: &'r Rule<'_>, draft: &mut Draft<'_>) -> Result<String, (&'r str, String)> {
        let mut head = self.symbols.read(rule.head, Role::Head, &rule.place, draft);
        if self.parts.arithmetic.kind == Kind::Cpfg {
            head = open_ended(&head);
        }
        let strict = strict(&head);
        let wrong = match () {
            () if strict.is_empty() => say!("This rule has no predecessor"),
            () if modules(strict) != 1 => say!("Several symbols as predecessor have no equal here"),
            () if contexts(&head).any(|context| context.contains('=')) => {
                say!("`=` in a context is read only in front of `]`")
            }
            () => String::new(),
        };
        if !wrong.is_empty() {
            return Err((rule.head, wrong.to_owned()));
        }
        let mut line = protected(head);
        let arithmetic = &self.parts.arithmetic;
        let condition = arithmetic.read(&rule.condition).map_err(|why| (&*rule.condition, why))?;
        if !matches!(&*condition, "" | "*" | "1") {
            line.extend([" : ", &condition]);
        }
        line.extend([" --> ", &self.word(&rule.successor, &rule.place, draft)]);
        if let Some(weight) = rule.weight {
            line.extend([" : ", &arithmetic.read(weight).map_err(|why| (weight, why))?]);
        } else if self.chosen.contains(name_and_arity(rule).as_str()) {
            line.push_str(" : 1");
        }
        Ok(line.trim_end().to_owned())
    }

    /// The list of symbols that contexts skip or see.
    fn seen(&mut self, word: &str, list: &str, draft: &mut Draft<'_>) -> String {
        let place = self.places.of(list);
        draft.read(place.clone(), format!("{word}: {list}"));
        // The symbols that stand for a surface are skipped and seen as `~` is.
        let mut list = match self.parts.arithmetic.kind {
            Kind::Cpfg => list.to_owned(),
            Kind::LPy => self.symbols.read(list, Role::Word, &place, draft),
        };
        if list.contains('~') {
            list.extend(self.symbols.surfaces());
        }
        format!("{word}: {list}")
    }
}

/// The strict predecessor of a head, with its arguments.
fn strict(head: &str) -> &str {
    let from = split(head, '<').map_or(0, |at| at + 1);
    let rest = &head[from..];
    rest[..split(rest, '>').unwrap_or(rest.len())].trim()
}

/// The strict predecessor with the number of its parameters.
fn name_and_arity(rule: &Rule<'_>) -> String {
    let strict = strict(rule.head);
    let (name, parameters) = strict.split_once('(').unwrap_or((strict, ""));
    format!("{} {}", name.trim(), if parameters.is_empty() { 0 } else { parameters.split(',').count() })
}

/// The contexts of a head.
fn contexts(head: &str) -> impl Iterator<Item = &str> {
    let left = split(head, '<').map_or("", |at| &head[..at]);
    let right = split(head, '>').map_or("", |at| &head[at + 1..]);
    [left, right].into_iter()
}

/// A head without the `=` at the end of branches in contexts. It stands for the rest of the branch, which branches of our
/// contexts have anyway.
fn open_ended(head: &str) -> String {
    let mut parts = head.split('=');
    let mut out = parts.next().unwrap_or_default().trim_end().to_owned();
    for part in parts {
        if !part.trim_start().starts_with(']') {
            out.push('=');
        }
        out.push_str(part);
    }
    out
}

/// The letters and digits at the start.
fn name_of(text: &str) -> &str {
    &text[..text.find(|c: char| !is_part(c)).unwrap_or(text.len())]
}

/// Whether a predecessor is a name for one symbol. In cpfg it is a group of symbols by the letter, which makes no
/// difference for a name that stands only as a whole.
fn is_word(name: &str, kind: Kind) -> bool {
    let mut letters = name.chars();
    let Some(first) = letters.next().filter(|first| first.is_alphabetic()) else { return false };
    let draws = matches!(first, 'F' | 'f' | 'G' | 'g');
    letters.as_str().contains(|c: char| c.is_lowercase() || c == '_')
        || (!letters.as_str().is_empty() && letters.all(|c| c.is_ascii_digit()) && (kind == Kind::LPy || !draws))
}

/// The number of symbols of a word in our notation.
fn modules(word: &str) -> usize {
    let mut count = 0;
    let mut rest = word;
    while let Some(ch) = rest.chars().next() {
        // A query has two characters, `?` and its letter.
        let is_half = ch == '?' && rest.get(2..).is_some_and(|arguments| arguments.starts_with('('));
        count += usize::from(!ch.is_whitespace() && !is_half);
        let behind = &rest[ch.len_utf8()..];
        rest = parenthesised(behind).map_or("", |(_, behind)| behind);
    }
    count
}

/// A word that does not begin like a comment.
fn protected(word: String) -> String {
    match word.strip_prefix(['/', '#']) {
        Some(rest) if word.starts_with('#') || rest.starts_with('/') => format!("`{}`{rest}", &word[..1]),
        _ => word,
    }
}

/// The names in a text.
fn identifiers(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !is_part(c)).filter(|word| !word.is_empty())
}

/// Takes over the derivation length.
fn length(parts: &Parts<'_>, places: &Places<'_>, draft: &mut Draft<'_>) {
    let Some(text) = parts.length else { return };
    let place = places.of(text);
    match parts.arithmetic.value(text) {
        Some(value) => {
            let line = draft.source.line_of(place.start);
            draft.iterations(line, &value.to_string());
            draft.read(place, counted!(draft.definition.iterations, "{} iteration", "{} iterations"));
        }
        None => draft.note_at(place, say!("The derivation length cannot be read")),
    }
}

/// Sets the angle. That of cpfg stands in another file.
fn angle(parts: &Parts<'_>, draft: &mut Draft<'_>) {
    let kind = parts.arithmetic.kind;
    let (grammar, _) = parse(&draft.definition.axiom, &draft.definition.rules);
    let mut made = grammar.made().chain(grammar.images.iter().flat_map(|image| &image.successor));
    let turns = made.any(|module| module.arguments.is_empty() && "+-&^/\\".contains(module.symbol));
    match (parts.angle, kind) {
        (Some(angle), _) => draft.definition.angle = angle,
        (None, Kind::Cpfg) => {
            draft.definition.angle = 90.0;
            if turns {
                draft.note(1, "", say!("The angle stands in cpfg's view file; 90 degrees is chosen"));
            }
        }
        (None, Kind::LPy) => {
            draft.definition.angle = 60.0;
            if turns {
                draft.note(1, "", say!("The text gives no angle; 60 degrees is the default of L-Py"));
            }
        }
    }
    match kind {
        Kind::Cpfg => draft.meaning('\'', ""),
        Kind::LPy => {
            // Rolls have the other names, and only `F` and `f` go forward.
            draft.meaning('/', "roll left");
            draft.meaning('\\', "roll right");
            draft.meaning('_', "thicker");
            ['\'', 'G', 'g'].into_iter().for_each(|symbol| draft.meaning(symbol, ""));
        }
    }
}
