//! What a course needs, for JavaScript. The page loads this wasm with the first exercise, check or lesson.

mod check;
mod exercise;
mod growth;
mod steps;

pub use check::check_output;
pub use exercise::{OpenExercise, write_exercise};
pub use growth::growth;
pub use steps::{one_by_one, step_rows, turtle_trace};

use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::*;

fn from_js<T: DeserializeOwned>(value: JsValue) -> Result<T, JsValue> {
    Ok(serde_wasm_bindgen::from_value(value)?)
}

/// Translates a value to plain objects and arrays; `None` becomes null.
fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    let plain = serde_wasm_bindgen::Serializer::json_compatible();
    value.serialize(&plain).map_err(JsValue::from)
}
