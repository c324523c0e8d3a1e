//! Surprises and children: always something to see, never twice the same, and always the same for one seed.

use lsystem_drawing::{Figure, System};
use lsystem_files::read_json;
use lsystem_invent::{Family, LIMITS, Moments, Rejection, breed, judge, lines, surprise, trial};
use lsystem_syntax::Definition;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

fn figure(definition: &Definition) -> Figure {
    let system = System::new(definition).unwrap_or_else(|diagnostics| panic!("{definition:?}: {diagnostics:?}"));
    assert_eq!(system.warnings, [], "{definition:?}");
    Figure::draw(&system, definition.iterations, &LIMITS).unwrap()
}

fn system(path: &str) -> Definition {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in").join(path);
    read_json(&fs::read_to_string(data).unwrap()).0.unwrap()
}

#[test]
fn surprises_have_something_to_see() {
    for seed in 0..12 {
        let (made, merit) = surprise(seed);
        let figure = figure(&made);
        assert!(figure.segment_count() + figure.polygon_count() >= 60, "{made:?}");
        assert!(merit.proportion >= 0.3 && merit.coverage >= 0.1, "{made:?}: {merit:?}");
        assert!(!made.title.is_empty());
    }
}

#[test]
fn a_seed_makes_one_system() {
    let (first, again) = (surprise(11), surprise(11));
    assert_eq!(first.0, again.0);
    let titles: Vec<String> = (0..10).map(|seed| surprise(seed).0.rules).collect();
    let mut different = titles.clone();
    different.sort();
    different.dedup();
    assert!(different.len() == titles.len(), "{titles:?}");
}

#[test]
fn every_family_is_kept_and_refused() {
    for family in Family::ALL {
        let mut counts: BTreeMap<Option<Rejection>, u32> = BTreeMap::new();
        for turn in 0..40 {
            *counts.entry(trial(family, 1, turn).err()).or_default() += 1;
        }
        assert!(counts.get(&None).is_some_and(|kept| *kept >= 3), "{family:?}: {counts:?}");
        assert!(!counts.contains_key(&Some(Rejection::Fails)), "{family:?}: {counts:?}");
    }
}

/// Each is refused for its own reason.
#[test]
fn poor_systems_are_refused() {
    let plain = |axiom: &str, rules: &str, angle: f64| Definition {
        axiom: axiom.into(),
        rules: rules.into(),
        angle,
        ..Definition::default()
    };
    for (axiom, rules, angle, family, refusal) in [
        ("X", "X -> XX", 60.0, Family::Curve, Rejection::Empty),
        ("F", "F -> FF", 60.0, Family::Curve, Rejection::Strip),
        ("F", "F -> F+", 60.0, Family::Curve, Rejection::Growth),
        ("F", "F -> F+F+F", 120.0, Family::Curve, Rejection::Overlap),
        ("F", "F -> F+F--F+F", 60.0, Family::Curve, Rejection::Known),
        ("X", "X -> F[+X]F+X\nF -> FF", 25.0, Family::Plant, Rejection::Balance),
        ("F", "F -> F(1", 60.0, Family::Curve, Rejection::Fails),
    ] {
        assert_eq!(judge(&mut plain(axiom, rules, angle), family).err(), Some(refusal), "{axiom} {rules}");
    }
}

#[test]
fn children_differ_from_each_other_and_from_their_parents() {
    let parents = [system("abop/1.24d.json"), system("garden/sea-fan.json"), system("curves/gosper.json")];
    for parents in [&parents[..1], &parents[..2], &parents[1..], &[system("garden/summer-lime.json")]] {
        let children = breed(parents, 3, 9);
        assert_eq!(children.len(), 9);
        assert_eq!(children, breed(parents, 3, 9));
        assert_ne!(children, breed(parents, 4, 9));
        for (at, child) in children.iter().enumerate() {
            let system = System::new(child).unwrap();
            assert!(Figure::draw(&system, child.iterations, &LIMITS).is_ok());
            assert!(!children[..at].contains(child) && !parents.contains(child));
        }
    }
    let broken = Definition { axiom: "F".into(), rules: "F -> F(1".into(), ..Definition::default() };
    assert!(breed(&[broken], 1, 9).is_empty());
    assert!(breed(&[], 1, 9).is_empty());
}

#[test]
fn a_shape_stays_when_a_drawing_is_turned_and_scaled() {
    let of = |axiom: &str, step: f64| {
        let rules = "F -> F+F--F+F".into();
        let made = Definition { axiom: axiom.into(), rules, angle: 60.0, iterations: 4, step, ..Definition::default() };
        Moments::of(&lines(&figure(&made)))
    };
    assert!(of("F", 1.0).is_like(&of("++F", 7.5)));
    assert!(!of("F", 1.0).is_like(&of("F++F", 1.0)));
}
