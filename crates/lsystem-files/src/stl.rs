//! Meshes as binary STL, the format of printers in space.

use crate::Writer;
use lsystem_drawing::Mesh;
use lsystem_syntax::{Diagnostic, Meter, Progress};

/// The longest side of the mesh, in millimetres. STL has no units, and programs read its numbers as millimetres.
const LONGEST: f64 = 100.0;
/// The first 80 bytes. They must not begin with `solid`, which marks the text form of the format.
const HEADER: &[u8; 80] = b"Binary STL, millimetres, z up                                                   ";
/// The units of work of one triangle.
const TRIANGLE_WORK: u64 = 8;

/// Writes a mesh: each triangle with its normal. The mesh is 100 mm long on its longest side, stands on z = 0, and its y
/// axis becomes z, as printers have it. Colours are lost.
#[derive(Debug)]
pub struct StlWriter {
    mesh: Mesh,
    /// The least corner of the mesh, and the millimetres of one model unit.
    low: [f64; 3],
    scale: f64,
    has_head: bool,
    /// The number of triangles written.
    written: usize,
}

impl StlWriter {
    /// A writer for a mesh.
    #[must_use]
    pub fn new(mesh: Mesh) -> Self {
        let side = |axis: usize, start: f64, pick: fn(f64, f64) -> f64| {
            mesh.positions.iter().map(|corner| f64::from(corner[axis])).fold(start, pick)
        };
        let low = [0, 1, 2].map(|axis| side(axis, f64::INFINITY, f64::min));
        let high = [0, 1, 2].map(|axis| side(axis, f64::NEG_INFINITY, f64::max));
        let longest = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
        let scale = if longest > 0.0 { LONGEST / longest } else { 1.0 };
        Self { mesh, low, scale, has_head: false, written: 0 }
    }

    /// A corner in millimetres, z up.
    fn corner(&self, index: u32) -> [f32; 3] {
        let place = self.mesh.positions[index as usize];
        let [x, y, z] = [0, 1, 2].map(|axis| ((f64::from(place[axis]) - self.low[axis]) * self.scale) as f32);
        [x, -z, y]
    }
}

impl Writer for StlWriter {
    fn step(&mut self, file: &mut Vec<u8>, work: u64) -> Result<Progress, Diagnostic> {
        let mut meter = Meter::new(work);
        if !self.has_head {
            file.extend(HEADER);
            file.extend((self.mesh.triangles.len() as u32).to_le_bytes());
            self.has_head = true;
        }
        while !meter.is_spent() {
            let Some(triangle) = self.mesh.triangles.get(self.written) else { return Ok(Progress::Done) };
            let corners = triangle.map(|index| self.corner(index));
            for value in [normal(corners)].iter().chain(&corners).flatten() {
                file.extend(value.to_le_bytes());
            }
            file.extend([0, 0]);
            self.written += 1;
            meter.charge(TRIANGLE_WORK);
        }
        Ok(Progress::More)
    }
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
    use crate::write_all;
    use lsystem_drawing::{System, draw_solid};
    use lsystem_syntax::{Definition, Limits, Style};
    use std::collections::BTreeMap;

    fn mesh(axiom: &str) -> Mesh {
        let style = Style { width: 0.1, ..Style::default() };
        let definition = Definition { axiom: axiom.into(), angle: 30.0, style, ..Definition::default() };
        let system = System::new(&definition).0.unwrap();
        let drawing = draw_solid(&system, 0, &Limits::default()).unwrap();
        Mesh::for_printing(&drawing, &definition.style, 1_000).unwrap()
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
        let file = write_all(&mut StlWriter::new(mesh("F'F+'F^F[&F{-f+f+f-|-f+f+f}][/+F]!F"))).unwrap();
        let mut edges = BTreeMap::<_, i32>::new();
        for [a, b, c] in triangles(&file) {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                *edges.entry((from, to)).or_default() += 1;
                *edges.entry((to, from)).or_default() -= 1;
            }
        }
        assert!(edges.len() > 100 && edges.values().all(|&count| count == 0));
        let (mut small, mut pieces) = (StlWriter::new(mesh("F'F")), vec![]);
        while small.step(&mut pieces, 1).unwrap() == Progress::More {}
        assert!(pieces == write_all(&mut StlWriter::new(mesh("F'F"))).unwrap());
    }

    #[test]
    fn a_print_stands_on_the_ground() {
        let file = write_all(&mut StlWriter::new(mesh("FFF"))).unwrap();
        let heights: Vec<f32> = triangles(&file).iter().flatten().map(|corner| f32::from_bits(corner[2])).collect();
        let [low, high] = [heights.iter().copied().fold(9.0, f32::min), heights.iter().copied().fold(0.0, f32::max)];
        assert_eq!([low, high], [0.0, 100.0]);
        assert_eq!(write_all(&mut StlWriter::new(Mesh::default())).unwrap().len(), 84);
    }
}
