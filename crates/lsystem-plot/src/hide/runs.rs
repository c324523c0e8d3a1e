//! Runs of vertices with the boxes around them: a line passes by most sides of a polygon with many corners.

use super::sight::{Place, Sight};
use crate::page::Point;

/// The vertices of a run: of long runs, and of the short ones in them.
const RUNS: [usize; 2] = [1024, 32];

/// The boxes around the runs of a list of vertices, by length.
#[derive(Debug, Default)]
pub(super) struct Runs([Vec<[Point; 2]>; 2]);

/// The runs of a polygon, whose vertices start at a place in the list.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part<'a>(pub(super) &'a Runs, pub(super) usize);

impl Runs {
    #[cfg(test)]
    pub(super) const NONE: &'static Self = &Self([vec![], vec![]]);

    pub(super) fn new(vertices: &[Place]) -> Self {
        let around = |run: &[Place]| {
            run.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], vertex| {
                [[0, 1].map(|axis| low[axis].min(vertex[axis])), [0, 1].map(|axis| high[axis].max(vertex[axis]))]
            })
        };
        Self(RUNS.map(|length| vertices.chunks(length).map(around).collect()))
    }
}

impl Part<'_> {
    /// The end of the run that starts at a vertex, if all of it lies on one side of a line, and whether that is the left.
    /// A vertex with these coordinates is on the left if `dx * y - dy * x` is above 0, relative to the line's start.
    pub(super) fn passed(self, at: usize, count: usize, line: &Sight) -> Option<(usize, bool)> {
        let Self(Runs(boxes), start) = self;
        let ([x, y, _], [dx, dy, _]) = (line.from, line.way);
        RUNS.iter().zip(boxes).find_map(|(&length, boxes)| {
            if !(start + at).is_multiple_of(length) || at + length > count {
                return None;
            }
            let [low, high] = boxes.get((start + at) / length)?;
            // Rounding keeps the order, so the box has the extremes of the very same expression.
            let [a, b] = [low, high].map(|corner| dx * (corner[1] - y));
            let [c, d] = [low, high].map(|corner| dy * (corner[0] - x));
            let is_left = a.min(b) - c.max(d) > 0.0;
            (is_left || a.max(b) - c.min(d) <= 0.0).then_some((at + length, is_left))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::body::stretches;
    use super::super::tests::Chance;
    use super::*;

    #[test]
    fn a_line_passes_by_runs_and_meets_the_same_sides() {
        let mut chance = Chance(21);
        let mut passed = [0; 2];
        for round in 0..100 {
            // An outline that winds around a circle; some vertices lie on the lines.
            let mut vertices: Vec<Place> = vec![chance.place(10.0); round % 40];
            let start = vertices.len();
            for number in 0..3000 {
                let (sin, cos) = libm::sincos(f64::from(number) / 3000.0 * core::f64::consts::TAU);
                let radius = 4.0 + chance.number(-0.3, 0.3);
                let [x, y] = [cos, sin].map(|part| libm::round(8.0 * (5.0 + radius * part)) / 8.0);
                vertices.push([x, y, 0.0]);
            }
            let runs = Runs::new(&vertices);
            let ends = [(); 2].map(|()| chance.place(10.0).map(libm::round));
            let Some(line) = Sight::new(ends) else { continue };
            let found = |runs: Part| {
                let mut spans = vec![];
                stretches(&vertices[start..], runs, &line, &mut vec![], |span| spans.push(span));
                spans
            };
            assert_eq!(found(Part(&runs, start)), found(Part(Runs::NONE, 0)));
            let all = (0..3000).filter(|at| (start + at).is_multiple_of(RUNS[1]));
            all.for_each(|at| passed[usize::from(Part(&runs, start).passed(at, 3000, &line).is_some())] += 1);
        }
        assert!(passed[1] > 2 * passed[0] && passed[1] > 500, "{passed:?}");
    }
}
