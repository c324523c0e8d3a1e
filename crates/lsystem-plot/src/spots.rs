//! Ink finer than the pen. The sheet is divided into spots smaller than the pen's line, and each colour draws a spot once.
//!
//! The first point of the drawing in a spot stands for all points there. So the parts of a curve still meet, a way back
//! over the same spots draws nothing, and the ink depends on the sheet and the pen only.

use crate::page::{Point, distance};
use std::collections::{HashMap, HashSet};

/// The side of a spot, in pens. The diagonal is about a pen, so that the line through a spot covers it.
const SIDE: f64 = 0.7;
/// The lines at a spot from which on lines to other such spots are left out: a curve has two.
const LINES: u8 = 2;
/// The spots between two stretches of a line up to which they are drawn as one: to raise the pen takes longer.
const GAP: usize = 4;

/// The spots with ink.
#[derive(Debug, Default)]
pub(crate) struct Spots {
    side: f64,
    numbers: HashMap<(u32, [i64; 2]), u32>,
    /// In the order of their first ink.
    list: Vec<Spot>,
    /// The lines between spots, each from the smaller number to the greater one.
    lines: HashSet<[u32; 2]>,
}

#[derive(Clone, Copy, Debug)]
struct Spot {
    layer: u32,
    point: Point,
    /// The number of lines to other spots, up to [`LINES`].
    lines: u8,
    /// The end of a stroke that lies in this spot, as long as there is no other ink.
    lone: Option<Point>,
}

impl Spots {
    /// No ink, for a pen of this width.
    pub(crate) fn new(pen: f64) -> Self {
        Self { side: SIDE * pen, numbers: HashMap::new(), list: Vec::new(), lines: HashSet::new() }
    }

    fn cell(&self, point: Point) -> [i64; 2] {
        point.map(|value| libm::floor(value / self.side) as i64)
    }

    /// The number of a point's spot, and whether the spot is new.
    fn number(&mut self, layer: u32, point: Point) -> (u32, bool) {
        let next = self.list.len() as u32;
        let number = *self.numbers.entry((layer, self.cell(point))).or_insert(next);
        if number == next {
            self.list.push(Spot { layer, point, lines: 0, lone: None });
        }
        (number, number == next)
    }

    /// The number of spots.
    pub(crate) fn count(&self) -> u64 {
        self.list.len() as u64
    }

    /// Notes a stroke shorter than the pen. Returns the ends of the line to draw, unless there is one already or both spots
    /// have lines enough.
    pub(crate) fn dot(&mut self, layer: u32, [from, to]: [Point; 2]) -> Option<[Point; 2]> {
        let ((a, is_new), (b, _)) = (self.number(layer, from), self.number(layer, to));
        if a == b {
            if is_new {
                self.list[a as usize].lone = Some(to);
            }
            return None;
        }
        let is_full = |number: u32| self.list[number as usize].lines >= LINES;
        if is_full(a) && is_full(b) || !self.lines.insert([a.min(b), a.max(b)]) {
            return None;
        }
        for number in [a, b] {
            let spot = &mut self.list[number as usize];
            spot.lone = None;
            spot.lines = (spot.lines + 1).min(LINES);
        }
        Some([a, b].map(|number| self.list[number as usize].point))
    }

    /// Whether a line leads over ink of this colour only.
    pub(crate) fn has(&self, layer: u32, [from, to]: [Point; 2]) -> bool {
        let last = self.steps([from, to]).max(1);
        (0..=last).all(|step| {
            let part = step as f64 / last as f64;
            let point = [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]));
            self.numbers.contains_key(&(layer, self.cell(point)))
        })
    }

    /// The steps of [`Spots::stretches`] along a line.
    pub(crate) fn steps(&self, [from, to]: [Point; 2]) -> u64 {
        libm::ceil(2.0 * distance(from, to) / self.side) as u64
    }

    /// The stretches of a line with new spots, in order.
    pub(crate) fn stretches(&mut self, layer: u32, [from, to]: [Point; 2]) -> Vec<[Point; 2]> {
        let last = self.steps([from, to]).max(1) as usize;
        let at = |step: usize| {
            let part = step as f64 / last as f64;
            [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]))
        };
        let mut stretches: Vec<[usize; 2]> = Vec::new();
        for step in 0..=last {
            let (number, is_new) = self.number(layer, if step == last { to } else { at(step) });
            let spot = &mut self.list[number as usize];
            let was_lone = spot.lone.take().is_some();
            spot.lines = LINES;
            if !is_new && !was_lone {
                continue;
            }
            // A stretch reaches to the spots before and after.
            let (start, end) = (step.saturating_sub(1), (step + 1).min(last));
            match stretches.last_mut() {
                Some(stretch) if start <= stretch[1] + GAP => stretch[1] = end,
                _ => stretches.push([start, end]),
            }
        }
        let point = |step: usize| if step == last { to } else { at(step) };
        stretches.into_iter().map(|ends| ends.map(point)).collect()
    }

    /// Whether all spots of a box have ink.
    pub(crate) fn is_full(&self, layer: u32, corners: impl Iterator<Item = Point>) -> bool {
        let (low, high) =
            corners.map(|corner| self.cell(corner)).fold(([i64::MAX; 2], [i64::MIN; 2]), |(low, high), spot| {
                ([0, 1].map(|axis| low[axis].min(spot[axis])), [0, 1].map(|axis| high[axis].max(spot[axis])))
            });
        (low[0]..=high[0]).all(|x| (low[1]..=high[1]).all(|y| self.numbers.contains_key(&(layer, [x, y]))))
    }

    /// The stroke of a spot that has no other ink, with its layer.
    pub(crate) fn lone(&self, number: usize) -> Option<(u32, [Point; 2])> {
        let Spot { layer, point, lone, .. } = self.list[number];
        lone.map(|end| (layer, [point, end]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_over_the_same_spots_is_drawn_once_and_stays_whole() {
        let mut spots = Spots::new(1.0);
        let way: Vec<Point> = (0..200).map(|at| [0.13 * f64::from(at), 0.3]).collect();
        let there: Vec<_> = way.windows(2).filter_map(|pair| spots.dot(0, [pair[0], pair[1]])).collect();
        assert!(there.windows(2).all(|pair| pair[0][1] == pair[1][0]), "{there:?}");
        let length: f64 = there.iter().map(|[from, to]| distance(*from, *to)).sum();
        assert!((length - 0.13 * 199.0).abs() < SIDE, "{length}");
        // Back, a tenth of the pen aside.
        let back = way.windows(2).rev().filter_map(|pair| spots.dot(0, [pair[1], pair[0]].map(|[x, y]| [x, y + 0.1])));
        assert_eq!(back.count(), 0);
        assert!(spots.dot(1, [way[0], way[9]]).is_some());
    }

    #[test]
    fn a_speck_is_drawn_and_a_speck_of_a_curve_is_not() {
        let mut spots = Spots::new(1.0);
        assert_eq!(spots.dot(0, [[0.1, 0.1], [0.3, 0.3]]), None);
        assert_eq!(spots.lone(0), Some((0, [[0.1, 0.1], [0.3, 0.3]])));
        assert_eq!(spots.dot(0, [[0.3, 0.3], [1.0, 0.3]]), Some([[0.1, 0.1], [1.0, 0.3]]));
        assert_eq!((0..spots.count() as usize).filter_map(|number| spots.lone(number)).count(), 0);
    }

    #[test]
    fn only_new_stretches_of_a_line_are_drawn() {
        let mut spots = Spots::new(1.0);
        let line = |from: f64, to: f64| [[from, 0.3], [to, 0.3]];
        assert_eq!(spots.stretches(0, line(0.0, 20.0)), [line(0.0, 20.0)]);
        assert!(spots.stretches(0, line(5.0, 15.0)).is_empty());
        let [[from, to]] = spots.stretches(0, line(10.0, 40.0))[..] else { panic!() };
        assert!((from[0] - 20.0).abs() < 2.0 * SIDE && to == [40.0, 0.3], "{from:?} {to:?}");
    }
}
