//! The same work done by other people's crates.

use bench::Work;
use dcc_lsystem::renderer::{DataRendererOptions, Renderer, TurtleRenderer};
use dcc_lsystem::turtle::{TurtleAction, TurtleLSystemBuilder, TurtleLSystemState};

/// `lindenmayer`: strings only.
pub(crate) fn lindenmayer(work: &Work) -> lindenmayer::LSystem {
    lindenmayer::LSystem::new(work.axiom.to_owned(), work.rules)
}

/// `dcc-lsystem`: token numbers, and a turtle over them that keeps lines in whole units.
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

/// How many lines a derived system draws. A renderer serves once.
pub(crate) fn dcc_lines(work: &Work, system: &dcc_lsystem::LSystem) -> u64 {
    dcc(work).1.render(system, &DataRendererOptions::default()).len() as u64
}
