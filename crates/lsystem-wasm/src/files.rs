//! Reading files, and making pictures for files.

use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::{Problem, problems};
use crate::surface::CanvasSurface;
use crate::viewer::{NOTHING, PictureSettings, Snapshot};
use crate::{from_js, to_js};
use lsystem::files::FileContent;
use lsystem::{Definition, Progress, Viewport, write_json};
use serde::Serialize;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use web_sys::OffscreenCanvas;

/// The contents of a file.
#[derive(Serialize)]
struct FileReport {
    definition: Option<Definition>,
    diagnostics: Vec<Problem>,
}

/// Reads a JSON file, or a PNG or SVG picture that carries its system: `{definition, diagnostics}`. The definition is
/// null if the file cannot be used.
///
/// # Errors
/// Throws only if the result cannot be translated.
#[wasm_bindgen]
pub fn read_file(bytes: &[u8]) -> Result<JsValue, JsValue> {
    let FileContent { definition, diagnostics, json } = lsystem::read_file(bytes);
    let texts = definition.clone().unwrap_or_default();
    to_js(&FileReport { definition, diagnostics: problems(&diagnostics, &texts, &json) })
}

/// Puts a definition into a PNG file, for [`read_file`]. Returns other bytes unchanged.
///
/// # Errors
/// Throws if the argument is not a definition.
#[wasm_bindgen]
pub fn tag_png(bytes: Vec<u8>, definition: JsValue) -> Result<Vec<u8>, JsValue> {
    let definition = from_js(definition)?;
    Ok(lsystem::files::tag_png(&bytes, &write_json(&definition)).unwrap_or(bytes))
}

#[wasm_bindgen]
impl Playground {
    /// Starts a picture of the current view on `canvas`, at another size.
    ///
    /// # Errors
    /// Throws the reason if nothing has been drawn, if memory does not suffice, or if the canvas has no 2D context.
    pub fn snapshot(&mut self, canvas: OffscreenCanvas, width: u32, height: u32) -> Result<Picture, JsValue> {
        self.history = None;
        let ratio = self.viewport.ratio * f64::from(width) / f64::from(self.viewport.width.max(1));
        let viewport = Viewport { width, height, ratio };
        let (realm, settings) = self.shown.zip(self.settings()).ok_or(NOTHING)?;
        let snapshot = self.views.get(realm).snapshot(PictureSettings { viewport, screen: viewport, ..settings })?;
        Ok(Picture {
            snapshot,
            surface: CanvasSurface::new(canvas)?,
            clock: Clock::new(),
            _busy: Rc::clone(&self.files),
        })
    }
}

/// A picture for a file, made in steps.
#[wasm_bindgen]
pub struct Picture {
    snapshot: Box<dyn Snapshot>,
    surface: CanvasSurface,
    clock: Clock,
    /// A reference by which the playground knows that a file is in the making.
    _busy: Rc<()>,
}

#[wasm_bindgen]
impl Picture {
    /// Works for about `budget` milliseconds and puts finished bands on the canvas. Returns whether the picture is
    /// complete.
    ///
    /// # Errors
    /// Throws if the canvas refuses the picture.
    pub fn step(&mut self, budget: f64) -> Result<bool, JsValue> {
        let end = self.clock.now() + budget;
        loop {
            if self.snapshot.step() == Progress::Done {
                if let Some((pixels, viewport, band)) = self.snapshot.band() {
                    self.surface.put(pixels, viewport, band)?;
                }
                if !self.snapshot.next() {
                    return Ok(true);
                }
            }
            if self.clock.now() >= end {
                return Ok(false);
            }
        }
    }
}

impl core::fmt::Debug for Picture {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Picture").finish_non_exhaustive()
    }
}
