//! The way from a system to a file of any format.

use crate::midi::midi_file;
use crate::{Content, FileOptions, Format, Notes, PngOptions, Sink, write_json, write_png};
use lsystem_base::{LimitName, Limits, Progress, say};
use lsystem_drawing::{Drawer, Drawing, Figure, Origin, Outlook, Projection, Solid, System, expand};
use lsystem_render::{Camera, Closeup, Vantage, View, Viewport, fit, opening_camera};
use lsystem_sound::{SoundOptions, listen};
use lsystem_syntax::{Definition, Diagnostic, Halt, Work, run_steps};
use std::sync::Arc;

/// The default length of the longer side of a picture of pixels. At this length a stroke's least width is in pixels;
/// larger pictures scale it.
const USUAL: u32 = 1024;
/// The least default length of the shorter side, in pixels.
const LEAST: u32 = 128;
/// The number of symbols of a string that are written at a time.
const SYMBOLS: usize = 1 << 15;

/// The content, the format and the limits of a file.
#[derive(Clone, Debug)]
pub struct FileTask<'a> {
    /// The definition.
    pub definition: &'a Definition,
    /// Its system.
    pub system: &'a System,
    /// The format.
    pub format: &'static Format,
    /// The choices of the reader. The title, the system and the limits are filled in.
    pub options: &'a FileOptions,
    /// The view of drawings.
    pub view: FileView,
    /// The limits.
    pub limits: FileLimits,
}

/// The view of a drawing in a file.
#[derive(Clone, Debug, Default)]
pub struct FileView {
    /// The view of pictures of pixels in the plane.
    pub view: View,
    /// The place on a segment that is the origin of `view`, as in [`Closeup`]; `None` for the fitted centre.
    pub segment: Option<Origin>,
    /// The camera of pictures of pixels in space; drawings on paper are projected in its direction. `None` for the
    /// [`opening_camera`].
    pub camera: Option<Camera>,
    /// The number of segments that pictures of pixels show; `None` for all.
    pub upto: Option<u128>,
    /// Device pixels in a CSS pixel, for pictures of pixels; `None` for so many that a picture of 1024 pixels has 1.
    pub ratio: Option<f64>,
    /// Whether files of strokes get a description for screen readers.
    pub is_described: bool,
}

/// The limits of a file and of what it is made from.
#[derive(Clone, Copy, Debug)]
pub struct FileLimits {
    /// The limits of the drawing.
    pub drawing: Limits,
    /// The most bytes of the drawing, at most those of `drawing`. Limits decide how a drawing is made, but this one
    /// does not.
    pub drawing_bytes: u64,
    /// The limits of the string.
    pub string: Limits,
    /// Whether a string that cannot be read by counts is read piece by piece from a remembered derivation, within the
    /// memory of `string`. Otherwise it is derived as a whole.
    pub remembers: bool,
    /// The most segments and vertices of polygons in a file.
    pub segments: u64,
    /// The most segments and vertices of polygons that are in memory at once: of projections, and of formats that are
    /// [made in memory](Format::is_made_in_memory).
    pub held: u64,
    /// The most segments of a mesh, and its most bytes.
    pub mesh: [u64; 2],
    /// As [`PngOptions::band`].
    pub band: u32,
}

/// Writes a file of a system.
///
/// # Errors
/// The diagnostic for an exceeded limit, or for a system that the format cannot express, before the first byte. If the
/// owner of the sink stops the work.
pub fn make(task: &FileTask<'_>, sink: &mut Sink<'_>) -> Result<Notes, Halt> {
    make_with(task, write_pixels, sink)
}

/// As [`make`], with another writer of pictures of pixels: the page does not load ours for other files.
///
/// # Errors
/// As [`make`].
pub fn make_with(
    task: &FileTask<'_>,
    pixels: fn(&FileTask<'_>, &mut Sink<'_>) -> Result<Notes, Halt>,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    let &FileTask { definition, system, format, limits, .. } = task;
    let style = &system.style;
    let most = if format.is_made_in_memory { limits.held } else { limits.segments };
    let options = FileOptions { most, ..task.filled_options() };
    let none = |()| Notes::default();
    match format.content {
        Content::System => {
            sink.text.push_str(&write_json(definition));
            Ok(Notes::default())
        }
        Content::String => write_string(task, sink).map(none),
        Content::Words(write) => write(definition, system, &options, sink),
        Content::Pixels => pixels(task, sink),
        Content::Segments { plane, space } => match task.figure(sink)? {
            Figure::Plane(drawing) => plane(&drawing, most, sink).map(none),
            Figure::Space(drawing) => space(&drawing, most, sink).map(none),
        },
        Content::Paper(write) => {
            let figure = task.figure(sink)?;
            let description = task.description(&figure, sink)?;
            let drawing = task.on_paper(figure, sink)?;
            write(drawing, style, &FileOptions { description, ..options }, sink)
        }
        Content::Sound => {
            let draw = &mut |system: &System, n, work: &mut dyn Work| task.figure_of(system, n, work);
            let notes = u64::from(options.sound.notes).min(limits.segments) as u32;
            let sound = SoundOptions { notes, ..options.sound };
            let tune = listen(system, definition.iterations, &sound, draw, sink)?;
            midi_file(&tune, &options, sink)?;
            Ok(Notes { summary: Some(tune.words(options.sound.step_seconds())), ..Notes::default() })
        }
        Content::Mesh(write) => {
            let [most, memory] = limits.mesh;
            write(task.in_space(sink)?, style, &FileOptions { most, memory, ..options }, sink)
        }
    }
}

/// Writes a picture of pixels, whatever the format.
///
/// # Errors
/// As [`make`].
pub fn write_pixels(task: &FileTask<'_>, sink: &mut Sink<'_>) -> Result<Notes, Halt> {
    let figure = task.figure(sink)?;
    let options = task.png(&figure, task.filled_options());
    let (figure, vantage) = task.view.shown(figure, options.viewport)?;
    write_png(&figure, &task.system.style, vantage, &options, sink).map(|()| Notes::default())
}

impl FileView {
    /// The drawing of a picture of pixels, and the vantage.
    fn shown(&self, figure: Figure, viewport: Viewport) -> Result<(Figure, Vantage), Diagnostic> {
        let vantage = self.vantage(&figure);
        let Some(segment) = &self.segment else { return Ok((figure, vantage)) };
        let near = match &figure {
            Figure::Plane(whole) => Closeup::new(whole.clone(), segment.clone()).show(viewport, vantage.view),
            Figure::Space(_) => None,
        };
        let (near, view) = near.ok_or_else(|| {
            Diagnostic::error(say!("This drawing cannot be seen from near that segment")).hint(say!(
                "It must have such a segment. The system must be in the plane, without chance, contexts and tropism."
            ))
        })?;
        Ok((Figure::Plane(near.drawing.clone()), Vantage { view, ..vantage }))
    }

    fn vantage(&self, figure: &Figure) -> Vantage {
        Vantage { view: self.view, camera: self.camera.unwrap_or_else(|| opening_camera(figure)) }
    }
}

impl FileTask<'_> {
    /// The choices of the reader with the title and the system.
    fn filled_options(&self) -> FileOptions {
        let stored = if self.options.bare { String::new() } else { write_json(self.definition) };
        FileOptions { title: self.definition.label().to_owned(), system: stored, ..self.options.clone() }
    }

    fn figure(&self, work: &mut dyn Work) -> Result<Figure, Halt> {
        self.figure_of(self.system, self.definition.iterations, work)
    }

    fn figure_of(&self, system: &System, n: u32, work: &mut dyn Work) -> Result<Figure, Halt> {
        let mut drawer = Figure::drawer(system, n, self.limits.drawing);
        self.draw(work, |units| (drawer.step(units), drawer.bytes()))?;
        Ok(drawer.finish()?)
    }

    /// The drawing in space, also of a system that does not leave the plane.
    fn in_space(&self, work: &mut dyn Work) -> Result<Arc<Drawing<Solid>>, Halt> {
        let mut drawer = Drawer::new(self.system, self.definition.iterations, self.limits.drawing);
        self.draw(work, |units| (drawer.step(units), drawer.bytes()))?;
        Ok(Arc::new(drawer.finish()?))
    }

    /// Runs a drawer, whose `step` returns its progress and its bytes, within the limit of memory.
    fn draw(&self, work: &mut dyn Work, mut step: impl FnMut(u64) -> (Progress, u64)) -> Result<(), Halt> {
        let (most, mut held) = (self.limits.drawing_bytes, 0);
        run_steps(work, |units| {
            let (progress, bytes) = step(units);
            held = bytes;
            if bytes <= most { progress } else { Progress::Done }
        })?;
        if held > most {
            return Err(Diagnostic::limit(LimitName::Memory, most, None).into());
        }
        Ok(())
    }

    /// The drawing in the plane, or its projection. The drawing in space is dropped, to save memory.
    fn on_paper(&self, figure: Figure, work: &mut dyn Work) -> Result<Arc<Drawing>, Halt> {
        let Camera { azimuth, elevation, .. } = self.view.vantage(&figure).camera;
        let drawing = match figure {
            Figure::Plane(drawing) => return Ok(drawing),
            Figure::Space(drawing) => drawing,
        };
        let mut projection = Projection::new(&drawing, &Outlook { azimuth, elevation }, self.limits.held)?;
        run_steps(work, |units| projection.step(&drawing, units))?;
        Ok(Arc::new(projection.finish(&drawing)))
    }

    /// The drawing in words, if they are asked for. The number of segments is counted where the drawing does not have
    /// it.
    fn description(&self, figure: &Figure, work: &mut dyn Work) -> Result<String, Halt> {
        if !self.view.is_described {
            return Ok(String::new());
        }
        let n = self.definition.iterations;
        if let Some(count) = figure.exact_segments() {
            return Ok(figure.describe(self.system, n, &count));
        }
        let mut counter = self.system.segments(n);
        run_steps(work, |units| counter.step(units))?;
        Ok(counter.count().map(|count| figure.describe(self.system, n, count)).unwrap_or_default())
    }

    fn png(&self, figure: &Figure, options: FileOptions) -> PngOptions {
        let FileOptions { size, dpi, transparent: is_transparent, system, .. } = options;
        let [width, height] = size.unwrap_or_else(|| usual_size(figure));
        let ratio = self.view.ratio.unwrap_or((f64::from(width.max(height)) / f64::from(USUAL)).max(1.0));
        let (viewport, upto, band) = (Viewport { width, height, ratio }, self.view.upto, self.limits.band);
        PngOptions { viewport, dpi, is_transparent, system, upto, band }
    }
}

/// The default size of a picture: in the plane in the proportions of the drawing, in space a square.
fn usual_size(figure: &Figure) -> [u32; 2] {
    let Figure::Plane(drawing) = figure else { return [USUAL; 2] };
    let extent = fit(drawing);
    let longer = extent.width.max(extent.height);
    let side = |length: f64| {
        let share = length / longer;
        // The proportions are unknown if the extent is beyond the range of `f64`.
        if share.is_finite() { (libm::round(share * f64::from(USUAL)) as u32).clamp(LEAST, USUAL) } else { USUAL }
    };
    [side(extent.width), side(extent.height)]
}

/// Writes the string and a newline.
fn write_string(task: &FileTask<'_>, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let (system, n, limits) = (task.system, task.definition.iterations, &task.limits.string);
    if !task.limits.remembers {
        sink.bytes(expand(system, n, limits)?.as_bytes())?;
        return sink.bytes(b"\n");
    }
    let symbols = |n: u32| system.word(n).map(|word| word.symbols());
    let too_long = |count: u128| count > u128::from(limits.symbols);
    match symbols(n) {
        Some(count) if too_long(count) => {
            let largest = (0..n).rev().find(|&n| !symbols(n).is_some_and(too_long));
            Err(Diagnostic::limit(LimitName::Symbols, limits.symbols, largest).into())
        }
        Some(_) => write_pieces(|at| system.word(n).map(|word| word.slice(at, SYMBOLS)).unwrap_or_default(), sink),
        None => {
            let full = |largest| Diagnostic::limit(LimitName::Memory, limits.memory, largest);
            let mut history = system.history(n, limits).ok_or_else(|| full(None))?;
            run_steps(sink, |units| history.step(units as usize))?;
            if history.symbols(n).is_none() {
                return Err(full((0..n).rev().find(|&n| history.symbols(n).is_some())).into());
            }
            write_pieces(|at| history.slice(n, at, SYMBOLS), sink)
        }
    }
}

/// Writes all pieces of a string, and a newline. `piece` returns the piece from a symbol on.
fn write_pieces(mut piece: impl FnMut(u128) -> String, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let mut at = 0;
    loop {
        let text = piece(at);
        if text.is_empty() {
            sink.text.push('\n');
            return Ok(());
        }
        sink.text.push_str(&text);
        sink.charge(SYMBOLS as u64)?;
        at += SYMBOLS as u128;
    }
}
