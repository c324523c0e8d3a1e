//! Pages of strings, symbols and marks.

use super::{Bench, definition, random, weed};
use crate::facts::Direction;
use lsystem::{View, Viewport};

#[test]
fn a_generation_is_read_in_place() {
    let mut bench = Bench::with(&weed(40), 0.0);
    bench.session.look(Viewport { width: 64, height: 64, ratio: 1.0 }, View::default(), None);
    bench.settle();
    let session = &bench.session;
    let page = session.string(1, 0, 99);
    assert_eq!((page.text.unwrap(), page.length.unwrap(), page.apart), ("F[+F]F[-F]F".into(), "11".into(), false));
    assert_eq!(session.string(40, 0, 4).text.unwrap(), "F[+F");
    assert_eq!(session.symbol(40, 0).ancestry.len(), 41);
    let symbol = session.symbol(1, 10);
    let part = symbol.part.unwrap();
    assert_eq!(part.segments[1], 5_u128.pow(40).to_string());
    assert!(part.outline.len() > 2);
    let first: u128 = part.segments[0].parse().unwrap();
    assert_eq!(symbol.stroke, session.segment(first));
    assert_eq!(session.descendant(1, 10, 40).unwrap(), part.symbols[0]);
    assert_eq!(session.descendant(1, 11, 40), None, "there is no such symbol");
    // The tip of the plant is the highest point of the fitted picture.
    let last = session.segment(5_u128.pow(40) - 1).unwrap();
    let Direction::Degrees(heading) = last.heading else { panic!("{last:?}") };
    assert_eq!(heading, 90.0);
    assert!((last.fitted_to[1] - 0.5).abs() < 1e-9);
    assert_eq!(session.segment(5_u128.pow(40)), None);
    // The stem goes up the picture. To its right, below the first leaves, the picture is empty.
    let picked = session.pick(32.0, 60.0, 6.0);
    let symbol: u128 = picked.symbol.unwrap().parse().unwrap();
    assert_eq!(picked.ancestry, session.symbol(40, symbol).ancestry);
    assert_eq!(picked.stroke, session.segment(picked.segment.unwrap().parse().unwrap()));
    assert_eq!(session.pick(1.0, 63.0, 2.0), crate::Picked::default());
}

#[test]
fn a_random_generation_is_remembered_before_it_is_read() {
    let mut bench = Bench::new();
    assert_eq!(bench.session.define(random(6)).segments.as_deref(), Some("64"));
    let report = bench.settle().1.unwrap();
    assert_eq!(bench.session.string(6, 0, 9).length, None);
    while !bench.session.remember(None) {}
    let page = bench.session.string(6, 0, 1 << 20);
    let length = page.length.unwrap();
    assert_eq!(page.text.unwrap().len().to_string(), length);
    assert_eq!(report.symbols.unwrap(), length);
    let last: u128 = length.parse::<u128>().unwrap() - 1;
    assert_eq!(bench.session.symbol(6, last).ancestry.len(), 7);
    assert_eq!(bench.session.symbol(0, 0).part.unwrap().segments[1], "64");
    bench.session.forget();
    assert_eq!(bench.session.string(6, 0, 9).text, None);
}

#[test]
fn remembering_takes_several_steps_if_it_is_long() {
    let mut bench = Bench::with(&random(14), 0.0);
    bench.settle();
    bench.tick(crate::STEP);
    let mut steps = 1;
    while !bench.session.remember(None) {
        steps += 1;
    }
    assert!(steps > 1, "{steps}");
    assert!(bench.session.remember(Some(3)), "known already");
}

#[test]
fn modules_are_read_with_their_arguments() {
    let tree = definition("A(1)", "A(l) : l > 0.3 -> F(l)[+A(l*0.5)]A(l*0.5)", 20.0, 3);
    let mut bench = Bench::with(&tree, 0.0);
    bench.settle();
    while !bench.session.remember(Some(3)) {}
    let page = bench.session.string(2, 0, 5);
    assert_eq!((page.text.unwrap(), page.apart), ("F(1)\n[\n+\nF(0.5)\n[\n".into(), true));
    assert_eq!(bench.session.string(1, 0, 0).length.unwrap(), "6");
    assert_eq!(bench.session.symbol(2, 3).ancestry[1].symbol, "A(0.5)");
    assert_eq!(bench.session.symbol_of_segment(1), Some(3));
}

#[test]
fn the_length_of_a_huge_string_is_exact() {
    // 2^(n + 1) - 1 symbols, more than 128 bits.
    let bench = Bench::with(&definition("F", "F -> F+F", 20.0, 200), 0.0);
    let length = bench.session.string(200, 0, 3).length.unwrap();
    assert!(length.ends_with("1301751") || length.len() == 61, "{length}");
}
