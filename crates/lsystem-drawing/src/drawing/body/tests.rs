use super::super::segments::{BlockFrame, Strokes};
use super::*;
use crate::{StyleChange, System, draw};
use lsystem_base::Limits;
use lsystem_syntax::Definition;

/// Checks that every block's body contains all that the block draws, and exceeds it by at most the block's slack.
fn check(rules: &str, angle: f64, n: u32, loose: f64) {
    let definition = Definition { axiom: "A".into(), rules: rules.into(), angle, ..Definition::default() };
    let drawing = draw::<Solid>(&System::new(&definition).unwrap(), n, &Limits::default()).unwrap();
    for (id, block) in drawing.blocks.iter().enumerate() {
        let mut strokes = Strokes::new(&drawing);
        strokes.enter(BlockId(id as u32), &BlockFrame::new(1.0, StyleChange::NONE));
        let (body, mut low, mut high, mut radius) = (block.hull, [f64::MAX; 3], [f64::MIN; 3], 0.0_f64);
        for end in strokes.flat_map(|(from, to, _)| [from, to]) {
            low = [0, 1, 2].map(|i| low[i].min(end[i]));
            high = [0, 1, 2].map(|i| high[i].max(end[i]));
            radius = radius.max(norm([0, 1, 2].map(|i| end[i] - body.centre()[i])));
        }
        for i in 0..3 {
            assert!(body.low[i] <= low[i] + 1e-11 && body.high[i] >= high[i] - 1e-11, "{id}: {body:?}");
            let slack = (low[i] - body.low[i]).max(body.high[i] - high[i]);
            assert!(slack <= block.slack + 1e-11 && slack <= loose, "{id}: {slack} {block:?}");
        }
        assert!(radius <= body.radius + 1e-11 && body.radius <= radius + loose.max(1e-11), "{id}: {radius} {body:?}");
        let reach = body.low.iter().chain(&body.high).fold(0.0_f64, |reach, c| reach.max(c.abs()));
        assert!((0.5..1.0).contains(&reach), "{id}: {body:?}");
    }
}

#[test]
fn bodies_contain_and_fit() {
    check("A -> [&F!A]/////'[&F!A]///////'[&F!A]\nF -> S/////F\nS -> F", 22.5, 9, 0.03);
    check("A -> F[&A][/+A]^F\\A\nF -> FF", 25.7, 8, 0.03);
    // A long chain of blocks, each nearly as large as its container.
    check("A -> F&/A", 137.5, 300, 0.6);
    // An unfolded drawing, because of `$`.
    check("A -> F[&A][/+A]^F\\$A\nF -> FF", 25.7, 8, 0.01);
}
