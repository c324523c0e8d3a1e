//! Files of the system, written in steps and taken away piece by piece, so that none of them stands whole in the memory
//! of the wasm.

use crate::budget::{HISTORY, LIMITS};
use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::{Problem, problems};
use crate::to_js;
use crate::viewer::WORK;
use lsystem::drawing::{MeshMaker, Outlook, Projection};
use lsystem::files::{Content, Format, Writer};
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

/// A file in the making.
type File = Box<dyn Writer>;
/// What follows when the drawing in space is there.
type Then = Box<dyn FnOnce(Arc<Drawing<Solid>>) -> Result<File, Diagnostic>>;

/// How far a file is.
enum Stage {
    /// It is of a drawing in space that is being made.
    Draw(Box<Drawer<Solid>>, Then),
    Begin(Arc<Drawing<Solid>>, Then),
    Write(File),
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
                    let written = writer.step(&mut self.piece, WORK as u64);
                    self.go_on(written, |progress, export| {
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
    /// Begins the system as a file, in one of the formats of [`lsystem::files::FORMATS`] but for pixels.
    ///
    /// # Errors
    /// Throws where there is no such format.
    pub fn export(&mut self, format: &str) -> Result<Export, JsValue> {
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
            // The report says why nothing has been drawn.
            export.diagnostics.clone_from(&self.report.diagnostics);
            return Ok(export);
        };
        let flat = drawing.clone().filter(|_| !system.is_solid());
        let (style, name) = (system.style.clone(), self.definition.label().to_owned());
        export.stage = match (content, flat) {
            (Content::System, _) => Stage::Write(whole(write_json(&self.definition))),
            (Content::String | Content::Pixels, _) => {
                let written = string(system.clone(), self.definition.iterations);
                export.go_on(written, |writer, _| Stage::Write(writer))
            }
            (Content::Segments { plane, .. }, Some(drawing)) => {
                export.go_on(plane(drawing, TEXT_SEGMENTS), |writer, _| Stage::Write(writer))
            }
            (Content::Segments { space, .. }, None) => {
                self.solid(system, Box::new(move |drawing| space(drawing, TEXT_SEGMENTS)))
            }
            (Content::Paper(write), Some(drawing)) => {
                let most = if format == "svg-compact" { FEW_SEGMENTS } else { TEXT_SEGMENTS };
                export.go_on(write(drawing, style, &self.svg_options(most)), |writer, _| Stage::Write(writer))
            }
            (Content::Paper(write), None) => {
                let Camera { azimuth, elevation, .. } = self.views.solid.camera;
                let (outlook, options) = (Outlook { azimuth, elevation }, self.svg_options(TEXT_SEGMENTS));
                let write = move |drawing| write(drawing, style.clone(), &options);
                self.solid(system, Box::new(move |drawing| seen(drawing, outlook, write)))
            }
            (Content::Mesh(write), _) => {
                self.solid(system, Box::new(move |drawing| mesh(drawing, style, move |mesh| write(mesh, &name))))
            }
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

    fn svg_options(&self, most: u64) -> SvgOptions {
        let title = self.definition.label().to_owned();
        let (description, system) = (self.report.description.clone(), write_json(&self.definition));
        SvgOptions { title, description, system, most, ..SvgOptions::default() }
    }
}

/// A file that a function writes.
struct Written<F>(F);

impl<F: FnMut(&mut Vec<u8>) -> Result<Progress, Diagnostic>> Writer for Written<F> {
    fn step(&mut self, file: &mut Vec<u8>, _: u64) -> Result<Progress, Diagnostic> {
        (self.0)(file)
    }
}

/// A system as text, which is short: those that can be read have texts of a mebibyte at most.
fn whole(text: String) -> File {
    let mut bytes = text.into_bytes();
    Box::new(Written(move |file: &mut Vec<u8>| {
        file.append(&mut bytes);
        Ok(Progress::Done)
    }))
}

/// A file for which something is made first, in steps, until that gives the writer.
struct Made<F> {
    make: F,
    writer: Option<File>,
}

impl<F: FnMut() -> Result<Option<File>, Diagnostic>> Writer for Made<F> {
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

/// A drawing in space as it is seen on paper.
fn seen(
    drawing: Arc<Drawing<Solid>>,
    outlook: Outlook,
    write: impl Fn(Arc<Drawing>) -> Result<File, Diagnostic> + 'static,
) -> Result<File, Diagnostic> {
    // The drawing in space is let go of when it is on paper.
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
    Ok(Box::new(Made { make, writer: None }))
}

fn mesh(
    drawing: Arc<Drawing<Solid>>,
    style: Style,
    write: impl Fn(Mesh) -> File + 'static,
) -> Result<File, Diagnostic> {
    let mut maker = Some(MeshMaker::new(&drawing, &style, FEW_SEGMENTS, MESH)?);
    let make = move || {
        if let Some(making) = &mut maker
            && making.step(&drawing, &style, WORK as u64)? == Progress::Done
        {
            return Ok(Some(write(maker.take().map(MeshMaker::finish).unwrap_or_default())));
        }
        Ok(None)
    };
    Ok(Box::new(Made { make, writer: None }))
}

/// The string of generation `n`, read piece by piece: by counts, or by what is remembered of the derivation.
fn string(system: System, n: u32) -> Result<File, Diagnostic> {
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
    Ok(Box::new(Written(move |file: &mut Vec<u8>| {
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
