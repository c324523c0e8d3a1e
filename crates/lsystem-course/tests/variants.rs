//! Variants of exercises, one for each student.

use lsystem_course::{Exercise, Given, Marker, Varied};
use lsystem_syntax::Definition;
use std::collections::HashSet;

fn exercise(axiom: &str, rules: &str, angle: f64, iterations: u32) -> Exercise {
    let target = Definition { axiom: axiom.into(), rules: rules.into(), angle, iterations, ..Definition::default() };
    Exercise { target, axiom: Given::Free, angle: Given::Free, ..Exercise::default() }
}

#[test]
fn no_two_variants_are_alike() {
    for (name, exercise, least) in [
        ("plant", exercise("X", "X -> F[+X]F[-X]+X\nF -> FF", 20.0, 4), 10),
        ("Koch", exercise("F", "F -> F+F--F+F", 60.0, 2), 1),
        ("by chance", exercise("F", "F -> F[+F]F : 2\nF -> F[-F]F : 1", 25.0, 3), 40),
    ] {
        let made = exercise.with_variants(&Varied::ALL);
        assert!(made.variants.len() >= least, "{name}: {}", made.variants.len());
        let all = (0..=made.variants.len()).map(|number| made.variant(number)).collect::<Vec<_>>();
        for (a, own) in all.iter().enumerate().take(6) {
            let mut marker = Marker::new(own.clone()).unwrap();
            for (b, other) in all.iter().enumerate() {
                let answer = Definition { rules: own.own_rules(&other.target.rules), ..other.target.clone() };
                // Seeds are given, so that their variants have one answer.
                let is_alike = other.target == Definition { seed: other.target.seed, ..own.target.clone() };
                assert_eq!(marker.mark(&answer).is_solved, is_alike, "{name}: {b} for {a}: {answer:?}");
            }
        }
        let read = Exercise::read(&made.write()).unwrap();
        assert_eq!(read, made);
        assert!(made.write().len() < 4 * made.variant(0).write().len() + 600, "{name}");
    }
}

#[test]
fn a_symmetric_target_has_no_mirrored_variant() {
    let made = exercise("F", "F -> F[+F][-F]", 90.0, 3).with_variants(&[Varied::Mirrored]);
    assert_eq!(made.variants, []);
}

#[test]
fn every_property_is_varied() {
    let plain = exercise("X", "X -> F[+X][-X]+X", 25.0, 3);
    let long = Exercise {
        target: Definition {
            rules: "X -> F[+\"X]-X".into(),
            overrides: "\": length * 0.8".into(),
            ..plain.target.clone()
        },
        ..plain.clone()
    };
    let factor = Exercise { target: Definition { length_factor: 0.8, ..long.target.clone() }, ..long };
    let chance = exercise("X", "X -> F[+X] : 1\nX -> F[-X]X : 1", 25.0, 3);
    let made = |exercise: &Exercise, varied| exercise.clone().with_variants(&[varied]).variants;
    assert!(made(&plain, Varied::Mirrored).iter().all(|target| target.rules == "X -> F[-X][+X]-X"));
    assert!(made(&plain, Varied::Angle).len() >= 5);
    // The same picture with other letters is no other exercise, but the same string is.
    assert_eq!(made(&plain, Varied::Letters), []);
    let text = Exercise { asks: lsystem_course::Asks::Text, ..plain };
    assert_eq!(made(&text, Varied::Letters)[0].rules, "A -> F[+A][-A]+A");
    assert!(!made(&chance, Varied::Seed).is_empty());
    assert!(made(&factor, Varied::Lengths).len() <= 3);
}

#[test]
fn a_name_has_one_variant() {
    let made = exercise("X", "X -> F[+X]F[-X]+X\nF -> FF", 20.0, 3).with_variants(&Varied::ALL);
    let count = 1 + made.variants.len();
    assert_eq!(made.variant_of("Ada Lovelace"), made.variant_of("  ada   LOVELACE "));
    let mut students = vec![0; count];
    (0..1000 * count).for_each(|number| students[made.variant_of(&format!("{number}"))] += 1);
    assert!(students.iter().all(|count| (850..1150).contains(count)), "{students:?}");
    let names = ["Ada", "Emmy", "Sophie", "Grace", "Alan", "Kurt", "Aristid", "Przemyslaw"];
    let found = names.iter().map(|name| made.variant_of(name)).collect::<HashSet<_>>();
    assert!(found.len() > 4, "{found:?}");
}
