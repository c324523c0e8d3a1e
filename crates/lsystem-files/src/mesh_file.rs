//! Files of meshes: the drawing is simplified where this is asked for, then made into a mesh, then written.

use crate::gltf::glb_file;
use crate::obj::obj_file;
use crate::scad::write_scad;
use crate::{FileOptions, Notes, Print, Sink, write_stl};
use lsystem_drawing::{Drawing, MeshForm, MeshOptions, MeshParts, Solid};
use lsystem_syntax::{Halt, Style};
use std::sync::Arc;

/// Writes OBJ.
pub(crate) fn obj(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    // The drawing is dropped after the mesh is made, to save memory.
    let mesh = {
        let drawing = simplified(drawing, options, sink)?;
        let &FileOptions { most, memory, .. } = options;
        let options = MeshOptions { form: MeshForm::Coloured, most, memory, ..MeshOptions::default() };
        MeshParts::new(&drawing, style, &options, sink)?.into_first()
    };
    obj_file(&mesh, &options.title, options.height, sink)?;
    Ok(Notes::default())
}

/// Writes STL, or with bodies in pieces a program for OpenSCAD. The drawing is dropped first, to save memory.
pub(crate) fn print<const IN_PIECES: bool>(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    let mut print = Print::new(&*simplified(drawing, options, sink)?, style, options, IN_PIECES, sink)?;
    let notes = Notes { remark: print.remark.take(), summary: Some(print.words()) };
    if IN_PIECES {
        write_scad(&print, sink)?;
    } else {
        write_stl(print, sink)?;
    }
    Ok(notes)
}

/// Writes binary glTF.
pub(crate) fn glb(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    glb_file(simplified(drawing, options, sink)?, style, options, sink)?;
    Ok(Notes::default())
}

/// The drawing in which fine parts are one stroke each.
fn simplified(
    drawing: Arc<Drawing<Solid>>,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Arc<Drawing<Solid>>, Halt> {
    match options.finest > 0.0 {
        true => drawing.simplified(options.finest, options.memory, sink).map(Arc::new),
        false => Ok(drawing),
    }
}
