//! Meshes as Wavefront OBJ, a text format that most 3D programs open.

use super::number::Decimals;
use super::sink::{Sink, collect};
use core::fmt::Write;
use lsystem_drawing::Mesh;
use lsystem_syntax::{Halt, Work};

/// The units of work of one line.
const LINE_WORK: u64 = 8;

/// Writes a mesh: `v` lines with a position and a colour, `vn` lines with normals, and `f` lines with triangles.
/// Positions are exact to a millionth of the mesh's size. Colours are sRGB red, green and blue from 0 to 1, an
/// extension that many programs read and other programs ignore. `name` becomes the name of the object.
#[must_use]
pub fn write_obj(mesh: &Mesh, name: &str) -> String {
    collect(|sink| obj_file(mesh, name, 0.0, sink)).map(|(text, ())| text).unwrap_or_default()
}

/// As [`write_obj`], piece by piece. The mesh gets a height, unless this is 0.
pub(crate) fn obj_file(mesh: &Mesh, name: &str, height: f64, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let scale = scale_to(height, mesh.positions.iter().map(|position| f64::from(position[1])));
    let size = scale * mesh.positions.iter().flatten().fold(0.0_f64, |size, c| size.max(f64::from(c.abs())));
    let (places, units) = (Decimals::for_size(size), Decimals::for_size(1e3));
    // The name must be one word on one line.
    let name: String = name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
    let name = if name.is_empty() { "l-system" } else { &name };
    // Writing to a `String` cannot fail.
    let _ = write!(sink.text, "# x, y, z, red, green, blue; y is up\no {name}\n");
    let numbers = |text: &mut String, decimals: Decimals, values: [f64; 3]| {
        for value in values {
            text.push(' ');
            decimals.write(text, value);
        }
    };
    for (position, colour) in mesh.positions.iter().zip(&mesh.colours) {
        sink.charge(LINE_WORK)?;
        sink.text.push('v');
        numbers(&mut sink.text, places, position.map(|c| scale * f64::from(c)));
        numbers(&mut sink.text, units, colour.map(|c| f64::from(c) / 255.0));
        sink.text.push('\n');
    }
    for normal in &mesh.normals {
        sink.charge(LINE_WORK)?;
        sink.text.push_str("vn");
        numbers(&mut sink.text, units, normal.map(f64::from));
        sink.text.push('\n');
    }
    for triangle in &mesh.triangles {
        sink.charge(LINE_WORK)?;
        let [a, b, c] = triangle.map(|corner| corner + 1);
        let _ = writeln!(sink.text, "f {a}//{a} {b}//{b} {c}//{c}");
    }
    Ok(())
}

/// The factor that gives a mesh with corners at these heights the height `wanted`; 1 if `wanted` is 0.
pub(crate) fn scale_to(wanted: f64, heights: impl Iterator<Item = f64>) -> f64 {
    if wanted <= 0.0 {
        return 1.0;
    }
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    if high > low { wanted / (high - low) } else { 1.0 }
}
