//! What teachers need: exercises written, their variants, and the answers of a class marked.

use super::exercise::undrawable;
use lsystem_base::say;
use lsystem_base::words::shown;
use lsystem_course::{Answer, Asks, ClassMarker, Exercise, Marked, Marker, Varied, answers, exercise_in, mistakes};
use lsystem_js::{from_js, to_js};
use serde::Serialize;
use std::collections::VecDeque;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// The most answers that are marked.
const MAX: usize = 10_000;

/// A marked answer, as a table shows it.
#[derive(Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub(crate) struct MarkedAnswer {
    name: String,
    /// The name in the link.
    by: String,
    link: Option<String>,
    is_solved: bool,
    /// From 0 to 1.
    agreement: f64,
    /// Empty if there is nothing to mark.
    percent: String,
    symbols: Option<u32>,
    /// The axiom, if it was to be found, and the rules; only the beginning of long ones.
    rules: String,
    words: String,
    /// From 1.
    variant: usize,
}

/// A mistake with the numbers of the answers that have it.
#[derive(Serialize, TS)]
pub(crate) struct MistakeReport {
    words: String,
    answers: Vec<usize>,
}

/// The exercise of a class, as a page shows it.
#[derive(Serialize, TS)]
pub(crate) struct AboutClass<'a> {
    title: &'a str,
    /// The exercise, if it asks for programs, which the page runs; else empty.
    program: &'a str,
    /// The number of answers.
    answers: usize,
    /// The number of variants, with the target.
    variants: usize,
}

/// Answers that are being marked.
#[wasm_bindgen]
pub struct ClassMarking {
    class: ClassMarker,
    left: VecDeque<Answer>,
    marked: Vec<Marked>,
}

#[wasm_bindgen]
impl ClassMarking {
    /// Begins to mark the answers in a text, to the exercise in a text or, if that is blank, in the first answer.
    ///
    /// # Errors
    /// Throws a sentence if there is no exercise or no answer, or the exercise is damaged.
    #[wasm_bindgen(constructor)]
    pub fn new(exercise: &str, text: &str) -> Result<Self, JsValue> {
        let wanted = if exercise.trim().is_empty() { text } else { exercise };
        let veiled = exercise_in(wanted)
            .or_else(|| is_bare(exercise).then(|| exercise.trim().to_owned()))
            .ok_or_else(|| say!("There is no link of an exercise (with x=…)."))?;
        let class = ClassMarker::new(veiled).map_err(|wrong| say!("The exercise {}.", wrong))?;
        let left: VecDeque<Answer> = answers(text, &say!("Answer"), class.veiled()).take(MAX).collect();
        if left.is_empty() {
            return Err(
                say!("There is no answer: paste links, one on each line, or a table with a column of links.").into()
            );
        }
        Ok(Self { class, left, marked: Vec::new() })
    }

    /// The title and the numbers of answers and variants.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn about(&self) -> Result<JsValue, JsValue> {
        let exercise = self.class.exercise();
        let answers = self.left.len() + self.marked.len();
        let program = if exercise.asks == Asks::Program { self.class.veiled() } else { "" };
        to_js(&AboutClass { title: &exercise.title, program, answers, variants: 1 + exercise.variants.len() })
    }

    /// Marks the next answer; null after the last.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn step(&mut self) -> Result<JsValue, JsValue> {
        let Some(answer) = self.left.pop_front() else { return Ok(JsValue::NULL) };
        let one = self.class.mark(answer);
        let row = to_js(&MarkedAnswer {
            name: one.answer.name.clone(),
            by: one.answer.by.clone(),
            link: one.answer.link().map(str::to_owned),
            is_solved: one.is_solved(),
            agreement: one.grade.as_ref().map_or(0.0, |grade| grade.agreement),
            percent: shown(&one.percent()),
            symbols: one.grade.as_ref().map(|grade| grade.symbols),
            rules: one.rules.clone(),
            words: one.words(),
            variant: one.variant + 1,
        });
        self.marked.push(one);
        row
    }

    /// The differences of the last marked answer, 128 by 128: 0 for none, 1 for ink of both, 2 for missing, 3 for too much.
    #[must_use]
    pub fn picture(&self) -> Vec<u8> {
        self.class.picture()
    }

    /// The mistakes so far, the most frequent first.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn mistakes(&self) -> Result<JsValue, JsValue> {
        let found = mistakes(&self.marked).into_iter();
        to_js(&found.map(|one| MistakeReport { words: one.words, answers: one.answers }).collect::<Vec<_>>())
    }

    /// The marks so far as a table for spreadsheets (CSV).
    #[must_use]
    pub fn csv(&self) -> String {
        self.class.csv(&self.marked)
    }
}

/// Whether a text is the value of `x` alone.
fn is_bare(text: &str) -> bool {
    let text = text.trim();
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'-' || byte == b'_')
}

/// The variants of an exercise that differ from its target in some properties.
///
/// # Errors
/// Throws a sentence if a property is unknown.
#[wasm_bindgen(js_name = variantsOf)]
pub fn variants_of(exercise: JsValue, varied: JsValue) -> Result<JsValue, JsValue> {
    let exercise = from_js::<Exercise>(exercise)?.within_limits();
    let varied: Vec<Varied> = from_js(varied)?;
    to_js(&exercise.with_variants(&varied).variants)
}

/// Writes an exercise as the value of `x` in a link.
///
/// # Errors
/// Throws a sentence if the exercise cannot be drawn.
#[wasm_bindgen(js_name = writeExercise)]
pub fn write_exercise(exercise: JsValue) -> Result<String, JsValue> {
    let exercise = from_js::<Exercise>(exercise)?.within_limits();
    let text = exercise.write();
    Marker::new(exercise).map_err(|errors| undrawable(&errors))?;
    Ok(text)
}
