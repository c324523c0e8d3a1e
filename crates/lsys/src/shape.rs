//! `lsys shape`: the outline in an SVG, or a mesh, as a line of rules that names a shape.

mod closed;
mod glb;
mod obj;

use crate::{CommandFailure, input, print};
use lsystem::base::say;
use lsystem::find::{is_svg, outline_of_svg};
use lsystem::syntax::MOST_SIDES;
use std::path::Path;

/// The corners of a triangle.
type Triangle = [[f64; 3]; 3];

/// Prints the shape in `file`, named after the file. The longest side is 20 units; the lowest point is at y = 0, and the
/// middle at x = 0 and z = 0.
///
/// # Errors
/// [`CommandFailure::Words`] if the file cannot be read, or is no outline and no closed mesh.
pub(crate) fn shape(file: &Path) -> Result<(), CommandFailure> {
    let bytes = input::bytes_of(file).map_err(|error| CommandFailure::io(file.display(), &error))?;
    let shape = if is_svg(&bytes) {
        outline_of_svg(&bytes)
    } else if bytes.starts_with(b"glTF") {
        glb::triangles(&bytes).and_then(|triangles| closed::mesh(&triangles))
    } else {
        obj::triangles(&bytes).and_then(|triangles| closed::mesh(&triangles))
    };
    let shape = shape.map_err(|words| CommandFailure::Words(format!("{}: {words}", file.display())))?;
    print(|out| writeln!(out, "shape {} = {shape}", name_of(file)))
}

/// The name of a shape: the letters and digits of the file's name.
fn name_of(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().to_lowercase();
    let name: String = stem.chars().filter(char::is_ascii_alphanumeric).take(20).collect();
    if name.starts_with(|first: char| first.is_ascii_alphabetic()) { name } else { format!("shape{name}") }
}

/// The reason why a mesh is too large.
fn too_many() -> String {
    say!("this mesh has more than {} triangles; make it simpler first", MOST_SIDES)
}
