//! Files of meshes: the drawing is simplified where this is asked for, then made into a mesh, then written.

use crate::formats::{WriterResult, append};
use crate::{FileOptions, GlbWriter, ObjWriter, StlWriter, Writer};
use lsystem_drawing::{Drawing, Mesh, MeshForm, MeshMaker, MeshOptions, Simplifier, Solid};
use lsystem_syntax::{Diagnostic, Progress, Style};
use std::sync::Arc;

/// A writer of OBJ.
pub(crate) fn obj(drawing: Arc<Drawing<Solid>>, style: Style, options: &FileOptions) -> WriterResult {
    let title = options.title.clone();
    simplified(drawing, options, move |drawing, options| {
        let write = move |mesh| Box::new(Obj { writer: ObjWriter::new(&mesh, &title), mesh }) as Box<dyn Writer>;
        made(drawing, style, options, MeshForm::Coloured, write)
    })
}

/// A writer of STL.
pub(crate) fn stl(drawing: Arc<Drawing<Solid>>, style: Style, options: &FileOptions) -> WriterResult {
    simplified(drawing, options, move |drawing, options| {
        made(drawing, style, options, MeshForm::Printed, |mesh| Box::new(StlWriter::new(mesh)))
    })
}

/// A writer of binary glTF.
pub(crate) fn glb(drawing: Arc<Drawing<Solid>>, style: Style, options: &FileOptions) -> WriterResult {
    simplified(drawing, options, move |drawing, options| {
        let FileOptions { most, memory, title, .. } = options;
        Ok(Box::new(Glb { writer: GlbWriter::new(&drawing, &style, *most, *memory, title)?, drawing, style }))
    })
}

/// A file in two stages: `step` prepares the writer.
struct Staged<F> {
    step: F,
    writer: Option<Box<dyn Writer>>,
}

impl<F: FnMut(u64) -> Result<Option<Box<dyn Writer>>, Diagnostic>> Writer for Staged<F> {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        if let Some(writer) = &mut self.writer {
            return writer.step(file, work);
        }
        self.writer = (self.step)(work)?;
        Ok(Progress::More)
    }

    fn summary(&self) -> Option<String> {
        self.writer.as_ref()?.summary()
    }
}

/// A file of the drawing in which fine parts are one stroke each.
fn simplified(
    drawing: Arc<Drawing<Solid>>,
    options: &FileOptions,
    begin: impl FnOnce(Arc<Drawing<Solid>>, &FileOptions) -> WriterResult + 'static,
) -> WriterResult {
    if options.finest <= 0.0 {
        return begin(drawing, options);
    }
    let options = options.clone();
    let simplifier = Simplifier::new(&drawing, options.finest, options.memory);
    let mut making = Some((simplifier, drawing, begin));
    let step = move |work| {
        if let Some((simplifier, drawing, _)) = &mut making
            && simplifier.step(drawing, work)? == Progress::Done
            && let Some((simplifier, drawing, begin)) = making.take()
        {
            return begin(Arc::new(simplifier.finish(&drawing)), &options).map(Some);
        }
        Ok(None)
    };
    Ok(Box::new(Staged { step, writer: None }))
}

/// A file of the mesh of a drawing.
fn made(
    drawing: Arc<Drawing<Solid>>,
    style: Style,
    options: &FileOptions,
    form: MeshForm,
    write: impl FnOnce(Mesh) -> Box<dyn Writer> + 'static,
) -> WriterResult {
    let FileOptions { most, memory, .. } = *options;
    // A printer cannot print tubes that are thinner than its finest part.
    let thinnest = if form == MeshForm::Printed { options.finest } else { 0.0 };
    let maker = MeshMaker::new(&drawing, &style, &MeshOptions { form, most, memory, thinnest, whole: 0 })?;
    // The drawing is dropped after the mesh is made, to save memory.
    let mut making = Some((maker, drawing, write));
    let step = move |work| {
        if let Some((maker, drawing, _)) = &mut making
            && maker.step(drawing, &style, work)? == Progress::Done
            && let Some((maker, _, write)) = making.take()
        {
            return Ok(Some(write(maker.finish())));
        }
        Ok(None)
    };
    Ok(Box::new(Staged { step, writer: None }))
}

struct Obj {
    writer: ObjWriter,
    mesh: Mesh,
}

impl Writer for Obj {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        append(file, |text| Ok(self.writer.step(&self.mesh, text, work)))
    }
}

struct Glb {
    writer: GlbWriter,
    drawing: Arc<Drawing<Solid>>,
    style: Style,
}

impl Writer for Glb {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        self.writer.step(&self.drawing, &self.style, file, work)
    }
}
