//! Curves in rules: their values in derivations, their messages, and their printing.

use crate::naive;
use lsystem::base::Limits;
use lsystem::syntax::{Definition, parse, print_rules};
use lsystem::{System, expand};

fn told(rules: &str) -> Vec<String> {
    let definition = Definition { axiom: "A(1)".into(), rules: rules.into(), ..Definition::default() };
    System::problems(&definition).iter().map(|problem| problem.message.clone()).collect()
}

#[test]
fn a_curve_is_a_function_in_arguments_conditions_weights_and_constants() {
    // Two points are a line, so the values are known.
    let rules = "curve half = (0, 0) (10, 5)\nr = half(4) + 1\n\
        A(x) : half(x) < 2.5 -> F(half(x))A(x + half(2))\nA(x) : half(x) >= 2.5 -> B(r, half(99), half(-1))";
    let definition = Definition { axiom: "A(2)".into(), rules: rules.into(), ..Definition::default() };
    let system = System::new(&definition).unwrap();
    assert_eq!(expand(&system, 4, &Limits::default()).unwrap(), "F(1)F(1.5)F(2)B(3,5,0)");
}

#[test]
fn derivations_with_curves_are_those_of_the_naive_one() {
    let rules = "curve taper = (0, 1) (0.2, 0.9) (0.5, 0.1) (0.5, 0.8) (1, 0.3)\n\
        A(x, l) : taper(x) > 0.35 -> F(l)[+(30*taper(1 - x))A(x + 0.2, l*taper(x))]A(x + 0.1, l)\nA(x, l) -> F(l) : taper(x)";
    let definition = Definition { axiom: "A(0, 1)".into(), rules: rules.into(), ..Definition::default() };
    let system = System::new(&definition).unwrap();
    for n in 0..8 {
        let word = naive::modules(&system.grammar, system.seed, n).unwrap();
        let written = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        let word = word.iter().map(|module| match &module.arguments[..] {
            [] => module.symbol.to_string(),
            values => format!("{}({})", module.symbol, written(values)),
        });
        assert_eq!(expand(&system, n, &Limits::default()).unwrap(), word.collect::<String>());
    }
}

#[test]
fn wrong_curves_are_told_with_their_places() {
    let use_it = "\nA(x) -> F(c(x))";
    for (curve, message) in [
        ("curve c = (0, 1)", "This curve has 1 point"),
        ("curve c = (0, 1) (0, 2)", "This curve has 2 points"),
        ("curve c =", "This curve has 0 points"),
        ("curve c = (0, 1) (2, 1) (1, 1)", "This point lies to the left of the point before it"),
        ("curve c = (0, 1) 2 (1, 1)", "`2` is not a point of a curve"),
        ("curve c = (0, 1) (1, 1, 1)", "`(1,1,1)` is not a point of a curve"),
        ("curve c = (0, 1) (1", "`(` is not a point of a curve"),
        ("curve 1c = (0, 1) (1, 2)", "`1c` cannot be the name"),
        ("curve sin = (0, 1) (1, 2)", "`sin` is defined already"),
        ("c = 1\ncurve c = (0, 1) (1, 2)", "`c` is defined already"),
    ] {
        let found = told(&format!("{curve}{use_it}"));
        assert!(found.iter().any(|one| one.contains(message)), "{curve}: {found:?}");
    }
    let good = "curve c = (0, 1), (1, 2)\n";
    assert!(told(&format!("{good}A(x) -> F(c)"))[0].contains("`c` needs its argument in parentheses"));
    assert!(!told(&format!("{good}A(x) -> F(c(x, 2))")).is_empty());
    assert!(told(&format!("{good}A(x) -> F(x)"))[0].contains("Nothing uses the curve `c`"));
    assert!(told(&format!("{good}A(c) -> F(c(2))")).iter().any(|one| one.contains("`c` is not a function")));
    assert!(told(&format!("{good}A(x) -> F(c(x))")).is_empty());
}

#[test]
fn curves_print_and_read_back() {
    let rules = "curve c = (0, 1e-7) (0.5, -3) (0.5, 2)\nA(x) -> F(-c(x + 1)^2*c(c(x)))";
    let (grammar, _) = parse("A(1)", rules);
    assert_eq!(parse("A(1)", &print_rules(&grammar)).0, grammar);
    assert_eq!(print_rules(&grammar), "curve c = (0, 1e-7) (0.5, -3) (0.5, 2)\nA(x) -> F(-c(x + 1)^2*c(c(x)))");
}
