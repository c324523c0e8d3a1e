//! The answers of a class to an exercise, marked.

mod answers;
mod csv;

pub use answers::{Answer, Handed, answers, exercise_in};

use crate::exercise::Exercise;
use crate::mark::{Grade, Marker};
use lsystem_base::say;
use lsystem_base::sorted;
use lsystem_render::mask::SIDE;
use lsystem_syntax::Definition;
use std::collections::HashMap;

/// The side of a small picture, in pixels.
pub const SMALL: usize = 128;

/// An exercise with the means to mark answers to it.
pub struct ClassMarker {
    exercise: Exercise,
    veiled: String,
    /// By variant: made with its first answer.
    markers: Vec<Option<Marker>>,
    /// The variant of the last answer.
    last: usize,
}

/// The most characters of an answer's rules that are kept to be shown.
const SHOWN: usize = 2000;

/// A marked answer.
#[derive(Clone, Debug)]
pub struct Marked {
    /// The answer.
    pub answer: Answer,
    /// The axiom, if it was to be found, and the rules; only the beginning of long ones.
    pub rules: String,
    /// The number of the student's variant, from 0 for the target itself.
    pub variant: usize,
    /// `None` if there is nothing to mark.
    pub grade: Option<Grade>,
    /// The probable mistake: an error, or a hint.
    pub mistake: Option<String>,
}

/// A mistake that several answers have.
#[derive(Clone, Debug, PartialEq)]
pub struct Mistake {
    /// The hint or the error.
    pub words: String,
    /// The numbers of the answers with it.
    pub answers: Vec<usize>,
}

impl ClassMarker {
    /// Opens the exercise in the value of `x` in a link.
    ///
    /// # Errors
    /// The end of a sentence that begins with "the exercise".
    pub fn new(veiled: String) -> Result<Self, String> {
        let exercise = Exercise::read(&veiled)?;
        let markers = (0..=exercise.variants.len()).map(|_| None).collect();
        let mut class = Self { exercise, veiled, markers, last: 0 };
        class.marker(0)?;
        Ok(class)
    }

    /// The exercise, with all variants.
    #[must_use]
    pub fn exercise(&self) -> &Exercise {
        &self.exercise
    }

    /// The value of `x` in links of the exercise.
    #[must_use]
    pub fn veiled(&self) -> &str {
        &self.veiled
    }

    /// Marks an answer to the variant of its student, who is named in the link, or else in the table.
    pub fn mark(&mut self, answer: Answer) -> Marked {
        let student = if answer.by.is_empty() { &answer.name } else { &answer.by };
        let variant = self.exercise.variant_of(student);
        self.last = variant;
        let refused =
            |answer, words| Marked { answer, rules: String::new(), variant, grade: None, mistake: Some(words) };
        let student = match answer.student(&self.veiled) {
            Ok(student) => student,
            Err(words) => return refused(answer, words),
        };
        let rules = [student.axiom.as_str(), &student.rules].join("\n");
        let rules = rules.trim().chars().take(SHOWN).collect();
        let marker = match self.marker(variant) {
            Ok(marker) => marker,
            Err(words) => return refused(answer, say!("the exercise {}", words)),
        };
        // A whole system in a file has the given rules, too.
        let student = Definition { rules: marker.exercise().own_rules(&student.rules), ..student };
        let grade = marker.mark(&student);
        let mistake = match grade.errors.first() {
            Some(error) => Some(error.message.clone()),
            None if grade.is_solved => None,
            None => marker.hint(&student),
        };
        Marked { answer, rules, variant, grade: Some(grade), mistake }
    }

    /// The differences of the last marked answer, [`SMALL`] by [`SMALL`] pixels, row by row from above: 0 for none, 1 for
    /// ink of both, 2 for missing ink, 3 for ink that is too much. A pixel shows the worst of those it stands for.
    #[must_use]
    pub fn picture(&self) -> Vec<u8> {
        let mut pixels = vec![0; SMALL * SMALL];
        let overlay = self.markers.get(self.last).into_iter().flatten().flat_map(Marker::overlay);
        for (at, value) in overlay.enumerate() {
            let place = at / SIDE / (SIDE / SMALL) * SMALL + at % SIDE / (SIDE / SMALL);
            // From 0, 1, 2 and 4.
            pixels[place] = (value - value / 4).max(pixels[place]);
        }
        pixels
    }

    /// A table for spreadsheets (CSV), with a row for each answer.
    #[must_use]
    pub fn csv(&self, marked: &[Marked]) -> String {
        csv::csv(marked, !self.exercise.variants.is_empty())
    }

    fn marker(&mut self, variant: usize) -> Result<&mut Marker, String> {
        let place = &mut self.markers[variant];
        if place.is_none() {
            let marker = Marker::new(self.exercise.variant(variant)).map_err(|errors| {
                let errors: Vec<String> = errors.iter().map(|problem| problem.message.clone()).collect();
                say!("cannot be drawn: {}", errors.join(" "))
            })?;
            *place = Some(marker);
        }
        place.as_mut().ok_or_else(String::new)
    }
}

impl Marked {
    /// Whether the answer solves the exercise.
    #[must_use]
    pub fn is_solved(&self) -> bool {
        self.grade.as_ref().is_some_and(|grade| grade.is_solved)
    }

    /// The agreement in percent; empty if there is nothing to mark.
    #[must_use]
    pub fn percent(&self) -> String {
        self.grade.as_ref().map(Grade::percent).unwrap_or_default()
    }

    /// The symbols of the rules; empty if there is nothing to mark.
    #[must_use]
    pub fn symbols(&self) -> String {
        self.grade.as_ref().map(|grade| grade.symbols.to_string()).unwrap_or_default()
    }

    /// The sentences that explain the mark to the student.
    #[must_use]
    pub fn words(&self) -> String {
        let measure = self.grade.as_ref().filter(|grade| grade.errors.is_empty()).map_or("", |grade| &grade.words);
        [measure, self.mistake.as_deref().unwrap_or_default()].join(" ").trim().to_owned()
    }
}

/// The mistakes of a class, the most frequent first.
#[must_use]
pub fn mistakes(marked: &[Marked]) -> Vec<Mistake> {
    let mut found: Vec<Mistake> = Vec::new();
    let mut places = HashMap::new();
    for (number, one) in marked.iter().enumerate() {
        let Some(words) = &one.mistake else { continue };
        let place = *places.entry(words).or_insert(found.len());
        if place == found.len() {
            found.push(Mistake { words: words.clone(), answers: Vec::new() });
        }
        found[place].answers.push(number);
    }
    sorted::sort_by_key(&mut found, |mistake| core::cmp::Reverse(mistake.answers.len()));
    found
}
