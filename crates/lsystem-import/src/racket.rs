//! Racket's `#lang lindenmayer`.
//!
//! ```text
//! #lang lindenmayer racket
//! ## axiom ##
//! F
//! ## rules ##
//! F -> FF-
//!      [-F+F+F]
//! ## variables ##
//! n=4
//! θ=22.5
//! ```
//!
//! Several systems are separated by a line of `-`. Racket code follows a line of `=`; it decides what the symbols do and
//! is not run. With the library `lindenmayer/turtle` the symbols are known: F draws and f moves by 2, the numbers of `+`
//! and `-` are factors of θ, and `!` sets the width. Of other code, definitions of a symbol that does nothing or the same
//! as another one are read.

use crate::MAX_ENTRIES;
use crate::draft::{Draft, turtle};
use crate::rules::split_rule;
use crate::source::Source;
use crate::value::whole_number;
use lsystem_base::{decimal, say};
use std::collections::{BTreeSet, HashMap};

/// A system: its first line and its lines that are not empty.
type Part<'a> = (usize, Vec<&'a str>);

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let first = text.lines().find(|line| !line.trim().is_empty())?;
    let has = |name: &str| text.lines().any(|line| heading(line).is_some_and(|found| found == name));
    if !(first.trim().starts_with("#lang lindenmayer") || has("axiom") && has("rules")) {
        return None;
    }
    let is_rule_of = |line: &str, mark: char| line.len() >= 3 && line.chars().all(|c| c == mark);
    let mut parts: Vec<Part<'_>> = vec![(1, Vec::new())];
    let mut code = "";
    let mut offset = 0;
    for (at, line) in text.split('\n').enumerate() {
        offset += line.len() + 1;
        let trimmed = line.trim();
        if is_rule_of(trimmed, '=') {
            code = text.get(offset..).unwrap_or_default();
            break;
        }
        if is_rule_of(trimmed, '-') {
            parts.push((at + 2, Vec::new()));
        } else if !trimmed.is_empty()
            && !trimmed.starts_with("#lang")
            && let Some(part) = parts.last_mut()
        {
            part.1.push(trimmed);
        }
    }
    let code = Code::new(code.trim());
    parts.retain(|part| !part.1.is_empty());
    parts.truncate(MAX_ENTRIES + 1);
    let mut drafts: Vec<Draft<'_>> = parts.iter().map(|(line, lines)| system(source, *line, lines, &code)).collect();
    if let Some(first) = drafts.first_mut() {
        code.account(first);
    }
    Some(drafts)
}

/// The Racket code behind the systems.
struct Code<'a> {
    text: &'a str,
    /// Whether the symbols are those of `lindenmayer/turtle`.
    library: bool,
    /// The first positive number of degrees that the code turns by.
    turn: Option<f64>,
    /// The expressions outside of others.
    forms: Vec<&'a str>,
    /// The last definition of each symbol.
    definitions: HashMap<char, Defined>,
}

/// What a definition says about a symbol.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Defined {
    /// It does the same as another symbol.
    Same(char),
    Nothing,
    /// Code that is not run.
    Other,
}

impl<'a> Code<'a> {
    fn new(code: &'a str) -> Self {
        // `(define (+ turtles variables) (turn 90 turtles))`
        let turns = code.split("(turn ").skip(1).filter_map(|rest| decimal::read(rest.split([' ', ')']).next()?));
        let forms = forms(code);
        Self {
            text: code,
            library: code.contains("lindenmayer/turtle") || code.is_empty(),
            turn: turns.into_iter().find(|angle| *angle > 0.0 && angle.is_finite()),
            definitions: forms.iter().filter_map(|form| definition(form)).collect(),
            forms,
        }
    }

    /// The actions of a symbol with the library, and whether code decides them that is not run.
    fn actions(&self, symbol: char) -> (&'static str, bool) {
        let mut symbol = symbol;
        // More definitions than this in a row form a circle.
        for _ in 0..16 {
            match self.definitions.get(&symbol) {
                Some(Defined::Same(other)) => symbol = *other,
                Some(Defined::Nothing) => return ("", false),
                other => {
                    let known = turtle("Racket").find(|(known, _)| *known == symbol);
                    return (known.map_or("", |(_, actions)| actions), other.is_some());
                }
            }
        }
        ("", true)
    }

    /// What becomes of the code with the library, as parts of the first system.
    fn account(&self, draft: &mut Draft<'a>) {
        if !self.library {
            return;
        }
        for form in &self.forms {
            let place = draft.place(form);
            match definition(form) {
                Some((symbol, Defined::Same(other))) => {
                    draft.read(place, say!("{} does the same as {}", symbol, other));
                }
                Some((symbol, Defined::Nothing)) => draft.read(place, say!("{} does nothing", symbol)),
                _ if ["(require", "(provide"].iter().any(|word| form.starts_with(word)) => draft.pass(place),
                _ => draft.note_at(place, say!("This Racket code is not run")),
            }
        }
    }
}

/// The expressions of Racket code that are not inside another one.
fn forms(code: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let (mut depth, mut start) = (0_usize, 0);
    let mut rest = code.char_indices();
    while let Some((at, ch)) = rest.next() {
        match ch {
            ';' => drop(rest.find(|(_, ch)| *ch == '\n')),
            '|' => drop(rest.find(|(_, ch)| *ch == '|')),
            '\\' => drop(rest.next()),
            '"' => {
                while let Some((_, ch)) = rest.next().filter(|(_, ch)| *ch != '"') {
                    if ch == '\\' {
                        rest.next();
                    }
                }
            }
            '(' | '[' | '{' => {
                start = if depth == 0 { at } else { start };
                depth += 1;
            }
            ')' | ']' | '}' if depth > 0 => {
                depth -= 1;
                if depth == 0 {
                    found.push(&code[start..=at]);
                }
            }
            _ => {}
        }
    }
    if depth > 0 {
        found.push(&code[start..]);
    }
    found
}

/// The symbol that a form defines, as in `(define G F)` or `(define (X turtles variables) turtles)`.
fn definition(form: &str) -> Option<(char, Defined)> {
    let inside = form.strip_prefix("(define")?.strip_suffix(')')?;
    let inside = inside.starts_with([' ', '\t', '\n', '\r', '(']).then(|| inside.trim())?;
    if let Some(head) = inside.strip_prefix('(') {
        let (name, rest) = name(head)?;
        let (parameters, body) = rest.split_once(')')?;
        let turtles = parameters.split_whitespace().next()?;
        let mut code = body.lines().map(|line| line.split(';').next().unwrap_or_default().trim());
        let is_nothing = code.find(|line| !line.is_empty()) == Some(turtles) && code.all(str::is_empty);
        return Some((name, if is_nothing { Defined::Nothing } else { Defined::Other }));
    }
    let (symbol, value) = name(inside)?;
    let is_same = name(value.trim()).filter(|(_, rest)| rest.trim().is_empty());
    Some((symbol, is_same.map_or(Defined::Other, |(other, _)| Defined::Same(other))))
}

/// The name of one character at the start of a text, such as `F` or `|[|`, and the text behind.
fn name(text: &str) -> Option<(char, &str)> {
    let quoted = text.strip_prefix('|');
    let mut chars = quoted.unwrap_or(text).chars();
    let name = chars.next().filter(|ch| quoted.is_some() || !"()[]\"'`,;#".contains(*ch))?;
    let rest = chars.as_str();
    let rest = if quoted.is_some() { rest.strip_prefix('|')? } else { rest };
    (rest.is_empty() || rest.starts_with(char::is_whitespace) || rest.starts_with(')')).then_some((name, rest))
}

/// The name of a section: `## axiom ##`, with any number of marks.
fn heading(line: &str) -> Option<&str> {
    let name = line.trim().strip_prefix('#')?.strip_suffix('#')?.trim_matches('#').trim();
    (!name.is_empty() && name.chars().all(char::is_alphabetic)).then_some(name)
}

fn system<'a>(source: Source<'a>, line: usize, lines: &[&'a str], code: &Code<'a>) -> Draft<'a> {
    let mut draft = Draft::new(source, "", line);
    let library = code.library;
    let (mut section, mut axiom) = ("", String::new());
    let mut rules: Vec<String> = Vec::new();
    let mut variables: Vec<(&str, &str, &str)> = Vec::new();
    for line in lines {
        let place = draft.place(line);
        draft.covers(place.clone());
        if let Some(name) = heading(line) {
            section = name;
            draft.pass(place);
            continue;
        }
        match section {
            _ if line.starts_with('#') => draft.note_at(place, say!("Racket cannot read this line")),
            "axiom" => {
                axiom.push_str(line);
                draft.read(place, say!("axiom {}", line));
            }
            "rules" => match (split_rule(line).filter(|_| line.contains(['→', '>'])), rules.last_mut()) {
                (Some(_), _) if is_rule(line) => {
                    rules.push((*line).to_owned());
                    draft.read(place, (*line).to_owned());
                }
                (_, Some(last)) => {
                    last.push(' ');
                    last.push_str(line);
                    draft.read(place, say!("the rule above"));
                }
                _ => draft.refuse_at(place, say!("This rule has no arrow")),
            },
            "variables" => match line.split_once('=') {
                Some((name, value)) if name.trim() == "n" => {
                    draft.iterations(draft.source.line_of(place.start), value);
                    draft.read(place, format!("n {}", draft.definition.iterations));
                }
                Some((name, value)) => variables.push((name.trim(), value.trim(), line)),
                None => draft.refuse_at(place, say!("This variable has no value")),
            },
            _ => draft.refuse_at(place, say!("This section cannot be read")),
        }
    }
    let clean = |text: &str| text.replace(['∧', '⌃'], "^");
    let (axiom, rules) = (clean(&axiom), rules.iter().map(|rule| clean(rule)).collect::<Vec<_>>());
    let scaled = |text: &str| if library { scale(text, code) } else { text.to_owned() };
    draft.definition.axiom = scaled(&axiom);
    let rules: Vec<String> = rules.iter().map(|rule| scaled(rule)).collect();
    angle(&mut draft, &variables, code);
    let body = format!("{}\n{}", draft.definition.axiom, rules.join("\n"));
    if body.contains('θ') && !variables.iter().any(|(name, ..)| *name == "θ") {
        variables.push(("θ", "90", ""));
    }
    let constants = constants(&variables, &names(&body), &mut draft);
    draft.definition.rules = constants.into_iter().chain(rules).collect::<Vec<_>>().join("\n");
    if library {
        draft.definition.step = 2.0;
        draft.others = Some("");
        turtle("Racket").for_each(|(symbol, actions)| draft.meaning(symbol, actions));
        for symbol in body.chars().filter(|ch| code.definitions.contains_key(ch)).collect::<BTreeSet<char>>() {
            let (actions, unknown) = code.actions(symbol);
            let is_nothing = actions.is_empty();
            draft.meaning(symbol, actions);
            if unknown {
                let why = if is_nothing {
                    say!("The Racket code decides what `{}` does and is not run; here it does nothing", symbol)
                } else {
                    say!(
                        "The Racket code decides what `{}` does and is not run; here it does what it does in the library",
                        symbol
                    )
                };
                draft.note(line, "", why);
            }
        }
    } else {
        let why = say!("The Racket code decides what symbols do and is not run; here symbols do the same as in ABOP");
        draft.note_at(draft.place(code.text), why);
    }
    draft
}

/// The lines of the variables that the rules use.
fn constants(variables: &[(&str, &str, &str)], used: &BTreeSet<String>, draft: &mut Draft<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    for (name, value, line) in variables {
        let place = draft.place(line);
        if used.contains(*name) {
            draft.read(place, format!("{name} = {value}"));
            lines.push(format!("{name} = {value}"));
        } else if matches!(*name, "w" | "h" | "θ") {
            // The size of that program's picture, and the angle, which has its own mark.
            draft.pass(place);
        } else if !line.is_empty() {
            draft.note_at(place, say!("The rules do not use this variable"));
        }
    }
    lines
}

/// Whether a line begins a rule: an arrow stands outside brackets behind the first symbol.
fn is_rule(line: &str) -> bool {
    ["->", "→", "⟶"].iter().any(|arrow| line.find(arrow).is_some_and(|at| !line[..at].contains('[')))
}

/// The names in arguments and conditions.
fn names(body: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for line in body.lines() {
        let condition = line.split_once(':').and_then(|(_, rest)| rest.split(['→', '-']).next()).unwrap_or_default();
        let mut depth = 0_usize;
        let inside = line.chars().map(|ch| {
            depth = (depth + usize::from(ch == '(')).saturating_sub(usize::from(ch == ')'));
            if depth > 0 { ch } else { ' ' }
        });
        let text: String = inside.chain([' ']).chain(condition.chars()).collect();
        let words = text.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
        found.extend(words.map(str::to_owned));
    }
    found
}

/// Sets the angle from the variables or the code.
fn angle(draft: &mut Draft<'_>, variables: &[(&str, &str, &str)], code: &Code<'_>) {
    let library = code.library;
    let names: &[&str] = if library { &["θ"] } else { &["θ", "δ", "angle", "theta", "delta"] };
    let found = names.iter().find_map(|name| variables.iter().rev().find(|(own, ..)| own == name));
    draft.definition.angle = match (found, code.turn) {
        (Some((_, value, line)), _) => {
            let angle = whole_number(value);
            let place = draft.place(line);
            match angle.filter(|angle| angle.is_finite()) {
                Some(angle) => draft.read(place, say!("angle {}", angle)),
                None => draft.refuse_at(place, say!("The angle is not a number")),
            }
            angle.unwrap_or_default()
        }
        _ if library => 90.0,
        (None, Some(angle)) => {
            draft.note(draft.line, "", say!("The angle is read from the Racket code"));
            angle
        }
        (None, None) => {
            draft.note(draft.line, "", say!("The text gives no angle; 90 degrees is chosen"));
            90.0
        }
    };
}

/// Multiplies the numbers of + and - by θ, and those of ! by half a step, as the library does.
fn scale(text: &str, code: &Code<'_>) -> String {
    let mut out = String::new();
    let mut depth = 0_usize;
    let mut scaled = None;
    let mut before = ' ';
    for ch in text.chars() {
        out.push(ch);
        match ch {
            '(' => {
                depth += 1;
                let factor = match code.actions(before).0 {
                    _ if depth > 1 => None,
                    "turn left" | "turn right" => Some("*θ)"),
                    "width 0.5" => Some("*0.5)"),
                    _ => None,
                };
                if let Some(factor) = factor {
                    out.push('(');
                    scaled = Some((depth, factor));
                }
            }
            ')' => {
                if let Some((_, factor)) = scaled.take_if(|(at, _)| *at == depth) {
                    out.push_str(factor);
                }
                depth = depth.saturating_sub(1);
            }
            _ => {}
        }
        before = ch;
    }
    out
}

#[cfg(test)]
mod tests;
