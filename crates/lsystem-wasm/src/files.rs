//! Files: systems read from them and written to them.

use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::{Problem, problems};
use crate::surface::Surface;
use crate::viewer::{Scene, Snapshot};
use crate::{LIMITS, from_js, to_js};
use js_sys::{Reflect, Uint8Array};
use lsystem::{
    Camera, Definition, FileContent, Mesh, Outlook, Progress, SvgForm, SvgOptions, Viewport, draw_solid, expand,
    write_csv, write_glb, write_json, write_obj, write_svg,
};
use serde::Serialize;
use std::sync::Arc;
use wasm_bindgen::prelude::*;
use web_sys::OffscreenCanvas;

/// Segments that are written as text at most: more than any program opens.
const TEXT_SEGMENTS: u64 = 2_000_000;
/// Segments of a mesh at most: as much as a browser saves without trouble.
const MESH_SEGMENTS: u64 = 200_000;

/// What a file says.
#[derive(Serialize)]
struct FileReport {
    definition: Option<Definition>,
    diagnostics: Vec<Problem>,
}

/// What an export gives.
#[derive(Serialize)]
struct ExportReport {
    text: Option<String>,
    diagnostics: Vec<Problem>,
}

/// Reads a file's bytes, be it JSON or a PNG or SVG picture that carries its system: `{definition, diagnostics}`, the
/// definition null where the file cannot be used.
///
/// # Errors
/// Throws only where the result cannot be translated.
#[wasm_bindgen]
pub fn read_file(bytes: &[u8]) -> Result<JsValue, JsValue> {
    let FileContent { definition, diagnostics, json } = lsystem::read_file(bytes);
    let texts = definition.clone().unwrap_or_default();
    to_js(&FileReport { definition, diagnostics: problems(&diagnostics, &texts, &json) })
}

/// A PNG file with a definition in it, so that [`read_file`] finds it again; bytes that are no PNG file as they are.
///
/// # Errors
/// Throws where the argument is not a definition at all.
#[wasm_bindgen]
pub fn tag_png(bytes: Vec<u8>, definition: JsValue) -> Result<Vec<u8>, JsValue> {
    let definition = from_js(definition)?;
    Ok(lsystem::tag_png(&bytes, &write_json(&definition)).unwrap_or(bytes))
}

#[wasm_bindgen]
impl Playground {
    /// The system as a file: `svg`, `svg-compact`, `csv`, `txt` (the string), `json`, `obj` or `glb` (meshes of tubes);
    /// `{text, diagnostics}`, the text null where a limit was passed or nothing has been drawn. What is no text stands
    /// in `bytes` instead.
    ///
    /// # Errors
    /// Throws where there is no such format.
    pub fn export(&self, format: &str) -> Result<JsValue, JsValue> {
        let Some(system) =
            self.system.as_ref().filter(|system| system.is_solid() || self.views.plane.drawing.is_some())
        else {
            // The report says why nothing has been drawn.
            return to_js(&ExportReport { text: None, diagnostics: self.report.diagnostics.clone() });
        };
        let (definition, n) = (&self.definition, self.definition.iterations);
        let solid = || match &self.views.solid.drawing {
            Some(drawing) if system.is_solid() && self.built() => Ok(drawing.clone()),
            _ => draw_solid(system, n, &LIMITS).map(Arc::new),
        };
        let mesh = || Mesh::new(&*solid()?, &system.style, MESH_SEGMENTS);
        let Camera { azimuth, elevation, .. } = self.views.solid.camera;
        let seen = || solid()?.seen_from(&Outlook { azimuth, elevation }, TEXT_SEGMENTS);
        let name = definition.label();
        let svg = |form| {
            let options = self.svg_options(form);
            let svg = match &self.views.plane.drawing {
                Some(drawing) if !system.is_solid() => write_svg(drawing, &system.style, &options)?,
                _ => write_svg(&seen()?, &system.style, &options)?,
            };
            let warning = svg.warning();
            Ok((svg.text, warning))
        };
        let exported = match format {
            "json" => Ok((write_json(definition), None)),
            "txt" => expand(system, n, &LIMITS).map(|text| (text + "\n", None)),
            "svg" => svg(SvgForm::Flat),
            "svg-compact" => svg(SvgForm::Compact),
            "csv" => match &self.views.plane.drawing {
                Some(drawing) if !system.is_solid() => write_csv(drawing, TEXT_SEGMENTS),
                _ => solid().and_then(|drawing| write_csv(&*drawing, TEXT_SEGMENTS)),
            }
            .map(|text| (text, None)),
            "obj" => mesh().map(|mesh| (write_obj(&mesh, name), None)),
            "glb" => match mesh() {
                Ok(mesh) => {
                    let report = to_js(&ExportReport { text: None, diagnostics: vec![] })?;
                    let bytes = Uint8Array::from(write_glb(&mesh, name).as_slice());
                    Reflect::set(&report, &"bytes".into(), &bytes)?;
                    return Ok(report);
                }
                Err(limit) => Err(limit),
            },
            _ => return Err(format!("there is no format `{format}`").into()),
        };
        let (text, diagnostic) = match exported {
            Ok((text, warning)) => (Some(text), warning),
            Err(limit) => (None, Some(limit)),
        };
        to_js(&ExportReport { text, diagnostics: problems(diagnostic.as_slice(), definition, "") })
    }

    /// Starts a picture of the current view at another size.
    ///
    /// # Errors
    /// Throws where nothing has been drawn.
    pub fn snapshot(&self, width: u32, height: u32) -> Result<Picture, JsValue> {
        let ratio = self.viewport.ratio * f64::from(width) / f64::from(self.viewport.width.max(1));
        let viewport = Viewport { width, height, ratio };
        let snapshot = self
            .shown
            .zip(self.scene())
            .and_then(|(realm, scene)| self.views.get(realm).snapshot(Scene { viewport, ..scene }));
        let snapshot = snapshot.ok_or("nothing has been drawn yet")?;
        Ok(Picture { snapshot, clock: Clock::new() })
    }
}

/// A picture for a file, made in steps.
#[wasm_bindgen]
pub struct Picture {
    snapshot: Box<dyn Snapshot>,
    clock: Clock,
}

#[wasm_bindgen]
impl Picture {
    /// Works for about `budget` milliseconds; whether the picture is there.
    pub fn step(&mut self, budget: f64) -> bool {
        let end = self.clock.now() + budget;
        loop {
            let done = self.snapshot.step() == Progress::Done;
            if done || self.clock.now() >= end {
                return done;
            }
        }
    }

    /// Paints it onto a canvas, which gets its size.
    ///
    /// # Errors
    /// Throws where the canvas refuses the picture.
    pub fn paint(&self, canvas: OffscreenCanvas) -> Result<(), JsValue> {
        let (pixels, viewport) = self.snapshot.picture();
        Surface::new(canvas)?.show(pixels, viewport)
    }
}

impl core::fmt::Debug for Picture {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Picture").finish_non_exhaustive()
    }
}

impl Playground {
    fn svg_options(&self, form: SvgForm) -> SvgOptions {
        let title = self.definition.label().to_owned();
        let (description, system) = (self.report.description.clone(), write_json(&self.definition));
        SvgOptions { title, description, system, form, most: TEXT_SEGMENTS, ..SvgOptions::default() }
    }
}
