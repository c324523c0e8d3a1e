//! Points in pairs with little distance in all: the moves of the raised pen between the ends that are left over.
//!
//! First the nearest points are joined (greedy matching), then two pairs at a time exchange their points as long as the
//! sum becomes less.

use crate::near::Near;
use crate::page::{Point, distance};
use core::cmp::Reverse;
use lsystem_base::Meter;
use lsystem_syntax::{Halt, Work};
use std::collections::{BinaryHeap, VecDeque};

/// The nearest points that are tried for each point.
const NEIGHBOURS: usize = 6;
/// The units of work to exchange pairs, for each point.
const EFFORT: u64 = 200;
/// The least saving, in millimetres: far above rounding errors.
const LEAST: f64 = 1e-6;
/// No point.
const NONE: u32 = u32::MAX;

/// The pairs of an even number of points.
pub(crate) fn pairs(points: &[Point], work: &mut dyn Work) -> Result<impl Iterator<Item = [u32; 2]> + use<>, Halt> {
    let mut near = Near::new(points.iter().copied());
    let order = near.number_in_order();
    let points: Vec<Point> = order.iter().map(|&point| points[point as usize]).collect();
    let neighbours = near.neighbours(|a, b| a != b, work)?;
    let mut pairs = Pairs { points: &points, neighbours, mates: vec![NONE; points.len()] };
    pairs.join(&mut near, work)?;
    drop(near);
    pairs.improve(work)?;
    let pairs = (0..).zip(pairs.mates).filter(|&(point, mate)| point < mate && mate != NONE);
    Ok(pairs.map(move |(point, mate)| [point, mate].map(|point| order[point as usize])))
}

/// Pairs in the making.
struct Pairs<'a> {
    points: &'a [Point],
    /// By point: the nearest other points of all, nearest first, or [`NONE`].
    neighbours: Vec<[u32; NEIGHBOURS]>,
    /// By point: the other one of its pair.
    mates: Vec<u32>,
}

impl Pairs<'_> {
    /// Joins the two nearest points without a mate, until at most one is left.
    fn join(&mut self, near: &mut Near, work: &mut dyn Work) -> Result<(), Halt> {
        // For each point without a mate: a point at most as far away as the nearest one without a mate. The bits of
        // distances are in the order of the distances.
        let mut next: BinaryHeap<Reverse<(u64, u32, u32)>> = (0..self.points.len() as u32)
            .map(|point| Reverse((self.far(point, self.neighbours[point as usize][0]).to_bits(), point, NONE)))
            .collect();
        while let Some(Reverse((_, point, other))) = next.pop() {
            let mut meter = Meter::new(u64::MAX);
            meter.charge(1);
            if self.mates[point as usize] == NONE {
                if other != NONE && self.mates[other as usize] == NONE {
                    (self.mates[point as usize], self.mates[other as usize]) = (other, point);
                    [point, other].iter().for_each(|&point| near.remove(point));
                } else if let other = self.free(point, near, &mut meter)
                    && other != NONE
                {
                    next.push(Reverse((self.far(point, other).to_bits(), point, other)));
                }
            }
            work.charge(meter.spent())?;
        }
        Ok(())
    }

    /// The nearest point without a mate.
    fn free(&self, point: u32, near: &mut Near, meter: &mut Meter) -> u32 {
        let is_free = |other: &u32| *other != NONE && self.mates[*other as usize] == NONE;
        self.neighbours[point as usize]
            .into_iter()
            .find(is_free)
            .unwrap_or_else(|| near.nearest::<1>(self.points[point as usize], meter, |other| other != point)[0].1)
    }

    /// Exchanges points of pairs as long as that saves distance and work is left.
    fn improve(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let mut queue: VecDeque<u32> = (0..self.points.len() as u32).collect();
        let mut is_queued = vec![true; self.points.len()];
        let mut left = EFFORT * self.points.len() as u64;
        while left > 0
            && let Some(point) = queue.pop_front()
        {
            is_queued[point as usize] = false;
            let mut meter = Meter::new(u64::MAX);
            meter.charge(1);
            for point in self.exchange(point, &mut meter).into_iter().flatten() {
                if !core::mem::replace(&mut is_queued[point as usize], true) {
                    queue.push_back(point);
                }
            }
            left = left.saturating_sub(meter.spent());
            work.charge(meter.spent())?;
        }
        Ok(())
    }

    /// The distance between two points; infinite for no point.
    fn far(&self, a: u32, b: u32) -> f64 {
        self.points.get(b as usize).map_or(f64::INFINITY, |&b| distance(self.points[a as usize], b))
    }

    /// Exchanges the mates of a point and of a near one, if that saves distance. Returns the four points.
    fn exchange(&mut self, point: u32, meter: &mut Meter) -> Option<[u32; 4]> {
        let mate = self.mates[point as usize];
        if mate == NONE {
            return None;
        }
        let own = self.far(point, mate);
        for other in self.neighbours[point as usize] {
            meter.charge(1);
            let others = self.mates.get(other as usize).copied().unwrap_or(NONE);
            if other == mate || others == NONE {
                continue;
            }
            if own + self.far(other, others) - self.far(point, other) - self.far(mate, others) > LEAST {
                for [a, b] in [[point, other], [mate, others]] {
                    (self.mates[a as usize], self.mates[b as usize]) = (b, a);
                }
                return Some([point, mate, other, others]);
            }
        }
        None
    }
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
            let pairs: Vec<[u32; 2]> = pairs(&points, &mut Meter::new(0)).unwrap().collect();
            let mut all: Vec<u32> = pairs.iter().flatten().copied().collect();
            all.sort_unstable();
            assert!(all.into_iter().eq(0..8));
            found += pairs.iter().map(|pair| distance(points[pair[0] as usize], points[pair[1] as usize])).sum::<f64>();
            best += least(&points);
        }
        assert!(found < 1.05 * best && best < found + 1e-6, "{found} {best}");
    }

    #[test]
    fn the_two_nearest_points_are_joined_each_time() {
        let mut state = 3_u64;
        let points: Vec<Point> = (0..602)
            .map(|_| {
                [0, 1].map(|_| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                    // Most points stand in small heaps, so that many lose all their near points.
                    let [coarse, fine] = [(state >> 60) as f64, (state >> 33) as f64 / (1_u64 << 31) as f64];
                    6.0 * coarse + fine
                })
            })
            .collect();
        let mut near = Near::new(points.iter().copied());
        let neighbours = near.neighbours(|a, b| a != b, &mut Meter::new(0)).unwrap();
        let mut pairs = Pairs { points: &points, neighbours, mates: vec![NONE; points.len()] };
        pairs.join(&mut near, &mut Meter::new(0)).unwrap();
        // Naively: all couples, the nearest first.
        let count = points.len() as u32;
        let mut couples: Vec<[u32; 2]> = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect();
        couples.sort_by(|a, b| pairs.far(a[0], a[1]).total_cmp(&pairs.far(b[0], b[1])));
        let mut mates = vec![NONE; points.len()];
        for [a, b] in couples {
            if mates[a as usize] == NONE && mates[b as usize] == NONE {
                (mates[a as usize], mates[b as usize]) = (b, a);
            }
        }
        assert_eq!(pairs.mates, mates);
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
