//! Lines a pen's width apart, in place of broad strokes and of polygons.

use super::page::{Point, distance};
use super::sort::Sort;
use core::f64::consts::FRAC_1_SQRT_2;
use lsystem_syntax::{Meter, Progress};

/// The lines of a stroke of this width, at most `most`: parallel to its axis, joined end to end in turns.
pub(super) fn broad([from, to]: [Point; 2], width: f64, pen: f64, most: u64) -> impl Iterator<Item = [Point; 2]> {
    let length = distance(from, to);
    // The outer lines reach the stroke's sides with half a pen.
    let between = (width - pen).max(0.0);
    let count = (libm::ceil(between / pen) as u64).saturating_add(1).min(most);
    let aside = [(from[1] - to[1]) / length, (to[0] - from[0]) / length];
    let line = move |number: u64| {
        let by = if count > 1 { between * (number as f64 / (count - 1) as f64 - 0.5) } else { 0.0 };
        let ends = [from, to].map(|end| [0, 1].map(|axis| end[axis] + by * aside[axis]));
        if number.is_multiple_of(2) { ends } else { [ends[1], ends[0]] }
    };
    (0..count).flat_map(move |number| {
        let own = line(number);
        let joint = (number + 1 < count).then(|| [own[1], line(number + 1)[0]]);
        core::iter::once(own).chain(joint)
    })
}

/// A crossing of a hatch line and a side of a polygon: the line's number, the place along it, and 1 where the side
/// leads upwards, -1 where it leads downwards.
type Crossing = (i64, f64, i32);

/// The hatch lines of a polygon by the nonzero winding rule. They lie on the same lines for all polygons, at 45
/// degrees.
#[derive(Clone, Debug)]
pub(super) struct Fill {
    vertices: Vec<Point>,
    pen: f64,
    /// The number of the next side, and of its next hatch line.
    side: usize,
    line: Option<i64>,
    crossings: Vec<Crossing>,
    sort: Option<Sort<Crossing>>,
    /// The sorted crossings, the last first.
    sorted: Vec<Crossing>,
    is_sorted: bool,
    /// The winding number and the start of the open hatch line.
    winding: i32,
    start: Option<(i64, f64)>,
}

impl Fill {
    pub(super) fn new(vertices: Vec<Point>, pen: f64) -> Self {
        Self {
            vertices,
            pen,
            side: 0,
            line: None,
            crossings: Vec::new(),
            sort: None,
            sorted: Vec::new(),
            is_sorted: false,
            winding: 0,
            start: None,
        }
    }

    /// Continues until the meter is spent, and hands each line to `draw`. `None` if there are more than `most`
    /// crossings.
    pub(super) fn step(&mut self, most: u64, meter: &mut Meter, mut draw: impl FnMut([Point; 2])) -> Option<Progress> {
        while !meter.is_spent() {
            meter.charge(1);
            if let Some(sort) = &mut self.sort {
                if sort.step(meter) == Progress::Done {
                    self.sorted = self.sort.take()?.finish();
                    self.sorted.reverse();
                    self.is_sorted = true;
                }
            } else if !self.is_sorted {
                if self.side == self.vertices.len() {
                    let order = |a: &Crossing, b: &Crossing| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
                    self.sort = Some(Sort::new(core::mem::take(&mut self.crossings), order));
                } else {
                    self.cross();
                    if self.crossings.len() as u64 > most {
                        return None;
                    }
                }
            } else {
                let Some(crossing) = self.sorted.pop() else { return Some(Progress::Done) };
                if let Some(line) = self.pass(crossing) {
                    draw(line);
                }
            }
        }
        Some(Progress::More)
    }

    /// Adds the next crossing of the present side, or goes on to the next side.
    fn cross(&mut self) {
        let next = self.vertices[(self.side + 1) % self.vertices.len()];
        let [from, to] = [self.vertices[self.side], next].map(turned);
        // Half-open, so that a vertex on a hatch line counts once.
        let number = |v: f64| libm::ceil(v / self.pen - 0.5) as i64;
        let [first, end] = [number(from[1].min(to[1])), number(from[1].max(to[1]))];
        let line = self.line.unwrap_or(first);
        if line >= end {
            (self.side, self.line) = (self.side + 1, None);
            return;
        }
        let part = (self.height(line) - from[1]) / (to[1] - from[1]);
        let way = if to[1] > from[1] { 1 } else { -1 };
        self.crossings.push((line, from[0] + part.clamp(0.0, 1.0) * (to[0] - from[0]), way));
        self.line = Some(line + 1);
    }

    fn height(&self, line: i64) -> f64 {
        (line as f64 + 0.5) * self.pen
    }

    /// Passes a crossing. Returns the line that ends there, if one does.
    fn pass(&mut self, (line, at, way): Crossing) -> Option<[Point; 2]> {
        self.winding += way;
        match self.start {
            None => self.start = Some((line, at)),
            Some((line, start)) if self.winding == 0 => {
                self.start = None;
                let v = self.height(line);
                return (at > start).then(|| [[start, v], [at, v]].map(turned_back));
            }
            Some(_) => {}
        }
        None
    }
}

/// A point in axes along and across the hatch lines.
fn turned([x, y]: Point) -> Point {
    [(x + y) * FRAC_1_SQRT_2, (y - x) * FRAC_1_SQRT_2]
}

fn turned_back([u, v]: Point) -> Point {
    [(u - v) * FRAC_1_SQRT_2, (u + v) * FRAC_1_SQRT_2]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn filled(vertices: &[Point], pen: f64) -> Vec<[Point; 2]> {
        let mut fill = Fill::new(vertices.to_vec(), pen);
        let mut lines = vec![];
        while fill.step(1000, &mut Meter::new(3), |line| lines.push(line)) == Some(Progress::More) {}
        lines
    }

    fn ink(lines: &[[Point; 2]]) -> f64 {
        lines.iter().map(|[a, b]| distance(*a, *b)).sum()
    }

    #[test]
    fn hatch_lines_cover_the_area_once() {
        let square = [[1.0, 1.0], [11.0, 1.0], [11.0, 11.0], [1.0, 11.0]];
        assert!((ink(&filled(&square, 0.1)) * 0.1 - 100.0).abs() < 1.0);
        // Two windings of one square are inside, too.
        let twice = [square, square].concat();
        assert!((ink(&filled(&twice, 0.1)) * 0.1 - 100.0).abs() < 1.0);
        // A bow tie has two triangles.
        let tie = [[0.0, 0.0], [10.0, 10.0], [10.0, 0.0], [0.0, 10.0]];
        assert!((ink(&filled(&tie, 0.1)) * 0.1 - 50.0).abs() < 1.5);
        assert_eq!(Fill::new(square.to_vec(), 1e-3).step(100, &mut Meter::new(u64::MAX), |_| {}), None);
    }

    #[test]
    fn a_broad_stroke_is_one_way_of_lines() {
        let lines: Vec<_> = broad([[0.0, 0.0], [10.0, 0.0]], 1.0, 0.3, 100).collect();
        assert_eq!(lines.len(), 7);
        assert!(lines.windows(2).all(|pair| distance(pair[0][1], pair[1][0]) < 1e-12));
        let reach = lines.iter().flatten().map(|point| point[1].abs()).fold(0.0, f64::max);
        assert!((reach - 0.35).abs() < 1e-12);
        assert_eq!(broad([[0.0, 0.0], [10.0, 0.0]], 0.2, 0.3, 100).count(), 1);
        assert_eq!(broad([[0.0, 0.0], [10.0, 0.0]], 1e300, 0.3, 4).count(), 7);
    }
}
