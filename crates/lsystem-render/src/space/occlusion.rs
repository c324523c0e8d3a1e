//! Ambient occlusion from a depth picture: places behind what is around them get less light from the sky.
//!
//! The depths are summed up in a pyramid. Near a place, single cells are compared in opposite pairs, so that a slanted
//! surface does not hide itself. Farther away, the place is compared with the mean depth around it. The largest radius
//! is a fixed part of the picture, so that crowns are dark inside at any size.

use super::lanes::{LANES, Lanes};
use super::picture::Picture;
use lsystem_base::{Meter, Progress};

/// The levels whose single cells are compared.
const NEAR_LEVELS: usize = 2;
/// The levels whose mean depths are compared.
const FAR_LEVELS: usize = LANES;
const LEVELS: usize = NEAR_LEVELS + FAR_LEVELS;
/// Cells around a level, which repeat those at its edges.
const EDGE: usize = 2;
/// The largest radius, as a part of the picture's shorter side.
const REACH: f32 = 0.08;
/// Cells of the far levels in a cell of the lowest level.
const FAR_SIZES: [f32; FAR_LEVELS] = [0.25, 0.125, 0.0625, 0.03125];
/// The weight of near cells, and of the mean depth around a place.
const NEAR_WEIGHT: f32 = 0.45;
const FAR_WEIGHT: f32 = 0.65;
/// How much a cell without a surface opens the place beside it.
const OPEN: f32 = 0.5;

/// A level of the pyramid: each cell has the mean depth of its surfaces times their part of the cell, and that part.
#[derive(Default)]
struct Level {
    size: [usize; 2],
    cells: Vec<[f32; 2]>,
}

/// The pyramid of a depth picture.
#[derive(Default)]
pub(super) struct Occlusion {
    levels: [Level; LEVELS],
    /// The weights of the levels; 0 beyond the largest radius.
    near_weights: [f32; NEAR_LEVELS],
    far_weights: Lanes,
    /// Cells of the lowest level in a sample of the picture.
    scale: f32,
    /// 1 / the eye's distance, in cells of the lowest level.
    nearness: f32,
    /// The level and the row that are made next.
    next: [usize; 2],
}

impl Occlusion {
    /// The bytes of the pyramid of a picture of `size` cells.
    pub(super) fn bytes(size: [usize; 2]) -> u64 {
        let cells = |level: usize| size.map(|count| (count.div_ceil(1 << level) + 2 * EDGE) as u64);
        (0..LEVELS).map(|level| cells(level).iter().product::<u64>() * size_of::<[f32; 2]>() as u64).sum()
    }

    /// Starts the pyramid of a picture of `size` cells. `scale` is the number of cells in a sample of the picture.
    pub(super) fn begin(&mut self, size: [usize; 2], scale: f64, nearness: f64) {
        (self.scale, self.nearness) = (scale as f32, nearness as f32);
        self.next = [0; 2];
        let reach = REACH * size[0].min(size[1]) as f32;
        let mut side = size;
        for level in &mut self.levels {
            level.size = side;
            level.cells.clear();
            level.cells.reserve_exact((side[0] + 2 * EDGE) * (side[1] + 2 * EDGE));
            side = side.map(|count| count.div_ceil(2));
        }
        // The radius of a level is the double of that below.
        let weight = |level: usize, weight: f32| if (1 << level) as f32 <= reach { weight } else { 0.0 };
        self.near_weights = core::array::from_fn(|level| weight(level, NEAR_WEIGHT));
        self.far_weights = Lanes(core::array::from_fn(|level| weight(NEAR_LEVELS + level, FAR_WEIGHT)));
    }

    /// Goes on with the pyramid of a finished depth picture.
    pub(super) fn step(&mut self, picture: &mut Picture, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            let [number, row] = self.next;
            if number == LEVELS {
                return Progress::Done;
            }
            let (below, above) = self.levels.split_at_mut(number);
            let level = &mut above[0];
            if row == level.size[1] {
                self.next = [number + 1, 0];
                continue;
            }
            meter.charge(1 + level.size[0] as u64 / 16);
            match below.last() {
                None => {
                    let depths = picture.depths(row, level.size[0]).iter();
                    let cell = |&depth: &f32| if depth.is_finite() { [depth, 1.0] } else { [0.0; 2] };
                    level.push(row, depths.map(cell));
                }
                Some(below) => {
                    // A last column or row without a partner is paired with its copy at the edge.
                    let pairs = [0, 1].map(|line| below.row(2 * row + line).chunks_exact(2));
                    let [upper, lower] = pairs;
                    let cells = upper.zip(lower).map(|(upper, lower)| {
                        [0, 1].map(|i| 0.25 * (upper[0][i] + upper[1][i] + (lower[0][i] + lower[1][i])))
                    });
                    level.push(row, cells.take(level.size[0]));
                }
            }
            self.next = [number, row + 1];
        }
        Progress::More
    }

    /// The mean surfaces around a place of the picture in samples, for [`Occlusion::at`].
    pub(super) fn around(&self, place: [f32; 2]) -> Around {
        let size = Lanes(FAR_SIZES) * self.scale;
        let [x, y] = place.map(|c| (size * c + -0.5).at_least(0.0));
        let [column, row] = [x, y].map(|c| (c + -0.5).at_least(0.0).round());
        let (tx, ty) = (x - column, y - row);
        let (columns, rows) = (column.indices(), row.indices());
        let mut corners = [[Lanes::all(0.0); 2]; 4];
        for (i, level) in self.levels[NEAR_LEVELS..].iter().enumerate() {
            let at = level.at([columns[i], rows[i]]);
            for (corner, at) in corners.iter_mut().zip([at, at + 1, at + level.stride(), at + level.stride() + 1]) {
                let [sum, part] = level.cells[at];
                (corner[0].0[i], corner[1].0[i]) = (sum, part);
            }
        }
        let mix = |kind: usize| {
            let [a, b, c, d] = corners.map(|corner| corner[kind]);
            let (upper, lower) = (a + tx * (b - a), c + tx * (d - c));
            upper + ty * (lower - upper)
        };
        Around { sum: mix(0), part: mix(1) }
    }

    /// The part of the light from the sky that is missing, 0 to 1, at a place of the picture in samples.
    pub(super) fn at(&self, [x, y, depth]: [f32; 3], around: &Around) -> f32 {
        let [x, y, depth] = [x, y, depth].map(|c| c * self.scale);
        // Depths shrink with perspective by the square of the scale, and distances in the picture by the scale.
        let steep = 0.5 / (1.0 - depth * self.nearness).max(0.05);
        let [fine, coarse] = &self.levels[..NEAR_LEVELS] else { return 0.0 };
        let near = fine.beside([x, y], depth, steep) * self.near_weights[0]
            + coarse.beside([0.5 * x, 0.5 * y], depth, 0.5 * steep) * self.near_weights[1];
        let rise = ((around.part * depth - around.sum) * (Lanes(FAR_SIZES) * steep)).at_least(0.0);
        let far = around.part * rise * (rise + 1.0).inverse() * self.far_weights;
        let sum = (near + far).sum();
        sum / (1.0 + sum)
    }
}

/// By far level: the mean surface around a place, as in a [`Level`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    sum: Lanes,
    part: Lanes,
}

impl Level {
    fn stride(&self) -> usize {
        self.size[0] + 2 * EDGE
    }

    /// The index of a cell, or of the nearest one.
    #[inline(always)]
    fn at(&self, [column, row]: [usize; 2]) -> usize {
        (row.min(self.size[1] - 1) + EDGE) * self.stride() + column.min(self.size[0] - 1) + EDGE
    }

    /// A row of cells and the copies of its last cell.
    fn row(&self, row: usize) -> &[[f32; 2]] {
        let first = (row + EDGE) * self.stride() + EDGE;
        &self.cells[first..first + self.size[0] + EDGE]
    }

    /// Adds a row of cells.
    fn push(&mut self, row: usize, cells: impl Iterator<Item = [f32; 2]>) {
        let stride = self.stride();
        let first = self.cells.len();
        self.cells.resize(first + EDGE, [0.0; 2]);
        self.cells.extend(cells);
        let [left, right] = [self.cells[first + EDGE], self.cells[self.cells.len() - 1]];
        self.cells[first..first + EDGE].fill(left);
        self.cells.resize(first + stride, right);
        let copies = if row == 0 { EDGE } else { 0 } + if row + 1 == self.size[1] { EDGE } else { 0 };
        for _ in 0..copies {
            self.cells.extend_from_within(first..first + stride);
        }
    }

    /// The occlusion by single cells around a place, in four directions. `steep` turns differences of depth into
    /// slopes.
    // Not inlined, to keep the wasm small.
    #[inline(never)]
    fn beside(&self, [x, y]: [f32; 2], depth: f32, steep: f32) -> Lanes {
        let [column, row, ..] = (Lanes([x, y, 0.0, 0.0]) + -0.5).at_least(0.0).round().indices();
        let (at, stride) = (self.at([column, row]), self.stride());
        let aside = [2, stride + 1, 2 * stride, stride - 1];
        let opposite = [0, 1, 2, 3].map(|i| self.cells[at - aside[i]]);
        let cells = [0, 1, 2, 3].map(|i| self.cells[at + aside[i]]);
        (slopes(cells, depth, steep) + slopes(opposite, depth, steep)).at_least(0.0) * (0.5 / LANES as f32)
    }
}

/// The slopes up to cells. Surfaces far ahead hide little of the sky.
#[inline(always)]
fn slopes(cells: [[f32; 2]; LANES], depth: f32, steep: f32) -> Lanes {
    let sum = Lanes(cells.map(|[sum, _]| sum));
    let part = Lanes(cells.map(|[_, part]| part));
    let rise = ((part * depth - sum) * steep).at_least(-1.0).at_most(6.0);
    rise * (rise * rise * 0.12 + 1.0).inverse() + (part + -1.0) * OPEN
}
