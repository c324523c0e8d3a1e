//! Meshes as binary STL, the format of printers in space.
//!
//! STL has no corners of its own: programs join the corners of triangles by their places. Two tubes may begin at the
//! same place, and joined corners would give edges with four triangles. So no two corners of the mesh get the same
//! place: the file is as closed as the mesh.

use crate::{Print, Sink};
use lsystem_syntax::{Halt, Work};
use std::collections::HashMap;

/// The places for corners in a millimetre: more than any printer resolves, and few enough for `f32`.
pub(crate) const PLACES: f64 = 10_000.0;
/// The first 80 bytes. They must not begin with `solid`, which marks the text form of the format.
const HEADER: &[u8; 80] = b"Binary STL, millimetres, z up                                                   ";
/// The units of work of one triangle.
const TRIANGLE_WORK: u64 = 8;
/// The units of work to try a place.
const PLACE_WORK: u64 = 4;

/// Writes a print: each triangle with its normal. STL has no units, and programs read its numbers as millimetres.
/// Colours are lost.
///
/// # Errors
/// If the owner of the sink stops the work.
pub fn write_stl(print: Print, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let places = places(&print.corners, sink)?;
    // Only the triangles are left to write.
    let triangles = print.triangles;
    sink.bytes(HEADER)?;
    sink.bytes(&(triangles.len() as u32).to_le_bytes())?;
    for triangle in triangles {
        sink.charge(TRIANGLE_WORK)?;
        let corners = triangle.map(|index| places[index as usize].map(|c| (f64::from(c) / PLACES) as f32));
        let values = [normal(corners)].into_iter().chain(corners).flatten();
        let record: Vec<u8> = values.flat_map(f32::to_le_bytes).chain([0, 0]).collect();
        sink.bytes(&record)?;
    }
    Ok(())
}

/// A place of its own for each corner: the nearest free one to the right.
fn places(corners: &[[f32; 3]], work: &mut dyn Work) -> Result<Vec<[i32; 3]>, Halt> {
    // The places in use, each with the distance to the next place to try.
    let mut taken = HashMap::<[i32; 3], u32>::new();
    let mut places = vec![];
    for corner in corners {
        let first = corner.map(|c| libm::round(f64::from(c) * PLACES) as i32);
        let mut right = taken.get(&first).copied().unwrap_or(0);
        let mut place = [first[0] + right as i32, first[1], first[2]];
        work.charge(PLACE_WORK)?;
        while taken.contains_key(&place) {
            work.charge(PLACE_WORK)?;
            right += 1;
            place[0] += 1;
        }
        // Later corners at the same place begin where this search ended.
        taken.insert(first, right + 1);
        taken.entry(place).or_insert(1);
        places.push(place);
    }
    Ok(places)
}

/// The outward direction of a triangle, of length 1; zero for a triangle without area.
fn normal(corners: [[f32; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let [u, v] = [b, c].map(|to| [0, 1, 2].map(|axis| to[axis] - a[axis]));
    let product = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = product.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length > 0.0 { product.map(|c| (c / length) as f32) } else { [0.0; 3] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FileOptions, collect};
    use lsystem_base::{Limits, Meter};
    use lsystem_drawing::{Solid, System, draw};
    use lsystem_syntax::{Definition, Style};
    use std::collections::BTreeMap;

    fn print(axiom: &str) -> Print {
        let style = Style { width: 0.1, ..Style::default() };
        let definition = Definition { axiom: axiom.into(), angle: 30.0, style, ..Definition::default() };
        let system = System::new(&definition).unwrap();
        let drawing = draw::<Solid>(&system, 0, &Limits::default()).unwrap();
        let options = FileOptions { foot: 0.0, ..FileOptions::default() };
        Print::new(&drawing, &definition.style, &options, false, &mut Meter::new(u64::MAX)).unwrap()
    }

    fn written(print: Print) -> Vec<u8> {
        collect(|sink| write_stl(print, sink)).unwrap().0
    }

    /// The triangles of a file, corner by corner as bits.
    fn triangles(file: &[u8]) -> Vec<[[u32; 3]; 3]> {
        let number = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap());
        assert_eq!(file.len(), 84 + 50 * number(80) as usize);
        let corner = |at: usize| [0, 4, 8].map(|offset| number(at + offset));
        (0..number(80) as usize).map(|i| [12, 24, 36].map(|offset| corner(84 + 50 * i + offset))).collect()
    }

    #[test]
    fn every_edge_has_a_triangle_on_each_side() {
        for axiom in [
            "F'F+'F^F[&F{-f+f+f-|-f+f+f}][/+F]!F",
            // Tubes of different lengths on the same line, there and back.
            "[F][FF][FFF]FF|F|FFF",
            // Leaves at the same place, a leaf that touches itself, and one with a spike.
            "{f+f+f+f}+{f+f+f}{f-f-f-f+f+f+f+f}{f+f|f+f}",
        ] {
            let file = written(print(axiom));
            let mut edges = BTreeMap::<_, [u32; 2]>::new();
            for [a, b, c] in triangles(&file) {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    edges.entry((from.min(to), from.max(to))).or_default()[usize::from(from > to)] += 1;
                }
            }
            assert!(edges.len() > 50 && edges.values().all(|&count| count == [1, 1]), "{axiom}");
        }
    }

    #[test]
    fn a_print_stands_on_the_ground() {
        let file = written(print("FFF"));
        let heights: Vec<f32> = triangles(&file).iter().flatten().map(|corner| f32::from_bits(corner[2])).collect();
        let [low, high] = [heights.iter().copied().fold(9.0, f32::min), heights.iter().copied().fold(0.0, f32::max)];
        assert_eq!([low, high], [0.0, 100.0]);
        assert_eq!(written(Print::default()).len(), 84);
    }
}
