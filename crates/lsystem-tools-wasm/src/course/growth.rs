//! How the generations of a system grow.

use lsystem_base::words::said;
use lsystem_course::growth::{Growth, growth as growth_of};
use lsystem_drawing::System;
use lsystem_js::{from_js, to_js};
use lsystem_syntax::Definition;
use serde::Serialize;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// The most letters of the matrix on the page.
const MAX_SHOWN: usize = 12;

#[derive(Serialize, TS)]
#[serde(rename_all = "camelCase")]
pub(crate) struct GrowthReport {
    /// The growth, or why it is not known.
    growth: Option<Growth>,
    why: String,
    csv: String,
    latex: String,
    shown: usize,
}

/// How the generations of a definition grow, at least up to its own: `{growth, why, csv, latex, shown}`.
///
/// # Errors
/// Throws only if the definition or the result cannot be translated.
#[wasm_bindgen]
pub fn growth(definition: JsValue) -> Result<JsValue, JsValue> {
    let definition: Definition = from_js(definition)?;
    let system = System::new(&definition).map_err(|problems| problems.to_string());
    let made = system.and_then(|system| growth_of(&system, definition.iterations).map_err(said));
    let (csv, latex) = made.as_ref().map_or_else(|_| Default::default(), |growth| (growth.csv(), growth.latex()));
    let why = made.as_ref().err().cloned().unwrap_or_default();
    to_js(&GrowthReport { growth: made.ok(), why, csv, latex, shown: MAX_SHOWN })
}
