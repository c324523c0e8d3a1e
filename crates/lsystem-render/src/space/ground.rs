//! The shade on the ground: the plane under the lowest point of the drawing darkens the background where the drawing
//! hides the sun. The shade is soft and fades with the height of what casts it.

use super::camera::{Lens, NEAR};
use super::lanes::LANES;
use super::sun::Sun;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::rotation::{Vector, dot};

/// Texels of the sun's depth picture along the side of a cell.
const CELL: usize = 4;
/// The radius of the blur for shade from near the ground, and for all shade, as parts of the depth picture.
const BLUR: [f32; 2] = [0.004, 0.025];
/// How often a blur is made, so that its edge is smooth.
const ROUNDS: usize = 3;
/// The strength of both kinds of shade.
const STRENGTH: [f32; 2] = [0.6, 0.7];
/// The heights at which both kinds of shade are half as strong, in radii of the drawing.
const HEIGHT: [f64; 2] = [0.18, 1.1];
/// The sines of the camera's elevation from which on the shade begins to show, and shows in full.
const LEVEL: [f64; 2] = [0.02, 0.1];

/// The width in which the shade fades out towards the border of the picture, as a part of half the shorter side.
const BORDER: f64 = 0.2;

/// The shade on the ground.
#[derive(Default)]
pub(super) struct Ground {
    /// Whether the ground is seen from above.
    pub(super) is_seen: bool,
    /// Cells along a side, a cell without shade at every edge included.
    side: usize,
    /// By kind of shade: the shade in each cell.
    cells: [Vec<f32>; 2],
    spare: Vec<f32>,
    strength: f32,
    /// The direction up, and the height of the ground in that direction, as the eye's lens sees them.
    up: Vector,
    height: f64,
    nearness: f64,
    middle: [f64; 2],
    radius: f64,
    /// The part of the picture in which there may be shade, in samples: left, right, upper and lower end.
    bounds: [f64; 4],
    /// The row of cells that is summed up next, or the blur that is made next.
    next: usize,
}

impl Ground {
    /// Starts the shade of a drawing that is `tall` units of its root block.
    pub(super) fn begin(&mut self, eye: &Lens, tall: f64, sun: &Sun) {
        let above = -eye.up[2];
        let scale = dot(eye.axes[1], eye.axes[1]).sqrt();
        self.strength = (((above - LEVEL[0]) / (LEVEL[1] - LEVEL[0])).clamp(0.0, 1.0)) as f32;
        self.is_seen = self.strength > 0.0 && tall > 0.0;
        self.side = if self.is_seen { sun.side.div_ceil(CELL) + 2 } else { 0 };
        (self.up, self.height) = (eye.up, dot(eye.up, eye.centre) - 0.5 * tall * scale);
        (self.nearness, self.middle, self.radius) = (eye.nearness, eye.middle, eye.radius);
        self.bounds = self.bound(sun);
        self.next = 0;
        for cells in &mut self.cells {
            cells.clear();
            cells.resize(self.side * self.side, 0.0);
        }
    }

    /// Goes on with the shade.
    pub(super) fn step(&mut self, sun: &Sun, meter: &mut Meter) -> Progress {
        while self.is_seen && !meter.is_spent() {
            let rows = sun.side.div_ceil(CELL);
            if self.next < rows {
                self.sum_row(sun, self.next);
                meter.charge(1 + sun.side as u64 / 2);
            } else if self.next < rows + 2 * ROUNDS {
                let kind = (self.next - rows) / ROUNDS;
                self.blur(kind, (BLUR[kind] * sun.side as f32 / CELL as f32).max(1.0) as usize);
                meter.charge(1 + (self.side * self.side) as u64 / 4);
            } else {
                return Progress::Done;
            }
            self.next += 1;
        }
        if self.is_seen { Progress::More } else { Progress::Done }
    }

    /// Sums up the shade of a row of cells.
    fn sum_row(&mut self, sun: &Sun, row: usize) {
        // The height above the ground grows evenly with the place in the depth picture.
        let square = dot(sun.turned[0], sun.turned[0]);
        let [across, down, away] = sun.turned.map(|direction| dot(direction, self.up) / square / self.radius);
        let base = (dot(sun.focus, self.up) - self.height) / self.radius;
        let half = sun.side as f64 / 2.0;
        for y in row * CELL..((row + 1) * CELL).min(sun.side) {
            for (x, &depth) in sun.depths[y * sun.side..(y + 1) * sun.side].iter().enumerate() {
                if !depth.is_finite() {
                    continue;
                }
                let height =
                    base + across * (x as f64 + 0.5 - half) + down * (y as f64 + 0.5 - half) + away * f64::from(depth);
                let at = (row + 1) * self.side + x / CELL + 1;
                for (cells, half) in self.cells.iter_mut().zip(HEIGHT) {
                    let far = height / half;
                    cells[at] += (1.0 / (1.0 + far * far)) as f32 * (1.0 / (CELL * CELL) as f32);
                }
            }
        }
    }

    /// Blurs the cells of one kind across and down.
    fn blur(&mut self, kind: usize, radius: usize) {
        let (side, cells) = (self.side, &mut self.cells[kind]);
        let per = 1.0 / (2 * radius + 1) as f32;
        self.spare.clear();
        self.spare.resize(cells.len(), 0.0);
        for row in 0..side {
            let line = &cells[row * side..(row + 1) * side];
            // Each cell sums up its own neighbours, so that rounding does not add up along the row.
            for x in 0..side {
                let near = &line[x.saturating_sub(radius)..(x + radius + 1).min(side)];
                self.spare[row * side + x] = near.iter().sum::<f32>() * per;
            }
        }
        cells.fill(0.0);
        for y in 0..side {
            for from in y.saturating_sub(radius)..(y + radius + 1).min(side) {
                for x in 0..side {
                    cells[y * side + x] += self.spare[from * side + x] * per;
                }
            }
        }
    }

    /// Finds the part of the picture that contains the ground under the sun's depth picture.
    fn bound(&self, sun: &Sun) -> [f64; 4] {
        let all = [f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY];
        let mut bounds = [f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY];
        let square = dot(sun.turned[0], sun.turned[0]);
        let half = 0.5 * sun.side as f64 + 2.0 * CELL as f64;
        let [right, down, away] = sun.turned.map(|direction| direction.map(|c| c / square));
        for [x, y] in [[-half, -half], [half, -half], [-half, half], [half, half]] {
            // The sunbeam through a corner of the depth picture meets the ground.
            let corner = [0, 1, 2].map(|i| sun.focus[i] + x * right[i] + y * down[i]);
            let t = (self.height - dot(self.up, corner)) / dot(self.up, away);
            let [x, y, z] = [0, 1, 2].map(|i| corner[i] + t * away[i]);
            let nearer = 1.0 + z * self.nearness;
            if nearer.is_nan() || nearer <= NEAR {
                return all;
            }
            let [x, y] = [self.middle[0] + x / nearer, self.middle[1] + y / nearer];
            bounds = [bounds[0].min(x), bounds[1].max(x), bounds[2].min(y), bounds[3].max(y)];
        }
        bounds
    }

    /// The first pixel with shade in a row of pixels, and the one after the last.
    pub(super) fn columns(&self, row: usize) -> [usize; 2] {
        let [left, right, top, bottom] = self.bounds.map(|end| end / LANES as f64);
        let row = row as f64;
        if !self.is_seen || row + 1.0 < top || row > bottom {
            return [0, 0];
        }
        // The conversion turns negative numbers into 0.
        [left as usize, (right + 1.0) as usize]
    }

    /// The shade, 0 to 1, at a place of the picture in samples.
    pub(super) fn at(&self, [x, y]: [f32; 2], sun: &Sun) -> f32 {
        if !self.is_seen {
            return 0.0;
        }
        let [x, y] = [f64::from(x) - self.middle[0], f64::from(y) - self.middle[1]];
        let [across, down] = self.middle;
        let inside = (across - x.abs()).min(down - y.abs()) / (BORDER * across.min(down));
        if inside <= 0.0 {
            return 0.0;
        }
        // The line of sight goes down towards the ground only below the horizon.
        let falls = self.up[1] * y * self.nearness + self.up[2];
        if falls > -1e-6 {
            return 0.0;
        }
        let z = (self.height - self.up[1] * y) / falls;
        let larger = 1.0 + z * self.nearness;
        if larger < NEAR {
            return 0.0;
        }
        let [x, y, _] = sun.place([x * larger, y * larger, z].map(|c| c as f32));
        let cell = CELL as f32;
        let [x, y] = [x / cell + 0.5, y / cell + 0.5];
        let far = (self.side - 1) as f32;
        if !(x >= 0.0 && y >= 0.0 && x < far && y < far) {
            return 0.0;
        }
        let [column, row] = [x as usize, y as usize];
        let [tx, ty] = [x - column as f32, y - row as f32];
        let at = row * self.side + column;
        let mut shade = 0.0;
        for (cells, strength) in self.cells.iter().zip(STRENGTH) {
            let upper = cells[at] + tx * (cells[at + 1] - cells[at]);
            let lower = cells[at + self.side] + tx * (cells[at + self.side + 1] - cells[at + self.side]);
            shade += strength * (upper + ty * (lower - upper));
        }
        let inside = inside.min(1.0) as f32;
        self.strength * shade.min(1.0) * inside * inside * (3.0 - 2.0 * inside)
    }
}
