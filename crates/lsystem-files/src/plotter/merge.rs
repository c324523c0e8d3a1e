//! Strokes on the same line become one stretch wherever they touch or overlap, so that no ink is drawn twice.

use super::cells::Cells;
use super::gather::Strokes;
use super::page::{Point, distance};
use super::sort::Sort;
use lsystem_syntax::{Meter, Progress};

/// Points nearer than a tenth of this are one point, in millimetres; a plotter's step is at least ten times as long.
pub(super) const JOINT: f64 = 1e-3;
/// Directions nearer than a tenth of this are one direction, as the sine of the angle or twice that. Along a sheet of
/// A4 this is less than [`JOINT`].
const DIRECTION: f64 = 2e-6;
/// Shorter strokes are points: their directions would be rounding errors.
const LEAST: f64 = 1e-5;

/// A straight piece of ink.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) layer: u32,
    pub(super) ends: [Point; 2],
}

/// The lines that carry the strokes, and the stretches of ink along them.
#[derive(Clone, Debug)]
pub(super) struct Merge {
    centre: Point,
    numbers: Cells,
    lines: Vec<Line>,
    stretches: Vec<Stretch>,
    sort: Option<Sort<Stretch>>,
    /// The number of stretches merged so far.
    next: usize,
    pieces: Vec<Piece>,
    /// The stretch that grows.
    open: Option<Stretch>,
}

/// A line of one layer: a unit vector along the line, and the distance to its left from the sheet's centre.
#[derive(Clone, Copy, Debug)]
struct Line {
    layer: u32,
    way: Point,
    aside: f64,
}

/// Ink between two places along a line.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    line: u32,
    start: f64,
    end: f64,
}

impl Strokes for Merge {
    fn add(&mut self, layer: u32, [from, to]: [Point; 2]) {
        let length = distance(from, to);
        // The comparison is false for NaN, too.
        if !(length > LEAST) {
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
        let along = |point: Point| line.way[0] * (point[0] - self.centre[0]) + line.way[1] * (point[1] - self.centre[1]);
        let (start, end) = (along(from), along(to));
        self.stretches.push(Stretch { line: number, start: start.min(end), end: start.max(end) });
    }
}

impl Merge {
    /// No ink, on a sheet of this size.
    pub(super) fn new(size: [f64; 2]) -> Self {
        Self {
            centre: size.map(|side| side / 2.0),
            numbers: Cells::new([DIRECTION, JOINT]),
            lines: Vec::new(),
            stretches: Vec::new(),
            sort: None,
            next: 0,
            pieces: Vec::new(),
            open: None,
        }
    }

    /// Merges the strokes until the meter is spent. No strokes can be added any more.
    pub(super) fn step(&mut self, meter: &mut Meter) -> Progress {
        if !self.stretches.is_empty() && self.sort.is_none() && self.next == 0 {
            self.numbers = Cells::new([DIRECTION, JOINT]);
            let order = |a: &Stretch, b: &Stretch| a.line.cmp(&b.line).then(a.start.total_cmp(&b.start));
            self.sort = Some(Sort::new(core::mem::take(&mut self.stretches), order));
        }
        if let Some(mut sort) = self.sort.take() {
            match sort.step(meter) {
                Progress::More => {
                    self.sort = Some(sort);
                    return Progress::More;
                }
                Progress::Done => self.stretches = sort.finish(),
            }
        }
        while !meter.is_spent() {
            meter.charge(1);
            let next = self.stretches.get(self.next).copied();
            self.next += 1;
            match (&mut self.open, next) {
                (Some(open), Some(next)) if open.line == next.line && next.start < open.end + JOINT => {
                    open.end = open.end.max(next.end);
                }
                (open, next) => {
                    let ended = core::mem::replace(open, next);
                    self.pieces.extend(ended.map(|stretch| self.lines[stretch.line as usize].piece(self.centre, stretch)));
                    if next.is_none() {
                        return Progress::Done;
                    }
                }
            }
        }
        Progress::More
    }

    /// The pieces of ink, after all steps.
    pub(super) fn finish(self) -> Vec<Piece> {
        self.pieces
    }
}

impl Line {
    fn piece(&self, centre: Point, stretch: Stretch) -> Piece {
        let [x, y] = self.way;
        let at = |along: f64| [centre[0] + along * x - self.aside * y, centre[1] + along * y + self.aside * x];
        Piece { layer: self.layer, ends: [at(stretch.start), at(stretch.end)] }
    }
}
