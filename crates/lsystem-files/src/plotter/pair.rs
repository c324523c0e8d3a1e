//! Points in pairs with little distance in all: the moves of the raised pen between the ends that are left over.
//!
//! First the nearest points are joined (greedy matching), then two pairs at a time exchange their points as long as the
//! sum becomes less.

use super::near::{Near, NearMaker};
use super::page::{Point, distance};
use super::sort::Sort;
use core::cmp::Ordering;
use lsystem_syntax::{Meter, Progress};
use std::collections::VecDeque;

/// The nearest points that are tried for each point.
const NEIGHBOURS: usize = 6;
/// The units of work to exchange pairs, for each point.
const EFFORT: u64 = 1000;
/// The least saving, in millimetres: far above rounding errors.
const LEAST: f64 = 1e-6;
/// No point.
const NONE: u32 = u32::MAX;

/// Two points and their distance.
type Couple = (f64, u32, u32);

/// Pairs points in steps. Their number is even.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    points: Vec<Point>,
    /// By point: the other one of its pair.
    mates: Vec<u32>,
    stage: Stage,
    left: u64,
}

#[derive(Clone, Debug)]
enum Stage {
    Prepare(NearMaker),
    /// Finds near points for the remaining points; the number is the next one's place in the list.
    Collect(Tree, Vec<u32>, usize, Vec<Couple>),
    Sort(Tree, Sort<Couple>),
    /// Joins the couples; the number is the next couple's place in the list.
    Join(Tree, Vec<Couple>, usize),
    Exchange(Tree, VecDeque<u32>),
    Done,
}

/// The tree of the points without a mate, and the boxes of the tree of all points.
#[derive(Clone, Debug)]
struct Tree {
    near: Near,
    full: Vec<[f64; 4]>,
}

impl Pair {
    /// Prepares the pairs of points of a sheet of this size.
    pub(super) fn new(points: Vec<Point>, size: [f64; 2]) -> Self {
        let maker = NearMaker::new(points.iter().copied(), size);
        Self {
            mates: vec![NONE; points.len()],
            left: EFFORT * points.len() as u64,
            points,
            stage: Stage::Prepare(maker),
        }
    }

    /// Continues until the meter is spent.
    pub(super) fn step(&mut self, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            meter.charge(1);
            self.stage = match core::mem::replace(&mut self.stage, Stage::Done) {
                Stage::Prepare(mut maker) => match maker.step(meter) {
                    Progress::More => Stage::Prepare(maker),
                    Progress::Done => {
                        let near = maker.finish();
                        let full = near.boxes();
                        Stage::Collect(Tree { near, full }, (0..self.points.len() as u32).collect(), 0, Vec::new())
                    }
                },
                Stage::Collect(mut tree, left, at, mut couples) => match left.get(at) {
                    Some(&point) => {
                        let found = self.neighbours(&mut tree.near, point, meter);
                        // Each couple is found from one of its points at least.
                        couples.extend(found.map(|(far, other)| (far, point.min(other), point.max(other))));
                        Stage::Collect(tree, left, at + 1, couples)
                    }
                    None => Stage::Sort(tree, Sort::new(couples, order)),
                },
                Stage::Sort(tree, mut sort) => match sort.step(meter) {
                    Progress::More => Stage::Sort(tree, sort),
                    Progress::Done => Stage::Join(tree, sort.finish(), 0),
                },
                Stage::Join(mut tree, couples, at) => match couples.get(at) {
                    Some(&(_, a, b)) => {
                        if self.mates[a as usize] == NONE && self.mates[b as usize] == NONE {
                            (self.mates[a as usize], self.mates[b as usize]) = (b, a);
                            [a, b].iter().for_each(|&point| tree.near.remove(point));
                        }
                        Stage::Join(tree, couples, at + 1)
                    }
                    None => self.next_round(tree, meter),
                },
                Stage::Exchange(mut tree, mut queue) => match queue.pop_front().filter(|_| self.left > 0) {
                    Some(point) => {
                        let before = meter.spent();
                        queue.extend(self.exchange(&mut tree.near, point, meter).into_iter().flatten());
                        self.left = self.left.saturating_sub(1 + meter.spent() - before);
                        Stage::Exchange(tree, queue)
                    }
                    None => Stage::Done,
                },
                Stage::Done => return Progress::Done,
            };
        }
        Progress::More
    }

    /// The pairs, after all steps.
    pub(super) fn finish(self) -> impl Iterator<Item = [u32; 2]> {
        (0..).zip(self.mates).filter(|&(point, mate)| point < mate && mate != NONE).map(|(point, mate)| [point, mate])
    }

    /// Collects couples of the points that are left, or begins to exchange.
    fn next_round(&self, mut tree: Tree, meter: &mut Meter) -> Stage {
        let left: Vec<u32> =
            (0..self.points.len() as u32).filter(|&point| self.mates[point as usize] == NONE).collect();
        meter.charge(self.points.len() as u64 / 16);
        // A single point has no mate.
        if left.len() > 1 {
            return Stage::Collect(tree, left, 0, Vec::new());
        }
        tree.near.restore(&tree.full);
        Stage::Exchange(tree, (0..self.points.len() as u32).collect())
    }

    fn neighbours(&self, near: &mut Near, point: u32, meter: &mut Meter) -> impl Iterator<Item = (f64, u32)> + use<> {
        let found = near.nearest::<NEIGHBOURS>(self.points[point as usize], meter, |other| other != point);
        found.into_iter().filter(|found| found.1 != NONE)
    }

    /// Exchanges the mates of a point and of a near one, if that saves distance. Returns the four points.
    fn exchange(&mut self, near: &mut Near, point: u32, meter: &mut Meter) -> Option<[u32; 4]> {
        let mate = self.mates[point as usize];
        if mate == NONE {
            return None;
        }
        let far = |a: u32, b: u32| distance(self.points[a as usize], self.points[b as usize]);
        let own = far(point, mate);
        for (new, other) in self.neighbours(near, point, meter) {
            let others = self.mates[other as usize];
            if other == mate || others == NONE {
                continue;
            }
            if own + far(other, others) - new - far(mate, others) > LEAST {
                for [a, b] in [[point, other], [mate, others]] {
                    (self.mates[a as usize], self.mates[b as usize]) = (b, a);
                }
                return Some([point, mate, other, others]);
            }
        }
        None
    }
}

fn order(a: &Couple, b: &Couple) -> Ordering {
    a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_nearly_as_good_as_the_best_ones() {
        let (mut found, mut best) = (0.0, 0.0);
        for seed in 1..40_u64 {
            let mut state = seed;
            let mut number = || {
                // A linear congruential generator (Knuth, MMIX).
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                (state >> 40) as f64 / f64::from(1 << 24) * 100.0
            };
            let points: Vec<Point> = (0..8).map(|_| [number(), number()]).collect();
            let mut pair = Pair::new(points.clone(), [100.0; 2]);
            while pair.step(&mut Meter::new(3)) == Progress::More {}
            let pairs: Vec<[u32; 2]> = pair.finish().collect();
            let mut all: Vec<u32> = pairs.iter().flatten().copied().collect();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..8));
            found += pairs.iter().map(|pair| distance(points[pair[0] as usize], points[pair[1] as usize])).sum::<f64>();
            best += least(&points);
        }
        assert!(found < 1.05 * best && best < found + 1e-6, "{found} {best}");
    }

    /// The least sum of all ways to pair the points.
    fn least(points: &[Point]) -> f64 {
        let Some((&first, rest)) = points.split_first() else { return 0.0 };
        let with = |at: usize| {
            let mut left = rest.to_vec();
            distance(first, left.remove(at)) + least(&left)
        };
        (0..rest.len()).map(with).fold(f64::INFINITY, f64::min)
    }
}
