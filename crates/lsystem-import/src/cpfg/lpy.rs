//! Files of L-Py: Python code, and below `production:` rules with arrows or with Python code.

use super::assignments::{is_name, prints};
use super::clean::clean;
use super::file::split;
use super::macros::is_part;
use super::nurbs;
use super::parts::{Parts, Rule, Section};
use super::python::{head_and_rest, successors};
use super::statements::{arrow, is_alone, keyword};
use super::{Kind, Places, translate};
use crate::draft::Draft;
use crate::source::{Lines, Source};
use core::ops::Range;
use lsystem_base::{say, word, words::said};
use std::borrow::Cow;

const NOT_RUN: &str = word!("Python code is not run");

pub(in super::super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let keywords: Vec<(&str, &str)> = text.lines().filter_map(keyword).collect();
    let has = |name: &str| keywords.iter().any(|(word, _)| *word == name);
    let (axiom, length) = (has("axiom"), has("derivation length"));
    // A rule behind `Production:` is another notation.
    let is_section = |rest: &str| rest.is_empty() || rest.starts_with('#');
    let production = keywords.iter().any(|(word, rest)| *word == "production" && is_section(rest));
    let is_lpy = !has("lsystem")
        && (production && (axiom || length) || axiom && length && (text.contains("-->") || only_python(text)));
    is_lpy.then(|| vec![system(source)])
}

/// Whether all lines are Python code, but for the axiom and the derivation length. Other notations have such lines too.
fn only_python(text: &str) -> bool {
    text.lines().all(|line| {
        let line = line.trim();
        let assigned = |line: &str| {
            line.split_once('=').is_some_and(|(name, value)| {
                let (name, value) = (name.trim(), value.trim());
                is_name(name) && (name.len() > 1 || value.starts_with(|c: char| c.is_ascii_digit()))
            })
        };
        line.is_empty()
            || line.starts_with(['#', '"', '\''])
            || ["import ", "from ", "module ", "extern(", "def "].iter().any(|start| line.starts_with(start))
            || keyword(line).is_some_and(|(word, _)| matches!(word, "axiom" | "derivation length"))
            || assigned(line)
    })
}

fn system(source: Source<'_>) -> Draft<'_> {
    let mut draft = Draft::new(source, "", 1);
    draft.definition.step = 1.0;
    let (text, comments) = clean(source.text, Kind::LPy);
    let lines = Lines::new(&text);
    let places = Places(Source::new(&text, &lines));
    let mut file = File { parts: Parts::new(Kind::LPy), places, section: None, code: Vec::new() };
    // What L-Py's editor writes below this line are its settings.
    let end = source.text.find("###### INITIALISATION ######").unwrap_or(text.len());
    let own: Vec<&str> = text[..end].lines().collect();
    let mut at = 0;
    while let Some(&line) = own.get(at) {
        // The block of a line: those below that are further in.
        let is_inside = |line: &&&str| line.trim().is_empty() || line.starts_with([' ', '\t']);
        let below = own[at + 1..].iter().take_while(is_inside).count();
        let block = &own[at + 1..at + 1 + below];
        file.statement(line, block, &mut draft);
        at += 1 + below;
    }
    draft.covers(0..end);
    comments.into_iter().filter(|comment| comment.start < end).for_each(|comment| draft.pass(comment));
    file.parts.set_curves(nurbs::read_curves(source.text));
    translate::translate(&file.parts, &places, &mut draft);
    file.used_code(&mut draft);
    draft
}

/// A system while its lines are read.
struct File<'c> {
    parts: Parts<'c>,
    places: Places<'c>,
    /// `None` where only code stands.
    section: Option<Section>,
    /// Names that only code can compute, with their places.
    code: Vec<(&'c str, Range<usize>)>,
}

impl<'c> File<'c> {
    /// Reads a line and its block.
    fn statement(&mut self, line: &'c str, block: &[&'c str], draft: &mut Draft<'_>) {
        let text = line.trim();
        if text.is_empty() {
            block.iter().filter(|line| !line.trim().is_empty()).for_each(|line| self.statement(line, &[], draft));
            return;
        }
        let whole = self.whole(text, block);
        if let Some((word, rest)) = keyword(text) {
            self.keyword(word, text, rest, draft);
            block.iter().filter(|line| !line.trim().is_empty()).for_each(|line| self.statement(line, &[], draft));
            return;
        }
        let Some(section) = self.section else { return self.python(text, block, whole, draft) };
        if let Some((at, length)) = arrow(text) {
            // Lines further in continue the successor, unless they are rules of their own.
            let own = block.iter().position(|line| arrow(line).is_some() || keyword(line).is_some());
            let (more, rest) = block.split_at(own.unwrap_or(block.len()));
            let rule = self.whole(text, more);
            let rule_text = self.slice(&rule);
            let (head, successor) = (&rule_text[..at], &rule_text[at + length..]);
            self.arrow_rule(head, successor, rule, section, draft);
            rest.iter().filter(|line| !line.trim().is_empty()).for_each(|line| self.statement(line, &[], draft));
            return;
        }
        let Some((head, inline)) = head_and_rest(text).filter(|(head, _)| !is_code(head)) else {
            return self.python(text, block, whole, draft);
        };
        // Rules of Python.
        draft.read(whole.clone(), say!("a rule"));
        match successors(inline, block, &self.parts.arithmetic) {
            Ok(made) => {
                for made in made {
                    let (condition, successor) = (Cow::Owned(made.condition), made.successor);
                    let rule = Rule { place: whole.clone(), head, condition, successor, weight: None };
                    self.check_head(&rule, draft);
                    self.parts.section(section).push(rule);
                }
            }
            Err((code, why)) => draft.refuse_at(self.places.or(code, &whole), why),
        }
    }

    fn keyword(&mut self, word: &str, text: &'c str, rest: &'c str, draft: &mut Draft<'_>) {
        let place = self.places.of(text);
        draft.read(place.start..place.end - rest.len(), word.to_owned());
        if is_alone(word) && !rest.is_empty() {
            return draft.refuse_at(self.places.of(rest), say!("Nothing can stand behind `{}`", word));
        }
        let mut begin = |section: Option<Section>, became: &str| {
            draft.read(place.clone(), said(became));
            self.section = section;
        };
        match word {
            "axiom" => self.parts.axiom = Some(rest),
            "derivation length" => self.parts.length = Some(rest),
            "ignore" => self.parts.seen.push(("ignore", rest)),
            "consider" => self.parts.seen.push(("consider", rest)),
            "production" => begin(Some(Section::Productions), word!("productions")),
            "homomorphism" | "interpretation" => begin(Some(Section::Images), "draw:"),
            "decomposition" => {
                self.parts.decomposed = Some(place.clone());
                begin(Some(Section::Decompositions), word!("decompositions"));
            }
            "endlsystem" => begin(None, word!("the end of the system")),
            "maximum depth" if self.section == Some(Section::Decompositions) => {
                self.parts.decomposition_depth = Some(rest);
                draft.read(place, say!("the depth of decompositions"));
            }
            "decomposition maximum depth" => {
                self.parts.decomposition_depth = Some(rest);
                draft.read(place, say!("the depth of decompositions"));
            }
            "maximum depth" | "interpretation maximum depth" => {
                self.parts.depth = Some(rest);
                draft.read(place, say!("the depth of the interpretation"));
            }
            "group" if rest.trim_end_matches(':').trim() == "0" => {
                draft.read(place, say!("the group that always counts"));
            }
            "endgroup" => draft.read(place, say!("the end of a group")),
            "group" => draft.refuse_at(place, say!("Groups of productions, which code chooses, are not possible")),
            "seed" => match self.parts.arithmetic.value(rest) {
                Some(seed) => {
                    draft.definition.seed = seed as _;
                    draft.read(place, say!("seed {}", draft.definition.seed));
                }
                None => draft.note_at(place, say!("The seed is not read")),
            },
            _ => draft.refuse_at(place, said(NOT_RUN)),
        }
    }

    fn arrow_rule(
        &mut self,
        head: &'c str,
        successor: &'c str,
        place: Range<usize>,
        section: Section,
        draft: &mut Draft<'_>,
    ) {
        let (head, condition) = split(head, ':').map_or((head, ""), |at| (&head[..at], head[at + 1..].trim()));
        let (successor, weight) =
            split(successor, ':').map_or((successor, None), |at| (&successor[..at], Some(&successor[at + 1..])));
        let (condition, successor) = (Cow::Borrowed(condition), Cow::Borrowed(successor));
        let rule = Rule { place, head: head.trim(), condition, successor, weight };
        self.check_head(&rule, draft);
        self.parts.section(section).push(rule);
    }

    fn check_head(&self, rule: &Rule<'c>, draft: &mut Draft<'_>) {
        if rule.head.contains("<<") || rule.head.contains(">>") {
            let why = say!("Contexts `<<` and `>>` in the new string have no equal here");
            draft.refuse_at(self.places.or(rule.head, &rule.place), why);
        }
    }

    /// Reads Python code outside of rules.
    fn python(&mut self, text: &'c str, block: &[&'c str], whole: Range<usize>, draft: &mut Draft<'_>) {
        if let Some(rest) = text.strip_prefix("module ") {
            let names = rest.split(':').next().unwrap_or_default();
            // Parameters may stand in parentheses.
            for name in names.split(',').map(str::trim) {
                let name = name.split(|c: char| !is_part(c)).next().unwrap_or_default();
                if name.chars().nth(1).is_some() && name.len() <= translate::LONGEST_NAME {
                    self.parts.names.insert(name.to_owned());
                }
            }
            return draft.read(whole, say!("names of modules"));
        }
        for line in [text].into_iter().chain(block.iter().copied()) {
            if let Some((_, rest)) = line.split_once("setAngleIncrement(") {
                match rest.split(')').next().and_then(|angle| self.parts.arithmetic.value(angle)) {
                    Some(angle) => {
                        self.parts.angle = Some(angle);
                        draft.read(self.places.of(line.trim()), say!("angle {}", angle));
                    }
                    None => draft.refuse_at(self.places.of(line.trim()), said(NOT_RUN)),
                }
            }
        }
        let inner = block.iter().map(|line| line.trim()).filter(|line| !line.is_empty());
        let is_quiet = |line: &str| {
            line == "pass" || prints(line) || line.contains("setAngleIncrement(") || line.starts_with(['"', '\''])
        };
        if let Some(seed) = text.split_once("seed(").filter(|(name, _)| matches!(*name, "" | "rd." | "random.")) {
            let seed = seed.1.strip_suffix(')').and_then(|seed| self.parts.arithmetic.value(seed));
            draft.definition.seed = seed.unwrap_or_default() as _;
            return draft.read(whole, say!("seed {}", draft.definition.seed));
        }
        if let Some(rest) = text.strip_prefix("extern(") {
            for part in rest.trim_end_matches(')').split(',') {
                self.assign(part.trim(), draft);
            }
            return;
        }
        if let Some(rest) = text.strip_prefix("def ") {
            let name = rest.split('(').next().unwrap_or_default().trim();
            let hooks = matches!(name, "Start" | "End" | "StartEach" | "EndEach" | "PostDraw" | "StartInterpretation");
            let quiet = head_and_rest(text).is_some_and(|(_, rest)| rest.is_empty() || is_quiet(rest));
            if hooks && name != "End" && name != "PostDraw" && !(quiet && inner.clone().all(is_quiet)) {
                return draft
                    .refuse_at(whole, say!("Python code is not run: `{}` may change what the rules use", name));
            }
            self.code.push((name, whole.clone()));
            return draft.note_at(whole, said(NOT_RUN));
        }
        if is_quiet(text) {
            return if text.contains("setAngleIncrement(") {
                draft.pass(whole);
            } else {
                draft.note_at(whole, said(NOT_RUN));
            };
        }
        if ["from ", "import ", "__", "context()", "@"].iter().any(|start| text.starts_with(start)) {
            return draft.note_at(whole, said(NOT_RUN));
        }
        if self.assign(text, draft) {
            // A list over several lines.
            return inner.for_each(|line| draft.note_at(self.places.of(line), said(NOT_RUN)));
        }
        draft.refuse_at(whole, said(NOT_RUN));
    }

    /// Reads `name = value`; whether the text is that. A value that only code can compute is remembered.
    fn assign(&mut self, text: &'c str, draft: &mut Draft<'_>) -> bool {
        let Some((names, value)) = text.split_once('=').filter(|(_, value)| !value.starts_with('=')) else {
            return false;
        };
        let place = self.places.of(text);
        let names: Vec<&str> = names.split(',').map(str::trim).collect();
        if names.iter().any(|name| !is_name(name)) {
            return false;
        }
        if value.contains("Curve2D(") {
            draft.read(place, say!("a curve"));
            return true;
        }
        match (names.as_slice(), self.parts.arithmetic.value(value)) {
            (&[name], Some(value)) => {
                self.parts.set_constant(name, value);
                draft.read(place, format!("{name} = {value}"));
            }
            _ => {
                draft.note_at(place.clone(), said(NOT_RUN));
                self.code.extend(names.into_iter().map(|name| (name, place.clone())));
            }
        }
        true
    }

    /// Refuses the system if its rules use a name that only code can compute.
    fn used_code(&self, draft: &mut Draft<'_>) {
        let mut used: Vec<&str> = Vec::new();
        let texts = [&draft.definition.axiom, &draft.definition.rules];
        for text in texts {
            used.extend(text.split(|c: char| !is_part(c)));
        }
        let used: std::collections::BTreeSet<String> = used.into_iter().map(str::to_owned).collect();
        for (name, place) in &self.code {
            if used.contains(*name) && name.len() > 1 {
                draft.refuse_at(place.clone(), say!("Python code is not run, and the rules use `{}`", name));
            }
        }
    }

    /// The place of a line and its block.
    fn whole(&self, text: &str, block: &[&str]) -> Range<usize> {
        let start = self.places.of(text);
        let end = block.iter().rev().map(|line| line.trim()).find(|line| !line.is_empty());
        start.start..end.map_or(start.end, |last| self.places.of(last).end)
    }

    fn slice(&self, place: &Range<usize>) -> &'c str {
        self.places.text().get(place.clone()).unwrap_or_default()
    }
}

/// Whether a line with a colon is Python code and no rule.
fn is_code(head: &str) -> bool {
    let word = head.split(|c: char| !is_part(c)).next().unwrap_or_default();
    matches!(word, "def" | "if" | "elif" | "else" | "for" | "while" | "class" | "try" | "except" | "with" | "lambda")
}
