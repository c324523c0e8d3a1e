//! The order of the polylines of a layer and their directions.
//!
//! Two ways are made, and the shorter one is improved. Both go to the nearest end; one of them first follows the closed
//! trails of which the polylines are parts.

use crate::improve::improve;
use crate::join::Polylines;
use crate::near::Near;
use crate::page::{Point, distance};
use lsystem_base::Meter;
use lsystem_syntax::{Halt, Work};

/// A way along polylines: the number of each, and whether it is drawn from its last point to its first.
pub(crate) type Tour = Vec<(u32, bool)>;

/// The order of the polylines of a layer. The pen starts and ends at `start`.
pub(crate) fn order(polylines: &Polylines, numbers: &[u32], start: Point, work: &mut dyn Work) -> Result<Tour, Halt> {
    // The ends of the layer's polylines: the first of polyline k at 2k, the last at 2k + 1. The start of the pen comes
    // last.
    let mut ends: Vec<Point> = numbers.iter().flat_map(|&number| polylines.ends(number as usize)).collect();
    let mut near = Near::new(ends.iter().copied());
    let full = near.boxes();
    ends.extend([start, start]);
    let trails: Vec<u32> = numbers.iter().map(|&number| polylines.trails[number as usize]).collect();
    let mut way = |trails: Option<&[u32]>| {
        let way = nearest_way(&mut near, &ends, trails, work);
        near.restore(&full);
        way
    };
    let (along, nearest) = (way(Some(&trails))?, way(None)?);
    let (way, _) = if along.1 < nearest.1 { along } else { nearest };
    // Numbered along the way, polylines that are compared lie near each other in memory, too.
    let along = || way.iter().flat_map(|&end| [end, end ^ 1]);
    let mut new = vec![0; 2 * way.len()];
    (0..).zip(along()).for_each(|(number, end)| new[end as usize] = number);
    near.renumber(&new);
    ends = along().map(|end| ends[end as usize]).collect();
    let improved = improve(near, ends, start, work)?;
    let old = |end: u32| way[end as usize / 2] ^ (end % 2);
    Ok(improved.into_iter().map(old).map(|end| (numbers[end as usize / 2], end % 2 == 1)).collect())
}

/// A way to the nearest end each time, along the closed trails if they are given: the end at which each polyline is
/// entered, and the length of the travel. The last of the `ends` are the start of the pen.
fn nearest_way(
    near: &mut Near,
    ends: &[Point],
    trails: Option<&[u32]>,
    work: &mut dyn Work,
) -> Result<(Vec<u32>, f64), Halt> {
    let start = ends[ends.len() - 1];
    let mut is_in = vec![false; ends.len() / 2];
    let (mut way, mut travel, mut at): (Vec<u32>, _, _) = (vec![], 0.0, start);
    loop {
        let mut meter = Meter::new(u64::MAX);
        let in_trail = trails.zip(way.last()).and_then(|(trails, &last)| next_in_trail(trails, &is_in, last));
        let end = in_trail.unwrap_or_else(|| near.nearest::<1>(at, &mut meter, |_| true)[0].1);
        work.charge(1 + meter.spent())?;
        if end == u32::MAX {
            return Ok((way, travel + distance(at, start)));
        }
        travel += distance(at, ends[end as usize]);
        at = ends[end as usize ^ 1];
        way.push(end);
        is_in[end as usize / 2] = true;
        near.remove(end);
        near.remove(end ^ 1);
    }
}

/// The end of the next polyline of a closed trail, in the direction of the last one.
fn next_in_trail(trails: &[u32], is_in: &[bool], last: u32) -> Option<u32> {
    let (polyline, is_flipped) = (last as usize / 2, last % 2 == 1);
    let trail = trails[polyline];
    let is_own = |other: &usize| trails.get(*other) == Some(&trail);
    // The first and the last polyline of a closed trail follow each other, too.
    let next = match is_flipped {
        false => Some(polyline + 1).filter(is_own).unwrap_or_else(|| trails.partition_point(|&own| own < trail)),
        true => {
            (polyline.checked_sub(1).filter(is_own)).unwrap_or_else(|| trails.partition_point(|&own| own <= trail) - 1)
        }
    };
    (!is_in[next]).then_some(2 * next as u32 + u32::from(is_flipped))
}

/// The point of a closed polyline at which the way from `before` and on to `after` is shortest.
pub(crate) fn best_start(points: &[Point], before: Point, after: Point) -> usize {
    let way = |point: Point| distance(before, point) + distance(point, after);
    let best = points
        .iter()
        .enumerate()
        .fold((0, f64::INFINITY), |best, (at, &point)| if way(point) < best.1 { (at, way(point)) } else { best });
    best.0 % (points.len() - 1).max(1)
}
