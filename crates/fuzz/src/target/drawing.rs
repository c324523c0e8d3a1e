//! Drawings: made in the page's steps, read in every way, and small ones compared with the naive turtle.

use super::derive::{is_supported, words};
use crate::gauge::WORK;
use crate::told::check_diagnostic;
use crate::{Gauge, Source, make, naive};
use lsystem::drawing::{Outlook, Segment, Space, symbol_of_polygon};
use lsystem::render::{fitted_ends, fitted_outline, fitted_polygon};
use lsystem::syntax::Heading;
use lsystem::{
    Definition, Drawer, Drawing, Figure, Limits, Progress, SegmentArrays, Solid, System, count_segments, fit,
};
use std::sync::Arc;

/// A drawing in the space of its system, made in steps.
pub(super) fn figure(system: &System, n: u32, limits: &Limits, gauge: &mut Gauge) -> Option<Figure> {
    if system.is_solid() {
        drawn_in_space(system, n, limits, gauge).map(Figure::Space)
    } else {
        drawn(system, n, limits, gauge).map(Figure::Plane)
    }
}

/// A drawing in the plane, made in steps.
pub(super) fn drawn(system: &System, n: u32, limits: &Limits, gauge: &mut Gauge) -> Option<Arc<Drawing>> {
    build(Drawer::new(system, n, *limits), gauge)
}

/// A drawing in space, made in steps.
pub(super) fn drawn_in_space(
    system: &System,
    n: u32,
    limits: &Limits,
    gauge: &mut Gauge,
) -> Option<Arc<Drawing<Solid>>> {
    build(Drawer::new(system, n, *limits), gauge)
}

fn build<S: Space>(mut drawer: Drawer<S>, gauge: &mut Gauge) -> Option<Arc<Drawing<S>>> {
    loop {
        let before = drawer.spent();
        let progress = gauge.call("draw", || drawer.step(WORK as u64));
        gauge.charge("draw", WORK as u64, drawer.spent() - before);
        if progress == Progress::Done {
            break;
        }
    }
    match gauge.call("finish", || drawer.finish()) {
        Ok(drawing) => {
            gauge.reach("drawn");
            Some(Arc::new(drawing))
        }
        Err(limit) => {
            gauge.reach("refused");
            check_diagnostic(&limit);
            None
        }
    }
}

/// A drawing in the plane.
pub(super) fn plane(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let n = definition.iterations;
    let limits = make::limits(source);
    let Some(drawing) = drawn(&system, n, &limits, gauge) else { return };
    let bounds = gauge.call("bounds", || drawing.bounds());
    assert_eq!(bounds.is_some(), drawing.segment_count() > 0 || drawing.polygon_count() > 0, "bounds of something");
    if let Some([x0, y0, x1, y1]) = bounds {
        assert!(x0 <= x1 && y0 <= y1, "{bounds:?}");
    }
    gauge.call("fit", || fit(&drawing));
    let number = place(source, drawing.segment_count());
    let figure = Figure::Plane(drawing.clone());
    if let Some(segments) = gauge.call("count_segments", || count_segments(&system, n)) {
        let words = gauge.call("describe", || figure.describe(&system, n, &segments));
        assert!(!words.is_empty(), "a picture without words");
    }
    gauge.call("fitted_ends", || fitted_ends(&figure, number));
    gauge.call("heading_at", || drawing.heading_at(number));
    let end = number.saturating_add(u128::from(source.word()));
    gauge.call("fitted_outline", || fitted_outline(&figure, number..end));
    let number = place(source, drawing.polygon_count());
    let polygon = gauge.call("fitted_polygon", || fitted_polygon(&figure, number));
    assert_eq!(polygon.is_empty(), number >= drawing.polygon_count());
    gauge.call("symbol_of_polygon", || symbol_of_polygon(&system, n, &drawing, number));
    let mut arrays = SegmentArrays::default();
    let _ = gauge.call("write_segments", || drawing.write_segments(5_000, &mut arrays));
    read(&drawing, gauge);
    if is_comparable(&definition, &system, n) {
        let naive = gauge.call("naive", || naive::limited_segments(&system, n, drawing.bounds()));
        gauge.reach("compared");
        compare(&drawing, &naive);
    }
}

/// A drawing in space.
pub(super) fn space(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let n = definition.iterations;
    let limits = make::limits(source);
    let Some(drawing) = drawn_in_space(&system, n, &limits, gauge) else { return };
    let bounds = gauge.call("bounds", || drawing.bounds());
    if let Some([low, high]) = bounds {
        assert!((0..3).all(|i| low[i] <= high[i]), "{bounds:?}");
    }
    let number = place(source, drawing.segment_count());
    let figure = Figure::Space(drawing.clone());
    gauge.call("fitted_ends", || fitted_ends(&figure, number));
    let number = place(source, drawing.polygon_count());
    gauge.call("fitted_polygon", || fitted_polygon(&figure, number));
    gauge.call("symbol_of_polygon", || symbol_of_polygon(&system, n, &drawing, number));
    let outlook = Outlook { azimuth: source.number(), elevation: source.number() };
    let _ = gauge.call("seen_from", || drawing.seen_from(&outlook, 5_000));
    read(&drawing, gauge);
    if system.is_solid() && is_comparable(&definition, &system, n) {
        let naive = gauge.call("naive", || naive::solid_segments(&system, n));
        gauge.reach("compared");
        compare(&drawing, &naive);
    }
}

/// A number below `count`, or `count` itself.
fn place(source: &mut Source<'_>, count: u128) -> u128 {
    match source.below(4) {
        0 => count,
        1 => count.saturating_sub(1),
        2 => 0,
        _ => u128::from(source.word()) % count.max(1),
    }
}

/// Reads some segments from different starts.
fn read<S: Space>(drawing: &Drawing<S>, gauge: &mut Gauge) {
    let count = drawing.segment_count();
    for start in [0, 1, count / 3, count.saturating_sub(1), count] {
        let few = gauge.call("segments_from", || drawing.segments_from(start).take(3).count());
        // A saturated count is not exact.
        if count == u128::MAX {
            continue;
        }
        assert_eq!(few as u128, (count.saturating_sub(start)).min(3), "segments from {start} on of {count}");
    }
}

/// Whether the naive turtle must give the same drawing: the word is short, the numbers have usual sizes, and the naive
/// reference supports the system.
fn is_comparable(definition: &Definition, system: &System, n: u32) -> bool {
    let turtle = &system.turtle;
    let usual = |number: f64| number == 0.0 || (1e-6..1e6).contains(&number.abs());
    let style = &definition.style;
    let numbers = [definition.step, definition.start[0], definition.start[1], style.width, style.width_factor];
    let more = [definition.length_factor, definition.elasticity, definition.growth];
    let arguments = |word: &Vec<naive::Module>| word.iter().flat_map(|module| &module.arguments).all(|&a| usual(a));
    let words = words(system, n);
    // A turn by 180 degrees does not vary in the core.
    let turns = [turtle.left, turtle.right, turtle.pitch_down, turtle.pitch_up, turtle.roll_left, turtle.roll_right];
    let varies = turtle.angle_variation != 0.0 && turns.contains(&Heading::HALF);
    // In plain rules, an image is one letter with several actions, so its variations have other random numbers.
    let images = system.rules.is_plain() && !system.grammar.images.is_empty();
    // A strong tropism overshoots and swings ever wider, so that rounding errors grow.
    let pull = |vector: [f64; 3]| vector.iter().map(|c| c * c).sum::<f64>().sqrt();
    let swings = turtle.tropism.is_some_and(|tropism| tropism.elasticity.abs() * pull(tropism.vector) > 1.0);
    let varies = varies || swings || images && (turtle.angle_variation != 0.0 || turtle.length_variation != 0.0);
    words.len() as u64 == u64::from(n) + 1
        && words.last().is_some_and(arguments)
        && numbers.into_iter().chain(more).chain(definition.tropism).all(usual)
        && is_supported(definition, system)
        && !varies
        && turtle.actions.iter().flatten().all(|&action| is_usual(action))
        && naive::images(&system.grammar, system.seed, &words[n as usize]).is_some_and(|word| arguments(&word))
}

/// Whether an action has a number of usual size, if any.
fn is_usual(action: lsystem::syntax::Action) -> bool {
    use lsystem::syntax::Action::{AddColour, ScaleLength, SetColour};
    let usual = |number: f64| number == 0.0 || (1e-4..1e4).contains(&number.abs());
    match action {
        // Factors of length multiply along a path.
        ScaleLength(factor) => (0.1..10.0).contains(&factor),
        SetColour(_) | AddColour(_) => true,
        _ => action.number().is_none_or(usual),
    }
}

/// Checks that segments are equal to 1e-6 of the extent: rounding errors add up along hundreds of branches.
fn compare<S: Space>(drawing: &Drawing<S>, naive: &[Segment<S>]) {
    assert_eq!(drawing.segment_count(), naive.len() as u128, "how many segments there are");
    let ends = naive.iter().flat_map(|segment| [segment.from, segment.to]);
    let extent = ends.flat_map(|end| end.as_ref().to_vec()).fold(0.0_f64, |most, c| most.max(c.abs()));
    let tolerance = 1e-6 * extent + 1e-9;
    for (number, (fast, plain)) in drawing.segments().zip(naive).enumerate() {
        for (a, b) in [(fast.from, plain.from), (fast.to, plain.to)] {
            let near = a.as_ref().iter().zip(b.as_ref()).all(|(a, b)| (a - b).abs() <= tolerance);
            assert!(near, "segment {number}: {fast:?}, but {plain:?}");
        }
        assert_eq!((fast.colour, fast.level), (plain.colour, plain.level), "segment {number}");
        let width = (fast.width - plain.width).abs() <= 1e-6 * plain.width.abs();
        assert!(width, "segment {number}: {} wide, but {}", fast.width, plain.width);
    }
}
