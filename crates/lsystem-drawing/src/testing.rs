//! What the tests of several files share.

use crate::{Rules, System, Turtle};
use lsystem_syntax::{Grammar, Module, Production, Style};
use std::sync::Arc;

/// How many cases a property test tries: 500, or what the environment variable `LSYSTEM_CASES` says.
pub(crate) fn cases() -> u32 {
    std::env::var("LSYSTEM_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(500)
}

/// Predecessor, successor, weight.
pub(crate) type Rule<'a> = (char, &'a str, Option<f64>);

/// A system whose letters do nothing.
pub(crate) fn system(axiom: &str, rules: &[Rule], seed: u32) -> System {
    let modules = |text: &str| text.chars().map(Module::from).collect::<Vec<_>>();
    let productions = rules.iter().map(|&(predecessor, successor, weight)| {
        let production = Production::new(predecessor, modules(successor));
        weight.map_or(production.clone(), |weight| production.weighted(weight))
    });
    let grammar = Grammar { axiom: modules(axiom), productions: productions.collect(), ..Grammar::default() };
    let rules = Arc::new(Rules::new(&grammar, vec![], |_| false, false).expect("weights are numbers"));
    let turtle = Turtle { actions: vec![vec![]; rules.letters.len()], ..Turtle::default() };
    System { grammar, rules, turtle, style: Style::default(), seed }
}
