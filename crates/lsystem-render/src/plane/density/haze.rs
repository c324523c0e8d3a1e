//! Ink of blocks that are too many to be drawn: the ink of each is spread evenly over a rectangle of the block's size.
//!
//! Where thousands of blocks overlap, single blocks cannot be distinguished, and their sum is smooth. A rectangle of
//! any size costs the same: only its corners are noted, and summed up at the end.

use super::sheet::{Pigment, Sheet};
use lsystem_base::{Meter, Progress};

/// Pixels along the side of a cell.
const SIDE: usize = 4;
/// The most pixels around a pane whose haze is spread into the pane: bounds the memory of the cells.
const WIDEST_APRON: f64 = 1024.0;
/// A sum below this part of the greatest sum is a rounding error.
const ROUNDING: f64 = 1e-10;

/// The ink of the haze, by cell: as differences from cell to cell at first, then as sums.
#[derive(Default)]
pub(super) struct Haze {
    /// Pixels on each side of the sheet that the cells cover as well, in whole cells.
    apron: usize,
    columns: usize,
    rows: usize,
    planes: usize,
    cells: Vec<f64>,
    /// The running sums of the line being smoothed.
    line: Vec<f64>,
    stage: Stage,
    /// The row or column of cells that is next in the stage.
    line_number: usize,
    /// The greatest sum of a cell.
    most: f64,
}

/// The stage of the summing up.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Stage {
    /// Sums up the differences across.
    #[default]
    Across,
    /// Sums up the differences down.
    Down,
    /// Smooths twice across and down in turn; the number is the turn, from 0 to 3.
    Smooth(u8),
    /// Finds the greatest sum.
    Most,
    /// Adds the sums to the sheet.
    Add,
    Done,
}

impl Haze {
    /// The pixels around a pane in which haze of this grain must be known, because smoothing spreads it into the pane.
    pub(super) fn apron(grain: f64) -> usize {
        (grain / 2.0).min(WIDEST_APRON) as usize / SIDE * SIDE + 2 * SIDE
    }

    /// Empties the haze, for a sheet with `apron` pixels around it. Returns the units of work.
    pub(super) fn reset(&mut self, sheet: &Sheet, apron: usize) -> u64 {
        (self.stage, self.line_number, self.most) = (Stage::Across, 0, 0.0);
        let cells = |side: usize| (side + 2 * apron).div_ceil(SIDE) + 2;
        (self.apron, self.columns, self.rows) = (apron, cells(sheet.width), cells(sheet.height));
        self.planes = sheet.planes;
        self.cells.clear();
        self.cells.resize(self.columns * self.rows * self.planes, 0.0);
        1 + self.cells.len() as u64 / 128
    }

    /// Adds `amount` of ink; `squares` are the mean squares of its distance from the centre, across and down, in
    /// pixels.
    pub(super) fn add(&mut self, centre: [f64; 2], squares: [f64; 2], amount: f64, pigment: Pigment) {
        // The mean square of an even distribution is a twelfth of the square of its length.
        let sides = squares.map(|square| (12.0 * square).sqrt().max(2.0 * SIDE as f64));
        let density = amount / (sides[0] * sides[1]);
        if !density.is_finite() {
            return;
        }
        let edges = [0, 1].map(|axis| {
            let most = if axis == 0 { self.columns - 2 } else { self.rows - 2 } as f64;
            let centre = centre[axis] + self.apron as f64;
            [-0.5, 0.5].map(|sign| ((centre + sign * sides[axis]) / SIDE as f64).clamp(0.0, most))
        });
        for (y, down) in steps(edges[1]) {
            for (x, across) in steps(edges[0]) {
                let at = (y * self.columns + x) * self.planes;
                let more = density * down * across;
                self.cells[at] += more;
                if let Some(cells) = self.cells.get_mut(at + 1..at + self.planes) {
                    cells.iter_mut().zip(pigment).for_each(|(cell, pigment)| *cell += more * f64::from(pigment));
                }
            }
        }
    }

    /// Goes on summing up, smoothing and adding the haze to the sheet. Smoothing hides the edges of rectangles about
    /// `grain` pixels large.
    pub(super) fn settle(&mut self, sheet: &mut Sheet, grain: f64, meter: &mut Meter) -> Progress {
        let (columns, planes) = (self.columns, self.planes);
        let (across, down) = (columns - 2, self.rows - 2);
        let radius = ((grain / 8.0) as usize / SIDE).clamp(1, columns.max(self.rows));
        while !meter.is_spent() {
            let at = self.line_number;
            self.line_number += 1;
            let count = match self.stage {
                Stage::Across => self.rows,
                Stage::Down => self.rows - 1,
                Stage::Smooth(0 | 2) => down * planes,
                Stage::Smooth(_) => across * planes,
                Stage::Most => self.rows,
                Stage::Add => sheet.height,
                Stage::Done => return Progress::Done,
            };
            if at == count {
                self.line_number = 0;
                self.stage = match self.stage {
                    Stage::Across => Stage::Down,
                    Stage::Down => Stage::Smooth(0),
                    Stage::Smooth(3) => Stage::Most,
                    Stage::Smooth(number) => Stage::Smooth(number + 1),
                    Stage::Most if self.most > 0.0 => Stage::Add,
                    _ => Stage::Done,
                };
                continue;
            }
            let length = match self.stage {
                Stage::Across => {
                    for at in at * columns * planes..(at + 1) * columns * planes {
                        let left = if at % (columns * planes) >= planes { self.cells[at - planes] } else { 0.0 };
                        self.cells[at] += left;
                    }
                    columns * planes
                }
                Stage::Down => {
                    for at in (at + 1) * columns * planes..(at + 2) * columns * planes {
                        self.cells[at] += self.cells[at - columns * planes];
                    }
                    columns * planes
                }
                Stage::Smooth(0 | 2) => {
                    self.smooth(at / planes * columns * planes + at % planes, planes, across, radius);
                    across
                }
                Stage::Smooth(_) => {
                    self.smooth(at, columns * planes, down, radius);
                    down
                }
                Stage::Most => {
                    let row = &self.cells[at * columns * planes..(at + 1) * columns * planes];
                    self.most = row.iter().step_by(planes).fold(self.most, |most, &cell| most.max(cell));
                    columns
                }
                Stage::Add | Stage::Done => {
                    self.add_row(sheet, at);
                    2 * sheet.width * planes
                }
            };
            meter.charge(1 + length as u64 / 8);
        }
        Progress::More
    }

    /// Adds the haze of a row of pixels to the sheet.
    fn add_row(&self, sheet: &mut Sheet, row: usize) {
        let (columns, planes) = (self.columns, self.planes);
        let near = |pixel: usize, end: usize| {
            let at = (((pixel + self.apron) as f64 + 0.5) / SIDE as f64 - 0.5).clamp(0.0, (end - 1) as f64);
            let first = (at as usize).min(end.saturating_sub(2));
            (first, at - first as f64)
        };
        let (above, down) = near(row, self.rows - 2);
        for column in 0..sheet.width {
            let (left, across) = near(column, columns - 2);
            let value = |plane: usize| {
                let cell = |x: usize, y: usize| self.cells[((above + y) * columns + left + x) * planes + plane];
                let upper = cell(0, 0) + across * (cell(1, 0) - cell(0, 0));
                let lower = cell(0, 1) + across * (cell(1, 1) - cell(0, 1));
                upper + down * (lower - upper)
            };
            if value(0) > ROUNDING * self.most {
                let at = (row * sheet.width + column) * planes;
                (0..planes).for_each(|plane| sheet.values[at + plane] += value(plane) as f32);
            }
        }
        sheet.reach[row] = 0..sheet.width as u32;
    }

    /// Replaces each cell of a line by the mean of the cells up to `radius` away.
    fn smooth(&mut self, first: usize, step: usize, count: usize, radius: usize) {
        let mut sum = 0.0;
        self.line.clear();
        self.line.push(sum);
        for cell in 0..count {
            sum += self.cells[first + cell * step];
            self.line.push(sum);
        }
        for cell in 0..count {
            let (low, high) = (cell.saturating_sub(radius), (cell + radius + 1).min(count));
            self.cells[first + cell * step] = (self.line[high] - self.line[low]) / (high - low) as f64;
        }
    }
}

/// The cells at which the coverage between two edges changes, and the changes.
fn steps([low, high]: [f64; 2]) -> [(usize, f64); 4] {
    let (first, last) = (low as usize, high as usize);
    let (after, beyond) = (low - first as f64, high - last as f64);
    [(first, 1.0 - after), (first + 1, after), (last, beyond - 1.0), (last + 1, -beyond)]
}
