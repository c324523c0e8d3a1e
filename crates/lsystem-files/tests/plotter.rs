//! Files for pen plotters, against plain geometry.

use lsystem_base::{LimitName, Limits, Meter};
use lsystem_drawing::{Drawing, Mark, Plane, System, draw};
use lsystem_files::{FileOptions, Owner, Sink, collect, read_json, read_segments, write_plot};
use lsystem_plot::{Corner, PlotOptions, PlotSummary, Sheet};
use lsystem_syntax::{Definition, Halt, Kind};
use std::path::Path;
use std::sync::Arc;

type Point = [f64; 2];

/// Ten systems: curves, islands, plants, many coincident strokes, and pens of several colours.
const SYSTEMS: [&str; 10] = [
    "curves/hilbert",
    "curves/gosper",
    "curves/levy-c",
    "curves/koch-snowflake",
    "curves/penrose",
    "curves/sierpinski-gasket",
    "abop/1.24a",
    "abop/1.24f",
    "practical-1/tree1",
    "focs-lsystems/dragon-curve",
];

fn definition(name: &str) -> Definition {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in").join(format!("{name}.json"));
    read_json(&std::fs::read_to_string(path).unwrap()).0.unwrap()
}

fn drawing(definition: &Definition, n: u32) -> Option<Arc<Drawing>> {
    let system = System::new(definition).unwrap_or_else(|diagnostics| panic!("{diagnostics:?}"));
    draw::<Plane>(&system, n, &Limits::default()).ok().map(Arc::new)
}

/// The drawing with the most steps that has at most `most` segments.
fn deepest(definition: &Definition, most: u128) -> Arc<Drawing> {
    let fits = |drawing: &Arc<Drawing>| drawing.segment_count() <= most;
    (0..12).map_while(|n| drawing(definition, n).filter(fits)).last().unwrap()
}

/// A sheet and a pen.
fn options(sheet: Sheet, pen: f64) -> FileOptions {
    FileOptions { sheet, plot: PlotOptions { pen, ..PlotOptions::default() }, ..FileOptions::default() }
}

fn plot(drawing: &Arc<Drawing>, definition: &Definition, options: &FileOptions) -> (String, PlotSummary) {
    collect(|sink| write_plot(drawing.clone(), &definition.style, options, sink)).unwrap()
}

/// The polylines of a file, layer by layer.
fn polylines(text: &str) -> Vec<Vec<Vec<Point>>> {
    let mut layers: Vec<Vec<Vec<Point>>> = vec![];
    for line in text.lines() {
        if line.starts_with("<g ") {
            layers.push(vec![]);
            assert!(line.contains("inkscape:groupmode=\"layer\"") && line.contains("fill=\"none\""));
            assert!(line.contains(&format!(", pen {}\"", layers.len())), "{line}");
        }
        let Some(d) = line.strip_prefix("<path ").and_then(|line| line.strip_suffix("\"/>")) else { continue };
        assert!(d.starts_with("stroke-width=\""));
        let d = d.split_once(" d=\"M").unwrap().1;
        let numbers: Vec<f64> = d.split([' ', 'L']).map(|number| number.parse().unwrap()).collect();
        layers.last_mut().unwrap().push(numbers.chunks(2).map(|pair| [pair[0], pair[1]]).collect());
    }
    layers
}

fn distance(a: Point, b: Point) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

/// The millimetres of a unit of the model.
fn scale(drawing: &Drawing, size: Point, margin: f64) -> f64 {
    let [x0, y0, x1, y1] = drawing.bounds().unwrap();
    ((size[0] - 2.0 * margin) / (x1 - x0)).min((size[1] - 2.0 * margin) / (y1 - y0))
}

/// The ink of a drawing, naively: the lines of each colour, each with its disjoint stretches.
#[derive(Default)]
struct Ink {
    lines: Vec<(String, Point, Point, Vec<[f64; 2]>)>,
}

impl Ink {
    /// The ink on a sheet.
    fn of(drawing: &Drawing, definition: &Definition, size: Point, margin: f64) -> Self {
        let [x0, y0, x1, y1] = drawing.bounds().unwrap();
        let scale = scale(drawing, size, margin);
        let place = |[x, y]: Point| {
            [size[0] / 2.0 + scale * (x - (x0 + x1) / 2.0), size[1] / 2.0 - scale * (y - (y0 + y1) / 2.0)]
        };
        let mut ink = Self::default();
        for mark in drawing.marks() {
            let (points, tint) = match mark {
                Mark::Segment(segment, tint) => (vec![segment.from, segment.to], tint),
                Mark::Polygon(mut vertices, tint) => {
                    vertices.push(vertices[0]);
                    (vertices, tint)
                }
            };
            let colour = String::from(definition.style.colour_of(tint));
            points.windows(2).for_each(|pair| ink.add(&colour, place(pair[0]), place(pair[1])));
        }
        for (.., stretches) in &mut ink.lines {
            stretches.sort_by(|a, b| a[0].total_cmp(&b[0]));
            stretches.dedup_by(|next, last| {
                let touches = next[0] < last[1] + 1e-3;
                last[1] = if touches { last[1].max(next[1]) } else { last[1] };
                touches
            });
        }
        ink
    }

    fn add(&mut self, colour: &str, a: Point, b: Point) {
        if distance(a, b) < 1e-5 {
            return;
        }
        let line = self
            .lines
            .iter()
            .position(|(own, at, way, _)| own == colour && [a, b].iter().all(|&point| aside(*at, *way, point) < 1e-4));
        let line = line.unwrap_or_else(|| {
            let way = [0, 1].map(|axis| (b[axis] - a[axis]) / distance(a, b));
            self.lines.push((colour.to_owned(), a, way, vec![]));
            self.lines.len() - 1
        });
        let (_, at, way, stretches) = &mut self.lines[line];
        let [from, to] = [a, b].map(|point| along(*at, *way, point));
        stretches.push([from.min(to), from.max(to)]);
    }

    fn length(&self) -> f64 {
        self.lines.iter().flat_map(|line| &line.3).map(|[start, end]| end - start).sum()
    }

    /// Whether the line between two points is ink; both are rounded to thousandths of a millimetre.
    fn has(&self, a: Point, b: Point) -> bool {
        self.lines.iter().any(|(_, at, way, stretches)| {
            [a, b].iter().all(|&point| aside(*at, *way, point) < 3e-3) && {
                let [from, to] = [a, b].map(|point| along(*at, *way, point));
                stretches.iter().any(|[start, end]| from.min(to) > start - 3e-3 && from.max(to) < end + 3e-3)
            }
        })
    }
}

fn aside(at: Point, way: Point, point: Point) -> f64 {
    (way[0] * (point[1] - at[1]) - way[1] * (point[0] - at[0])).abs()
}

fn along(at: Point, way: Point, point: Point) -> f64 {
    way[0] * (point[0] - at[0]) + way[1] * (point[1] - at[1])
}

#[test]
fn all_ink_is_drawn_once_and_nothing_else() {
    for name in SYSTEMS {
        let definition = definition(name);
        let drawing = deepest(&definition, 2000);
        let (text, summary) = plot(&drawing, &definition, &options(Sheet::named("a2").unwrap(), 0.05));
        let ink = Ink::of(&drawing, &definition, summary.sheet, 10.0);
        assert!((summary.down - ink.length()).abs() < 1e-4 * ink.length(), "{name} {summary:?} {}", ink.length());
        let layers = polylines(&text);
        let all: Vec<&Vec<Point>> = layers.iter().flatten().collect();
        assert_eq!((layers.len(), all.len()), (summary.pens, summary.polylines), "{name}");
        let drawn: f64 = all.iter().map(|points| length(points)).sum();
        assert!((drawn - summary.down).abs() < 1e-3 * drawn, "{name}");
        assert!(all.iter().all(|points| points.windows(2).all(|pair| ink.has(pair[0], pair[1]))), "{name}");
        let straight = |p: &[Point]| {
            let turn = (p[1][0] - p[0][0]) * (p[2][1] - p[1][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[1][0]);
            turn.abs() < 1e-4 * distance(p[0], p[1]) * distance(p[1], p[2])
                && distance(p[0], p[2]) > distance(p[0], p[1])
        };
        assert!(!all.iter().any(|points| points.windows(3).any(straight)), "{name}");
        let travel: f64 = (layers.iter())
            .map(|layer| {
                let mut stops = vec![[0.0; 2]];
                layer.iter().for_each(|points| stops.extend([points[0], points[points.len() - 1]]));
                stops.push([0.0; 2]);
                stops.chunks(2).map(length).sum::<f64>()
            })
            .sum();
        assert!((travel - summary.travel).abs() < 1e-3 * (travel + 10.0), "{name} {travel} {summary:?}");
        // To draw coincident strokes once may take more travel than to draw them again.
        let strokes = drawing.segments().map(|segment| distance(segment.from, segment.to)).sum::<f64>();
        if strokes * scale(&drawing, summary.sheet, 10.0) < 1.001 * ink.length() {
            assert!(summary.travel < summary.travel_before + 1e-6, "{name} {summary:?}");
        }
    }
}

#[test]
fn a_curve_is_one_polyline() {
    for name in ["curves/hilbert", "curves/gosper", "curves/koch-snowflake"] {
        let definition = definition(name);
        let drawing = deepest(&definition, 2000);
        let (_, summary) = plot(&drawing, &definition, &options(Sheet::default(), 0.05));
        assert_eq!(summary.polylines, 1, "{name}");
    }
}

#[test]
fn plots_with_parts_smaller_than_the_pen_take_no_more_than_their_ink() {
    for name in SYSTEMS {
        let definition = definition(name);
        let drawing = deepest(&definition, 2000);
        for pen in [1.0, 3.0, 10.0] {
            let (_, summary) = plot(&drawing, &definition, &options(Sheet::named("a5").unwrap(), pen));
            let ink = Ink::of(&drawing, &definition, summary.sheet, 10.0).length();
            println!("{name} {pen}: {:.0} of {ink:.0} mm, {} polylines", summary.down, summary.polylines);
            assert!(summary.down < ink * (1.0 + 1e-6) && summary.down > 0.0, "{name} {pen} {summary:?} {ink}");
        }
    }
}

#[test]
fn forty_steps_are_plotted_like_few() {
    for name in SYSTEMS {
        let definition = definition(name);
        let sheet = Sheet { width: 60.0, height: 60.0, margin: 5.0 };
        let Some(drawing) = drawing(&definition, 40) else { continue };
        let pen = 0.5;
        let (text, summary) = plot(&drawing, &definition, &options(sheet, pen));
        println!("{name}: {summary:?}, {} bytes", text.len());
        // Lines a pen's width apart fill the sheet once; a colour takes about twice as much, as lines between spots smaller
        // than the pen do. Gaps of up to four pens in ink are drawn over, so that shorter lines are seldom.
        let fill = summary.pens as f64 * 50.0 * 50.0 / pen;
        assert!(summary.down > 50.0 && summary.down < 2.5 * fill, "{name} {summary:?}");
        assert!(summary.down / summary.polylines as f64 > 4.0 * pen, "{name} {summary:?}");
    }
}

/// An owner who stops the work after so many calls, and checks how much work lies between two.
struct Patience(u32, u64);

impl Owner for Patience {
    fn piece(&mut self, _: &[u8]) -> Result<(), Halt> {
        Ok(())
    }

    fn spent(&mut self, units: u64) -> Result<(), Halt> {
        assert!(units <= (1 << 14) + Meter::PIECE, "{units}");
        self.1 += 1;
        self.0 = self.0.checked_sub(1).ok_or(Halt::Stopped)?;
        Ok(())
    }
}

#[test]
fn plots_can_be_stopped_at_any_time() {
    let definition = definition("curves/penrose");
    let drawing = deepest(&definition, 2000);
    let options = options(Sheet::default(), 0.3);
    let calls = |patience: u32| {
        let mut owner = Patience(patience, 0);
        let result = Sink::to(&mut owner, |sink| write_plot(drawing.clone(), &definition.style, &options, sink));
        (result.is_ok(), owner.1)
    };
    let (is_done, all) = calls(u32::MAX);
    assert!(is_done && all > 2, "{all}");
    for patience in 0..all {
        assert_eq!(calls(patience as u32), (false, patience + 1));
    }
}

#[test]
fn numbers_out_of_range_are_bounded() {
    let definition = definition("abop/1.24a");
    let drawing = deepest(&definition, 2000);
    for bad in [f64::NAN, f64::INFINITY, -1e300, -1.0, 0.0, 1e-300, 1e300] {
        let sheet = Sheet { width: bad, height: bad, margin: bad };
        let plot_options = PlotOptions {
            pen: bad,
            least: bad,
            speed: bad,
            travel_speed: bad,
            lift: bad,
            hatch: true,
            hide: bad > 0.0,
            start: Corner::BottomRight,
            turns: true,
        };
        let file = FileOptions { sheet, plot: plot_options, ..FileOptions::default() };
        let (text, summary) = plot(&drawing, &definition, &file);
        assert!(text.ends_with("</svg>\n") && summary.seconds.is_finite() && summary.travel.is_finite(), "{bad}");
    }
    let mut wide = definition.clone();
    wide.style.width = 1e9;
    let drawing = deepest(&wide, 2000);
    let mut file = options(Sheet::default(), 0.3);
    file.plot.hatch = true;
    assert!(plot(&drawing, &wide, &file).0.ends_with("</svg>\n"));
}

#[test]
fn limits_name_themselves() {
    let definition = definition("curves/hilbert");
    let file = FileOptions { most: 1000, ..options(Sheet::default(), 0.3) };
    let drawing = drawing(&definition, 40).unwrap();
    let mut text = String::new();
    let halt = Sink::to(&mut text, |sink| write_plot(drawing, &definition.style, &file, sink)).unwrap_err();
    let error = halt.diagnostic();
    assert!(matches!(error.kind, Kind::Limit { limit: LimitName::PlotStrokes, value: 1000, .. }));
    assert!(text.is_empty());
}

#[test]
fn polygons_and_broad_strokes_are_hatched() {
    let mut definition = Definition { axiom: "{F+F+F+F}".into(), angle: 90.0, ..Definition::default() };
    let mut file = options(Sheet { width: 120.0, height: 120.0, margin: 10.0 }, 0.5);
    let outline = plot(&drawing(&definition, 0).unwrap(), &definition, &file).1;
    assert!((outline.down - 400.0).abs() < 1e-6, "{outline:?}");
    file.plot.hatch = true;
    let (text, hatched) = plot(&drawing(&definition, 0).unwrap(), &definition, &file);
    // The area, over the distance of the lines.
    assert!((hatched.down - 400.0 - 100.0 * 100.0 / 0.5).abs() < 200.0, "{hatched:?}");
    let read = read_segments(&text, 100_000).unwrap().unwrap();
    assert_eq!(read.segments.len(), polylines(&text).iter().flatten().map(|points| points.len() - 1).sum::<usize>());

    definition.axiom = "F".into();
    definition.style.width = 0.5;
    let (text, broad) = plot(&drawing(&definition, 0).unwrap(), &definition, &file);
    assert_eq!(broad.polylines, 1, "{text}");
    let area = broad.down * 0.5;
    let [width, height] = [0, 1].map(|axis| {
        let values = || polylines(&text).into_iter().flatten().flatten().map(move |point| point[axis]);
        values().fold(0.0, f64::max) - values().fold(f64::INFINITY, f64::min)
    });
    assert!((area - (width + 0.5) * height.max(width)).abs() < 0.05 * area, "{area} {width} {height}");
}

#[test]
fn what_is_behind_is_hidden() {
    // A square, and one that covers a quarter of it: two half sides of the first are hidden.
    let axiom = "[{F-F-F-F}]f(0.5)-f(0.5)+{F-F-F-F}".into();
    let mut definition = Definition { axiom, angle: 90.0, ..Definition::default() };
    definition.style.width = 0.0;
    let mut file = options(Sheet { width: 220.0, height: 220.0, margin: 10.0 }, 0.3);
    let drawing = drawing(&definition, 0).unwrap();
    let lengths = [false, true].map(|hide| {
        file.plot.hide = hide;
        plot(&drawing, &definition, &file).1.down / scale(&drawing, [220.0; 2], 10.0)
    });
    assert!((lengths[0] - 8.0).abs() < 1e-6 && (lengths[1] - 7.0).abs() < 1e-6, "{lengths:?}");

    // A broad stroke is an outline: two sides and a circle.
    let mut broad = Definition { axiom: "F".into(), ..Definition::default() };
    broad.style.width = 0.5;
    let drawing = self::drawing(&broad, 0).unwrap();
    let (text, summary) = plot(&drawing, &broad, &file);
    let points = polylines(&text).concat().concat();
    let [width, height] = [0, 1].map(|axis| {
        let values = || points.iter().map(move |point| point[axis]);
        values().fold(0.0, f64::max) - values().fold(f64::INFINITY, f64::min)
    });
    let [short, long] = [width.min(height), width.max(height)];
    assert_eq!(summary.polylines, 1, "{text}");
    let around = 2.0 * (long - short) + core::f64::consts::PI * short;
    assert!((summary.down - around).abs() < 0.01 * around, "{summary:?} {around}");
}

#[test]
fn plots_that_hide_can_be_stopped_and_have_limits() {
    let mut definition = definition("garden/sunflower");
    definition.iterations = definition.iterations.min(4);
    let drawing = drawing(&definition, definition.iterations).unwrap();
    let mut file = options(Sheet::default(), 0.3);
    file.plot.hide = true;
    file.plot.hatch = true;
    let calls = |patience: u32| {
        let mut owner = Patience(patience, 0);
        let result = Sink::to(&mut owner, |sink| write_plot(drawing.clone(), &definition.style, &file, sink));
        (result.is_ok(), owner.1)
    };
    let (is_done, all) = calls(u32::MAX);
    assert!(is_done && all > 2, "{all}");
    for patience in (0..all).step_by(1 + all as usize / 20) {
        assert_eq!(calls(patience as u32), (false, patience + 1));
    }
    file.most = 50;
    let mut text = String::new();
    let halt = Sink::to(&mut text, |sink| write_plot(drawing, &definition.style, &file, sink)).unwrap_err();
    assert!(matches!(halt.diagnostic().kind, Kind::Limit { limit: LimitName::PlotStrokes, value: 50, .. }));
}

#[test]
fn short_lines_are_left_out_and_pens_start_in_their_corner() {
    let definition = definition("abop/1.24f");
    let drawing = deepest(&definition, 2000);
    let mut file = options(Sheet::default(), 0.05);
    let all = plot(&drawing, &definition, &file);
    file.plot.least = 10.0;
    let few = plot(&drawing, &definition, &file);
    assert!(few.1.polylines < all.1.polylines && few.1.down < all.1.down);
    assert!(polylines(&few.0).iter().flatten().all(|points| length(points) > 9.99));
    file.plot.start = Corner::BottomLeft;
    let corner = plot(&drawing, &definition, &file);
    assert!(corner.0 != few.0 && corner.1.down == few.1.down);
}
