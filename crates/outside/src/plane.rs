//! Pictures in the plane and plots.

use crate::asked::{Asked, number, numbers, numbers_in};
use crate::made::Made;
use crate::output;
use crate::{equal, near};
use anyhow::{Result, ensure};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::Command;

/// A curve of one colour, and a plant whose colours lie on each other.
pub(crate) const SYSTEMS: [&str; 2] = ["curves/hilbert", "abop/1.24f"];
/// A plot whose lines are finer than any pen, on a small sheet: vpype takes a minute to read 50,000 polylines.
const DEEP: [&str; 6] = ["-n", "40", "--sheet", "100x100", "--pen", "0.5"];
/// The largest difference of two pictures, in parts of the drawing's longer side: pictures are compared on a grid of 400
/// cells, so that ink may be two cells off by rounding on both sides, and strokes of other widths move the box by as
/// much again.
const FAR: f64 = 4.0 / 400.0;

pub(crate) fn ask(made: &Made<'_>, asked: &mut Asked<'_>) -> Result<()> {
    for system in SYSTEMS {
        svg(made, asked, system)?;
        png(made, asked, system)?;
        pdf(made, asked, system)?;
        plot(made, asked, system, &[])?;
        deep(made, asked, system)?;
    }
    plot(made, asked, "abop/1.27", &["--hatch", "--sheet", "150x120", "--start", "bottom-right"])?;
    Ok(())
}

/// The strokes of both forms of SVG against the table of segments, which another writer makes.
fn svg(made: &Made<'_>, asked: &mut Asked<'_>, system: &str) -> Result<()> {
    let told = made.told(system)?;
    let table = json!({"look": "table", "file": made.draw(system, "csv", &[])?.0});
    for format in ["svg", "svg-compact"] {
        let file = made.draw(system, format, &[])?.0;
        let (segments, sides, is_compact) = (told.segments, told.sides(), format == "svg-compact");
        asked.look(
            format!("{system} as {format}"),
            "svgelements, Python's csv",
            [json!({"look": "svg", "file": file}), table.clone()],
            move |answers| {
                let [picture, table] = [&answers[0], &answers[1]];
                equal("rows of the table", table["segments"].as_u64(), Some(segments))?;
                let [length, width, height] = ["length", "width", "height"].map(|key| number(&table[key]));
                near("width of the table's segments", width, sides[0], 1e-6 * sides[0])?;
                near("height of the table's segments", height, sides[1], 1e-6 * sides[1])?;
                // The compact form draws consecutive segments of a straight part as one.
                let strokes = picture["segments"].as_u64().unwrap_or(0);
                ensure!(strokes == segments || is_compact && strokes < segments, "{strokes} of {segments} strokes");
                // Pixels for a step; coordinates have a few decimals.
                let scale = number(&picture["height"]) / height;
                near("width", number(&picture["width"]), width * scale, 1e-3 * width * scale)?;
                near("length of all strokes", number(&picture["length"]), length * scale, 1e-3 * length * scale)?;
                Ok(format!("{strokes} strokes, {length:.1} steps long"))
            },
        );
    }
    Ok(())
}

fn png(made: &Made<'_>, asked: &mut Asked<'_>, system: &str) -> Result<()> {
    let (file, _) = made.draw(system, "png", &["--size", "640x400", "--dpi", "300"])?;
    asked.look(format!("{system} as png"), "Pillow", [json!({"look": "png", "file": file})], |answers| {
        equal("pixels", numbers(&answers[0]["size"]), vec![640.0, 400.0])?;
        // The file has whole dots a metre, of 39.37 inches.
        numbers(&answers[0]["dpi"]).iter().try_for_each(|&dpi| near("dots an inch", dpi, 300.0, 0.02))?;
        let ink = number(&answers[0]["ink"]);
        ensure!((0.001..0.9).contains(&ink), "{ink} of the pixels have ink");
        Ok(format!("640 x 400 pixels, 300 dots an inch, {:.1} % ink", 100.0 * ink))
    });
    Ok(())
}

/// The page of a PDF, and its ink against that of the PNG.
fn pdf(made: &Made<'_>, asked: &mut Asked<'_>, system: &str) -> Result<()> {
    let (sheet, margin) = ([148.0, 210.0], 15.0);
    let (file, _) = made.draw(system, "pdf", &["--sheet", "a5", "--whole-sheet", "--margin", "15"])?;
    asked.look(format!("{system} as pdf"), "pypdf", [json!({"look": "pdf", "file": file})], move |answers| {
        let pages = answers[0]["sizes"].as_array().map_or(0, Vec::len);
        equal("pages", pages, 1)?;
        let sizes = numbers(&answers[0]["sizes"][0]);
        sizes.iter().zip(sheet).try_for_each(|(&size, told)| near("side of the page", size, told, 0.01))?;
        Ok(format!("a page of {} x {} mm", sheet[0], sheet[1]))
    });
    let Some(page) = rendered(asked, made, &file)? else { return Ok(()) };
    let (picture, _) = made.draw(system, "png", &[])?;
    let questions = [
        json!({"look": "strip", "file": page, "page": sheet}),
        json!({"look": "same", "file": page, "other": picture}),
    ];
    asked.look(format!("{system} as pdf"), "pdftoppm, Pillow", questions, move |answers| {
        let [low, high] = ["low", "high"].map(|key| numbers(&answers[0][key]));
        let gaps = [[low[0], sheet[0] - high[0]], [low[1], sheet[1] - high[1]]];
        // A rendered pixel has 0.25 mm. Pictures have a frame of a few strokes' widths around the drawing.
        let least = gaps.iter().flatten().fold(f64::INFINITY, |least, &gap| least.min(gap));
        near("margin and frame in mm", least, margin + 2.0, 2.25)?;
        gaps.iter().try_for_each(|[before, after]| near("margins on two sides in mm", *before, *after, 0.5))?;
        is_same(&answers[1])
    });
    Ok(())
}

/// A PDF's first page as a picture, if there is a program for that.
pub(crate) fn rendered(asked: &Asked<'_>, made: &Made<'_>, file: &Path) -> Result<Option<PathBuf>> {
    let Some(program) = asked.programs.optional("pdftoppm") else { return Ok(None) };
    let name = file.file_stem().unwrap_or_default().to_string_lossy();
    let base = made.path(&format!("{name}-page"));
    output(Command::new(program).args(["-r", "101.6", "-png", "-singlefile"]).arg(file).arg(&base))?;
    Ok(Some(base.with_extension("png")))
}

/// That two pictures have the same ink.
pub(crate) fn is_same(answer: &Value) -> Result<String> {
    let far = number(&answer["far"]);
    near("largest difference from the other picture, in parts of its side", far, 0.0, FAR)?;
    Ok(format!("ink at most {:.2} % off", 100.0 * far))
}

/// The layers, lengths and sheet of a plot against the words of `lsys`.
fn plot(made: &Made<'_>, asked: &mut Asked<'_>, system: &str, words: &[&str]) -> Result<PathBuf> {
    let (file, said) = made.draw(system, "plotter", words)?;
    let told = numbers_in(said.split_once("plot of").map_or("", |(_, told)| told));
    ensure!(told.len() > 5, "lsys did not tell about the plot: {said}");
    let start = if words.contains(&"bottom-right") { [told[0], told[1]] } else { [0.0; 2] };
    let question = json!({"look": "plot", "file": &file, "start": start});
    let is_hatched = words.contains(&"--hatch");
    let words: String = words.iter().map(|word| format!(" {word}")).collect();
    asked.look(format!("{system} as plotter{words}"), "vpype", [question], move |answers| {
        plot_is(&answers[0], &told, is_hatched)
    });
    Ok(file)
}

/// That vpype finds the told sheet, pens, polylines, length and travel.
fn plot_is(found: &Value, told: &[f64], is_hatched: bool) -> Result<String> {
    let (sheet, layers, polylines) = ([told[0], told[1]], told[2], told[3]);
    // A number of metres has two decimals, and a coordinate is rounded to a thousandth of a millimetre.
    let rounding = 5.0 + 1e-3 * number(&found["points"]);
    let sides = numbers(&found["sheet"]);
    sides.iter().zip(sheet).try_for_each(|(&side, told)| near("side of the sheet", side, told, 0.01))?;
    let ids = numbers(&found["layers"]);
    equal("layers", ids.len() as f64, layers)?;
    ensure!(ids.iter().zip(1..).all(|(&id, number)| id == f64::from(number)), "the layers are {ids:?}");
    for (id, [name, colour]) in (1..).zip(pairs(found)) {
        ensure!(
            name.starts_with(&format!("{id} ")) && name.ends_with(&format!("{colour}, pen {id}")),
            "layer {id}: {name}, {colour}"
        );
    }
    equal("polylines", number(&found["polylines"]), polylines)?;
    near("length drawn in mm", number(&found["down"]), 1000.0 * told[4], rounding)?;
    near("travel in mm", number(&found["travel"]), 1000.0 * told[5], rounding)?;
    let [x0, y0, x1, y1] = numbers(&found["box"])[..] else { anyhow::bail!("there is no box") };
    let gap = [x0, y0, sheet[0] - x1, sheet[1] - y1].into_iter().fold(f64::INFINITY, f64::min);
    // The default margin, where the axes of strokes end, or their broad sides.
    ensure!(gap > 9.99, "a line is {gap} mm from the edge");
    if !is_hatched {
        near("least margin in mm", gap, 10.0, 0.01)?;
    }
    Ok(format!(
        "{layers} layers, {polylines} polylines, {:.2} m drawn, {:.2} m travelled, {} x {} mm",
        told[4], told[5], sheet[0], sheet[1]
    ))
}

/// The label and the colour of each layer.
fn pairs(found: &Value) -> Vec<[String; 2]> {
    let texts = |key: &str| -> Vec<String> {
        let list = found[key].as_array().map_or(&[][..], Vec::as_slice);
        list.iter().map(|text| text.as_str().unwrap_or_default().to_owned()).collect()
    };
    texts("names").into_iter().zip(texts("colours")).map(Into::into).collect()
}

/// A deep drawing: the plot has the ink of the PNG.
fn deep(made: &Made<'_>, asked: &mut Asked<'_>, system: &str) -> Result<()> {
    let plot = plot(made, asked, system, &DEEP)?;
    let (picture, _) = made.draw(system, "png", &DEEP[..2])?;
    asked.look(
        format!("{system} as plotter {}, drawn with a pen", DEEP.join(" ")),
        "vpype, Pillow",
        [json!({"look": "same", "file": plot, "other": picture})],
        |answers| is_same(&answers[0]),
    );
    Ok(())
}
