//! A search for the points nearest to a place.
//!
//! The points are sorted along a curve that fills the sheet (Morton 1966), so that consecutive points are near each
//! other. A binary tree of boxes stands above them. Removed points leave their boxes, so that a search never enters
//! empty ones.

use crate::page::{Point, distance};
use lsystem_base::Meter;

/// The points of a box at the bottom of the tree.
const LEAF: usize = 8;
/// The box around no points.
const EMPTY: [f64; 4] = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];

/// A tree of points. Points are numbered by their place in the list that it was made of.
pub(crate) struct Near {
    /// The points in the tree's order, with their numbers.
    points: Vec<(Point, u32)>,
    /// Whether each of these points is still in the tree.
    is_in: Vec<bool>,
    /// By number: the place in the tree's order.
    places: Vec<u32>,
    /// The boxes, the root at 1, the halves of box k at 2k and 2k + 1.
    boxes: Vec<[f64; 4]>,
    /// The number of boxes at the bottom: a power of two.
    leaves: usize,
    /// The boxes still to be searched, with their distances, the nearest last.
    open: Vec<(f64, u32)>,
}

/// The bits of a number with a gap behind each.
fn spread(value: u32) -> u64 {
    let mut bits = u64::from(value);
    bits = (bits | bits << 16) & 0x0000_ffff_0000_ffff;
    bits = (bits | bits << 8) & 0x00ff_00ff_00ff_00ff;
    bits = (bits | bits << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    bits = (bits | bits << 2) & 0x3333_3333_3333_3333;
    (bits | bits << 1) & 0x5555_5555_5555_5555
}

impl Near {
    /// A tree of points of a sheet of this size.
    pub(crate) fn new(points: impl Iterator<Item = Point>, size: [f64; 2]) -> Self {
        let side = size[0].max(size[1]);
        let code = |point: Point| {
            let [x, y] = point.map(|value| (value / side * f64::from(u32::MAX)) as u32);
            spread(x) | spread(y) << 1
        };
        let mut sorted: Vec<(u64, u32, Point)> =
            points.zip(0..).map(|(point, number)| (code(point), number, point)).collect();
        sorted.sort_unstable_by_key(|&(code, number, _)| (code, number));
        let points: Vec<_> = sorted.into_iter().map(|(_, number, point)| (point, number)).collect();
        let mut places = vec![0; points.len()];
        points.iter().enumerate().for_each(|(place, &(_, number))| places[number as usize] = place as u32);
        let leaves = points.len().div_ceil(LEAF).next_power_of_two();
        let mut near = Self {
            is_in: vec![true; points.len()],
            points,
            places,
            boxes: vec![EMPTY; 2 * leaves],
            leaves,
            open: Vec::new(),
        };
        (0..leaves).for_each(|leaf| near.boxes[leaves + leaf] = near.leaf_box(leaf));
        (1..leaves).rev().for_each(|at| near.boxes[at] = near.joined(at));
        near
    }

    fn leaf(&self, leaf: usize) -> core::ops::Range<usize> {
        let end = self.points.len();
        (leaf * LEAF).min(end)..((leaf + 1) * LEAF).min(end)
    }

    fn leaf_box(&self, leaf: usize) -> [f64; 4] {
        let inside = self.leaf(leaf).filter(|&place| self.is_in[place]).map(|place| self.points[place].0);
        inside.fold(EMPTY, |[a, b, c, d], [x, y]| [a.min(x), b.min(y), c.max(x), d.max(y)])
    }

    fn joined(&self, at: usize) -> [f64; 4] {
        let ([a, b, c, d], [e, f, g, h]) = (self.boxes[2 * at], self.boxes[2 * at + 1]);
        [a.min(e), b.min(f), c.max(g), d.max(h)]
    }

    /// Removes a point.
    pub(crate) fn remove(&mut self, number: u32) {
        let place = self.places[number as usize] as usize;
        self.is_in[place] = false;
        let leaf = place / LEAF;
        let mut at = self.leaves + leaf;
        let mut next = self.leaf_box(leaf);
        while self.boxes[at] != next {
            self.boxes[at] = next;
            at /= 2;
            if at == 0 {
                return;
            }
            next = self.joined(at);
        }
    }

    /// Puts all points back, for a search among all of them. `full` has the boxes of the new tree.
    pub(crate) fn restore(&mut self, full: &[[f64; 4]]) {
        self.is_in.fill(true);
        self.boxes.copy_from_slice(full);
    }

    /// A copy of all boxes, for [`Near::restore`].
    pub(crate) fn boxes(&self) -> Vec<[f64; 4]> {
        self.boxes.clone()
    }

    /// The numbers of the nearest points for which `admits` is true, nearest first, with their distances.
    pub(crate) fn nearest<const N: usize>(
        &mut self,
        from: Point,
        meter: &mut Meter,
        admits: impl Fn(u32) -> bool,
    ) -> [(f64, u32); N] {
        let mut found = [(f64::INFINITY, u32::MAX); N];
        self.open.clear();
        if self.points.is_empty() {
            return found;
        }
        self.open.push((away(from, &self.boxes[1]), 1));
        let mut work = 1;
        while let Some((least, at)) = self.open.pop() {
            if least >= found[N - 1].0 {
                continue;
            }
            work += 1;
            let at = at as usize;
            if at < self.leaves {
                let mut halves = [2 * at, 2 * at + 1].map(|half| (away(from, &self.boxes[half]), half as u32));
                if halves[0].0 < halves[1].0 {
                    halves.swap(0, 1);
                }
                self.open.extend(halves.into_iter().filter(|half| half.0 < found[N - 1].0));
                continue;
            }
            for place in self.leaf(at - self.leaves) {
                let (point, number) = self.points[place];
                let far = distance(from, point);
                if self.is_in[place] && far < found[N - 1].0 && admits(number) {
                    let slot = found.iter().position(|other| far < other.0).unwrap_or(N - 1);
                    found[slot..].rotate_right(1);
                    found[slot] = (far, number);
                }
            }
        }
        meter.charge(work);
        found
    }
}

/// The distance from a point to a box; infinite for the empty box.
fn away([x, y]: Point, [a, b, c, d]: &[f64; 4]) -> f64 {
    let [x, y] = [(a - x).max(x - c).max(0.0), (b - y).max(y - d).max(0.0)];
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_points_are_those_of_a_plain_search() {
        let points: Vec<Point> = (0..700_u32)
            .map(|at| [7, 11].map(|by| f64::from(at.wrapping_mul(2_654_435_761).rotate_left(by) % 1000) / 10.0))
            .collect();
        let mut near = Near::new(points.iter().copied(), [100.0, 100.0]);
        let full = near.boxes();
        let mut left: Vec<u32> = (0..points.len() as u32).collect();
        let mut from = [3.0, 4.0];
        while !left.is_empty() {
            let found = near.nearest::<3>(from, &mut Meter::new(1), |_| true);
            let mut all: Vec<f64> = left.iter().map(|&number| distance(from, points[number as usize])).collect();
            all.sort_by(f64::total_cmp);
            assert!(found.iter().zip(&all).all(|(found, far)| found.0 == *far));
            left.retain(|&number| number != found[0].1);
            near.remove(found[0].1);
            from = points[found[0].1 as usize];
        }
        assert_eq!(near.nearest::<1>(from, &mut Meter::new(1), |_| true)[0].1, u32::MAX);
        near.restore(&full);
        assert_eq!(near.nearest::<1>(from, &mut Meter::new(1), |_| true)[0].0, 0.0);
    }
}
