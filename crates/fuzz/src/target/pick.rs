//! Picking: the mark under a pointer, in the plane and in space.

use super::drawing::figure;
use crate::{Gauge, Source, make};
use lsystem::Vantage;
use lsystem::render::{Pick, Pointer, Target};

/// A few pointers on a picture.
pub(super) fn pick(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let (n, limits) = (definition.iterations, make::limits(source));
    let viewport = make::viewport(source);
    let vantage = Vantage { view: make::view(source), camera: make::camera(source) };
    let pointers: Vec<Pointer> = (0..source.between(1, 6)).map(|_| pointer(source)).collect();
    source.show(format_args!("{viewport:?} {vantage:?}\n{pointers:?}"));
    let Some(figure) = figure(&system, n, &limits, gauge) else { return };
    for pointer in &pointers {
        let found = gauge.call("pick", || lsystem::pick(&figure, viewport, &vantage, pointer));
        check(found, pointer, figure.segment_count(), figure.polygon_count(), gauge);
    }
}

fn pointer(source: &mut Source<'_>) -> Pointer {
    let place = |source: &mut Source<'_>| match source.below(8) {
        0 => source.number(),
        _ => f64::from(source.pick(&[32_u32, 50, 80, 1, 160])) * (1.0 + 0.1 * source.part()),
    };
    let at = [place(source), place(source)];
    let tolerance = if source.once_in(8) { source.number() } else { source.pick(&[8.0, 4.0, 24.0, 0.0]) };
    // Mostly the page's budget.
    let visits = source.pick(&[20_000, 20_000, 1, 0]);
    Pointer { at, tolerance, upto: make::upto(source), visits }
}

/// Checks that a found mark exists.
fn check(found: Option<Pick>, pointer: &Pointer, segments: u128, polygons: u128, gauge: &mut Gauge) {
    let Some(found) = found else { return };
    gauge.reach("found");
    let upto = pointer.upto.unwrap_or(u128::MAX);
    match found.target {
        Target::Segment(number) => assert!(number < segments && number < upto, "{found:?} of {segments}"),
        Target::Polygon(number) => assert!(number < polygons, "{found:?} of {polygons}"),
    }
    let nowhere = pointer.at.iter().any(|c| !c.is_finite());
    assert!(found.distance >= 0.0 || nowhere, "{found:?}");
}
