//! Systems, strings and pyramids of tiles.

use crate::asked::{Asked, number, numbers};
use crate::made::Made;
use crate::output;
use crate::{equal, near, plane};
use anyhow::{Context, Result};
use fs_err as fs;
use serde_json::{Value, json};

/// The levels of a pyramid below the tile of all.
const LEVELS: u32 = 2;

pub(crate) fn ask(made: &Made<'_>, asked: &mut Asked<'_>) -> Result<()> {
    for system in plane::SYSTEMS {
        let source: Value = serde_json::from_slice(&fs::read(made.source(system))?)?;
        let symbols = made.told(system)?.symbols;
        let text = json!({"look": "words", "file": made.draw(system, "txt", &[])?.0});
        asked.look(format!("{system} as txt"), "Python", [text], move |answers| {
            equal("symbols", answers[0]["characters"].as_u64(), Some(symbols))?;
            Ok(format!("{symbols} symbols"))
        });
        let question = json!({"look": "system", "file": made.draw(system, "json", &[])?.0});
        let told = source.clone();
        asked.look(format!("{system} as json"), "Python's json", [question], move |answers| {
            let (found, told) = (&answers[0], &told);
            equal("axiom", &found["initial"], &told["initial"])?;
            equal("rules", &found["rules"], &told["rules"])?;
            equal("steps", &found["steps"], &told["num_iters"])?;
            Ok("the axiom, the rules and the steps of its source".to_owned())
        });
        let question = json!({"look": "markdown", "file": made.draw(system, "markdown", &[])?.0});
        asked.look(format!("{system} as markdown"), "markdown-it", [question], move |answers| {
            let rules = source["rules"].as_array().context("rules")?.iter().filter_map(Value::as_str);
            let sides = |rule: &str| rule.split(" -> ").map(str::to_owned).collect();
            let told: Vec<Vec<String>> =
                core::iter::once(vec![source["initial"].as_str().unwrap_or_default().to_owned()])
                    .chain(rules.map(sides))
                    .collect();
            equal("axiom and productions", &answers[0]["items"], &json!(told))?;
            Ok(format!("the axiom and {} productions", told.len() - 1))
        });
    }
    pyramid(made, asked, plane::SYSTEMS[1])
}

/// The tiles of a pyramid: their number on each level, and the ink of the last level against that of a PNG of its size.
fn pyramid(made: &Made<'_>, asked: &mut Asked<'_>, system: &str) -> Result<()> {
    let folder = made.path("tiles");
    let levels = format!("0..{LEVELS}");
    let mut command = made.command("tiles", system);
    output(command.arg(&folder).args(["--levels", &levels, "--set", "background=#ffffff"]))?;
    let side = 256_u64 << LEVELS;
    let question = json!({"look": "pyramid", "file": folder.join("tiles.dzi")});
    asked.look(format!("{system} as tiles"), "Pillow", [question], move |answers| {
        let found = &answers[0];
        equal("size", numbers(&found["size"]), vec![side as f64; 2])?;
        // Level 8 of Deep Zoom is the first one of 256 pixels. Tiles without ink are left out.
        let top = 8 + u64::from(LEVELS);
        equal("levels", found["top"].as_u64(), Some(top))?;
        let tiles = found["tiles"].as_object().context("tiles")?;
        equal("levels with tiles", tiles.len() as u64, top + 1)?;
        let count: u64 = tiles.values().filter_map(Value::as_u64).sum();
        near("part with ink", number(&found["ink"]), 0.05, 0.05)?;
        Ok(format!("{count} tiles on {} levels of up to {side} pixels", tiles.len()))
    });
    Ok(())
}
