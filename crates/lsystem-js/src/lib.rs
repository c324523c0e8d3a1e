//! What the boundaries between the core and JavaScript share: values cross as plain objects and arrays, and JavaScript
//! gives the words of the reader's language. Each boundary is a wasm of its own, so this crate exports nothing itself.

mod reader;

pub use reader::set_reader;

use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::JsValue;

/// Translates a plain object.
///
/// # Errors
/// If the object is something else.
pub fn from_js<T: DeserializeOwned>(value: JsValue) -> Result<T, JsValue> {
    Ok(serde_wasm_bindgen::from_value(value)?)
}

/// Translates a value to plain objects and arrays; `None` becomes null.
///
/// # Errors
/// If the value has no such form.
pub fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    let plain = serde_wasm_bindgen::Serializer::json_compatible();
    value.serialize(&plain).map_err(JsValue::from)
}

/// The error of a result as a plain object.
pub fn thrown(error: impl Serialize) -> JsValue {
    to_js(&error).unwrap_or_else(|error| error)
}
