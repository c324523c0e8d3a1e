//! The tools of courses: exercises with their marks, growth, and steps.

use crate::gauge::WORK;
use crate::make;
use crate::{Gauge, Source};
use lsystem::course::growth::growth as growth_of;
use lsystem::course::steps::{Order, one_by_one, rows, trace};
use lsystem::course::{Asks, Exercise, Given, Grade, Marker};
use lsystem::{Definition, Limits, expand};

/// An exercise draws its target in one call, with up to 16 Mi units of work.
const TARGET_STEPS: u32 = (16 << 20) / WORK as u32;

/// Exercises of random systems: what is written is read again, and the target solves its own exercise.
pub(super) fn exercises(source: &mut Source<'_>, gauge: &mut Gauge) {
    let given = [Given::Shown, Given::Free, Given::Hidden];
    let target = make::definition(source);
    let asks =
        source.pick(&[Asks::Picture, Asks::Picture, Asks::Picture, Asks::Text, Asks::Segments, Asks::Statistics]);
    let exercise = Exercise {
        title: source.pick(&["", "A weed", "🌿"]).repeat(source.between(0, 300)),
        target,
        axiom: source.pick(&given),
        angle: source.pick(&given),
        n: source.pick(&given),
        turtle: source.pick(&given),
        rules: (0..source.between(0, 4)).map(|_| source.pick(&given)).collect(),
        asks,
        tolerance: source.once_in(4).then(|| source.number()),
        shows_answer: true,
        ..Exercise::default()
    }
    .within_limits();
    let mut text = exercise.write();
    if source.once_in(4) {
        let at = source.below(text.len());
        text.replace_range(at..=at, source.pick(&["A", "_", "-", "", "%"]));
        let _ = gauge.call("damaged", || Exercise::read(&text));
        return;
    }
    let read = gauge.call("read", || Exercise::read(&text));
    if let Ok(read) = &read {
        assert_eq!(read.shown_rules(), exercise.shown_rules());
        assert_eq!(read.start().rules, "");
    }
    let Ok(mut marker) = gauge.long_call("target", TARGET_STEPS, || Marker::new(exercise.clone())) else { return };
    let own = Definition { rules: exercise.own_rules(&exercise.target.rules), ..exercise.target.clone() };
    let mark = marked(&mut marker, "mark", &own, gauge);
    assert!((0.0..=1.0).contains(&mark.agreement), "{mark:?}");
    // Lines of several rules in another order may be another system, so only whole targets are sure.
    if exercise.rules.iter().all(|given| *given == Given::Free) && asks != Asks::Statistics && mark.errors.is_empty() {
        gauge.reach("marked");
        assert!(mark.is_same != Some(false), "{mark:?}");
    }
    // A committed system's answer is a random one, because its own answer has been marked.
    source.given = None;
    let other = make::definition(source);
    let mark = marked(&mut marker, "other", &other, gauge);
    assert!(!mark.is_solved || mark.errors.is_empty());
    assert_eq!(marker.overlay().len(), 512 * 512);
    if source.once_in(8) {
        let _ = gauge.call("hint", || marker.hint(&other));
    }
}

/// Marks an answer in steps, as the page does.
fn marked(marker: &mut Marker, name: &'static str, student: &Definition, gauge: &mut Gauge) -> Grade {
    let mut marking = gauge.call(name, || marker.begin(student));
    loop {
        if let Some(mark) = gauge.call(name, || marker.step(&mut marking, WORK as u64)) {
            return mark;
        }
    }
}

/// Growth: counts are those of the strings.
pub(super) fn growth(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let Ok(growth) = gauge.call("growth", || growth_of(&system, definition.iterations)) else { return };
    gauge.reach("growth");
    assert!(growth.segments.factor >= 0.0 && growth.symbols.factor.is_finite());
    assert!(!growth.csv().is_empty() && !growth.latex().is_empty() && !growth.words().is_empty());
    if growth.is_random {
        return;
    }
    let limits = Limits { symbols: 20_000, work: 100_000, memory: 64 << 20, ..Limits::default() };
    for row in growth.table.iter().take(6) {
        let Ok(text) = expand(&system, row.n, &limits) else { break };
        assert_eq!(row.symbols.digits, text.chars().count().to_string());
    }
}

/// Steps: the children of all symbols are the next generation.
pub(super) fn steps(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let n = definition.iterations;
    if let Ok(read) = gauge.call("rows", || rows(&system, n, u128::from(source.word()), 60)) {
        gauge.reach("rows");
        let mut next: Option<u128> = None;
        for family in &read.families {
            let first: u128 = family.first.parse().expect("digits");
            assert!(next.is_none_or(|next| next == first), "{read:?}");
            next = Some(first + family.children.len() as u128 + family.more.parse::<u128>().expect("digits"));
        }
    }
    if let Ok(trace) = gauge.call("trace", || trace(&system, n, 1000)) {
        gauge.reach("trace");
        assert!(!trace.states.is_empty());
    }
    if let Ok(singles) =
        gauge.call("single", || one_by_one(&system, 50, source.pick(&[Order::Leftmost, Order::Rightmost])))
    {
        assert!(singles.len() <= 51);
    }
}
