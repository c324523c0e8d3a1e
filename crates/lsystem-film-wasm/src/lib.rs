//! Films for JavaScript. The page loads this wasm with the first film.

mod player;
mod preset;
mod script;

pub use player::FilmPlayer;
pub use preset::with_preset;
pub use script::{read_film, subjects};

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

/// An error as its words.
fn words(error: impl core::fmt::Display) -> JsValue {
    error.to_string().into()
}
