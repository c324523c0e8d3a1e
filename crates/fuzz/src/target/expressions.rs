//! Arithmetic: expressions have the values of the naive reference.

use crate::make::{expression, random_pieces};
use crate::{Gauge, Source, naive};
use lsystem::derive::Rewriter;
use lsystem::syntax::{parse, print_axiom, print_rules};
use lsystem::{Definition, Limits, System};

/// Expressions in the axiom, in successors, conditions and weights.
pub(super) fn expressions(source: &mut Source<'_>, gauge: &mut Gauge) {
    let depth = source.between(0, 5) as u32;
    let (one, other) = (expression(source, &["r"], depth), expression(source, &["x", "y", "r"], depth));
    let condition = if source.once_in(3) { expression(source, &["x", "y"], 3) } else { "1".to_owned() };
    let other = if source.once_in(20) { random_pieces(source).replace('\n', " ") } else { other };
    let axiom = format!("A({one},{})", expression(source, &[], 2));
    let rules = format!("r = {}\nA(x,y) : {condition} -> B(x)A({other},x)", source.pick(&["2", "0.5", "1e300", "-1"]));
    source.show(format_args!("{axiom}\n{rules}"));
    let (grammar, diagnostics) = parse(&axiom, &rules);
    if diagnostics.iter().any(lsystem::Diagnostic::is_error) {
        return;
    }
    let (axiom, rules) = (print_axiom(&grammar), print_rules(&grammar));
    let (again, wrong) = parse(&axiom, &rules);
    assert_eq!(again, grammar, "printed text reads as another grammar: {axiom}\n{rules}\n{wrong:?}");
    let definition = Definition { axiom, rules, seed: source.word(), ..Definition::default() };
    let Ok(system) = System::new(&definition) else { return };
    let words: Option<Vec<_>> = (0..3).map(|n| naive::modules(&system.grammar, system.seed, n)).collect();
    let Some(rewriter) = Rewriter::new(system.rules.clone(), system.seed, Limits::default()).ok() else {
        assert!(words.is_none(), "the naive reference has numbers for all");
        return;
    };
    let mut rewriter = rewriter;
    let Some(words) = words else { return };
    gauge.reach("computed");
    for (n, word) in words.iter().enumerate() {
        while rewriter.generation() < n as u32 {
            match rewriter.step(1000) {
                Ok(_) => {}
                Err(fault) => panic!("{fault:?}, but the naive reference goes on"),
            }
        }
        let naive: Vec<f64> = word.iter().flat_map(|module| &module.arguments).copied().collect();
        assert_eq!(rewriter.word().arguments, naive, "generation {n}");
    }
}
