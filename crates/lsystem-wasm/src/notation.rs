//! The classes of a definition's characters, for syntax colours, and its constants, for changing their values.

use crate::{from_js, to_js};
use lsystem::Definition;
use lsystem::syntax::{Field, byte_offset, classify, site, utf16_letters, utf16_span};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// The texts as class letters ([`lsystem::syntax::Class`]), one for each UTF-16 unit, and the constants.
#[derive(Serialize)]
struct Notation {
    axiom: String,
    rules: String,
    overrides: String,
    constants: Vec<ConstantSpan>,
}

/// A named constant and the place of its value in the rules, in UTF-16 units.
#[derive(Serialize)]
struct ConstantSpan {
    name: String,
    /// Null if the value is not valid.
    value: Option<f64>,
    start: usize,
    end: usize,
    /// Whether the value is one number, so that another number may replace it.
    number: bool,
}

/// The texts and constants of a definition, valid or not: `{axiom, rules, overrides, constants}`. A text comes as class
/// letters, one for each UTF-16 unit; a constant is `{name, value, start, end, number}`.
///
/// # Errors
/// Throws if the argument is not a definition.
#[wasm_bindgen]
pub fn notation(definition: JsValue) -> Result<JsValue, JsValue> {
    let definition = from_js(definition)?;
    let classes = classify(&definition);
    let Definition { axiom, rules, overrides, .. } = &definition;
    let constant = |place: lsystem::syntax::ConstantPlace| {
        let span = utf16_span(rules, place.span);
        ConstantSpan { name: place.name, value: place.value, start: span.start, end: span.end, number: place.is_number }
    };
    to_js(&Notation {
        axiom: utf16_letters(axiom, &classes.axiom),
        rules: utf16_letters(rules, &classes.rules),
        overrides: utf16_letters(overrides, &classes.overrides),
        constants: classes.constants.into_iter().map(constant).collect(),
    })
}

/// The place of a written module.
#[derive(Serialize)]
struct Site {
    /// The number of the production (0-based); null for a module of the axiom.
    production: Option<usize>,
    /// The symbol that the production replaces; null for a module of the axiom.
    predecessor: Option<char>,
    /// The number of the module in the successor or in the axiom (0-based).
    position: usize,
}

/// The module at a UTF-16 offset into the `axiom` or the `rules`: `{production, predecessor, position}`; null for
/// other text.
///
/// # Errors
/// Throws if the first argument is not a definition.
#[wasm_bindgen(js_name = siteOf)]
pub fn site_of(definition: JsValue, field: &str, offset: usize) -> Result<JsValue, JsValue> {
    let Definition { axiom, rules, .. } = from_js(definition)?;
    let (field, text) = if field == "axiom" { (Field::Axiom, &axiom) } else { (Field::Rules, &rules) };
    let found = site(&axiom, &rules, field, byte_offset(text, offset));
    to_js(&found.map(|found| {
        let (production, predecessor) = found.production.unzip();
        Site { production, predecessor, position: found.position }
    }))
}
