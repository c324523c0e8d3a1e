//! The output of a program, compared with a system.

use lsystem_course::Verdict;
use lsystem_drawing::System;
use lsystem_js::{from_js, to_js};
use lsystem_syntax::Definition;
use serde::Serialize;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// The result of a comparison.
#[derive(Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub(crate) struct CheckReport {
    is_right: bool,
    /// The result in words: a sentence, and lines that show the difference.
    words: String,
    /// The place of the first symbol that differs, or that draws the first segment that differs: decimal digits.
    symbol: Option<String>,
}

/// Compares what a program printed with the generation that a definition asks for: `{isRight, words, symbol}`.
///
/// # Errors
/// Throws only if the definition or the result cannot be translated.
#[wasm_bindgen(js_name = checkOutput)]
pub fn check_output(definition: JsValue, output: &str) -> Result<JsValue, JsValue> {
    let definition: Definition = from_js(definition)?;
    let check = lsystem_course::check(&definition, output);
    let symbol = match &check.verdict {
        Verdict::Symbol(difference) => Some(u128::from(difference.index)),
        Verdict::Segment { index, .. } => System::new(&definition)
            .ok()
            .and_then(|system| system.word(definition.iterations)?.symbol_of_segment(u128::from(*index))),
        _ => None,
    };
    let symbol = symbol.map(|place| place.to_string());
    to_js(&CheckReport { is_right: check.is_right(), words: check.words(), symbol })
}
