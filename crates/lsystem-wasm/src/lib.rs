//! The boundary between the core and JavaScript: it translates and nothing else.
//!
//! Two plain functions, [`expand`](fn@expand) and [`draw`](fn@draw), turn a definition into a string and into typed
//! arrays. [`Playground`] is the page's handle: it keeps a system between edits, works in steps that end on time,
//! and paints an `OffscreenCanvas`. A definition is a plain object with the fields of [`lsystem::Definition`] in
//! camel case; missing ones have their defaults. What is wrong with it comes as structured values ([`Problem`])
//! with UTF-16 spans, thrown by the plain functions as `{diagnostics: [..]}`.

mod clock;
#[cfg(feature = "full")]
mod files;
mod notation;
mod plane;
mod playground;
#[cfg(feature = "full")]
mod qr;
mod reading;
mod report;
#[cfg(feature = "full")]
mod solid;
mod surface;
mod viewer;

#[cfg(feature = "full")]
pub use files::{read, read_file, tag_png};
pub use notation::notation;
pub use playground::Playground;
#[cfg(feature = "full")]
pub use qr::qr_code;
pub use report::{Problem, Report};

use lsystem::{Definition, Diagnostic, Limits, System};
use report::{Failure, problems};
use serde::Serialize;
use wasm_bindgen::prelude::*;

/// What a page may spend: a string that a browser can still hold, a drawing that fits 32-bit memory.
const LIMITS: Limits = Limits { symbols: 64 << 20, modules: 16 << 20, segments: 1_000_000, work: 100_000_000 };

/// Segments that [`draw`](fn@draw) gives at most: 16 bytes each, twice over while they are copied out.
const ARRAY_SEGMENTS: u64 = 16 << 20;

/// The segments of a drawing, in drawing order.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug)]
pub struct Segments {
    /// x0 y0 x1 y1 of each, in model units, y up.
    pub segments: js_sys::Float32Array,
    /// The colour index of each, not yet wrapped to a palette.
    pub colours: js_sys::Int32Array,
    /// The branch level of each.
    pub levels: js_sys::Uint16Array,
}

/// The string of generation `n` of a definition.
///
/// # Errors
/// Throws `{diagnostics}` where the definition is wrong or the string too long.
#[wasm_bindgen]
pub fn expand(definition: JsValue, n: u32) -> Result<String, JsValue> {
    let (definition, system) = compile(definition)?;
    lsystem::expand(&system, n, &LIMITS).map_err(|limit| failure(&definition, &[limit]))
}

/// The segments of generation `n` of a definition.
///
/// # Errors
/// Throws `{diagnostics}` where the definition is wrong or the drawing too large.
#[wasm_bindgen]
pub fn draw(definition: JsValue, n: u32) -> Result<Segments, JsValue> {
    let (definition, system) = compile(definition)?;
    let wrong = |limit| failure(&definition, &[limit]);
    let drawing = lsystem::draw(&system, n, &LIMITS).map_err(wrong)?;
    let mut arrays = lsystem::SegmentArrays::default();
    drawing.write_segments(ARRAY_SEGMENTS, &mut arrays).map_err(wrong)?;
    Ok(Segments {
        segments: arrays.ends.as_slice().into(),
        colours: arrays.colours.as_slice().into(),
        levels: arrays.levels.as_slice().into(),
    })
}

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

fn compile(definition: JsValue) -> Result<(Definition, System), JsValue> {
    let definition = from_js(definition)?;
    let (system, diagnostics) = System::new(&definition);
    match system {
        Some(system) => Ok((definition, system)),
        None => Err(failure(&definition, &diagnostics)),
    }
}

fn failure(definition: &Definition, diagnostics: &[Diagnostic]) -> JsValue {
    to_js(&Failure { diagnostics: problems(diagnostics, definition, "") }).unwrap_or_else(|error| error)
}
