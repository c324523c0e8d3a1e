//! Meshes.

use crate::asked::{Asked, number, numbers};
use crate::made::Made;
use crate::{equal, near};
use anyhow::{Result, ensure};
use fs_err as fs;
use serde_json::json;

/// A curve in the plane, as tubes, and a bush with leaves.
const SYSTEMS: [&str; 2] = ["curves/hilbert", "abop/1.25"];
/// Tubes reach beyond their axes by half a stroke's width, which is less than this part of a drawing's longer side.
const TUBE: f64 = 0.02;
/// The part of the triangles that may be missing where parts repeat.
const MISSING: f64 = 0.1;

pub(crate) fn ask(made: &Made<'_>, asked: &mut Asked<'_>) -> Result<()> {
    for system in SYSTEMS {
        let mut sides = made.told(system)?.sides();
        sides.resize(3, 0.0);
        let longest = sides.iter().copied().fold(0.0, f64::max);
        let (obj, glb) = (made.draw(system, "obj", &[])?.0, made.draw(system, "glb", &[])?.0);
        // Faces of more than three corners are cut into triangles.
        let text = fs::read_to_string(&obj)?;
        let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
        let triangles: u64 = faces.map(|corners| corners.split_whitespace().count() as u64 - 2).sum();
        asked.validate_gltf(format!("{system} as glb"), &glb, move |answers| {
            let (issues, info) = (&answers[0]["issues"], &answers[0]["info"]);
            for kind in ["numErrors", "numWarnings"] {
                equal(&format!("{kind} in {}", issues["messages"]), issues[kind].as_u64(), Some(0))?;
            }
            // Parts that repeat are written once.
            let written = info["totalTriangleCount"].as_u64().unwrap_or(0);
            ensure!((1..=triangles).contains(&written), "{written} triangles are written for {triangles} of OBJ");
            Ok(format!("no errors and no warnings, {written} triangles for {triangles} of OBJ"))
        });
        for (format, file) in [("obj", obj), ("glb", glb)] {
            let sides = sides.clone();
            let question = json!({"look": "mesh", "file": file});
            asked.look(format!("{system} as {format}"), "trimesh", [question], move |answers| {
                // Parts that repeat have ends of their own, so joints inside OBJ may be missing between them.
                let off = if format == "obj" { 0.0 } else { MISSING * triangles as f64 };
                near("triangles", number(&answers[0]["faces"]), triangles as f64, off)?;
                for (&found, &told) in numbers(&answers[0]["box"]).iter().zip(&sides) {
                    // Coordinates have seven digits.
                    near("side of the box", found, told + TUBE / 2.0 * longest, (TUBE / 2.0 + 1e-6) * longest)?;
                }
                Ok(format!("{triangles} triangles, {:.1} x {:.1} x {:.1} steps", sides[0], sides[1], sides[2]))
            });
        }
        let file = made.draw(system, "stl", &[])?.0;
        asked.look(format!("{system} as stl"), "trimesh", [json!({"look": "mesh", "file": file})], |answers| {
            let mesh = &answers[0];
            ensure!(mesh["is_watertight"] == true, "the mesh is not watertight");
            ensure!(mesh["is_oriented"] == true, "some faces are turned over");
            let (sides, volume) = (numbers(&mesh["box"]), number(&mesh["volume"]));
            near("longest side in mm", sides.iter().copied().fold(0.0, f64::max), 100.0, 0.001)?;
            let most: f64 = sides.iter().product();
            ensure!(0.0 < volume && volume < most, "the volume is {volume} mm³ in a box of {most} mm³");
            Ok(format!("watertight, {} triangles, {volume:.0} mm³", mesh["faces"]))
        });
    }
    Ok(())
}
