//! A scene as the bytes of a binary glTF file.

use crate::Sink;
use crate::number::write_exact;
use crate::obj::scale_to;
use core::fmt::Write;
use core::ops::Range;
use lsystem_drawing::{Material, Mesh};
use lsystem_syntax::{Halt, Work};

/// Constants of the format, by their names in its specification.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// The entries that are written at a time.
const PIECE: usize = 256;
/// The bytes of the file's head that are written in a unit of work.
const HEAD_BYTES: u64 = 16;
/// The most corners of a mesh with 16-bit indices: the greatest 16-bit number is no index.
const SHORT: usize = 0xffff;

/// Meshes and their places.
#[derive(Clone, Debug, Default)]
pub(super) struct Scene {
    /// The name of the node that holds all others.
    pub(super) name: String,
    /// The scale of that node.
    pub(super) scale: f64,
    /// The meshes, which parts may share.
    pub(super) meshes: Vec<Mesh>,
    /// Whether corners have colours of their own.
    pub(super) has_colours: bool,
    /// The materials of each part, and the indices of their meshes.
    pub(super) parts: Vec<Vec<(Material, usize)>>,
    /// The placed parts.
    pub(super) nodes: Vec<Node>,
}

/// A placed part.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) part: usize,
    /// The place, in model units.
    pub(super) at: [f64; 3],
    /// The rotation as a unit quaternion: x, y, z, w.
    pub(super) rotation: [f64; 4],
}

/// A list of the binary chunk. The lists follow each other in this order, each mesh by mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum List {
    Positions,
    Normals,
    Colours,
    /// The indices of meshes with many corners.
    Long,
    /// The indices of all other meshes.
    Short,
}

impl List {
    const ALL: [Self; 5] = [Self::Positions, Self::Normals, Self::Colours, Self::Long, Self::Short];

    /// The number of a mesh's entries: corners or triangles.
    fn entries(self, mesh: &Mesh, has_colours: bool) -> usize {
        let is_long = mesh.positions.len() > SHORT;
        match self {
            Self::Positions | Self::Normals => mesh.positions.len(),
            Self::Colours if has_colours => mesh.positions.len(),
            Self::Long if is_long => mesh.triangles.len(),
            Self::Short if !is_long => mesh.triangles.len(),
            _ => 0,
        }
    }

    /// The bytes of an entry.
    const fn size(self) -> usize {
        match self {
            Self::Positions | Self::Normals | Self::Long => 12,
            Self::Colours => 8,
            Self::Short => 6,
        }
    }

    /// The bytes of a range of a mesh's entries. `linear` has the linear value of each sRGB value.
    fn bytes(self, mesh: &Mesh, range: Range<usize>, linear: &[u16]) -> Vec<u8> {
        match self {
            Self::Positions => mesh.positions[range].iter().flatten().flat_map(|c| c.to_le_bytes()).collect(),
            Self::Normals => mesh.normals[range].iter().flatten().flat_map(|c| c.to_le_bytes()).collect(),
            Self::Colours => {
                let channels =
                    |[r, g, b]: &[u8; 3]| [*r, *g, *b].map(|c| linear[usize::from(c)]).into_iter().chain([u16::MAX]);
                mesh.colours[range].iter().flat_map(channels).flat_map(u16::to_le_bytes).collect()
            }
            Self::Long => mesh.triangles[range].iter().flatten().flat_map(|index| index.to_le_bytes()).collect(),
            Self::Short => {
                mesh.triangles[range].iter().flatten().flat_map(|&index| (index as u16).to_le_bytes()).collect()
            }
        }
    }
}

impl Scene {
    /// Gives the scene a height, unless this is 0.
    pub(super) fn set_height(&mut self, wanted: f64, work: &mut dyn Work) -> Result<(), Halt> {
        let mut ends = vec![];
        for Node { part, at, rotation: [x, y, z, w] } in self.nodes.iter().filter(|_| wanted > 0.0) {
            // The second row of the rotation's matrix.
            let row = [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)];
            for (_, mesh) in &self.parts[*part] {
                let positions = &self.meshes[*mesh].positions;
                work.charge(positions.len() as u64)?;
                let heights = positions.iter().map(|corner| (0..3).map(|i| row[i] * f64::from(corner[i])).sum::<f64>());
                let (low, high) =
                    heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
                ends.extend([at[1] + low, at[1] + high]);
            }
        }
        self.scale = scale_to(wanted, ends.into_iter());
        Ok(())
    }

    /// The bytes of a list.
    fn bytes_of(&self, list: List) -> usize {
        self.meshes.iter().map(|mesh| list.entries(mesh, self.has_colours)).sum::<usize>() * list.size()
    }

    /// Writes the file. Only parts with triangles may have nodes.
    pub(super) fn write(&self, sink: &mut Sink<'_>) -> Result<(), Halt> {
        let head = self.head();
        sink.charge(head.len() as u64 / HEAD_BYTES)?;
        sink.bytes(&head)?;
        drop(head);
        // By sRGB value: the linear value.
        let linear: Vec<u16> =
            (0..=u8::MAX).map(|value| libm::round(linear(value) * f64::from(u16::MAX)) as u16).collect();
        for list in List::ALL {
            for mesh in &self.meshes {
                sink.charge(1)?;
                let entries = list.entries(mesh, self.has_colours);
                for start in (0..entries).step_by(PIECE) {
                    let piece = start..(start + PIECE).min(entries);
                    sink.charge(piece.len() as u64)?;
                    sink.bytes(&list.bytes(mesh, piece, &linear))?;
                }
            }
        }
        let bytes: usize = List::ALL.map(|list| self.bytes_of(list)).iter().sum();
        sink.bytes(&[0; 4][..bytes.next_multiple_of(4) - bytes])
    }

    /// The bytes before the binary data.
    fn head(&self) -> Vec<u8> {
        // The length of a chunk is a multiple of four bytes.
        let binary = List::ALL.map(|list| self.bytes_of(list)).iter().sum::<usize>().next_multiple_of(4);
        let mut json = String::from("{\"asset\":{\"version\":\"2.0\",\"generator\":\"lsystem\"},\"scene\":0,");
        if self.nodes.is_empty() {
            json.push_str("\"scenes\":[{}]}");
        } else {
            json.push_str("\"scenes\":[{\"nodes\":[0]}]");
            self.write_nodes(&mut json);
            self.write_meshes(&mut json);
            let _ = write!(json, ",\"buffers\":[{{\"byteLength\":{binary}}}]}}");
        }
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
        head
    }

    fn write_nodes(&self, json: &mut String) {
        json.push_str(",\"nodes\":[{\"name\":");
        write_string(json, &self.name);
        json.push_str(",\"children\":[");
        write_list(json, 1..=self.nodes.len(), |json, node| {
            let _ = write!(json, "{node}");
        });
        json.push(']');
        if self.scale != 1.0 {
            json.push_str(",\"scale\":[");
            write_list(json, [self.scale; 3], write_float);
            json.push(']');
        }
        json.push('}');
        for Node { part, at, rotation } in &self.nodes {
            let _ = write!(json, ",{{\"mesh\":{part}");
            if at.iter().any(|&c| c != 0.0) {
                json.push_str(",\"translation\":[");
                write_list(json, at, |json, &c| write_float(json, c));
                json.push(']');
            }
            if rotation[3] < 1.0 {
                json.push_str(",\"rotation\":[");
                write_list(json, rotation, |json, &c| write_float(json, c));
                json.push(']');
            }
            json.push('}');
        }
        json.push(']');
    }

    /// Writes meshes, materials, accessors and views of the binary chunk.
    fn write_meshes(&self, json: &mut String) {
        let views: Vec<List> = List::ALL.into_iter().filter(|&list| self.bytes_of(list) > 0).collect();
        let (mut accessors, mut count, mut offsets) = (String::new(), 0, [0; List::ALL.len()]);
        // By mesh: the start of a primitive, up to its material.
        let mut starts = Vec::with_capacity(self.meshes.len());
        for mesh in &self.meshes {
            let mut start = String::from("{\"attributes\":{");
            for list in List::ALL {
                let entries = list.entries(mesh, self.has_colours);
                if entries == 0 {
                    continue;
                }
                if count > 0 {
                    accessors.push(',');
                }
                let view = views.iter().position(|&view| view == list).unwrap_or_default();
                let offset = &mut offsets[list as usize];
                write_accessor(&mut accessors, list, view, *offset, mesh);
                *offset += entries * list.size();
                let _ = match list {
                    List::Positions => write!(start, "\"POSITION\":{count}"),
                    List::Normals => write!(start, ",\"NORMAL\":{count}"),
                    List::Colours => write!(start, ",\"COLOR_0\":{count}"),
                    List::Long | List::Short => write!(start, "}},\"indices\":{count}"),
                };
                count += 1;
            }
            starts.push(start);
        }
        let mut materials: Vec<Material> = vec![];
        json.push_str(",\"meshes\":[");
        write_list(json, &self.parts, |json, part| {
            json.push_str("{\"primitives\":[");
            write_list(json, part, |json, (material, mesh)| {
                let number = materials.iter().position(|known| known == material).unwrap_or_else(|| {
                    materials.push(*material);
                    materials.len() - 1
                });
                let _ = write!(json, "{},\"material\":{number}}}", starts[*mesh]);
            });
            json.push_str("]}");
        });
        json.push_str("],\"materials\":[");
        write_list(json, &materials, |json, &material| write_material(json, material));
        let _ = write!(json, "],\"accessors\":[{accessors}],\"bufferViews\":[");
        let mut offset = 0;
        write_list(json, views, |json, list| {
            let length = self.bytes_of(list);
            let _ = write!(json, "{{\"buffer\":0,\"byteOffset\":{offset},\"byteLength\":{length}");
            let _ = match list {
                List::Long | List::Short => write!(json, ",\"target\":{ELEMENT_ARRAY_BUFFER}}}"),
                _ => write!(json, ",\"byteStride\":{},\"target\":{ARRAY_BUFFER}}}", list.size()),
            };
            offset += length;
        });
        json.push(']');
    }
}

/// Writes the accessor of a mesh's entries in a list.
fn write_accessor(json: &mut String, list: List, view: usize, offset: usize, mesh: &Mesh) {
    let (corners, indices) = (mesh.positions.len(), 3 * mesh.triangles.len());
    let (component, kind, count) = match list {
        List::Positions | List::Normals => (FLOAT, "VEC3", corners),
        List::Colours => (UNSIGNED_SHORT, "VEC4", corners),
        List::Long => (UNSIGNED_INT, "SCALAR", indices),
        List::Short => (UNSIGNED_SHORT, "SCALAR", indices),
    };
    let _ = write!(
        json,
        "{{\"bufferView\":{view},\"byteOffset\":{offset},\"componentType\":{component},\"type\":\"{kind}\",\
         \"count\":{count}"
    );
    if list == List::Colours {
        json.push_str(",\"normalized\":true");
    }
    if list == List::Positions {
        let least = |axis: usize| mesh.positions.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
        let most = |axis: usize| mesh.positions.iter().map(|p| p[axis]).fold(f32::NEG_INFINITY, f32::max);
        for (key, bound) in [("min", [0, 1, 2].map(least)), ("max", [0, 1, 2].map(most))] {
            let _ = write!(json, ",\"{key}\":[");
            write_list(json, bound, |json, value| write_exact(json, f64::from(value)));
            json.push(']');
        }
    }
    json.push('}');
}

/// Writes a material: rough and not metallic, as bark and leaves are. Leaves have one side, which is shown from both.
fn write_material(json: &mut String, Material { rgb, is_leaf }: Material) {
    let kind = if is_leaf { "Leaf" } else { "Stroke" };
    let _ = write!(json, "{{\"name\":\"{kind}");
    if let Some([r, g, b]) = rgb {
        let _ = write!(json, " #{r:02x}{g:02x}{b:02x}");
    }
    json.push_str("\",\"pbrMetallicRoughness\":{");
    if let Some(rgb) = rgb {
        json.push_str("\"baseColorFactor\":[");
        for value in rgb.map(linear) {
            write_exact(json, value as f32 as f64);
            json.push(',');
        }
        json.push_str("1],");
    }
    json.push_str("\"metallicFactor\":0,\"roughnessFactor\":0.8}");
    json.push_str(if is_leaf { ",\"doubleSided\":true}" } else { "}" });
}

/// Converts an sRGB value (0 to 255) to a linear value (0 to 1).
fn linear(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.040_45 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// Writes the entries of a list with commas between them.
fn write_list<T>(json: &mut String, list: impl IntoIterator<Item = T>, mut write: impl FnMut(&mut String, T)) {
    for (number, entry) in list.into_iter().enumerate() {
        if number > 0 {
            json.push(',');
        }
        write(json, entry);
    }
}

/// Writes a number with the digits of the nearest `f32`, which viewers read.
fn write_float(json: &mut String, value: f64) {
    let value = value.clamp(-f64::from(f32::MAX), f64::from(f32::MAX)) as f32;
    let _ = match value.abs() {
        0.0 => json.write_char('0'),
        1e-5..1e12 => write!(json, "{value}"),
        _ => write!(json, "{value:e}"),
    };
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
