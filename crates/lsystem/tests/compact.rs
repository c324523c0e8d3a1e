//! Compact SVG pictures: contents, size and cost.

use lsystem::base::LimitName;
use lsystem::files::{Svg, SvgForm};
use lsystem::syntax::{ColourBy, Kind, Tint};
use lsystem::{Definition, Drawing, Limits, Plane, SvgOptions, System, draw, read_json, write_svg};
use std::collections::HashMap;
use std::path::Path;

const PLANT: &str = "X -> F-[[X]+X]+F[+FX]-X\nF -> FF";

fn plant(n: u32) -> Definition {
    let (axiom, rules) = ("X".into(), PLANT.into());
    Definition { axiom, rules, angle: 25.0, iterations: n, ..Definition::default() }
}

fn drawing(definition: &Definition) -> Drawing {
    draw::<Plane>(&System::new(definition).unwrap(), definition.iterations, &Limits::default()).unwrap()
}

fn compact(definition: &Definition, size: f64) -> Svg {
    let options = SvgOptions { form: SvgForm::Compact, size, ..SvgOptions::default() };
    write_svg(&drawing(definition), &definition.style, &options).unwrap()
}

/// An SVG file read naively: every `<use>` expanded, element by element.
#[derive(Default)]
struct Reader<'a> {
    definitions: HashMap<&'a str, Vec<&'a str>>,
    strokes: Vec<Stroke>,
    uses: usize,
}

#[derive(Clone, Debug)]
struct Stroke {
    from: [f64; 2],
    to: [f64; 2],
    colour: String,
    width: f64,
    end_width: f64,
}

/// The stroke whose outline this is: an arc around its end, then one around its start, nine corners each. `None` for
/// another polygon.
fn cone(corners: &[[f64; 2]], colour: &str) -> Option<Stroke> {
    let (end, start) = (corners.len() == 18).then(|| corners.split_at(9))?;
    let circle = |arc: &[[f64; 2]]| {
        // The centre is as far from the first corner as from the middle and the last one.
        let row = |to: [f64; 2]| {
            let way = [to[0] - arc[0][0], to[1] - arc[0][1]];
            (way, (to[0] * to[0] + to[1] * to[1] - arc[0][0] * arc[0][0] - arc[0][1] * arc[0][1]) / 2.0)
        };
        let ((a, u), (b, v)) = (row(arc[4]), row(arc[8]));
        let det = a[0] * b[1] - a[1] * b[0];
        let centre = [(u * b[1] - v * a[1]) / det, (a[0] * v - b[0] * u) / det];
        let radius = distance(centre, arc[0]);
        arc.iter().all(|&corner| (distance(centre, corner) - radius).abs() < 0.02).then_some((centre, radius))
    };
    let ((to, last), (from, first)) = (circle(end)?, circle(start)?);
    Some(Stroke { from, to, colour: colour.to_owned(), width: 2.0 * first, end_width: 2.0 * last })
}

/// A rotation in degrees and a translation, with y down.
#[derive(Clone, Copy)]
struct Transform {
    degrees: f64,
    at: [f64; 2],
}

impl Transform {
    fn of(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (s, c) = (libm::sin(self.degrees.to_radians()), libm::cos(self.degrees.to_radians()));
        [self.at[0] + c * x - s * y, self.at[1] + s * x + c * y]
    }
}

fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let start = line.find(&format!(" {name}=\""))? + name.len() + 3;
    line[start..].split('"').next()
}

fn number(line: &str, name: &str) -> f64 {
    attribute(line, name).map_or(0.0, |text| text.parse().unwrap())
}

impl<'a> Reader<'a> {
    fn read(text: &'a str) -> Self {
        let mut reader = Self::default();
        let (before, body) = text.split_once("<g fill").unwrap();
        let around = &text[before.len()..text.len() - body.len() + body.find('\n').unwrap()];
        let mut lines = body.lines().skip(1);
        let (mut main, mut group) = (vec![], None);
        for line in lines.by_ref() {
            if line == "</svg>" || line == "<defs>" || line == "</defs>" {
            } else if let Some(name) = line.strip_prefix("<g id=\"") {
                group = name.split('"').next();
            } else if line == "</g>" {
                group = None;
            } else if let Some(name) = group {
                reader.definitions.entry(name).or_default().push(line);
            } else if let Some(name) = attribute(line, "id") {
                reader.definitions.insert(name, vec![line]);
            } else {
                main.push(line);
            }
        }
        reader.expand(&main, Transform { degrees: 0.0, at: [0.0; 2] }, around);
        reader
    }

    fn expand(&mut self, lines: &[&'a str], transform: Transform, around: &str) {
        for line in lines {
            if line.starts_with("<use") {
                self.uses += 1;
                let name = attribute(line, "xlink:href").unwrap().strip_prefix('#').unwrap();
                let (mut at, mut degrees) = ([number(line, "x"), number(line, "y")], 0.0);
                if let Some(text) = attribute(line, "transform") {
                    let numbers: Vec<f64> = text.split(['(', ')', ' ']).filter_map(|word| word.parse().ok()).collect();
                    assert_eq!(numbers.len(), 3, "{text}");
                    (at, degrees) = ([numbers[0], numbers[1]], numbers[2]);
                }
                let inner = Transform { degrees: transform.degrees + degrees, at: transform.of(at) };
                let definition = self.definitions[name].clone();
                self.expand(&definition, inner, around);
                continue;
            }
            assert!(line.starts_with("<path"), "{line}");
            // Polygons have no strokes, but may be the outlines of strokes that taper.
            if attribute(line, "stroke") == Some("none") {
                let path = attribute(line, "d").unwrap().trim_start_matches('M').trim_end_matches('z');
                let numbers: Vec<f64> = path.split([' ', 'L']).map(|number| number.parse().unwrap()).collect();
                let corners: Vec<[f64; 2]> = numbers.chunks(2).map(|p| transform.of([p[0], p[1]])).collect();
                self.strokes.extend(cone(&corners, attribute(line, "fill").unwrap()));
                continue;
            }
            let of = |name| attribute(line, name).or(attribute(around, name)).unwrap();
            let (colour, width) = (of("stroke").to_owned(), of("stroke-width").parse().unwrap());
            for part in attribute(line, "d").unwrap().split('M').skip(1) {
                let numbers: Vec<f64> = part.split([' ', 'L']).map(|number| number.parse().unwrap()).collect();
                let points: Vec<[f64; 2]> = numbers.chunks(2).map(|p| transform.of([p[0], p[1]])).collect();
                self.strokes.extend(points.windows(2).map(|pair| {
                    let [from, to] = [pair[0], pair[1]];
                    Stroke { from, to, colour: colour.clone(), width, end_width: width }
                }));
            }
        }
    }
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// Checks that the compact strokes cover the segments of the drawing in order. A stroke may stand for several segments
/// on a line.
fn check_covers(definition: &Definition, size: f64) {
    let drawing = drawing(definition);
    let svg = compact(definition, size);
    let reader = Reader::read(&svg.text);
    let [x0, y0, x1, y1] = drawing.bounds().unwrap();
    let margin = definition.step.abs();
    let pixel = ((x1 - x0).max(y1 - y0) + 2.0 * margin) / size;
    let place = |[x, y]: [f64; 2]| [(x - x0 + margin) / pixel, (y1 + margin - y) / pixel];
    let near = |a, b| distance(a, b) < 0.02;
    let mut segments = drawing.segments().peekable();
    for stroke in &reader.strokes {
        let mut at = stroke.from;
        while segments.peek().is_some() && (at == stroke.from || !near(at, stroke.to)) {
            let segment = segments.next().unwrap();
            assert!(near(place(segment.from), at), "{stroke:?} {segment:?} {}", definition.name);
            let colour = String::from(definition.style.colour_of(Tint {
                index: segment.colour,
                level: segment.level,
                place: 0.0,
            }));
            assert_eq!(stroke.colour, colour);
            let [width, end_width] =
                [segment.width, segment.end_width].map(|width| (width / pixel).max(definition.style.min_width));
            // The corners of an outline are rounded.
            let exact = if stroke.width == stroke.end_width { 1e-5 * width } else { 0.1 };
            assert!((stroke.width - width).abs() <= exact, "{stroke:?} {width}");
            at = place(segment.to);
            if near(at, stroke.to) {
                assert!((stroke.end_width - end_width).abs() <= exact, "{stroke:?} {end_width}");
            }
        }
        assert!(near(at, stroke.to), "{stroke:?} {at:?} {}", definition.name);
    }
    assert!(segments.next().is_none());
}

#[test]
fn the_same_strokes_as_the_drawing() {
    // In a picture so large that every block is larger than a pixel.
    for n in 0..=5 {
        let mut definition = plant(n);
        if n == 0 {
            definition.axiom = "FX".into();
        }
        check_covers(&definition, 20_000.0);
    }
    for colour_by in [ColourBy::Symbol, ColourBy::Single, ColourBy::Level, ColourBy::Turn, ColourBy::Generation] {
        let mut styled = plant(4);
        styled.rules = "X -> F!'[[X]+X]+F#[+FX]-X\nF -> FF".into();
        styled.overrides = "!: width 0.3\n#: thicker".into();
        (styled.style.colour_by, styled.style.width, styled.step) = (colour_by, 0.1, 7.5);
        check_covers(&styled, 20_000.0);
        styled.style.min_width = 0.0;
        check_covers(&styled, 20_000.0);
        let mut scaled = plant(5);
        scaled.rules = "X -> F@[[X]~+X]+F~[+FX]-○X\nF -> FF".into();
        scaled.overrides = "@: length times 0.9\n~: swap turns".into();
        (scaled.right_angle, scaled.style.colour_by) = (Some(31.0), colour_by);
        check_covers(&scaled, 200_000.0);
    }
}

#[test]
fn the_gallery_is_covered() {
    let mut files = vec![];
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    for folder in std::fs::read_dir(data).unwrap().flatten() {
        files.extend(std::fs::read_dir(folder.path()).unwrap().flatten().map(|file| file.path()));
    }
    let mut checked = 0;
    for file in files {
        let mut definition = read_json(&std::fs::read_to_string(&file).unwrap()).0.unwrap();
        definition.name = file.display().to_string();
        definition.iterations = definition.iterations.min(5);
        let drawing = drawing(&definition);
        // With colours along the path no blocks can be shared, so the file is flat.
        let shares = drawing.is_memoised() && definition.style.colour_by != ColourBy::Path;
        if shares && drawing.bounds().is_some() && drawing.segment_count() < 50_000 {
            check_covers(&definition, 100_000.0);
            checked += 1;
        }
    }
    assert!(checked > 50, "{checked}");
}

#[test]
fn small_at_any_n() {
    for n in [8, 12, 40, 1000] {
        let svg = compact(&plant(n), 1024.0);
        assert!(svg.text.len() < 10_000, "n = {n}: {} bytes", svg.text.len());
        assert!(!svg.text.contains("NaN") && !svg.text.contains("inf"));
    }
    // With a style that changes with every level, a block has as many variants as levels.
    let mut styled = plant(12);
    styled.rules = "X -> F-[[X]+X]+F['!+FX]-X\nF -> FF".into();
    styled.style.width = 1.0;
    let svg = compact(&styled, 1024.0);
    assert!(svg.text.len() < 200_000, "{} bytes", svg.text.len());
}

#[test]
fn what_is_painted_is_counted_and_limited() {
    let painted = |svg: &Svg| Reader::read(&svg.text).strokes.len() as u128;
    for (n, size) in [(5, 1024.0), (7, 300.0), (9, 400.0)] {
        let svg = compact(&plant(n), size);
        assert_eq!(svg.painted, painted(&svg), "{n}");
        assert_eq!(svg.warning(), None);
    }
    // Blocks smaller than some pixels are not divided, which limits the number of strokes.
    for n in 5..=40 {
        let svg = compact(&plant(n), 1024.0);
        assert!(svg.painted <= 400_000 && svg.warning().is_none(), "{n}: {} strokes", svg.painted);
        if n == 14 {
            let reader = Reader::read(&svg.text);
            assert_eq!(svg.painted, reader.strokes.len() as u128);
            assert!(svg.painted > 100_000 && reader.uses < 100_000, "{} strokes", svg.painted);
        }
    }

    let bush = Definition { axiom: "F".into(), rules: "F -> FF-[-F+F+F]+[+F-F-F]".into(), ..plant(12) };
    let svg = compact(&bush, 1024.0);
    let warning = svg.warning().unwrap();
    assert!(svg.painted > 400_000 && !warning.is_error());
    assert!(warning.message.starts_with("This file may open slowly ("), "{warning:?}");
}

#[test]
fn what_is_under_a_pixel_is_one_stroke() {
    let mut koch = Definition { axiom: "F".into(), rules: "F -> F+F--F+F".into(), ..Definition::default() };
    (koch.angle, koch.iterations) = (60.0, 30);
    let svg = compact(&koch, 500.0);
    let strokes = Reader::read(&svg.text).strokes;
    assert!((1_000..100_000).contains(&strokes.len()), "{}", strokes.len());
    for stroke in &strokes {
        assert!(distance(stroke.from, stroke.to) <= 1.01 && stroke.width == 1.0, "{stroke:?}");
    }
}

#[test]
fn what_does_not_memoise_is_flat() {
    let mut random = plant(4);
    random.rules = "X -> F[+X]X : 1\nX -> F[-X]X : 1\nF -> FF".into();
    let drawing = drawing(&random);
    let write = |form| write_svg(&drawing, &random.style, &SvgOptions { form, ..SvgOptions::default() }).unwrap();
    assert_eq!(write(SvgForm::Compact), write(SvgForm::Flat));
}

#[test]
fn limits_and_odd_drawings() {
    let drawing = drawing(&plant(12));
    let options = SvgOptions { form: SvgForm::Compact, most: 9, ..SvgOptions::default() };
    let over = Kind::Limit { limit: LimitName::Segments, value: 9, largest: None };
    assert_eq!(write_svg(&drawing, &plant(12).style, &options).unwrap_err().kind, over);

    // An empty drawing, a point, a line of 2^1000 steps, and a thousand nested letters.
    for (axiom, rules, overrides, n) in [
        ("X", "", "", 3),
        ("F", "", "F: draw 0", 0),
        ("F", "F -> FF", "", 1000),
        ("FfFf-F", "f -> fff", "", 1000),
        ("A", "A -> F+A", "", 1000),
        ("A", "A -> F+[A]A", "", 1000),
        ("F", "F -> FFF", "F: draw 1e-9", 3),
    ] {
        let [axiom, rules, overrides] = [axiom, rules, overrides].map(String::from);
        let odd = Definition { axiom, rules, overrides, iterations: n, angle: 7.0, ..Definition::default() };
        let svg = compact(&odd, 1024.0);
        assert!(!svg.text.contains("NaN") && !svg.text.contains("inf"), "{}", svg.text);
        assert!(svg.text.len() < 200_000, "{}: {} bytes", odd.rules, svg.text.len());
    }
}
