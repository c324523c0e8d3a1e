//! The boundary between the core and JavaScript. This crate only translates.
//!
//! Two plain functions, [`expand`](fn@expand) and [`draw`](fn@draw), turn a definition into a string and into typed
//! arrays. [`Playground`] is the page's handle: it keeps a system between edits, works in steps that end on time,
//! and paints an `OffscreenCanvas`. A definition is a plain object with the fields of [`lsystem::Definition`] in
//! camel case; missing fields have their defaults. Errors and warnings are structured values ([`Problem`]) with UTF-16
//! spans. The plain functions throw them as `{diagnostics: [..]}`.

mod budget;
mod clock;
mod files;
mod mates;
mod notation;
mod plain;
mod plane;
mod playground;
mod qr;
mod reading;
mod report;
mod sharing;
mod solid;
mod surface;
mod viewer;

pub use files::read_file;
pub use notation::{notation, site_of};
pub use plain::{Segments, draw, expand};
pub use playground::Playground;
pub use qr::qr_code;
pub use report::{Problem, Report};

use lsystem::Definition;
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// A random seed.
///
/// # Errors
/// Throws if the browser has no source of randomness.
#[wasm_bindgen]
pub fn fresh_seed() -> Result<u32, JsValue> {
    getrandom::u32().map_err(|error| JsValue::from_str(&error.to_string()))
}

fn from_js(definition: JsValue) -> Result<Definition, JsValue> {
    Ok(serde_wasm_bindgen::from_value(definition)?)
}

/// Translates a value to plain objects and arrays; `None` becomes null.
fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    let plain = serde_wasm_bindgen::Serializer::json_compatible();
    value.serialize(&plain).map_err(JsValue::from)
}
