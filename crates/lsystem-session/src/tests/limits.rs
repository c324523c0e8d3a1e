//! Limits are errors, and the last good drawing stays.

use super::{Bench, bush, random, weed};
use crate::Session;
use crate::budget::{LIMITS, SMALL};

#[test]
fn a_drawing_beyond_the_budget_is_an_error_that_names_the_largest() {
    let mut bench = Bench::with(&weed(4), 0.0);
    bench.settle();
    let shown = bench.screen.pixels();
    bench.session.define(random(60));
    let report = bench.settle().1.unwrap();
    let largest = report.largest.unwrap();
    let limit = report.diagnostics.last().unwrap();
    assert!(report.ok && limit.severity == "error", "{report:?}");
    assert_eq!((report.memoised, largest), (None, 20));
    assert_eq!(bench.screen.pixels(), shown, "the last good drawing stays");
    // What the message promises can be drawn, within the budget.
    bench.session.define(random(largest));
    let report = bench.settle().1.unwrap();
    assert_eq!((report.memoised, report.largest), (Some(false), None));
    assert!(bench.session.shown.as_ref().unwrap().bytes() <= LIMITS.memory);
}

#[test]
fn small_pictures_have_a_smaller_budget_and_no_counts() {
    let mut bench = Bench::of(Session::small);
    assert_eq!(bench.session.define(weed(4)).segments, None);
    let (pictures, _) = bench.settle();
    let stages: Vec<bool> = pictures.iter().map(|drawn| drawn.complete).collect();
    assert_eq!(stages, [false, true], "always coarse first");
    bench.session.define(random(20));
    let largest = bench.settle().1.unwrap().largest.unwrap();
    assert!(largest < 20);
    bench.session.define(random(largest));
    bench.settle();
    let figure = bench.session.shown.as_ref().unwrap();
    assert!(figure.segment_count() == 1 << largest && figure.bytes() <= SMALL.memory);
}

#[test]
fn a_string_beyond_the_budget_is_not_read() {
    let mut bench = Bench::with(&random(20), 0.0);
    bench.settle();
    while !bench.session.remember(None) {}
    let page = bench.session.string(20, 0, 10);
    assert_eq!((page.text, page.length), (None, None));
    assert_eq!(bench.session.symbol(0, 0).part, None);
    // Generations before the limit can be read.
    assert!(bench.session.string(10, 0, 10).text.is_some());
}

#[test]
fn a_pane_of_a_refused_drawing_is_refused() {
    let mut bench = Bench::with(&bush(3), 0.0);
    bench.settle();
    bench.session.set_mates(1);
    bench.session.define(random(60));
    bench.settle();
    let pane = lsystem::render::Pane { x: 0, y: 0, width: 16, height: 16 };
    bench.session.begin_pane(pane, 1.0);
    assert_eq!(bench.session.step_pane(), crate::PaneStep::Refused);
}
