//! Reading files.

use crate::report::{Problem, problems};
use crate::to_js;
use lsystem::Definition;
use lsystem::files::FileContent;
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// The contents of a file.
#[derive(Serialize)]
struct FileReport {
    definition: Option<Definition>,
    diagnostics: Vec<Problem>,
}

/// Reads a JSON file, or a PNG or SVG picture that carries its system: `{definition, diagnostics}`. The definition is
/// null if the file cannot be used.
///
/// # Errors
/// Throws only if the result cannot be translated.
#[wasm_bindgen]
pub fn read_file(bytes: &[u8]) -> Result<JsValue, JsValue> {
    let FileContent { definition, diagnostics, json } = lsystem::read_file(bytes);
    let texts = definition.clone().unwrap_or_default();
    to_js(&FileReport { definition, diagnostics: problems(&diagnostics, &texts, &json) })
}
