//! Drawings: made in the page's steps, read in every way, and small ones compared with the naive turtle.

use super::derive::{is_supported, words};
use crate::gauge::WORK;
use crate::told::check_diagnostic;
use crate::{Gauge, Source, make, naive};
use lsystem::drawing::{Outlook, Plane, Segment, Space};
use lsystem::render::{fitted_ends, fitted_outline, fitted_polygon};
use lsystem::syntax::Heading;
use lsystem::{Definition, Drawer, Drawing, Figure, Limits, SegmentArrays, Solid, System, count_segments, fit};
use std::sync::Arc;

/// A drawing in the space of its system, made in steps.
pub(super) fn figure(system: &System, n: u32, limits: &Limits, gauge: &mut Gauge) -> Option<Figure> {
    if system.is_solid() {
        drawn(system, n, limits, gauge).map(Figure::Space)
    } else {
        drawn(system, n, limits, gauge).map(Figure::Plane)
    }
}

/// A drawing in a space, made in steps.
pub(super) fn drawn<S: Space>(system: &System, n: u32, limits: &Limits, gauge: &mut Gauge) -> Option<Arc<Drawing<S>>> {
    let mut drawer = Drawer::new(system, n, *limits);
    gauge.steps("draw", WORK, &mut drawer, |drawer, work| drawer.step(work as u64), Drawer::spent);
    let finished = gauge.call("finish", || drawer.finish());
    gauge.reach(if finished.is_ok() { "drawn" } else { "refused" });
    finished.inspect_err(check_diagnostic).ok().map(Arc::new)
}

/// A random system with its drawing in a space.
pub(super) fn random_drawing<S: Space>(
    source: &mut Source<'_>,
    gauge: &mut Gauge,
) -> Option<(Definition, System, Arc<Drawing<S>>)> {
    let (definition, system) = make::system(source)?;
    let limits = make::limits(source);
    let drawing = drawn(&system, definition.iterations, &limits, gauge)?;
    Some((definition, system, drawing))
}

/// A drawing as seen in the plane: itself, or the view of one in space.
pub(super) fn flat(source: &mut Source<'_>, system: &System, n: u32, gauge: &mut Gauge) -> Option<Arc<Drawing>> {
    let limits = make::limits(source);
    if !system.is_solid() {
        return drawn(system, n, &limits, gauge);
    }
    let solid = drawn::<Solid>(system, n, &limits, gauge)?;
    seen(source, &solid, gauge).map(Arc::new)
}

/// The view of a drawing in space, if it has few segments.
pub(super) fn seen(source: &mut Source<'_>, solid: &Drawing<Solid>, gauge: &mut Gauge) -> Option<Drawing> {
    let outlook = Outlook { azimuth: source.part() * 360.0, elevation: source.pick(&[12.0, 0.0, 90.0, 300.0]) };
    gauge.call("seen_from", || solid.seen_from(&outlook, 20_000)).ok()
}

/// A drawing in the plane.
pub(super) fn plane(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system, drawing)) = random_drawing::<Plane>(source, gauge) else { return };
    let n = definition.iterations;
    let is_there = drawing.segment_count() > 0 || drawing.polygon_count() > 0;
    assert_eq!(drawing.bounds().is_some(), is_there, "bounds of something");
    gauge.call("fit", || fit(&drawing));
    read(source, &system, n, &Figure::Plane(drawing.clone()), gauge);
    let number = place(source, drawing.segment_count());
    gauge.call("heading_at", || drawing.heading_at(number));
    let mut arrays = SegmentArrays::default();
    let _ = gauge.call("write_segments", || drawing.write_segments(5_000, &mut arrays));
    if is_comparable(&definition, &system, n) {
        let naive = gauge.call("naive", || naive::limited_segments(&system, n, drawing.bounds()));
        gauge.reach("compared");
        compare(&drawing, &naive);
    }
}

/// A drawing in space.
pub(super) fn space(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system, drawing)) = random_drawing::<Solid>(source, gauge) else { return };
    let n = definition.iterations;
    read(source, &system, n, &Figure::Space(drawing.clone()), gauge);
    let outlook = Outlook { azimuth: source.number(), elevation: source.number() };
    let _ = gauge.call("seen_from", || drawing.seen_from(&outlook, 5_000));
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

/// Reads a drawing in the ways that both spaces have.
fn read(source: &mut Source<'_>, system: &System, n: u32, figure: &Figure, gauge: &mut Gauge) {
    let bounds = gauge.call("bounds", || figure.bounds());
    assert!(bounds.iter().all(|[low, high]| low.iter().zip(high).all(|(low, high)| low <= high)), "{bounds:?}");
    let count = figure.segment_count();
    if let Some(segments) = gauge.call("count_segments", || count_segments(system, n)) {
        let words = gauge.call("describe", || figure.describe(system, n, &segments));
        assert!(!words.is_empty(), "a picture without words");
    }
    let number = place(source, count);
    gauge.call("fitted_ends", || fitted_ends(figure, number));
    let end = number.saturating_add(u128::from(source.word()));
    gauge.call("fitted_outline", || fitted_outline(figure, number..end));
    let number = place(source, figure.polygon_count());
    let polygon = gauge.call("fitted_polygon", || fitted_polygon(figure, number));
    assert_eq!(polygon.is_empty(), number >= figure.polygon_count());
    gauge.call("symbol_of_polygon", || figure.symbol_of_polygon(system, n, number));
    for start in [0, 1, count / 3, count.saturating_sub(1), count] {
        let few = gauge.call("segments_from", || figure.segments_from(start).take(3).count());
        let is_right = few as u128 == count.saturating_sub(start).min(3);
        assert!(count == u128::MAX || is_right, "segments from {start} on of {count}: {few}");
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
