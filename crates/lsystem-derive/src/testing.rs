//! Helpers for the tests of several files.

use crate::{Counter, Rules, Tally};
use lsystem_base::{Limits, Meter};
use lsystem_syntax::{Diagnostic, Grammar, Module, Production};
use std::sync::Arc;

/// Predecessor, successor, weight.
pub(crate) type TestRule<'a> = (char, &'a str, Option<f64>);

/// A system to derive.
pub(crate) struct TestSystem {
    pub(crate) grammar: Grammar,
    pub(crate) rules: Arc<Rules>,
    pub(crate) seed: u32,
}

pub(crate) fn system(axiom: &str, rules: &[TestRule], seed: u32) -> TestSystem {
    let modules = |text: &str| text.chars().map(Module::from).collect::<Vec<_>>();
    let productions = rules.iter().map(|&(predecessor, successor, weight)| {
        let production = Production::new(predecessor, modules(successor));
        weight.map_or(production.clone(), |weight| production.weighted(weight))
    });
    let grammar = Grammar { axiom: modules(axiom), productions: productions.collect(), ..Grammar::default() };
    let rules = Arc::new(Rules::new(&grammar, vec![], |_| false, false).expect("weights are numbers"));
    TestSystem { grammar, rules, seed }
}

pub(crate) fn expand(system: &TestSystem, n: u32, limits: &Limits) -> Result<String, Diagnostic> {
    let mut text = String::new();
    crate::derive_string(&system.rules, system.seed, n, limits, &mut text, &mut Meter::new(u64::MAX)).map(|()| text)
}

pub(crate) fn count_symbols(system: &TestSystem, n: u32) -> Option<Tally> {
    Counter::symbols(&system.rules, n).finish()
}
