//! The stages of a file: a drawing, then its projection or its mesh, then the text or the bytes. Each stage is a
//! [`Writer`] that prepares the next one, so that a file as a whole is one writer.

use crate::budget::{FEW_SEGMENTS, LIMITS, WORK};
use lsystem_derive::{Counter, Tally};
use lsystem_drawing::{Drawer, Drawing, Outlook, Projection, Solid, Space, System, describe};
use lsystem_files::Writer;
use lsystem_syntax::{Diagnostic, Progress};
use std::sync::Arc;

/// A file in the making.
pub(crate) type FileWriter = Box<dyn Writer>;
/// The writer of a file, or the diagnostic for an exceeded limit.
pub(crate) type Begun = Result<FileWriter, Diagnostic>;

/// A writer from a function.
pub(crate) struct FunctionWriter<F>(pub(crate) F);

impl<F: FnMut(&mut Vec<u8>) -> Result<Progress, Diagnostic>> Writer for FunctionWriter<F> {
    fn step(&mut self, file: &mut Vec<u8>, _: u64) -> Result<Progress, Diagnostic> {
        (self.0)(file)
    }
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

fn prepared(make: impl FnMut() -> Result<Option<FileWriter>, Diagnostic> + 'static) -> FileWriter {
    Box::new(PreparedWriter { make, writer: None })
}

/// A short text, written in one step: a system has texts of at most 1 MiB.
pub(crate) fn text_file(text: String) -> FileWriter {
    let mut bytes = text.into_bytes();
    Box::new(FunctionWriter(move |file: &mut Vec<u8>| {
        file.append(&mut bytes);
        Ok(Progress::Done)
    }))
}

/// A file of the drawing in the plane.
pub(crate) fn plane_file(system: &System, n: u32, begin: impl FnOnce(Arc<Drawing>) -> Begun + 'static) -> FileWriter {
    drawn_file(Drawer::new(system, n, LIMITS), begin)
}

/// A file of the drawing in space. Systems in the plane have one, too, for meshes.
pub(crate) fn solid_file(
    system: &System,
    n: u32,
    begin: impl FnOnce(Arc<Drawing<Solid>>) -> Begun + 'static,
) -> FileWriter {
    drawn_file(Drawer::<Solid>::new(system, n, LIMITS), begin)
}

fn drawn_file<S: Space + 'static>(
    drawer: Drawer<S>,
    begin: impl FnOnce(Arc<Drawing<S>>) -> Begun + 'static,
) -> FileWriter {
    let mut making = Some((drawer, begin));
    prepared(move || {
        if let Some((drawer, _)) = &mut making
            && drawer.step(WORK) == Progress::Done
            && let Some((drawer, begin)) = making.take()
        {
            return begin(Arc::new(drawer.finish()?)).map(Some);
        }
        Ok(None)
    })
}

/// A file whose writer needs the drawing's description: the number of segments is counted first, where the drawing
/// does not tell.
pub(crate) fn described_file<S: Space + 'static>(
    system: System,
    n: u32,
    drawing: Arc<Drawing<S>>,
    bounds: Option<[f64; 4]>,
    begin: impl FnOnce(Arc<Drawing<S>>, String) -> Begun + 'static,
) -> Begun {
    let shared = drawing.is_memoised().then(|| drawing.block_count());
    let exact = Some(drawing.segment_count()).filter(|&count| count < u128::MAX);
    let words = move |system: &System, count: &Tally| describe(system, n, count, shared, bounds);
    if let Some(count) = exact {
        return begin(drawing, words(&system, &Tally::from(count)));
    }
    let mut counting = Some((system.segments(n), drawing, begin));
    Ok(prepared(move || {
        if let Some((counter, ..)) = &mut counting
            && step(counter) == Progress::Done
            && let Some((counter, drawing, begin)) = counting.take()
        {
            let description = counter.count().map(|count| words(&system, count)).unwrap_or_default();
            return begin(drawing, description).map(Some);
        }
        Ok(None)
    }))
}

fn step(counter: &mut Counter) -> Progress {
    counter.step(WORK)
}

/// A file of the projection of a drawing in space.
pub(crate) fn projected_file(
    drawing: Arc<Drawing<Solid>>,
    outlook: Outlook,
    begin: impl FnOnce(Arc<Drawing>) -> Begun + 'static,
) -> Begun {
    // The drawing in space is dropped after the projection, to save memory.
    let mut making = Some((Projection::new(&drawing, &outlook, FEW_SEGMENTS)?, drawing, begin));
    Ok(prepared(move || {
        if let Some((projection, drawing, _)) = &mut making
            && projection.step(drawing, WORK) == Progress::Done
            && let Some((projection, drawing, begin)) = making.take()
        {
            return begin(Arc::new(projection.finish(&drawing))).map(Some);
        }
        Ok(None)
    }))
}
