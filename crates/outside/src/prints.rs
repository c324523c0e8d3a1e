//! Prints in space: sliced by PrusaSlicer, and united by OpenSCAD. Both take long.

use crate::asked::{Asked, number};
use crate::made::Made;
use crate::{near, output};
use anyhow::{Result, ensure};
use fs_err as fs;
use serde_json::json;
use std::process::Command;

/// A plant in the plane, a curve, and a plant in space with leaves.
const PRINTS: [(&str, &str); 3] = [("abop/1.24f", "5"), ("curves/koch-snowflake", "4"), ("garden/five-ways", "3")];
/// Plants with the volume of their bodies' union in mm³, as manifold3d 3.5.4 computes it.
const UNIONS: [(&str, &str, f64); 2] = [("abop/1.24f", "3", 981.970), ("abop/1.25", "3", 4581.176)];

pub(crate) fn ask(made: &Made<'_>, asked: &mut Asked<'_>) -> Result<()> {
    if let Some(program) = asked.programs.optional("prusa-slicer") {
        for (system, n) in PRINTS {
            let print = made.draw(system, "stl", &["-n", n])?.0;
            let code = print.with_extension("gcode");
            let said = output(Command::new(program).arg("--export-gcode").arg(&print).arg("--output").arg(&code));
            let sliced = said.and_then(|said| {
                ensure!(!said.to_lowercase().contains("empty layer"), "{said}");
                let layers = fs::read_to_string(&code)?.matches(";LAYER_CHANGE").count();
                ensure!(layers > 100, "{layers} layers");
                Ok(format!("{layers} layers, none is empty"))
            });
            asked.note(format!("{system} as stl"), "PrusaSlicer", sliced);
        }
    }
    if let Some(program) = asked.programs.optional("openscad") {
        for (system, n, told) in UNIONS {
            let bodies = made.draw(system, "scad", &["-n", n])?.0;
            let union = bodies.with_extension("stl");
            output(Command::new(program).arg("-o").arg(&union).arg(&bodies))?;
            let question = json!({"look": "mesh", "file": union});
            asked.look(format!("{system} as scad"), "OpenSCAD", [question], move |answers| {
                let volume = number(&answers[0]["volume"]);
                near("volume of the union", volume, told, told / 1000.0)?;
                Ok(format!("{volume:.1} mm³"))
            });
        }
    }
    Ok(())
}
