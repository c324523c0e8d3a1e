//! The two plain functions: a definition in, a string or typed arrays out.

use crate::budget::LIMITS;
use crate::report::{ThrownProblems, problems};
use crate::{from_js, to_js};
use lsystem::{Definition, Diagnostic, System};
use wasm_bindgen::prelude::*;

/// The most segments that [`draw`](fn@draw) returns. A segment takes 22 bytes, and twice as many during the copy.
const ARRAY_SEGMENTS: u64 = 16 << 20;

/// The segments of a drawing, in drawing order.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug)]
pub struct Segments {
    /// x0 y0 x1 y1 of each segment, in model units, y up.
    pub segments: js_sys::Float32Array,
    /// The colour index of each segment, not yet wrapped to a palette.
    pub colours: js_sys::Int32Array,
    /// The branch level of each segment.
    pub levels: js_sys::Uint16Array,
}

/// The string of generation `n` of a definition.
///
/// # Errors
/// Throws `{diagnostics}` if the definition has errors or the string is too long.
#[wasm_bindgen]
pub fn expand(definition: JsValue, n: u32) -> Result<String, JsValue> {
    let (definition, system) = compile(definition)?;
    lsystem::expand(&system, n, &LIMITS).map_err(|limit| failure(&definition, &[limit]))
}

/// The segments of generation `n` of a definition.
///
/// # Errors
/// Throws `{diagnostics}` if the definition has errors or the drawing is too large.
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

fn compile(definition: JsValue) -> Result<(Definition, System), JsValue> {
    let definition = from_js(definition)?;
    let (system, diagnostics) = System::new(&definition);
    match system {
        Some(system) => Ok((definition, system)),
        None => Err(failure(&definition, &diagnostics)),
    }
}

fn failure(definition: &Definition, diagnostics: &[Diagnostic]) -> JsValue {
    to_js(&ThrownProblems { diagnostics: problems(diagnostics, definition, "") }).unwrap_or_else(|error| error)
}
