//! Closed meshes in files of other programs, as shapes.

mod glb;
mod obj;

use lsystem_base::number::number;
use lsystem_base::{counted, say};
use lsystem_syntax::MAX_SIDES;
use std::collections::HashMap;

/// The corners of a triangle.
type Triangle = [[f64; 3]; 3];

/// The longest side of a mesh, in model units.
const SIZE: f64 = 20.0;
/// The places on a side of a model unit: coordinates have three digits after the point.
const GRID: f64 = 1000.0;

/// The text of the mesh in a Wavefront OBJ or a binary glTF 2.0 file, such as `mesh(0, 0, 0, …)`. The longest side is 20
/// units; the lowest point is at y = 0, and the middle at x = 0 and z = 0.
///
/// # Errors
/// Why the file has no closed mesh.
pub fn mesh_shape(bytes: &[u8]) -> Result<String, String> {
    let triangles = if bytes.starts_with(b"glTF") { glb::triangles(bytes) } else { obj::triangles(bytes) };
    closed(&triangles?)
}

/// The reason why a mesh is too large.
fn too_many() -> String {
    say!("this mesh has more than {} triangles; make it simpler first", MAX_SIDES)
}

/// The text of a closed mesh.
fn closed(triangles: &[Triangle]) -> Result<String, String> {
    let all = || triangles.iter().flatten();
    let least = [0, 1, 2].map(|axis| all().map(|at| at[axis]).fold(f64::INFINITY, f64::min));
    let most = [0, 1, 2].map(|axis| all().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max));
    let longest = (0..3).map(|axis| most[axis] - least[axis]).fold(0.0, f64::max);
    let scale = SIZE / longest;
    if !(longest > 0.0 && scale.is_finite() && scale > 0.0) {
        return Err(say!("this file has no triangles"));
    }
    let origin = [0.5 * (least[0] + most[0]), least[1], 0.5 * (least[2] + most[2])];
    let placed = |at: &[f64; 3]| [0, 1, 2].map(|axis| ((at[axis] - origin[axis]) * scale * GRID).round() as i64);
    let placed: Vec<[[i64; 3]; 3]> = (triangles.iter().map(|triangle| triangle.each_ref().map(placed)))
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect();
    if placed.is_empty() {
        return Err(say!("this file has no triangles"));
    }
    let mut sides: HashMap<[[i64; 3]; 2], i32> = HashMap::new();
    for [a, b, c] in &placed {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            let (ends, sign) = if from < to { ([*from, *to], 1) } else { ([*to, *from], -1) };
            *sides.entry(ends).or_default() += sign;
        }
    }
    match sides.values().filter(|&&count| count != 0).count() {
        0 => {}
        open => {
            return Err(counted!(
                open,
                "this mesh is not closed: {} edge has a triangle on one side only, or two that face apart",
                "this mesh is not closed: {} edges have a triangle on one side only, or two that face apart"
            ));
        }
    }
    let numbers = placed.iter().flatten().flatten().map(|&value| number(value as f64 / GRID));
    Ok(format!("mesh({})", numbers.collect::<Vec<_>>().join(", ")))
}
