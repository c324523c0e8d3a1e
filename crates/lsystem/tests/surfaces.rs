//! Bezier surfaces, compared with the naive turtle, and where a system holds them.

use crate::naive;
use crate::styling::check;
use lsystem::syntax::{parse_surfaces, print_surfaces};
use lsystem::{Definition, Limits, Plane, Solid, Style, System, draw, read_json, write_json};
use proptest::prelude::*;

/// A bent leaf `l` and a surface `m` of two patches.
fn surfaces() -> String {
    let patch = |shift: f64, bend: f64| -> String {
        let number = |at: usize| {
            let (along, across) = ((at / 4) as f64 / 3.0, (at % 4) as f64 / 3.0 - 0.5);
            let (left, up) = (shift + across * (1.0 - along), bend * along * along);
            format!(" {} {} {}", number(along), number(left), number(up))
        };
        fn number(value: f64) -> String {
            format!("{value:.3}")
        }
        (0..16).map(number).collect()
    };
    format!("l:{}\nm:{}{}", patch(0.0, 0.5), patch(0.5, 0.2), patch(-0.5, -0.2))
}

fn leaves(axiom: &str, rules: &str) -> Definition {
    Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        angle: 35.0,
        overrides: "L: surface l\nM: surface m 0.5, turn left 20\nN: surface l, draw".into(),
        surfaces: surfaces(),
        style: Style { width: 0.5, ..Style::default() },
        ..Definition::default()
    }
}

fn system(definition: &Definition) -> System {
    System::new(definition).unwrap_or_else(|_| panic!("{definition:?}"))
}

fn word() -> impl Strategy<Value = String> {
    let parts =
        vec!["F", "L", "M", "N", "L(x)", "N(x)", "M(x)", "[&L]", "+", "&", "/", "A(x)", "A(x*0.7)", "[+A(x)]", "'"];
    prop::collection::vec(prop::sample::select(parts), 1..5).prop_map(|parts| parts.concat())
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn surfaces_are_as_the_naive_turtle_says(
        (a, b, growth, percent, n) in (word(), word(), 0.2..1.0, prop_oneof![Just(0.0), 0.0..50.0], 0..4_u32)
    ) {
        let definition = leaves("A(1)", &format!("A(x) : x > 0.3 -> {a}\nB(x) -> {b}"));
        let definition = Definition { growth, length_variation: percent, ..definition };
        let length = naive::modules(&system(&definition).grammar, definition.seed, n).map(|word| word.len());
        prop_assume!(length.is_some_and(|length| length < 60));
        check(&definition, n)?;
    }
}

#[test]
fn surfaces_share_blocks() {
    let definition = leaves("A", "A -> F[&L]/[+NA]M");
    check(&definition, 4).unwrap();
    let drawing = draw::<Solid>(&system(&definition), 60, &Limits::default()).unwrap();
    assert!(drawing.is_memoised() && drawing.block_count() < 200);
    // A patch that ends in a point has 6 triangles less than 72. Two patches have twice as many as one.
    assert_eq!(draw::<Solid>(&system(&leaves("M", "")), 0, &Limits::default()).unwrap().polygon_count(), 132);
    assert_eq!(draw::<Plane>(&system(&leaves("L", "")), 0, &Limits::default()).unwrap().polygon_count(), 66);
}

#[test]
fn files_and_links_hold_surfaces() {
    let definition = leaves("FL", "F -> FF");
    let text = print_surfaces(&parse_surfaces(&definition.surfaces).unwrap());
    let definition = Definition { surfaces: text, ..definition };
    assert_eq!(read_json(&write_json(&definition)).0, Some(definition.clone()));
    let link = lsystem::files::write_link(&definition);
    assert_eq!(lsystem::files::read_link(&link).unwrap().definition, definition);
}

#[test]
fn problems_are_told() {
    let missing = Definition { surfaces: String::new(), ..leaves("L", "") };
    let messages: Vec<String> = System::problems(&missing).into_iter().map(|diagnostic| diagnostic.message).collect();
    assert_eq!(messages, ["There is no surface `l`", "There is no surface `m`"]);
    assert_eq!(draw::<Plane>(&system(&missing), 0, &Limits::default()).unwrap().polygon_count(), 0);
    let wrong = Definition { surfaces: "l: 1 2".into(), ..leaves("L", "") };
    assert!(System::new(&wrong).is_err());
    assert!(System::problems(&wrong).iter().any(|problem| problem.message.starts_with("Line 1 of the surfaces")));
}

#[test]
fn a_number_is_the_size_of_the_whole_surface() {
    let definition = |axiom: &str| Definition { surfaces: surfaces(), ..leaves(axiom, "X(x) -> X(x)") };
    let bounds =
        |axiom: &str| draw::<Solid>(&system(&definition(axiom)), 0, &Limits::default()).unwrap().bounds().unwrap();
    let [one, three] = ["L", "L(3)"].map(bounds);
    for (one, three) in one.iter().flatten().zip(three.iter().flatten()) {
        assert!((3.0 * one - three).abs() < 1e-12, "{one} {three}");
    }
}
