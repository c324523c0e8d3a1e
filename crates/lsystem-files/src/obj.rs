//! Meshes as Wavefront OBJ, a text format that most 3D programs open.

use super::number::Decimals;
use core::fmt::Write;
use lsystem_drawing::Mesh;
use lsystem_syntax::{Meter, Progress};

/// Writes a mesh: `v` lines with a position and a colour, `vn` lines with normals, and `f` lines with triangles.
/// Positions are exact to a millionth of the mesh's size. Colours are sRGB red, green and blue from 0 to 1, an
/// extension that many programs read and other programs ignore.
#[must_use]
pub fn write_obj(mesh: &Mesh, name: &str) -> String {
    let mut writer = ObjWriter::new(mesh, name);
    let mut text = String::new();
    while writer.step(mesh, &mut text, u64::MAX) == Progress::More {}
    text
}

/// A writer of OBJ in steps. It holds no mesh, and the caller may remove the written text between two steps.
#[derive(Clone, Debug)]
pub struct ObjWriter {
    /// The lines before the mesh; empty once written.
    head: String,
    places: Decimals,
    units: Decimals,
    /// The number of lines written after the head.
    lines: usize,
    spent: u64,
}

/// The units of work of one line.
const LINE_WORK: u64 = 8;

impl ObjWriter {
    /// A writer for a mesh. `name` becomes the name of the object.
    #[must_use]
    pub fn new(mesh: &Mesh, name: &str) -> Self {
        let size = mesh.positions.iter().flatten().fold(0.0_f64, |size, c| size.max(f64::from(c.abs())));
        // The name must be one word on one line.
        let name: String = name.chars().map(|c| if c.is_whitespace() || c.is_control() { '_' } else { c }).collect();
        let name = if name.is_empty() { "l-system" } else { &name };
        let head = format!("# x, y, z, red, green, blue; y is up\no {name}\n");
        Self { head, places: Decimals::for_size(size), units: Decimals::for_size(1e3), lines: 0, spent: 0 }
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Appends lines for about `work` units of work. `mesh` must be the same each time.
    pub fn step(&mut self, mesh: &Mesh, text: &mut String, work: u64) -> Progress {
        text.push_str(&core::mem::take(&mut self.head));
        let mut meter = Meter::new(work);
        let mut progress = Progress::More;
        while progress == Progress::More && !meter.is_spent() {
            meter.charge(LINE_WORK);
            if self.write_line(mesh, text) {
                self.lines += 1;
            } else {
                progress = Progress::Done;
            }
        }
        self.spent = self.spent.saturating_add(meter.spent());
        progress
    }

    /// Writes the next line. Returns whether there was one.
    fn write_line(&self, mesh: &Mesh, text: &mut String) -> bool {
        let mut numbers = |letter: &str, decimals: Decimals, values: [f64; 3], more: Option<[f64; 3]>| {
            text.push_str(letter);
            for value in values {
                text.push(' ');
                decimals.write(text, value);
            }
            for value in more.into_iter().flatten() {
                text.push(' ');
                self.units.write(text, value);
            }
            text.push('\n');
        };
        let corners = mesh.positions.len();
        if let Some((position, colour)) = mesh.positions.get(self.lines).zip(mesh.colours.get(self.lines)) {
            numbers("v", self.places, position.map(f64::from), Some(colour.map(|c| f64::from(c) / 255.0)));
        } else if let Some(normal) = mesh.normals.get(self.lines - corners) {
            numbers("vn", self.units, normal.map(f64::from), None);
        } else if let Some(triangle) = mesh.triangles.get(self.lines - corners - mesh.normals.len()) {
            let [a, b, c] = triangle.map(|corner| corner + 1);
            // Writing to a `String` cannot fail.
            let _ = writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}");
        } else {
            return false;
        }
        true
    }
}
