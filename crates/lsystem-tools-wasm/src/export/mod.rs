//! Files of systems.
//!
//! A file is made from a definition by one call, and handed on piece by piece, so that the wasm never holds a whole
//! file.

mod maker;
mod scorm;

pub use scorm::make_package;

use js_sys::{Function, Uint8Array};
use lsystem_base::say;
use lsystem_files::{FileOptions, FileView, Format, OptionValue, Owner, PNG, make_with, write_pixels};
use lsystem_js::{from_js, to_js};
use lsystem_render::{PageCamera, PageView};
use lsystem_syntax::{Definition, Halt, Problem};
use maker::{Order, Report, Writer, make};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use ts_rs::TS;
use wasm_bindgen::prelude::*;

/// The request of the page.
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
#[derive(Serialize, TS)]
pub(crate) struct ExportReport {
    /// Whether the whole file was written: no limit was exceeded, and the definition has no errors.
    complete: bool,
    diagnostics: Vec<Problem>,
}

/// The bytes of a piece of a file.
const PIECE: usize = 1 << 20;

/// The page, which takes a file piece by piece.
struct Page<'a> {
    tell: &'a Function,
    /// The bytes that the page has not got yet.
    piece: Vec<u8>,
}

impl Page<'_> {
    fn tell(&self, value: &JsValue) -> Result<(), Halt> {
        self.tell.call1(&JsValue::UNDEFINED, value).map(drop).map_err(|_| Halt::Stopped)
    }

    fn hand_on(&mut self) -> Result<(), Halt> {
        self.tell(&Uint8Array::from(&self.piece[..]))?;
        self.piece.clear();
        Ok(())
    }
}

impl Owner for Page<'_> {
    fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
        self.piece.extend_from_slice(bytes);
        if self.piece.len() < PIECE { Ok(()) } else { self.hand_on() }
    }

    fn spent(&mut self, _: u64) -> Result<(), Halt> {
        self.tell(&JsValue::UNDEFINED)
    }
}

/// Makes a file, but no picture of pixels, of `{definition, format, options, view, camera, ratio, upto}`. `tell` is called with each piece of the
/// file, a `Uint8Array` of about 1 MiB, and without a piece at least every millisecond, as a sign of life.
///
/// Returns `{complete, diagnostics}`. The file is not complete if a limit was exceeded or the definition has errors.
///
/// # Errors
/// Throws if there is no such format or option, or if the argument cannot be translated.
#[wasm_bindgen]
pub fn make_file(asked: JsValue, tell: &Function) -> Result<JsValue, JsValue> {
    made(asked, tell, Format::named, |task, sink| make_with(task, |_, _| Err(Halt::Stopped), sink))
}

/// As [`make_file`], for pictures of pixels.
///
/// # Errors
/// As [`make_file`].
#[wasm_bindgen]
pub fn make_picture(asked: JsValue, tell: &Function) -> Result<JsValue, JsValue> {
    made(asked, tell, |name| (name == PNG.name).then_some(&PNG), write_pixels)
}

fn made(
    asked: JsValue,
    tell: &Function,
    named: fn(&str) -> Option<&'static Format>,
    write: Writer,
) -> Result<JsValue, JsValue> {
    let Asked { definition, format, options, view, camera, ratio, upto } = from_js(asked)?;
    let format = named(&format).ok_or_else(|| say!("there is no format `{}`", format))?;
    let options = FileOptions::from_values(&options)?;
    let segment = view.as_ref().and_then(PageView::origin);
    let (view, camera) = (view.map(Into::into).unwrap_or_default(), camera.map(Into::into));
    let view = FileView { view, segment, camera, upto, ratio: Some(ratio), is_described: true };
    let mut page = Page { tell, piece: vec![] };
    let Report { complete, diagnostics } = make(&Order { definition, format, options, view }, write, &mut page);
    let complete = complete && page.hand_on().is_ok();
    let report = ExportReport { complete, diagnostics };
    to_js(&report)
}
