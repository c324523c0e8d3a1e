//! Drawings in space, compared with the naive turtle, and the meaning of symbols in space.

use crate::naive;
use crate::naive::systems::wind;
use lsystem::base::LimitName;
use lsystem::drawing::{Mark, Outlook, Segment};
use lsystem::syntax::{Action, Kind};
use lsystem::{Definition, Dialect, Drawing, Limits, Plane, Solid, System, draw};
use proptest::prelude::*;

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|diagnostics| panic!("{definition:?}: {diagnostics:?}"))
}

fn abop(axiom: &str, rules: &str, angle: f64) -> Definition {
    Definition { axiom: axiom.into(), rules: rules.into(), angle, ..Definition::default() }
}

fn bounds(segments: &[Segment<Solid>], filled: &[[f64; 3]]) -> Option<[[f64; 3]; 2]> {
    let mut ends = segments.iter().flat_map(|s| [s.from, s.to]).chain(filled.iter().copied());
    let first = ends.next()?;
    Some(ends.fold([first, first], |[low, high], end| {
        [[0, 1, 2].map(|i| low[i].min(end[i])), [0, 1, 2].map(|i| high[i].max(end[i]))]
    }))
}

/// Checks that the drawing equals that of the naive turtle, to 1e-9 of the extent.
fn check(system: &System, n: u32) -> Result<Drawing<Solid>, TestCaseError> {
    let drawing = draw::<Solid>(system, n, &Limits::default()).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let expected = naive::solid_segments(system, n);
    prop_assert_eq!(drawing.segment_count(), expected.len() as u128);
    prop_assert!(drawing.symbol_count().is_some() || drawing.is_memoised());
    let filled: Vec<[f64; 3]> = naive::solid_polygons(system, n).into_iter().flat_map(|polygon| polygon.0).collect();
    let bounds = bounds(&expected, &filled);
    prop_assert_eq!(drawing.bounds().is_some(), bounds.is_some());
    let Some([low, high]) = bounds else { return Ok(drawing) };
    let extent = (0..3).map(|i| high[i] - low[i]).fold(0.0, f64::max);
    let tolerance = 1e-9 * extent + 1e-12;
    let [own_low, own_high] = drawing.bounds().unwrap();
    for i in 0..3 {
        prop_assert!((own_low[i] - low[i]).abs() <= tolerance, "{:?} {:?}", drawing.bounds(), [low, high]);
        prop_assert!((own_high[i] - high[i]).abs() <= tolerance, "{:?} {:?}", drawing.bounds(), [low, high]);
    }
    let near = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() <= tolerance);
    let segments: Vec<Segment<Solid>> = drawing.segments().collect();
    prop_assert_eq!(segments.len(), expected.len());
    for (index, (a, b)) in segments.iter().zip(&expected).enumerate() {
        prop_assert!(near(a.from, b.from) && near(a.to, b.to), "{}: {:?} {:?}", index, a, b);
        prop_assert_eq!((a.colour, a.level), (b.colour, b.level), "{}", index);
        prop_assert!((a.width - b.width).abs() <= 1e-9 * b.width, "{}: {:?} {:?}", index, a, b);
        prop_assert!((a.end_width - b.end_width).abs() <= 1e-9 * b.end_width, "{}: {:?} {:?}", index, a, b);
    }
    for start in [1, segments.len() / 3, segments.len() - 1] {
        let from: Vec<_> = drawing.segments_from(start as u128).take(3).collect();
        prop_assert_eq!(&from[..], &segments[start..(start + 3).min(segments.len())]);
    }
    Ok(drawing)
}

/// A word with letters that turn about all axes, and with `$` if `upright`.
fn word(upright: bool) -> impl Strategy<Value = String> {
    let mut parts = vec![
        "F", "F", "F", "A", "B", "+", "-", "&", "^", "\\", "/", "|", "f", "!", "'", "[&F]", "[/A]", "[^^B]", "@", "~",
        "[~A]", "○", "[-\\F", "]",
    ];
    // Unbalanced branches prevent sharing, so they are rare; with `$` there are none.
    parts.truncate(if upright { parts.len() } else { parts.len() - 2 });
    if upright {
        parts.push("$");
    }
    prop::collection::vec(prop::sample::select(parts), 1..7).prop_map(|parts| parts.concat())
}

fn random() -> impl Strategy<Value = (Definition, u32)> {
    let angle = || prop::sample::select(vec![90.0, 30.0, 22.5, 25.7, 137.5, -60.0]);
    let angles = (angle(), prop::array::uniform5(prop::option::of(angle())));
    let tropism = prop_oneof![
        2 => Just(([0.0, -1.0, 0.0], 0.0)),
        1 => (prop::array::uniform3(-1.0..1.0), -0.4..0.4),
        1 => Just(([0.0, 1.0, 0.0], 0.22)),
    ];
    let words = prop_oneof![Just(false), Just(true)].prop_flat_map(|upright| prop::array::uniform4(word(upright)));
    (words, angles, (tropism, wind()), 0..5_u32, prop::bool::ANY, any::<u32>()).prop_map(
        |([axiom, a, b, f], (angle, others), ((tropism, elasticity), wind), n, chance, seed)| {
            let rules = if chance {
                format!("A -> {a} : 1\nA -> {b} : 2\nF -> {f}F")
            } else {
                format!("A -> {a}\nB -> {b}\nF -> {f}F")
            };
            let [right_angle, pitch_down, pitch_up, roll_left, roll_right] = others;
            let definition = Definition {
                right_angle,
                pitch_down,
                pitch_up,
                roll_left,
                roll_right,
                tropism,
                elasticity,
                wind,
                heading: angle + 7.0,
                start: [3.0, -2.0],
                step: 0.7,
                overrides: "@: length times 0.8\n~: swap turns".into(),
                seed,
                style: lsystem::Style { width: 0.5, ..lsystem::Style::default() },
                ..abop(&axiom, &rules, angle)
            };
            (definition, n)
        },
    )
}

fn levelled() -> impl Strategy<Value = String> {
    "([F&^/+$]|\\[[&^/+$]{0,3}[ABT]\\]|[ABT]){1,6}"
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn drawings_are_as_the_naive_turtle_says((definition, n) in random()) {
        let system = system(&definition);
        prop_assume!(lsystem::count_segments(&system, n).is_none_or(|count| count.to_string().len() < 6));
        check(&system, n)?;
    }

    #[test]
    fn modules_with_numbers_too(a in 5.0..60.0, b in -90.0..90.0, d in 0.0..360.0, e in prop_oneof![Just(0.0), 0.0..0.3], wind in wind()) {
        let rules = format!("a = {a}\nb = {b}\nd = {d}\nA(l,w) -> !(w)F(l)[&(a)B(l*0.9,w*0.7)]/(d)A(l*0.8,w*0.7)\n\
            B(l,w) -> !(w)F(l)[-(b)$C(l*0.6,w*0.7)]\\(d)C(l*0.9,w*0.7)\nC(l,w) -> !(w)F(l)[+(b)^(a)B(l,w)]B(l/2,w*0.7)");
        let drawing = check(&system(&Definition { elasticity: e, wind, ..abop("A(1,0.1)", &rules, 10.0) }), 6)?;
        prop_assert_eq!(drawing.is_memoised(), e == 0.0);
    }

    #[test]
    fn what_looks_to_the_vertical_is_shared_rightly(words in prop::array::uniform3(levelled()), heading in 0.0..180.0, wind in wind()) {
        let numbered = |word: &str| {
            word.replace('F', "F(l)").replace('A', "A(l*0.7)").replace('B', "B(l*0.6)").replace('T', "T(l)")
        };
        let [a, b, t] = words.map(|word| numbered(&word));
        let rules = format!("A(l) -> F(l){a}\nB(l) -> {b}F(l)\nT(l) -> {t}");
        // Some of these systems share blocks. Others have `$` after a turn that is not known, and are unfolded.
        check(&system(&Definition { heading, wind, ..abop("A(1)&B(1)$F", &rules, 25.0) }), 3)?;
    }

    #[test]
    fn a_flat_drawing_is_the_same_in_both_spaces(word in "([FAf+|-]|\\[F\\+A\\]){1,9}", e in prop_oneof![Just(0.0), -0.3..0.3]) {
        let definition = Definition { elasticity: e, ..abop("A-F", &format!("A -> {word}\nF -> F+F"), 25.7) };
        let system = system(&definition);
        prop_assert!(!system.is_solid());
        let limits = Limits::default();
        let (flat, solid) = (draw::<Plane>(&system, 4, &limits).unwrap(), draw::<Solid>(&system, 4, &limits).unwrap());
        prop_assert_eq!(flat.segment_count(), solid.segment_count());
        let expected = naive::segments(&system, 4);
        for ((a, b), c) in flat.segments().zip(solid.segments()).zip(expected) {
            let near = |x: f64, y: f64| (x - y).abs() < 1e-9 * (1.0 + x.abs());
            prop_assert!(near(a.to[0], b.to[0]) && near(a.to[1], b.to[1]) && b.to[2].abs() < 1e-9, "{:?} {:?}", a, b);
            prop_assert!(near(a.to[0], c.to[0]) && near(a.to[1], c.to[1]), "{:?} {:?}", a, c);
        }
    }
}

#[test]
fn what_leads_out_of_the_plane_is_solid() {
    let solid = |definition: &Definition| system(definition).is_solid();
    for (axiom, expected) in [("F+F", false), ("F&F", true), ("F/F", true), ("$F", true), ("F^", true), ("\\F", true)] {
        assert_eq!(solid(&abop(axiom, "", 10.0)), expected, "{axiom}");
    }
    // Only symbols that may occur count.
    assert!(!solid(&abop("F", "A -> &F", 10.0)));
    assert!(solid(&abop("F", "F -> FA\ndraw:\nA -> &F", 10.0)));
    assert!(solid(&abop("F(1)A", "draw:\nA -> &F", 10.0)));
    // The meaning of symbols depends on the dialect.
    for (dialect, axiom, expected) in [
        (Dialect::EveryLetter, "F&F", false),
        (Dialect::Practical, "F>F", true),
        (Dialect::Practical, "F/F", false),
        (Dialect::Axes, "F+F", true),
        (Dialect::Axes, "FvF", true),
    ] {
        assert_eq!(solid(&Definition { dialect, ..abop(axiom, "", 10.0) }), expected, "{dialect:?} {axiom}");
    }
    assert!(solid(&Definition { overrides: "K: roll left 20".into(), ..abop("FKF", "", 10.0) }));
    assert!(!solid(&Definition { elasticity: 0.1, ..abop("F", "", 10.0) }));
    assert!(solid(&Definition { elasticity: 0.1, tropism: [0.0, 0.0, 1.0], ..abop("F", "", 10.0) }));
}

/// The end of the last segment, to nine decimals.
fn end(definition: &Definition) -> [f64; 3] {
    let drawing = draw::<Solid>(&system(definition), 0, &Limits::default()).unwrap();
    drawing.segments().last().unwrap().to.map(|c| (c * 1e9).round() / 1e9)
}

#[test]
fn a_turtle_that_heads_up_knows_its_left_and_its_back() {
    // The heading is +y, left is -x, and up is +z (towards the viewer).
    let end = |axiom: &str| end(&abop(axiom, "", 90.0));
    assert_eq!(end("F"), [0.0, 1.0, 0.0]);
    assert_eq!(end("+F"), [-1.0, 0.0, 0.0]);
    assert_eq!(end("-F"), [1.0, 0.0, 0.0]);
    assert_eq!(end("&F"), [0.0, 0.0, -1.0]);
    assert_eq!(end("^F"), [0.0, 0.0, 1.0]);
    // After a roll to the left by 90 degrees, left is the former up.
    assert_eq!(end("\\+F"), [0.0, 0.0, 1.0]);
    assert_eq!(end("/+F"), [0.0, 0.0, -1.0]);
    assert_eq!(end("&|F"), [0.0, 0.0, 1.0]);
    // `$` levels the left: after a pitch down by 90 degrees, left is -x again.
    assert_eq!(end("&(90)/(33)$+F"), [-1.0, 0.0, 0.0]);
}

/// A definition with six different angles.
fn six() -> Definition {
    Definition {
        angle: 11.0,
        right_angle: Some(23.0),
        pitch_down: Some(31.0),
        pitch_up: Some(43.0),
        roll_left: Some(53.0),
        roll_right: Some(61.0),
        ..Definition::default()
    }
}

/// The rotation matrices of the course in Python and of "Of Trees and Turtles", as written there.
fn matrix(axis: char, degrees: f64) -> [[f64; 3]; 3] {
    let (s, c) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
    match axis {
        'x' => [[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]],
        'y' => [[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]],
        _ => [[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]],
    }
}

fn product(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Draws a word: each command multiplies the frame by a matrix on the right, and each step goes along `axis` of the
/// frame.
fn by_matrices(word: &str, start: [[f64; 3]; 3], axis: usize, table: &[(char, char, f64)]) -> Vec<[f64; 3]> {
    let (mut frame, mut at, mut ends) = (start, [0.0; 3], Vec::new());
    for symbol in word.chars() {
        match table.iter().find(|entry| entry.0 == symbol) {
            Some(&(_, about, degrees)) => frame = product(frame, matrix(about, degrees)),
            None => {
                at = [0, 1, 2].map(|i| at[i] + frame[i][axis]);
                ends.push(at);
            }
        }
    }
    ends
}

fn check_matrices(dialect: Dialect, word: &str, expected: &[[f64; 3]]) {
    let definition = Definition { axiom: word.into(), dialect, ..six() };
    let drawing = draw::<Solid>(&system(&definition), 0, &Limits::default()).unwrap();
    let ends: Vec<[f64; 3]> = drawing.segments().map(|segment| segment.to).collect();
    assert_eq!(ends.len(), expected.len());
    for (a, b) in ends.iter().zip(expected) {
        assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-12), "{a:?} {b:?}");
    }
}

#[test]
fn practical_is_its_matrices() {
    let table =
        [('+', 'z', 11.0), ('-', 'z', -23.0), ('&', 'x', 53.0), ('^', 'x', -61.0), ('>', 'y', 31.0), ('<', 'y', -43.0)];
    let word = "F+F&F>F-F^F<F&>+F<<^F";
    check_matrices(Dialect::Practical, word, &by_matrices(word, matrix('z', 90.0), 0, &table));
}

#[test]
fn axes_is_its_matrices() {
    let table =
        [('>', 'z', 11.0), ('<', 'z', -23.0), ('+', 'y', 53.0), ('-', 'y', -61.0), ('v', 'x', 43.0), ('^', 'x', -31.0)];
    let word = "F+F>FvF-F^F<Fv>+F<<^F";
    check_matrices(Dialect::Axes, word, &by_matrices(word, matrix('z', 0.0), 1, &table));
}

#[test]
fn memoised_bushes_are_deep_and_cheap() {
    // ABOP, figure 1.25, without its leaves.
    let rules = "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^F]";
    let bush = system(&abop("A", rules, 22.5));
    let small = check(&bush, 5).unwrap();
    assert!(small.is_memoised());
    let deep = draw::<Solid>(&bush, 60, &Limits::default()).unwrap();
    assert!(deep.is_memoised() && deep.block_count() < 400, "{}", deep.block_count());
    assert!(deep.segment_count() > 1 << 60 && deep.bounds().unwrap().iter().flatten().all(|c| c.is_finite()));
    assert!(draw::<Solid>(&bush, 1000, &Limits::default()).is_ok());
}

#[test]
fn trees_with_level_branches_are_deep_and_cheap() {
    // ABOP, figure 2.6: step 12 has 4,096 apices, but at most 24 directions of the vertical in their frames.
    for name in ["a", "b", "c", "d"] {
        let file = format!("{}/../../data_in/abop/2.6{name}.json", env!("CARGO_MANIFEST_DIR"));
        let definition = lsystem::read_json(&std::fs::read_to_string(file).unwrap()).0.unwrap();
        let tree = system(&definition);
        assert!(check(&tree, 7).unwrap().is_memoised());
        let deep = |n| draw::<Solid>(&tree, n, &Limits::default()).unwrap();
        let apices = deep(12).block_count() - deep(11).block_count();
        assert!(apices <= 24, "{name}: {apices}");
        assert_eq!(deep(40).segment_count(), (1 << 40) - 1);
    }
}

#[test]
fn quarter_turns_stay_on_the_lattice() {
    // ABOP, figure 1.19: Hilbert's curve in space.
    let rules = "A -> B-F+CFC+F-D&F^D-F+&&CFC+F+B//\nB -> A&F^CFB^F^D^^-F-D^|F^B|FC^F^A//\n\
        C -> |D^|F^B-F+C^F^A&&FA&F^C+F+B^F^D//\nD -> |CFB-F+B|FA&F^A&&FB-F+B|FC//";
    let hilbert = system(&abop("A", rules, 90.0));
    let drawing = check(&hilbert, 3).unwrap();
    assert_eq!(drawing.segment_count(), 511);
    let mut places: Vec<[i64; 3]> = drawing.segments().map(|s| s.to.map(|c| c as i64)).collect();
    assert!(drawing.segments().all(|s| s.to.iter().all(|c| c.fract() == 0.0)));
    places.push([0; 3]);
    places.sort_unstable();
    places.dedup();
    assert_eq!(places.len(), 512, "every place of the cube is visited once");
    let [low, high] = drawing.bounds().unwrap();
    assert!((0..3).all(|i| high[i] - low[i] == 7.0));
}

#[test]
fn limits_hold_in_space_too() {
    let random = system(&abop("F", "F -> F[&F]F : 1\nF -> F/F[^F] : 1", 20.0));
    let limits = Limits { segments: 1000, ..Limits::default() };
    let error = draw::<Solid>(&random, 20, &limits).unwrap_err();
    assert!(
        matches!(error.kind, Kind::Limit { limit: LimitName::Segments, value: 1000, largest: Some(6) }),
        "{error:?}"
    );
}

#[test]
fn numbers_of_all_sizes_stay_numbers() {
    for angle in [f64::MAX, 1e300, f64::MIN_POSITIVE] {
        let wild =
            Definition { pitch_down: Some(angle), roll_left: Some(-angle), ..abop("F&F/F^F\\$F", "F -> F&F", angle) };
        let drawing = draw::<Solid>(&system(&wild), 3, &Limits::default()).unwrap();
        assert!(drawing.segments().all(|s| s.to.iter().all(|c| c.is_finite())));
    }
    assert!(Action::PitchDown(None).is_solid() && !Action::TurnLeft(None).is_solid());
}

/// The files of `data_in` that leave the plane.
const FILES: [&str; 17] = [
    "practical-1/tree3d0",
    "practical-1/tree3d1",
    "trees-and-turtles/of-trees-and-turtles",
    "abop/1.19",
    "abop/1.25",
    "abop/2.6a",
    "abop/2.6b",
    "abop/2.6c",
    "abop/2.6d",
    "abop/2.7a",
    "abop/2.7b",
    "abop/2.7c",
    "abop/2.7d",
    "abop/2.8a",
    "abop/2.8b",
    "abop/2.8c",
    "abop/2.8d",
];

fn file(name: &str) -> Definition {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in").join(name);
    let text = std::fs::read_to_string(path.with_added_extension("json")).expect(name);
    let (definition, diagnostics) = lsystem::read_json(&text);
    assert_eq!(diagnostics, [], "{name}");
    definition.expect(name)
}

#[test]
fn files_equal_the_reference() {
    for name in FILES {
        let definition = file(name);
        let system = system(&definition);
        assert!(system.is_solid(), "{name}");
        check(&system, definition.iterations).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn modules_of_figure_2_6_are_as_counted() {
    for (n, modules) in [(10, 7162), (17, 917_498)] {
        let drawing = draw::<Solid>(&system(&file("abop/2.6a")), n, &Limits::default()).unwrap();
        assert_eq!(drawing.symbol_count(), Some(modules));
    }
}

#[test]
fn on_paper_what_is_nearer_covers_what_is_farther() {
    // Three arms from the start: away from the viewer, to the left, and towards the viewer.
    let cross = system(&Definition { step: 2.0, start: [5.0, 1.0], ..abop("'[&F]'[+F]'[^F]", "", 90.0) });
    let drawing = draw::<Solid>(&cross, 0, &Limits::default()).unwrap();
    let from = |azimuth: f64, elevation: f64| {
        let outlook = Outlook { azimuth, elevation };
        let seen = drawing.seen_from(&outlook, 10).unwrap();
        let round = |p: [f64; 2]| p.map(|c| (c * 1e6).round() / 1e6 + 0.0);
        seen.segments().map(|s| (s.colour, round(s.to))).collect::<Vec<_>>()
    };
    assert_eq!(from(0.0, 0.0), [(1, [5.0, 1.0]), (2, [3.0, 1.0]), (3, [5.0, 1.0])]);
    // From the right, +z points to the left, and the left arm is behind.
    assert_eq!(from(90.0, 0.0), [(2, [0.0, 1.0]), (1, [2.0, 1.0]), (3, [-2.0, 1.0])]);
    // From straight above, +z points down.
    assert_eq!(from(0.0, 90.0), [(1, [5.0, 2.0]), (2, [3.0, 0.0]), (3, [5.0, -2.0])]);
    // From behind.
    assert_eq!(from(180.0, 0.0), [(3, [-5.0, 1.0]), (2, [-3.0, 1.0]), (1, [-5.0, 1.0])]);
    let error = drawing.seen_from(&Outlook::default(), 2).unwrap_err();
    assert!(matches!(error.kind, Kind::Limit { limit: LimitName::Segments, value: 2, .. }));
    // A negative length reverses a segment.
    let back = system(&Definition { overrides: "F: draw -2".into(), ..abop("'[&F]'[^F]", "", 90.0) });
    let seen =
        draw::<Solid>(&back, 0, &Limits::default()).unwrap().seen_from(&Outlook { azimuth: 0.0, elevation: 0.0 }, 9);
    assert_eq!(seen.unwrap().segments().map(|s| s.colour).collect::<Vec<_>>(), [2, 1]);
}

#[test]
fn on_paper_colours_follow_the_path_in_space() {
    let line = system(&abop("F&F&F", "", 90.0));
    let drawing = draw::<Solid>(&line, 0, &Limits::default()).unwrap();
    // The first segment is nearest from one side and farthest from the other.
    for (azimuth, places) in [(0.0, [2.5, 1.5, 0.5]), (180.0, [0.5, 1.5, 2.5])] {
        let seen = drawing.seen_from(&Outlook { azimuth, elevation: 0.0 }, 10).unwrap();
        let tints = seen.marks().map(|mark| match mark {
            Mark::Segment(_, tint) | Mark::Polygon(_, tint) => tint.place,
        });
        assert_eq!(tints.collect::<Vec<_>>(), places.map(|place| place / 3.0), "{azimuth}");
    }
}

#[test]
fn tables_have_a_column_for_each_coordinate() {
    let drawing = draw::<Solid>(&system(&abop("F&F", "", 90.0)), 0, &Limits::default()).unwrap();
    let text = lsystem::write_csv(&drawing, 10).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x0,y0,z0,x1,y1,z1,level,colour"));
    assert!(lines.all(|line| line.split(',').count() == 8) && text.lines().count() == 3, "{text}");
}
