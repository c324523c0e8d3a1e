//! Branches compared with the segments that carry them: how long they are, and where they turn.

use crate::fit::{Ends, length};
use std::collections::HashMap;

/// Ratios and turns that differ by less are equal.
const NEAR: f64 = 1e-6;
/// Ends in one cell are at the same place: its size as a part of the longest segment, and where the cells begin.
const CELL: f64 = 1e-9;
const BORDER: f64 = 0.377;

/// A segment beside the earlier one at whose end it begins.
struct Joint {
    /// The number of the segment that carries this one.
    carrier: usize,
    /// The length, in lengths of the carrier.
    ratio: f64,
    /// The angle to the carrier and to the carrier's carrier, in radians: counter-clockwise in the plane.
    turns: [f64; 2],
}

/// The segments of two drawings that correspond one by one.
pub(crate) struct Branches {
    pairs: Vec<Option<[Joint; 2]>>,
}

/// The first segment that stands otherwise to its carrier than the target's does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Joined {
    /// The segments before it.
    pub right: usize,
    /// Whether it is too short or too long beside its carrier; `None` if it turns otherwise.
    pub length: Option<LengthFault>,
    /// Whether all segments that have carriers are like it.
    pub is_every: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LengthFault {
    TooShort,
    TooLong,
}

impl Branches {
    /// `None` if the segments do not correspond: there are more of one drawing, or others carry them.
    pub(crate) fn of(own: &[Ends], target: &[Ends]) -> Option<Self> {
        if own.len() != target.len() {
            return None;
        }
        let pairs = joints(own).into_iter().zip(joints(target)).map(|pair| match pair {
            (Some(own), Some(target)) if own.carrier == target.carrier => Some(Some([own, target])),
            (None, None) => Some(None),
            _ => None,
        });
        let pairs = pairs.collect::<Option<Vec<_>>>()?;
        pairs.iter().any(Option::is_some).then_some(Self { pairs })
    }

    /// How much the lengths and turns of all branches agree, from 0 to 1.
    pub(crate) fn agreement(&self) -> f64 {
        let agrees = |[own, target]: &[Joint; 2]| {
            let turn = own.turns.iter().zip(target.turns).map(|(own, target)| turned(*own, target).abs()).sum::<f64>();
            let short = own.ratio.min(target.ratio) / own.ratio.max(target.ratio);
            short * (1.0 - turn / core::f64::consts::TAU)
        };
        let (sum, count) =
            self.pairs.iter().flatten().fold((0.0, 0.0), |(sum, count), pair| (sum + agrees(pair), count + 1.0));
        sum / count
    }

    /// `None` if there is none.
    pub(crate) fn first_difference(&self) -> Option<Joined> {
        let differs = |pair: &Option<[Joint; 2]>| pair.as_ref().and_then(difference);
        let right = self.pairs.iter().position(|pair| differs(pair).is_some())?;
        let length = differs(&self.pairs[right])?;
        let is_every = self.pairs.iter().flatten().all(|pair| difference(pair) == Some(length));
        Some(Joined { right, length, is_every })
    }
}

/// The difference of a segment from the target's, if there is one: of its length, or else of its turn.
fn difference([own, target]: &[Joint; 2]) -> Option<Option<LengthFault>> {
    if (own.ratio - target.ratio).abs() > NEAR * target.ratio {
        return Some(Some(if own.ratio < target.ratio { LengthFault::TooShort } else { LengthFault::TooLong }));
    }
    (turned(own.turns[0], target.turns[0]).abs() > NEAR).then_some(None)
}

/// The difference of two angles, from -pi to pi.
fn turned(from: f64, to: f64) -> f64 {
    libm::remainder(to - from, core::f64::consts::TAU)
}

/// The joint of each segment; `None` for those that no earlier segment carries, and without a length.
fn joints(segments: &[Ends]) -> Vec<Option<Joint>> {
    let cell = segments.iter().map(length).fold(0.0, f64::max) * CELL;
    let key = |point: [f64; 3]| point.map(|value| libm::floor(value / cell + BORDER) as i64);
    let is_flat = segments.iter().flatten().all(|point| point[2] == 0.0);
    let mut ends = HashMap::new();
    let mut carriers = Vec::with_capacity(segments.len());
    for (number, segment) in segments.iter().enumerate() {
        carriers.push(ends.get(&key(segment[0])).copied());
        if length(segment) > 0.0 {
            ends.insert(key(segment[1]), number);
        }
    }
    let joint = |(number, carrier): (usize, &Option<usize>)| {
        let (segment, below) = (&segments[number], (*carrier)?);
        let ratio = length(segment) / length(&segments[below]);
        let before = carriers[below].map_or(below, |before| before);
        let turns = [below, before].map(|other| angle(&segments[other], segment, is_flat));
        (ratio > 0.0 && ratio.is_finite()).then_some(Joint { carrier: below, ratio, turns })
    };
    carriers.iter().enumerate().map(joint).collect()
}

/// The angle from one segment to another; without a sign in space.
fn angle(from: &Ends, to: &Ends, is_flat: bool) -> f64 {
    let [a, b] = [from, to].map(|[start, end]| [0, 1, 2].map(|axis| end[axis] - start[axis]));
    let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let across = if is_flat { cross[2] } else { length(&[[0.0; 3], cross]) };
    libm::atan2(across, a.iter().zip(b).map(|(a, b)| a * b).sum())
}
