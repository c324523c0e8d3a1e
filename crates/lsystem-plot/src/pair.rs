//! Points in pairs with little distance in all: the moves of the raised pen between the ends that are left over.
//!
//! First the nearest points are joined (greedy matching), then two pairs at a time exchange their points as long as the
//! sum becomes less.

use crate::near::Near;
use crate::page::{Point, distance};
use lsystem_base::Meter;
use lsystem_syntax::{Halt, Work};
use std::collections::VecDeque;

/// The nearest points that are tried for each point.
const NEIGHBOURS: usize = 6;
/// The units of work to exchange pairs, for each point.
const EFFORT: u64 = 1000;
/// The least saving, in millimetres: far above rounding errors.
const LEAST: f64 = 1e-6;
/// No point.
const NONE: u32 = u32::MAX;

/// The pairs of an even number of points on a sheet of this size.
pub(crate) fn pairs(
    points: &[Point],
    size: [f64; 2],
    work: &mut dyn Work,
) -> Result<impl Iterator<Item = [u32; 2]> + use<>, Halt> {
    let near = Near::new(points.iter().copied(), size);
    let full = near.boxes();
    let mut pairs = Pairs { points, near, mates: vec![NONE; points.len()] };
    pairs.join(work)?;
    pairs.near.restore(&full);
    pairs.improve(work)?;
    let pairs = (0..).zip(pairs.mates).filter(|&(point, mate)| point < mate && mate != NONE);
    Ok(pairs.map(|(point, mate)| [point, mate]))
}

/// Pairs in the making.
struct Pairs<'a> {
    points: &'a [Point],
    /// The points without a mate; all points while pairs exchange their points.
    near: Near,
    /// By point: the other one of its pair.
    mates: Vec<u32>,
}

impl Pairs<'_> {
    /// Joins the nearest points until at most one is left.
    fn join(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let mut left: Vec<u32> = (0..self.points.len() as u32).collect();
        // A single point has no mate.
        while left.len() > 1 {
            let mut couples = vec![];
            for &point in &left {
                let mut meter = Meter::new(u64::MAX);
                let found = self.neighbours(point, &mut meter);
                // Each couple is found from one of its points at least.
                couples.extend(found.map(|(far, other)| (far, point.min(other), point.max(other))));
                work.charge(1 + meter.spent())?;
            }
            couples.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
            for (_, a, b) in couples {
                work.charge(1)?;
                if self.mates[a as usize] == NONE && self.mates[b as usize] == NONE {
                    (self.mates[a as usize], self.mates[b as usize]) = (b, a);
                    [a, b].iter().for_each(|&point| self.near.remove(point));
                }
            }
            left.retain(|&point| self.mates[point as usize] == NONE);
        }
        Ok(())
    }

    /// Exchanges points of pairs as long as that saves distance and work is left.
    fn improve(&mut self, work: &mut dyn Work) -> Result<(), Halt> {
        let mut queue: VecDeque<u32> = (0..self.points.len() as u32).collect();
        let mut left = EFFORT * self.points.len() as u64;
        while left > 0
            && let Some(point) = queue.pop_front()
        {
            let mut meter = Meter::new(u64::MAX);
            meter.charge(1);
            queue.extend(self.exchange(point, &mut meter).into_iter().flatten());
            left = left.saturating_sub(meter.spent());
            work.charge(meter.spent())?;
        }
        Ok(())
    }

    fn neighbours(&mut self, point: u32, meter: &mut Meter) -> impl Iterator<Item = (f64, u32)> + use<> {
        let found = self.near.nearest::<NEIGHBOURS>(self.points[point as usize], meter, |other| other != point);
        found.into_iter().filter(|found| found.1 != NONE)
    }

    /// Exchanges the mates of a point and of a near one, if that saves distance. Returns the four points.
    fn exchange(&mut self, point: u32, meter: &mut Meter) -> Option<[u32; 4]> {
        let mate = self.mates[point as usize];
        if mate == NONE {
            return None;
        }
        let points = self.points;
        let far = |a: u32, b: u32| distance(points[a as usize], points[b as usize]);
        let own = far(point, mate);
        for (new, other) in self.neighbours(point, meter) {
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
            let pairs: Vec<[u32; 2]> = pairs(&points, [100.0; 2], &mut Meter::new(0)).unwrap().collect();
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
