//! Strokes that overlap become pieces that do not, so that no ink is drawn twice.
//!
//! The pieces of a line end where strokes end, so that strokes of other lines that start there meet an end.

use crate::cells::Cells;
use crate::page::{Point, distance};
use lsystem_base::sorted;
use lsystem_syntax::{Halt, Work};

/// Points nearer than a tenth of this are one point, in millimetres; a plotter's step is at least ten times as long.
pub(crate) const JOINT: f64 = 1e-3;
/// Directions nearer than a tenth of this are one direction, as the sine of the angle or twice that. Along a sheet of
/// A4 this is less than [`JOINT`].
const DIRECTION: f64 = 2e-6;
/// Shorter strokes are points: their directions would be rounding errors.
pub(crate) const LEAST: f64 = 1e-5;

/// A straight piece of ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Piece {
    pub(crate) layer: u32,
    pub(crate) ends: [Point; 2],
}

/// The lines that carry the strokes, and where strokes start and end along them.
pub(crate) struct Merge {
    centre: Point,
    numbers: Cells,
    lines: Vec<Line>,
    ends: Vec<End>,
}

/// A line of one layer: a unit vector along the line, and the distance to its left from the sheet's centre.
#[derive(Clone, Copy, Debug)]
struct Line {
    layer: u32,
    way: Point,
    aside: f64,
}

/// A place along a line where strokes start or end.
#[derive(Clone, Copy, Debug)]
struct End {
    line: u32,
    at: f64,
    /// The number of strokes that start here, less those that end here.
    starts: i32,
}

impl Merge {
    /// No ink, on a sheet of this size.
    pub(crate) fn new(size: [f64; 2]) -> Self {
        let centre = size.map(|side| side / 2.0);
        Self { centre, numbers: Cells::new([DIRECTION, JOINT]), lines: Vec::new(), ends: Vec::new() }
    }

    /// Adds a stroke.
    pub(crate) fn add(&mut self, layer: u32, [from, to]: [Point; 2]) {
        let length = distance(from, to);
        if length.is_nan() || length <= LEAST {
            return;
        }
        let mut way = [0, 1].map(|axis| (to[axis] - from[axis]) / length);
        // Both ways along a line are the same line. Nearly vertical lines lead downwards.
        if way[0] < -DIRECTION || (way[0] <= DIRECTION && way[1] < 0.0) {
            way = way.map(|part| -part);
        }
        // Grows with the angle, and is nearly proportional to it.
        let sum = way[0].abs() + way[1].abs();
        let direction = if way[0] >= 0.0 { way[1] / sum } else { 1.0 - way[0] / sum };
        let middle = [0, 1].map(|axis| f64::midpoint(from[axis], to[axis]) - self.centre[axis]);
        let aside = way[0] * middle[1] - way[1] * middle[0];
        let (number, is_new) = self.numbers.number(layer, [direction, aside]);
        if is_new {
            self.lines.push(Line { layer, way, aside });
        }
        let line = self.lines[number as usize];
        let along =
            |point: Point| line.way[0] * (point[0] - self.centre[0]) + line.way[1] * (point[1] - self.centre[1]);
        let (start, end) = (along(from), along(to));
        self.ends.push(End { line: number, at: start.min(end), starts: 1 });
        self.ends.push(End { line: number, at: start.max(end), starts: -1 });
    }

    /// The pieces of ink, and their length in millimetres.
    pub(crate) fn finish(self, work: &mut dyn Work) -> Result<(Vec<Piece>, f64), Halt> {
        let Self { centre, numbers, lines, mut ends } = self;
        drop(numbers);
        sorted::sort_by(&mut ends, |a, b| {
            a.line.cmp(&b.line).then(a.at.total_cmp(&b.at)).then(b.starts.cmp(&a.starts))
        });
        let (mut pieces, mut length) = (vec![], 0.0);
        // The last end of a piece, and the number of strokes there.
        let mut last = End { line: u32::MAX, at: 0.0, starts: 0 };
        for end in ends {
            work.charge(1)?;
            if end.line != last.line {
                last = end;
                continue;
            }
            // Nearer ends are one end.
            if end.at - last.at >= JOINT {
                if last.starts > 0 {
                    length += end.at - last.at;
                    pieces.push(lines[end.line as usize].piece(centre, [last.at, end.at]));
                }
                last.at = end.at;
            }
            last.starts += end.starts;
        }
        Ok((pieces, length))
    }
}

impl Line {
    fn piece(&self, centre: Point, places: [f64; 2]) -> Piece {
        let [x, y] = self.way;
        let at = |along: f64| [centre[0] + along * x - self.aside * y, centre[1] + along * y + self.aside * x];
        Piece { layer: self.layer, ends: places.map(at) }
    }
}
