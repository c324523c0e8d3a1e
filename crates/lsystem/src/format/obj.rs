//! Meshes as Wavefront OBJ, a text format that most programs open.

use super::number::Decimals;
use crate::Mesh;
use core::fmt::Write;

/// Writes a mesh: `v` lines with a place and a colour (red, green, blue from 0 to 1 in sRGB, an extension that many
/// programs read and the others pass over), `vn` lines, and `f` lines. Places are exact to a millionth of the mesh's size.
#[must_use]
pub fn write_obj(mesh: &Mesh, name: &str) -> String {
    let size = mesh.positions.iter().flatten().fold(0.0_f64, |size, c| size.max(f64::from(c.abs())));
    let (places, units) = (Decimals::for_size(size), Decimals::for_size(1e3));
    // A name is one line; writing to a `String` cannot fail.
    let name: String = name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
    let mut text = String::from("# x, y, z, red, green, blue; y is up\n");
    let _ = writeln!(text, "o {}", if name.is_empty() { "l-system" } else { &name });
    let mut numbers = |letter: &str, decimals: Decimals, values: [f64; 3], more: Option<[f64; 3]>| {
        text.push_str(letter);
        for value in values {
            text.push(' ');
            decimals.write(&mut text, value);
        }
        for value in more.into_iter().flatten() {
            text.push(' ');
            units.write(&mut text, value);
        }
        text.push('\n');
    };
    for (position, colour) in mesh.positions.iter().zip(&mesh.colours) {
        numbers("v", places, position.map(f64::from), Some(colour.map(|c| f64::from(c) / 255.0)));
    }
    for normal in &mesh.normals {
        numbers("vn", units, normal.map(f64::from), None);
    }
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|corner| corner + 1);
        let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
    }
    text
}
