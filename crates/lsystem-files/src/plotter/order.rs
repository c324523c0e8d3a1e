//! The order of the polylines of a layer and their directions.
//!
//! Two ways are made, and the shorter one is improved. Both go to the nearest end; one of them first follows the closed
//! trails of which the polylines are parts.

use super::improve::Improve;
use super::join::Polylines;
use super::near::{Near, NearMaker};
use super::page::{Point, distance};
use lsystem_syntax::{Meter, Progress};

/// A way along polylines: the number of each, and whether it is drawn from its last point to its first.
pub(super) type Tour = Vec<(u32, bool)>;

/// Orders the polylines of one layer in steps.
#[derive(Clone, Debug)]
pub(super) struct Order {
    /// The polylines of the layer.
    numbers: Vec<u32>,
    /// The ends of these polylines: the first of polyline k at 2k, the last at 2k + 1. The start of the pen comes last.
    ends: Vec<Point>,
    stage: Stage,
    /// By polyline: the number of its closed trail.
    trails: Vec<u32>,
    /// The way so far: the end at which each polyline is entered.
    tour: Vec<u32>,
    /// By polyline: whether it is in the way.
    is_in: Vec<bool>,
    start: Point,
    /// The length of the travel so far.
    travel: f64,
    /// The way along the closed trails and its travel, once made.
    along: Option<(Vec<u32>, f64)>,
}

#[derive(Clone, Debug)]
enum Stage {
    Prepare(NearMaker),
    /// The tree of the ends that are left, and the boxes of the full tree.
    Nearest(Near, Vec<[f64; 4]>),
    Improve(Box<Improve>),
    Done,
}

impl Order {
    /// Prepares the order of the polylines of a layer on a sheet of this size. The pen starts and ends at `start`.
    pub(super) fn new(polylines: &Polylines, numbers: Vec<u32>, size: [f64; 2], start: Point) -> Self {
        let mut ends: Vec<Point> = numbers.iter().flat_map(|&number| polylines.ends(number as usize)).collect();
        let maker = NearMaker::new(ends.iter().copied(), size);
        ends.extend([start, start]);
        let trails = numbers.iter().map(|&number| polylines.trails[number as usize]).collect();
        Self {
            tour: Vec::with_capacity(numbers.len()),
            is_in: vec![false; numbers.len()],
            trails,
            numbers,
            ends,
            stage: Stage::Prepare(maker),
            start,
            travel: 0.0,
            along: None,
        }
    }

    /// Continues until the meter is spent.
    pub(super) fn step(&mut self, meter: &mut Meter) -> Progress {
        while !meter.is_spent() {
            self.stage = match core::mem::replace(&mut self.stage, Stage::Done) {
                Stage::Prepare(mut maker) => match maker.step(meter) {
                    Progress::More => Stage::Prepare(maker),
                    Progress::Done => {
                        let near = maker.finish();
                        let full = near.boxes();
                        Stage::Nearest(near, full)
                    }
                },
                Stage::Nearest(mut near, full) => match self.next(&mut near, meter) {
                    Some(end) => {
                        self.travel += distance(self.at(), self.ends[end as usize]);
                        self.tour.push(end);
                        self.is_in[end as usize / 2] = true;
                        near.remove(end);
                        near.remove(end ^ 1);
                        Stage::Nearest(near, full)
                    }
                    None => self.next_way(near, full),
                },
                Stage::Improve(mut improve) => match improve.step(meter) {
                    Progress::More => Stage::Improve(improve),
                    Progress::Done => {
                        self.tour = improve.finish();
                        Stage::Done
                    }
                },
                Stage::Done => return Progress::Done,
            };
        }
        Progress::More
    }

    /// The position of the pen.
    fn at(&self) -> Point {
        self.tour.last().map_or(self.start, |&end| self.ends[end as usize ^ 1])
    }

    /// The end that comes next.
    fn next(&self, near: &mut Near, meter: &mut Meter) -> Option<u32> {
        meter.charge(1);
        if let Some(end) = self.tour.last().filter(|_| self.along.is_none()).and_then(|&last| self.next_in_trail(last))
        {
            return Some(end);
        }
        let [(_, end)] = near.nearest(self.at(), meter, |_| true);
        Some(end).filter(|&end| end != u32::MAX)
    }

    /// The end of the next polyline of a closed trail, in the direction of the last one.
    fn next_in_trail(&self, last: u32) -> Option<u32> {
        let (polyline, is_flipped) = (last as usize / 2, last % 2 == 1);
        let trail = self.trails[polyline];
        let is_own = |other: &usize| self.trails.get(*other) == Some(&trail);
        // The first and the last polyline of a closed trail follow each other, too.
        let next = match is_flipped {
            false => {
                Some(polyline + 1).filter(is_own).unwrap_or_else(|| self.trails.partition_point(|&own| own < trail))
            }
            true => (polyline.checked_sub(1).filter(is_own))
                .unwrap_or_else(|| self.trails.partition_point(|&own| own <= trail) - 1),
        };
        (!self.is_in[next]).then_some(2 * next as u32 + u32::from(is_flipped))
    }

    /// Begins the second way, or the improvement of the shorter one.
    fn next_way(&mut self, mut near: Near, full: Vec<[f64; 4]>) -> Stage {
        near.restore(&full);
        let travel = self.travel + distance(self.at(), self.start);
        let tour = core::mem::take(&mut self.tour);
        let Some((along, other)) = self.along.take() else {
            self.along = Some((tour, travel));
            self.is_in.fill(false);
            self.travel = 0.0;
            return Stage::Nearest(near, full);
        };
        let tour = if other < travel { along } else { tour };
        Stage::Improve(Box::new(Improve::new(near, core::mem::take(&mut self.ends), tour)))
    }

    /// The order, after all steps.
    pub(super) fn finish(self) -> Tour {
        self.tour.iter().map(|&end| (self.numbers[end as usize / 2], end % 2 == 1)).collect()
    }
}

/// The point of a closed polyline at which the way from `before` and on to `after` is shortest.
pub(super) fn best_start(points: &[Point], before: Point, after: Point) -> usize {
    let way = |point: Point| distance(before, point) + distance(point, after);
    let best = points
        .iter()
        .enumerate()
        .fold((0, f64::INFINITY), |best, (at, &point)| if way(point) < best.1 { (at, way(point)) } else { best });
    best.0 % (points.len() - 1).max(1)
}
