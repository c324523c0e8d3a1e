//! New systems.

use crate::to_js;
use wasm_bindgen::prelude::*;

/// The new system with this seed: always the same.
///
/// # Errors
/// Throws only if the result cannot be translated.
#[wasm_bindgen]
pub fn surprise(seed: u32) -> Result<JsValue, JsValue> {
    to_js(&lsystem_invent::surprise(seed).0)
}
