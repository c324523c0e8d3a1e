//! What a program printed, compared with a system.

use crate::{from_js, to_js};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// The result of a comparison.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct CheckReport {
    is_right: bool,
    /// The result in words: a sentence, and lines that show the difference.
    words: String,
}

/// Compares what a program printed with the generation that a definition asks for: `{isRight, words}`.
///
/// # Errors
/// Throws only if the definition or the result cannot be translated.
#[wasm_bindgen(js_name = checkOutput)]
pub fn check_output(definition: JsValue, output: &str) -> Result<JsValue, JsValue> {
    let check = lsystem_compare::check(&from_js(definition)?, output);
    to_js(&CheckReport { is_right: check.is_right(), words: check.words() })
}
