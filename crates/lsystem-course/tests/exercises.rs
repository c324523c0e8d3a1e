//! Exercises: what students see, how answers are marked, and hints.

use crate::naive;

use lsystem_course::{Asks, Exercise, First, Given, Grade, Marker};
use lsystem_syntax::{Definition, Dialect};
use naive::systems::{one_symbol_edits, rewritings, systems};
use naive::{System, is_same};

fn system(axiom: &str, rules: &str, angle: f64, n: u32) -> Definition {
    Definition { axiom: axiom.into(), rules: rules.into(), angle, iterations: n, heading: 0.0, ..Definition::default() }
}

fn exercise(target: &Definition) -> Exercise {
    Exercise { target: target.clone(), ..Exercise::default() }
}

fn mark(exercise: &Exercise, rules: &str) -> Grade {
    Marker::new(exercise.clone()).unwrap().mark(&Definition { rules: rules.into(), ..exercise.start() })
}

fn hint(exercise: &Exercise, rules: &str) -> String {
    let marker = Marker::new(exercise.clone()).unwrap();
    marker.hint(&Definition { rules: rules.into(), ..exercise.start() }).unwrap_or_default()
}

/// Every one-symbol edit is marked as brute force on segments says, and all equivalent rules are accepted.
#[test]
fn marks_are_those_of_brute_force() {
    let (mut wrong, mut right, mut nearest) = (0, 0, 0.0_f64);
    for system in systems() {
        let mut table = [0; 4];
        let target = system.segments().unwrap();
        let mut marker =
            Marker::new(Exercise { axiom: Given::Free, angle: Given::Free, ..exercise(&system.definition()) }).unwrap();
        let edits = one_symbol_edits(&system.rules[0].1, &system.alphabet());
        let edited = edits.into_iter().map(|edit| ("edit", system.with_rule(0, edit)));
        for (kind, other) in edited.chain(rewritings(&system)) {
            let Some(segments) = other.segments() else { continue };
            let expected = is_same(&target, &segments);
            let found = marker.mark(&other.definition());
            assert_eq!((found.is_solved, found.is_same), (expected, Some(expected)), "{kind}: {other:?}: {found:?}");
            table[usize::from(kind != "edit") * 2 + usize::from(expected)] += 1;
            match expected {
                true => {
                    assert!(found.agreement > 0.999, "{kind}: {other:?}: {found:?}");
                    right += 1;
                }
                false => {
                    nearest = nearest.max(found.agreement);
                    wrong += 1;
                }
            }
        }
        let [edits_wrong, edits_right, _, rewritten] = table;
        println!(
            "{:14} {edits_wrong:4} wrong edits, {edits_right:3} right ones, {rewritten:3} rewritings",
            system.name
        );
    }
    assert!(right >= 300 && wrong >= 800 && nearest < 0.9, "{right} right, {wrong} wrong, nearest {nearest}");
}

#[test]
fn too_large_pictures_are_the_same_by_their_graphs() {
    let koch = exercise(&system("F", "F -> F+F--F+F", 60.0, 14));
    for (rules, expected) in [
        ("F -> F+F--F+F", Some(true)),
        ("F -> F+F--F+F\nX -> F", Some(true)),
        ("F -> F+F-+--F+F", Some(true)),
        ("F -> [F]F+F--F+F", Some(true)),
        ("F -> F[]+F--F+F", Some(true)),
        ("F -> F-F++F-F", Some(false)),
    ] {
        let mark = mark(&koch, rules);
        assert_eq!((mark.is_same, mark.is_solved), (expected, expected == Some(true)), "{rules}: {mark:?}");
        assert_eq!(mark.agreement > 0.98, expected != Some(false), "{rules}: {mark:?}");
    }
    // Subdivision changes the graph, so that nothing proves it.
    let hilbert = exercise(&system("X", "X -> -YF+XFX+FY-\nY -> +XF-YFY-FX+", 90.0, 12));
    let halves = "X -> -YFF+XFFX+FFY-\nY -> +XFF-YFFY-FFX+";
    let unknown = mark(&hilbert, halves);
    assert!(unknown.is_same.is_none() && !unknown.is_solved && unknown.agreement > 0.98, "{unknown:?}");
    assert!(mark(&Exercise { tolerance: Some(0.98), ..hilbert }, halves).is_solved);
    assert!(!mark(&Exercise { tolerance: Some(0.98), ..koch }, "F -> F-F++F-F").is_solved);
}

/// Rules that give the same picture are accepted where nothing can compare all segments, too; wrong ones never are.
#[test]
fn rewritings_of_too_large_pictures_are_accepted() {
    let (mut right, mut unknown) = (0, Vec::new());
    for system in systems() {
        let large = System { n: system.n + 12, ..system.clone() };
        let mut marker =
            Marker::new(Exercise { axiom: Given::Free, angle: Given::Free, ..exercise(&large.definition()) }).unwrap();
        for (kind, other) in rewritings(&large).into_iter().step_by(3) {
            let found = marker.mark(&other.definition());
            match found.is_same {
                Some(true) => right += 1,
                Some(false) => panic!("{kind}: {other:?}: {found:?}"),
                None => unknown.push((system.name, kind)),
            }
        }
        let target = system.segments().unwrap();
        for edit in one_symbol_edits(&system.rules[0].1, &system.alphabet()).into_iter().step_by(11) {
            let small = system.with_rule(0, edit.clone()).segments();
            if small.is_some_and(|segments| !is_same(&target, &segments)) {
                let found = marker.mark(&large.with_rule(0, edit).definition());
                assert!(found.is_same != Some(true), "{}: {found:?}", system.name);
            }
        }
    }
    assert!(right >= 115 && unknown.iter().all(|(_, kind)| *kind == "shorter segments"), "{right} right, {unknown:?}");
}

#[test]
fn filled_shapes_and_drawings_in_space_are_compared() {
    let leaf = exercise(&system("A", "A -> {.+F.-F.}F[+A][-A]", 25.0, 4));
    assert!(mark(&leaf, "A -> {.+F.-F.}F[-A][+A]").is_solved);
    assert!(!mark(&leaf, "A -> F[+A][-A]").is_solved, "without the leaves");
    let tree = exercise(&system("A", "A -> F[&A]////[&A]", 30.0, 5));
    assert!(mark(&tree, "A -> F[&A]////[&A]").is_solved);
    assert!(mark(&tree, "A -> F[&A][////&A]").is_solved);
    assert!(!mark(&tree, "A -> F[&A]///[&A]").is_solved);
    assert!(!mark(&tree, "A -> F[+A]--[+A]").is_solved, "in the plane");
}

/// Parts that are hidden never reach the student, and count all the same.
#[test]
fn students_see_what_is_shown() {
    let target = Definition {
        overrides: "K: draw".into(),
        dialect: Dialect::Abop,
        ..system("X", "X -> F[+X]-X\n\nF -> FF", 25.0, 4)
    };
    let mut exercise = Exercise {
        title: "A weed".into(),
        axiom: Given::Hidden,
        n: Given::Free,
        turtle: Given::Hidden,
        rules: vec![Given::Free, Given::Shown, Given::Hidden],
        first: First { n: 2, rules: "X -> F".into(), ..First::default() },
        ..exercise(&target)
    };
    let start = exercise.start();
    assert_eq!((start.axiom.as_str(), start.rules.as_str(), start.overrides.as_str()), ("", "X -> F", ""));
    assert_eq!((start.iterations, start.angle, start.title.as_str()), (2, 25.0, "A weed"));
    assert_eq!(exercise.shown_rules(), "");
    let answer =
        Definition { rules: "X -> F[+X]-X".into(), iterations: 4, axiom: "nonsense".into(), angle: 3.0, ..start };
    let whole = exercise.complete(&answer);
    assert_eq!((whole.axiom.as_str(), whole.rules.as_str()), ("X", "X -> F[+X]-X\n\nF -> FF"));
    assert_eq!((whole.angle, whole.overrides.as_str()), (25.0, "K: draw"));
    assert!(Marker::new(exercise.clone()).unwrap().mark(&answer).is_solved);
    exercise.rules = vec![Given::Shown];
    assert_eq!(exercise.shown_rules(), "X -> F[+X]-X");
    let veiled = exercise.write();
    assert_eq!(Exercise::read(&veiled).as_ref(), Ok(&exercise));
    assert!(
        lsystem_files::packed::unpack(&veiled, 1 << 20)
            .is_ok_and(|bytes| !bytes.windows(4).any(|part| part == b"X ->"))
    );
}

/// An exercise in a link of the first version. Such links are readable forever.
#[test]
fn old_exercises_stay_readable() {
    let text = "eNpNU1uPm1YYPAewuRywjS9gDhd31121W6uK1GZTR2q9AQw2y8UYsDHG4KYPfenWrdTbQ9T89rLbKMrjJ32amW9mvu98LIgEY9urbwPntNx_rdMcESlSj4CErlrFPRHUqxfhCAEZONs8eOxoqK-HQHDUzFKs7fc4QogYloWIHfHBqq48HrIQmwZop-Ku2M947cHpzMysTH7-p5C29x4rDBC5Kb14fcgt_5Leua1XgtmTElMs7dNP3hc9h5uAjpREdVhvrzvWklYVsycmVnYsdrc4ajkYM4bT8pytFHyuIujw4xbnx_zgVzN_RCqQImM0RhKoc-m4YAAtICN81tfgLYSI5JBhSihx7X05nkO0FGndfNp3guX-fhW89gIFIELOBmSI5wAzIMjtOdt27DwPbmh2KSpUm1vVRGye8ys_c38ITBv1DMdSeTz07KPz5auHq_nLd9rbXwbDO3Dt2Kl5P230xVa1YLDAAcO2k1NPV_P9rIXc86naeF4cx7s0mPNBvQiibFz1LKhi_NuJqeIua-9WWyk_dIo_fct18x3xhjKbfEblX_yxFTf8R9J1QZnhH_2QIBlETxp9_TNR_4t4d25tCInVd_a7Df7bJ-AAwQaPMKuTFdxeQQbqm1KQaUdXs-IFwUqcSrbKc0zCM12-54P1SqFaghBjKHeHF4rmvqHZkbhaixMG42uGhKtsE-e5uxyMhv5U0-gnv25lOj3k1fbWoOlJxHd1Z-Gdq3R_xchQtsI7ESRvq7p4uNHbLC-EU42is7VS1I-viRbChrnNfAX28PgrwIoyCp_xdcUtZny0f7pX5tof_BYQwpPOSEqy4iSdF22lJzzzSUkcOePrNuZ5wB2LaSJ0ld_fP1LdLtDDzgjKiRia2xmOGA5wFPLjqsnjzU2bdM-BwUp9jfiYz8f50Pin85xCNv61d3Z4rC5pIAsQd5s-J8td-txnUmOoZk6Lvbm_vLRckp70hdW6HByi7ZRq_umTvlycoIVYSJVnqwNHw_0lrRUv4Pt9KcYD71zONQ2urA0vSe0_1lmWf4aDGqlQaPg31WlZXHONPjAWRv_z-QKtD4C2KSeUkWbL_wCpzrld";
    let exercise = Exercise::read(text).unwrap();
    assert_eq!((exercise.title.as_str(), exercise.hints.len()), ("Alternating twigs", 2));
    assert_eq!(exercise.rules, [Given::Free, Given::Shown]);
    assert_eq!((exercise.axiom, exercise.asks, exercise.tolerance), (Given::Shown, Asks::Picture, None));
    let Definition { axiom, rules, angle, iterations, .. } = &exercise.target;
    assert_eq!((axiom.as_str(), rules.as_str(), *angle, *iterations), ("X", "X -> F[+X]F[-X]+X\nF -> FF", 20.0, 7));
}

#[test]
fn damaged_exercises_are_refused() {
    let text = exercise(&system("F", "F -> F+F", 90.0, 3)).write();
    for wrong in [&text[..text.len() - 9], "", "AAAA", "%", "\u{1f33f}"] {
        assert!(Exercise::read(wrong).unwrap_err().contains("damaged"), "{wrong}");
    }
    let long = Exercise {
        title: "🌿".repeat(500),
        hints: vec![String::new(); 99],
        tolerance: Some(7.0),
        ..Exercise::default()
    };
    let read = Exercise::read(&long.write()).unwrap();
    assert_eq!((read.title.chars().count(), read.hints.len(), read.tolerance), (100, 20, None));
    assert!(Marker::new(exercise(&system("F", "F -> F(", 90.0, 3))).is_err());
    assert!(Marker::new(exercise(&system("FF", "F < F -> FFFF", 90.0, 999))).is_err_and(|limits| !limits.is_empty()));
}

/// Numbers of segments beyond 128 bits are compared exactly.
#[test]
fn numbers_of_any_size_are_compared() {
    let many = |n| Exercise { asks: Asks::Segments, ..exercise(&system("F", "F -> F+F--F+F", 60.0, n)) };
    for n in [63, 64, 128, 300] {
        assert!(mark(&many(n), "F -> FF+FF").is_solved, "{n}");
        let wrong = mark(&many(n), "F -> FF");
        assert!(!wrong.is_solved && wrong.is_same == Some(false) && wrong.percent() == "0.0 %", "{n}: {wrong:?}");
        assert_ne!(wrong.segments[0], wrong.segments[1], "{n}");
    }
    assert!(mark(&many(300), "F -> FFF").words.contains("of about 4.14 × 10^180 segments"));
    // One segment more than 4^70, where an `f64` does not tell the difference.
    let target = system("FG", "F -> FFFF", 90.0, 70);
    let near = Exercise { asks: Asks::Segments, axiom: Given::Free, tolerance: Some(1.0), ..exercise(&target) };
    let own = Definition { axiom: "F".into(), rules: "F -> FFFF".into(), ..near.start() };
    let own = Marker::new(near).unwrap().mark(&own);
    assert!(!own.is_solved && own.percent() == "99.9 %", "{own:?}");
    // A count that depends on chance is not known beyond 128 bits.
    let chance = system("F", "F -> FFFF: 1\nF -> FFFF+: 1", 90.0, 100);
    let unknown = Exercise { asks: Asks::Segments, tolerance: Some(0.5), ..exercise(&chance) };
    if let Ok(mut marker) = Marker::new(unknown.clone()) {
        let grade = marker.mark(&Definition { rules: "F -> FF".into(), ..unknown.start() });
        assert!(!grade.is_solved, "{grade:?}");
    }
}

/// Drawings and sizes beyond the range of numbers are not called equal.
#[test]
fn what_is_beyond_the_range_of_numbers_is_not_solved() {
    let grown = |factor: f64, n: u32| Definition { length_factor: factor, ..system("X", "X -> F[+X]F!X", 90.0, n) };
    for (n, rules) in [(1000, "X -> F[-X]FFX"), (1000, "X -> F+X")] {
        for tolerance in [None, Some(0.5), Some(1.0)] {
            let target = Definition { dialect: Dialect::Abop, ..grown(1e300, n) };
            let exercise = Exercise { tolerance, ..exercise(&target) };
            let Ok(mut marker) = Marker::new(exercise.clone()) else { continue };
            let grade = marker.mark(&Definition { rules: rules.into(), ..exercise.start() });
            assert!(!grade.is_solved, "{n} {rules} {tolerance:?} {grade:?}");
        }
    }
}

#[test]
fn other_things_can_be_asked() {
    let doubling = Exercise { asks: Asks::Text, ..exercise(&system("A", "A -> AB\nB -> A", 90.0, 6)) };
    assert!(mark(&doubling, "B -> A\nA -> AB").is_solved);
    let wrong = mark(&doubling, "A -> AB\nB -> B");
    assert!(
        !wrong.is_solved
            && wrong.words.contains("The first 2 symbols agree. Length of your string: 7; of the target: 21."),
        "{wrong:?}"
    );
    let many = Exercise { asks: Asks::Segments, ..exercise(&system("F", "F -> F+F--F+F", 60.0, 3)) };
    assert!(mark(&many, "F -> FF[F]F").is_solved);
    assert!(mark(&many, "F -> FFF").words.contains("27 of 64 segments"));
    let short = Exercise { most_symbols: Some(9), ..exercise(&system("F", "F -> F+F--F+F", 60.0, 3)) };
    assert!(mark(&short, "F -> F+F--F+F").is_solved);
    let long = mark(&short, "F -> F+F---+F+F");
    assert!(!long.is_solved && long.is_same == Some(true) && long.symbols == 11, "{long:?}");
    assert!(long.words.contains("at most 9"), "{long:?}");
}

#[test]
fn random_plants_are_marked_by_their_statistics() {
    let weed = system("F", "F -> F[+F]F[-F]F : 0.5\nF -> F[+F]F : 0.5", 25.7, 3);
    let exercise = Exercise { asks: Asks::Statistics, ..exercise(&weed) };
    assert!(mark(&exercise, "F -> F[+F]F : 1\nF -> F[+F]F[-F]F : 1").is_solved);
    for wrong in
        ["F -> F[+F]F[-F]F", "F -> F[+F]F[-F]F : 0.7\nF -> F[+F]F : 0.3", "F -> F[+F]F : 0.5\nF -> F[-F]F[-F]F : 0.5"]
    {
        let mark = mark(&exercise, wrong);
        assert!(!mark.is_solved && mark.agreement < 0.9, "{wrong}: {mark:?}");
    }
}

#[test]
fn errors_of_answers_are_told() {
    let koch = exercise(&system("F", "F -> F+F--F+F", 60.0, 3));
    let broken = mark(&koch, "F -> F(");
    assert!(!broken.is_solved && broken.agreement == 0.0 && broken.errors.len() == 1, "{broken:?}");
    let endless = mark(
        &koch,
        "F < F -> FFFFFFFFFFFFFFFFFFFFFFFFF+F\nF -> FFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFFF",
    );
    assert!(!endless.is_solved, "{endless:?}");
}

#[test]
fn hints_name_what_is_wrong() {
    let koch = exercise(&system("F", "F -> F+F--F+F", 60.0, 3));
    let bush = Exercise { angle: Given::Free, n: Given::Free, ..exercise(&system("F", "F -> F[+F]F[-F][F]", 20.0, 4)) };
    let answer = |rules: &str, angle, iterations| {
        let marker = Marker::new(bush.clone()).unwrap();
        marker.hint(&Definition { rules: rules.into(), angle, iterations, ..bush.start() }).unwrap_or_default()
    };
    for (found, expected) in [
        (hint(&koch, "F -> F-F++F-F"), "mirror image"),
        (hint(&koch, "# nothing yet"), "no rule yet"),
        (hint(&koch, "F -> X"), "rewritten away"),
        (hint(&koch, "F -> F+F--F+FF-F"), "first"),
        (answer("F -> F[+F]F[-F][F]", 20.0, 3), "The same after one more iteration."),
        (answer("F -> F[+F]F[-F][F]", 25.0, 4), "the angle is not"),
        (answer("F -> F[+F]F[-F][F][F][F]", 20.0, 4), "Right outline, too many segments"),
    ] {
        assert!(found.to_lowercase().contains(&expected.to_lowercase()), "{expected}: {found}");
    }
}

/// A target of one segment, whose stroke would be a tenth of it, is shown with a thin stroke; so is every answer.
#[test]
fn pictures_are_shown_with_strokes_of_one_width() {
    let mut target = system("F", "F -> F", 90.0, 1);
    target.style.width = 0.1;
    let marker = Marker::new(exercise(&target)).unwrap();
    let style = marker.shown_style();
    assert_eq!((style.width, style.min_width), (0.0, 3.0));
    let pixels = marker.picture(320, 320, 1.0).unwrap();
    let ink = pixels.chunks(4).filter(|pixel| pixel[..3] != pixels[..3]).count();
    // A line of 3 x 282 pixels.
    assert!((700..1500).contains(&ink), "{ink}");
    let fine = Definition { iterations: 7, rules: "F -> F+F--F+F".into(), ..target };
    assert!(Marker::new(exercise(&fine)).unwrap().shown_style().min_width < 1.5);
}

#[test]
fn wind_does_not_change_the_mark() {
    let target = Definition { wind: [8.0, 90.0], heading: 80.0, ..system("F[+F]F[-F]", "F -> FF", 25.0, 0) };
    let windy = Exercise { axiom: Given::Free, n: Given::Free, ..exercise(&target) };
    assert_eq!(Exercise::read(&windy.write()).unwrap().start().wind, [0.0; 2]);
    // The same picture after another number of steps, in another wind.
    let student = Definition { axiom: "A".into(), rules: "A -> F[+F]F[-F]".into(), iterations: 1, ..target };
    let grade = Marker::new(windy).unwrap().mark(&Definition { wind: [3.0, 0.0], ..student });
    assert!(grade.is_solved && grade.is_same == Some(true), "{grade:?}");
}

#[test]
fn an_answer_tells_for_which_generations_it_is_right() {
    let plant = exercise(&system("X", "X -> F[+X]-X\nF -> FF", 25.0, 4));
    let two = exercise(&system("F", "F -> F+F--F+F", 60.0, 2));
    let every = "The picture is the same, at every number of iterations.";
    for (exercise, rules, words) in [
        (&plant, "X -> F[+X]-X\nF -> FF", every),
        (&plant, "F -> FF\nX -> F[+Y]-X\nY -> F[+X]-Y", every),
        (&plant, "X -> F[+qX]-X\nF -> FF", every),
        // Another order of branches is another word.
        (&exercise_of_two_branches(), "X -> F[-X][+X]", "The picture is the same, for n up to 4."),
        // Right at n = 2 only.
        (&two, "F -> K+K--K+K\nK -> F+F--F+F", "The picture is the same."),
        (&two, "F -> KKKK\nK -> F", "of the ink agrees."),
    ] {
        let grade = mark(exercise, rules);
        assert!(grade.words.contains(words), "{rules}: {grade:?}");
    }
}

fn exercise_of_two_branches() -> Exercise {
    exercise(&system("X", "X -> F[+X][-X]", 25.0, 4))
}
