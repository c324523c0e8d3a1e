//! Lines a pen's width apart, in place of broad strokes and of polygons.

use crate::page::{Point, distance};
use core::f64::consts::FRAC_1_SQRT_2;
use lsystem_base::sorted;
use lsystem_syntax::{Halt, Work};

/// The lines of a stroke with these widths at its ends, at most `most`: along its axis, joined end to end in turns.
pub(crate) fn broad([from, to]: [Point; 2], widths: [f64; 2], pen: f64, most: u64) -> impl Iterator<Item = [Point; 2]> {
    let length = distance(from, to);
    // The outer lines reach the stroke's sides with half a pen.
    let between = widths.map(|width| (width - pen).max(0.0));
    let count = (libm::ceil(between[0].max(between[1]) / pen) as u64).saturating_add(1).min(most);
    let aside = [(from[1] - to[1]) / length, (to[0] - from[0]) / length];
    let line = move |number: u64| {
        let part = if count > 1 { number as f64 / (count - 1) as f64 - 0.5 } else { 0.0 };
        let ends = [(from, between[0]), (to, between[1])];
        let ends = ends.map(|(end, between)| [0, 1].map(|axis| end[axis] + between * part * aside[axis]));
        if number.is_multiple_of(2) { ends } else { [ends[1], ends[0]] }
    };
    (0..count).flat_map(move |number| {
        let own = line(number);
        let joint = (number + 1 < count).then(|| [own[1], line(number + 1)[0]]);
        core::iter::once(own).chain(joint)
    })
}

/// A crossing of a hatch line and a side of a polygon: the line's number, the place along it, and 1 where the side
/// leads upwards, -1 where it leads downwards.
type Crossing = (i64, f64, i32);

/// The crossings of a polygon's hatch lines, line by line and along each. The lines are the same for all polygons, at 45
/// degrees. `None` if there are more than `most` crossings.
pub(crate) fn crossings(
    vertices: &[Point],
    pen: f64,
    most: u64,
    work: &mut dyn Work,
) -> Result<Option<Vec<Crossing>>, Halt> {
    let mut crossings: Vec<Crossing> = vec![];
    for (from, to) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
        work.charge(1)?;
        let [from, to] = [*from, *to].map(turned);
        // Half-open, so that a vertex on a hatch line counts once.
        let number = |v: f64| libm::ceil(v / pen - 0.5) as i64;
        let way = if to[1] > from[1] { 1 } else { -1 };
        for line in number(from[1].min(to[1]))..number(from[1].max(to[1])) {
            work.charge(1)?;
            let part = (height(line, pen) - from[1]) / (to[1] - from[1]);
            crossings.push((line, from[0] + part.clamp(0.0, 1.0) * (to[0] - from[0]), way));
            if crossings.len() as u64 > most {
                return Ok(None);
            }
        }
    }
    sorted::sort_by(&mut crossings, |a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    Ok(Some(crossings))
}

/// The hatch lines between crossings, by the nonzero winding rule: `None` for a crossing where no line ends.
pub(crate) fn lines(crossings: Vec<Crossing>, pen: f64) -> impl Iterator<Item = Option<[Point; 2]>> {
    let (mut winding, mut start) = (0, None);
    crossings.into_iter().map(move |(line, at, way)| {
        winding += way;
        match start {
            None => start = Some((line, at)),
            Some((line, from)) if winding == 0 => {
                start = None;
                let v = height(line, pen);
                return (at > from).then(|| [[from, v], [at, v]].map(turned_back));
            }
            Some(_) => {}
        }
        None
    })
}

/// The place of a hatch line across all of them.
fn height(line: i64, pen: f64) -> f64 {
    (line as f64 + 0.5) * pen
}

/// A point in axes along and across the hatch lines.
fn turned([x, y]: Point) -> Point {
    [(x + y) * FRAC_1_SQRT_2, (y - x) * FRAC_1_SQRT_2]
}

fn turned_back([u, v]: Point) -> Point {
    [(u - v) * FRAC_1_SQRT_2, (u + v) * FRAC_1_SQRT_2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_base::Meter;

    fn filled(vertices: &[Point], pen: f64) -> Vec<[Point; 2]> {
        let crossings = crossings(vertices, pen, 1000, &mut Meter::new(0)).unwrap().unwrap();
        lines(crossings, pen).flatten().collect()
    }

    fn ink(lines: &[[Point; 2]]) -> f64 {
        lines.iter().map(|[a, b]| distance(*a, *b)).sum()
    }

    #[test]
    fn hatch_lines_cover_the_area_once() {
        let square = [[1.0, 1.0], [11.0, 1.0], [11.0, 11.0], [1.0, 11.0]];
        assert!((ink(&filled(&square, 0.1)) * 0.1 - 100.0).abs() < 1.0);
        // Two windings of one square are inside, too.
        let twice = [square, square].concat();
        assert!((ink(&filled(&twice, 0.1)) * 0.1 - 100.0).abs() < 1.0);
        // A bow tie has two triangles.
        let tie = [[0.0, 0.0], [10.0, 10.0], [10.0, 0.0], [0.0, 10.0]];
        assert!((ink(&filled(&tie, 0.1)) * 0.1 - 50.0).abs() < 1.5);
        assert_eq!(crossings(&square, 1e-3, 100, &mut Meter::new(0)), Ok(None));
    }

    #[test]
    fn a_broad_stroke_is_one_way_of_lines() {
        let lines: Vec<_> = broad([[0.0, 0.0], [10.0, 0.0]], [1.0; 2], 0.3, 100).collect();
        assert_eq!(lines.len(), 7);
        assert!(lines.windows(2).all(|pair| distance(pair[0][1], pair[1][0]) < 1e-12));
        let reach = lines.iter().flatten().map(|point| point[1].abs()).fold(0.0, f64::max);
        assert!((reach - 0.35).abs() < 1e-12);
        assert_eq!(broad([[0.0, 0.0], [10.0, 0.0]], [0.2; 2], 0.3, 100).count(), 1);
        assert_eq!(broad([[0.0, 0.0], [10.0, 0.0]], [1e300; 2], 0.3, 4).count(), 7);
    }
}
