//! Files of meshes: the drawing is simplified where this is asked for, then made into a mesh, then written.

use crate::gltf::glb_file;
use crate::obj::obj_file;
use crate::{FileOptions, Notes, Sink, write_stl};
use lsystem_drawing::{Drawing, Mesh, MeshForm, MeshOptions, MeshParts, Solid};
use lsystem_syntax::{Halt, Style};
use std::sync::Arc;

/// Writes OBJ.
pub(crate) fn obj(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    let mesh = mesh(drawing, style, options, MeshForm::Coloured, sink)?;
    obj_file(&mesh, &options.title, sink)?;
    Ok(Notes::default())
}

/// Writes STL.
pub(crate) fn stl(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    let mesh = mesh(drawing, style, options, MeshForm::Printed, sink)?;
    write_stl(mesh, sink)?;
    Ok(Notes::default())
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

/// The mesh of a drawing. The drawing is dropped after the mesh is made, to save memory.
fn mesh(
    drawing: Arc<Drawing<Solid>>,
    style: &Style,
    options: &FileOptions,
    form: MeshForm,
    sink: &mut Sink<'_>,
) -> Result<Mesh, Halt> {
    let drawing = simplified(drawing, options, sink)?;
    let FileOptions { most, memory, .. } = *options;
    // A printer cannot print tubes that are thinner than its finest part.
    let thinnest = if form == MeshForm::Printed { options.finest } else { 0.0 };
    let options = MeshOptions { form, most, memory, thinnest, whole: 0 };
    MeshParts::new(&drawing, style, &options, sink).map(MeshParts::into_first)
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
