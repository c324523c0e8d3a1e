//! The boundary between the core and JavaScript: it translates and nothing else.
//!
//! Two plain functions, [`expand`](fn@expand) and [`draw`](fn@draw), turn a definition into a string and into typed
//! arrays. [`Playground`] is the page's handle: it keeps a system between edits, works in steps that end on time,
//! and paints an `OffscreenCanvas`. A definition is a plain object with the fields of [`lsystem::Definition`] in
//! camel case; missing ones have their defaults. What is wrong with it comes as structured values ([`Problem`])
//! with UTF-16 spans, thrown by the plain functions as `{diagnostics: [..]}`.
//!
//! Without the feature `full` there is what a first picture needs: drawings in the plane of what is right. The plain
//! functions, reading, files, space and the words of problems are left out, and a report tells what is `beyond` it.

mod brush;
mod clock;
#[cfg(feature = "full")]
mod export;
#[cfg(feature = "full")]
mod files;
#[cfg(feature = "full")]
mod mates;
mod notation;
#[cfg(feature = "full")]
mod plain;
mod plane;
mod playground;
#[cfg(feature = "full")]
mod qr;
#[cfg(feature = "full")]
mod reading;
mod report;
#[cfg(feature = "full")]
mod sharing;
#[cfg(feature = "full")]
mod solid;
mod surface;
mod viewer;

#[cfg(feature = "full")]
pub use export::Export;
#[cfg(feature = "full")]
pub use files::{Picture, read_file, tag_png};
pub use notation::notation;
#[cfg(feature = "full")]
pub use plain::{Segments, draw, expand};
pub use playground::Playground;
#[cfg(feature = "full")]
pub use qr::qr_code;
pub use report::{Problem, Report};

use lsystem::{Definition, Limits};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// What a page may spend: a string that a browser can still hold, a drawing that fits 32-bit memory.
///
/// An instance may take 256 megabytes. Of these the drawing in the making takes at most 96 ([`LIMITS`]), a derivation
/// that is remembered with the counts that a string is read by 40 ([`HISTORY`]), counts of any size 16
/// ([`lsystem::MAX_COUNTING`]) and a picture in the making 64. The rest is for the texts, the compiled system and the
/// drawing that is shown.
const LIMITS: Limits =
    Limits { symbols: 64 << 20, modules: 16 << 20, segments: 1_000_000, work: 100_000_000, memory: 112 << 20 };

/// The same for a derivation that is remembered; a string that is read by counts takes 16 megabytes at most.
#[cfg(feature = "full")]
const HISTORY: Limits = Limits { memory: 24 << 20, ..LIMITS };

/// A fresh seed.
///
/// # Errors
/// Throws where the browser has no source of randomness.
#[wasm_bindgen]
pub fn fresh_seed() -> Result<u32, JsValue> {
    getrandom::u32().map_err(|error| JsValue::from_str(&error.to_string()))
}

fn from_js(definition: JsValue) -> Result<Definition, JsValue> {
    let style = serde_wasm_bindgen::from_value(definition.clone())?;
    Ok(Definition { style, ..serde_wasm_bindgen::from_value(definition)? })
}

/// Translates to plain objects and arrays, absent values to null.
fn to_js(value: &impl Serialize) -> Result<JsValue, JsValue> {
    let plain = serde_wasm_bindgen::Serializer::json_compatible();
    value.serialize(&plain).map_err(JsValue::from)
}
