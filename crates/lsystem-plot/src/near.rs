//! A search for the points nearest to a place.
//!
//! The points are halved across the longer side of their box, and so are the halves (k-d tree, Bentley 1975; Friedman,
//! Bentley and Finkel 1977). Removed points leave their boxes, so that a search never enters empty ones.

use crate::page::Point;
use lsystem_base::Meter;
use lsystem_base::sorted;
use lsystem_syntax::{Halt, Work};

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
    /// The boxes still to be searched, with the squares of their distances, the nearest last.
    open: Vec<(f64, u32)>,
}

/// The place at which a leaf of a tree of `count` points starts.
fn start(leaf: usize, leaves: usize, count: usize) -> usize {
    (leaf as u64 * count as u64 / leaves as u64) as usize
}

/// Sorts the points of some leaves: the points of a box are halved across its longer side.
fn sort(points: &mut [(Point, u32)], [first, end]: [usize; 2], leaves: usize) {
    let count = points.len();
    let [low, middle, high] = [first, first.midpoint(end), end].map(|leaf| start(leaf, leaves, count));
    let own = &mut points[low..high];
    if end - first == 1 {
        sorted::sort_by_key(own, |&(_, number)| number);
        return;
    }
    if middle < high {
        let [a, b, c, d] = around(own.iter().map(|&(point, _)| point));
        let axis = usize::from(d - b > c - a);
        own.select_nth_unstable_by(middle - low, |a, b| a.0[axis].total_cmp(&b.0[axis]).then(a.1.cmp(&b.1)));
    }
    sort(points, [first, first.midpoint(end)], leaves);
    sort(points, [first.midpoint(end), end], leaves);
}

/// The box around points.
fn around(points: impl Iterator<Item = Point>) -> [f64; 4] {
    points.fold(EMPTY, |[a, b, c, d], [x, y]| [a.min(x), b.min(y), c.max(x), d.max(y)])
}

impl Near {
    /// A tree of points.
    pub(crate) fn new(points: impl Iterator<Item = Point>) -> Self {
        let mut points: Vec<(Point, u32)> = points.zip(0..).collect();
        let leaves = points.len().div_ceil(LEAF).next_power_of_two();
        sort(&mut points, [0, leaves], leaves);
        let mut places = vec![0; points.len()];
        points.iter().enumerate().for_each(|(place, &(_, number))| places[number as usize] = place as u32);
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

    /// Numbers the points in the tree's order: points near each other lie near each other in memory, too. Returns the
    /// old numbers in this order.
    pub(crate) fn number_in_order(&mut self) -> Vec<u32> {
        let old = self.points.iter().map(|&(_, number)| number).collect();
        self.renumber(&self.places.clone());
        old
    }

    /// Gives the points new numbers, listed by the old ones.
    pub(crate) fn renumber(&mut self, new: &[u32]) {
        for (place, (_, number)) in (0..).zip(&mut self.points) {
            *number = new[*number as usize];
            self.places[*number as usize] = place;
        }
    }

    fn leaf(&self, leaf: usize) -> core::ops::Range<usize> {
        start(leaf, self.leaves, self.points.len())..start(leaf + 1, self.leaves, self.points.len())
    }

    fn leaf_box(&self, leaf: usize) -> [f64; 4] {
        around(self.leaf(leaf).filter(|&place| self.is_in[place]).map(|place| self.points[place].0))
    }

    fn joined(&self, at: usize) -> [f64; 4] {
        let ([a, b, c, d], [e, f, g, h]) = (self.boxes[2 * at], self.boxes[2 * at + 1]);
        [a.min(e), b.min(f), c.max(g), d.max(h)]
    }

    /// Removes a point.
    pub(crate) fn remove(&mut self, number: u32) {
        let place = self.places[number as usize] as usize;
        self.is_in[place] = false;
        let leaf = (((place as u64 + 1) * self.leaves as u64 - 1) / self.points.len() as u64) as usize;
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

    /// By number: the nearest points that `admits` a couple of numbers with the point's own first, nearest first. Missing
    /// ones are `u32::MAX`.
    pub(crate) fn neighbours<const N: usize>(
        &mut self,
        admits: impl Fn(u32, u32) -> bool,
        work: &mut dyn Work,
    ) -> Result<Vec<[u32; N]>, Halt> {
        let mut all = vec![[u32::MAX; N]; self.points.len()];
        // In the tree's order, searches that follow each other open the same boxes. Each goes from the point's own box
        // upwards: it passes by most boxes.
        for leaf in 0..self.leaves {
            for place in self.leaf(leaf) {
                let (point, number) = self.points[place];
                let admits = |other| admits(number, other);
                let mut found = [(f64::INFINITY, u32::MAX); N];
                let mut at = self.leaves + leaf;
                let mut opened = 1 + self.search(at, point, &mut found, admits);
                while at > 1 {
                    opened += self.search(at ^ 1, point, &mut found, admits);
                    at /= 2;
                }
                all[number as usize] = found.map(|(_, other)| other);
                work.charge(opened)?;
            }
        }
        Ok(all)
    }

    /// The numbers of the nearest points for which `admits` is true, nearest first, with their distances.
    pub(crate) fn nearest<const N: usize>(
        &mut self,
        from: Point,
        meter: &mut Meter,
        admits: impl Fn(u32) -> bool,
    ) -> [(f64, u32); N] {
        let mut found = [(f64::INFINITY, u32::MAX); N];
        meter.charge(1 + self.search(1, from, &mut found, admits));
        found.map(|(square, number)| (square.sqrt(), number))
    }

    /// Looks in a box for points nearer than those found so far, which have the squares of their distances. Returns the
    /// number of boxes opened.
    fn search<const N: usize>(
        &mut self,
        root: usize,
        from: Point,
        found: &mut [(f64, u32); N],
        admits: impl Fn(u32) -> bool,
    ) -> u64 {
        let mut opened = 0;
        self.open.clear();
        self.open.push((away(from, &self.boxes[root]), root as u32));
        while let Some((least, at)) = self.open.pop() {
            if least >= found[N - 1].0 {
                continue;
            }
            opened += 1;
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
                let far = square(from, point);
                if self.is_in[place] && far < found[N - 1].0 && admits(number) {
                    let slot = found.iter().position(|other| far < other.0).unwrap_or(N - 1);
                    found[slot..].rotate_right(1);
                    found[slot] = (far, number);
                }
            }
        }
        opened
    }
}

/// The square of the distance of two points.
fn square(a: Point, b: Point) -> f64 {
    let [x, y] = [b[0] - a[0], b[1] - a[1]];
    x * x + y * y
}

/// The square of the distance from a point to a box; infinite for the empty box.
fn away([x, y]: Point, [a, b, c, d]: &[f64; 4]) -> f64 {
    let [x, y] = [(a - x).max(x - c).max(0.0), (b - y).max(y - d).max(0.0)];
    x * x + y * y
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::distance;

    #[test]
    fn the_nearest_points_are_those_of_a_plain_search() {
        let points: Vec<Point> = (0..700_u32)
            .map(|at| [7, 11].map(|by| f64::from(at.wrapping_mul(2_654_435_761).rotate_left(by) % 1000) / 10.0))
            .collect();
        let mut near = Near::new(points.iter().copied());
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

    #[test]
    fn a_search_opens_few_boxes_however_the_points_lie() {
        // Points along curved lines that become denser and denser, as on the twigs of a tree.
        let points: Vec<Point> = (0..40_000_u32)
            .map(|at| {
                let (line, part) = (f64::from(at % 40), f64::from(at / 40) / 1000.0);
                [60.0 + 50.0 * part * libm::cos(line), 50.0 + 40.0 * part * part * libm::sin(line * 1.7)]
            })
            .collect();
        let mut near = Near::new(points.iter().copied());
        let mut meter = Meter::new(0);
        let all = near.neighbours::<6>(|a, b| a != b, &mut meter).unwrap();
        assert!(meter.spent() < 48 * points.len() as u64, "{}", meter.spent());
        for at in (0..points.len()).step_by(997) {
            let mut far: Vec<f64> = points.iter().map(|&point| distance(points[at], point)).collect();
            far.sort_by(f64::total_cmp);
            assert!(
                all[at].iter().zip(&far[1..]).all(|(&other, far)| distance(points[at], points[other as usize]) == *far)
            );
        }
    }
}
