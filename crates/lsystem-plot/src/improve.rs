//! A shorter way: two joints of the way are replaced (2-opt, Croes 1958), or a few polylines are moved elsewhere
//! (Or-opt, Or 1976), as long as the travel becomes shorter and work is left.
//!
//! Only polylines near each other are joined anew, and a polyline is looked at again only after one of its joints has
//! changed (Bentley 1992).

use crate::near::Near;
use crate::page::{Point, distance};
use lsystem_base::Meter;
use lsystem_syntax::{Halt, Work};
use std::collections::VecDeque;

/// The nearest ends that are tried.
const NEIGHBOURS: usize = 10;
/// The most polylines that are moved together.
const MOVED: usize = 12;
/// The most polylines that change their places at a time. Longer changes save little, and their time grows as the
/// square of the number of polylines (Johnson and McGeoch 1997).
const LONGEST: usize = 50_000;
/// The units of work for each polyline.
const EFFORT: u64 = 1500;
/// The polylines that change their places in a unit of work.
const SHIFTED: u64 = 16;
/// The least saving, in millimetres: far above rounding errors.
const LEAST: f64 = 1e-6;

/// Improves the closed way through polylines whose ends are given in the order of the way: the first end of polyline k
/// at 2k, the last at 2k + 1. They are the points of the tree. The pen starts and ends at `start`. Returns the end at
/// which each polyline is entered.
pub(crate) fn improve(near: Near, mut ends: Vec<Point>, start: Point, work: &mut dyn Work) -> Result<Vec<u32>, Halt> {
    let count = ends.len() as u32 / 2;
    let mut left = EFFORT * u64::from(count);
    ends.extend([start, start]);
    let mut improve = Improve::new(near, ends, (0..count).map(|polyline| 2 * polyline).collect(), work)?;
    while left > 0
        && let Some(units) = improve.step()
    {
        left = left.saturating_sub(units);
        work.charge(units)?;
    }
    improve.tour.remove(0);
    Ok(improve.tour)
}

/// A closed way that becomes shorter.
struct Improve {
    ends: Vec<Point>,
    /// By end: the nearest ends of other polylines, nearest first, or `u32::MAX`.
    neighbours: Vec<[u32; NEIGHBOURS]>,
    /// The end at which each polyline is entered, in order. The start of the pen is the first polyline and stays there.
    tour: Vec<u32>,
    /// By polyline: its place in the tour.
    places: Vec<u32>,
    /// The polylines to look at, and whether each is among them.
    queue: VecDeque<u32>,
    is_queued: Vec<bool>,
}

impl Improve {
    fn new(mut near: Near, ends: Vec<Point>, way: Vec<u32>, work: &mut dyn Work) -> Result<Self, Halt> {
        let mut neighbours = near.neighbours(|own, other| own / 2 != other / 2, work)?;
        let start = near.nearest(ends[ends.len() - 1], &mut Meter::new(u64::MAX), |_| true).map(|(_, other)| other);
        neighbours.extend([start; 2]);
        let count = way.len() as u32;
        let tour: Vec<u32> = core::iter::once(2 * count).chain(way).collect();
        let mut places = vec![0; tour.len()];
        tour.iter().zip(0..).for_each(|(&end, place)| places[end as usize / 2] = place);
        Ok(Self {
            ends,
            neighbours,
            places,
            queue: tour.iter().map(|end| end / 2).collect(),
            is_queued: vec![true; tour.len()],
            tour,
        })
    }

    /// Looks at the next polyline. Returns the units of work for it; `None` if no polyline is left.
    fn step(&mut self) -> Option<u64> {
        let polyline = self.queue.pop_front()?;
        self.is_queued[polyline as usize] = false;
        let mut meter = Meter::new(u64::MAX);
        meter.charge(1);
        if self.improve(polyline, &mut meter) {
            self.look_at(polyline);
        }
        Some(meter.spent())
    }

    fn far(&self, a: u32, b: u32) -> f64 {
        distance(self.ends[a as usize], self.ends[b as usize])
    }

    /// The end at which the polyline at a place is entered. The way is closed.
    fn entry(&self, place: usize) -> u32 {
        self.tour[if place == self.tour.len() { 0 } else { place }]
    }

    fn exit(&self, place: usize) -> u32 {
        self.tour[place] ^ 1
    }

    fn look_at(&mut self, polyline: u32) {
        if !core::mem::replace(&mut self.is_queued[polyline as usize], true) {
            self.queue.push_back(polyline);
        }
    }

    /// Tries to improve the joints of a polyline. Returns whether one is better now.
    fn improve(&mut self, polyline: u32, meter: &mut Meter) -> bool {
        for side in [0, 1] {
            let end = 2 * polyline + side;
            for other in self.neighbours[end as usize].into_iter().take_while(|&other| other != u32::MAX) {
                meter.charge(1);
                let far = self.far(end, other);
                if self.exchange(end, other, far, meter) || self.move_near(end, other, far, meter) {
                    return true;
                }
            }
        }
        false
    }

    /// 2-opt: joins `end` to `other`, if that saves travel.
    fn exchange(&mut self, end: u32, other: u32, far: f64, meter: &mut Meter) -> bool {
        let [at, to] = [end, other].map(|end| self.places[end as usize / 2] as usize);
        let is_exit = self.tour[at] != end;
        // The pen's start is no polyline; its ends are the same point. The start is left at its exit only, and entered at
        // its entry only.
        if is_exit != (self.tour[to] != other) {
            return false;
        }
        // The part of the way between the two joints.
        let (first, last) = match is_exit {
            true => (at.min(to) + 1, at.max(to)),
            false if at == 0 || to == 0 => (at.max(to), self.tour.len() - 1),
            false => (at.min(to), at.max(to) - 1),
        };
        let [before, start, stop, after] =
            [self.exit(first - 1), self.entry(first), self.exit(last), self.entry(last + 1)];
        let old = self.far(before, start) + self.far(stop, after);
        if far + LEAST >= old || old - self.far(before, stop) - self.far(start, after) < LEAST {
            return false;
        }
        if last - first > LONGEST {
            return false;
        }
        self.reverse(first, last, meter);
        [before, start, stop, after].iter().for_each(|end| self.look_at(end / 2));
        true
    }

    /// Or-opt: moves up to [`MOVED`] polylines, the last of which ends with `end`, next to `other`, if that saves travel.
    fn move_near(&mut self, end: u32, other: u32, far: f64, meter: &mut Meter) -> bool {
        let [at, to] = [end, other].map(|end| self.places[end as usize / 2] as usize);
        if at == 0 {
            return false;
        }
        let is_exit = self.tour[at] != end;
        let longest = self.longest_joint(to);
        for length in 1..=MOVED {
            let (first, last) = match is_exit {
                true if at >= length => (at + 1 - length, at),
                false if at + length <= self.tour.len() => (at, at + length - 1),
                _ => return false,
            };
            if (first..=last).contains(&to) {
                return false;
            }
            let [before, start, stop, after] =
                [self.exit(first - 1), self.entry(first), self.exit(last), self.entry(last + 1)];
            let saved = self.far(before, start) + self.far(stop, after) - self.far(before, after);
            if saved < far + LEAST - longest {
                continue;
            }
            // The joint of `other` into which the part goes.
            let gap = if self.tour[to] == other { to } else { to + 1 };
            if gap == 0 || (first..=last + 1).contains(&gap) {
                continue;
            }
            let (left, right) = (self.exit(gap - 1), self.entry(gap));
            let far_end = if is_exit { start } else { stop };
            let outer = if left == other { right } else { left };
            if saved - far - self.far(far_end, outer) + self.far(left, right) < LEAST {
                continue;
            }
            // The part keeps its direction if `end` comes on its own side.
            let keeps = (left == other) != is_exit;
            let shift = if gap > last { gap - first } else { last + 1 - gap };
            if shift > LONGEST {
                continue;
            }
            self.shift((first, last), gap, keeps, meter);
            [before, start, stop, after, left, right].iter().for_each(|end| self.look_at(end / 2));
            return true;
        }
        false
    }

    /// The longer joint of the polyline at a place.
    fn longest_joint(&self, place: usize) -> f64 {
        let before = if place == 0 { self.tour.len() - 1 } else { place - 1 };
        let [a, b] = [(before, place), (place, place + 1)].map(|(from, to)| self.far(self.exit(from), self.entry(to)));
        a.max(b)
    }

    /// Reverses a part of the way.
    fn reverse(&mut self, first: usize, last: usize, meter: &mut Meter) {
        meter.charge((last - first) as u64 / SHIFTED + 1);
        let part = &mut self.tour[first..=last];
        part.reverse();
        part.iter_mut().for_each(|end| *end ^= 1);
        self.number(first, last);
    }

    /// Moves a part of the way to the joint before the place `gap`, reversed unless it `keeps` its direction.
    fn shift(&mut self, (first, last): (usize, usize), gap: usize, keeps: bool, meter: &mut Meter) {
        if !keeps {
            self.reverse(first, last, meter);
        }
        let (from, to) = (first.min(gap), last.max(gap - 1));
        meter.charge((to - from) as u64 / SHIFTED + 1);
        let count = last + 1 - first;
        let part = &mut self.tour[from..=to];
        if gap > last {
            part.rotate_left(count);
        } else {
            part.rotate_right(count);
        }
        self.number(from, to);
    }

    /// Notes the places of a part of the way.
    fn number(&mut self, first: usize, last: usize) {
        for place in first..=last {
            self.places[self.tour[place] as usize / 2] = place as u32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn length(ends: &[Point], way: &[u32]) -> f64 {
        let start = ends[ends.len() - 1];
        let (mut at, mut sum) = (start, 0.0);
        for &end in way {
            sum += distance(at, ends[end as usize]);
            at = ends[end as usize ^ 1];
        }
        sum + distance(at, start)
    }

    #[test]
    fn a_way_becomes_shorter_and_keeps_all_polylines() {
        let mut state = 1_u64;
        let mut number = || {
            // A linear congruential generator (Knuth, MMIX).
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / f64::from(1 << 24) * 100.0
        };
        let mut ends: Vec<Point> = (0..400).map(|_| [number(), number()]).collect();
        for pair in ends.chunks_exact_mut(2) {
            pair[1] = [0, 1].map(|axis| pair[0][axis] + (pair[1][axis] - pair[0][axis]) / 20.0);
        }
        let near = Near::new(ends.iter().copied());
        ends.extend([[0.0; 2]; 2]);
        let way: Vec<u32> = (0..200).map(|polyline| 2 * polyline).collect();
        let before = length(&ends, &way);
        let mut improve = Improve::new(near, ends.clone(), way, &mut Meter::new(0)).unwrap();
        let mut last = before;
        while improve.step().is_some() {
            let now = length(&ends, &improve.tour[1..]);
            assert!(now <= last + 1e-9 && improve.tour[0] == 400);
            last = now;
        }
        let way = improve.tour[1..].to_vec();
        let mut polylines: Vec<u32> = way.iter().map(|end| end / 2).collect();
        polylines.sort_unstable();
        assert!(polylines.into_iter().eq(0..200));
        // A random way of n points in a square of side s has a length of 0.52 n s, the shortest one 0.71 s sqrt(n).
        let after = length(&ends, &way);
        assert!(after < 0.85 * 100.0 * 200.0_f64.sqrt() && before > 0.4 * 200.0 * 100.0, "{before} {after}");
    }
}
