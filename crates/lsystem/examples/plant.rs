//! A plant from its rules to files: `cargo run --example plant` writes `plant.svg` and `plant.png`.

use lsystem::files::{PngOptions, collect, write_png};
use lsystem::{Definition, Figure, Limits, Style, SvgOptions, System, Vantage, Viewport};
use lsystem::{Plane, count_segments, draw, expand, render_diagnostic, write_svg};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let plant = Definition {
        axiom: "X".into(),
        rules: "X -> F-[[X]+X]+F[+FX]-X\nF -> FF".into(),
        angle: 22.5,
        heading: 65.0,
        ..Definition::default()
    };
    let system = System::new(&plant)?;
    system.warnings.iter().for_each(|warning| eprint!("{}", render_diagnostic(warning, "plant", &plant.rules)));
    let told = |limit| render_diagnostic(&limit, "plant", "");

    println!("n = 2: {}", expand(&system, 2, &Limits::default()).map_err(told)?);

    let few = draw::<Plane>(&system, 5, &Limits::default()).map_err(told)?;
    std::fs::write("plant.svg", write_svg(&few, &Style::default(), &SvgOptions::default()).map_err(told)?.text)?;

    // No file holds these segments, but a picture shows them.
    let many = Figure::draw(&system, 40, &Limits::default()).map_err(told)?;
    println!("n = 40: {} segments", count_segments(&system, 40).map_or_else(String::new, |count| count.to_string()));
    let viewport = Viewport { width: 800, height: 1000, ratio: 1.0 };
    let options = PngOptions { viewport, dpi: Some(300.0), is_transparent: true, ..PngOptions::default() };
    let written = collect::<Vec<u8>, _>(|sink| write_png(&many, &Style::default(), Vantage::default(), &options, sink));
    std::fs::write("plant.png", written.map_err(told)?.0)?;
    Ok(())
}
