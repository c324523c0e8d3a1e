//! Files of the system, written in steps and taken away piece by piece, so that none of them stands whole in the memory
//! of the wasm.

use crate::budget::{HISTORY, LIMITS};
use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::{Problem, problems};
use crate::to_js;
use crate::viewer::WORK;
use core::cell::RefCell;
use lsystem::drawing::{MeshMaker, Outlook, Projection, Space};
use lsystem::files::{CsvWriter, GlbWriter, ObjWriter, SvgForm, SvgWriter};
use lsystem::syntax::{Field, Kind, LimitName};
use lsystem::{
    Camera, Definition, Diagnostic, Drawer, Drawing, Limits, Mesh, Progress, Solid, Style, SvgOptions, System,
    write_json,
};
use serde::Serialize;
use std::rc::Rc;
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// Segments that are written as text at most: more than any program opens.
const TEXT_SEGMENTS: u64 = 2_000_000;
/// Segments of a mesh, of a drawing in space on paper and strokes and placed blocks of a compact picture at most: all of
/// them are in memory at once, with some hundred bytes each.
const FEW_SEGMENTS: u64 = 200_000;
/// Bytes of a mesh at most, and of a drawing that is made for one: together as much as a file may take.
const MESH: u64 = 42 << 20;
const DRAWING: Limits = Limits { memory: LIMITS.memory - MESH, ..LIMITS };
/// Symbols of a string that are written at a time.
const SYMBOLS: usize = 1 << 15;

/// Appends to a file, and says whether there is more to do.
type Writer = Box<dyn FnMut(&mut Vec<u8>) -> Result<Progress, Diagnostic>>;
/// What follows when the drawing in space is there.
type Then = Box<dyn FnOnce(Arc<Drawing<Solid>>) -> Result<Writer, Diagnostic>>;
/// A remark on a file, known when it has been written.
type Remark = Rc<RefCell<Option<Diagnostic>>>;

/// How far a file is.
enum Stage {
    /// It is of a drawing in space that is being made.
    Draw(Box<Drawer<Solid>>, Then),
    Begin(Arc<Drawing<Solid>>, Then),
    Write(Writer),
    Done,
}

/// What is said of a file at its end.
#[derive(Serialize)]
struct ExportReport {
    complete: bool,
    diagnostics: Vec<Problem>,
}

/// A file that is being written.
#[wasm_bindgen]
pub struct Export {
    stage: Stage,
    /// What has been written and not been taken yet.
    piece: Vec<u8>,
    complete: bool,
    diagnostics: Vec<Problem>,
    definition: Definition,
    remark: Remark,
    clock: Clock,
    /// Tells the playground that a file is being made.
    _busy: Rc<()>,
}

#[wasm_bindgen]
impl Export {
    /// Works for about `budget` milliseconds; whether nothing is left to do.
    pub fn step(&mut self, budget: f64) -> bool {
        let end = self.clock.now() + budget;
        loop {
            self.stage = match core::mem::replace(&mut self.stage, Stage::Done) {
                Stage::Draw(mut drawer, then) => match drawer.step(WORK as u64) {
                    Progress::More => Stage::Draw(drawer, then),
                    Progress::Done => self.go_on(drawer.finish(), |drawing, _| Stage::Begin(Arc::new(drawing), then)),
                },
                Stage::Begin(drawing, then) => self.go_on(then(drawing), |writer, _| Stage::Write(writer)),
                Stage::Write(mut writer) => {
                    let written = writer(&mut self.piece);
                    self.go_on(written, |progress, export| {
                        if progress == Progress::More {
                            return Stage::Write(writer);
                        }
                        export.complete = true;
                        export.diagnostics = problems(export.remark.take().as_slice(), &export.definition, "");
                        Stage::Done
                    })
                }
                Stage::Done => return true,
            };
            if self.clock.now() >= end {
                return matches!(self.stage, Stage::Done);
            }
        }
    }

    /// Takes away what has been written since this was called last.
    pub fn take(&mut self) -> Vec<u8> {
        core::mem::take(&mut self.piece)
    }

    /// What there is to say at the end: `{complete, diagnostics}`. It is not complete where a limit was passed or nothing
    /// has been drawn.
    ///
    /// # Errors
    /// Throws only where the result cannot be translated.
    pub fn report(&mut self) -> Result<JsValue, JsValue> {
        to_js(&ExportReport { complete: self.complete, diagnostics: core::mem::take(&mut self.diagnostics) })
    }
}

impl Export {
    /// The next stage, or the end where a limit was passed.
    fn go_on<T>(&mut self, outcome: Result<T, Diagnostic>, next: impl FnOnce(T, &mut Self) -> Stage) -> Stage {
        match outcome {
            Ok(value) => next(value, self),
            Err(limit) => {
                self.diagnostics = problems(&[limit], &self.definition, "");
                Stage::Done
            }
        }
    }
}

impl core::fmt::Debug for Export {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Export").finish_non_exhaustive()
    }
}

#[wasm_bindgen]
impl Playground {
    /// Begins the system as a file: `svg`, `svg-compact`, `csv`, `txt` (the string), `json`, `obj` or `glb` (meshes of
    /// tubes).
    ///
    /// # Errors
    /// Throws where there is no such format.
    pub fn export(&mut self, format: &str) -> Result<Export, JsValue> {
        self.history = None;
        let remark = Remark::default();
        let mut export = Export {
            stage: Stage::Done,
            piece: vec![],
            complete: false,
            diagnostics: vec![],
            definition: self.definition.clone(),
            remark: Rc::clone(&remark),
            clock: Clock::new(),
            _busy: Rc::clone(&self.files),
        };
        let drawing = &self.views.plane.drawing;
        let Some(system) = self.system.as_ref().filter(|system| system.is_solid() || drawing.is_some()) else {
            // The report says why nothing has been drawn.
            export.diagnostics.clone_from(&self.report.diagnostics);
            return Ok(export);
        };
        let flat = drawing.clone().filter(|_| !system.is_solid());
        let (style, name) = (system.style.clone(), self.definition.label().to_owned());
        export.stage = match (format, flat) {
            ("json", _) => Stage::Write(whole(write_json(&self.definition))),
            ("txt", _) => {
                let written = string(system.clone(), self.definition.iterations);
                export.go_on(written, |writer, _| Stage::Write(writer))
            }
            ("csv", Some(drawing)) => export.go_on(csv(drawing), |writer, _| Stage::Write(writer)),
            ("csv", None) => self.solid(system, Box::new(csv)),
            ("svg" | "svg-compact", Some(drawing)) => {
                let form = if format == "svg" { SvgForm::Flat } else { SvgForm::Compact };
                let written = svg(drawing, style, &self.svg_options(form), remark);
                export.go_on(written, |writer, _| Stage::Write(writer))
            }
            ("svg" | "svg-compact", None) => {
                let Camera { azimuth, elevation, .. } = self.views.solid.camera;
                let options = self.svg_options(SvgForm::Flat);
                let outlook = Outlook { azimuth, elevation };
                self.solid(system, Box::new(move |drawing| seen(drawing, outlook, style, options, remark)))
            }
            ("obj" | "glb", _) => {
                let text = format == "obj";
                self.solid(system, Box::new(move |drawing| mesh(drawing, style, name, text)))
            }
            _ => return Err(format!("there is no format `{format}`").into()),
        };
        Ok(export)
    }
}

impl Playground {
    /// A file of the drawing in space, which is made where it is not there.
    fn solid(&self, system: &System, then: Then) -> Stage {
        match &self.views.solid.drawing {
            Some(drawing) if system.is_solid() && self.built() => Stage::Begin(drawing.clone(), then),
            _ => Stage::Draw(Box::new(Drawer::solid(system, self.definition.iterations, DRAWING)), then),
        }
    }

    fn svg_options(&self, form: SvgForm) -> SvgOptions {
        let title = self.definition.label().to_owned();
        let (description, system) = (self.report.description.clone(), write_json(&self.definition));
        let most = if form == SvgForm::Compact { FEW_SEGMENTS } else { TEXT_SEGMENTS };
        SvgOptions { title, description, system, form, most, ..SvgOptions::default() }
    }
}

/// A system as text, which is short: those that can be read have texts of a mebibyte at most.
fn whole(text: String) -> Writer {
    let mut bytes = text.into_bytes();
    Box::new(move |file| {
        file.append(&mut bytes);
        Ok(Progress::Done)
    })
}

/// Writes with something that appends to a text.
fn as_text(mut write: impl FnMut(&mut String) -> Result<Progress, Diagnostic> + 'static) -> Writer {
    Box::new(move |file| {
        let mut text = String::new();
        let progress = write(&mut text)?;
        file.extend(text.into_bytes());
        Ok(progress)
    })
}

fn csv<S: Space + 'static>(drawing: Arc<Drawing<S>>) -> Result<Writer, Diagnostic> {
    let mut writer = CsvWriter::new(&drawing, TEXT_SEGMENTS)?;
    Ok(as_text(move |text| Ok(writer.step(&drawing, text, WORK as u64))))
}

fn svg(drawing: Arc<Drawing>, style: Style, options: &SvgOptions, remark: Remark) -> Result<Writer, Diagnostic> {
    let mut writer = SvgWriter::new(&drawing, &style, options)?;
    Ok(as_text(move |text| {
        let progress = writer.step(&drawing, &style, text, WORK as u64)?;
        if progress == Progress::Done {
            remark.replace(writer.warning());
        }
        Ok(progress)
    }))
}

/// Makes something in steps, until `make` gives the writer of the file; then that writes.
fn make_then_write(mut make: impl FnMut() -> Result<Option<Writer>, Diagnostic> + 'static) -> Writer {
    let mut writer: Option<Writer> = None;
    Box::new(move |file| {
        if let Some(writer) = &mut writer {
            return writer(file);
        }
        writer = make()?;
        Ok(Progress::More)
    })
}

/// A drawing in space as it is seen on paper.
fn seen(
    drawing: Arc<Drawing<Solid>>,
    outlook: Outlook,
    style: Style,
    options: SvgOptions,
    remark: Remark,
) -> Result<Writer, Diagnostic> {
    // The drawing in space is let go of when it is on paper.
    let mut making = Some((Projection::new(&drawing, &outlook, FEW_SEGMENTS)?, drawing));
    Ok(make_then_write(move || {
        if let Some((projection, drawing)) = &mut making
            && projection.step(drawing, WORK as u64) == Progress::Done
            && let Some((projection, drawing)) = making.take()
        {
            let seen = Arc::new(projection.finish(&drawing));
            return svg(seen, style.clone(), &options, Rc::clone(&remark)).map(Some);
        }
        Ok(None)
    }))
}

fn mesh(drawing: Arc<Drawing<Solid>>, style: Style, name: String, text: bool) -> Result<Writer, Diagnostic> {
    let mut maker = Some(MeshMaker::new(&drawing, &style, FEW_SEGMENTS, MESH)?);
    Ok(make_then_write(move || {
        if let Some(making) = &mut maker
            && making.step(&drawing, &style, WORK as u64)? == Progress::Done
        {
            let mesh = maker.take().map(MeshMaker::finish).unwrap_or_default();
            return Ok(Some(if text { obj(mesh, &name) } else { glb(mesh, &name) }));
        }
        Ok(None)
    }))
}

fn obj(mesh: Mesh, name: &str) -> Writer {
    let mut writer = ObjWriter::new(&mesh, name);
    as_text(move |text| Ok(writer.step(&mesh, text, WORK as u64)))
}

fn glb(mesh: Mesh, name: &str) -> Writer {
    let mut writer = GlbWriter::new(&mesh, name);
    Box::new(move |file| Ok(writer.step(&mesh, file, WORK as u64)))
}

/// The string of generation `n`, read piece by piece: by counts, or by what is remembered of the derivation.
fn string(system: System, n: u32) -> Result<Writer, Diagnostic> {
    let symbols = |n: u32| system.word(n).map(|word| word.symbols());
    let too_long = |count: u128| count > u128::from(LIMITS.symbols);
    let mut history = None;
    match symbols(n) {
        Some(count) if too_long(count) => {
            let mut largest = n.checked_sub(1);
            while let Some(n) = largest.filter(|&n| symbols(n).is_some_and(too_long)) {
                largest = n.checked_sub(1);
            }
            return Err(limit(LimitName::Symbols, LIMITS.symbols, largest));
        }
        Some(_) => {}
        None => history = Some(system.history(n, &HISTORY).ok_or_else(|| limit_of_memory(None))?),
    }
    let mut at = 0;
    Ok(as_text(move |text| {
        let before = text.len();
        match &mut history {
            None => text.push_str(&system.word(n).map(|word| word.slice(at, SYMBOLS)).unwrap_or_default()),
            Some(history) => {
                if history.symbols(n).is_none() {
                    if history.step(WORK) == Progress::Done && history.symbols(n).is_none() {
                        let largest = (0..n).rev().find(|&n| history.symbols(n).is_some());
                        return Err(limit_of_memory(largest));
                    }
                    return Ok(Progress::More);
                }
                text.push_str(&history.slice(n, at, SYMBOLS));
            }
        }
        at += SYMBOLS as u128;
        if text.len() > before {
            return Ok(Progress::More);
        }
        text.push('\n');
        Ok(Progress::Done)
    }))
}

fn limit_of_memory(largest: Option<u32>) -> Diagnostic {
    limit(LimitName::Memory, HISTORY.memory, largest)
}

fn limit(limit: LimitName, value: u64, largest: Option<u32>) -> Diagnostic {
    Diagnostic { kind: Kind::Limit { limit, value, largest }, field: Field::Numbers, span: 0..0 }
}
