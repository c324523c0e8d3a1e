//! The same work by other crates.

use bench::Work;
use dcc_lsystem::renderer::{DataRendererOptions, Renderer, TurtleRenderer};
use dcc_lsystem::turtle::{TurtleAction, TurtleLSystemBuilder, TurtleLSystemState};
use expression::cond::Cond;
use expression_num::NumExpr;
use lindenmayer_system::parametric::{PRule, PSym, PSystem, ParametricSymbol, ParametricSystem};

/// `lindenmayer`: strings only.
pub(crate) fn lindenmayer(work: &Work) -> lindenmayer::LSystem {
    lindenmayer::LSystem::new(work.axiom.to_owned(), work.rules)
}

/// `dcc-lsystem`: strings of token numbers, and a turtle with lines in whole units.
pub(crate) fn dcc(work: &Work) -> (dcc_lsystem::LSystem, TurtleRenderer<TurtleLSystemState>) {
    let spaced = |text: &str| text.chars().map(String::from).collect::<Vec<_>>().join(" ");
    let mut builder = TurtleLSystemBuilder::new();
    let angle = work.angle as i32;
    builder
        .token("X", TurtleAction::Nothing)
        .token("F", TurtleAction::Forward(100))
        .token("G", TurtleAction::Forward(100))
        .token("+", TurtleAction::Rotate(angle))
        .token("-", TurtleAction::Rotate(-angle))
        .token("[", TurtleAction::Push)
        .token("]", TurtleAction::Pop)
        .axiom(&spaced(work.axiom));
    for (symbol, successor) in work.rules {
        builder.rule(&*format!("{symbol} => {}", spaced(successor)));
    }
    builder.finish()
}

/// The number of lines that a derived system draws. A renderer can be used only once, so each call makes a new one.
pub(crate) fn dcc_lines(work: &Work, system: &dcc_lsystem::LSystem) -> u64 {
    dcc(work).1.render(system, &DataRendererOptions::default()).len() as u64
}

type MadeSymbol = PSym<char, NumExpr<f64>>;
type GrownSymbol = PSym<char, f64>;
/// A system of `lindenmayer-system`.
pub(crate) type ParametricTree = PSystem<PRule<char, MadeSymbol, GrownSymbol, Cond<NumExpr<f64>>>>;

/// `lindenmayer-system`: ABOP, figure 2.6a.
pub(crate) fn tree() -> ParametricTree {
    let made =
        |symbol: char, arguments: Vec<NumExpr<f64>>| MadeSymbol::new_from_vec(symbol, arguments).expect("a symbol");
    let number = |value: f64| vec![NumExpr::Const(value)];
    let times = |slot: usize, by: f64| NumExpr::Mul(Box::new(NumExpr::Var(slot)), Box::new(NumExpr::Const(by)));
    let apex = |symbol: char, factor: f64| made(symbol, vec![times(0, factor), times(1, 0.707)]);
    let start = || vec![made('!', vec![NumExpr::Var(1)]), made('F', vec![NumExpr::Var(0)]), made('[', vec![])];
    let mut system = ParametricTree::new();
    let mut add = |symbol: char, branch: Vec<MadeSymbol>, rest: Vec<MadeSymbol>| {
        let successor = start().into_iter().chain(branch).chain([made(']', vec![])]).chain(rest);
        system.add_rule(PRule::new(symbol, Cond::True, successor.collect(), 2));
    };
    add('A', vec![made('&', number(45.0)), apex('B', 0.6)], vec![made('/', number(137.5)), apex('A', 0.9)]);
    add('B', vec![made('-', number(45.0)), made('$', vec![]), apex('C', 0.6)], vec![apex('C', 0.9)]);
    add('C', vec![made('+', number(45.0)), made('$', vec![]), apex('B', 0.6)], vec![apex('B', 0.9)]);
    system
}

/// Derives `n` generations. Returns the number of modules read.
pub(crate) fn derive_tree(tree: &ParametricTree, n: u32, modules: u64) -> u64 {
    let mut word = vec![GrownSymbol::new_from_vec('A', vec![1.0, 10.0]).expect("a symbol")];
    let mut read = 0;
    for _ in 0..n {
        read += word.len() as u64;
        word = tree.develop_next(&word).0;
    }
    assert_eq!(word.len() as u64, modules);
    read
}
