//! The first segment of an answer that the target does not have.

use crate::fit::{Ends, Fit, length};
use lsystem_base::sorted;
use std::collections::HashSet;

/// The part of a usual segment by which places, directions and lengths may differ.
const NEAR: f64 = 1e-6;
/// The segments that decide on the scale.
const COMPARED: usize = 1_000;
/// The size of the cells in which equal segments are looked up, in lengths of the first segment, and where they begin.
const CELL: f64 = 1e-5;
const BORDER: f64 = 0.377 * CELL;

/// The first difference of an answer's segments from the target's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Difference {
    /// The segments of the answer before it, all of which the target has.
    pub right: usize,
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// The next segment has the right direction.
    TooShort,
    TooLong,
    /// The next segment has the right length; the angle to the target's segment counter-clockwise, in degrees, if both are
    /// in the plane.
    Turned(Option<f64>),
    /// The next segment has another direction and another length.
    Other,
    /// No segment of the target that is still to be drawn begins where the next segment does.
    Elsewhere,
    /// The target has all segments of the answer, and this many more.
    Missing(usize),
    /// The answer has all segments of the target, and this many more.
    TooMany(usize),
}

impl Difference {
    /// `None` if there is none.
    pub(crate) fn of(own: &[Ends], target: &[Ends]) -> Option<Self> {
        let (target, own) = placed(own, target)?;
        let has = target.iter().map(key).collect::<HashSet<_>>();
        let done = own.iter().map(key).collect::<HashSet<_>>();
        let left = |segment: &&Ends| !done.contains(&key(segment));
        let Some(right) = own.iter().position(|segment| !has.contains(&key(segment))) else {
            let missing = target.iter().filter(left).count();
            return (missing > 0).then_some(Self { right: own.len(), kind: Kind::Missing(missing) });
        };
        if target.iter().all(|segment| done.contains(&key(segment))) {
            let more = own.iter().filter(|segment| !has.contains(&key(segment))).count();
            return Some(Self { right, kind: Kind::TooMany(more) });
        }
        let next = own[right];
        let begins_there = |segment: &&Ends| distance(segment[0], next[0]) < CELL;
        let kinds = target.iter().filter(left).filter(begins_there).map(|segment| kind(&next, segment));
        let rank = |kind: &Kind| match kind {
            Kind::TooShort | Kind::TooLong => 0,
            Kind::Turned(_) => 1,
            _ => 2,
        };
        Some(Self { right, kind: kinds.min_by_key(rank).unwrap_or(Kind::Elsewhere) })
    }
}

/// Both drawings with their first segment at the origin. The scale is that which makes most segments alike: as drawn, or
/// such that the first segments, or the usual ones, are equally long.
fn placed(own: &[Ends], target: &[Ends]) -> Option<(Vec<Ends>, Vec<Ends>)> {
    let fit = Fit::first(target);
    let start = Fit::first(own);
    let usual = |list: &[Ends]| {
        let mut lengths = list.iter().take(COMPARED).map(length).filter(|long| *long > 0.0).collect::<Vec<_>>();
        sorted::sort_by(&mut lengths, f64::total_cmp);
        lengths.get(lengths.len() / 2).copied()
    };
    let sizes = [fit.size, start.size, fit.size * usual(own)? / usual(target)?];
    let target = target.iter().map(|segment| fit.place(segment)).collect::<Vec<_>>();
    let scaled = |size: f64| {
        let fit = Fit { size, ..start };
        own.iter().map(move |segment| fit.place(segment))
    };
    let alike = |size: f64| {
        let way = |[from, to]: &Ends| [0, 1, 2].map(|axis| to[axis] - from[axis]);
        scaled(size).zip(&target).take(COMPARED).filter(|(a, b)| distance(way(a), way(b)) < NEAR).count()
    };
    let size = sizes.into_iter().rev().max_by_key(|size| alike(*size)).filter(|size| size.is_normal())?;
    let own = scaled(size).collect();
    Some((target, own))
}

/// How a segment differs from another with the same start.
fn kind(own: &Ends, target: &Ends) -> Kind {
    let [a, b] = [own, target].map(|[from, to]| [0, 1, 2].map(|axis| to[axis] - from[axis]));
    let [long, expected] = [own, target].map(length);
    let is_straight = distance(a.map(|part| part * expected), b.map(|part| part * long)) < NEAR * long * expected;
    let is_long = (long - expected).abs() < NEAR * expected;
    match (is_straight, is_long) {
        (true, _) if long < expected => Kind::TooShort,
        (true, _) => Kind::TooLong,
        (false, true) => {
            let is_flat = a[2] == 0.0 && b[2] == 0.0;
            let turn = libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]).to_degrees();
            Kind::Turned(is_flat.then_some(turn))
        }
        (false, false) => Kind::Other,
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    length(&[a, b])
}

/// Equal for equal segments, whichever way they are drawn.
fn key(segment: &Ends) -> [[i64; 3]; 2] {
    let [a, b] = segment.map(|point| point.map(|value| libm::floor((value + BORDER) / CELL) as i64));
    [a.min(b), a.max(b)]
}
