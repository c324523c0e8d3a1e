//! A stroke in space: a stick with round ends, as the viewer sees it.
//!
//! In the space of the picture (samples to the right and down, and a depth that keeps straight lines straight) lines of
//! sight are parallel, so the point where one meets a stick is exact. A line of sight meets the side of the stick a
//! little before the place `along` the axis, because the side bulges. Beyond the ends the line meets a ball or nothing.

use super::lanes::{LANES, Lanes};
use super::light::{LIGHT, Light, LocalLight};
use super::surface::Surface;
use super::tile::{CELL, ScreenTile};
use lsystem_drawing::rotation::Vector;

/// A stick in the space of a picture; with perspective its ends differ in width.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stick {
    pub ends: [Vector; 2],
    pub radii: [f64; 2],
    pub ink: [f32; 3],
    pub spots: [LocalLight; 2],
}

/// A stick that reaches farther from a tile than this, in samples, is cut, so that single precision is enough.
const REACH: f64 = 4096.0;
/// If the bounds of a stick are at most this many samples wide, every row looks at all columns.
const NARROW: usize = 6;
/// If the ratio of a stick's length in the picture to its length is at most this, only the nearer end is painted.
const END_ON: f64 = 1e-3;

impl Stick {
    /// Paints a band of the stick, from the row `from` on, on a tile whose upper left corner is at `corner`.
    pub(super) fn paint(&self, tile: &mut ScreenTile, corner: [f64; 2], light: &Light, from: usize) -> Painted {
        let size = tile.size.map(|count| count as f64);
        let Some(stick) = self.within(corner, size) else { return Painted::default() };
        let [[x0, y0, d0], [x1, y1, d1]] = stick.ends;
        let widest = stick.radii[0].max(stick.radii[1]);
        let aside = widest + tile.slack();
        let Some(across) = span(x0.min(x1) - aside, x0.max(x1) + aside, size[0]) else { return Painted::default() };
        let Some(down) = span(y0.min(y1) - widest, y0.max(y1) + widest, size[1]) else { return Painted::default() };
        let (down, rest) = band(across, down, from);
        let way = [x1 - x0, y1 - y0, d1 - d0];
        let flat = (way[0] * way[0] + way[1] * way[1]).sqrt();
        let length = (flat * flat + way[2] * way[2]).sqrt();
        if flat <= END_ON * length || flat < 1e-6 {
            let near = usize::from(d1 < d0);
            let ball = Ball {
                at: stick.ends[near].map(|c| c as f32),
                radius: stick.radii[near] as f32,
                ink: stick.ink,
                spot: stick.spots[near],
            };
            tile.touch(across, down);
            return Painted { looked: ball.fill(tile, across, down, light), rest };
        }
        Painted { looked: stick.fill(tile, across, down, [flat, length], light), rest }
    }

    /// The stick relative to a tile's corner, cut to the part near the tile; `None` if nothing is left.
    fn within(&self, corner: [f64; 2], size: [f64; 2]) -> Option<Self> {
        let mut ends = self.ends.map(|[x, y, d]| [x - corner[0], y - corner[1], d]);
        let is_near = |end: &Vector| (0..2).all(|i| end[i].abs() < REACH);
        if ends.iter().all(is_near) {
            return Some(Self { ends, ..*self });
        }
        let radius = self.radii[0].max(self.radii[1]);
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for ((start, end), side) in ends[0].iter().zip(ends[1]).zip(size) {
            let way = end - start;
            let bounds = [-REACH / 2.0 - 2.0 * radius, REACH / 2.0 + side + 2.0 * radius];
            if way.abs() < 1e-9 {
                if *start < bounds[0] || *start > bounds[1] {
                    return None;
                }
                continue;
            }
            let [a, b] = bounds.map(|bound| (bound - start) / way);
            from = from.max(a.min(b));
            to = to.min(a.max(b));
        }
        if from >= to {
            return None;
        }
        let [start, end] = ends;
        let at = |t: f64| [0, 1, 2].map(|i| start[i] + t * (end[i] - start[i]));
        ends = [at(from), at(to)];
        let radius = |t: f64| self.radii[0] + t * (self.radii[1] - self.radii[0]);
        let spot = |t: f64| self.spots[0].towards(&self.spots[1], t as f32);
        Some(Self { ends, radii: [radius(from), radius(to)], spots: [spot(from), spot(to)], ink: self.ink })
    }

    /// Paints a stick of this `length` that is `flat` long in the picture. Returns the number of samples looked at.
    fn fill(
        &self,
        tile: &mut ScreenTile,
        across: [usize; 2],
        down: [usize; 2],
        [flat, length]: [f64; 2],
        light: &Light,
    ) -> usize {
        let [x0, y0] = [0, 1].map(|i| self.ends[0][i] as f32);
        let widest = self.radii[0].max(self.radii[1]) as f32;
        let surface = Surface::new(self, [flat, length], light.up);
        let narrow = across[1] - across[0] <= NARROW;
        let crossings = Crossings::new(&surface, widest, tile.slack() as f32);
        // The columns that may cross the stick in some rows; none if the second is less than the first.
        let cross = |rows: [usize; 2], columns: [usize; 2]| {
            if narrow { columns } else { crossings.columns(rows.map(|row| row as f32 + 0.5 - y0), x0, columns) }
        };
        let near = surface.near(widest);
        let mut looked = 0;
        let mut within = [1, 0];
        for row in down[0]..=down[1] {
            if row == down[0] || row % CELL == 0 {
                // Cells that show nearer surfaces are left out.
                let end = down[1].min(row / CELL * CELL + CELL - 1);
                within = tile.uncovered(row / CELL, cross([row, end], across), near);
                looked += 2;
            }
            let y = row as f32 + 0.5 - y0;
            let columns = cross([row, row], within);
            if columns[1] < columns[0] {
                continue;
            }
            let [left, right] = columns;
            let ahead = left as f32 + 0.5 + tile.lean(row) - x0;
            let (depths, colours) = tile.lanes(row, columns);
            looked += depths.len() * LANES;
            let last = Lanes::all(right as f32 + 1.0 - x0);
            for (i, samples) in depths.iter_mut().zip(colours).enumerate() {
                let x = Lanes::from(ahead + (i * LANES) as f32);
                surface.paint((x, last), y, samples, light);
            }
        }
        looked
    }
}

/// The spans in which a row crosses the band around a stick's axis, and the slab between its ends. Each span moves
/// evenly from row to row: its middle in the row of the first end, its shift from row to row, and half its length.
struct Crossings {
    band: [f32; 3],
    slab: [f32; 3],
}

impl Crossings {
    #[inline(always)]
    fn new(surface: &Surface<'_>, widest: f32, slack: f32) -> Self {
        let slack = 0.01 + slack;
        let crossing = |along: f32, offset: f32, [low, high]: [f32; 2]| {
            let per = 1.0 / if along.abs() > 1e-4 { along } else { 1e-4 };
            [0.5 * (low + high) * per, -offset * per, 0.5 * (high - low) * per.abs() + slack]
        };
        let ([ex, ey], flat) = surface.axis();
        Self { band: crossing(-ey, ex, [-widest, widest]), slab: crossing(ex, ey, [-widest, flat + widest]) }
    }

    /// The columns from `first` to `last` that may cross both between two heights. Heights are relative to the first
    /// end, which lies at `x`.
    #[inline(always)]
    fn columns(&self, heights: [f32; 2], x: f32, [first, last]: [usize; 2]) -> [usize; 2] {
        let [a, b] = [self.band, self.slab].map(|[middle, slope, half]| {
            let [a, b] = heights.map(|y| middle + slope * y);
            [a.min(b) - half, a.max(b) + half]
        });
        let (low, high) = (a[0].max(b[0]) + x, a[1].min(b[1]) + x);
        if high < 0.5 {
            return [1, 0];
        }
        // A column counts from its middle on; the conversion turns negative numbers into 0.
        [first.max((low + 0.5) as usize), last.min((high - 0.5) as usize)]
    }
}

/// The round end of a stick on a tile.
struct Ball {
    at: [f32; 3],
    radius: f32,
    ink: [f32; 3],
    spot: LocalLight,
}

impl Ball {
    fn fill(&self, tile: &mut ScreenTile, across: [usize; 2], down: [usize; 2], light: &Light) -> usize {
        let [x0, y0, d] = self.at;
        let per = 1.0 / self.radius;
        for row in down[0]..=down[1] {
            let y = (row as f32 + 0.5 - y0) * per;
            let ahead = 0.5 + tile.lean(row) - x0;
            let (depths, colours) = tile.row(row, across);
            for (i, (depth, colour)) in depths.iter_mut().zip(colours).enumerate() {
                let x = ((across[0] + i) as f32 + ahead) * per;
                let rest = 1.0 - x * x - y * y;
                if rest < 0.0 {
                    continue;
                }
                let h = rest.sqrt();
                let surface = d - self.radius * h;
                if surface < *depth {
                    *depth = surface;
                    let [lx, ly, lz] = LIGHT.map(|c| c as f32);
                    *colour = light.surface(self.ink, &self.spot, x * lx + y * ly - h * lz, h);
                }
            }
        }
        (down[1] - down[0] + 1) * (across[1] - across[0] + 1)
    }
}

/// A disc of one colour, which stands for a node too small to be looked into.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dot {
    /// The centre in the space of the picture.
    pub at: Vector,
    pub radius: f64,
    pub colour: u32,
}

impl Dot {
    /// Paints a band of the dot, from the row `from` on, on a tile whose upper left corner is at `corner`.
    pub(super) fn paint(&self, tile: &mut ScreenTile, corner: [f64; 2], from: usize) -> Painted {
        let [x, y] = [0, 1].map(|i| self.at[i] - corner[i]);
        let [width, height] = tile.size.map(|count| count as f64);
        let aside = self.radius + tile.slack();
        let Some(across) = span(x - aside, x + aside, width) else { return Painted::default() };
        let Some(down) = span(y - self.radius, y + self.radius, height) else { return Painted::default() };
        let (down, rest) = band(across, down, from);
        tile.touch(across, down);
        let (x, y, near) = (x as f32, y as f32, self.at[2] as f32);
        let reach = (self.radius * self.radius) as f32;
        for row in down[0]..=down[1] {
            let dy = row as f32 + 0.5 - y;
            let left = across[0] as f32 + 0.5 + tile.lean(row) - x;
            let (depths, colours) = tile.row(row, across);
            for (i, (depth, colour)) in depths.iter_mut().zip(colours).enumerate() {
                let dx = left + i as f32;
                if dx * dx + dy * dy <= reach && near < *depth {
                    *depth = near;
                    *colour = self.colour;
                }
            }
        }
        Painted { looked: (down[1] - down[0] + 1) * (across[1] - across[0] + 1), rest }
    }
}

/// The result of painting a band.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Painted {
    /// The number of samples looked at.
    pub looked: usize,
    /// The first row of the next band, if there is one.
    pub rest: Option<usize>,
}

/// The most samples of a band (at least a row of cells), so that a band's work is small beside a step's.
const BAND: usize = 1 << 16;

/// The rows of the band that begins at the row `from`, and the first row of the next band, if there is one. Bands end
/// at the borders of cells.
pub(super) fn band([left, right]: [usize; 2], [top, bottom]: [usize; 2], from: usize) -> ([usize; 2], Option<usize>) {
    let top = top.max(from);
    let cells = (BAND / (CELL * (right - left + 1))).max(1);
    let next = (top / CELL + cells) * CELL;
    ([top, bottom.min(next - 1)], (next <= bottom).then_some(next))
}

/// The first and the last sample of a tile whose middles lie between two places; `None` if there is none.
#[inline]
pub(super) fn span(from: f64, to: f64, side: f64) -> Option<[usize; 2]> {
    let first = (from - 0.5).ceil().max(0.0);
    let last = (to - 0.5).floor().min(side - 1.0);
    (first <= last).then_some([first as usize, last as usize])
}
