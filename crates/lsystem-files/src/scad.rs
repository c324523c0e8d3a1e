//! Prints as programs for OpenSCAD.
//!
//! OpenSCAD computes with exact solids: a body that overlaps itself is no solid, and the faces of a body are clockwise as
//! seen from outside. So each stroke is a convex polyhedron of its own, and the program unites them.

use crate::number::write_exact;
use crate::stl::PLACES;
use crate::{Print, Sink};
use lsystem_syntax::{Halt, Work};

/// The units of work of one triangle.
const TRIANGLE_WORK: u64 = 8;

/// Writes a print in pieces as a union of polyhedra above the ground, in millimetres.
///
/// # Errors
/// If the owner of the sink stops the work.
pub(crate) fn write_scad(print: &Print, sink: &mut Sink<'_>) -> Result<(), Halt> {
    sink.text.push_str("// millimetres, z up\nintersection() {\ntranslate([-1e6, -1e6, 0]) cube(2e6);\nunion() {\n");
    // By corner: its number in the last body, and that body.
    let mut numbers = vec![(0, usize::MAX); print.corners.len()];
    for (body, &start) in print.bodies.iter().enumerate() {
        let end = print.bodies.get(body + 1).map_or(print.triangles.len(), |&end| end as usize);
        let triangles = &print.triangles[start as usize..end];
        sink.text.push_str("polyhedron([");
        let mut count = 0;
        for &corner in triangles.iter().flatten() {
            let number = &mut numbers[corner as usize];
            if number.1 != body {
                *number = (count, body);
                let place = print.corners[corner as usize].map(|c| libm::round(f64::from(c) * PLACES) / PLACES);
                list(&mut sink.text, place, count == 0);
                count += 1;
            }
        }
        sink.text.push_str("],[");
        for (at, &[a, b, c]) in triangles.iter().enumerate() {
            sink.charge(TRIANGLE_WORK)?;
            list(&mut sink.text, [a, c, b].map(|corner| f64::from(numbers[corner as usize].0)), at == 0);
        }
        sink.text.push_str("]);\n");
    }
    sink.text.push_str("}\n}\n");
    Ok(())
}

/// Writes three numbers, with a comma before all but the first list.
fn list(text: &mut String, values: [f64; 3], is_first: bool) {
    let mut sign = if is_first { "[" } else { ",[" };
    for value in values {
        text.push_str(sign);
        write_exact(text, value);
        sign = ",";
    }
    text.push(']');
}
