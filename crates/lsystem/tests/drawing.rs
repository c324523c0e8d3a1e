//! Drawings in the plane, compared with the naive reference.

use crate::naive;
use crate::naive::systems::{Features, wind};
use lsystem::base::LimitName;
use lsystem::derive::Rules;
use lsystem::drawing::{Segment, Turtle, Wind};
use lsystem::render::{Pick, Pointer, Target, fitted_ends, fitted_outline, fitted_scale};
use lsystem::syntax::{Action, Grammar, Heading, Kind, Module, Production};
use lsystem::{
    Definition, Diagnostic, Dialect, Drawer, Drawing, Figure, Limits, Plane, Progress, SegmentArrays, Style, System,
    Vantage, View, Viewport, draw, fit, pick,
};
use proptest::prelude::*;
use std::sync::Arc;

fn modules(text: &str) -> Vec<Module> {
    text.chars().map(Module::from).collect()
}

/// A system of productions `predecessor -> successor : weight`. A weight above 1 stands for no weight.
fn system(axiom: &str, rules: &[(char, &str, f64)], angle: f64) -> System {
    let production = |&(predecessor, successor, weight): &(char, &str, f64)| {
        let production = Production::new(predecessor, modules(successor));
        if weight <= 1.0 { production.weighted(weight) } else { production }
    };
    let grammar =
        Grammar { axiom: modules(axiom), productions: rules.iter().map(production).collect(), ..Grammar::default() };
    let rules = Arc::new(Rules::new(&grammar, vec![], |_| false, false).expect("weights are numbers"));
    let actions = rules.letters.iter().map(|letter| match letter.symbol {
        'L' => vec![Action::Draw(Some(0.25)), Action::TurnLeft(Some(17.3))],
        'P' => vec![Action::Push, Action::Draw(None), Action::Pop],
        'M' => vec![Action::Move(Some(-1.5)), Action::SetColour(3)],
        'Z' => vec![Action::Draw(Some(0.0)), Action::SetWidth(2.5)],
        symbol => Dialect::Abop.actions(symbol).to_vec(),
    });
    let turtle = Turtle {
        actions: actions.collect(),
        left: Heading::from_degrees(angle),
        right: Heading::from_degrees(angle),
        start: [3.0, -4.0],
        step: 0.7,
        width: 0.5,
        tapers: true,
        max_width: 0.03,
        ..Turtle::default()
    };
    System { grammar, rules, turtle, style: Style::default(), seed: 7, warnings: vec![] }
}

/// A system of productions without weights.
fn plain(axiom: &str, rules: &[(char, &str)], angle: f64) -> System {
    let rules: Vec<_> = rules.iter().map(|&(p, s)| (p, s, f64::INFINITY)).collect();
    system(axiom, &rules, angle)
}

fn drawn(system: &System, n: u32) -> Drawing {
    draw::<Plane>(system, n, &Limits::default()).unwrap()
}

fn near(a: [f64; 2], b: [f64; 2], tolerance: f64) -> bool {
    (a[0] - b[0]).abs() <= tolerance && (a[1] - b[1]).abs() <= tolerance
}

/// Checks that the drawing equals that of the naive turtle, to 1e-9 of the extent.
fn check(system: &System, n: u32) -> Result<Drawing, TestCaseError> {
    let drawing = draw::<Plane>(system, n, &Limits::default()).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let expected = naive::limited_segments(system, n, drawing.bounds());
    prop_assert_eq!(drawing.segment_count(), expected.len() as u128);
    if let Some(symbols) = drawing.symbol_count() {
        let word = naive::modules(&system.grammar, system.seed, n).unwrap();
        prop_assert_eq!(symbols, word.len() as u64);
    }
    prop_assert!(drawing.symbol_count().is_some() || drawing.is_memoised());
    prop_assert_eq!(drawing.segments().size_hint(), (expected.len(), Some(expected.len())));
    let bounds = naive::bounds(&expected);
    prop_assert_eq!(drawing.bounds().is_some(), bounds.is_some());
    let Some(bounds) = bounds else { return Ok(drawing) };
    // Coordinates include the start, which adds a rounding error.
    let tolerance = 1e-9 * (bounds[2] - bounds[0]).max(bounds[3] - bounds[1]) + 1e-13;
    for (side, expected) in drawing.bounds().unwrap().into_iter().zip(bounds) {
        prop_assert!((side - expected).abs() <= tolerance, "{:?} {:?}", drawing.bounds(), bounds);
    }
    let segments: Vec<Segment> = drawing.segments().collect();
    prop_assert_eq!(segments.len(), expected.len());
    for (index, (a, b)) in segments.iter().zip(&expected).enumerate() {
        prop_assert!(near(a.from, b.from, tolerance) && near(a.to, b.to, tolerance), "{}: {:?} {:?}", index, a, b);
        prop_assert_eq!((a.colour, a.level), (b.colour, b.level), "{}", index);
        prop_assert!((a.width - b.width).abs() <= 1e-9 * b.width, "{}: {:?} {:?}", index, a, b);
        prop_assert!((a.end_width - b.end_width).abs() <= 1e-9 * b.end_width, "{}: {:?} {:?}", index, a, b);
    }
    check_arrays(&drawing, &segments)?;
    check_places(&drawing, &segments)?;
    Ok(drawing)
}

/// Checks that reading from any segment on, and picking, agree with reading from the start.
fn check_places(drawing: &Drawing, segments: &[Segment]) -> Result<(), TestCaseError> {
    for start in [0, 1, segments.len() / 3, segments.len() - 1, segments.len(), segments.len() + 9] {
        let from: Vec<Segment> = drawing.segments_from(start as u128).take(3).collect();
        let expected: Vec<Segment> = segments.iter().skip(start).take(3).copied().collect();
        prop_assert_eq!(&from, &expected, "from {}", start);
        let heading = drawing.heading_at(start as u128);
        prop_assert_eq!(heading.is_some(), !expected.is_empty());
        if let (Some(heading), Some(segment)) = (heading, expected.first()) {
            let (c, s) = Heading::from_degrees(heading).cos_sin();
            let along = [0, 1].map(|axis| segment.to[axis] - segment.from[axis]);
            let length = distance(segment.from, &Segment { from: segment.to, ..*segment });
            // A negative step length draws backwards.
            let ahead = [c * length, s * length];
            let slack = 1e-9 * (length + along[0].abs().max(along[1].abs()).max(1.0));
            prop_assert!(near(along, ahead, slack) || near(along, ahead.map(|v| -v), slack));
        }
    }
    let shown = fit(drawing);
    // With a negative step, width and height are negative.
    let side = if shown.width.abs() > shown.height.abs() { shown.width } else { shown.height };
    if !side.is_normal() {
        return Ok(());
    }
    let extent = side.abs();
    // Coordinates include the start here, too.
    let tolerance = 1e-9 * extent + 1e-13;
    let centre = [shown.x + shown.width / 2.0, shown.y + shown.height / 2.0];
    let figure = Figure::Plane(Arc::new(drawing.clone()));
    let model = |place: Vec<f64>| [0, 1].map(|i| centre[i] + side * (place[i] + place[i + 2]));
    for number in [0, segments.len() / 3, segments.len() - 1] {
        let [from, to] = fitted_ends(&figure, number as u128).unwrap().map(model);
        prop_assert!(near(from, segments[number].from, tolerance) && near(to, segments[number].to, tolerance));
    }
    prop_assert_eq!(fitted_ends(&figure, segments.len() as u128), None);
    for (first, last) in [(0, segments.len()), (segments.len() / 3, segments.len() * 2 / 3), (0, 1), (1, 1)] {
        let ends: Vec<[f64; 2]> = segments[first..last.max(first)].iter().flat_map(|s| [s.from, s.to]).collect();
        let outline: Vec<[f64; 2]> =
            fitted_outline(&figure, first as u128..last as u128).into_iter().map(model).collect();
        prop_assert_eq!(outline.is_empty(), ends.is_empty());
        // The outline is convex and contains all ends. It is within the box around them, unless its hull has very many
        // corners.
        for (corner, &from) in outline.iter().enumerate().filter(|_| outline.len() > 2) {
            let to = outline[(corner + 1) % outline.len()];
            let length = distance(from, &Segment { from: to, to, ..segments[0] });
            // Corners that differ only by rounding have no side between them.
            if length <= tolerance {
                continue;
            }
            let side = |p: [f64; 2]| (to[0] - from[0]) * (p[1] - from[1]) - (to[1] - from[1]) * (p[0] - from[0]);
            prop_assert!(ends.iter().all(|&end| side(end) >= -tolerance * length));
        }
        for axis in 0..2 {
            let least = |points: &[[f64; 2]]| points.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
            let most = |points: &[[f64; 2]]| points.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
            if !ends.is_empty() {
                let room = tolerance + if ends.len() > 64 { 0.01 * extent } else { 0.0 };
                prop_assert!((-tolerance..=room).contains(&(least(&ends) - least(&outline))));
                prop_assert!((-tolerance..=room).contains(&(most(&outline) - most(&ends))));
            }
        }
    }
    let viewport = Viewport { width: 1000, height: 800, ratio: 1.0 };
    let fitted = fitted_scale(&figure, viewport, &Vantage::default());
    // With very wide strokes, all axes may lie within a tiny part of a pixel, where a pointer cannot separate them.
    if fitted < 1e-3 {
        return Ok(());
    }
    // One model unit in device pixels.
    let scale = fitted / extent;
    let number = |pick: Pick| match pick.target {
        Target::Segment(number) => number as usize,
        Target::Polygon(_) => usize::MAX,
    };
    for k in 0..4 {
        let segment = &segments[k * (segments.len() - 1) / 3];
        let middle = [0, 1].map(|axis| (segment.from[axis] + segment.to[axis]) / 2.0);
        let point = [middle[0] + 0.02 * k as f64 * extent, middle[1]];
        let tolerance = 0.05 * fitted;
        let distances: Vec<f64> =
            segments.iter().map(|s| scale * (distance(point, s) - width_beside(point, s) / 2.0).max(0.0)).collect();
        let slack = 1e-9 * fitted;
        for upto in [None, Some(segments.len() / 2)] {
            let pointer = Pointer {
                at: [500.0 + fitted / side * (point[0] - centre[0]), 400.0 - fitted / side * (point[1] - centre[1])],
                tolerance,
                upto: upto.map(|upto| upto as u128),
                visits: usize::MAX,
            };
            let there = &distances[..upto.unwrap_or(distances.len())];
            let nearest = there.iter().copied().fold(f64::INFINITY, f64::min);
            match pick(&figure, viewport, &Vantage::default(), &pointer) {
                None => prop_assert!(nearest >= tolerance * 31.0 / 32.0 - slack),
                Some(pick) => {
                    prop_assert!((there[number(pick)] - pick.distance).abs() <= slack);
                    prop_assert!(pick.distance <= tolerance);
                    prop_assert!(pick.distance <= (tolerance / 4.0).max(nearest + tolerance / 16.0) + slack);
                }
            }
            let hurried = pick(&figure, viewport, &Vantage::default(), &Pointer { visits: 3, ..pointer });
            prop_assert!(hurried.is_none_or(|pick| (there[number(pick)] - pick.distance).abs() <= slack));
        }
    }
    Ok(())
}

fn distance(point: [f64; 2], segment: &Segment) -> f64 {
    let t = nearest(point, segment);
    let away = [0, 1].map(|axis| point[axis] - segment.from[axis] - t * (segment.to[axis] - segment.from[axis]));
    libm::hypot(away[0], away[1])
}

/// The place of a segment's nearest point, from 0 to 1.
fn nearest(point: [f64; 2], segment: &Segment) -> f64 {
    let along = [0, 1].map(|axis| segment.to[axis] - segment.from[axis]);
    let away = [0, 1].map(|axis| point[axis] - segment.from[axis]);
    let length = libm::hypot(along[0], along[1]);
    let t = if length > 0.0 { (along[0] * away[0] + along[1] * away[1]) / (length * length) } else { 0.0 };
    t.clamp(0.0, 1.0)
}

/// The width of a segment at its nearest point.
fn width_beside(point: [f64; 2], segment: &Segment) -> f64 {
    segment.width + nearest(point, segment) * (segment.end_width - segment.width)
}

/// Checks that the arrays, whole and in chunks, have the same segments, to 1e-6 of the extent.
fn check_arrays(drawing: &Drawing, segments: &[Segment]) -> Result<(), TestCaseError> {
    let mut arrays = SegmentArrays { ends: vec![1.0; 6], colours: vec![2; 9], levels: vec![3] };
    prop_assert!(drawing.write_segments(segments.len() as u64, &mut arrays).is_ok());
    prop_assert_eq!(
        [arrays.ends.len(), arrays.colours.len(), arrays.levels.len()],
        [4 * segments.len(), segments.len(), segments.len()]
    );
    let [x0, y0, x1, y1] = drawing.bounds().unwrap();
    // The start is away from the origin, which costs precision in `f32`.
    let tolerance = 1e-6 * (x1 - x0).max(y1 - y0).max(x0.abs()).max(y1.abs());
    for (index, (ends, segment)) in arrays.ends.chunks(4).zip(segments).enumerate() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| f64::from(ends[i]));
        prop_assert!(near([a, b], segment.from, tolerance) && near([c, d], segment.to, tolerance), "{}", index);
        prop_assert_eq!((arrays.colours[index], u32::from(arrays.levels[index])), (segment.colour, segment.level));
    }
    let mut chunks = SegmentArrays::default();
    drawing.for_each_chunk(|chunk| {
        chunks.ends.extend(chunk.ends);
        chunks.colours.extend(chunk.colours);
        chunks.levels.extend(chunk.levels);
    });
    prop_assert!(chunks == arrays);
    if !segments.is_empty() {
        prop_assert!(drawing.write_segments(segments.len() as u64 - 1, &mut arrays).is_err());
        prop_assert_eq!(arrays, SegmentArrays::default());
    }
    Ok(())
}

const KOCH: [(char, &str); 1] = [('F', "F+F-F-F+F")];
const PLANT: [(char, &str); 2] = [('X', "F+[[X]-X]-F[-FX]+X"), ('F', "FF")];
const DRAGON: [(char, &str); 2] = [('X', "X+YF+"), ('Y', "-FX-Y")];
const SIERPINSKI: [(char, &str); 2] = [('F', "F-G+F+G-F"), ('G', "GG")];

#[test]
fn known_curves() {
    for (axiom, rules, angle, n, blocks) in [
        ("F", &KOCH[..], 90.0, 5, 6),
        ("X", &PLANT[..], 25.7, 5, 11),
        ("FX", &DRAGON[..], 90.0, 12, 25),
        ("F-G-G", &SIERPINSKI[..], 120.0, 7, 15),
    ] {
        let system = plain(axiom, rules, angle);
        let drawing = check(&system, n).unwrap();
        assert!(drawing.is_memoised());
        assert!(drawing.block_count() <= blocks, "{}", drawing.block_count());
    }
}

#[test]
fn pieces_say_how_they_leave_the_turtle() {
    // Half of a dragon turns by a right angle in every step. X alone draws nothing in one step.
    let system = plain("FX", &DRAGON, 90.0);
    let drawing = drawn(&system, 8);
    let id = |symbol| system.rules.letter(symbol, 0).unwrap();
    let piece = drawing.piece(id('X'), 1).unwrap();
    let block = drawing.piece(id('Y'), 1).unwrap().block;
    assert!(piece.block.is_some() && block.is_some() && piece.block != block);
    // X+YF+ ends one step to the left, with the opposite heading.
    assert_eq!(piece.effect.heading, Heading::HALF);
    let [x, y] = piece.effect.at.map(|c| libm::scalbn(c, piece.effect.exponent));
    assert_eq!((x, y), (0.0, 1.0));
    assert!(drawing.piece(id('F'), 1).is_none() && drawing.piece(id('X'), 0).is_none());
    assert!(drawing.piece(id('X'), 9).is_none());
}

#[test]
fn large_drawings_stay_exact() {
    for (axiom, rules, angle, n) in [
        ("F", &KOCH[..], 90.0, 8),
        ("X", &PLANT[..], 22.5, 8),
        ("FX", &DRAGON[..], 90.0, 18),
        ("F-G-G", &SIERPINSKI[..], 120.0, 11),
        // More headings than the number of rotated copies in the cache.
        ("A", &[('A', "F[+F'A]+A")][..], 7.3, 14),
    ] {
        check(&plain(axiom, rules, angle), n).unwrap();
    }
}

#[test]
fn any_segment_of_a_drawing_without_end() {
    let drawing = drawn(&plain("F", &KOCH, 90.0), 50);
    let count = drawing.segment_count();
    assert_eq!(count, 5_u128.pow(50));
    // The curve ends 3^50 steps along its first axis, as it would without its bumps.
    let last: Vec<Segment> = drawing.segments_from(count - 2).collect();
    assert_eq!(last.len(), 2);
    let [x0, y0, x1, y1] = drawing.bounds().unwrap();
    let extent = (x1 - x0).max(y1 - y0);
    let end = 0.7 * 717_897_987_691_852_588_770_249.0; // steps of 0.7, 3^50 of them
    assert!(near(last[1].to, [0.0, end], 1e-9 * extent) || near(last[1].to, [end, 0.0], 1e-9 * extent), "{last:?}");
    let viewport = Viewport { width: 200, height: 100, ratio: 1.0 };
    let figure = Figure::Plane(Arc::new(drawing));
    let [_, end] = fitted_ends(&figure, count - 1).unwrap();
    let view = View { x: end[0], y: end[1], zoom: 1e25, fine: [end[2], end[3]] };
    let pointer = Pointer { at: [100.0, 50.0], tolerance: 1e-6, upto: None, visits: 10_000 };
    assert_eq!(pick(&figure, viewport, &view.into(), &pointer).unwrap().target, Target::Segment(count - 1));
}

#[test]
fn a_thousand_iterations() {
    for (axiom, rules, angle) in
        [("F", &KOCH[..], 90.0), ("X", &PLANT[..], 25.7), ("FX", &DRAGON[..], 90.0), ("F-G-G", &SIERPINSKI[..], 120.0)]
    {
        let drawing = drawn(&plain(axiom, rules, angle), 1000);
        assert_eq!(drawing.segment_count(), u128::MAX);
        assert!(drawing.bounds().unwrap().iter().all(|b| !b.is_nan()));
        for segment in drawing.segments().take(1000) {
            assert!(segment.from.iter().chain(&segment.to).all(|c| c.is_finite()));
        }
    }
}

fn failure(system: &System, n: u32, limits: Limits) -> Kind {
    let diagnostic: Diagnostic = draw::<Plane>(system, n, &limits).unwrap_err();
    diagnostic.kind
}

#[test]
fn limits_name_themselves_and_the_largest_n() {
    let limits = Limits { segments: 1000, work: 100_000, ..Limits::default() };
    let unbalanced = plain("F", &[('F', "FF[")], 30.0);
    let random = system("F", &[('F', "FF", 0.5), ('F', "F+F", 0.5)], 30.0);
    let idle = system("A", &[('A', "AA", 0.5), ('A', "A+A", 0.5)], 30.0);
    let branches = plain("A", &[('A', "[A")], 30.0);
    let segments = |largest| Kind::Limit { limit: LimitName::Segments, value: 1000, largest };
    assert_eq!(failure(&unbalanced, 1000, limits), segments(Some(9)));
    assert_eq!(failure(&random, 1000, limits), segments(Some(9)));
    assert!(draw::<Plane>(&random, 9, &limits).is_ok());
    let work = |value, largest| Kind::Limit { limit: LimitName::Work, value, largest };
    assert!(matches!(failure(&idle, 1000, limits), Kind::Limit { limit: LimitName::Work, largest: Some(13..16), .. }));
    assert_eq!(failure(&branches, 1000, Limits { work: 3400, ..limits }), work(3400, Some(99)));
    assert_eq!(
        failure(&plain("F", &KOCH, 90.0), 1001, limits),
        Kind::Limit { limit: LimitName::Iterations, value: 1000, largest: Some(1000) }
    );
    assert_eq!(failure(&plain("F", &KOCH, 90.0), 500, limits), segments(Some(111)));
    assert!(draw::<Plane>(&plain("F", &KOCH, 90.0), 111, &limits).is_ok());
}

#[test]
fn small_steps_lead_to_the_same_drawing() {
    let random = system("X", &[('X', "F[+X]F", 0.5), ('X', "F[-X]X", 0.5), ('F', "FF", 2.0)], 25.7);
    let unbalanced = plain("F", &[('F', "F]F[+F")], 33.3);
    for (system, n) in [(plain("X", &PLANT, 25.7), 30), (random, 8), (unbalanced, 8), (plain("", &[], 1.0), 0)] {
        let mut drawer = Drawer::<Plane>::new(&system, n, Limits::default());
        let mut steps = 0;
        while drawer.step(1) == Progress::More {
            steps += 1;
        }
        assert!(steps > 100 || n == 0);
        assert_eq!(drawer.step(1), Progress::Done);
        let (slow, fast) = (drawer.finish().unwrap(), drawn(&system, n));
        assert_eq!((slow.segment_count(), slow.block_count()), (fast.segment_count(), fast.block_count()));
        assert!(slow.segments().take(10_000).eq(fast.segments().take(10_000)));
    }
    let failing = Drawer::<Plane>::new(&plain("F", &[('F', "F]F")], 1.0), 1000, Limits::default());
    assert!(failing.clone().finish().is_err());
    let mut failing = failing;
    while failing.step(1) == Progress::More {}
    assert!(failing.finish().is_err());
}

#[test]
fn odd_drawings() {
    let empty = drawn(&plain("X", &[('X', "XX")], 90.0), 20);
    assert_eq!((empty.bounds(), empty.segment_count(), empty.segments().count()), (None, 0, 0));
    assert_eq!(drawn(&plain("", &[], 90.0), 3).bounds(), None);
    for (axiom, rules, angle, n) in [
        ("]]F]+F[[F", vec![], 45.0, 0),
        ("]F[+F]]F", vec![('F', "F[+F]F")], 33.3, 4),
        ("F", vec![('F', "F]F[+F")], 33.3, 5),
        ("[F", vec![('[', "[["), ('F', "F]F")], 33.3, 5),
        ("Z", vec![('Z', "Z+Z")], 10.0, 4),
        ("F", vec![('F', "FF")], 0.0, 6),
        ("MF", vec![('M', "MM!")], 60.0, 6),
        ("FL", vec![('L', "LF")], 137.5, 8),
        ("F", vec![('F', "")], 1.0, 2),
        ("F-F-F-F", vec![], 90.0, 7),
        ("PX", vec![('P', "+PP'"), ('X', "P[X]")], 20.0, 5),
    ] {
        check(&plain(axiom, &rules, angle), n).unwrap_or_else(|e| panic!("{axiom} {rules:?}: {e}"));
    }
}

#[test]
fn a_system_without_a_step_length() {
    let mut system = plain("FLL", &[('L', "LF")], 20.0);
    system.turtle.step = 0.0;
    check(&system, 4).unwrap();
    system.turtle.step = -2.0;
    check(&system, 4).unwrap();
}

/// The system with a sway.
fn in_wind(mut system: System, wind: [f64; 2]) -> System {
    system.turtle.wind = Wind::new(wind);
    system
}

/// A word with balanced branches.
fn balanced() -> impl Strategy<Value = String> {
    let letter = "[FGXYLPMZfg+|!#',;-]{0,4}";
    letter.prop_recursive(3, 12, 3, |inner| {
        (inner.clone(), inner.clone(), inner).prop_map(|(a, b, c)| format!("{a}[{b}]{c}"))
    })
}

fn unbalanced() -> impl Strategy<Value = String> {
    r"[FGXYLPMZf+|!'\[\]-]{0,7}".prop_map(|text| text)
}

fn angle() -> impl Strategy<Value = f64> {
    prop_oneof![Just(90.0), Just(60.0), Just(25.7), Just(0.0), -360.0..360.0]
}

/// The most iterations for which the naive reference is fast.
fn affordable(system: &System, most: u32) -> u32 {
    (0..=most)
        .take_while(|&n| naive::modules(&system.grammar, system.seed, n).is_some_and(|word| word.len() < 3000))
        .last()
        .unwrap_or(0)
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn balanced_systems_memoise(axiom in balanced(), rules in prop::collection::vec((r"[FGXYLMZ+]", balanced()), 0..4),
                                angle in angle(), wind in wind(), n in 0_u32..9) {
        let rules: Vec<_> = rules.iter().map(|(p, s)| (p.chars().next().unwrap(), s.as_str())).collect();
        let system = in_wind(plain(&axiom, &rules, angle), wind);
        let drawing = check(&system, affordable(&system, n))?;
        prop_assert!(drawing.is_memoised());
    }

    #[test]
    fn unbalanced_systems_materialise(axiom in unbalanced(), angle in angle(), wind in wind(), n in 0_u32..9,
                                      rules in prop::collection::vec((r"[FXY+\[\]]", unbalanced()), 0..4)) {
        let rules: Vec<_> = rules.iter().map(|(p, s)| (p.chars().next().unwrap(), s.as_str())).collect();
        let system = in_wind(plain(&axiom, &rules, angle), wind);
        check(&system, affordable(&system, n))?;
    }

    #[test]
    fn random_systems_materialise(axiom in balanced(), angle in angle(), wind in wind(), n in 0_u32..9, seed: u32,
                                  rules in prop::collection::vec((r"[FGX]", unbalanced(), 0.01..1.0), 1..6)) {
        let rules: Vec<_> = rules.iter().map(|(p, s, w)| (p.chars().next().unwrap(), s.as_str(), *w)).collect();
        let mut system = in_wind(system(&axiom, &rules, angle), wind);
        system.seed = seed;
        check(&system, affordable(&system, n))?;
    }

    #[test]
    fn contexts_parameters_and_images_are_drawn(
        system in naive::systems::system(Features { contexts: true, parameters: true, weights: true, images: true, cuts: true }),
        wind in wind(),
        n in 0_u32..5,
    ) {
        let system = in_wind(system, wind);
        let word = |n: u32| naive::modules(&system.grammar, system.seed, n);
        let finite = |n: u32| word(n).is_some_and(|word| naive::images(&system.grammar, system.seed, &word).is_some());
        match (0..=n).find(|&n| !finite(n)) {
            Some(wrong) if word(wrong).is_none() => {
                let kind = draw::<Plane>(&system, wrong, &Limits::default()).map(|_| ()).unwrap_err().kind;
                prop_assert!(matches!(kind, Kind::NotFinite), "{:?}", kind);
            }
            Some(_) => {}
            None => drop(check(&system, affordable(&system, n))?),
        }
    }

    #[test]
    fn plain_images_memoise(
        system in naive::systems::system(Features { images: true, ..Features::default() }),
        wind in wind(),
        n in 0_u32..5,
    ) {
        let system = in_wind(system, wind);
        prop_assert!(system.rules.is_plain());
        check(&system, affordable(&system, n))?;
    }
}

#[test]
fn what_only_rounding_tells_apart_is_found() {
    check(&plain("+P", &[('+', "-L")], 60.0), 1).unwrap();
    check(&system("[-F[]Z]", &[('F', "MZ", 0.01)], 60.0), 1).unwrap();
}

#[test]
fn no_step_takes_long() {
    let steps = |rules: &str, limits: Limits| {
        let definition = Definition { axiom: "F".repeat(1000), rules: rules.into(), ..Definition::default() };
        let system = System::new(&definition);
        let mut drawer = Drawer::<Plane>::new(&system.unwrap(), 12, limits);
        let steps = (0..).take_while(|_| drawer.step(1000) == Progress::More).count();
        (drawer.finish().is_err(), steps)
    };
    // After a limit is exceeded, a second derivation finds the largest n: 127,000 modules twice.
    let limits = Limits { segments: 100_000, modules: 128_000, ..Limits::default() };
    let (failed, beyond) = steps("F < F -> FF", limits);
    assert!(failed && (300..1000).contains(&beyond), "{beyond}");
    // Testing productions that do not apply is work, too.
    let limits = Limits { work: 10_000_000, ..Limits::default() };
    let (failed, many) = steps(&"FG < F -> FF\n".repeat(1000), limits);
    assert!(failed && many > 200, "{failed} {many}");
}
