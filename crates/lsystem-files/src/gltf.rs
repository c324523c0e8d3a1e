//! Meshes as binary glTF 2.0 (`.glb`), the format of viewers, browsers and game engines.

use super::number::write_exact;
use core::fmt::Write;
use lsystem_drawing::Mesh;
use lsystem_syntax::{Meter, Progress};

/// Constants of the format, by their names in its specification.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Writes a mesh: positions and normals as 32-bit floats, colours as linear 16-bit numbers with alpha 1 as the format
/// requires, and 32-bit indices. The material is rough and not metallic. A mesh without triangles gives an empty scene.
#[must_use]
pub fn write_glb(mesh: &Mesh, name: &str) -> Vec<u8> {
    let mut writer = GlbWriter::new(mesh, name);
    let mut bytes = Vec::with_capacity(writer.length);
    while writer.step(mesh, &mut bytes, u64::MAX) == Progress::More {}
    bytes
}

/// A writer of GLB in steps. It holds no mesh, and the caller may remove the written bytes between two steps.
#[derive(Clone, Debug)]
pub struct GlbWriter {
    /// The bytes before the mesh's data; empty once written.
    head: Vec<u8>,
    /// The length of the whole file, in bytes.
    length: usize,
    /// The number of entries written: positions, then normals, colours and triangles.
    written: usize,
    /// By sRGB value: the linear value.
    linear: Vec<u16>,
    spent: u64,
}

/// The most entries written between two checks of the meter.
const PIECE: usize = 256;

impl GlbWriter {
    /// A writer for a mesh. `name` becomes the name of the node.
    #[must_use]
    pub fn new(mesh: &Mesh, name: &str) -> Self {
        let (head, length) = head(mesh, name);
        Self { head, length, written: 0, linear: (0..=255).map(linear).collect(), spent: 0 }
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Appends bytes for about `work` units of work. `mesh` must be the same each time.
    pub fn step(&mut self, mesh: &Mesh, bytes: &mut Vec<u8>, work: u64) -> Progress {
        bytes.append(&mut self.head);
        let mut meter = Meter::new(work);
        let (corners, all) = (mesh.positions.len(), 3 * mesh.positions.len() + mesh.triangles.len());
        while self.written < all && !meter.is_spent() {
            let (list, from) = match self.written.checked_sub(3 * corners) {
                Some(from) => (3, from),
                None => (self.written / corners, self.written % corners),
            };
            let to = (from + PIECE).min(if list == 3 { mesh.triangles.len() } else { corners });
            match list {
                0 | 1 => {
                    let vectors = if list == 0 { &mesh.positions } else { &mesh.normals };
                    vectors[from..to].iter().flatten().for_each(|value| bytes.extend(value.to_le_bytes()));
                }
                2 => {
                    for colour in &mesh.colours[from..to] {
                        let [r, g, b] = colour.map(|c| self.linear[usize::from(c)]);
                        [r, g, b, u16::MAX].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
                    }
                }
                _ => mesh.triangles[from..to].iter().flatten().for_each(|index| bytes.extend(index.to_le_bytes())),
            }
            self.written += to - from;
            meter.charge((to - from) as u64);
        }
        self.spent = self.spent.saturating_add(meter.spent());
        if self.written < all { Progress::More } else { Progress::Done }
    }
}

/// The bytes before the mesh's data, and the length of the whole file in bytes.
fn head(mesh: &Mesh, name: &str) -> (Vec<u8>, usize) {
    let (corners, indices) = (mesh.positions.len(), 3 * mesh.triangles.len());
    let binary = corners * 32 + indices * 4;
    let mut json = String::from("{\"asset\":{\"version\":\"2.0\",\"generator\":\"lsystem\"},\"scene\":0,");
    if mesh.triangles.is_empty() {
        json.push_str("\"scenes\":[{}]}");
    } else {
        json.push_str("\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0,\"name\":");
        write_string(&mut json, name);
        json.push_str(
            "}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"COLOR_0\":2},\
             \"indices\":3,\"material\":0}]}],\
             \"materials\":[{\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0.8}}],\"accessors\":[",
        );
        let least = |axis: usize| mesh.positions.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
        let most = |axis: usize| mesh.positions.iter().map(|p| p[axis]).fold(f32::NEG_INFINITY, f32::max);
        accessor(&mut json, 0, FLOAT, "VEC3", corners);
        for (key, bound) in [("min", [0, 1, 2].map(least)), ("max", [0, 1, 2].map(most))] {
            let _ = write!(json, ",\"{key}\":[");
            for (axis, value) in bound.into_iter().enumerate() {
                if axis > 0 {
                    json.push(',');
                }
                write_exact(&mut json, f64::from(value));
            }
            json.push(']');
        }
        json.push_str("},");
        accessor(&mut json, 1, FLOAT, "VEC3", corners);
        json.push_str("},");
        accessor(&mut json, 2, UNSIGNED_SHORT, "VEC4", corners);
        json.push_str(",\"normalized\":true},");
        accessor(&mut json, 3, UNSIGNED_INT, "SCALAR", indices);
        json.push_str("}],\"bufferViews\":[");
        let lengths = [(12 * corners, ARRAY_BUFFER), (12 * corners, ARRAY_BUFFER), (8 * corners, ARRAY_BUFFER)];
        let mut offset = 0;
        for (view, (length, target)) in lengths.into_iter().chain([(4 * indices, ELEMENT_ARRAY_BUFFER)]).enumerate() {
            let comma = if view > 0 { "," } else { "" };
            // Writing to a `String` cannot fail.
            let _ = write!(
                json,
                "{comma}{{\"buffer\":0,\"byteOffset\":{offset},\"byteLength\":{length},\"target\":{target}}}"
            );
            offset += length;
        }
        let _ = write!(json, "],\"buffers\":[{{\"byteLength\":{binary}}}]}}");
    }

    // The length of a chunk is a multiple of four bytes.
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let chunk = |length: usize, kind: &[u8; 4]| [&(length as u32).to_le_bytes()[..], kind].concat();
    let length = 12 + 8 + json.len() + if binary > 0 { 8 + binary } else { 0 };
    let mut head = [&b"glTF"[..], &2_u32.to_le_bytes(), &(length as u32).to_le_bytes()].concat();
    head.extend(chunk(json.len(), b"JSON"));
    head.extend(json.as_bytes());
    if binary > 0 {
        head.extend(chunk(binary, b"BIN\0"));
    }
    (head, length)
}

/// Writes an accessor except its end.
fn accessor(json: &mut String, view: u32, component: u32, kind: &str, count: usize) {
    let _ = write!(json, "{{\"bufferView\":{view},\"componentType\":{component},\"type\":\"{kind}\",\"count\":{count}");
}

/// Converts an sRGB value (0 to 255) to a linear value (0 to 65,535).
fn linear(value: u16) -> u16 {
    let value = f64::from(value) / 255.0;
    let linear = if value <= 0.040_45 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) };
    libm::round(linear * f64::from(u16::MAX)) as u16
}

fn write_string(json: &mut String, text: &str) {
    json.push('"');
    for ch in text.chars() {
        match ch {
            '"' | '\\' => json.extend(['\\', ch]),
            _ if ch.is_control() => json.push(' '),
            _ => json.push(ch),
        }
    }
    json.push('"');
}
