//! The surroundings of points in space: how many others are near, and how much of the sky's light reaches a point.

use crate::room::bytes_of;
use lsystem_base::sorted::sort;
use lsystem_base::{Meter, Progress};

/// A point, and the number that its module gives with the question: a radius or the side of a cube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Site {
    pub at: [f64; 3],
    pub size: f64,
}

/// The square of the distance of two points.
fn distance_2(a: [f64; 3], b: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|i| a[i] - b[i]);
    x * x + y * y + z * z
}

/// Points in a unit of work, where each is only put into its cell.
const POINTS_PER_UNIT: usize = 8;
/// Sites looked at in a unit of work.
const LOOKS_PER_UNIT: u64 = 16;
/// Cells in a unit of work.
const CELLS_PER_UNIT: usize = 64;

/// The number of other sites nearer than each site's radius, up to [`Crowd::MAX`].
#[derive(Default)]
pub(crate) struct Crowd {
    sites: Vec<Site>,
    /// The side of a cell: the largest radius.
    side: f64,
    /// The sites by cell: the cell's place, and the site's number. Sorted.
    cells: Vec<([i64; 3], u32)>,
    /// By site.
    counts: Vec<u32>,
    /// The number of sites that are counted, in the order of the cells: sites of one cell share the ranges around it.
    done: usize,
    /// The cell whose surroundings are known, and their nine ranges of `cells`.
    around: ([i64; 3], [[usize; 2]; 9]),
    /// The number of sites looked at.
    looked: u64,
}

impl Crowd {
    /// More are not counted.
    pub(crate) const MAX: u32 = 100;

    /// The question for these sites.
    pub(crate) fn new(sites: Vec<Site>) -> Self {
        Self { sites, ..Self::default() }
    }

    /// Goes on counting.
    pub(crate) fn step(&mut self, meter: &mut Meter) -> Progress {
        if self.cells.len() < self.sites.len() {
            let sizes = self.sites.iter().map(|site| site.size).filter(|size| size.is_finite());
            self.side = sizes.fold(0.0, f64::max).max(f64::MIN_POSITIVE);
            self.cells = self.sites.iter().zip(0..).map(|(site, number)| (self.cell(site.at), number)).collect();
            sort(&mut self.cells);
            meter.charge((self.sites.len() / POINTS_PER_UNIT) as u64);
            self.counts = vec![0; self.sites.len()];
        }
        while let Some(&(cell, own)) = self.cells.get(self.done) {
            if meter.is_spent() {
                return Progress::More;
            }
            if self.done == 0 || self.around.0 != cell {
                self.around = (cell, self.ranges(cell));
            }
            let (count, looked) = self.near(own);
            meter.charge(1 + looked / LOOKS_PER_UNIT);
            self.counts[own as usize] = count;
            self.done += 1;
            self.looked += looked;
        }
        Progress::Done
    }

    fn cell(&self, at: [f64; 3]) -> [i64; 3] {
        // Beyond this, cells are so far away that none are neighbours.
        at.map(|c| (c / self.side).floor().clamp(-1e15, 1e15) as i64)
    }

    /// The ranges of `cells` with the sites in a cell and in those next to it.
    fn ranges(&self, [x, y, z]: [i64; 3]) -> [[usize; 2]; 9] {
        core::array::from_fn(|at| {
            let (x, y) = (x + at as i64 / 3 - 1, y + at as i64 % 3 - 1);
            // Three neighbouring cells in the last direction follow each other.
            [[x, y, z - 1], [x, y, z + 2]].map(|end| self.cells.partition_point(|(cell, _)| *cell < end))
        })
    }

    /// The number of other sites near a site of the cell whose surroundings are known, and the number of sites looked at.
    fn near(&self, own: u32) -> (u32, u64) {
        let (mut count, mut looked) = (0, 0);
        let site = &self.sites[own as usize];
        for [first, end] in self.around.1 {
            looked += 4;
            for &(_, other) in &self.cells[first..end] {
                looked += 1;
                let square = distance_2(self.sites[other as usize].at, site.at);
                count += u32::from(other != own && square < site.size * site.size);
                if count == Self::MAX {
                    return (count, looked);
                }
            }
        }
        (count, looked)
    }

    /// By site.
    pub(crate) fn counts(&self) -> &[u32] {
        &self.counts
    }

    /// The units of work so far.
    pub(crate) fn work(&self) -> u64 {
        self.looked / LOOKS_PER_UNIT
    }

    pub(crate) fn bytes(&self) -> u64 {
        bytes_of(&self.sites) + bytes_of(&self.cells) + bytes_of(&self.counts)
    }
}

/// The light of the sky at each site, 0 to 1, after Palubicki et al. 2009, "Self-organizing tree models for image
/// synthesis", section 4.1: each site casts a shadow into the cubes below it. The shadow is a pyramid; it is
/// [`SHADE`] in the site's own cube and [`FADING`] times as strong in each layer below.
#[derive(Default)]
pub(crate) struct Sky {
    sites: Vec<Site>,
    grid: Grid,
    /// By layer, row and column: the number of sites in all cubes of the layer up to that row and column.
    sums: Vec<u32>,
    /// The number of layers summed up.
    done: usize,
    /// By site.
    light: Vec<f64>,
}

/// The shadow that a site casts into its own cube.
const SHADE: f64 = 0.2;
/// The strength of a shadow, relative to the layer above.
const FADING: f64 = 0.5;
/// The layers below a site that its shadow reaches: in the next, it would be below a thousandth.
const LAYERS: usize = 8;
/// The most cubes. If more were needed, cubes are larger.
const MAX_CUBES: f64 = (1 << 22) as f64;

/// Cubes around all sites.
#[derive(Default)]
struct Grid {
    /// The least coordinates.
    low: [f64; 3],
    side: f64,
    /// The number of cubes in each direction.
    count: [usize; 3],
}

impl Grid {
    /// Cubes around sites, as large as the largest size that a site asks for, or larger if there would be too many.
    fn around(sites: &[Site]) -> Self {
        let end = |start: f64, pick: fn(f64, f64) -> f64| {
            [0, 1, 2].map(|i| sites.iter().map(|site| site.at[i]).fold(start, pick))
        };
        let (low, high) = (end(f64::INFINITY, f64::min), end(f64::NEG_INFINITY, f64::max));
        let sizes = sites.iter().map(|site| site.size).filter(|size| size.is_finite());
        let mut side = sizes.fold(0.0, f64::max).max(f64::MIN_POSITIVE);
        let along = |side: f64| [0, 1, 2].map(|i| ((high[i] - low[i]) / side).floor() + 1.0);
        // Doubling ends: with infinitely large cubes there is one.
        while along(side).iter().product::<f64>() > MAX_CUBES {
            side *= 2.0;
        }
        Self { low, side, count: along(side).map(|count| if count.is_finite() { count as usize } else { 1 }) }
    }

    fn cube(&self, at: [f64; 3]) -> [usize; 3] {
        [0, 1, 2].map(|i| (((at[i] - self.low[i]) / self.side) as usize).min(self.count[i] - 1))
    }
}

impl Sky {
    /// The question for these sites.
    pub(crate) fn new(sites: Vec<Site>) -> Self {
        Self { sites, ..Self::default() }
    }

    /// Goes on.
    pub(crate) fn step(&mut self, meter: &mut Meter) -> Progress {
        if self.sites.is_empty() {
            return Progress::Done;
        }
        if self.sums.is_empty() {
            self.grid = Grid::around(&self.sites);
            let [across, up, deep] = self.grid.count;
            self.sums.resize(across * up * deep, 0);
            for site in &self.sites {
                let [x, y, z] = self.grid.cube(site.at);
                self.sums[(y * deep + z) * across + x] += 1;
            }
            meter.charge((self.sites.len() / POINTS_PER_UNIT + self.sums.len() / CELLS_PER_UNIT) as u64);
        }
        let [across, up, deep] = self.grid.count;
        while self.done < up {
            if meter.is_spent() {
                return Progress::More;
            }
            let layer = &mut self.sums[self.done * deep * across..][..deep * across];
            for at in 0..layer.len() {
                let (row, column) = (at / across, at % across);
                let left = if column > 0 { layer[at - 1] } else { 0 };
                let above = if row > 0 { layer[at - across] } else { 0 };
                let both = if row > 0 && column > 0 { layer[at - across - 1] } else { 0 };
                layer[at] = layer[at] + left + above - both;
            }
            self.done += 1;
            meter.charge(1 + (layer.len() / CELLS_PER_UNIT) as u64);
        }
        while let Some(site) = self.sites.get(self.light.len()) {
            if meter.is_spent() {
                return Progress::More;
            }
            self.light.push(self.light_at(site));
            meter.charge(1);
        }
        Progress::Done
    }

    /// The light at a site, without the site's own shadow.
    fn light_at(&self, site: &Site) -> f64 {
        let [x, y, z] = self.grid.cube(site.at);
        let [across, up, deep] = self.grid.count;
        let mut shade = -SHADE;
        let mut strength = SHADE;
        for above in 0..=LAYERS.min(up - 1 - y) {
            let layer = &self.sums[(y + above) * deep * across..][..deep * across];
            // The number of sites in a layer's cubes before a row and a column.
            let before = |row: usize, column: usize| {
                if row == 0 || column == 0 { 0 } else { layer[(row - 1) * across + column - 1] }
            };
            let [left, right] = [x.saturating_sub(above), (x + above + 1).min(across)];
            let [near, far] = [z.saturating_sub(above), (z + above + 1).min(deep)];
            let count = before(far, right) + before(near, left) - before(far, left) - before(near, right);
            shade += strength * f64::from(count);
            strength *= FADING;
        }
        (1.0 - shade).clamp(0.0, 1.0)
    }

    /// By site.
    pub(crate) fn light(&self) -> &[f64] {
        &self.light
    }

    pub(crate) fn bytes(&self) -> u64 {
        bytes_of(&self.sites) + bytes_of(&self.sums) + bytes_of(&self.light)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites(count: usize, spread: f64, size: f64) -> Vec<Site> {
        let mut state = 7_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 40) as f64 / f64::from(1 << 24) * spread
        };
        (0..count).map(|_| Site { at: [next(), next(), next() / 3.0], size }).collect()
    }

    fn finish(mut step: impl FnMut(&mut Meter) -> Progress) {
        while step(&mut Meter::new(10)) == Progress::More {}
    }

    #[test]
    fn crowds_are_those_of_all_pairs() {
        for (count, size) in [(0, 1.0), (1, 1.0), (300, 0.7), (300, 3.0), (300, 30.0), (300, 0.0)] {
            let mut all = sites(count, 10.0, size);
            // Sites in one place count each other.
            all.extend_from_within(..count.min(5));
            let naive = |own: usize| {
                let near = |(other, site): (usize, &Site)| {
                    let square = distance_2(site.at, all[own].at);
                    other != own && square < size * size
                };
                (all.iter().enumerate().filter(|&pair| near(pair)).count() as u32).min(Crowd::MAX)
            };
            let mut crowd = Crowd::new(all.clone());
            finish(|meter| crowd.step(meter));
            assert_eq!(crowd.counts(), (0..all.len()).map(naive).collect::<Vec<_>>(), "{count} {size}");
        }
    }

    #[test]
    fn light_is_that_of_all_shadows() {
        for (count, size) in [(1, 1.0), (200, 0.9), (200, 2.5), (200, 100.0)] {
            let all = sites(count, 12.0, size);
            let grid = Grid::around(&all);
            let cubes: Vec<_> = all.iter().map(|site| grid.cube(site.at).map(|c| c as i64)).collect();
            let naive = |own: usize| {
                let shade = |other: usize| {
                    let [dx, dy, dz] = [0, 1, 2].map(|i| cubes[other][i] - cubes[own][i]);
                    let falls = (0..=LAYERS as i64).contains(&dy) && dx.abs() <= dy && dz.abs() <= dy;
                    if falls && other != own { SHADE * libm::pow(FADING, dy as f64) } else { 0.0 }
                };
                (1.0 - (0..all.len()).map(shade).sum::<f64>()).clamp(0.0, 1.0)
            };
            let mut sky = Sky::new(all.clone());
            finish(|meter| sky.step(meter));
            for (own, light) in sky.light().iter().enumerate() {
                assert!((light - naive(own)).abs() < 1e-9, "{count} {size} {own}: {light} {}", naive(own));
            }
        }
    }

    #[test]
    fn strange_sites_do_no_harm() {
        let far = [0.0, 1e300, -1e300, f64::MAX].map(|c| Site { at: [c, -c, 0.0], size: 1.0 });
        let none = [0.0, f64::INFINITY, f64::NAN, -1.0, 1e-300].map(|size| Site { at: [1.0; 3], size });
        for all in [far.to_vec(), none.to_vec(), [far.as_slice(), &none].concat()] {
            let (mut crowd, mut sky) = (Crowd::new(all.clone()), Sky::new(all.clone()));
            finish(|meter| crowd.step(meter));
            finish(|meter| sky.step(meter));
            assert!(crowd.counts().len() == all.len() && sky.light().len() == all.len());
            assert!(sky.light().iter().all(|light| (0.0..=1.0).contains(light)));
        }
    }
}
