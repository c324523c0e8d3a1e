//! Drawings against the naive reference.

mod naive;

use lsystem::{Grammar, Module, Production};

fn modules(text: &str) -> Vec<Module> {
    text.chars().map(Module::from).collect()
}

#[test]
fn the_reference_rewrites() {
    let rule = |p: char, successor| Production { predecessor: p.into(), successor: modules(successor), weight: None };
    let grammar =
        Grammar { axiom: modules("X"), productions: vec![rule('X', "F[+X]"), rule('F', "FF")], constants: vec![] };
    assert_eq!(naive::expand(&grammar, 0, 2), "FF[+F[+X]]");
}
