//! Published systems with contexts and parameters, through the notation.

use crate::naive;
use lsystem::derive::{Rewriter, Template};
use lsystem::drawing::{expand_once, expand_symbol};
use lsystem::syntax::Kind;
use lsystem::{Definition, Limits, System, count_symbols, expand};
use std::sync::Arc;

fn system(axiom: &str, rules: &str) -> System {
    let definition = Definition { axiom: axiom.into(), rules: rules.into(), angle: 22.5, ..Definition::default() };
    System::new(&definition).unwrap_or_else(|diagnostics| panic!("{diagnostics:?}"))
}

/// ABOP, figure 1.31, after Hogeweg and Hesper: successors for the contexts `0 < 0 > 0` to `1 < 1 > 1`.
fn hogeweg_hesper(successors: [&str; 8]) -> System {
    let mut rules = "ignore: +-F\n".to_owned();
    for (index, successor) in successors.into_iter().enumerate() {
        let [left, strict, right] = [index >> 2 & 1, index >> 1 & 1, index & 1];
        rules.push_str(&format!("{left} < {strict} > {right} -> {successor}\n"));
    }
    system("F1F1F1", &(rules + "+ -> -\n- -> +"))
}

/// ABOP, figure 2.6 a, after Honda.
fn honda() -> System {
    let constants = "r1 = 0.9\nr2 = 0.6\na0 = 45\na2 = 45\nd = 137.5\nwr = 0.707\n";
    let rules = "A(l,w) -> !(w)F(l)[&(a0)B(l*r2,w*wr)]/(d)A(l*r1,w*wr)\n\
                 B(l,w) -> !(w)F(l)[-(a2)$C(l*r2,w*wr)]C(l*r1,w*wr)\n\
                 C(l,w) -> !(w)F(l)[+(a2)$B(l*r2,w*wr)]B(l*r1,w*wr)";
    system("A(1,10)", &format!("{constants}{rules}"))
}

/// The modules of generation `n`.
fn modules(system: &System, n: u32) -> usize {
    let mut rewriter = Rewriter::new(system.rules.clone(), system.seed, Limits::default()).unwrap();
    while rewriter.generation() < n {
        rewriter.step(usize::MAX).unwrap();
    }
    rewriter.word().letters.len()
}

#[test]
fn figure_1_31_has_the_published_sizes() {
    let a = hogeweg_hesper(["0", "1[+F1F1]", "1", "1", "0", "1F1", "0", "0"]);
    assert_eq!(modules(&a, 30), 6_910);
    assert_eq!(expand(&a, 30, &Limits::default()).unwrap().len(), 6_910);
    assert_eq!(count_symbols(&a, 30), None);
    assert_eq!(modules(&a, 60), 9_239_061);
}

#[test]
fn figures_1_31_b_to_e_derive() {
    let sizes = [
        (["1", "1[-F1F1]", "1", "1", "0", "1F1", "1", "0"], 30, 19_199),
        (["0", "1", "0", "1[+F1F1]", "0", "1F1", "0", "0"], 26, 2_926),
        (["1", "0", "0", "1F1", "1", "1[+F1F1]", "1", "0"], 24, 7_145),
        (["0", "1[-F1F1]", "1", "1", "0", "1F1", "1", "0"], 26, 2_428),
    ];
    for (successors, n, expected) in sizes {
        let system = hogeweg_hesper(successors);
        assert_eq!(modules(&system, n), expected);
        // A generation near the end, derived by the naive reference.
        assert_eq!(modules(&system, 18), naive::modules(&system.grammar, 0, 18).unwrap().len());
    }
}

#[test]
fn figure_2_6_has_the_published_sizes() {
    let tree = honda();
    assert_eq!(modules(&tree, 10), 7_162);
    assert_eq!(modules(&tree, 17), 917_498);
    // Every letter always has the same successor, so the count needs no derivation.
    assert_eq!(count_symbols(&tree, 17).unwrap(), 917_498_u64.into());
    let text = expand(&tree, 1, &Limits::default()).unwrap();
    assert_eq!(text, "!(10)F(1)[&(45)B(0.6,7.069999999999999)]/(137.5)A(0.9,7.069999999999999)");
}

/// ABOP, section 3.2.3, the shedding of branches: each branch lives for three steps and leaves a scar.
#[test]
fn branches_are_shed() {
    let tree =
        system("A", "A -> F(1)[-X(3)B][+X(3)B]A\nB -> F(1)B\nX(d) : d > 0 -> X(d-1)\nX(d) : d == 0 -> U%\nU -> F(0.3)");
    let at = |n| expand(&tree, n, &Limits::default()).unwrap();
    assert_eq!(at(2), "F(1)[-X(2)F(1)B][+X(2)F(1)B]F(1)[-X(3)B][+X(3)B]A");
    assert!(at(5).starts_with("F(1)[-U%F(1)F(1)F(1)F(1)B][+U%F(1)F(1)F(1)F(1)B]F(1)[-X(0)F(1)F(1)F(1)B]"));
    assert!(at(6).starts_with("F(1)[-F(0.3)][+F(0.3)]F(1)[-U%F(1)"));
    assert!(at(20).starts_with(&"F(1)[-F(0.3)][+F(0.3)]".repeat(15)));
    // The counts depend on cuts.
    assert_eq!(count_symbols(&tree, 20), None);
}

#[test]
fn plain_systems_are_cut_too() {
    let system = system("A", "A -> F[+B]A\nB -> FC\nC -> %F");
    assert_eq!(expand(&system, 4, &Limits::default()).unwrap(), "F[+F]F[+F%F]F[+FC]F[+B]A");
    let drawn = lsystem::draw::<lsystem::Plane>(&system, 4, &Limits::default()).unwrap();
    assert_eq!((drawn.segment_count(), drawn.symbol_count()), (8, Some(24)));
    assert_eq!(lsystem::count_segments(&system, 4), None);
}

#[test]
fn single_steps_lead_to_the_same_words() {
    let shedding = system(
        "A(1)",
        "r = 0.5\nA(x) : x > 0.1 -> F(x)[+A(x*r)]A(x/3)\nF(x) < A(y) -> A(y)B%F\nB -> b : 1\nB -> c : 2",
    );
    for system in [hogeweg_hesper(["0", "1[+F1F1]", "1", "1", "0", "1F1", "0", "0"]), honda(), shedding] {
        let mut word = expand(&system, 0, &Limits::default()).unwrap();
        for n in 1..8 {
            // Modules have the keys of an axiom, so random choices may differ. Letters without choices agree.
            let next = expand_once(&system, &word, n);
            let whole = expand(&system, n, &Limits::default()).unwrap();
            let alike = |text: &str| text.replace('c', "b");
            assert_eq!(alike(&next), alike(&whole), "{n}");
            word = whole;
        }
    }
    let system = system("AB(2)", "A -> FB(1) : 1\nA -> G : 3\nB(x) -> B(x + 1)\nC < A -> *");
    assert_eq!(expand_symbol(&system, 'A', 0.2), "FB(1)");
    assert_eq!(expand_symbol(&system, 'A', 0.3), "G");
    assert_eq!(expand_symbol(&system, 'X', 0.3), "X");
    assert_eq!(expand_once(&system, "B(2.5)CAX", 1), "B(3.5)CX");
    assert_eq!(expand_once(&system, "B(", 1), "B(");
}

#[test]
fn a_text_too_long_says_how_far_it_goes() {
    let limits = Limits { symbols: 10_000, ..Limits::default() };
    let tree = honda();
    let Kind::Limit { largest: Some(n), .. } = expand(&tree, 12, &limits).unwrap_err().kind else {
        panic!("the largest generation is known")
    };
    assert!(expand(&tree, n, &limits).is_ok() && expand(&tree, n + 1, &limits).is_err(), "{n}");
}

/// A system of `data_in/abop`, and its number of iterations.
fn file(name: &str) -> (System, u32) {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../data_in/abop/{name}.json"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let definition = lsystem::read_json(&text).0.unwrap();
    (System::new(&definition).unwrap(), definition.iterations)
}

/// ABOP, figures 1.7 and 1.9: the number of segments that replace one, and islands that close.
#[test]
fn koch_curves_have_the_published_sizes() {
    let sizes = [("1.7a", 4, 18), ("1.9a", 4, 8), ("1.9b", 4, 7), ("1.9c", 4, 7), ("1.9e", 4, 5), ("1.9f", 4, 5)];
    for (name, sides, parts) in [&sizes[..], &[("1.7b", 1, 5)]].concat() {
        let (system, n) = file(name);
        let drawing = lsystem::draw::<lsystem::Plane>(&system, n, &Limits::default()).unwrap();
        assert_eq!(drawing.segment_count(), sides * u128::pow(parts, n), "{name}");
        let ends: Vec<_> = drawing.segments().map(|segment| (segment.from, segment.to)).collect();
        let (first, last) = (ends[0].0, ends[ends.len() - 1].1);
        assert_eq!(first == last, sides == 4, "{name}");
    }
    // The generators of figure 1.7 replace six and three segments in a row.
    for (name, length) in [("1.7a", 6.0), ("1.7b", 3.0)] {
        let (system, _) = file(name);
        let mut system = system;
        Arc::make_mut(&mut system.rules).axiom = Template { letters: vec![2], arguments: vec![] };
        assert_eq!(system.rules.symbol(2), 'F');
        let drawing = lsystem::draw::<lsystem::Plane>(&system, 1, &Limits::default()).unwrap();
        let last = drawing.segments().last().unwrap();
        assert_eq!(last.to, [0.0, length], "{name}");
    }
}

/// ABOP, figure 1.30: the symbol G is a segment that the signal has reached.
#[test]
fn signals_travel_along_the_axis() {
    for (name, reached) in [("1.30a", "G[+G]G[-G]G[+G]G"), ("1.30b", "G[+F]G[-F]G[+F]G")] {
        let (system, _) = file(name);
        let counts: Vec<usize> =
            (0..=4).map(|n| expand(&system, n, &Limits::default()).unwrap().matches('G').count()).collect();
        assert_eq!(expand(&system, 4, &Limits::default()).unwrap(), reached);
        assert_eq!(counts, if name == "1.30a" { [1, 3, 5, 7, 7] } else { [1, 2, 3, 4, 4] }, "{name}");
    }
}
