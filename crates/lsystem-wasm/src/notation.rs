//! How the texts of a definition read, for showing them in colours and for changing their constants.

use crate::{from_js, to_js};
use lsystem::Definition;
use lsystem::syntax::{classify, utf16_letters, utf16_span};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// The letter of its class ([`lsystem::syntax::Class`]) for each UTF-16 unit of a text.
#[derive(Serialize)]
struct Notation {
    axiom: String,
    rules: String,
    overrides: String,
    constants: Vec<Constant>,
}

/// A named constant and where its value stands in the rules, in UTF-16 units.
#[derive(Serialize)]
struct Constant {
    name: String,
    /// Null where it is wrong.
    value: Option<f64>,
    start: usize,
    end: usize,
    /// Whether the value is one number, so that another number may stand in its place.
    number: bool,
}

/// How the texts of a definition read, be they right or wrong: `{axiom, rules, overrides, constants}`. The texts come
/// as the letters of their classes, one for each UTF-16 unit; a constant is `{name, value, start, end, number}`.
///
/// # Errors
/// Throws where the argument is not a definition at all.
#[wasm_bindgen]
pub fn notation(definition: JsValue) -> Result<JsValue, JsValue> {
    let definition = from_js(definition)?;
    let classes = classify(&definition);
    let Definition { axiom, rules, overrides, .. } = &definition;
    let constant = |place: lsystem::syntax::ConstantPlace| {
        let span = utf16_span(rules, place.span);
        Constant { name: place.name, value: place.value, start: span.start, end: span.end, number: place.is_number }
    };
    to_js(&Notation {
        axiom: utf16_letters(axiom, &classes.axiom),
        rules: utf16_letters(rules, &classes.rules),
        overrides: utf16_letters(overrides, &classes.overrides),
        constants: classes.constants.into_iter().map(constant).collect(),
    })
}
