//! Smooth tubes, compared with the naive turtle.

use crate::naive;
use crate::styling::check;
use lsystem::{Definition, Limits, Plane, Style, System, count_segments, draw};
use proptest::prelude::*;

const TUBES: &str = "S: open tube\nT: tube point\nU: close tube\nR: move, tube point";

fn tubes(axiom: &str, rules: &str, angle: f64) -> Definition {
    Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        angle,
        overrides: TUBES.into(),
        style: Style { width: 0.5, ..Style::default() },
        ..Definition::default()
    }
}

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|_| panic!("{definition:?}"))
}

fn word() -> impl Strategy<Value = String> {
    let parts = vec![
        "SfT", "R", "R+R", "+fT", "-fU", "&R", "/R", "[+R]", "[SfT]", "[-A]", "!R", "F", "A", "B", "R(2)", "T", "']R",
        "[^R", "$R",
    ];
    prop::collection::vec(prop::sample::select(parts), 1..6).prop_map(|parts| parts.concat())
}

fn random() -> impl Strategy<Value = (Definition, u32)> {
    let numbers = (prop_oneof![Just(1.0), 0.3..1.6], prop_oneof![Just(0.0), 0.0..40.0], 0.0..1.0);
    (prop::array::uniform3(word()), numbers, any::<bool>(), 0..4_u32, any::<u32>()).prop_map(
        |([axiom, a, b], (factor, percent, growth), tapers, n, seed)| {
            let rules = format!("A -> {a}\nB -> {b}A");
            let definition = tubes(&axiom, &rules, 25.0);
            let style = Style { tapers, width_factor: factor, ..definition.style };
            let (length_factor, angle_variation) = (factor, percent);
            (Definition { style, length_factor, angle_variation, growth, seed, ..definition }, n)
        },
    )
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn tubes_are_as_the_naive_turtle_says((definition, n) in random()) {
        prop_assume!(naive::modules(&system(&definition).grammar, definition.seed, n).unwrap().len() < 600);
        check(&definition, n)?;
    }
}

#[test]
fn a_part_of_a_tube_stays_near_its_curve() {
    for start in [0.0_f64, 15.0, 30.0, 45.0, 60.0] {
        for end in [-60.0_f64, -45.0, -20.0, 0.0, 30.0, 60.0] {
            let heading = |degrees: f64| [libm::cos(degrees.to_radians()), libm::sin(degrees.to_radians())];
            let (from, to) = (([0.0, 0.0], heading(start), 1.0), ([1.0, 0.0], heading(end), 1.0));
            let (corners, fine) = (naive::tube(from, to, 8), naive::tube(from, to, 800));
            let farthest = fine.iter().enumerate().map(|(at, point)| {
                let [a, b] = [corners[(at / 100).min(7)], corners[(at / 100).min(7) + 1]];
                let along = [b[0] - a[0], b[1] - a[1]];
                let across = (along[0] * (point[1] - a[1]) - along[1] * (point[0] - a[0])).abs();
                across / (along[0] * along[0] + along[1] * along[1]).sqrt()
            });
            let farthest = farthest.fold(0.0, f64::max);
            assert!(farthest < 1.0 / 90.0, "{start} {end}: {farthest}");
        }
    }
}

#[test]
fn a_straight_part_has_even_strokes_and_the_width_changes_evenly() {
    let drawing = draw::<Plane>(&system(&tubes("S!(2)f(8)U", "", 0.0)), 0, &Limits::default()).unwrap();
    let strokes: Vec<_> = drawing.segments().collect();
    assert_eq!(strokes.len(), 8);
    let factor = strokes[0].width / 0.5;
    for (at, stroke) in strokes.iter().enumerate() {
        let at = at as f64;
        assert!((stroke.from[1] - at).abs() < 1e-12 && (stroke.to[1] - at - 1.0).abs() < 1e-12, "{stroke:?}");
        let widths = [0.5 + 1.5 * at / 8.0, 0.5 + 1.5 * (at + 1.0) / 8.0];
        assert!((stroke.width / factor - widths[0]).abs() < 1e-12, "{stroke:?}");
        assert!((stroke.end_width / factor - widths[1]).abs() < 1e-12, "{stroke:?}");
    }
}

#[test]
fn strokes_of_tubes_are_counted_without_drawing() {
    let definition = tubes("SA", "A -> R[+A]A", 20.0);
    for n in 0..6 {
        let system = system(&definition);
        let drawn = draw::<Plane>(&system, n, &Limits::default()).unwrap().segment_count();
        assert_eq!(count_segments(&system, n).unwrap().to_string(), drawn.to_string());
    }
}

#[test]
fn a_drawing_of_too_many_tubes_names_the_limit() {
    let definition = tubes("S(1)A", "A -> RAA\nS(x) -> S(x)", 20.0);
    let limits = Limits { segments: 100, ..Limits::default() };
    let refused = draw::<Plane>(&system(&definition), 8, &limits).unwrap_err();
    let lsystem::syntax::Kind::Limit { value, largest, .. } = refused.kind else { panic!("{refused:?}") };
    assert_eq!((value, largest), (100, Some(3)));
    assert!(draw::<Plane>(&system(&definition), 3, &limits).is_ok());
}
