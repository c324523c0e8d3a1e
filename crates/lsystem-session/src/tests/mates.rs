//! One picture by several sessions.

use super::{Bench, bush};
use crate::{Outcome, PaneStep, Screen};
use lsystem::render::Pane;
use lsystem::{View, Viewport};

/// Large enough for several panes.
const LARGE: Viewport = Viewport { width: 600, height: 300, ratio: 1.0 };

fn bench(tick: f64) -> Bench {
    let mut bench = Bench::with(&bush(8), tick);
    bench.session.look(LARGE, View::default(), None);
    bench
}

/// Works on the pane until it is complete.
fn outcome(mate: &mut Bench) -> Outcome {
    loop {
        match mate.session.step_pane() {
            PaneStep::More => {}
            PaneStep::Done(outcome) => return outcome,
            PaneStep::Refused => panic!("the pane is refused"),
        }
    }
}

#[test]
fn a_shared_picture_has_the_pixels_of_one_session() {
    let mut alone = bench(1.0);
    let (pictures, _) = alone.settle();
    assert!(pictures.last().unwrap().slow, "mates would help");
    let (mut own, mut mate) = (bench(1.0), bench(0.0));
    assert_eq!((own.session.round(), own.session.hand_out(0)), (0, None));
    own.session.set_mates(1);
    let (mut made, mut complete) = (0, false);
    while !complete {
        complete = own.session.step().unwrap().drawn.is_some_and(|drawn| drawn.complete);
        let round = own.session.round();
        // The session makes some of the panes itself.
        while let Some(pane) = own.session.hand_out(1) {
            let place = Pane { x: pane.x, y: pane.y, width: pane.width, height: pane.height };
            mate.session.begin_pane(place, pane.budget);
            let outcome = outcome(&mut mate);
            assert!(!own.session.take_in(round + 1, pane.number, outcome), "another round");
            assert!(own.session.take_in(round, pane.number, outcome));
            own.screen.put(mate.session.pane_pixels(), LARGE, place).unwrap();
            made += 1;
        }
    }
    assert!(made > 0 && own.session.round() == 0, "{made} panes by the mate");
    assert!(own.screen.pixels() == alone.screen.pixels(), "the pixels differ");
}

#[test]
fn panes_of_lost_mates_are_made_without_them() {
    let mut alone = bench(0.0);
    alone.settle();
    let mut own = bench(1.0);
    own.session.set_mates(1);
    let (mut lost, mut has_waited) = (0, false);
    loop {
        let answer = own.session.step().unwrap();
        if answer.idle {
            break;
        }
        while own.session.hand_out(0).is_some() {
            lost += 1;
        }
        has_waited |= own.session.waits();
    }
    assert!(lost > 0 && has_waited);
    assert!(own.screen.pixels() == alone.screen.pixels(), "the pixels differ");
}

#[test]
fn a_new_view_ends_a_round() {
    let mut own = bench(1.0);
    own.session.set_mates(1);
    while own.session.round() == 0 {
        assert!(!own.session.step().unwrap().idle);
    }
    let (round, pane) = (own.session.round(), own.session.hand_out(0).unwrap());
    own.session.look(LARGE, View::default(), None);
    assert_eq!((own.session.round(), own.session.hand_out(0)), (0, None));
    assert!(!own.session.take_in(round, pane.number, Outcome { work: 1.0, poor: false }));
}
