//! The walk of the turtle as notes.

use lsystem_base::{Limits, Meter, Progress};
use lsystem_drawing::{Figure, FigureDrawer, System};
use lsystem_files::{FileOptions, OptionValue};
use lsystem_js::{from_js, to_js};
use lsystem_render::fitted_ends;
use lsystem_sound::{SoundOptions, Tune, Walk, listen, marked};
use lsystem_syntax::{Definition, Diagnostic, Diagnostics, Halt, Work};
use serde::Serialize;
use std::collections::BTreeMap;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// The limits of drawings that are heard as a whole: they have few lines.
const SHORT: Limits = Limits { segments: 1 << 20, work: 4_000_000, memory: 32 << 20, ..Limits::PAGE };

/// A note of a tune.
#[derive(Serialize, TS)]
#[ts(rename = "Note")]
pub(crate) struct NoteObject {
    /// The start, in steps.
    start: f64,
    /// The length, in steps.
    length: f64,
    /// The pitch as a key of the MIDI standard: 60 is middle C.
    key: u8,
    /// The loudness, from 1 to 127.
    velocity: u8,
    /// The branch, or the branch level.
    voice: u32,
    /// From left (-1) to right (1).
    side: f64,
    /// The end of the line, as the page's marks take it; empty for notes in drawing order.
    fitted: Vec<f64>,
}

/// A tune.
#[derive(Serialize, TS)]
#[ts(rename = "Tune")]
pub(crate) struct TuneObject {
    notes: Vec<NoteObject>,
    /// The length, in steps.
    length: f64,
    /// The seconds of a step.
    step: f64,
    /// The facts in words.
    words: String,
}

/// A system that is heard.
#[wasm_bindgen]
pub struct Listener {
    system: System,
    n: u32,
    drawer: Option<FigureDrawer>,
    walk: Option<Walk>,
}

fn problem(error: &Diagnostic) -> JsValue {
    error.message.as_str().into()
}

#[wasm_bindgen]
impl Listener {
    /// A listener to a definition.
    ///
    /// # Errors
    /// Throws the words of the first error of the definition.
    #[wasm_bindgen(constructor)]
    pub fn new(definition: JsValue) -> Result<Self, JsValue> {
        let definition: Definition = from_js(definition)?;
        let error = |problems: Diagnostics| problems.first_error().as_ref().map_or(JsValue::NULL, problem);
        Ok(Self {
            system: System::new(&definition).map_err(error)?,
            n: definition.iterations,
            drawer: None,
            walk: None,
        })
    }

    /// Draws for about `work` units. Returns whether there is more to do before [`Listener::part`].
    ///
    /// # Errors
    /// Throws the words of an exceeded limit.
    pub fn step(&mut self, work: u32) -> Result<bool, JsValue> {
        if self.walk.is_some() {
            return Ok(false);
        }
        let drawer = &mut self.drawer;
        let drawing = drawer.get_or_insert_with(|| Figure::drawer(&marked(&self.system), self.n, Limits::PAGE));
        if drawing.step(work.into()) == Progress::More {
            return Ok(true);
        }
        let figure = drawer.take().map_or_else(|| Figure::draw(&self.system, 0, &SHORT), FigureDrawer::finish);
        self.walk = Some(Walk::new(figure.map_err(|error| problem(&error))?, &self.system));
        Ok(false)
    }

    /// At most `count` notes, of line `from` and of each `stride`-th line after it; both numbers in decimal digits.
    ///
    /// # Errors
    /// Throws if an option is not possible.
    pub fn part(&self, from: &str, stride: &str, count: u32, options: JsValue) -> Result<JsValue, JsValue> {
        let options = sound_options(options)?;
        let [from, stride] = [from, stride].map(|digits| digits.parse().unwrap_or(u128::MAX));
        let tune = self.walk.as_ref().map(|walk| walk.part(from, stride, count, &options, &mut Meter::new(u64::MAX)));
        let tune = tune.transpose().map_err(|halt| problem(&halt.diagnostic()))?.unwrap_or_default();
        to_js(&translated(&tune, &options, None))
    }

    /// The whole tune.
    ///
    /// # Errors
    /// Throws the words of an exceeded limit, or if an option is not possible.
    pub fn tune(&self, options: JsValue) -> Result<JsValue, JsValue> {
        let options = sound_options(options)?;
        let mut last = None;
        let draw = &mut |system: &System, n, _: &mut dyn Work| {
            let figure = Figure::draw(system, n, &SHORT)?;
            last = Some((n, figure.clone()));
            Ok(figure)
        };
        let tune = listen(&self.system, self.n, &options, draw, &mut Meter::new(u64::MAX));
        let tune = tune.map_err(|halt: Halt| problem(&halt.diagnostic()))?;
        let heard = match tune.heard {
            lsystem_sound::Heard::Earlier(n) => n,
            _ => self.n,
        };
        // The last drawing may have been too long.
        let figure = match last {
            Some((n, figure)) if n == heard => figure,
            _ => Figure::draw(&self.system, heard, &SHORT).map_err(|error| problem(&error))?,
        };
        to_js(&translated(&tune, &options, Some(&figure)))
    }
}

fn sound_options(values: JsValue) -> Result<SoundOptions, JsValue> {
    let values: BTreeMap<String, OptionValue> = from_js(values)?;
    Ok(FileOptions::from_values(&values)?.sound)
}

fn translated(tune: &Tune, options: &SoundOptions, figure: Option<&Figure>) -> TuneObject {
    let step = options.step_seconds();
    let notes = tune.notes.iter().map(|note| NoteObject {
        start: note.start,
        length: note.length,
        key: note.key,
        velocity: note.velocity,
        voice: note.voice,
        side: note.side,
        fitted: figure.and_then(|figure| fitted_ends(figure, note.segment)).map_or_else(Vec::new, |[_, end]| end),
    });
    TuneObject { notes: notes.collect(), length: tune.length, step, words: tune.words(step) }
}
