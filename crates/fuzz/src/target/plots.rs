//! Files for pen plotters: lines on the sheet, and a summary of the file.

use super::drawing::flat;
use crate::{Gauge, Source, make};
use lsystem::files::{FileOptions, write_plot};
use lsystem::plot::{Corner, PlotOptions, PlotSummary, Sheet};
use lsystem::{read_file, write_json};

/// The most strokes of a plot in this target.
const MAX: u64 = 20_000;
/// The most parts of a plot in this target, of about 16,384 units of work each. A plot may read millions of blocks
/// until a limit ends it.
const PARTS: usize = 400;
/// The rounding of a coordinate in the file, in millimetres.
const ROUNDING: f64 = 0.0005;
/// The least relative and absolute rounding error of long sums and of drawings placed on the sheet.
const ERROR: f64 = 1e-6;

/// Plots with random choices.
pub(super) fn plots(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let Some(drawing) = flat(source, &system, definition.iterations, gauge) else { return };
    let written = write_json(&definition);
    let options = FileOptions {
        title: "<&>".into(),
        system: written.clone(),
        most: MAX,
        sheet: sheet(source),
        plot: plot_options(source),
        ..FileOptions::default()
    };
    source.show(format_args!("{:?}\n{:?}", options.sheet, options.plot));
    let style = if source.once_in(3) { make::style(source) } else { system.style.clone() };
    let (file, summary) = match gauge.file("plot", PARTS, |sink| write_plot(drawing, &style, &options, sink)) {
        Ok(plot) => plot,
        Err(limit) => return gauge.reach(if limit.is_some() { "refused" } else { "long" }),
    };
    let text = String::from_utf8(file).expect("UTF-8");
    gauge.reach("plot");
    let found = read_file(text.as_bytes()).definition.map(|definition| write_json(&definition));
    assert_eq!(found, Some(written), "the system in the file");
    check(&text, &summary, &options, gauge);
}

/// A sheet, seldom a strange one.
fn sheet(source: &mut Source<'_>) -> Sheet {
    let margin = source.usual(10, &[10.0, 0.0, 20.0, 100.0, 500.0]);
    let [width, height] = [(); 2].map(|()| source.usual(10, &[210.0, 297.0, 50.0, 1000.0]));
    Sheet { width, height, margin }
}

fn plot_options(source: &mut Source<'_>) -> PlotOptions {
    PlotOptions {
        pen: source.usual(10, &[0.3, 0.05, 1.0, 20.0]),
        turns: source.once_in(2),
        hatch: source.once_in(2),
        hide: source.once_in(2),
        start: source.pick(&Corner::ALL),
        least: source.usual(10, &[0.0, 0.0, 1.0, 50.0]),
        speed: source.usual(10, &[50.0]),
        travel_speed: source.usual(10, &[150.0]),
        lift: source.usual(10, &[0.2]),
    }
}

/// Checks the lines of a file against the sheet and against the summary.
fn check(text: &str, summary: &PlotSummary, options: &FileOptions, gauge: &mut Gauge) {
    let [width, height] = summary.sheet;
    let numbers = [width, height, summary.down, summary.travel, summary.travel_before, summary.seconds];
    assert!(numbers.iter().all(|number| number.is_finite() && *number >= 0.0), "{summary:?}");
    // Sides out of range are moved into it. The sheet may be turned.
    let margin = options.sheet.margin;
    let margin = if margin.is_finite() { margin.clamp(0.0, 10_000.0) } else { Sheet::default().margin };
    let (across, down) = Sheet { width, height, margin }.inner();
    let least = [(width - across) / 2.0, (height - down) / 2.0];
    let lines: Vec<Vec<[f64; 2]>> = text.lines().filter_map(polyline).collect();
    let layers = text.lines().filter(|line| line.contains("inkscape:groupmode=\"layer\"")).count();
    assert_eq!((lines.len(), layers), (summary.polylines, summary.pens), "polylines and pens");
    let (mut length, mut segments) = (0.0, 0);
    for points in &lines {
        assert!(points.len() > 1, "a polyline of one point");
        for (axis, side) in [width, height].into_iter().enumerate() {
            let slack = ROUNDING + ERROR * side;
            let within = least[axis] - slack..=side - least[axis] + slack;
            let outside = points.iter().find(|point| !within.contains(&point[axis]));
            assert!(outside.is_none(), "off the page: {outside:?} is not within {within:?} on axis {axis}");
        }
        segments += points.len() - 1;
        let distance = |pair: &[[f64; 2]]| libm::hypot(pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]);
        length += points.windows(2).map(distance).sum::<f64>();
    }
    // Each end of a segment is rounded along both axes.
    let rounding = 2.0 * core::f64::consts::SQRT_2 * ROUNDING * segments as f64;
    let differs = (length - summary.down).abs();
    assert!(differs <= rounding + ERROR * (1.0 + length), "{length} mm drawn, but {} told", summary.down);
    if segments > 0 {
        gauge.reach("lines");
    }
}

/// The points of a polyline in a line of the file.
fn polyline(line: &str) -> Option<Vec<[f64; 2]>> {
    let path = line.strip_prefix("<path ")?.split_once(" d=\"M")?.1.strip_suffix("\"/>").expect("a path on one line");
    let numbers: Vec<f64> = path.split([' ', 'L']).map(|word| word.parse().expect("a number")).collect();
    assert!(numbers.iter().all(|number| number.is_finite()) && numbers.len().is_multiple_of(2), "{line}");
    Some(numbers.chunks_exact(2).map(|point| [point[0], point[1]]).collect())
}
