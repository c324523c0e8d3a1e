//! The outlines of tubes as lines.

use super::body::Tube;
use super::sight::Place;
use core::f64::consts::{FRAC_PI_2, PI};

/// The most by which a line leaves a round end or the outline of a stroke, in pens.
pub(super) const EXACT: f64 = 0.05;
/// The most lines of half a round end.
const MAX: f64 = 256.0;

/// A line of an outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub(super) ends: [Place; 2],
    /// Whether the line is part of a round end.
    pub(super) is_round: bool,
}

/// Puts the outline of a tube into an empty list: a closed way around it. Lines of round ends touch the circles from
/// outside, so that the same round end of another tube does not hide them.
pub(super) fn outline(tube: &Tube, pen: f64, edges: &mut Vec<Edge>) {
    let (unit, length) = tube.axis();
    let ahead = libm::atan2(unit[1], unit[0]);
    if tube.sides(length).is_none() {
        let end = usize::from(tube.radii[1] > tube.radii[0]);
        arc(tube, end, [ahead, ahead + 2.0 * PI], pen, edges);
        return;
    }
    // The angle from the direction ahead to where the sides touch the round ends.
    let side = FRAC_PI_2 - libm::asin(((tube.radii[0] - tube.radii[1]) / length).clamp(-1.0, 1.0));
    for (end, from, to) in [(1, -side, side), (0, side, 2.0 * PI - side)] {
        let start = on_circle(tube, end, ahead + from, tube.radii[end]);
        let before = on_circle(tube, 1 - end, ahead + from, tube.radii[1 - end]);
        edges.push(Edge { ends: [before, start], is_round: false });
        arc(tube, end, [ahead + from, ahead + to], pen, edges);
    }
}

/// Lines around an end of a tube, between two angles.
fn arc(tube: &Tube, end: usize, [from, to]: [f64; 2], pen: f64, edges: &mut Vec<Edge>) {
    let radius = tube.radii[end];
    // Half the angle of a line that touches the circle, and whose ends are so near.
    let half = libm::acos(radius / (radius + EXACT * pen));
    let count = libm::ceil((to - from) / (2.0 * half)).clamp(1.0, MAX * (to - from) / PI);
    let step = (to - from) / count;
    let far = radius / libm::cos(step / 2.0);
    let mut last = on_circle(tube, end, from, radius);
    let corners = (0..count as u32).map(|number| on_circle(tube, end, from + (f64::from(number) + 0.5) * step, far));
    for corner in corners.chain([on_circle(tube, end, to, radius)]) {
        edges.push(Edge { ends: [last, corner], is_round: true });
        last = corner;
    }
}

fn on_circle(tube: &Tube, end: usize, angle: f64, radius: f64) -> Place {
    let (sin, cos) = libm::sincos(angle);
    let [x, y, depth] = tube.ends[end];
    [x + radius * cos, y + radius * sin, depth]
}
