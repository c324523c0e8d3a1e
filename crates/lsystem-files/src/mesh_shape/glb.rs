//! The triangles of binary glTF 2.0 files (GLB): all meshes of the nodes, in the places of the nodes.

use super::{Triangle, too_many};
use lsystem_base::say;
use lsystem_syntax::MAX_SIDES;
use serde::de::{Error, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;

/// The most nodes and parts of meshes that are visited: nodes may share meshes, and in a wrong file contain each other.
/// Also the most items of a list.
const MAX: usize = 10_000;

/// A matrix by columns.
type Matrix = [[f64; 4]; 4];

/// What is read of a file.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct File {
    #[serde(default)]
    nodes: List<Node>,
    #[serde(default)]
    meshes: List<Mesh>,
    #[serde(default)]
    accessors: List<Accessor>,
    #[serde(default)]
    buffer_views: List<View>,
}

#[derive(Deserialize)]
struct Node {
    #[serde(default)]
    children: List<u32>,
    mesh: Option<u32>,
    matrix: Option<[f64; 16]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
    translation: Option<[f64; 3]>,
}

#[derive(Deserialize)]
struct Mesh {
    primitives: List<Part>,
}

/// A part of a mesh.
#[derive(Deserialize)]
struct Part {
    mode: Option<u32>,
    attributes: Attributes,
    indices: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "UPPERCASE")]
struct Attributes {
    position: Option<u32>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<u32>,
    #[serde(default)]
    byte_offset: u32,
    component_type: u32,
    count: u32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    #[serde(default)]
    byte_offset: u32,
    byte_stride: Option<u32>,
}

/// The triangles of a file.
///
/// # Errors
/// Why there are none.
pub(super) fn triangles(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let (json, binary) = chunks(bytes).ok_or_else(|| say!("this GLB is damaged"))?;
    let file: File = serde_json::from_slice(json).map_err(|error| say!("this GLB is damaged: {}", error))?;
    let mut is_child = vec![false; file.nodes.0.len()];
    for &child in file.nodes.0.iter().flat_map(|node| &node.children.0) {
        if let Some(is_child) = is_child.get_mut(child as usize) {
            *is_child = true;
        }
    }
    let mut open: Vec<(&Node, Matrix)> =
        file.nodes.0.iter().zip(is_child).filter(|(_, is_child)| !is_child).map(|(node, _)| (node, IDENTITY)).collect();
    let (mut triangles, mut visits) = (vec![], 0);
    while let Some((node, outer)) = open.pop() {
        let matrix = times(&outer, &matrix_of(node));
        let parts = node.mesh.and_then(|mesh| file.meshes.at(mesh)).map_or(&[][..], |mesh| &mesh.primitives.0);
        visits += node.children.0.len() + parts.len();
        if visits > MAX {
            return Err(say!("this GLB has more than {} nodes and parts", MAX));
        }
        open.extend(node.children.0.iter().filter_map(|&child| Some((file.nodes.at(child)?, matrix))));
        // 4 is a list of triangles, which is the default.
        for part in parts.iter().filter(|part| part.mode.is_none_or(|mode| mode == 4)) {
            add(part, &file, binary, &matrix, &mut triangles)?;
        }
    }
    if triangles.is_empty() { Err(say!("this GLB has no triangles")) } else { Ok(triangles) }
}

/// A list of at most [`MAX`] items.
struct List<T>(Vec<T>);

impl<T> List<T> {
    fn at(&self, index: u32) -> Option<&T> {
        self.0.get(index as usize)
    }
}

impl<T> Default for List<T> {
    fn default() -> Self {
        Self(vec![])
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for List<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Items<T>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Items<T> {
            type Value = List<T>;
            fn expecting(&self, out: &mut fmt::Formatter) -> fmt::Result {
                write!(out, "a list of at most {MAX} items")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<List<T>, A::Error> {
                let mut list = vec![];
                while let Some(item) = items.next_element()? {
                    if list.len() == MAX {
                        return Err(A::Error::invalid_length(MAX + 1, &self));
                    }
                    list.push(item);
                }
                Ok(List(list))
            }
        }
        deserializer.deserialize_seq(Items(PhantomData))
    }
}

/// The JSON and the binary chunk.
fn chunks(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let length = |at: usize| Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?) as usize);
    let json = bytes.get(20..20_usize.checked_add(length(12)?)?)?;
    let at = 20 + json.len();
    // A file may have no binary chunk.
    let binary = length(at).and_then(|length| bytes.get(at + 8..(at + 8).checked_add(length)?));
    Some((json, binary.unwrap_or_default()))
}

/// Adds the triangles of a part of a mesh.
fn add(part: &Part, file: &File, binary: &[u8], matrix: &Matrix, triangles: &mut Vec<Triangle>) -> Result<(), String> {
    let wrong = || say!("this GLB is damaged, or its mesh is compressed");
    let float = |bytes: &[u8]| Some(f64::from(f32::from_le_bytes(*bytes.first_chunk()?)));
    let read = |at: u32, size: usize| Elements::new(file, binary, at, size).ok_or_else(wrong);
    let positions = read(part.attributes.position.ok_or_else(wrong)?, 3)?;
    let indices = part.indices.map(|at| read(at, 1)).transpose()?;
    let count = indices.as_ref().map_or(positions.count, |indices| indices.count);
    if triangles.len() + count / 3 > MAX_SIDES {
        return Err(too_many());
    }
    let corner = |at: usize| -> Option<[f64; 3]> {
        let at = match &indices {
            None => at,
            Some(indices) => match (indices.at(at)?, indices.kind) {
                (&[number], 5121) => number.into(),
                (bytes, 5123) => u16::from_le_bytes(*bytes.first_chunk()?).into(),
                (bytes, 5125) => u32::from_le_bytes(*bytes.first_chunk()?) as usize,
                _ => return None,
            },
        };
        let bytes = positions.at(at).filter(|_| positions.kind == 5126)?;
        let [x, y, z] = [float(bytes)?, float(&bytes[4..])?, float(&bytes[8..])?];
        let place =
            [0, 1, 2].map(|axis| matrix[0][axis] * x + matrix[1][axis] * y + matrix[2][axis] * z + matrix[3][axis]);
        Some(place).filter(|place| place.iter().all(|value| value.is_finite()))
    };
    for at in 0..count / 3 {
        let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|side| corner(3 * at + side)) else { return Err(wrong()) };
        triangles.push([a, b, c]);
    }
    Ok(())
}

/// The elements of an accessor.
struct Elements<'a> {
    bytes: &'a [u8],
    /// The type of a component: 5121, 5123 and 5125 are unsigned integers of 1, 2 and 4 bytes, and 5126 are floats.
    kind: u32,
    size: usize,
    stride: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    /// The elements of accessor `at`, with `size` components each.
    fn new(file: &File, binary: &'a [u8], at: u32, size: usize) -> Option<Self> {
        let accessor = file.accessors.at(at)?;
        let view = file.buffer_views.at(accessor.buffer_view?)?;
        let from = (view.byte_offset as usize).checked_add(accessor.byte_offset as usize)?;
        let kind = accessor.component_type;
        let size = size * [(5121, 1), (5123, 2), (5125, 4), (5126, 4)].iter().find(|(known, _)| *known == kind)?.1;
        let stride = view.byte_stride.map_or(size, |stride| stride as usize);
        Some(Self { bytes: binary.get(from..)?, kind, size, stride, count: accessor.count as usize })
    }

    fn at(&self, index: usize) -> Option<&'a [u8]> {
        let from = index.checked_mul(self.stride)?;
        self.bytes.get(from..from.checked_add(self.size)?)
    }
}

const IDENTITY: Matrix = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    b.map(|column| [0, 1, 2, 3].map(|row| (0..4).map(|at| a[at][row] * column[at]).sum()))
}

/// The place of a node: its matrix, or its scale, its rotation (a quaternion) and its translation.
fn matrix_of(node: &Node) -> Matrix {
    if let Some(matrix) = node.matrix {
        return [0, 1, 2, 3].map(|column| [0, 1, 2, 3].map(|row| matrix[4 * column + row]));
    }
    let [x, y, z, w] = node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let [sx, sy, sz] = node.scale.unwrap_or([1.0; 3]);
    let [tx, ty, tz] = node.translation.unwrap_or([0.0; 3]);
    [
        [sx * (1.0 - 2.0 * (y * y + z * z)), sx * 2.0 * (x * y + z * w), sx * 2.0 * (x * z - y * w), 0.0],
        [sy * 2.0 * (x * y - z * w), sy * (1.0 - 2.0 * (x * x + z * z)), sy * 2.0 * (y * z + x * w), 0.0],
        [sz * 2.0 * (x * z + y * w), sz * 2.0 * (y * z - x * w), sz * (1.0 - 2.0 * (x * x + y * y)), 0.0],
        [tx, ty, tz, 1.0],
    ]
}
