//! The boundary between the core and the JavaScript of the npm package, which is in `npm`. This crate reads systems as
//! scripts hold them, and makes strings, arrays of segments and files.
//!
//! `npm/library.js` wraps these exports: it turns objects into JSON texts, frees handles, and throws errors of its own
//! class. A refusal crosses the boundary as `{message, diagnostics}`.

mod files;
mod opened;
mod segments;
mod strings;

use js_sys::{JsString, Uint8Array};
use lsystem_js::{thrown, to_js};
use opened::{OpenSystem, Refusal};
use segments::{SegmentPages, draw};
use strings::SymbolPages;
use wasm_bindgen::prelude::*;

/// A system whose problems, if it has any, are warnings.
#[wasm_bindgen(js_name = System)]
#[derive(Debug)]
pub struct ScriptSystem(OpenSystem);

/// The segments of a drawing, in drawing order.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug)]
pub struct Segments {
    /// 2 in the plane, 3 in space.
    pub dimension: u32,
    /// The coordinates of both ends of each segment, in model units, y up.
    pub segments: js_sys::Float32Array,
    /// The colour index of each segment, not yet wrapped to a palette.
    pub colours: js_sys::Int32Array,
    /// The branch level of each segment.
    pub levels: js_sys::Uint16Array,
}

#[wasm_bindgen(js_class = System)]
impl ScriptSystem {
    /// Reads an object of [`lsystem_files::read_fields`]. `n` replaces its number of iterations.
    ///
    /// # Errors
    /// Throws a refusal if the object has errors or unknown fields.
    #[wasm_bindgen(constructor)]
    pub fn new(text: &str, n: Option<f64>) -> Result<Self, JsValue> {
        OpenSystem::read(text, n).map(Self).map_err(thrown)
    }

    /// The string.
    ///
    /// # Errors
    /// Throws a refusal if the string is too long.
    pub fn expand(&self) -> Result<String, JsValue> {
        strings::expand(&self.0).map_err(thrown)
    }

    /// The numbers of symbols and of segments, in decimal digits.
    ///
    /// # Errors
    /// Throws a refusal if the numbers are only found by a derivation that is too long.
    pub fn count(&self) -> Result<Vec<String>, JsValue> {
        strings::count(&self.0).map(Vec::from).map_err(thrown)
    }

    /// A reader of the string.
    ///
    /// # Errors
    /// Throws a refusal if the string is too long to be read.
    pub fn symbols(&self) -> Result<SymbolReader, JsValue> {
        SymbolPages::new(&self.0).map(SymbolReader).map_err(thrown)
    }

    /// All segments as arrays.
    ///
    /// # Errors
    /// Throws a refusal if the drawing is too large.
    pub fn draw(&self) -> Result<Segments, JsValue> {
        let drawn = draw(&self.0).map_err(thrown)?;
        Ok(Segments {
            dimension: drawn.dimension,
            segments: drawn.arrays.ends.as_slice().into(),
            colours: drawn.arrays.colours.as_slice().into(),
            levels: drawn.arrays.levels.as_slice().into(),
        })
    }

    /// A reader of the segments.
    ///
    /// # Errors
    /// Throws a refusal if the drawing is too large.
    pub fn segments(&self) -> Result<SegmentReader, JsValue> {
        SegmentPages::new(&self.0).map(SegmentReader).map_err(thrown)
    }

    /// A file in a format of [`lsystem_files::FORMATS`]: a `Uint8Array`, or a string if the format is a text. `options`
    /// are `{values, view, camera, ratio}`.
    ///
    /// # Errors
    /// Throws a refusal if there is no such format or option, or if a limit is exceeded.
    pub fn file(&self, format: &str, options: JsValue) -> Result<JsValue, JsValue> {
        let format = files::format(format).map_err(thrown)?;
        let request =
            serde_wasm_bindgen::from_value(options).map_err(|error| thrown(Refusal::words(error.to_string())))?;
        let bytes = files::make(&self.0, format, &request).map_err(thrown)?;
        if format.is_binary {
            return Ok(Uint8Array::from(&*bytes).into());
        }
        Ok(JsString::from(&*String::from_utf8_lossy(&bytes)).into())
    }
}

/// Reads a string page by page.
#[wasm_bindgen]
#[derive(Debug)]
pub struct SymbolReader(SymbolPages);

#[wasm_bindgen]
impl SymbolReader {
    /// The next symbols; empty at the end.
    pub fn page(&mut self) -> String {
        self.0.next_page()
    }

    /// Whether each symbol ends with a line end, because some may have arguments or names in backquotes.
    #[wasm_bindgen(getter)]
    pub fn apart(&self) -> bool {
        self.0.is_apart()
    }
}

/// Reads the segments of a drawing page by page.
#[wasm_bindgen]
#[derive(Debug)]
pub struct SegmentReader(SegmentPages);

#[wasm_bindgen]
impl SegmentReader {
    /// Eight numbers for each of the next segments: three coordinates of each end, the colour, the level. Empty at the
    /// end.
    pub fn page(&mut self) -> Vec<f64> {
        self.0.next_page()
    }

    /// 2 in the plane, 3 in space.
    #[wasm_bindgen(getter)]
    pub fn dimension(&self) -> u32 {
        self.0.dimension()
    }
}

/// The problems of an object of [`lsystem_files::read_fields`].
///
/// # Errors
/// Throws only if the result cannot be translated.
#[wasm_bindgen]
pub fn check(text: &str) -> Result<JsValue, JsValue> {
    to_js(&opened::Reading::of_object(text, None).problems)
}

/// The problems and the definition of a file: `{definition, problems}`. JSON, or a picture that holds its system.
///
/// # Errors
/// Throws a refusal if the file has no system.
#[wasm_bindgen]
pub fn read(bytes: &[u8]) -> Result<JsValue, JsValue> {
    let reading = opened::Reading::of_file(bytes);
    match &reading.definition {
        Some(_) => to_js(&reading),
        None => Err(thrown(reading.refusal())),
    }
}
