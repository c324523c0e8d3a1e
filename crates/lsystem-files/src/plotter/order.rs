//! The order of the polylines of a layer and their directions: always the nearest one next, then improved.

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
    /// The way so far: the end at which each polyline is entered.
    tour: Vec<u32>,
    /// The position of the pen.
    at: Point,
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
        Self { tour: Vec::with_capacity(numbers.len()), numbers, ends, stage: Stage::Prepare(maker), at: start }
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
                Stage::Nearest(mut near, full) => {
                    let [(_, end)] = near.nearest(self.at, meter, |_| true);
                    if end == u32::MAX {
                        near.restore(&full);
                        let (ends, tour) = (core::mem::take(&mut self.ends), core::mem::take(&mut self.tour));
                        Stage::Improve(Box::new(Improve::new(near, ends, tour)))
                    } else {
                        self.tour.push(end);
                        near.remove(end);
                        near.remove(end ^ 1);
                        self.at = self.ends[end as usize ^ 1];
                        Stage::Nearest(near, full)
                    }
                }
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

    /// The order, after all steps.
    pub(super) fn finish(self) -> Tour {
        self.tour.iter().map(|&end| (self.numbers[end as usize / 2], end % 2 == 1)).collect()
    }
}

/// The point of a closed polyline at which the way from `before` and on to `after` is shortest.
pub(super) fn best_start(points: &[Point], before: Point, after: Point) -> usize {
    let way = |point: Point| distance(before, point) + distance(point, after);
    let best = points.iter().enumerate().fold((0, f64::INFINITY), |best, (at, &point)| {
        if way(point) < best.1 { (at, way(point)) } else { best }
    });
    best.0 % (points.len() - 1).max(1)
}
