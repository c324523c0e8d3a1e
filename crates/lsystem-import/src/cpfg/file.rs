//! Files of cpfg: statements, the preprocessor, and code.

use super::assignments::{inlined, is_name};
use super::clean::clean;
use super::macros::{Replaced, arguments, is_part};
use super::parts::{Parts, Rule, Section};
use super::statements::{Class, Statement, arrow, is_alone, keyword, statements};
use super::{Kind, Places, code, companions, translate};
use crate::draft::Draft;
use crate::source::{Lines, Source};
use core::ops::Range;
use lsystem_base::{say, word, words::said};
use std::borrow::Cow;
use std::collections::BTreeSet;

/// The most definitions of a text.
const MAX_DEFINITIONS: usize = 2000;

/// Whether a line begins a system.
fn begins(line: &str) -> bool {
    // Not of `lsystem: {` in an object, or `lsystem::draw` in a program.
    keyword(line).is_some_and(|(word, rest)| word == "lsystem" && !rest.starts_with(['{', '[', '"', ':', '=']))
}

pub(in super::super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    source.text.lines().any(begins).then(|| vec![system(source)])
}

fn system(source: Source<'_>) -> Draft<'_> {
    let mut draft = Draft::new(source, "", 1);
    draft.definition.step = 1.0;
    let (text, comments) = clean(source.text, Kind::Cpfg);
    let lines = Lines::new(&text);
    let places = Places(Source::new(&text, &lines));
    let mut file = File {
        parts: Parts::new(Kind::Cpfg),
        globals: BTreeSet::new(),
        section: Section::Productions,
        place: 0..0,
        state: State::Before,
    };
    let mut rest: Option<Range<usize>> = None;
    let files = companions::parts(&text);
    let own = files.iter().find(|part| part.text.lines().any(begins)).map_or(&*text, |part| part.text);
    for statement in statements(own) {
        let place = places.of(statement.text);
        let is_header = statement.class == Class::Keyword("lsystem");
        match file.state {
            State::Before if is_header => {
                file.place = place.clone();
                file.state = State::Inside;
                draft.read(place, say!("the beginning of the system"));
            }
            State::Before if statement.class == Class::Directive => {
                draft.covers(place);
                file.directive(statement.text, &places, &mut draft);
            }
            State::Before => {}
            State::Inside | State::Behind if is_header => {
                rest = Some(place.start..places.of(own).start + own.trim_end().len());
                break;
            }
            State::Inside => file.statement(statement, &places, &mut draft),
            State::Behind => {}
        }
        if file.state == State::Inside {
            file.place.end = places.of(statement.text).end;
        }
    }
    draft.covers(file.place.clone());
    comments.into_iter().filter(|comment| file.place.contains(&comment.start)).for_each(|comment| draft.pass(comment));
    if let Some(rest) = rest {
        let why = say!(
            "This second L-system is a sub-L-system of cpfg, which the first does not enter; only the first is read"
        );
        draft.covers(rest.clone());
        draft.note_at(rest, why);
    }
    file.parts.surfaces = companions::read_surfaces(&text, &places, &mut draft);
    let functions = companions::read_curves(&text, &places, &mut draft);
    file.parts.set_curves(functions);
    file.parts.angle = companions::read_angle(&text, &places, &mut draft);
    translate::translate(&file.parts, &places, &mut draft);
    draft
}

/// Where a statement stands.
#[derive(Clone, Copy, PartialEq)]
enum State {
    Before,
    Inside,
    Behind,
}

/// A system while its statements are read.
struct File<'c> {
    parts: Parts<'c>,
    /// The numbers that code of the whole system assigns.
    globals: BTreeSet<String>,
    section: Section,
    place: Range<usize>,
    state: State,
}

impl<'c> File<'c> {
    fn statement(&mut self, statement: Statement<'c>, places: &Places<'c>, draft: &mut Draft<'_>) {
        let text = statement.text;
        match statement.class {
            Class::Directive => self.directive(text, places, draft),
            Class::Keyword(word) => {
                let rest = keyword(text).map_or("", |(_, rest)| rest);
                self.keyword(word, text, rest, places, draft);
            }
            Class::Other => match arrow(text) {
                Some((at, length)) => self.rule(text, at, length, places, draft),
                None => {
                    draft.refuse_at(places.of(text), say!("This line is no statement of cpfg: it has no arrow `-->`"));
                }
            },
        }
    }

    fn keyword(&mut self, word: &str, text: &'c str, rest: &'c str, places: &Places<'c>, draft: &mut Draft<'_>) {
        let place = places.of(text);
        draft.read(place.start..place.end - rest.len(), word.to_owned());
        if is_alone(word) && !matches!(rest, "" | "warnings" | "no warnings") {
            return draft.refuse_at(places.of(rest), say!("Nothing can stand behind `{}`", word));
        }
        match word {
            "axiom" => self.parts.axiom = Some(rest),
            "derivation length" | "derivationlength" => self.parts.length = Some(rest),
            "ignore" => self.parts.seen.push(("ignore", rest)),
            "consider" => self.parts.seen.push(("consider", rest)),
            // A seed of the homomorphism counts only there.
            "seed" => match self.parts.arithmetic.value(rest) {
                Some(_) if self.section == Section::Images => {
                    draft.note_at(place, say!("The homomorphism has no seed of its own here"));
                }
                Some(seed) => {
                    draft.definition.seed = seed as _;
                    self.parts.is_stochastic = true;
                    draft.read(place, say!("seed {}", draft.definition.seed));
                }
                None => draft.note_at(place, say!("The seed is not read")),
            },
            "homomorphism" | "interpretation" => self.begin(Section::Images, place, "draw:", draft),
            "production" => self.begin(Section::Productions, place, word!("productions"), draft),
            "decomposition" => {
                self.parts.decomposed = Some(place.clone());
                self.begin(Section::Decompositions, place, word!("decompositions"), draft);
            }
            "maximum depth" if self.section == Section::Decompositions => {
                draft.read(place, say!("the depth of decompositions"));
                self.parts.decomposition_depth = Some(rest);
            }
            "maximum depth" => {
                draft.read(place, say!("the depth of the homomorphism"));
                self.parts.depth = Some(rest);
            }
            "start" => {
                let names =
                    rest.split(';').filter_map(|part| Some(part.split_once('=')?.0.trim_matches(['{', ' ', '\n'])));
                self.globals.extend(names.map(|name| name.trim().to_owned()));
                code::start(rest, &mut self.parts, places, draft);
            }
            "define" => code::define(rest, &mut self.parts, places, draft),
            "end" => {
                draft.note_at(place, say!("This code runs behind the last step and changes nothing that is drawn"));
            }
            "starteach" | "endeach" | "start each" | "end each" => {
                let is_before = word.starts_with("start");
                code::every_step(rest, is_before, &place, &mut self.parts, places, draft);
                self.globals.extend(self.parts.every_step.names().into_iter().map(str::to_owned));
            }
            "ring lsystem" => draft.refuse_at(place, say!("Rings, whose ends are neighbours, have no equal here")),
            "endlsystem" => {
                draft.read(place, say!("the end of the system"));
                self.state = State::Behind;
                self.place.end = places.of(text).end;
            }
            _ => draft.refuse_at(place, say!("Groups of productions are not possible")),
        }
    }

    fn begin(&mut self, section: Section, place: Range<usize>, became: &str, draft: &mut Draft<'_>) {
        draft.read(place, said(became));
        self.section = section;
    }

    /// Reads a line of the preprocessor.
    fn directive(&mut self, line: &'c str, places: &Places<'c>, draft: &mut Draft<'_>) {
        let place = places.of(line);
        let rest = line[1..].trim_start();
        if rest.starts_with(|c: char| c.is_ascii_digit()) || rest.starts_with("line") {
            return draft.pass(place);
        }
        let Some(rest) = rest.strip_prefix("define").filter(|rest| rest.starts_with([' ', '\t'])) else {
            let word = rest.split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
            let why = match word {
                "include" => say!("`#include` reads another file"),
                _ => say!("Of the preprocessor, only #define is read: not `#{}`", word),
            };
            return draft.refuse_at(place, why);
        };
        if self.parts.arithmetic.macros.len() > MAX_DEFINITIONS {
            return draft.refuse_at(place, say!("At most {} definitions are read", MAX_DEFINITIONS));
        }
        let rest = rest.trim();
        let (name, value) = rest.split_at(rest.find(|c: char| !is_part(c)).unwrap_or(rest.len()));
        if !is_name(name) {
            return draft.refuse_at(place, say!("This definition has no name"));
        }
        if let Some(inside) = value.strip_prefix('(') {
            let Some((parameters, body)) = arguments(inside) else {
                return draft.refuse_at(place, say!("The parenthesis of this macro is not closed"));
            };
            let parameters: Vec<String> = parameters.iter().map(|name| name.trim().to_owned()).collect();
            let parameters = if parameters == [""] { Vec::new() } else { parameters };
            let macros = &mut self.parts.arithmetic.macros;
            macros.define(name.to_owned(), Some(parameters), body.trim().to_owned(), false);
            return draft.read(place, say!("the macro {}", name));
        }
        let value = value.trim();
        match self.constant(value) {
            Some(number) => {
                let parts = &mut self.parts;
                parts.set_constant(name, number);
                // Words are replaced by the value as it stands.
                parts.arithmetic.macros.define(name.to_owned(), None, value.to_owned(), true);
                draft.read(place, format!("{name} = {value}"));
            }
            None => {
                self.parts.arithmetic.macros.define(name.to_owned(), None, value.to_owned(), false);
                draft.read(place, say!("the macro {}", name));
            }
        }
    }

    /// The number that a macro is. Its value must be one part, such as a number or a sum in parentheses: the
    /// preprocessor writes `1+2` without parentheses around it.
    fn constant(&self, value: &str) -> Option<f64> {
        let unsigned = value.strip_prefix(['-', '+']).unwrap_or(value);
        let whole = unsigned.parse::<f64>().is_ok() && unsigned.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let one = whole
            || is_name(unsigned)
            || unsigned.strip_prefix('(').and_then(arguments).is_some_and(|(_, behind)| behind.is_empty());
        if !one {
            return None;
        }
        // A number is a constant where arithmetic stands; a name that is a symbol is none.
        self.parts.arithmetic.value(value)
    }

    fn rule(&mut self, text: &'c str, at: usize, length: usize, places: &Places<'c>, draft: &mut Draft<'_>) {
        let place = places.of(text);
        let (head, successor) = (without_label(&text[..at]), &text[at + length..]);
        let (head, condition) = split(head, ':').map_or((head, ""), |at| (&head[..at], &head[at + 1..]));
        let (successor, weight) =
            split(successor, ':').map_or((successor, None), |at| (&successor[..at], Some(&successor[at + 1..])));
        let mut rule = Rule {
            place: place.clone(),
            head: head.trim(),
            condition: Cow::Borrowed(condition.trim()),
            successor: Cow::Borrowed(successor),
            weight,
        };
        if condition.contains('{') {
            let macros = &self.parts.arithmetic.macros;
            let read = macros.expand(condition, Replaced::Texts).and_then(|condition| {
                let successor = macros.expand(successor, Replaced::Texts)?;
                inlined(&condition, &successor, &|name| self.globals.contains(name))
            });
            match read {
                Ok((condition, successor)) => {
                    (rule.condition, rule.successor) = (Cow::Owned(condition), Cow::Owned(successor));
                }
                Err(why) => return draft.refuse_at(place, said(why)),
            }
        }
        // The first production that applies is used there.
        if self.section == Section::Images
            && let Some(weight) = rule.weight.take()
        {
            draft.note_at(
                places.of(weight),
                say!("cpfg takes the first production of a homomorphism, whatever its probability"),
            );
        }
        self.parts.section(self.section).push(rule);
    }
}

/// The place of a character outside of parentheses and braces.
pub(super) fn split(text: &str, mark: char) -> Option<usize> {
    let mut depth = 0_usize;
    text.char_indices().find_map(|(at, ch)| {
        match ch {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        (depth == 0 && ch == mark).then_some(at)
    })
}

/// A production without its label `p1:`.
fn without_label(text: &str) -> &str {
    let Some((name, rest)) = text.split_once(':') else { return text };
    let name = name.trim();
    let is_label =
        name.len() > 1 && name.chars().all(char::is_alphanumeric) && name.ends_with(|c: char| c.is_ascii_digit());
    // Another predecessor stands behind a label.
    let has_head = rest.trim_start().starts_with(|c: char| !c.is_whitespace());
    if is_label && has_head { rest.trim_start() } else { text }
}
