//! A filled polygon, row by row.

use super::Canvas;
use super::bit_words::{GROUP, NOTHING, Spans};
use crate::ink::{Crossing, MAX_SORTED, SIDES_PER_UNIT, Side, sides_in};
use core::ops::Range;
use lsystem_base::{Meter, Progress};

/// A polygon that is being filled.
#[derive(Debug, Default)]
pub(in crate::plane) struct Filling {
    /// The outline on the subsample lattice, y down.
    vertices: Vec<[f64; 2]>,
    colour: u32,
    /// The rows that are still to be filled.
    rows: Range<usize>,
    /// The sides that may cross the rows of the present group.
    sides: Vec<Side>,
    crossings: Vec<Crossing>,
    /// The first spans of the rows of a group, their second spans, and so on.
    layers: Vec<Spans>,
    /// By column: the change of the winding number there, for a row with very many crossings.
    changes: Vec<i32>,
    /// The spans so far, and an eighth of the vertices for each row.
    pub work: usize,
}

impl Filling {
    /// Starts to paint every subsample around whose centre the outline has a winding number other than 0. `vertices`
    /// are on the subsample lattice, y down. Returns the units of work.
    pub(in crate::plane) fn begin(
        &mut self,
        canvas: &Canvas,
        vertices: impl Iterator<Item = [f64; 2]>,
        colour: u32,
    ) -> u64 {
        let [_, height] = canvas.size();
        (self.colour, self.rows, self.work) = (colour, 0..0, 0);
        self.vertices.clear();
        self.vertices.extend(vertices);
        let ends = self
            .vertices
            .iter()
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], [_, y]| [low.min(*y), high.max(*y)]);
        let first = (ends[0] - 0.5).ceil().max(0.0);
        let last = (ends[1] - 0.5).floor().min(height - 1.0);
        if first <= last && self.vertices.iter().flatten().all(|c| c.is_finite()) {
            self.rows = first as usize..last as usize + 1;
        }
        1 + (self.vertices.len() / SIDES_PER_UNIT) as u64
    }

    /// Whether all rows are filled.
    pub(in crate::plane) fn is_done(&self) -> bool {
        self.rows.is_empty()
    }

    /// Goes on, a group of rows at a time.
    pub(in crate::plane) fn step(&mut self, canvas: &mut Canvas, meter: &mut Meter) -> Progress {
        while !self.is_done() {
            if meter.is_spent() {
                return Progress::More;
            }
            meter.charge(self.group(canvas));
        }
        Progress::Done
    }

    /// Fills all rows at once, for outlines of few corners. Returns the units of work.
    pub(in crate::plane) fn finish(&mut self, canvas: &mut Canvas) -> u64 {
        let mut units = 0;
        while !self.is_done() {
            units += self.group(canvas);
        }
        units
    }

    /// Fills the rows of the next group. Returns the units of work.
    fn group(&mut self, canvas: &mut Canvas) -> u64 {
        let right = canvas.size()[0];
        let start = self.rows.start;
        let rows = start..self.rows.end.min(start / GROUP * GROUP + GROUP);
        self.rows.start = rows.end;
        let mut units =
            sides_in(&self.vertices, [rows.start, rows.end - 1].map(|row| row as f64 + 0.5), &mut self.sides);
        self.layers.clear();
        for row in rows.clone() {
            units += crossings(&self.sides, row as f64 + 0.5, &mut self.crossings);
            let layers = &mut self.layers;
            let mut layer = 0;
            let mut work = 0;
            let mut span = |start: f64, x: f64| {
                // The columns whose centres lie between the two crossings.
                let from = (start - 0.5).ceil().clamp(0.0, right) as i64;
                let to = (x - 0.5).floor().clamp(-1.0, right - 1.0) as i64;
                if from <= to {
                    if layer == layers.len() {
                        layers.push([NOTHING; GROUP]);
                    }
                    layers[layer][row % GROUP] = [from, to];
                    layer += 1;
                }
                work += 1;
            };
            if self.crossings.len() > MAX_SORTED {
                let columns = right as usize;
                spans_of_many(&self.crossings, columns, &mut self.changes, |from, to| {
                    span(from as f64 + 0.5, to as f64 + 0.5);
                });
                units += ((self.crossings.len() + columns) / SIDES_PER_UNIT) as u64;
            } else {
                spans_of_few(&mut self.crossings, &mut span);
                units += self.crossings.len() as u64 / 2;
            }
            self.work += work + self.vertices.len() / 8;
        }
        for layer in &self.layers {
            let reach = layer.iter().fold(NOTHING, |[a, b], &[first, last]| [a.min(first), b.max(last)]);
            canvas.fill(
                rows.clone(),
                self.colour,
                |_| reach,
                |_, spans| {
                    *spans = *layer;
                    reach
                },
            );
        }
        units + self.layers.len() as u64 + canvas.take_work()
    }
}

/// Finds the crossings of sides with a row. Returns the units of work.
fn crossings(sides: &[Side], y: f64, crossings: &mut Vec<Crossing>) -> u64 {
    crossings.clear();
    for &[[x0, y0], [x1, y1]] in sides {
        if (y0 <= y) != (y1 <= y) {
            let x = x0 + (y - y0) / (y1 - y0) * (x1 - x0);
            crossings.push((x, if y0 < y1 { 1 } else { -1 }));
        }
    }
    (sides.len() / SIDES_PER_UNIT) as u64
}

/// Finds the spans of a row that are inside, by sorting the crossings.
fn spans_of_few(crossings: &mut [Crossing], mut span: impl FnMut(f64, f64)) {
    crossings.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    let (mut winding, mut start) = (0, 0.0);
    for &(x, way) in &*crossings {
        if winding == 0 {
            start = x;
        }
        winding += way;
        if winding == 0 {
            span(start, x);
        }
    }
}

/// Finds the spans of a row that are inside, column by column, in time linear in the crossings and the columns.
fn spans_of_many(crossings: &[Crossing], columns: usize, changes: &mut Vec<i32>, mut span: impl FnMut(usize, usize)) {
    changes.clear();
    changes.resize(columns + 1, 0);
    for &(x, way) in crossings {
        changes[(x - 0.5).ceil().clamp(0.0, columns as f64) as usize] += way;
    }
    let (mut winding, mut start) = (0, 0);
    for (column, change) in changes.iter().enumerate().take(columns) {
        let before = winding;
        winding += change;
        if before == 0 {
            start = column;
        } else if winding == 0 {
            span(start, column - 1);
        }
    }
    if winding != 0 {
        span(start, columns - 1);
    }
}

/// Paints a whole polygon.
#[cfg(test)]
pub(in crate::plane) fn paint(canvas: &mut Canvas, vertices: &[[f64; 2]], colour: u32) {
    let mut filling = Filling::default();
    filling.begin(canvas, vertices.iter().copied(), colour);
    filling.finish(canvas);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn however_many_crossings_a_row_has_the_same_columns_are_inside() {
        let mut state = 1_u32;
        let mut number = |most: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) % most
        };
        for count in [2, 4, 10, 60] {
            let mut row: Vec<Crossing> = vec![];
            for _ in 0..count / 2 {
                // No crossing is at the centre of a column.
                row.extend([1, -1].map(|way| (f64::from(number(1200)) / 10.0 - 10.03, way)));
            }
            let (mut few, mut many) = (vec![false; 100], vec![false; 100]);
            spans_of_many(&row, 100, &mut vec![], |from, to| many[from..=to].fill(true));
            spans_of_few(&mut row, |from, to| {
                let from = (from - 0.5).ceil().clamp(0.0, 100.0) as usize;
                let to = (to - 0.5).floor().clamp(-1.0, 99.0);
                if to >= from as f64 {
                    few[from..=to as usize].fill(true);
                }
            });
            assert_eq!(few, many, "{row:?}");
        }
    }
}
