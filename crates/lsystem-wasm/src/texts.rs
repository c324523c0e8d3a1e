//! Texts, files and links, without a drawing.

use lsystem::syntax::Field;
use lsystem_js::{from_js, to_js};
use wasm_bindgen::prelude::*;

/// The classes of a definition's characters and its constants, whether it is valid or not.
///
/// # Errors
/// Throws if the argument is not a definition.
#[wasm_bindgen(unchecked_return_type = "Notation")]
pub fn notation(definition: JsValue) -> Result<JsValue, JsValue> {
    to_js(&lsystem_session::notation(&from_js(definition)?))
}

/// The module at a UTF-16 offset into the `axiom` or the `rules`; null for other text.
///
/// # Errors
/// Throws if the first argument is not a definition.
#[wasm_bindgen(js_name = siteOf, unchecked_return_type = "Site | null")]
pub fn site_of(definition: JsValue, field: &str, offset: usize) -> Result<JsValue, JsValue> {
    let field = if field == "axiom" { Field::Axiom } else { Field::Rules };
    to_js(&lsystem_session::site_of(&from_js(definition)?, field, offset))
}

/// Reads a JSON file, or a PNG or SVG picture that carries its system.
///
/// # Errors
/// Throws only if the result cannot be translated.
#[wasm_bindgen(unchecked_return_type = "FileRead")]
pub fn read_file(bytes: &[u8]) -> Result<JsValue, JsValue> {
    to_js(&lsystem_session::read_file(bytes))
}

/// The modules of a text's QR code, row by row from the top left, 1 for dark. The caller adds the quiet zone of four
/// modules. `undefined` if the text is too long.
#[wasm_bindgen]
pub fn qr_code(text: &str) -> Option<Vec<u8>> {
    lsystem_session::qr_code(text)
}
