//! `lsys shape`: the outline in an SVG, or a mesh, as a line of rules that names a shape.

use crate::{CommandFailure, input, print};
use lsystem::files::mesh_shape;
use lsystem::svg::{is_svg, outline_of_svg};
use std::path::Path;

/// Prints the shape in `file`, named after the file. The longest side is 20 units; the lowest point is at y = 0, and the
/// middle at x = 0 and z = 0.
///
/// # Errors
/// [`CommandFailure::Words`] if the file cannot be read, or is no outline and no closed mesh.
pub(crate) fn shape(file: &Path) -> Result<(), CommandFailure> {
    let bytes = input::bytes_of(file).map_err(|error| CommandFailure::io(file.display(), &error))?;
    let shape = if is_svg(&bytes) { outline_of_svg(&bytes).map_err(|error| error.message) } else { mesh_shape(&bytes) };
    let shape = shape.map_err(|words| CommandFailure::Words(format!("{}: {words}", file.display())))?;
    print(|out| writeln!(out, "shape {} = {shape}", name_of(file)))
}

/// The name of a shape: the letters and digits of the file's name.
fn name_of(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().to_lowercase();
    let name: String = stem.chars().filter(char::is_ascii_alphanumeric).take(20).collect();
    if name.starts_with(|first: char| first.is_ascii_alphabetic()) { name } else { format!("shape{name}") }
}
