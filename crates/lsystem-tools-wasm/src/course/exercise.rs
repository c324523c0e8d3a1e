//! Exercises: what a student sees, and marks.

use lsystem_base::say;
use lsystem_base::words::shown;
use lsystem_course::{Asks, Exercise, Given, Grade, Marker, Marking};
use lsystem_js::{from_js, to_js};
use lsystem_syntax::{Definition, Diagnostic};
use serde::Serialize;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// The units of work of one step: some milliseconds.
const WORK: u64 = 300_000;
/// The most bytes of a string to derive that are shown.
const MAX_SYMBOLS: usize = 5_000;
/// The most pixels of a picture of the target.
const MAX_PIXELS: u32 = 4_000_000;

/// The part of an exercise that a student sees.
#[derive(Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub(crate) struct AboutExercise<'a> {
    title: &'a str,
    task: &'a str,
    hints: &'a [String],
    asks: Asks,
    /// The functions to write.
    program: &'a str,
    /// The number of variants besides the target: each student gets one.
    variants: usize,
    axiom: Given,
    angle: Given,
    n: Given,
    turtle: Given,
    /// Whether some rules count that the student does not see.
    hides_rules: bool,
    asks_for_rules: bool,
    shown_rules: String,
    most_symbols: Option<u32>,
    tolerance: Option<f64>,
    /// The beginning of the string to derive, if the string is asked for.
    text: Option<&'a str>,
    /// The system with which the student starts.
    start: Definition,
    /// The system without anything that the student found, and the fields, besides the rules, that the student has to
    /// find. With them and the student's rules before the others, the system is whole. Its style is that in which the
    /// target is shown.
    fixed: Definition,
    #[ts(type = "(keyof import('./tables.js').Definition)[]")]
    free: Vec<&'static str>,
}

/// A mark, as the page shows it.
#[derive(Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub(crate) struct MarkReport {
    is_solved: bool,
    agreement: f64,
    percent: String,
    is_same: Option<bool>,
    symbols: u32,
    words: String,
    /// The beginning of the answer's string, if the string is asked for and nothing that makes it is hidden.
    text: Option<String>,
    /// The errors of the answer.
    errors: Vec<String>,
}

/// An open exercise with the mark in the making.
#[wasm_bindgen]
pub struct OpenExercise {
    marker: Marker,
    marking: Option<Marking>,
    is_solved: bool,
}

#[wasm_bindgen]
impl OpenExercise {
    /// Opens the exercise in the value of `x` in a link, or one variant of it, as [`variant_of`] names it.
    ///
    /// # Errors
    /// Throws a sentence if the exercise is damaged or cannot be drawn.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str) -> Result<Self, JsValue> {
        let (text, variant) = text.split_once('.').unwrap_or((text, ""));
        let mut exercise = Exercise::read(text).map_err(|wrong| JsValue::from(say!("The exercise {}.", wrong)))?;
        if let Ok(number) = variant.parse() {
            exercise = exercise.variant(number);
        }
        let marker = Marker::new(exercise).map_err(|errors| undrawable(&errors))?;
        Ok(Self { marker, marking: None, is_solved: false })
    }

    /// The part of the exercise that a student sees.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn about(&self) -> Result<JsValue, JsValue> {
        let exercise = self.marker.exercise();
        to_js(&AboutExercise {
            title: &exercise.title,
            task: &exercise.task,
            hints: &exercise.hints,
            asks: exercise.asks,
            program: &exercise.program,
            variants: exercise.variants.len(),
            axiom: exercise.axiom,
            angle: exercise.angle,
            n: exercise.n,
            turtle: exercise.turtle,
            hides_rules: exercise.rules.contains(&Given::Hidden),
            asks_for_rules: exercise.asks_for_rules(),
            shown_rules: exercise.shown_rules(),
            most_symbols: exercise.most_symbols,
            tolerance: exercise.tolerance,
            text: self.marker.text(MAX_SYMBOLS),
            start: exercise.start(),
            fixed: Definition { style: self.marker.shown_style(), ..exercise.fixed() },
            free: exercise.free_fields(),
        })
    }

    /// Starts to mark an answer; an unfinished mark is given up.
    ///
    /// # Errors
    /// Throws only if the definition cannot be translated.
    pub fn begin(&mut self, student: JsValue) -> Result<(), JsValue> {
        self.marking = Some(self.marker.begin(&from_js(student)?));
        Ok(())
    }

    /// Works on the mark for some milliseconds: `{isSolved, agreement, percent, isSame, symbols, words, text, errors}`
    /// after the last step, null before.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn step(&mut self) -> Result<JsValue, JsValue> {
        let Some(marking) = &mut self.marking else { return Ok(JsValue::NULL) };
        let Some(mark) = self.marker.step(marking, WORK) else { return Ok(JsValue::NULL) };
        self.marking = None;
        self.is_solved |= mark.is_solved;
        let percent = shown(&mark.percent());
        let Grade { is_solved, agreement, is_same, symbols, words, errors, .. } = mark;
        let errors = errors.iter().map(|problem| problem.message.clone()).collect();
        let exercise = self.marker.exercise();
        let is_open = exercise.axiom != Given::Hidden && !exercise.rules.contains(&Given::Hidden);
        let text = self.marker.own_text(MAX_SYMBOLS).filter(|_| is_open).map(str::to_owned);
        to_js(&MarkReport { is_solved, agreement, percent, is_same, symbols, words, text, errors })
    }

    /// The pixels of the target and of the last marked answer, 512 by 512: 1 for both, 2 for missing, 4 for too much.
    #[must_use]
    pub fn overlay(&self) -> Vec<u8> {
        self.marker.overlay()
    }

    /// The probable mistake in an answer; null if no usual mistake explains it.
    ///
    /// # Errors
    /// Throws only if the definition cannot be translated.
    pub fn hint(&self, student: JsValue) -> Result<Option<String>, JsValue> {
        Ok(self.marker.hint(&from_js(student)?))
    }

    /// The target as RGBA pixels.
    ///
    /// # Errors
    /// Throws a sentence if the target cannot be drawn.
    pub fn picture(&self, width: u32, height: u32, ratio: f64) -> Result<Vec<u8>, JsValue> {
        let height = height.min(MAX_PIXELS / width.max(1));
        self.marker.picture(width, height, ratio).map_err(|errors| undrawable(&errors))
    }

    /// The target's system, once the exercise is solved and if it shows its answer; null otherwise.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn answer(&self) -> Result<JsValue, JsValue> {
        let exercise = self.marker.exercise();
        to_js(&(self.is_solved && exercise.shows_answer).then_some(&exercise.target))
    }
}

/// An exercise for one student: its value of `x` and the number of the variant, from 1.
#[derive(Serialize, TS)]
pub(crate) struct VariantReport {
    text: String,
    variant: usize,
}

/// The exercise with the variant of a student alone: the value of `x` in a link, a full stop and the variant's number.
///
/// # Errors
/// Throws a sentence if the exercise is damaged.
#[wasm_bindgen(js_name = variantOf)]
pub fn variant_of(text: &str, student: &str) -> Result<JsValue, JsValue> {
    let exercise = Exercise::read(text).map_err(|wrong| JsValue::from(say!("The exercise {}.", wrong)))?;
    let number = exercise.variant_of(student);
    to_js(&VariantReport { text: format!("{text}.{number}"), variant: number + 1 })
}

pub(super) fn undrawable(errors: &[Diagnostic]) -> JsValue {
    let words: Vec<String> = errors.iter().map(|error| format!("{}.", error.message)).collect();
    JsValue::from(say!("The exercise cannot be drawn: {}", words.join(" ")))
}
