//! Files of systems for JavaScript. The page loads this wasm with the first file that it saves.
//!
//! A file is made in steps from a definition, and taken piece by piece, so that the wasm never holds a whole file.

mod budget;
mod maker;
mod stages;
mod string;

use lsystem_files::{FileOptions, Format, OptionValue};
use lsystem_render::{PageCamera, PageView};
use lsystem_syntax::{Definition, Problem, Progress};
use maker::{FileMaker, Order};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use wasm_bindgen::prelude::*;

/// What the page asks for.
#[derive(Deserialize)]
struct Asked {
    definition: Definition,
    /// The name of a format of [`lsystem_files::FORMATS`].
    format: String,
    /// The choices that differ from the defaults of [`lsystem_files::FILE_OPTIONS`], by name.
    #[serde(default)]
    options: BTreeMap<String, OptionValue>,
    /// The place of pictures of pixels in the plane; the whole drawing if it is missing.
    view: Option<PageView>,
    /// The camera on drawings in space; the page's first one if it is missing.
    camera: Option<PageCamera>,
    /// Device pixels in a CSS pixel, for pictures of pixels.
    #[serde(default = "one")]
    ratio: f64,
    /// The number of segments that pictures of pixels show; all if it is missing.
    upto: Option<u128>,
}

const fn one() -> f64 {
    1.0
}

/// The report on a finished file.
#[derive(Serialize)]
struct ExportReport<'a> {
    complete: bool,
    diagnostics: &'a [Problem],
}

/// A file in the making.
#[wasm_bindgen]
pub struct Export(FileMaker);

#[wasm_bindgen]
impl Export {
    /// Begins a file: `{definition, format, options, view, camera, ratio, upto}`.
    ///
    /// # Errors
    /// Throws if there is no such format or option, or if the argument cannot be translated.
    #[wasm_bindgen(constructor)]
    pub fn new(asked: JsValue) -> Result<Self, JsValue> {
        let Asked { definition, format, options, view, camera, ratio, upto } = serde_wasm_bindgen::from_value(asked)?;
        let format = Format::named(&format).ok_or_else(|| format!("there is no format `{format}`"))?;
        let options = FileOptions::from_values(&options)?;
        let (view, camera) = (view.map(Into::into).unwrap_or_default(), camera.map(Into::into).unwrap_or_default());
        Ok(Self(FileMaker::new(Order { definition, format, options, view, camera, ratio, upto })))
    }

    /// Works for well under a millisecond. Returns whether the file is at its end.
    pub fn step(&mut self) -> bool {
        self.0.step() == Progress::Done
    }

    /// The number of bytes that can be taken.
    #[wasm_bindgen(getter)]
    pub fn waiting(&self) -> usize {
        self.0.waiting()
    }

    /// Takes the bytes written since the last call.
    pub fn take(&mut self) -> Vec<u8> {
        self.0.take()
    }

    /// The report at the end: `{complete, diagnostics}`. The file is not complete if a limit was exceeded or the
    /// definition has errors.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn report(&self) -> Result<JsValue, JsValue> {
        let report = ExportReport { complete: self.0.complete, diagnostics: &self.0.diagnostics };
        report.serialize(&serde_wasm_bindgen::Serializer::json_compatible()).map_err(JsValue::from)
    }
}

impl core::fmt::Debug for Export {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Export").finish_non_exhaustive()
    }
}
