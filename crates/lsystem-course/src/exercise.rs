//! Exercises: a target, what the student is given, and what counts as solved.

use lsystem_base::words::said;
use lsystem_base::{say, word};
use lsystem_files::packed::{pack, unpack};
use lsystem_syntax::fields::Section;
use lsystem_syntax::{Definition, FIELDS, FieldSpec, parse};
use serde::{Deserialize, Serialize};

/// The most variants besides the target itself.
pub(crate) const MAX_VARIANTS: usize = 40;

/// The most bytes of an exercise as JSON.
const MAX_JSON: usize = 256 << 10;
/// The most hints.
const MAX_HINTS: usize = 20;
/// The most UTF-16 units of a title, and of a task or a hint.
const MAX_TITLE: usize = 200;
const MAX_WORDS: usize = 5_000;
/// The most UTF-16 units of the functions to write.
const MAX_PROGRAM: usize = 20_000;
/// Mixed into the bytes of an exercise, so that a decoder for base64 and zlib alone does not show its rules.
const VEIL: &[u8] = b"Lindenmayer 1968";

/// How much of a part of the target a student sees.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "lowercase")]
pub enum Given {
    /// The student sees it and cannot change it.
    #[default]
    Shown,
    /// The student has to find it.
    Free,
    /// It counts, but the student does not see it.
    Hidden,
}

/// The property in which an answer must equal the target.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "lowercase")]
pub enum Asks {
    /// The picture, up to its place and size.
    #[default]
    Picture,
    /// The derived string.
    Text,
    /// The number of segments.
    Segments,
    /// With rules of chance: the numbers of segments and the sizes over many seeds.
    Statistics,
    /// The results of functions that the student writes. The page runs them, and nothing else does.
    Program,
}

impl Asks {
    /// All kinds, in the order in which they are offered.
    pub const ALL: [Self; 5] = [Self::Picture, Self::Text, Self::Segments, Self::Statistics, Self::Program];

    /// The name in an exercise's JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Picture => "picture",
            Self::Text => "text",
            Self::Segments => "segments",
            Self::Statistics => "statistics",
            Self::Program => "program",
        }
    }

    /// What must be the same, after "Must be the same".
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Picture => word!("the picture"),
            Self::Text => word!("the string"),
            Self::Segments => word!("the number of segments"),
            Self::Statistics => word!("the statistics over many seeds"),
            Self::Program => word!("the results of a program"),
        }
    }

    /// The task of an exercise without a task of its own.
    #[must_use]
    pub fn task(self) -> &'static str {
        match self {
            Self::Picture => word!("Find rules that draw the target."),
            Self::Text => word!("Find rules that derive the same string."),
            Self::Segments => word!("Find rules that draw as many segments as the target."),
            Self::Statistics => word!("Find rules of chance whose drawings have the same statistics."),
            Self::Program => word!("Write the functions, and see what they draw."),
        }
    }

    /// Whether usual mistakes and other answers can be searched: both compare pictures.
    #[must_use]
    pub fn is_searched(self) -> bool {
        self == Self::Picture
    }

    /// Whether the string counts, so that an answer need not draw.
    #[must_use]
    pub fn is_text(self) -> bool {
        self == Self::Text
    }
}

/// The values with which a student starts, where they are free.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(default)]
pub struct First {
    /// The axiom.
    pub axiom: String,
    /// The student's own rules.
    pub rules: String,
    /// The angle of turns, in degrees.
    pub angle: f64,
    /// The derivation steps.
    pub n: u32,
}

/// An exercise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "camelCase", default)]
pub struct Exercise {
    /// The title.
    pub title: String,
    /// The task in words.
    pub task: String,
    /// Hints, shown one by one when the student asks.
    pub hints: Vec<String>,
    /// The system to find. Its look is that of the student's drawing, too.
    #[serde(serialize_with = "differing")]
    pub target: Definition,
    /// Other targets of equal difficulty, with as many lines of rules: each student gets one of them or the target.
    #[serde(serialize_with = "all_differing", skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<Definition>,
    /// The axiom.
    pub axiom: Given,
    /// All angles of turns.
    pub angle: Given,
    /// The derivation steps.
    pub n: Given,
    /// The turtle: what symbols mean, and the heading at the start. Lengths and bending are given, unless the turtle is
    /// hidden.
    pub turtle: Given,
    /// Each line of the target's rules. Further lines are free.
    pub rules: Vec<Given>,
    /// Where the student starts.
    pub first: First,
    /// The property in which an answer must equal the target.
    pub asks: Asks,
    /// The functions to write, if a program is asked for: a ready-made set, or own ones with examples
    /// (`www/js/programs/tasks.js` reads the text).
    #[serde(skip_serializing_if = "String::is_empty")]
    pub program: String,
    /// The most symbols that the student's rules may have.
    pub most_symbols: Option<u32>,
    /// The agreement of the ink that counts as solved, from 0 to 1; `None` if only the same picture counts.
    pub tolerance: Option<f64>,
    /// Whether the target's rules are shown once the exercise is solved.
    pub shows_answer: bool,
}

impl Exercise {
    /// Reads the value of `x` in a link.
    ///
    /// # Errors
    /// A sentence's end that says what is wrong.
    pub fn read(text: &str) -> Result<Self, String> {
        let bytes = unpack(text, MAX_JSON).map_err(said)?;
        let exercise: Self = serde_json::from_slice(&veiled(bytes)).map_err(|error| match error.classify() {
            serde_json::error::Category::Data => say!("has a wrong value: {}", error),
            _ => say!("is damaged or cut off"),
        })?;
        Ok(exercise.within_limits())
    }

    /// Writes the value of `x` in a link.
    #[must_use]
    pub fn write(&self) -> String {
        // Numbers that JSON cannot hold become null, which reading refuses.
        pack(&veiled(serde_json::to_vec(self).unwrap_or_default()))
    }

    /// The check sum (CRC-32) of an exercise as it stands in links, in 8 digits. It stands for the exercise where a link
    /// has to be short: as `k` in the answers that a package for learning systems keeps.
    #[must_use]
    pub fn key(text: &str) -> String {
        format!("{:08x}", rawzip::crc32(text.as_bytes()))
    }

    /// The exercise with texts cut, numbers moved into their ranges, and without wind.
    #[must_use]
    pub fn within_limits(mut self) -> Self {
        cut(&mut self.title, MAX_TITLE);
        cut(&mut self.task, MAX_WORDS);
        cut(&mut self.program, MAX_PROGRAM);
        self.hints.truncate(MAX_HINTS);
        self.hints.iter_mut().for_each(|hint| cut(hint, MAX_WORDS));
        self.variants.truncate(MAX_VARIANTS);
        self.variants.iter_mut().chain([&mut self.target]).for_each(|target| target.wind = [0.0; 2]);
        self.tolerance = self.tolerance.filter(|least| (0.0..1.0).contains(least));
        self
    }

    /// The lines of the target's rules that are given in this way.
    fn lines(&self, given: Given) -> impl Iterator<Item = &str> {
        let kinds = self.rules.iter().copied().chain(std::iter::repeat(Given::Free));
        self.target.rules.lines().zip(kinds).filter(move |(_, kind)| *kind == given).map(|(line, _)| line)
    }

    /// The rules that the student sees and cannot change.
    #[must_use]
    pub fn shown_rules(&self) -> String {
        self.lines(Given::Shown).collect::<Vec<_>>().join("\n")
    }

    /// The system with which the student starts: only the student's own rules, and nothing of what is hidden.
    #[must_use]
    pub fn start(&self) -> Definition {
        let usual = Definition::default();
        let mut start = Definition { rules: self.first.rules.clone(), ..self.target.clone() };
        start.title.clone_from(&self.title);
        (start.name, start.source, start.notes) = Default::default();
        if self.axiom != Given::Shown {
            start.axiom = if self.axiom == Given::Free { self.first.axiom.clone() } else { String::new() };
        }
        if self.angle != Given::Shown {
            let angle = if self.angle == Given::Free { self.first.angle } else { 0.0 };
            copy(&mut start, &Definition { angle, ..usual.clone() }, &ANGLES);
        }
        if self.n != Given::Shown {
            start.iterations = if self.n == Given::Free { self.first.n } else { 0 };
        }
        if self.turtle != Given::Shown {
            copy(&mut start, &usual, &if self.turtle == Given::Free { SYMBOLS.to_vec() } else { turtle() });
        }
        start
    }

    /// The names of the fields, besides the rules, that the student has to find.
    #[must_use]
    pub fn free_fields(&self) -> Vec<&'static str> {
        let parts: [(Given, &[&'static str]); 4] =
            [(self.axiom, &["axiom"]), (self.n, &["iterations"]), (self.angle, &ANGLES), (self.turtle, &SYMBOLS)];
        parts.into_iter().filter(|(given, _)| *given == Given::Free).flat_map(|(_, names)| names).copied().collect()
    }

    /// Whether the student has to find rules.
    #[must_use]
    pub fn asks_for_rules(&self) -> bool {
        self.lines(Given::Free).any(|line| !line.trim().is_empty())
    }

    /// The system without anything that the student found: its rules are those that are shown or hidden.
    #[must_use]
    pub fn fixed(&self) -> Definition {
        let mut fixed = Definition { title: self.title.clone(), ..self.target.clone() };
        (fixed.name, fixed.source, fixed.notes) = Default::default();
        fixed.rules = self.lines(Given::Shown).chain(self.lines(Given::Hidden)).collect::<Vec<_>>().join("\n");
        fixed
    }

    /// The whole system of a student: what the student found, with all that is given, shown or hidden. The student's
    /// rules come first, so that places in them stay where they are.
    #[must_use]
    pub fn complete(&self, student: &Definition) -> Definition {
        let mut whole = self.fixed();
        copy(&mut whole, student, &self.free_fields());
        whole.rules = format!("{}\n{}", student.rules, whole.rules);
        whole
    }

    /// A student's rules without those that are given.
    #[must_use]
    pub fn own_rules(&self, rules: &str) -> String {
        let given: Vec<&str> = self.lines(Given::Shown).chain(self.lines(Given::Hidden)).map(str::trim).collect();
        rules.lines().filter(|line| !given.contains(&line.trim())).collect::<Vec<_>>().join("\n")
    }

    /// The symbols of a student's own rules: all modules of predecessors, contexts and successors.
    #[must_use]
    pub fn symbols(student: &Definition) -> u32 {
        let (grammar, _) = parse(&student.axiom, &student.rules);
        let productions = grammar.productions.iter().chain(&grammar.images);
        let symbols = productions.map(|rule| rule.left.len() + 1 + rule.right.len() + rule.successor.len());
        u32::try_from(symbols.sum::<usize>()).unwrap_or(u32::MAX)
    }
}

/// The fields of the angles of turns.
const ANGLES: [&str; 6] = ["angle", "rightAngle", "pitchDown", "pitchUp", "rollLeft", "rollRight"];
/// The fields of the turtle that a student may have to find.
const SYMBOLS: [&str; 3] = ["dialect", "overrides", "heading"];

/// The names of the turtle's fields but its angles, and but the growth, which belongs to the iterations.
fn turtle() -> Vec<&'static str> {
    let is_turtle = |spec: &&FieldSpec| spec.file.is_some_and(|(section, _)| section == Section::Turtle);
    let names = FIELDS.iter().filter(is_turtle).map(|spec| spec.name);
    names.filter(|name| *name != "growth" && !ANGLES.contains(name)).collect()
}

fn copy(to: &mut Definition, from: &Definition, names: &[&str]) {
    for spec in FIELDS.iter().filter(|spec| names.contains(&spec.name)) {
        if let Some(value) = spec.get(from) {
            spec.set(to, &value);
        }
    }
}

/// Cuts a text to at most `most` UTF-16 units.
pub(crate) fn cut(text: &mut String, most: usize) {
    let mut units = 0;
    let end = text.char_indices().find(|(_, c)| {
        units += c.len_utf16();
        units > most
    });
    if let Some((at, _)) = end {
        text.truncate(at);
    }
}

fn veiled(mut bytes: Vec<u8>) -> Vec<u8> {
    bytes.iter_mut().zip(VEIL.iter().cycle()).for_each(|(byte, veil)| *byte ^= veil);
    bytes
}

/// A definition of which only the fields are written that differ from their defaults.
struct Differing<'a>(&'a Definition);

impl Serialize for Differing<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        differing(self.0, serializer)
    }
}

fn all_differing<S: serde::Serializer>(definitions: &[Definition], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(definitions.iter().map(Differing))
}

/// Writes the fields that differ from their defaults.
fn differing<S: serde::Serializer>(definition: &Definition, serializer: S) -> Result<S::Ok, S::Error> {
    let usual = Definition::default();
    let fields = FIELDS.iter().filter_map(|spec| {
        let value = spec.get(definition)?;
        (spec.get(&usual).as_ref() != Some(&value)).then_some((spec.name, value))
    });
    serializer.collect_map(fields)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_field_exists() {
        for name in ANGLES.iter().chain(&SYMBOLS).chain(&["axiom", "iterations"]) {
            assert!(FIELDS.iter().any(|spec| spec.name == *name && spec.is_defined()), "{name}");
        }
    }
}
