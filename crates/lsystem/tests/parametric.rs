//! Blocks shared among modules with parameters, compared with the naive turtle, and the systems that share blocks.

use crate::naive;
use lsystem::syntax::Kind;
use lsystem::{Definition, Drawing, Limits, Plane, System, count_segments, count_symbols, draw};
use proptest::prelude::*;

fn system(axiom: &str, rules: &str) -> System {
    let definition = Definition { axiom: axiom.into(), rules: rules.into(), angle: 25.0, ..Definition::default() };
    System::new(&definition).unwrap_or_else(|diagnostics| panic!("{definition:?}: {diagnostics:?}"))
}

fn drawn(system: &System, n: u32) -> Drawing {
    draw::<Plane>(system, n, &Limits::default()).unwrap()
}

/// A module of a successor, for a production with the parameters x and y: letters that draw, turn and grow. Arguments
/// are taken from `lengths` for lengths, from `numbers` otherwise.
fn module(lengths: &[&'static str], numbers: &[&'static str]) -> BoxedStrategy<String> {
    let length = || prop::sample::select(lengths.to_vec());
    let number = || prop::sample::select(numbers.to_vec());
    prop_oneof![
        2 => length().prop_map(|l| format!("F({l})")),
        2 => (length(), number()).prop_map(|(l, k)| format!("A({l},{k})")),
        2 => (length(), number()).prop_map(|(l, k)| format!("B({l},{k})")),
        1 => length().prop_map(|l| format!("f({l})")),
        1 => length().prop_map(|l| format!("C({l})")),
        1 => number().prop_map(|k| format!("!({k})")),
        1 => number().prop_map(|k| format!("+({k})")),
        1 => number().prop_map(|k| format!("'({k})")),
        1 => prop::sample::select(vec!["+", "-(40)", "$", "&(30)", "|", ";", "E"]).prop_map(str::to_owned),
    ]
    .boxed()
}

/// A word with balanced branches.
fn word(module: BoxedStrategy<String>) -> impl Strategy<Value = String> {
    let run = move || prop::collection::vec(module.clone(), 0..3).prop_map(|modules| modules.concat());
    let branch = (run(), run(), run()).prop_map(|(before, inside, after)| format!("{before}[{inside}]{after}"));
    prop_oneof![run(), branch.clone(), (branch, run()).prop_map(|(a, b)| format!("[{a}]{b}"))]
}

/// Systems with lengths that scale together, and others.
fn systems(scaling: bool, conditions: bool) -> impl Strategy<Value = System> {
    let lengths = if scaling {
        vec!["x", "x*r", "x*0.6", "x/3*2", "x - x*0.25", "max(x, x*q)", "-x", "y*x"]
    } else {
        vec!["x", "x*r", "x + 1", "x - y", "2", "x*y", "abs(x)^0.5", "floor(x)", "x*0.1"]
    };
    let numbers = vec!["y", "y*q", "2", "y/2", "r"];
    let tests = if conditions { vec!["", " : y > 0.3", " : y*2 < 3", " : not (y = 1)"] } else { vec![""] };
    let rule = move |head: &'static str| {
        let (tests, made) = (tests.clone(), word(module(&lengths, &numbers)));
        (prop::sample::select(tests), made).prop_map(move |(test, made)| format!("{head}{test} -> {made}\n"))
    };
    let rules = (rule("A(x,y)"), rule("B(x,y)"), rule("A(x,y)"));
    let images = prop::sample::select(vec!["", "draw:\nC(x) -> F(x)[+F(x*r)]", "draw:\nE -> +(r)\nC(x) -> f(x)C(x)"]);
    let axiom = prop::sample::select(vec!["A(1,2)B(3,1)", "[A(2,1)", "B(0.5,1.5)]A(-1,1)", "A(0,1)F(2)C(1)"]);
    (axiom, rules, images)
        .prop_map(|(axiom, (a, b, c), images)| system(axiom, &format!("r = 0.75\nq = 0.9\n{a}{b}{c}{images}")))
}

/// The most iterations, up to `most`, for which the naive reference is fast.
fn affordable(system: &System, most: u32) -> Option<u32> {
    let fits = |n: &u32| {
        let word = naive::modules(&system.grammar, system.seed, *n);
        word.is_some_and(|w| w.len() < 800 && naive::images(&system.grammar, system.seed, &w).is_some())
    };
    (0..=most).take_while(fits).last()
}

/// Checks that the drawing equals that of the naive turtle, to 1e-9 of its extent.
fn check(system: &System, n: u32) -> Result<Drawing, TestCaseError> {
    let drawing = drawn(system, n);
    let expected = naive::limited_segments(system, n, drawing.bounds());
    prop_assert_eq!(drawing.segment_count(), expected.len() as u128);
    let word = naive::modules(&system.grammar, system.seed, n).unwrap();
    prop_assert_eq!(drawing.symbol_count(), Some(word.len() as u64));
    let tolerance = naive::bounds(&expected).map_or(0.0, |[x0, y0, x1, y1]| 1e-9 * (x1 - x0).max(y1 - y0) + 1e-13);
    for (a, b) in drawing.segments().zip(&expected) {
        for (a, b) in a.from.into_iter().chain(a.to).zip(b.from.into_iter().chain(b.to)) {
            prop_assert!((a - b).abs() <= tolerance, "{} {}", a, b);
        }
        prop_assert_eq!((a.colour, a.level), (b.colour, b.level));
        prop_assert!((a.width - b.width).abs() <= 1e-9 * b.width, "{:?} {:?}", a, b);
        prop_assert!((a.end_width - b.end_width).abs() <= 1e-9 * b.end_width, "{:?} {:?}", a, b);
    }
    let bounds = drawing.bounds().into_iter().flatten().zip(naive::bounds(&expected).into_iter().flatten());
    for (a, b) in bounds {
        prop_assert!((a - b).abs() <= tolerance, "{} {}", a, b);
    }
    Ok(drawing)
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn lengths_that_scale_together(system in systems(true, false), n in 0_u32..8) {
        let Some(n) = affordable(&system, n) else { return Ok(()) };
        prop_assert!(check(&system, n)?.is_memoised());
    }

    #[test]
    fn conditions_on_other_parameters(system in systems(true, true), n in 0_u32..8) {
        let Some(n) = affordable(&system, n) else { return Ok(()) };
        prop_assert!(check(&system, n)?.is_memoised());
    }

    #[test]
    fn parameters_of_any_kind(system in systems(false, true), n in 0_u32..8) {
        let Some(n) = affordable(&system, n) else { return Ok(()) };
        prop_assert!(check(&system, n)?.is_memoised());
    }
}

#[test]
fn a_tree_of_two_ratios_at_once() {
    let tree = system("A(1)", "A(l) -> F(l)[+(30)A(l*0.7)][-(40)A(l*0.6)]");
    let drawing = drawn(&tree, 40);
    assert!(drawing.is_memoised());
    assert_eq!(drawing.segment_count(), (1 << 40) - 1);
    assert_eq!(count_segments(&tree, 40).unwrap(), drawing.segment_count().into());
    // One block for each number of steps, independent of lengths.
    assert_eq!(drawing.block_count(), 40 + 1);
    assert_eq!(drawn(&tree, 1000).block_count(), 1000 + 1);
}

#[test]
fn widths_of_another_scale_and_lengths_that_end() {
    // ABOP, figure 2.6a in the plane: the step determines the width, so each step has three states.
    let honda = system(
        "A(1,10)",
        "r1 = 0.9\nr2 = 0.6\nwr = 0.707\n\
         A(l,w) -> !(w)F(l)[&(45)B(l*r2,w*wr)]/(137.5)A(l*r1,w*wr)\n\
         B(l,w) -> !(w)F(l)[-(45)$C(l*r2,w*wr)]C(l*r1,w*wr)\n\
         C(l,w) -> !(w)F(l)[+(45)$B(l*r2,w*wr)]B(l*r1,w*wr)",
    );
    let drawing = drawn(&honda, 40);
    assert!(drawing.is_memoised() && drawing.block_count() <= 3 * 40, "{} blocks", drawing.block_count());
    assert_eq!(count_symbols(&honda, 40).unwrap(), u128::from(drawing.symbol_count().unwrap()).into());
    // With a condition on a length, only equal numbers share a block, here also if multiplied in another order.
    let ending = system("A(1)", "A(l) : l > 0.001 -> F(l)[+(30)A(l*0.7)][-(40)A(l*0.6)]");
    let drawing = drawn(&ending, 40);
    assert!(drawing.is_memoised() && drawing.block_count() < 2_000, "{} blocks", drawing.block_count());
    let whole = system("A(1)", "A(l) : l > 0.001 and random(0, 1) < 2 -> F(l)[+(30)A(l*0.7)][-(40)A(l*0.6)]");
    let plain = drawn(&whole, 25);
    assert!(!plain.is_memoised());
    assert_eq!(plain.segment_count(), drawing.segment_count());
}

#[test]
fn too_many_states_are_drawn_one_by_one() {
    // All modules are different.
    let apart = system("A(1,1)", "A(x,k) -> F(x)[+(k)A(x*0.9,k*2)][-(k)A(x*0.9,k*2 + 1)]");
    let drawing = drawn(&apart, 17);
    assert!(!drawing.is_memoised());
    assert_eq!(drawing.segment_count(), (1 << 17) - 1);
    let kind = draw::<Plane>(&apart, 40, &Limits::default()).unwrap_err().kind;
    assert!(matches!(kind, Kind::Limit { largest: Some(19..=21), .. }), "{kind:?}");
    // If unfolding manages fewer steps, the diagnostic names the largest n of sharing.
    let ending = system("A(1,1)", "A(x,k) -> F(x)[+(k)A(x*0.9,k*2)][-(k)A(x*0.9,k*2 + 1)]F(x)F(x)");
    let limits = Limits { segments: 1000, ..Limits::default() };
    let kind = draw::<Plane>(&ending, 40, &limits).unwrap_err().kind;
    assert!(matches!(kind, Kind::Limit { largest: Some(_), .. }), "{kind:?}");
}
