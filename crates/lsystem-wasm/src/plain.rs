//! The two plain functions, and seeds for them.

use lsystem_js::{from_js, thrown};
use wasm_bindgen::prelude::*;

/// The segments of a drawing, in drawing order.
#[wasm_bindgen(js_name = Segments, getter_with_clone)]
#[derive(Debug)]
pub struct PlainSegments {
    /// x0 y0 x1 y1 of each segment, in model units, y up.
    pub segments: js_sys::Float32Array,
    /// The colour index of each segment, not yet wrapped to a palette.
    pub colours: js_sys::Int32Array,
    /// The branch level of each segment.
    pub levels: js_sys::Uint16Array,
}

/// The string of generation `n` of a definition.
///
/// # Errors
/// Throws `{diagnostics}` if the definition has errors or the string is too long.
#[wasm_bindgen]
pub fn expand(definition: JsValue, n: u32) -> Result<String, JsValue> {
    lsystem_session::expand(&from_js(definition)?, n).map_err(thrown)
}

/// The segments of generation `n` of a definition.
///
/// # Errors
/// Throws `{diagnostics}` if the definition has errors or the drawing is too large.
#[wasm_bindgen]
pub fn draw(definition: JsValue, n: u32) -> Result<PlainSegments, JsValue> {
    let arrays = lsystem_session::segments(&from_js(definition)?, n).map_err(thrown)?;
    Ok(PlainSegments {
        segments: arrays.ends.as_slice().into(),
        colours: arrays.colours.as_slice().into(),
        levels: arrays.levels.as_slice().into(),
    })
}

/// A random seed.
///
/// # Errors
/// Throws if the browser has no source of randomness.
#[wasm_bindgen]
pub fn fresh_seed() -> Result<u32, JsValue> {
    getrandom::u32().map_err(|error| JsValue::from_str(&error.to_string()))
}
