//! Ambient occlusion from a depth picture: places behind what is around them get less light from the sky.
//!
//! The depths are summed up in a pyramid. Near a place, single cells are compared in opposite pairs, so that a slanted
//! surface does not hide itself. Farther away, the place is compared with the mean depth around it. The largest radius
//! is a fixed part of the picture, so that crowns are dark inside at any size.

use super::picture::Picture;
use lsystem_base::{Meter, Progress};

/// Offsets of compared cells, in pairs with their opposites.
const ASIDE: [[f32; 2]; 4] = [[2.0, 0.0], [1.45, 1.45], [0.0, 2.0], [-1.45, 1.45]];
/// The levels whose single cells are compared.
const NEAR_LEVELS: usize = 2;
/// The largest radius, as a part of the picture's shorter side.
const REACH: f32 = 0.08;
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
    levels: Vec<Level>,
    /// The number of levels of the present picture.
    count: usize,
    /// Cells of the lowest level in a sample of the picture.
    scale: f32,
    /// 1 / the eye's distance, in cells of the lowest level.
    nearness: f32,
    /// The level and the row that are made next.
    next: [usize; 2],
}

impl Occlusion {
    /// Starts the pyramid of a picture of `size` cells. `scale` is the number of cells in a sample of the picture.
    pub(super) fn begin(&mut self, size: [usize; 2], scale: f64, nearness: f64) {
        (self.scale, self.nearness) = (scale as f32, nearness as f32);
        self.next = [0; 2];
        let reach = REACH * size[0].min(size[1]) as f32;
        let (mut side, mut radius) = (size, 2.0);
        self.count = 0;
        loop {
            if self.levels.len() == self.count {
                self.levels.push(Level::default());
            }
            let level = &mut self.levels[self.count];
            level.size = side;
            level.cells.clear();
            level.cells.reserve_exact(side[0] * side[1]);
            self.count += 1;
            if radius > reach {
                return;
            }
            (side, radius) = (side.map(|count| count.div_ceil(2)), 2.0 * radius);
        }
    }

    /// Goes on with the pyramid of a finished depth picture.
    pub(super) fn step(&mut self, picture: &mut Picture, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            let [number, row] = self.next;
            if number == self.count {
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
                    level.cells.extend(depths.map(|&depth| if depth.is_finite() { [depth, 1.0] } else { [0.0; 2] }));
                }
                Some(below) => {
                    let rows = [2 * row, (2 * row + 1).min(below.size[1] - 1)];
                    let [upper, lower] = rows.map(|row| &below.cells[row * below.size[0]..(row + 1) * below.size[0]]);
                    for (upper, lower) in upper.chunks(2).zip(lower.chunks(2)) {
                        let [a, b] = [upper, lower].map(|pair| [0, 1].map(|i| pair[0][i] + pair[pair.len() - 1][i]));
                        level.cells.push([0, 1].map(|i| 0.25 * (a[i] + b[i])));
                    }
                }
            }
            self.next = [number, row + 1];
        }
        Progress::More
    }

    /// The part of the light from the sky that is missing, 0 to 1, at a place of the picture in samples.
    pub(super) fn at(&self, [x, y, depth]: [f32; 3]) -> f32 {
        let [mut x, mut y, depth] = [x, y, depth].map(|c| c * self.scale);
        // Depths shrink with perspective by the square of the scale, and distances in the picture by the scale.
        let mut steep = 1.0 / (1.0 - depth * self.nearness).max(0.05);
        let mut sum = 0.0;
        for (number, level) in self.levels[..self.count].iter().enumerate() {
            if number < NEAR_LEVELS {
                sum += NEAR_WEIGHT * level.beside([x, y], depth, 0.5 * steep);
            } else {
                sum += FAR_WEIGHT * level.around([x, y], depth, 0.5 * steep);
            }
            (x, y, steep) = (0.5 * x, 0.5 * y, 0.5 * steep);
        }
        sum / (1.0 + sum)
    }
}

impl Level {
    #[inline]
    fn cell(&self, x: f32, y: f32) -> [f32; 2] {
        // The conversion turns negative numbers into 0.
        let [x, y] = [(x as usize).min(self.size[0] - 1), (y as usize).min(self.size[1] - 1)];
        self.cells[y * self.size[0] + x]
    }

    /// The mean occlusion by single cells around a place. `steep` turns differences of depth into slopes.
    fn beside(&self, [x, y]: [f32; 2], depth: f32, steep: f32) -> f32 {
        let slope = |x: f32, y: f32| {
            let [sum, part] = self.cell(x, y);
            let rise = ((depth * part - sum) * steep).clamp(-1.0, 6.0);
            // Surfaces far ahead hide little of the sky.
            rise / (1.0 + 0.12 * rise * rise) - OPEN * (1.0 - part)
        };
        let sum: f32 = ASIDE.iter().map(|[dx, dy]| (slope(x + dx, y + dy) + slope(x - dx, y - dy)).max(0.0)).sum();
        sum / (2 * ASIDE.len()) as f32
    }

    /// The occlusion by the mean surface around a place.
    fn around(&self, [x, y]: [f32; 2], depth: f32, steep: f32) -> f32 {
        let [x, y] = [(x - 0.5).max(0.0), (y - 0.5).max(0.0)];
        let [column, row] = [(x as usize).min(self.size[0] - 1), (y as usize).min(self.size[1] - 1)];
        let [tx, ty] = [x - column as f32, y - row as f32];
        let next = usize::from(column + 1 < self.size[0]);
        let at = row * self.size[0] + column;
        let below = if row + 1 < self.size[1] { at + self.size[0] } else { at };
        let mix = |at: usize| {
            let [a, b] = [self.cells[at], self.cells[at + next]];
            [0, 1].map(|i| a[i] + tx * (b[i] - a[i]))
        };
        let [a, b] = [mix(at), mix(below)];
        let [sum, part] = [0, 1].map(|i| a[i] + ty * (b[i] - a[i]));
        let rise = ((depth * part - sum) * steep).max(0.0);
        part * rise / (1.0 + rise)
    }
}
