//! Where two tubes pass through each other.
//!
//! The straight lines along the surface of the thinner tube enter the other one and leave it once, because it is convex.
//! The round ends of the thinner tube are left out.

use super::body::Tube;
use super::meet::unit;
use super::sight::{Place, Sight, cross, dot, minus};
use super::span::Span;
use core::f64::consts::PI;

/// The parts of the way around a tube that are tried first, and the most halvings of each.
const PARTS: u32 = 24;
const HALVED: u32 = 8;
/// The halvings to find where the lines begin to meet the other tube.
const FOUND: u32 = 16;

/// Adds the lines where the surfaces of two tubes meet: chords of both tubes widened by `exact`, at most `exact` inside
/// their surfaces.
pub(super) fn tubes(pair: [&Tube; 2], exact: f64, lines: &mut Vec<[Place; 2]>) {
    let [a, b] = pair.map(|tube| tube.grown(exact));
    let [thin, thick] = if a.widest() <= b.widest() { [a, b] } else { [b, a] };
    // Balls on the thinner tube's axis reach the other tube only where the axis reaches it widened.
    if thick.grown(thin.widest()).inside(&Sight::through(thin.ends)).within(0.0, 1.0).is_empty() {
        return;
    }
    let Some(around) = Around::new(&thin, &thick) else { return };
    let mut before = around.ends(0.0);
    for part in 1..=PARTS {
        let angle = f64::from(part) / f64::from(PARTS) * 2.0 * PI;
        let next = around.ends(angle);
        match (before.is_met(), next.is_met()) {
            (true, true) => around.both([before, next], exact, lines),
            (true, false) => around.up_to(before, next, exact, lines),
            (false, true) => around.up_to(next, before, exact, lines),
            (false, false) => {}
        }
        before = next;
    }
}

/// The straight lines along a tube.
struct Around<'a> {
    other: &'a Tube,
    /// Where the lines begin and end on the axis, and how far aside.
    middles: [Place; 2],
    aside: [f64; 2],
    /// Two directions across the axis.
    axes: [Place; 2],
}

/// Where the line at an angle enters the other tube and leaves it, as places along the line. Not finite if it does not.
#[derive(Clone, Copy)]
struct Ends {
    angle: f64,
    places: [f64; 2],
}

impl Ends {
    fn is_met(self) -> bool {
        self.places[0] < self.places[1] && self.places.iter().all(|place| place.is_finite())
    }
}

impl<'a> Around<'a> {
    fn new(tube: &Tube, other: &'a Tube) -> Option<Self> {
        let axis = minus(tube.ends[1], tube.ends[0]);
        let length = dot(axis, axis).sqrt();
        let sides = tube.sides(length)?;
        let along = axis.map(|part| part / length);
        let middles = sides.map(|[far, _]| [0, 1, 2].map(|at| tube.ends[0][at] + far * along[at]));
        let least = if along[0].abs() < along[1].abs() { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let aside = unit(cross(along, least));
        Some(Self { other, middles, aside: sides.map(|side| side[1]), axes: [aside, cross(along, aside)] })
    }

    fn line(&self, angle: f64) -> Sight {
        let (sin, cos) = libm::sincos(angle);
        let end = |end: usize| {
            let out = |at: usize| self.aside[end] * (cos * self.axes[0][at] + sin * self.axes[1][at]);
            [0, 1, 2].map(|at| self.middles[end][at] + out(at))
        };
        Sight::through([end(0), end(1)])
    }

    fn ends(&self, angle: f64) -> Ends {
        let span = self.other.inside(&self.line(angle));
        Ends { angle, places: [span.low, span.high] }
    }

    /// Adds the chords between two angles at which lines meet the other tube: where they enter it, and where they leave
    /// it.
    fn both(&self, ends: [Ends; 2], exact: f64, lines: &mut Vec<[Place; 2]>) {
        for way in [0, 1] {
            self.chords(ends, way, exact, HALVED, lines);
        }
    }

    /// Adds the chords from an angle at which the line meets the other tube towards one at which it does not.
    fn up_to(&self, met: Ends, missed: Ends, exact: f64, lines: &mut Vec<[Place; 2]>) {
        let (mut last, mut far) = (met, missed.angle);
        for _ in 0..FOUND {
            let middle = self.ends(f64::midpoint(last.angle, far));
            if middle.is_met() { last = middle } else { far = middle.angle }
        }
        self.both([met, last], exact, lines);
        let line = self.line(last.angle);
        // There, both are one point.
        add(last.places.map(|place| line.at(place)), last.places, lines);
    }

    fn chords(&self, [from, to]: [Ends; 2], way: usize, exact: f64, halved: u32, lines: &mut Vec<[Place; 2]>) {
        let at = |ends: Ends| self.line(ends.angle).at(ends.places[way]);
        let middle = self.ends(f64::midpoint(from.angle, to.angle));
        if halved > 0 && middle.is_met() && aside([at(from), at(to)], at(middle)) > exact {
            self.chords([from, middle], way, exact, halved - 1, lines);
            self.chords([middle, to], way, exact, halved - 1, lines);
        } else {
            add([at(from), at(to)], [from, to].map(|ends| ends.places[way]), lines);
        }
    }
}

/// Adds the part of a chord that is on the straight lines, between the places 0 and 1 along them.
fn add(ends: [Place; 2], [from, to]: [f64; 2], lines: &mut Vec<[Place; 2]>) {
    let chord = Sight::through(ends);
    let span = Span::ALL.below(-from, from - to).below(from - 1.0, to - from).within(0.0, 1.0);
    if !span.is_empty() {
        lines.push([span.low, span.high].map(|part| chord.at(part)));
    }
}

/// The distance of a place from a chord.
fn aside([from, to]: [Place; 2], place: Place) -> f64 {
    let (way, own) = (minus(to, from), minus(place, from));
    let part = (dot(own, way) / dot(way, way)).clamp(0.0, 1.0);
    // The ends may be one point.
    let out = if part.is_nan() { own } else { [0, 1, 2].map(|at| own[at] - part * way[at]) };
    dot(out, out).sqrt()
}
