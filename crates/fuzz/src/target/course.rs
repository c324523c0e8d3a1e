//! The tools of courses: exercises with their marks, growth, and steps.

use crate::gauge::WORK;
use crate::make;
use crate::{Gauge, Source};
use lsystem::course::growth::growth as growth_of;
use lsystem::course::steps::{Order, one_by_one, rows, trace};
use lsystem::course::{Asks, Exercise, Given, Grade, Marker};
use lsystem::{Definition, Figure, Limits, System, expand};

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
    let other = if source.once_in(3) { make::definition(source) } else { changed(source, &own) };
    let mark = marked(&mut marker, "other", &other, gauge);
    assert!(!mark.is_solved || mark.errors.is_empty());
    if mark.is_same == Some(true) && mark.errors.is_empty() {
        gauge.reach("same");
        same(&exercise, &other);
    }
    assert_eq!(marker.overlay().len(), 512 * 512);
    if source.once_in(8) {
        let _ = gauge.call("hint", || marker.hint(&other));
    }
}

/// The same rules with one symbol more, less or other.
fn changed(source: &mut Source<'_>, own: &Definition) -> Definition {
    let mut rules: Vec<char> = own.rules.chars().collect();
    let at = source.below(rules.len() + 1);
    let symbol = source.pick_char("F+-XfG|");
    match source.below(3) {
        0 => rules.insert(at, symbol),
        1 if at < rules.len() => rules[at] = symbol,
        _ if at < rules.len() => _ = rules.remove(at),
        _ => {}
    }
    Definition { rules: rules.into_iter().collect(), ..own.clone() }
}

/// Checks that an answer that is called the same is so, segment by segment.
fn same(exercise: &Exercise, student: &Definition) {
    let drawn = |definition: &Definition| {
        let system = System::new(definition).ok()?.without_wires();
        let figure = Figure::draw(&system, definition.iterations, &Limits::default()).ok()?;
        let is_compared = figure.segment_count() <= MAX_COMPARED && figure.polygon_count() == 0;
        is_compared.then_some(figure)
    };
    let (Some(target), Some(own)) = (drawn(&exercise.target), drawn(&exercise.complete(student))) else { return };
    match exercise.asks {
        Asks::Segments => assert_eq!(target.segment_count(), own.segment_count(), "the number of segments"),
        Asks::Picture => {
            let [target, own] = [target, own].map(|figure| fitted(&figure));
            for (one, other, what) in [(&target, &own, "is missing"), (&own, &target, "is too much")] {
                for [from, to] in one {
                    for part in [0.0, 0.3, 0.5, 1.0] {
                        let at = [0, 1, 2].map(|axis| from[axis] + part * (to[axis] - from[axis]));
                        let is_there = other.iter().any(|segment| distance(at, segment) < 1e-5);
                        assert!(is_there, "{at:?} {what} in an answer that is called the same");
                    }
                }
            }
        }
        Asks::Text | Asks::Statistics | Asks::Program => {}
    }
}

/// The most segments that are compared one by one.
const MAX_COMPARED: u128 = 300;

/// The segments that have a length, moved and scaled so that the longest side is 1.
fn fitted(figure: &Figure) -> Vec<[[f64; 3]; 2]> {
    let segments: Vec<[[f64; 3]; 2]> = figure.segments_from(0).map(|segment| [segment.from, segment.to]).collect();
    let along = |axis: usize, first: f64, pick: fn(f64, f64) -> f64| {
        segments.as_flattened().iter().map(|place| place[axis]).fold(first, pick)
    };
    let low = [0, 1, 2].map(|axis| along(axis, f64::INFINITY, f64::min));
    let high = [0, 1, 2].map(|axis| along(axis, f64::NEG_INFINITY, f64::max));
    let side = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max);
    let place = |at: [f64; 3]| [0, 1, 2].map(|axis| (at[axis] - f64::midpoint(low[axis], high[axis])) / side);
    let placed = segments.iter().map(|segment| segment.map(place));
    placed.filter(|[from, to]| (0..3).any(|axis| (from[axis] - to[axis]).abs() > 1e-6)).collect()
}

/// The distance of a place from a segment.
fn distance(at: [f64; 3], [from, to]: &[[f64; 3]; 2]) -> f64 {
    let way = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let off = [0, 1, 2].map(|axis| at[axis] - from[axis]);
    let part = (dot(off, way) / dot(way, way)).clamp(0.0, 1.0);
    let rest = [0, 1, 2].map(|axis| off[axis] - part * way[axis]);
    libm::sqrt(dot(rest, rest))
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
