//! Whether two pictures have the same ink, whatever the order of their segments, their repeats and their subdivision.

use crate::fit::{Ends, Fit, extent, length};
use lsystem_base::sorted;
use std::collections::HashMap;

/// Places and directions that differ by less are equal, in pictures whose longest side is 1.
const NEAR: f64 = 1e-8;
/// The size of the cells in which equal lines are looked up. Lines in one cell are equal.
const CELL: f64 = 1e-6;
/// Where the cells begin. Coordinates of drawings are seldom near a border then.
const BORDER: f64 = 0.377 * CELL;

/// A stretch of ink: the number of the line that carries it, and where it starts and ends along the line.
#[derive(Clone, Copy)]
struct Stretch {
    line: u32,
    start: f64,
    end: f64,
}

/// The ink of a picture, to be compared with others.
pub(crate) struct Outline {
    lines: Lines,
    stretches: Vec<Stretch>,
}

/// Whether two pictures have the same ink after the centre of each is moved to the origin and its longest side is made
/// 1. Pictures without ink are equal. A picture with a coordinate that is not finite is equal to none.
///
/// The work grows as m log m in the number of segments.
#[must_use]
pub fn is_same_picture(a: &[Ends], b: &[Ends]) -> bool {
    Outline::new(a, &[]).is_some_and(|mut outline| outline.is_of(b, &[]) == Some(true))
}

impl Outline {
    /// The ink of segments and of the sides of filled shapes; `None` if a coordinate is not finite.
    pub(crate) fn new(segments: &[Ends], sides: &[Ends]) -> Option<Self> {
        let fit = fit(segments, sides)?;
        let mut lines = Lines::default();
        let stretches = lines.stretches(&fit, segments, sides, true)?;
        Some(Self { lines, stretches })
    }

    /// Whether another picture has the same ink; `None` if a coordinate of the other is not finite.
    pub(crate) fn is_of(&mut self, segments: &[Ends], sides: &[Ends]) -> Option<bool> {
        let fit = fit(segments, sides)?;
        let Some(others) = self.lines.stretches(&fit, segments, sides, false) else { return Some(false) };
        let near = |a: f64, b: f64| (a - b).abs() < 2.0 * NEAR;
        let is_same = self.stretches.len() == others.len()
            && (self.stretches.iter().zip(&others))
                .all(|(a, b)| a.line == b.line && near(a.start, b.start) && near(a.end, b.end));
        Some(is_same)
    }
}

/// How a picture is moved and scaled; `None` if a coordinate or the size is not finite.
fn fit(segments: &[Ends], sides: &[Ends]) -> Option<Fit> {
    let is_finite = |segment: &Ends| segment.as_flattened().iter().all(|value| value.is_finite());
    if !segments.iter().chain(sides).all(is_finite) {
        return None;
    }
    let [a, b] = [extent(segments), extent(sides)];
    let low = [0, 1, 2].map(|axis| a[0][axis].min(b[0][axis]));
    let high = [0, 1, 2].map(|axis| a[1][axis].max(b[1][axis]));
    let is_too_large = (0..3).any(|axis| high[axis] - low[axis] == f64::INFINITY);
    (!is_too_large).then(|| Fit::of([low, high]))
}

/// The cell of a line. Lines of sides of filled shapes are other lines.
type Cell = (bool, [i32; 6]);

/// The lines that carry a picture's ink.
#[derive(Default)]
struct Lines {
    numbers: HashMap<Cell, u32>,
}

impl Lines {
    /// The ink as disjoint stretches in order, after the picture is moved and scaled. `None` if a line is not known and
    /// `learns` is false.
    fn stretches(&mut self, fit: &Fit, segments: &[Ends], sides: &[Ends], learns: bool) -> Option<Vec<Stretch>> {
        let mut stretches = Vec::with_capacity(segments.len() + sides.len());
        for (list, is_side) in [(segments, false), (sides, true)] {
            for segment in list {
                let placed = fit.place(segment);
                if (0..3).all(|axis| (placed[1][axis] - placed[0][axis]).abs() <= NEAR) {
                    continue;
                }
                let (coordinates, [start, end]) = line(&placed);
                let line = match self.find(is_side, coordinates) {
                    Some(line) => line,
                    None if learns => self.learn(is_side, coordinates),
                    None => return None,
                };
                stretches.push(Stretch { line, start, end });
            }
        }
        Some(merged(stretches))
    }

    /// The number of a line. A coordinate near the border of its cell may be in the next cell, too.
    fn find(&self, is_side: bool, coordinates: [f64; 6]) -> Option<u32> {
        let cell = coordinates.map(cell);
        if let Some(&number) = self.numbers.get(&(is_side, cell)) {
            return Some(number);
        }
        let other = coordinates.map(|value| [cell_or(value, -NEAR), cell_or(value, NEAR)]);
        let choices = [0, 1, 2, 3, 4, 5].map(|axis| {
            let [low, high] = other[axis];
            if low == cell[axis] { high } else { low }
        });
        let near_border: u32 = (0..6).filter(|&axis| choices[axis] != cell[axis]).map(|axis| 1 << axis).sum();
        // All subsets of the coordinates that are near a border.
        let mut subset = near_border;
        while subset != 0 {
            let mut next = cell;
            (0..6).filter(|axis| subset >> axis & 1 == 1).for_each(|axis| next[axis] = choices[axis]);
            if let Some(&number) = self.numbers.get(&(is_side, next)) {
                return Some(number);
            }
            subset = (subset - 1) & near_border;
        }
        None
    }

    fn learn(&mut self, is_side: bool, coordinates: [f64; 6]) -> u32 {
        let number = self.numbers.len() as u32;
        self.numbers.insert((is_side, coordinates.map(cell)), number);
        number
    }
}

fn cell(value: f64) -> i32 {
    cell_or(value, 0.0)
}

fn cell_or(value: f64, offset: f64) -> i32 {
    libm::floor((value + offset + BORDER) / CELL) as i32
}

/// The line that carries a segment, as its direction and its point nearest to the origin, and where the segment starts
/// and ends along it.
fn line(segment: &Ends) -> ([f64; 6], [f64; 2]) {
    let [from, to] = segment;
    let along = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let length = length(segment);
    // Both ways along a line are the same line.
    let sign = along.into_iter().find(|part| part.abs() > 10.0 * NEAR * length).unwrap_or(1.0).signum();
    let way = along.map(|part| part * sign / length);
    let (start, end) = (dot(*from, way), dot(*to, way));
    let middle = f64::midpoint(start, end);
    let near = [0, 1, 2].map(|axis| f64::midpoint(from[axis], to[axis]) - middle * way[axis]);
    ([way[0], way[1], way[2], near[0], near[1], near[2]], [start.min(end), start.max(end)])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Stretches that touch or overlap become one.
fn merged(mut stretches: Vec<Stretch>) -> Vec<Stretch> {
    sorted::sort_by(&mut stretches, |a, b| a.line.cmp(&b.line).then(a.start.total_cmp(&b.start)));
    stretches.dedup_by(|next, last| {
        let touches = next.line == last.line && next.start < last.end + NEAR;
        if touches {
            last.end = last.end.max(next.end);
        }
        touches
    });
    stretches
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The edges of a box of the given size, with its lowest corner at `at`.
    fn edges(at: [f64; 3], size: [f64; 3]) -> Vec<Ends> {
        let corner = |bits: usize| [0, 1, 2].map(|axis| at[axis] + size[axis] * (bits >> axis & 1) as f64);
        let pairs = (0..8).flat_map(|bits| (0..3).map(move |axis| (bits, bits | 1 << axis)));
        pairs.filter(|(from, to)| from != to).map(|(from, to)| [corner(from), corner(to)]).collect()
    }

    #[test]
    fn pictures_in_space_are_compared() {
        let cube = edges([0.0; 3], [1.0; 3]);
        let moved: Vec<Ends> = edges([5.0, -7.0, 0.1], [0.3; 3]).iter().rev().map(|&[a, b]| [b, a]).collect();
        assert_eq!((cube.len(), moved.len()), (12, 12));
        assert!(is_same_picture(&cube, &moved), "moved, smaller, the other way round");
        let halves = cube.iter().flat_map(|&[a, b]| {
            let middle = [0, 1, 2].map(|axis| f64::midpoint(a[axis], b[axis]));
            [[a, middle], [middle, b], [b, a]]
        });
        assert!(is_same_picture(&cube, &halves.collect::<Vec<_>>()), "subdivided and repeated");
        assert!(!is_same_picture(&cube, &cube[1..]), "an edge is missing");
        assert!(!is_same_picture(&cube, &edges([0.0; 3], [1.0, 1.0, 0.999])), "not as deep");
        let diagonal = [&cube[..], &[[[0.0; 3], [1.0; 3]]]].concat();
        assert!(!is_same_picture(&cube, &diagonal), "a diagonal more");
        let flat: Vec<Ends> = cube.iter().map(|edge| edge.map(|[x, y, _]| [x, y, 0.0])).collect();
        assert!(!is_same_picture(&cube, &flat), "seen from above");
    }

    #[test]
    fn pictures_that_are_not_finite_are_equal_to_none() {
        let plain = [[[0.0; 3], [1.0, 0.0, 0.0]]];
        for wrong in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let broken = [plain[0], [[0.0; 3], [0.0, wrong, 0.0]]];
            for other in [&broken[..], &plain[..], &[]] {
                assert!(!is_same_picture(&broken, other) && !is_same_picture(other, &broken), "{wrong} {other:?}");
            }
        }
        // A size beyond the largest number is not finite, either.
        let huge = [[[-f64::MAX; 3], [f64::MAX; 3]]];
        assert!(!is_same_picture(&huge, &huge) && !is_same_picture(&plain, &huge));
        assert!(is_same_picture(&[], &[]));
        assert!(is_same_picture(&[], &[[[3.0; 3]; 2]]), "a point has no ink");
    }
}
