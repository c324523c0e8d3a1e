//! Scripts as plain objects.

use super::words;
use lsystem_base::MAX_ITERATIONS;
use lsystem_base::say;
use lsystem_base::words::said;
use lsystem_drawing::Origin;
use lsystem_film::{Script, Subject};
use lsystem_js::{from_js, to_js};
use lsystem_syntax::{Definition, Expected, FieldSpec, classify};
use serde::Serialize;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// A script, as the page edits it.
#[derive(Serialize, TS)]
pub(crate) struct ScriptObject {
    seconds: f64,
    rate: u32,
    width: u32,
    height: u32,
    ending: &'static str,
    easing: &'static str,
    fixed: bool,
    frames: u32,
    /// The place on a segment that is the origin of views, as in links; empty for the fitted centre.
    segment: String,
    tracks: Vec<TrackObject>,
}

/// A track.
#[derive(Serialize, TS)]
pub(crate) struct TrackObject {
    subject: String,
    keys: Vec<KeyObject>,
}

/// A key.
#[derive(Serialize, TS)]
pub(crate) struct KeyObject {
    time: f64,
    value: Vec<f64>,
    easing: &'static str,
}

/// Reads the text of a film: `{seconds, rate, width, height, ending, easing, fixed, frames, segment, tracks: [{subject,
/// keys: [{time, value, easing}]}]}`.
///
/// # Errors
/// Throws the words of the first problem.
#[wasm_bindgen(js_name = readFilm)]
pub fn read_film(text: &str) -> Result<JsValue, JsValue> {
    let script: Script = text.parse().map_err(words)?;
    let tracks = script.tracks.iter().map(|track| TrackObject {
        subject: track.subject.name(),
        keys: (track.keys.iter())
            .map(|key| KeyObject { time: key.time, value: key.value.clone(), easing: key.easing.name() })
            .collect(),
    });
    to_js(&ScriptObject {
        seconds: script.seconds,
        rate: script.rate,
        width: script.size[0],
        height: script.size[1],
        ending: script.ending.name(),
        easing: script.easing.name(),
        fixed: script.fixed,
        frames: script.frames(),
        segment: script.segment.as_ref().map(Origin::text).unwrap_or_default(),
        tracks: tracks.collect(),
    })
}

/// A number of a system that a track can change.
#[derive(Serialize, TS)]
pub(crate) struct SubjectObject {
    name: String,
    label: String,
    /// The present value; null if there is none.
    value: Option<Vec<f64>>,
    /// The range in words.
    expected: String,
}

/// The numbers that tracks can change, beside view, camera and the drawn part: `[{name, label, value, expected}]`.
///
/// # Errors
/// Throws if the argument is not a definition.
#[wasm_bindgen]
pub fn subjects(definition: JsValue) -> Result<JsValue, JsValue> {
    let definition: &Definition = &from_js(definition)?;
    let mut list = vec![SubjectObject {
        name: "n".to_owned(),
        label: say!("Iterations"),
        value: Some(vec![f64::from(definition.iterations)]),
        expected: Expected::Between(0.0, f64::from(MAX_ITERATIONS)).words(),
    }];
    for subject in Subject::names().filter_map(Subject::named) {
        let Subject::Field(FieldSpec { label, expected, .. }) = subject else { continue };
        list.push(SubjectObject {
            name: subject.name(),
            label: said(label),
            value: subject.of(definition),
            expected: expected.words(),
        });
    }
    for constant in classify(definition).constants.into_iter().filter(|constant| constant.is_number) {
        let (name, value) = (constant.name, constant.value.map(|value| vec![value]));
        let subject = Subject::Constant(name.clone());
        list.push(SubjectObject { name: subject.name(), label: name, value, expected: Expected::Number.words() });
    }
    to_js(&list)
}
