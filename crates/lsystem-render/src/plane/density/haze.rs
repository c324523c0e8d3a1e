//! Ink of blocks that are too many to be drawn: the ink of each is spread evenly over a rectangle of the block's size.
//!
//! Where thousands of blocks overlap, single blocks cannot be distinguished, and their sum is smooth. A rectangle of
//! any size costs the same: only its corners are noted, and summed up at the end.

use crate::ink::{Pigment, Sheet};
use lsystem_base::{Meter, Progress};

/// Pixels along the side of a cell.
const SIDE: usize = 4;
/// The most pixels around a pane whose haze is spread into the pane: bounds the memory of the cells.
const WIDEST_APRON: f64 = 1024.0;
/// As [`WIDEST_APRON`], in a sketch, whose pixels are places of sums.
const SKETCH_APRON: f64 = 256.0;
/// Columns that are smoothed at a time: as many cells as a cache line holds.
const COLUMNS: usize = 8;
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
    /// The running sums of the columns being smoothed.
    sums: Vec<f64>,
    /// The haze of the pixels on the middle of two rows of cells, and the number of the first of them.
    middles: ([Vec<f32>; 2], Option<usize>),
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
    pub(super) fn apron(grain: f64, is_sketch: bool) -> usize {
        let widest = if is_sketch { SKETCH_APRON } else { WIDEST_APRON };
        (grain / 4.0).min(widest) as usize / SIDE * SIDE + 2 * SIDE
    }

    /// Empties the haze, for a sheet with `apron` pixels around it. Returns the units of work.
    pub(super) fn reset(&mut self, sheet: &Sheet, apron: usize) -> u64 {
        (self.stage, self.line_number, self.most, self.middles.1) = (Stage::Across, 0, 0.0, None);
        let cells = |side: usize| (side + 2 * apron).div_ceil(SIDE) + 2;
        (self.apron, self.rows) = (apron, cells(sheet.height));
        self.columns = cells(sheet.width).next_multiple_of(COLUMNS);
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
        let numbers = columns * planes;
        while !meter.is_spent() {
            let at = self.line_number;
            self.line_number += 1;
            let count = match self.stage {
                Stage::Across => self.rows,
                Stage::Down => self.rows - 1,
                Stage::Smooth(0 | 2) => down * planes,
                Stage::Smooth(_) => numbers / COLUMNS,
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
                    for at in at * numbers + planes..(at + 1) * numbers {
                        self.cells[at] += self.cells[at - planes];
                    }
                    numbers
                }
                Stage::Down => {
                    let (above, below) = self.cells[at * numbers..(at + 2) * numbers].split_at_mut(numbers);
                    below.iter_mut().zip(above).for_each(|(cell, above)| *cell += *above);
                    numbers
                }
                Stage::Smooth(0 | 2) => {
                    self.smooth::<1>(at / planes * numbers + at % planes, planes, across, radius);
                    across
                }
                Stage::Smooth(_) => {
                    self.smooth::<COLUMNS>(at * COLUMNS, numbers, down, radius);
                    COLUMNS * down
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

    /// The last cell whose middle is not beyond the middle of a pixel, and the part of the way to the next one. The apron
    /// is wider than a cell.
    fn before(&self, pixel: usize) -> (usize, f32) {
        let at = (2 * (pixel + self.apron) + 1).saturating_sub(SIDE);
        (at / (2 * SIDE), (at % (2 * SIDE)) as f32 / (2 * SIDE) as f32)
    }

    /// Adds the haze of a row of pixels to the sheet.
    fn add_row(&mut self, sheet: &mut Sheet, row: usize) {
        let (above, down) = self.before(row);
        let ([mut upper, mut lower], middle) = core::mem::take(&mut self.middles);
        if middle != Some(above) {
            core::mem::swap(&mut upper, &mut lower);
            if middle.is_none_or(|middle| middle + 1 != above) {
                self.spread_row(above, sheet.width, &mut upper);
            }
            self.spread_row(above + 1, sheet.width, &mut lower);
        }
        let values = &mut sheet.values[row * upper.len()..(row + 1) * upper.len()];
        for ((value, upper), lower) in values.iter_mut().zip(&upper).zip(&lower) {
            *value += upper + down * (lower - upper);
        }
        sheet.reach[row] = 0..sheet.width as u32;
        self.middles = ([upper, lower], Some(above));
    }

    /// Makes the haze of the pixels on the middle of a row of cells.
    fn spread_row(&self, row: usize, width: usize, pixels: &mut Vec<f32>) {
        let (numbers, planes) = (self.columns * self.planes, self.planes);
        let cells = &self.cells[row * numbers..(row + 1) * numbers];
        pixels.clear();
        for column in 0..width {
            let (left, across) = self.before(column);
            let [left, right] = [left, left + 1].map(|cell| &cells[cell * planes..(cell + 1) * planes]);
            let shows = left[0].max(right[0]) > ROUNDING * self.most;
            let value = |(left, right): (&f64, &f64)| (left + f64::from(across) * (right - left)) as f32;
            pixels.extend(left.iter().zip(right).map(value).map(|value| if shows { value } else { 0.0 }));
        }
    }

    /// Replaces each cell of `N` neighbouring columns by the mean of the cells up to `radius` away along the column. The
    /// first cells are at `first`, and those of the next row `step` farther on.
    fn smooth<const N: usize>(&mut self, first: usize, step: usize, count: usize, radius: usize) {
        let mut sum = [0.0; N];
        self.sums.clear();
        self.sums.extend(sum);
        for cell in 0..count {
            if let Some(cells) = self.cells.get(first + cell * step..).and_then(<[_]>::first_chunk::<N>) {
                (0..N).for_each(|column| sum[column] += cells[column]);
            }
            self.sums.extend(sum);
        }
        let (sums, _) = self.sums.as_chunks::<N>();
        for cell in 0..count {
            let (low, high) = (cell.saturating_sub(radius), (cell + radius + 1).min(count));
            let (before, after, part) = (sums[low], sums[high], 1.0 / (high - low) as f64);
            if let Some(cells) = self.cells.get_mut(first + cell * step..).and_then(<[_]>::first_chunk_mut::<N>) {
                (0..N).for_each(|column| cells[column] = (after[column] - before[column]) * part);
            }
        }
    }
}

/// The cells at which the coverage between two edges changes, and the changes.
fn steps([low, high]: [f64; 2]) -> [(usize, f64); 4] {
    let (first, last) = (low as usize, high as usize);
    let (after, beyond) = (low - first as f64, high - last as f64);
    [(first, 1.0 - after), (first + 1, after), (last, beyond - 1.0), (last + 1, -beyond)]
}
