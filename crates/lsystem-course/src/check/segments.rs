//! Segments, compared up to place and size, within the rounding of the output.

use super::{Check, LIMITS, MAX_SEGMENTS, Output, Verdict, candidates};
use crate::fit::{Ends, Fit, extent, length};
use lsystem_base::LimitName;
use lsystem_base::say;
use lsystem_drawing::{Figure, System, count_segments};
use lsystem_files::{SegmentFile, SegmentForm};
use lsystem_syntax::Diagnostic;
use std::collections::HashMap;

/// The part of a usual segment's length by which ends may differ.
const NEAR: f64 = 0.05;
/// The part of the drawing's size by which ends may always differ, for rounding errors of the arithmetic.
const TINY: f64 = 1e-9;

pub(super) fn check(system: &System, n: u32, file: &SegmentFile) -> Check {
    let (output, found) = match file.form {
        SegmentForm::Svg => (Output::Svg, upright(&file.segments)),
        SegmentForm::Table => (Output::Table, file.segments.clone()),
    };
    let checked = |expected: Option<usize>, verdict| Check {
        output,
        generation: n,
        expected: expected.map(|count| count as u128),
        found: found.len() as u64,
        verdict,
    };
    if system.is_solid() && !file.is_solid {
        let reason = say!("the drawing is in space, and the output has no z coordinates");
        return checked(None, Verdict::Unreadable(reason));
    }
    let expected = match segments_of(system, n) {
        Ok(segments) => segments,
        Err(limit) => return checked(None, Verdict::Failed(vec![limit])),
    };
    let verdict = compare(&expected, &found, file.rounding).or_else(|| {
        let is_generation = |&other: &u32| {
            let segments = segments_of(system, other);
            segments.is_ok_and(|segments| is_same(&segments, &found, file.rounding).is_ok())
        };
        candidates(n, found.len() as u64, |other| count_segments(system, other))
            .find(is_generation)
            .map(Verdict::Generation)
    });
    let verdict = verdict.unwrap_or_else(|| {
        let index = common_start(&expected, &found, file.rounding);
        Verdict::Segment {
            index: index as u64,
            expected: expected.get(index).copied(),
            found: file.segments.get(index).copied(),
        }
    });
    checked(Some(expected.len()), verdict)
}

/// The segments of a picture with y up.
fn upright(segments: &[Ends]) -> Vec<Ends> {
    segments.iter().map(|segment| segment.map(|[x, y, z]| [x, -y, z])).collect()
}

/// The segments of generation `n`.
///
/// # Errors
/// The limit that the drawing exceeds.
fn segments_of(system: &System, n: u32) -> Result<Vec<Ends>, Diagnostic> {
    let most = MAX_SEGMENTS as u64;
    let figure = Figure::draw(system, n, &LIMITS)?;
    if figure.segment_count() > u128::from(most) {
        return Err(Diagnostic::limit(LimitName::Segments, most, None));
    }
    Ok(figure.segments_from(0).map(|segment| [segment.from, segment.to]).collect())
}

/// Whether two lists of segments are the same, within a tolerance.
type Test = fn(&[Ends], &[Ends], f64) -> bool;

/// The verdict if both are the same up to order, turns by 90 degrees and mirroring.
fn compare(expected: &[Ends], found: &[Ends], rounding: f64) -> Option<Verdict> {
    if is_same(expected, found, rounding).is_ok() {
        return Some(Verdict::Same);
    }
    if is_same_set(expected, found, rounding) {
        return Some(Verdict::Reordered);
    }
    // The same order says more than the same set: a mirrored corner is a turned corner in another order.
    let tests: [Test; 2] = [|a, b, r| is_same(a, b, r).is_ok(), is_same_set];
    tests.into_iter().find_map(|test| {
        let turns =
            [false, true].into_iter().flat_map(|is_mirrored| (0..4).map(move |quarters| (quarters, is_mirrored)));
        turns.skip(1).find_map(|(quarters, is_mirrored)| {
            let turned: Vec<Ends> = expected.iter().map(|&segment| turn(segment, quarters, is_mirrored)).collect();
            let verdict = Verdict::Placed { degrees: 90 * quarters, is_mirrored };
            test(&turned, found, rounding).then_some(verdict)
        })
    })
}

/// A segment mirrored left to right, then turned by quarters counter-clockwise about the z axis.
fn turn(segment: Ends, quarters: u32, is_mirrored: bool) -> Ends {
    segment.map(|[x, y, z]| {
        let x = if is_mirrored { -x } else { x };
        match quarters {
            0 => [x, y, z],
            1 => [-y, x, z],
            2 => [-x, -y, z],
            _ => [y, -x, z],
        }
    })
}

/// Both fitted, with the distance up to which ends count as equal.
struct Pair {
    expected: Fit,
    found: Fit,
    near: f64,
}

impl Pair {
    fn new(segments: [&[Ends]; 2], fit: fn(&[Ends]) -> Fit, rounding: f64) -> Self {
        let [expected, found] = segments.map(fit);
        let mut lengths: Vec<f64> = segments[0].iter().map(length).filter(|&length| length > 0.0).collect();
        let middle = lengths.len() / 2;
        let usual = match lengths.is_empty() {
            true => 0.0,
            false => *lengths.select_nth_unstable_by(middle, f64::total_cmp).1,
        };
        // Rounding moves both the ends and the extent by half a step along each axis.
        let rounded = 1.5 * rounding / found.size;
        let tiny = TINY * Fit::whole(segments[0]).size / expected.size;
        // A coarse rounding must not make everything equal.
        let near = (NEAR * usual / expected.size).max(rounded.min(usual / expected.size / 2.0)).max(tiny);
        Self { expected, found, near }
    }

    /// Whether the ends of two fitted segments are at most `near` apart along each axis, in either direction.
    fn is_near(a: &Ends, b: &Ends, near: f64) -> bool {
        let ends = |a: &[f64; 3], b: &[f64; 3]| (0..3).all(|axis| (a[axis] - b[axis]).abs() <= near);
        (ends(&a[0], &b[0]) && ends(&a[1], &b[1])) || (ends(&a[0], &b[1]) && ends(&a[1], &b[0]))
    }

    fn is_equal(&self, expected: &Ends, found: &Ends) -> bool {
        Self::is_near(&self.expected.place(expected), &self.found.place(found), self.near)
    }
}

/// Whether the segments are the same in the same order; the first difference if not.
fn is_same(expected: &[Ends], found: &[Ends], rounding: f64) -> Result<(), usize> {
    let pair = Pair::new([expected, found], Fit::whole, rounding);
    same_start(&pair, expected, found)
}

fn same_start(pair: &Pair, expected: &[Ends], found: &[Ends]) -> Result<(), usize> {
    let equal = expected.iter().zip(found).take_while(|(expected, found)| pair.is_equal(expected, found)).count();
    if equal == expected.len() && equal == found.len() { Ok(()) } else { Err(equal) }
}

/// The number of equal segments at the start, fitted as a whole or by the first segment, whichever explains more.
fn common_start(expected: &[Ends], found: &[Ends], rounding: f64) -> usize {
    let fits: [fn(&[Ends]) -> Fit; 2] = [Fit::whole, Fit::first];
    let start = |fit| same_start(&Pair::new([expected, found], fit, rounding), expected, found).err();
    fits.into_iter().filter_map(start).max().unwrap_or(0)
}

/// Whether each segment has an equal one on the other side. Repeats do not count.
fn is_same_set(expected: &[Ends], found: &[Ends], rounding: f64) -> bool {
    let pair = Pair::new([expected, found], Fit::whole, rounding);
    let expected: Vec<Ends> = expected.iter().map(|segment| pair.expected.place(segment)).collect();
    let found: Vec<Ends> = found.iter().map(|segment| pair.found.place(segment)).collect();
    let [sides, others] = [extent(&expected), extent(&found)];
    let is_as_large =
        sides.iter().flatten().zip(others.iter().flatten()).all(|(a, b)| (a - b).abs() <= 2.0 * pair.near);
    expected.is_empty() == found.is_empty()
        && (expected.is_empty() || is_as_large)
        && is_within(&expected, &found, pair.near)
        && is_within(&found, &expected, pair.near)
}

/// The most segments of one cell that are compared.
const MAX_IN_CELL: usize = 256;

/// Whether each segment of `some` has one in `all` that is at most `near` away.
fn is_within(some: &[Ends], all: &[Ends], near: f64) -> bool {
    // Segments by the cell of their middle. Middles of equal segments are at most a quarter of a cell apart, so they
    // lie in the same cell or in the nearer neighbours.
    let side = 4.0 * near.max(f64::MIN_POSITIVE);
    let middle = |segment: &Ends| [0, 1, 2].map(|axis| (segment[0][axis] + segment[1][axis]) / 2.0 / side);
    let mut cells: HashMap<[i64; 3], Vec<&Ends>> = HashMap::with_capacity(all.len());
    for segment in all {
        let inside = cells.entry(middle(segment).map(|value| libm::floor(value) as i64)).or_default();
        // Repeats are kept once, so that a cell with many of them stays short.
        if inside.len() < MAX_IN_CELL && !inside.iter().any(|other| Pair::is_near(other, segment, near / 8.0)) {
            inside.push(segment);
        }
    }
    some.iter().all(|segment| {
        let at = middle(segment);
        (0..8).any(|corner| {
            let cell = [0, 1, 2].map(|axis| {
                let own = libm::floor(at[axis]);
                let is_beside = corner >> axis & 1 == 1;
                let beside = if at[axis] - own < 0.5 { own - 1.0 } else { own + 1.0 };
                (if is_beside { beside } else { own }) as i64
            });
            cells.get(&cell).is_some_and(|inside| inside.iter().any(|other| Pair::is_near(segment, other, near)))
        })
    })
}
