//! Export files, written in steps. The page takes them piece by piece, so that the wasm never holds a whole file.

use crate::budget::{HISTORY, LIMITS};
use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::{Problem, problems};
use crate::to_js;
use crate::viewer::WORK;
use lsystem::drawing::{MeshMaker, Outlook, Projection};
use lsystem::files::{Content, FileOptions, Format, Writer};
use lsystem::syntax::{Field, Kind, LimitName};
use lsystem::{
    Camera, Definition, Diagnostic, Drawer, Drawing, Limits, Mesh, Progress, Solid, Style, System, write_json,
};
use serde::Serialize;
use std::rc::Rc;
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// The most segments of a text file: more than any program opens.
const TEXT_SEGMENTS: u64 = 2_000_000;
/// The most segments of a mesh or of a projected drawing, and the most strokes and placed blocks of a compact picture.
/// All are in memory at once, with some hundred bytes each.
const FEW_SEGMENTS: u64 = 200_000;
/// The most bytes of a mesh. A mesh and a drawing made for a file share the file's memory.
const MESH: u64 = 42 << 20;
/// The limits of a drawing that is made for a file.
const DRAWING: Limits = Limits { memory: LIMITS.memory - MESH, ..LIMITS };
/// The number of symbols of a string that are written at a time.
const SYMBOLS: usize = 1 << 15;

/// A file in the making.
type FileWriter = Box<dyn Writer>;
/// Begins the file of a drawing in space.
type BeginFile = Box<dyn FnOnce(Arc<Drawing<Solid>>) -> Result<FileWriter, Diagnostic>>;

/// The stage of a file.
enum Stage {
    /// Make the drawing in space.
    Draw(Box<Drawer<Solid>>, BeginFile),
    /// Begin the file of a drawing in space.
    Begin(Arc<Drawing<Solid>>, BeginFile),
    Write(FileWriter),
    Done,
}

/// The report on a finished file.
#[derive(Serialize)]
struct ExportReport {
    complete: bool,
    diagnostics: Vec<Problem>,
}

/// A file that is being written.
#[wasm_bindgen]
pub struct Export {
    stage: Stage,
    /// The bytes written and not yet taken.
    piece: Vec<u8>,
    complete: bool,
    diagnostics: Vec<Problem>,
    definition: Definition,
    clock: Clock,
    /// A reference by which the playground knows that a file is in the making.
    _busy: Rc<()>,
}

#[wasm_bindgen]
impl Export {
    /// Works for about `budget` milliseconds. Returns whether the file is at its end.
    pub fn step(&mut self, budget: f64) -> bool {
        let end = self.clock.now() + budget;
        loop {
            self.stage = match core::mem::replace(&mut self.stage, Stage::Done) {
                Stage::Draw(mut drawer, begin) => match drawer.step(WORK as u64) {
                    Progress::More => Stage::Draw(drawer, begin),
                    Progress::Done => {
                        self.advance(drawer.finish(), |drawing, _| Stage::Begin(Arc::new(drawing), begin))
                    }
                },
                Stage::Begin(drawing, begin) => self.advance(begin(drawing), |writer, _| Stage::Write(writer)),
                Stage::Write(mut writer) => {
                    let written = writer.step(&mut self.piece, WORK as u64);
                    self.advance(written, |progress, export| {
                        if progress == Progress::More {
                            return Stage::Write(writer);
                        }
                        export.complete = true;
                        export.diagnostics = problems(writer.remark().as_slice(), &export.definition, "");
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

    /// Takes the bytes written since the last call.
    pub fn take(&mut self) -> Vec<u8> {
        core::mem::take(&mut self.piece)
    }

    /// The report at the end: `{complete, diagnostics}`. The file is not complete if a limit was exceeded or nothing
    /// has been drawn.
    ///
    /// # Errors
    /// Throws only if the result cannot be translated.
    pub fn report(&mut self) -> Result<JsValue, JsValue> {
        to_js(&ExportReport { complete: self.complete, diagnostics: core::mem::take(&mut self.diagnostics) })
    }
}

impl Export {
    /// The stage `next`, or the end if a limit was exceeded.
    fn advance<T>(&mut self, outcome: Result<T, Diagnostic>, next: impl FnOnce(T, &mut Self) -> Stage) -> Stage {
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
    /// Begins a file of the system, in one of the formats of [`lsystem::files::FORMATS`] without pixels. A `bare`
    /// picture does not have the system inside.
    ///
    /// # Errors
    /// Throws if there is no such format.
    pub fn export(&mut self, format: &str, bare: bool) -> Result<Export, JsValue> {
        let found = Format::named(format).filter(|format| !matches!(format.content, Content::Pixels));
        let content = found.ok_or_else(|| format!("there is no format `{format}`"))?.content;
        self.history = None;
        let mut export = Export {
            stage: Stage::Done,
            piece: vec![],
            complete: false,
            diagnostics: vec![],
            definition: self.definition.clone(),
            clock: Clock::new(),
            _busy: Rc::clone(&self.files),
        };
        let drawing = &self.views.plane.drawing;
        let Some(system) = self.system.as_ref().filter(|system| system.is_solid() || drawing.is_some()) else {
            // The report has the reason why nothing has been drawn.
            export.diagnostics.clone_from(&self.report.diagnostics);
            return Ok(export);
        };
        let flat = drawing.clone().filter(|_| !system.is_solid());
        let (style, name) = (system.style.clone(), self.definition.label().to_owned());
        export.stage = match (content, flat) {
            (Content::System, _) => Stage::Write(text_file(write_json(&self.definition))),
            (Content::Words(write), _) => {
                let written = write(&self.definition, system, &self.options(TEXT_SEGMENTS, bare));
                export.advance(written, |writer, _| Stage::Write(writer))
            }
            (Content::String | Content::Pixels, _) => {
                let written = string_file(system.clone(), self.definition.iterations);
                export.advance(written, |writer, _| Stage::Write(writer))
            }
            (Content::Segments { plane, .. }, Some(drawing)) => {
                export.advance(plane(drawing, TEXT_SEGMENTS), |writer, _| Stage::Write(writer))
            }
            (Content::Segments { space, .. }, None) => {
                self.solid_file(system, Box::new(move |drawing| space(drawing, TEXT_SEGMENTS)))
            }
            (Content::Paper(write), Some(drawing)) => {
                let most = if format == "svg-compact" { FEW_SEGMENTS } else { TEXT_SEGMENTS };
                export.advance(write(drawing, style, &self.options(most, bare)), |writer, _| Stage::Write(writer))
            }
            (Content::Paper(write), None) => {
                let Camera { azimuth, elevation, .. } = self.views.solid.camera;
                let (outlook, options) = (Outlook { azimuth, elevation }, self.options(TEXT_SEGMENTS, bare));
                let write = move |drawing| write(drawing, style.clone(), &options);
                self.solid_file(system, Box::new(move |drawing| projected_file(drawing, outlook, write)))
            }
            (Content::Mesh { is_printed, write }, _) => {
                let begin = move |drawing| mesh_file(drawing, style, is_printed, move |mesh| write(mesh, &name));
                self.solid_file(system, Box::new(begin))
            }
        };
        Ok(export)
    }
}

impl Playground {
    /// A file of the drawing in space; if there is none, it is made first.
    fn solid_file(&self, system: &System, begin: BeginFile) -> Stage {
        match &self.views.solid.drawing {
            Some(drawing) if system.is_solid() && self.built() => Stage::Begin(drawing.clone(), begin),
            _ => Stage::Draw(Box::new(Drawer::solid(system, self.definition.iterations, DRAWING)), begin),
        }
    }

    fn options(&self, most: u64, bare: bool) -> FileOptions {
        let title = self.definition.label().to_owned();
        let system = if bare { String::new() } else { write_json(&self.definition) };
        let description = self.report.description.clone();
        FileOptions { title, description, system, most, ..FileOptions::default() }
    }
}

/// A writer from a function.
struct FunctionWriter<F>(F);

impl<F: FnMut(&mut Vec<u8>) -> Result<Progress, Diagnostic>> Writer for FunctionWriter<F> {
    fn step(&mut self, file: &mut Vec<u8>, _: u64) -> Result<Progress, Diagnostic> {
        (self.0)(file)
    }
}

/// A short text, written in one step: a system has texts of at most 1 MiB.
fn text_file(text: String) -> FileWriter {
    let mut bytes = text.into_bytes();
    Box::new(FunctionWriter(move |file: &mut Vec<u8>| {
        file.append(&mut bytes);
        Ok(Progress::Done)
    }))
}

/// A writer that is prepared in steps: `make` returns the writer of the file in the end.
struct PreparedWriter<F> {
    make: F,
    writer: Option<FileWriter>,
}

impl<F: FnMut() -> Result<Option<FileWriter>, Diagnostic>> Writer for PreparedWriter<F> {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        if let Some(writer) = &mut self.writer {
            return writer.step(file, work);
        }
        self.writer = (self.make)()?;
        Ok(Progress::More)
    }

    fn remark(&self) -> Option<Diagnostic> {
        self.writer.as_ref()?.remark()
    }
}

/// A file of the projection of a drawing in space.
fn projected_file(
    drawing: Arc<Drawing<Solid>>,
    outlook: Outlook,
    write: impl Fn(Arc<Drawing>) -> Result<FileWriter, Diagnostic> + 'static,
) -> Result<FileWriter, Diagnostic> {
    // The drawing in space is dropped after the projection, to save memory.
    let mut making = Some((Projection::new(&drawing, &outlook, FEW_SEGMENTS)?, drawing));
    let make = move || {
        if let Some((projection, drawing)) = &mut making
            && projection.step(drawing, WORK as u64) == Progress::Done
            && let Some((projection, drawing)) = making.take()
        {
            return write(Arc::new(projection.finish(&drawing))).map(Some);
        }
        Ok(None)
    };
    Ok(Box::new(PreparedWriter { make, writer: None }))
}

/// A file of the mesh of a drawing in space.
fn mesh_file(
    drawing: Arc<Drawing<Solid>>,
    style: Style,
    is_printed: bool,
    write: impl Fn(Mesh) -> FileWriter + 'static,
) -> Result<FileWriter, Diagnostic> {
    let maker = MeshMaker::new(&drawing, &style, FEW_SEGMENTS, MESH)?;
    let mut maker = Some(if is_printed { maker.for_printing() } else { maker });
    let make = move || {
        if let Some(making) = &mut maker
            && making.step(&drawing, &style, WORK as u64)? == Progress::Done
        {
            return Ok(Some(write(maker.take().map(MeshMaker::finish).unwrap_or_default())));
        }
        Ok(None)
    };
    Ok(Box::new(PreparedWriter { make, writer: None }))
}

/// A file of the string of generation `n`, read piece by piece by counts or from a remembered derivation.
fn string_file(system: System, n: u32) -> Result<FileWriter, Diagnostic> {
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
    Ok(Box::new(FunctionWriter(move |file: &mut Vec<u8>| {
        let text = match &mut history {
            None => system.word(n).map(|word| word.slice(at, SYMBOLS)).unwrap_or_default(),
            Some(history) => {
                if history.symbols(n).is_none() {
                    if history.step(WORK) == Progress::Done && history.symbols(n).is_none() {
                        let largest = (0..n).rev().find(|&n| history.symbols(n).is_some());
                        return Err(limit_of_memory(largest));
                    }
                    return Ok(Progress::More);
                }
                history.slice(n, at, SYMBOLS)
            }
        };
        at += SYMBOLS as u128;
        let progress = if text.is_empty() { Progress::Done } else { Progress::More };
        file.append(&mut text.into_bytes());
        if progress == Progress::Done {
            file.push(b'\n');
        }
        Ok(progress)
    })))
}

fn limit_of_memory(largest: Option<u32>) -> Diagnostic {
    limit(LimitName::Memory, HISTORY.memory, largest)
}

fn limit(limit: LimitName, value: u64, largest: Option<u32>) -> Diagnostic {
    Diagnostic { kind: Kind::Limit { limit, value, largest }, field: Field::Numbers, span: 0..0 }
}
