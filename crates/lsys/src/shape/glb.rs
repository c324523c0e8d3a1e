//! The triangles of binary glTF 2.0 files (GLB): all meshes of the nodes, in the places of the nodes.

use super::{Triangle, too_many};
use lsystem::base::say;
use lsystem::syntax::MOST_SIDES;
use serde_json::Value;

/// The most nodes that are visited: a wrong file may have nodes that contain each other.
const MOST_NODES: usize = 10_000;

/// A matrix by columns.
type Matrix = [[f64; 4]; 4];

/// The triangles of a file.
///
/// # Errors
/// Why there are none.
pub(super) fn triangles(bytes: &[u8]) -> Result<Vec<Triangle>, String> {
    let (json, binary) = chunks(bytes).ok_or_else(|| say!("this GLB is damaged"))?;
    let file: Value = serde_json::from_slice(json).map_err(|error| say!("this GLB is damaged: {}", error))?;
    let nodes = list(&file["nodes"]);
    let is_child =
        |at: usize| nodes.iter().any(|node| list(&node["children"]).iter().any(|child| index(child) == Some(at)));
    let roots = (0..nodes.len().min(MOST_NODES)).filter(|&at| !is_child(at));
    let mut open: Vec<(usize, Matrix)> = roots.map(|at| (at, IDENTITY)).collect();
    let (mut triangles, mut visits) = (vec![], 0);
    while let Some((at, outer)) = open.pop() {
        visits += 1;
        if visits > MOST_NODES {
            return Err(say!("this GLB has more than {} nodes", MOST_NODES));
        }
        let Some(node) = nodes.get(at) else { continue };
        let matrix = times(&outer, &matrix_of(node));
        open.extend(list(&node["children"]).iter().filter_map(index).map(|child| (child, matrix)));
        let Some(mesh) = index(&node["mesh"]).and_then(|mesh| list(&file["meshes"]).get(mesh)) else { continue };
        for part in list(&mesh["primitives"]) {
            // 4 is a list of triangles, which is the default.
            if part["mode"].as_u64().is_some_and(|mode| mode != 4) {
                continue;
            }
            add(part, &file, binary, &matrix, &mut triangles)?;
        }
    }
    if triangles.is_empty() { Err(say!("this GLB has no triangles")) } else { Ok(triangles) }
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
fn add(
    part: &Value,
    file: &Value,
    binary: &[u8],
    matrix: &Matrix,
    triangles: &mut Vec<Triangle>,
) -> Result<(), String> {
    let wrong = || say!("this GLB is damaged, or its mesh is compressed");
    let float = |bytes: &[u8]| Some(f64::from(f32::from_le_bytes(*bytes.first_chunk()?)));
    let read = |at: usize, size: usize| Elements::new(file, binary, at, size).ok_or_else(wrong);
    let positions = read(index(&part["attributes"]["POSITION"]).ok_or_else(wrong)?, 3)?;
    let indices = index(&part["indices"]).map(|at| read(at, 1)).transpose()?;
    let count = indices.as_ref().map_or(positions.count, |indices| indices.count);
    if triangles.len() + count / 3 > MOST_SIDES {
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
    kind: u64,
    size: usize,
    stride: usize,
    count: usize,
}

impl<'a> Elements<'a> {
    /// The elements of accessor `at`, with `size` components each.
    fn new(file: &Value, binary: &'a [u8], at: usize, size: usize) -> Option<Self> {
        let accessor = list(&file["accessors"]).get(at)?;
        let view = list(&file["bufferViews"]).get(index(&accessor["bufferView"])?)?;
        let number = |value: &Value| index(value).unwrap_or(0);
        let from = number(&view["byteOffset"]).checked_add(number(&accessor["byteOffset"]))?;
        let kind = accessor["componentType"].as_u64()?;
        let size = size * [(5121, 1), (5123, 2), (5125, 4), (5126, 4)].iter().find(|(known, _)| *known == kind)?.1;
        let stride = index(&view["byteStride"]).unwrap_or(size);
        Some(Self { bytes: binary.get(from..)?, kind, size, stride, count: index(&accessor["count"])? })
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
fn matrix_of(node: &Value) -> Matrix {
    if let Ok(matrix) = <[f64; 16]>::try_from(numbers(&node["matrix"])) {
        return [0, 1, 2, 3].map(|column| [0, 1, 2, 3].map(|row| matrix[4 * column + row]));
    }
    let [x, y, z, w] = numbers(&node["rotation"]).try_into().unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let [sx, sy, sz] = numbers(&node["scale"]).try_into().unwrap_or([1.0; 3]);
    let [tx, ty, tz] = numbers(&node["translation"]).try_into().unwrap_or([0.0; 3]);
    [
        [sx * (1.0 - 2.0 * (y * y + z * z)), sx * 2.0 * (x * y + z * w), sx * 2.0 * (x * z - y * w), 0.0],
        [sy * 2.0 * (x * y - z * w), sy * (1.0 - 2.0 * (x * x + z * z)), sy * 2.0 * (y * z + x * w), 0.0],
        [sz * 2.0 * (x * z + y * w), sz * 2.0 * (y * z - x * w), sz * (1.0 - 2.0 * (x * x + y * y)), 0.0],
        [tx, ty, tz, 1.0],
    ]
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn index(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|value| usize::try_from(value).ok())
}

fn numbers(value: &Value) -> Vec<f64> {
    list(value).iter().filter_map(Value::as_f64).collect()
}
