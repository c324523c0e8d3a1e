//! Export files: limited in size, well formed, with finite numbers, and with their system.

use super::drawing::{drawn, seen};
use crate::{Gauge, Source, make};
use lsystem::base::Meter;
use lsystem::drawing::Plane;
use lsystem::files::{FileOptions, Print, SvgForm, write_stl};
use lsystem::{
    Definition, Diagnostic, Drawing, Mesh, Solid, Style, SvgOptions, read_file, write_csv, write_glb, write_json,
    write_obj, write_svg,
};
use std::collections::HashMap;

/// The most segments of a file in this target.
const MAX: u64 = 20_000;

/// Writes every format.
pub(super) fn export(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let (n, limits) = (definition.iterations, make::limits(source));
    if !system.is_solid() {
        let Some(drawing) = drawn::<Plane>(&system, n, &limits, gauge) else { return };
        svg(source, &definition, &drawing, &system.style, gauge);
        table(gauge.call("csv", || write_csv(&drawing, MAX)), drawing.segment_count(), 6);
    }
    if system.is_solid() || source.once_in(3) {
        let Some(drawing) = drawn::<Solid>(&system, n, &limits, gauge) else { return };
        table(gauge.call("csv", || write_csv(&*drawing, MAX)), drawing.segment_count(), 8);
        if let Some(seen) = seen(source, &drawing, gauge) {
            svg(source, &definition, &seen, &system.style, gauge);
        }
        let Ok(mesh) = gauge.call("mesh", || Mesh::new(&drawing, &system.style, MAX)) else { return };
        check(&mesh);
        let obj = gauge.call("obj", || write_obj(&mesh, definition.label()));
        assert!(!obj.contains("NaN") && !obj.contains("inf"), "a number that is not finite in OBJ");
        printed(&drawing, &system.style, gauge);
        let written = gauge.call("glb", || write_glb(&drawing, &system.style, MAX, definition.label()));
        let Ok(glb) = written else { return };
        assert!(glb.starts_with(b"glTF"));
        let length = glb[8..12].iter().rev().fold(0, |length, &byte| length << 8 | usize::from(byte));
        assert_eq!(length, glb.len(), "the length that the file tells");
        gauge.reach("mesh");
    }
}

/// Makes a mesh for a printer, and its file: every edge joins two triangles that run along it in opposite directions.
fn printed(drawing: &Drawing<Solid>, style: &Style, gauge: &mut Gauge) {
    let options = FileOptions { most: MAX, ..FileOptions::default() };
    let print = || Print::new(drawing, style, &options, false, &mut Meter::new(u64::MAX));
    let Ok(print) = gauge.call("print", print) else { return };
    let mut edges: HashMap<[u32; 2], [u32; 2]> = HashMap::new();
    for &[a, b, c] in &print.triangles {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            edges.entry([from.min(to), from.max(to)]).or_default()[usize::from(from > to)] += 1;
        }
    }
    let open = edges.iter().find(|(_, count)| **count != [1, 1]);
    assert!(open.is_none(), "an edge of a printed mesh: {open:?}");
    assert!(print.corners.iter().flatten().all(|c| c.is_finite()), "a corner that is not finite");
    let count = print.triangles.len();
    let file = gauge.file("stl", usize::MAX, |sink| write_stl(print, sink)).map(|(file, ())| file);
    // A head of 80 bytes, the number of triangles, and 50 bytes for each.
    assert_eq!(file.map(|file| file.len()), Ok(84 + 50 * count), "the length of an STL file");
    gauge.reach("stl");
}

/// Writes one of the two forms of SVG, with the system inside.
fn svg(source: &mut Source<'_>, definition: &Definition, drawing: &Drawing, style: &Style, gauge: &mut Gauge) {
    let form = source.pick(&[SvgForm::Flat, SvgForm::Compact]);
    let system = write_json(definition);
    let options = SvgOptions { title: "<&>".into(), system: system.clone(), form, most: MAX, ..SvgOptions::default() };
    let Ok(svg) = gauge.call("svg", || write_svg(drawing, style, &options)) else { return };
    let _ = svg.warning();
    gauge.reach("svg");
    assert!(svg.text.starts_with("<svg") && svg.text.trim_end().ends_with("</svg>"));
    let picture = svg.text.replace(&*escaped(&system), "");
    assert!(!picture.contains("NaN") && !picture.contains("inf"), "a number that is not finite in SVG");
    let found = read_file(svg.text.as_bytes()).definition.map(|definition| write_json(&definition));
    assert_eq!(found, Some(system), "the system in the file");
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Checks that a table has one line for each segment, each with `columns` numbers.
fn table(text: Result<String, Diagnostic>, segments: u128, columns: usize) {
    let Ok(text) = text else { return };
    assert_eq!(text.lines().count() as u128, segments + 1, "a line for each segment");
    for line in text.lines().skip(1) {
        let numbers = line.split(',').filter_map(|word| word.parse::<f64>().ok()).filter(|number| number.is_finite());
        assert_eq!(numbers.count(), columns, "{line}");
    }
}

/// Checks that triangles have existing corners, and that numbers are finite.
fn check(mesh: &Mesh) {
    let corners = mesh.positions.len();
    assert!(mesh.normals.len() == corners && mesh.colours.len() == corners);
    assert!(mesh.triangles.iter().flatten().all(|&corner| (corner as usize) < corners));
    assert!(mesh.positions.iter().chain(&mesh.normals).flatten().all(|c| c.is_finite()), "a corner that is not finite");
}
