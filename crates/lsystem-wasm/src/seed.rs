//! Seeds of random choices.

use wasm_bindgen::prelude::*;

/// A random seed.
///
/// # Errors
/// Throws if the browser has no source of randomness.
#[wasm_bindgen]
pub fn fresh_seed() -> Result<u32, JsValue> {
    getrandom::u32().map_err(|error| JsValue::from_str(&error.to_string()))
}
