//! Export files of drawings.

use expect_test::{Expect, expect};
use lsystem::base::LimitName;
use lsystem::drawing::{Outlook, Projection};
use lsystem::files::SvgForm;
use lsystem::syntax::{ColourBy, Kind};
use lsystem::{
    Definition, Dialect, Drawing, Limits, Plane, Progress, Solid, Style, SvgOptions, System, draw, read_json,
    write_csv, write_svg,
};
use std::path::Path;

fn drawing(definition: &Definition) -> Drawing {
    draw::<Plane>(&System::new(definition).unwrap(), definition.iterations, &Limits::default()).unwrap()
}

fn definition(axiom: &str, rules: &str) -> Definition {
    Definition { axiom: axiom.into(), rules: rules.into(), angle: 90.0, ..Definition::default() }
}

fn check_svg(definition: &Definition, options: &SvgOptions, expected: &Expect) {
    expected.assert_eq(&write_svg(&drawing(definition), &definition.style, options).unwrap().text);
}

#[test]
fn course_form() {
    let course =
        Definition { dialect: Dialect::EveryLetter, style: Style::course(), ..definition("F", "F -> F+F-F-F+F") };
    check_svg(
        &course,
        &SvgOptions { title: "Koch <&> curve\u{1}".into(), ..SvgOptions::default() },
        &expect![[r##"
            <svg xmlns="http://www.w3.org/2000/svg" width="614" height="1024" viewBox="-2 -4 3 5" role="img">
            <title>Koch &lt;&amp;&gt; curve�</title>
            <rect x="-2" y="-4" width="3" height="5" fill="#ffffff"/>
            <g fill="none" stroke-linecap="round" stroke-linejoin="round">
            <path stroke="#008000" stroke-width="0.04" d="M0 0L0 -1 -1 -1 -1 -2 0 -2 0 -3"/>
            </g>
            </svg>
        "##]],
    );
}

#[test]
fn styles_part_paths_and_moves_part_lines() {
    let mut styled = definition("F[+F'F]fF!F", "");
    styled.overrides = "!: width 2".into();
    styled.style.width = 0.5;
    check_svg(
        &styled,
        &SvgOptions { description: "Three".into(), size: 100.0, ..SvgOptions::default() },
        &expect![[r##"
            <svg xmlns="http://www.w3.org/2000/svg" width="66.7" height="100" viewBox="-3 -5 4 6" role="img">
            <desc>Three</desc>
            <rect x="-3" y="-5" width="4" height="6" fill="#fbfaf5"/>
            <g fill="none" stroke-linecap="round" stroke-linejoin="round">
            <path stroke="#1f5c3a" stroke-width="0.06" d="M0 0L0 -1 -1 -1"/>
            <path stroke="#5f8f2f" stroke-width="0.06" d="M-1 -1L-2 -1"/>
            <path fill="#1f5c3a" stroke="none" d="M0.039998 -2.9996L0.037069 -3.01503 0.028425 -3.028142 0.0154 -3.036917 0 -3.04 -0.0154 -3.036917 -0.028425 -3.028142 -0.037069 -3.01503 -0.039998 -2.9996 -0.029998 -1.9997 -0.02763 -1.988312 -0.021107 -1.978681 -0.011411 -1.972255 0 -1.97 0.011411 -1.972255 0.021107 -1.978681 0.02763 -1.988312 0.029998 -1.9997z"/>
            <path stroke="#1f5c3a" stroke-width="0.08" d="M0 -3L0 -4"/>
            </g>
            </svg>
        "##]],
    );
}

#[test]
fn nothing_and_points() {
    check_svg(
        &definition("X", ""),
        &SvgOptions::default(),
        &expect![[r##"
        <svg xmlns="http://www.w3.org/2000/svg" width="1024" height="1024" viewBox="-1 -1 2 2" role="img">
        <rect x="-1" y="-1" width="2" height="2" fill="#fbfaf5"/>
        <g fill="none" stroke-linecap="round" stroke-linejoin="round">
        </g>
        </svg>
    "##]],
    );
    let mut point = definition("F", "");
    point.overrides = "F: draw 0".into();
    point.start = [5.0, 5.0];
    check_svg(
        &point,
        &SvgOptions::default(),
        &expect![[r##"
        <svg xmlns="http://www.w3.org/2000/svg" width="1024" height="1024" viewBox="4 -6 2 2" role="img">
        <rect x="4" y="-6" width="2" height="2" fill="#fbfaf5"/>
        <g fill="none" stroke-linecap="round" stroke-linejoin="round">
        <path stroke="#1f5c3a" stroke-width="0.001953125" d="M5 -5L5 -5"/>
        </g>
        </svg>
    "##]],
    );
}

/// Reads the paths of an SVG back: from, to (y up), stroke colour.
fn read_paths(svg: &str) -> Vec<([f64; 2], [f64; 2], String)> {
    let mut segments = vec![];
    for path in svg.split("<path stroke=\"").skip(1) {
        let colour = path[..7].to_owned();
        let data = path.split(" d=\"").nth(1).unwrap().split('"').next().unwrap();
        for line in data.split('M').skip(1) {
            let numbers: Vec<f64> = line.split([' ', 'L']).map(|number| number.parse().unwrap()).collect();
            let points: Vec<[f64; 2]> = numbers.chunks(2).map(|p| [p[0], -p[1]]).collect();
            segments.extend(points.windows(2).map(|pair| (pair[0], pair[1], colour.clone())));
        }
    }
    segments
}

#[test]
fn paths_read_back() {
    for colour_by in [ColourBy::Symbol, ColourBy::Single, ColourBy::Level] {
        let mut plant = definition("X", "X -> F'+[[X]-X]-F[-FX]+X\nF -> FF");
        (plant.angle, plant.iterations, plant.step, plant.style.colour_by) = (25.7, 6, 0.013, colour_by);
        let drawing = drawing(&plant);
        let svg = write_svg(&drawing, &plant.style, &SvgOptions::default()).unwrap().text;
        let read = read_paths(&svg);
        let [x0, y0, x1, y1] = drawing.bounds().unwrap();
        let tolerance = 1e-6 * (x1 - x0).max(y1 - y0);
        assert_eq!(read.len() as u128, drawing.segment_count());
        for ((from, to, colour), segment) in read.iter().zip(drawing.segments()) {
            for (a, b) in from.iter().chain(to).zip(segment.from.iter().chain(&segment.to)) {
                assert!((a - b).abs() <= tolerance, "{from:?} {to:?} {segment:?}");
            }
            let entry = match colour_by {
                ColourBy::Symbol => segment.colour as usize,
                ColourBy::Single => 0,
                _ => segment.level as usize,
            };
            assert_eq!(*colour, String::from(plant.style.palette[entry % plant.style.palette.len()]));
        }
    }
}

#[test]
fn long_paths_are_parted() {
    let mut koch = definition("F", "F -> F+F-F-F+F");
    koch.iterations = 6;
    let svg = write_svg(&drawing(&koch), &koch.style, &SvgOptions::default()).unwrap().text;
    assert_eq!(svg.matches("<path").count(), 2);
    assert_eq!(read_paths(&svg).len(), 15_625);
}

#[test]
fn csv_is_exact() {
    let mut fork = definition("F[+'F]-F", "");
    (fork.angle, fork.step, fork.start) = (30.0, 0.1, [1e-9, -2e8]);
    let text = write_csv(&drawing(&fork), 3).unwrap();
    expect![[r#"
        x0,y0,x1,y1,level,colour
        1e-9,-200000000,1e-9,-199999999.9,0,0
        1e-9,-199999999.9,-0.049999999,-199999999.81339747,1,1
        1e-9,-199999999.9,0.050000001,-199999999.81339747,0,0
    "#]]
    .assert_eq(&text);

    let mut plant = definition("X", "X -> F'+[[X]-X]-F[-FX]+X\nF -> FF");
    (plant.angle, plant.iterations) = (25.7, 4);
    let drawing = drawing(&plant);
    let text = write_csv(&drawing, 1_000_000).unwrap();
    assert_eq!(text.lines().count() as u128, 1 + drawing.segment_count());
    for (line, segment) in text.lines().skip(1).zip(drawing.segments()) {
        let fields: Vec<f64> = line.split(',').map(|field| field.parse().unwrap()).collect();
        let [x0, y0] = segment.from;
        let [x1, y1] = segment.to;
        assert_eq!(fields, [x0, y0, x1, y1, f64::from(segment.level), f64::from(segment.colour)]);
    }
}

#[test]
fn limits() {
    let mut koch = definition("F", "F -> F+F-F-F+F");
    koch.iterations = 500;
    let drawing = drawing(&koch);
    let over = Kind::Limit { limit: LimitName::Segments, value: 9, largest: None };
    assert_eq!(write_csv(&drawing, 9).unwrap_err().kind, over);
    let options = SvgOptions { most: 9, ..SvgOptions::default() };
    assert_eq!(write_svg(&drawing, &koch.style, &options).unwrap_err().kind, over);
}

#[test]
fn beyond_floating_point() {
    let mut far = definition("FfFf-F", "f -> fff");
    far.iterations = 1000;
    let drawing = drawing(&far);
    assert_eq!(write_csv(&drawing, 9).unwrap().lines().count(), 4);
    let svg = write_svg(&drawing, &far.style, &SvgOptions::default()).unwrap().text;
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
}

/// Compact pictures with many copies, some of which are planned more than once, report it; a picture that is too large
/// is refused.
#[test]
fn compact_files_of_deep_drawings() {
    let bush = Definition { angle: 25.0, ..definition("F", "F -> FF-[-F+F+F]+[+F-F-F]") };
    let drawing = drawing(&Definition { iterations: 12, ..bush.clone() });
    let options = SvgOptions { form: SvgForm::Compact, ..SvgOptions::default() };
    let whole = write_svg(&drawing, &bush.style, &options).unwrap();
    assert!(whole.painted > 400_000 && whole.warning().is_some());
    let few = SvgOptions { most: 9, ..options };
    let over = Kind::Limit { limit: LimitName::Segments, value: 9, largest: None };
    assert_eq!(write_svg(&drawing, &bush.style, &few).unwrap_err().kind, over);
}

/// Files of projections that are made in the smallest steps; and how many files have shared blocks.
#[test]
fn files_of_all_systems() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let folders = std::fs::read_dir(data).unwrap().flatten();
    let files = folders.flat_map(|folder| std::fs::read_dir(folder.path()).unwrap().flatten());
    let (mut compact, mut solid) = (0, 0);
    for file in files {
        let name = file.path().display().to_string();
        let definition = read_json(&std::fs::read_to_string(file.path()).unwrap()).0.unwrap();
        let (system, style) = (System::new(&definition).unwrap(), &definition.style);
        let n = definition.iterations.min(4);
        let drawing = draw::<Plane>(&system, n, &Limits::default()).unwrap();
        for form in [SvgForm::Flat, SvgForm::Compact] {
            let svg = write_svg(&drawing, style, &SvgOptions { form, ..SvgOptions::default() }).unwrap();
            assert!(svg.text.ends_with("</g>\n</svg>\n"), "{name}");
            compact += u32::from(svg.text.contains("<use"));
        }
        if system.is_solid() {
            let drawing = draw::<Solid>(&system, n, &Limits::default()).unwrap();
            let outlook = Outlook::default();
            let whole = drawing.seen_from(&outlook, u64::MAX).unwrap();
            let mut projection = Projection::new(&drawing, &outlook, u64::MAX).unwrap();
            while projection.step(&drawing, 1) == Progress::More {}
            let seen = projection.finish(&drawing);
            assert_eq!((seen.bounds(), &seen.places), (whole.bounds(), &whole.places), "{name}");
            let options = SvgOptions::default();
            assert_eq!(
                write_svg(&seen, style, &options).unwrap(),
                write_svg(&whole, style, &options).unwrap(),
                "{name}"
            );
            solid += u32::from(seen.segment_count() > 0);
        }
    }
    assert!(compact > 20 && solid > 5, "{compact} {solid}");
}
