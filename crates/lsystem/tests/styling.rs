//! Colours, factors, variation, growth and polygons, compared with the naive reference.

use crate::naive;
use lsystem::drawing::{Mark, Segment};
use lsystem::syntax::{ColourBy, Tint};
use lsystem::{Definition, Limits, Plane, Solid, Style, System, draw, read_json, write_json};
use proptest::prelude::*;

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|diagnostics| panic!("{definition:?}: {diagnostics:?}"))
}

fn abop(axiom: &str, rules: &str, angle: f64) -> Definition {
    Definition { axiom: axiom.into(), rules: rules.into(), angle, ..Definition::default() }
}

fn near<const N: usize>(a: [f64; N], b: [f64; N], tolerance: f64) -> bool {
    a.iter().zip(&b).all(|(a, b)| (a - b).abs() <= tolerance)
}

/// Checks that the drawing equals that of the naive turtle, in both spaces.
pub(crate) fn check(definition: &Definition, n: u32) -> Result<(), TestCaseError> {
    let system = system(definition);
    let limits = Limits::default();
    let flat = draw::<Plane>(&system, n, &limits).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let solid = draw::<Solid>(&system, n, &limits).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
    let expected = naive::limited_segments(&system, n, flat.bounds());
    let reach = expected.iter().flat_map(|s| s.from.into_iter().chain(s.to)).fold(1.0_f64, |r, c| r.max(c.abs()));
    prop_assert_eq!(flat.segment_count(), expected.len() as u128);
    for (index, (a, b)) in flat.segments().zip(&expected).enumerate() {
        let tolerance = 1e-9 * reach;
        prop_assert!(near(a.from, b.from, tolerance) && near(a.to, b.to, tolerance), "{index}: {a:?} {b:?}");
        prop_assert_eq!((a.colour, a.level), (b.colour, b.level), "{}", index);
        prop_assert!((a.width - b.width).abs() <= 1e-9 * (1.0 + b.width), "{index}: {a:?} {b:?}");
        prop_assert!((a.end_width - b.end_width).abs() <= 1e-9 * (1.0 + b.end_width), "{index}: {a:?} {b:?}");
    }
    let expected = naive::solid_segments(&system, n);
    let polygons = naive::solid_polygons(&system, n);
    let ends = expected.iter().flat_map(|s| s.from.into_iter().chain(s.to));
    let reach =
        ends.chain(polygons.iter().flat_map(|p| p.0.iter().flatten().copied())).fold(1.0_f64, |r, c| r.max(c.abs()));
    let tolerance = 1e-9 * reach;
    // A polygon whose area is only a rounding error may be missing.
    let flat = |outline: &[[f64; 3]]| outline.windows(2).filter(|p| !near(p[0], p[1], tolerance)).count() < 2;
    let polygons: Vec<_> = polygons.iter().filter(|polygon| !flat(&polygon.0)).collect();
    let (mut segments, mut filled) = (0, 0);
    for mark in solid.marks() {
        match mark {
            Mark::Segment(a, tint) => {
                let b: &Segment<_> = &expected[segments];
                prop_assert!(near(a.from, b.from, tolerance) && near(a.to, b.to, tolerance), "{a:?} {b:?}");
                prop_assert_eq!((a.colour, a.level, tint.index, tint.level), (b.colour, b.level, b.colour, b.level));
                segments += 1;
            }
            Mark::Polygon(vertices, _) if flat(&vertices) => {}
            Mark::Polygon(vertices, tint) => {
                prop_assert!(filled < polygons.len());
                let (outline, colour, level, before, _) = polygons[filled];
                // Ends that differ only by rounding may be one vertex or two.
                let mut theirs = outline.iter();
                let mut last = None;
                for vertex in &vertices {
                    last = theirs.by_ref().find(|&&p| near(*vertex, p, tolerance)).or(last);
                    prop_assert!(last.is_some_and(|&p| near(*vertex, p, tolerance)), "{vertices:?} {outline:?}");
                }
                prop_assert_eq!((tint.index, tint.level, segments), (*colour, *level, *before));
                filled += 1;
            }
        }
    }
    prop_assert_eq!((segments, filled), (expected.len(), polygons.len()));
    if let Some(bounds) = solid.bounds() {
        let all = expected.iter().flat_map(|s| [s.from, s.to]).chain(polygons.iter().flat_map(|p| p.0.clone()));
        for point in all {
            for axis in 0..3 {
                prop_assert!(point[axis] >= bounds[0][axis] - tolerance && point[axis] <= bounds[1][axis] + tolerance);
            }
        }
    }
    Ok(())
}

fn word() -> impl Strategy<Value = String> {
    let parts = vec![
        "F",
        "F",
        "A",
        "B",
        "+",
        "-",
        "&",
        "/",
        "|",
        "f",
        "G",
        "!",
        "'",
        "[+F]",
        "[-A]",
        "[^B]",
        "{+f-f|-f}",
        "{F[+A].B}",
        "{.G.+G.}",
        "{",
        "}",
        "]",
        "[{f+f",
        "f}]",
        "{f{'f+f}+f+f}",
        "{.[-f.][+f.]}",
        "{[-f][+f]f}",
        "@",
        "@F[@+A]",
        "~",
        "~B~",
        "[~A]",
        "○",
        "●",
        "{f+●f-f}",
    ];
    prop::collection::vec(prop::sample::select(parts), 1..6).prop_map(|parts| parts.concat())
}

fn random() -> impl Strategy<Value = (Definition, u32)> {
    let percent = || prop_oneof![2 => Just(0.0), 1 => 0.0..100.0];
    let factor = || prop_oneof![1 => Just(1.0), 2 => 0.3..1.6];
    let numbers = (percent(), percent(), factor(), factor(), prop_oneof![1 => Just(1.0), 1 => 0.0..1.0]);
    (
        prop::array::uniform4(word()),
        numbers,
        prop::sample::select(ColourBy::ALL.to_vec()),
        prop::sample::select(vec![22.5, 90.0, 137.5, -60.0]),
        (0..5_u32, any::<u32>(), 0..4),
    )
        .prop_map(|([axiom, a, b, f], numbers, colour_by, angle, (n, seed, kind))| {
            let rules = match kind {
                0 => format!("A -> {a} : 1\nA -> {b} : 2\nF -> {f}F"),
                // Rules with contexts are derived by whole generations.
                1 => format!("A -> {a}\nF < B -> {b}\nF -> {f}F\nP(x) -> F(x)"),
                _ => format!("A -> {a}\nB -> {b}\nF -> {f}F"),
            };
            let style =
                Style { colour_by, width: 0.5, width_factor: numbers.2, turn_colours: [3, 5], ..Style::default() };
            let definition = Definition {
                right_angle: (seed % 2 == 0).then_some(35.0),
                overrides: "@: length times 0.8\n~: swap turns".into(),
                angle_variation: numbers.0,
                length_variation: numbers.1,
                length_factor: numbers.3,
                growth: numbers.4,
                seed,
                style,
                ..abop(&axiom, &rules, angle)
            };
            (definition, n)
        })
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn drawings_are_as_the_naive_turtle_says((definition, n) in random()) {
        let count = lsystem::count_segments(&system(&definition), n);
        prop_assume!(count.map_or(n < 4, |count| count.to_string().len() < 5));
        check(&definition, n)?;
    }
}

/// A word of modules with a parameter `x`, with balanced branches.
fn numbered() -> impl Strategy<Value = String> {
    let parts = vec![
        "F(x)",
        "F",
        "A(x*0.8)",
        "B(x)",
        "B(x*r)",
        "C(x)",
        "+(x*20)",
        "-",
        "|",
        "f(x)",
        "!(x)",
        "[+F(x)]",
        "[-A(x*0.7)F]",
        "[&B(x)]",
        "[C(x)+f(x)A(x)]",
        "G(x)",
        "E(x)",
        "@(x)",
        "@(0.5)A(x)",
        "~",
        "~B(x)",
        "[~A(x)-F]",
        "○(x)",
        "●(x)",
        "○",
    ];
    prop::collection::vec(prop::sample::select(parts), 1..5).prop_map(|parts| parts.concat())
}

fn with_parameters() -> impl Strategy<Value = (Definition, u32)> {
    let factor = || prop_oneof![1 => Just(1.0), 2 => 0.3..1.6];
    let numbers = (factor(), factor(), prop_oneof![1 => Just(1.0), 2 => 0.0..1.0]);
    let images = ["", "draw:\nC(x) -> f(x)[+F(x)]F(x)", "draw:\nE(x) : x > 0.5 -> [+F(x)]F\nC(x) -> f(x)"];
    let rest = (prop::sample::select(ColourBy::ALL.to_vec()), prop::sample::select(images.to_vec()), 0..4_u32);
    (prop::array::uniform3(numbered()), numbers, rest).prop_map(|([a, b, f], numbers, (colour_by, images, n))| {
        let rules = format!("r = 0.9\nA(x) : x > 0.2 -> {a}\nB(x) -> {b}\nF(x) : x > 0.5 -> {f}F(x)\n{images}");
        let style = Style { colour_by, width: 0.5, width_factor: numbers.0, turn_colours: [3, 5], ..Style::default() };
        let (length_factor, growth) = (numbers.1, numbers.2);
        let overrides = "@: length times 0.8\n~: swap turns, turn left 7".into();
        let right_angle = (n % 2 == 0).then_some(40.0);
        (
            Definition {
                length_factor,
                growth,
                style,
                overrides,
                right_angle,
                ..abop("A(1)[+B(0.7)]F(0.8)", &rules, 25.0)
            },
            n,
        )
    })
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn what_shares_by_parameters_is_as_the_naive_turtle_says((definition, n) in with_parameters()) {
        let system = system(&definition);
        prop_assume!(naive::modules(&system.grammar, system.seed, n).is_some_and(|word| word.len() < 600));
        prop_assert!(draw::<Plane>(&system, n, &Limits::default()).unwrap().is_memoised());
        check(&definition, n)?;
    }
}

fn drawn(definition: &Definition, n: u32) -> lsystem::Drawing {
    draw::<Plane>(&system(definition), n, &Limits::default()).unwrap()
}

#[test]
fn semicolons_raise_the_colour_and_commas_lower_it() {
    let colours = |axiom: &str| drawn(&abop(axiom, "", 0.0), 0).segments().map(|s| s.colour).collect::<Vec<_>>();
    assert_eq!(colours("F;F'F,F"), [0, 1, 2, 1]);
    assert_eq!(colours(";(5)F,F,(3)F"), [5, 4, 3]);
}

#[test]
fn a_polygon_records_the_start_of_its_first_segment_only() {
    let outlines = |axiom: &str| {
        let of = |mark| if let Mark::Polygon(vertices, _) = mark { Some(vertices) } else { None };
        drawn(&abop(axiom, "", 90.0), 0).marks().filter_map(of).collect::<Vec<_>>()
    };
    // The turtle starts upwards.
    let cases: [(&str, &[[f64; 2]]); 6] = [
        ("{.[-f(2).][+f(2).]}", &[[0.0, 0.0], [2.0, 0.0], [-2.0, 0.0]]),
        ("{[-f][+f]f}", &[[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0]]),
        ("{f[+f]f}", &[[0.0, 0.0], [0.0, 1.0], [-1.0, 1.0], [0.0, 2.0]]),
        ("{F+F+F}", &[[0.0, 0.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0]]),
        ("G{f+f+f}", &[[0.0, 1.0], [0.0, 2.0], [-1.0, 2.0], [-1.0, 1.0]]),
        ("{.Gf+f}", &[[0.0, 0.0], [0.0, 2.0], [-1.0, 2.0]]),
    ];
    for (axiom, expected) in cases {
        let found = outlines(axiom);
        let exact =
            found.iter().map(|p| p.iter().map(|v| v.map(|c| (c * 1e9).round() / 1e9 + 0.0)).collect::<Vec<_>>());
        assert_eq!(exact.collect::<Vec<_>>(), [expected.to_vec()], "{axiom}");
    }
}

#[test]
fn scaled_lengths_exchanged_turns_discs_and_leaves_share_blocks() {
    let overrides = "@: length times 0.5\n~: swap turns\nL: leaf oak 0.7\nQ: next colour, leaf petal";
    // The last rule leaves the turtle with exchanged turns.
    for rules in ["X -> F[@+X]~[@-X]F", "X -> F@X~+X○", "X -> @~F-X●~", "X -> +FX~", "X -> F[+L@X]-FQX~"] {
        let definition =
            |rules: &str| Definition { overrides: overrides.into(), right_angle: Some(50.0), ..abop("X", rules, 30.0) };
        check(&definition(rules), 5).unwrap();
        let deep = drawn(&definition(rules), 60);
        assert!(deep.is_memoised() && deep.block_count() < 200, "{rules}: {}", deep.block_count());
        let turned = format!("{rules}\nY(a) : a > 0 -> +(a)Y(a/2)~\n")
            .replace('X', "X(x)")
            .replace("X(x) ->", "X(x) : x > 0 ->");
        let turned = Definition { axiom: "X(1)Y(8)".into(), ..definition(&turned) };
        check(&turned, 5).unwrap();
        assert!(drawn(&turned, 40).is_memoised(), "{rules}");
    }
}

#[test]
fn a_stroke_tapers_to_the_width_with_which_its_branch_goes_on() {
    let widths = |axiom: &str| -> Vec<[f64; 2]> {
        let mut definition = abop(axiom, "", 90.0);
        (definition.style.width, definition.style.max_width) = (1.0, 0.0);
        definition.overrides = "!: width times 0.5\n#: width times 2".into();
        drawn(&definition, 0).segments().map(|segment| [segment.width, segment.end_width]).collect()
    };
    // From stroke to stroke; the last one is even.
    assert_eq!(widths("F!F!F"), [[1.0, 0.5], [0.5, 0.25], [0.25, 0.25]]);
    assert_eq!(widths("F#F"), [[1.0, 2.0], [2.0, 2.0]]);
    // Past a side branch, which is a branch of its own.
    assert_eq!(widths("F[!!+F!F]!F"), [[1.0, 0.5], [0.25, 0.125], [0.125, 0.125], [0.5, 0.5]]);
    assert_eq!(widths("F[+F]F"), [[1.0, 1.0]; 3]);
    // Not over a gap, nor to the sides of a circle.
    assert_eq!(widths("F!fF"), [[1.0, 1.0], [0.5, 0.5]]);
    assert_eq!(widths("F!○F")[..2], [[1.0, 0.5], [0.5, 0.5]]);
    // To a width of its own.
    assert_eq!(widths("F!(3)F!(0)F"), [[1.0, 3.0], [3.0, 0.0], [0.0, 0.0]]);
    // A branch that is never closed, and one that was never opened.
    assert_eq!(widths("F[!F!F"), [[1.0, 1.0], [0.5, 0.25], [0.25, 0.25]]);
    assert_eq!(widths("F]!F"), [[1.0, 0.5], [0.5, 0.5]]);
}

#[test]
fn tapered_strokes_share_blocks() {
    for (axiom, rules) in [
        ("X", "X -> F![+X]F![-X]!+X\nF -> FF"),
        ("FXF", "X -> F[!X]+!X"),
        ("X", "X -> [!+X]X\nF -> F"),
        ("XF", "X -> Y!Y\nY -> [+F]YF"),
        ("X", "X -> f!X[+F!F]F"),
        ("X", "X -> X!\nY -> F"),
        ("X!F", "X -> FX"),
        ("!X#F", "X -> #FX[!FX]"),
    ] {
        for width_factor in [1.0, 0.7] {
            let mut definition = abop(axiom, rules, 25.7);
            (definition.style.width, definition.style.width_factor) = (0.3, width_factor);
            for n in 0..6 {
                check(&definition, n).unwrap();
            }
            let deep = drawn(&definition, 60);
            assert!(deep.is_memoised() && deep.block_count() < 400, "{rules}: {}", deep.block_count());
            // The same turtle without sharing: by chance, by generations, and for modules with parameters.
            let chance = rules.replace("X ->", "X -> F!F : 0.2\nX ->");
            let chance = chance
                .lines()
                .map(|line| if line.starts_with("X -> F!F") { line.into() } else { format!("{line} : 1") });
            let chance = Definition { rules: chance.collect::<Vec<_>>().join("\n"), ..definition.clone() };
            check(&chance, 5).unwrap();
            let context = Definition { rules: format!("{rules}\nF < F > F -> F!F"), ..definition.clone() };
            check(&context, 4).unwrap();
            let module = rules.replace('X', "X(x)").replace("X(x) ->", "X(x) : x > 0 ->");
            let module = Definition { axiom: axiom.replace('X', "X(1)"), rules: module, ..definition };
            check(&module, 5).unwrap();
        }
    }
}

#[test]
fn long_words_taper_over_their_blocks() {
    // Branches that stay open over thousands of strokes, each of a bottom block or more.
    for part in ["F+", "F[+F!F]-", "F[-F", "X"] {
        let axiom = format!("F![+F!{}]F!F", part.repeat(3_000));
        let mut definition = abop(&axiom, "", 25.7);
        (definition.style.width, definition.overrides) = (0.5, "X: draw, thinner".into());
        check(&definition, 0).unwrap();
        check(&Definition { axiom: "A".into(), rules: format!("A -> {axiom}"), ..definition.clone() }, 1).unwrap();
        let chance = Definition { axiom: "A".into(), rules: format!("A -> {axiom} : 1\nA -> F : 0.001"), ..definition };
        check(&chance, 1).unwrap();
    }
}

#[test]
fn the_widest_stroke_is_a_set_part_of_the_drawing() {
    for (axiom, rules, n, side) in [("FFF!F", "", 0, 4.0), ("F[+F]F", "F -> F!F", 1, 4.0), ("F(7)", "", 0, 7.0)] {
        let widths = |width: f64, max_width: f64| -> Vec<f64> {
            let mut definition = abop(axiom, rules, 90.0);
            (definition.style.width, definition.style.max_width) = (width, max_width);
            drawn(&definition, n).segments().flat_map(|segment| [segment.width, segment.end_width]).collect()
        };
        let (free, limited) = (widths(40.0, 0.0), widths(40.0, 3.0));
        let widest = limited.iter().copied().fold(0.0, f64::max);
        assert!((widest - 0.03 * side).abs() < 1e-12, "{axiom}: {widest}");
        // All strokes by the same factor.
        assert!(free.iter().zip(&limited).all(|(a, b)| (a * widest / 40.0 - b).abs() < 1e-12), "{axiom}");
        // Strokes that are thin enough stay as they are, and a point has no size.
        assert_eq!(widths(0.02 * side, 3.0), widths(0.02 * side, 0.0), "{axiom}");
    }
    let mut point = abop("F(0)", "", 0.0);
    point.style.width = 2.0;
    assert_eq!(drawn(&point, 0).segments().next().unwrap().width, 2.0);
}

#[test]
fn modules_give_factors_and_diameters() {
    let bounds = |axiom: &str| {
        let definition = Definition { overrides: "@: length times 2".into(), ..abop(axiom, "", 0.0) };
        drawn(&definition, 0).bounds().unwrap()
    };
    let same = |axiom: &str, expected: [f64; 4]| {
        let found = bounds(axiom);
        assert!(near(found, expected, 1e-9), "{axiom}: {found:?}");
    };
    same("@F", [0.0, 0.0, 0.0, 2.0]);
    same("@(0.5)F", [0.0, 0.0, 0.0, 0.5]);
    same("[@(3)F]F", [0.0, 0.0, 0.0, 3.0]);
    same("●", [-0.5, -0.5, 0.5, 0.5]);
    same("f○(3)", [-1.5, -0.5, 1.5, 2.5]);
    same("@(2)●(3)", [-3.0, -3.0, 3.0, 3.0]);
}

#[test]
fn what_composes_memoises() {
    let plant = abop("X", "X -> F[+X]F[-X]{+f-f|-f}+X\nF -> FF", 20.0);
    for colour_by in ColourBy::ALL {
        for growth in [1.0, 0.3] {
            let style = Style { colour_by, width_factor: 0.7, ..Style::default() };
            let styled = Definition { length_factor: 0.8, growth, style, ..plant.clone() };
            let drawing = drawn(&styled, 40);
            assert!(drawing.is_memoised() && drawing.block_count() < 200, "{colour_by:?}");
        }
    }
    let twig = abop("A(1)", "A(l) -> F(l)[+A(l*0.7)][-A(l*0.7)]L(l)\ndraw:\nL(l) -> [+F(l/3)][-F(l/3)]", 20.0);
    for colour_by in ColourBy::ALL {
        for growth in [1.0, 0.3] {
            let style = Style { colour_by, width_factor: 0.7, ..Style::default() };
            let styled = Definition { length_factor: 0.8, growth, style, ..twig.clone() };
            let drawing = drawn(&styled, 40);
            assert!(drawing.is_memoised() && drawing.block_count() < 200, "{colour_by:?}");
        }
    }
    for varied in [Definition { angle_variation: 1.0, ..plant.clone() }, Definition { length_variation: 1.0, ..plant }]
    {
        assert!(!drawn(&varied, 4).is_memoised());
    }
    // A polygon with vertices from several productions.
    assert!(!drawn(&abop("X", "X -> {F[+X]F}\nF -> FF", 20.0), 4).is_memoised());
    assert!(!drawn(&abop("{X}", "X -> fX+", 20.0), 4).is_memoised());
    assert!(drawn(&abop("{f+f+f}X", "X -> F[+X]", 20.0), 4).is_memoised());
}

#[test]
fn growing_begins_at_the_generation_before() {
    for rules in ["F -> F+F--F+F", "X -> X+YF+\nY -> -FX-Y", "R -> L-R-L\nL -> R+L+R", "X -> F[+X]F[-X]+X\nF -> FF"] {
        let axiom = &rules[..1];
        let definition =
            Definition { angle: 60.0, growth: 0.0, overrides: "L: draw\nR: draw".into(), ..abop(axiom, rules, 60.0) };
        let lengths = |definition: &Definition, n: u32| -> Vec<Segment> {
            let all = drawn(definition, n).segments().collect::<Vec<_>>();
            let long = |s: &&Segment| (s.to[0] - s.from[0]).abs() + (s.to[1] - s.from[1]).abs() > 1e-9;
            all.iter().filter(long).copied().collect()
        };
        let (born, before) = (lengths(&definition, 5), lengths(&Definition { growth: 1.0, ..definition.clone() }, 4));
        assert_eq!(born.len(), before.len(), "{rules}");
        for (a, b) in born.iter().zip(&before) {
            assert!(near(a.from, b.from, 1e-9) && near(a.to, b.to, 1e-9), "{rules}: {a:?} {b:?}");
        }
    }
}

#[test]
fn half_a_turn_grows_to_its_own_side() {
    let bent = |axiom: &str, rules: &str| {
        let definition = Definition { growth: 0.5, ..abop(axiom, rules, 180.0) };
        check(&definition, 1).unwrap();
        let last = draw::<Solid>(&system(&definition), 1, &Limits::default()).unwrap().segments().last().unwrap();
        [0, 1, 2].map(|i| last.to[i] - last.from[i])
    };
    for (symbol, expected) in [
        ("+", [-0.5, 0.0, 0.0]),
        ("-", [0.5, 0.0, 0.0]),
        ("|", [-0.5, 0.0, 0.0]),
        ("&", [0.0, 0.0, -0.5]),
        ("^", [0.0, 0.0, 0.5]),
    ] {
        let direction = bent("X", &format!("X -> {symbol}F"));
        assert!((0..3).all(|i| (direction[i] - expected[i]).abs() < 1e-12), "{symbol} {direction:?}");
    }
}

#[test]
fn a_seed_varies_all_of_a_plant_and_growing_keeps_it() {
    let plant = Definition { angle_variation: 30.0, length_variation: 20.0, ..abop("X", "X -> F[+X][-X]FX", 25.7) };
    let first = |seed: u32, n: u32| -> Vec<Segment> {
        drawn(&Definition { seed, ..plant.clone() }, n).segments().take(3).collect()
    };
    assert_ne!(first(1, 5), first(2, 5));
    assert_eq!(first(1, 5)[0], first(1, 6)[0]);
    let expected = 1.0 + 0.2;
    for segment in drawn(&plant, 6).segments() {
        let length = libm::hypot(segment.to[0] - segment.from[0], segment.to[1] - segment.from[1]);
        assert!((0.8 - 1e-9..=expected + 1e-9).contains(&length), "{length}");
    }
}

#[test]
fn palettes_wrap_or_hold() {
    let colour = |text: &str| text.parse::<lsystem::syntax::Colour>().unwrap();
    let style = Style { palette: vec![colour("red"), colour("lime")], colour_by: ColourBy::Level, ..Style::default() };
    let tint = |level| Tint { level, ..Tint::default() };
    assert_eq!(style.colour_of(tint(4)), colour("red"));
    let held = Style { palette_holds: true, ..style };
    assert_eq!((held.colour_of(tint(0)), held.colour_of(tint(4))), (colour("red"), colour("lime")));
    let along = Style { colour_by: ColourBy::Path, palette: vec![colour("black"), colour("white")], ..held };
    let greys = [0.0, 0.25, 0.5, 0.999].map(|place| along.colour_of(Tint { place, ..Tint::default() }).rgb[0]);
    assert!(greys.windows(2).all(|pair| pair[0] < pair[1]) && greys[0] == 0 && greys[3] == 255, "{greys:?}");
}

#[test]
fn hues_turn() {
    let colour = |name: &str| name.parse::<lsystem::syntax::Colour>().unwrap();
    let turned = |hue: f64| Style { palette: vec![colour("red"), colour("white")], hue, ..Style::default() };
    // The matrix of SVG's hueRotate(120): the colour keeps the luminance of red.
    assert_eq!(turned(120.0).entry(0).rgb, [0, 113, 0]);
    assert_eq!([turned(120.0).entry(1), turned(360.0).entry(0)], [colour("white"), colour("red")]);
    assert_eq!(turned(120.0).gradient(0.0), turned(120.0).entry(0));
}

#[test]
fn files_keep_it_all() {
    let style = Style {
        colour_by: ColourBy::Generation,
        palette_holds: true,
        turn_colours: [4, 0],
        width_factor: 0.7,
        ..Style::default()
    };
    let definition = Definition {
        length_factor: 0.8,
        angle_variation: 10.0,
        length_variation: 5.0,
        growth: 0.5,
        style,
        ..abop("F", "F -> F[+F]F", 30.0)
    };
    let text = write_json(&definition);
    assert_eq!(read_json(&text), (Some(definition), vec![]), "{text}");
    for key in ["length_factor", "angle_variation", "length_variation", "growth", "width_factor", "palette_holds"] {
        assert!(text.contains(key), "{key}");
    }
}
