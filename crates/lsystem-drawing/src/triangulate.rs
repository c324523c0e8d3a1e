//! Polygons in space as triangles, by cutting off ears.

use crate::rotation::{Vector, cross, dot, minus, norm};

/// The most vertices tested while the ears of a polygon are cut: enough for outlines of many thousand vertices. The
/// rest of the outline is then cut as if it were convex. The bound is the reason for own code: libraries search
/// outlines that cross themselves for as long as it takes (the crate `earcut`: 34 ms for 1,000 vertices, 1.7 s for 10,000).
const MAX_TESTS: usize = 1 << 19;
/// The vertices tested in a unit of work.
const TESTS_PER_UNIT: usize = 8;
/// The most cells of a grid along each axis.
const MAX_CELLS: usize = 512;

/// A polygon as triangles.
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    /// The polygon's normal, as [`facing`]; `None`, with no triangles, if the polygon has no area.
    pub facing: Option<Vector>,
    /// The indices of the triangles' vertices; all triangles have the polygon's orientation.
    pub corners: Vec<[usize; 3]>,
    /// The units of work spent: at most half of [`Meter::PIECE`](lsystem_base::Meter::PIECE), plus about one for each
    /// vertex.
    pub work: u64,
}

/// Cuts a polygon into triangles. Exact for plane outlines that do not cross themselves and are within the limit above.
pub fn triangulate(vertices: &[Vector]) -> Triangles {
    let Some(normal) = facing(vertices) else { return Triangles::default() };
    let mut outline = Outline::new(vertices, normal);
    let mut corners = Vec::with_capacity(vertices.len());
    let (mut left, mut first, mut at, mut misses) = (vertices.len(), 0, 0, 0);
    while left > 3 && outline.tests < MAX_TESTS {
        if misses == left {
            // An outline without an ear crosses itself or is flat; any corner will do.
            at = first;
        } else if !outline.is_ear(at) {
            (at, misses) = (outline.around[at][1], misses + 1);
            continue;
        }
        let triangle @ [_, _, after] = outline.cut(at);
        corners.push(triangle);
        (left, misses) = (left - 1, 0);
        if at == first {
            first = after;
        }
        // Leaving out a corner gives better triangles than a fan.
        at = outline.around[after][1];
    }
    let rest: Vec<usize> = core::iter::successors(Some(first), |&at| Some(outline.around[at][1])).take(left).collect();
    corners.extend((2..rest.len()).map(|at| [rest[0], rest[at - 1], rest[at]]));
    Triangles { facing: Some(normal), corners, work: (outline.tests / TESTS_PER_UNIT) as u64 }
}

/// The outline that is left.
struct Outline<'a> {
    vertices: &'a [Vector],
    normal: Vector,
    /// The vertices before and after each vertex; a vertex that is cut off stands between itself.
    around: Vec<[usize; 2]>,
    grid: Grid,
    /// The vertices tested so far.
    tests: usize,
}

impl<'a> Outline<'a> {
    fn new(vertices: &'a [Vector], normal: Vector) -> Self {
        let count = vertices.len();
        let around = (0..count).map(|at| [(at + count - 1) % count, (at + 1) % count]).collect();
        let mut outline = Self { vertices, normal, around, grid: Grid::default(), tests: 0 };
        outline.grid = Grid::new(vertices, normal, |at| outline.is_reflex(at));
        outline
    }

    /// Whether a corner does not turn to the left.
    fn is_reflex(&self, at: usize) -> bool {
        let [before, after] = self.around[at];
        self.turn(before, at, after) <= 0.0
    }

    /// Twice the area of a triangle, positive if it turns to the left.
    fn turn(&self, a: usize, b: usize, c: usize) -> f64 {
        let [a, b, c] = [a, b, c].map(|at| self.vertices[at]);
        dot(self.normal, cross(minus(b, a), minus(c, b)))
    }

    /// Whether the corner turns to the left, and no vertex lies inside its triangle.
    fn is_ear(&mut self, b: usize) -> bool {
        let [a, c] = self.around[b];
        self.tests += 1;
        if self.is_reflex(b) {
            return false;
        }
        let mut tests = 0;
        let is_blocked = self.grid.around([a, b, c]).flatten().any(|&p| {
            tests += 1;
            let is_other = self.around[p][1] != p && ![a, b, c].contains(&p);
            is_other && self.turn(a, b, p) > 0.0 && self.turn(b, c, p) > 0.0 && self.turn(c, a, p) > 0.0
        });
        self.tests += tests;
        !is_blocked
    }

    /// Cuts off a corner, and returns its triangle.
    fn cut(&mut self, at: usize) -> [usize; 3] {
        let [before, after] = self.around[at];
        self.around[before][1] = after;
        self.around[after][0] = before;
        self.around[at] = [at; 2];
        [before, at, after]
    }
}

/// The reflex vertices by their places in the plane of the polygon, so that only those near a triangle are tested. A
/// triangle with any vertex inside has a reflex one inside.
#[derive(Default)]
struct Grid {
    /// The column and the row of each vertex.
    cells: Vec<[usize; 2]>,
    /// The number of columns, and of rows.
    side: usize,
    /// For each cell, row by row, the place of its first vertex in `members`; then the number of members.
    starts: Vec<usize>,
    members: Vec<usize>,
}

impl Grid {
    fn new(vertices: &[Vector], normal: Vector, is_reflex: impl Fn(usize) -> bool) -> Self {
        // Two axes of the plane, of any length.
        let least = (0..3).min_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs())).unwrap_or(0);
        let mut aside = [0.0; 3];
        aside[least] = 1.0;
        let across = cross(normal, aside);
        let axes = [across, cross(normal, across)];
        let places = vertices.iter().map(|&vertex| axes.map(|axis| dot(axis, minus(vertex, vertices[0]))));
        let bounds = places.clone().fold([[f64::INFINITY, f64::NEG_INFINITY]; 2], |bounds, place| {
            [0, 1].map(|axis| [bounds[axis][0].min(place[axis]), bounds[axis][1].max(place[axis])])
        });
        let side = vertices.len().isqrt().clamp(1, MAX_CELLS);
        // Conversion saturates, also of numbers that are not finite, and keeps the order.
        let cell = |value: f64, [low, high]: [f64; 2]| ((value - low) / (high - low) * side as f64) as usize;
        let cells = places.map(|place| [0, 1].map(|axis| cell(place[axis], bounds[axis]).min(side - 1)));
        let cells: Vec<[usize; 2]> = cells.collect();
        let placed = || cells.iter().enumerate().filter(|&(vertex, _)| is_reflex(vertex));
        let mut starts = vec![0; side * side + 1];
        placed().for_each(|(_, &[column, row])| starts[row * side + column + 1] += 1);
        (0..side * side).for_each(|at| starts[at + 1] += starts[at]);
        let (mut next, mut members) = (starts.clone(), vec![0; starts[side * side]]);
        for (vertex, &[column, row]) in placed() {
            let place = &mut next[row * side + column];
            members[*place] = vertex;
            *place += 1;
        }
        Self { cells, side, starts, members }
    }

    /// The reflex vertices in the cells around a triangle, row by row.
    fn around(&self, triangle: [usize; 3]) -> impl Iterator<Item = &[usize]> {
        let [a, b, c] = triangle.map(|corner| self.cells[corner]);
        let [columns, rows] = [0, 1].map(|axis| [a[axis].min(b[axis]).min(c[axis]), a[axis].max(b[axis]).max(c[axis])]);
        (rows[0]..=rows[1]).map(move |row| {
            let [start, end] = [columns[0], columns[1] + 1].map(|column| self.starts[row * self.side + column]);
            &self.members[start..end]
        })
    }
}

/// The unit normal of a polygon (Newell's method): seen against the normal, the outline goes counter-clockwise. `None`
/// if the polygon has no area.
pub fn facing(vertices: &[Vector]) -> Option<Vector> {
    let next = vertices.iter().cycle().skip(1);
    let sum = vertices.iter().zip(next).fold([0.0; 3], |sum, (&a, &b)| {
        // Relative to the first vertex: far from the origin, rounding would destroy the differences.
        let [a, b] = [a, b].map(|v| minus(v, vertices[0]));
        let product = cross(a, b);
        [0, 1, 2].map(|i| sum[i] + product[i])
    });
    let size = norm(sum);
    if !(size > 0.0 && size.is_finite()) {
        return None;
    }
    Some(sum.map(|c| c / size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn the_area_is_kept() {
        let square = [[0.0, 0.0, 5.0], [2.0, 0.0, 5.0], [2.0, 2.0, 5.0], [0.0, 2.0, 5.0]];
        let arrow = [[0.0, 0.0, 0.0], [3.0, 3.0, 3.0], [0.0, 1.0, 0.5], [-3.0, 3.0, 0.0]];
        for outline in [&square, &arrow] {
            let Triangles { facing, corners: triangles, .. } = triangulate(outline);
            let normal = facing.unwrap();
            assert_eq!(triangles.len(), 2);
            let area = |[a, b, c]: [usize; 3]| {
                dot(normal, cross(minus(outline[b], outline[a]), minus(outline[c], outline[a]))) / 2.0
            };
            assert!(triangles.iter().all(|&triangle| area(triangle) > 0.0), "{triangles:?}");
        }
        assert_eq!(triangulate(&square).facing, Some([0.0, 0.0, 1.0]));
        let flat = triangulate(&[[0.0; 3], [1.0; 3], [2.0; 3]]);
        assert!(flat.facing.is_none() && flat.corners.is_empty());
    }

    /// Twice the areas of the triangles, and of the outline.
    fn areas(outline: &[Vector], triangles: &Triangles) -> (Vec<f64>, f64) {
        let normal = triangles.facing.unwrap();
        let area =
            |[a, b, c]: [usize; 3]| dot(normal, cross(minus(outline[b], outline[a]), minus(outline[c], outline[a])));
        let around = outline.iter().zip(outline.iter().cycle().skip(1));
        let whole = around.map(|(&a, &b)| dot(normal, cross(minus(a, outline[0]), minus(b, outline[0])))).sum();
        (triangles.corners.iter().map(|&corners| area(corners)).collect(), whole)
    }

    /// Checks that all triangles have the outline's orientation and together its area, so that none overlap.
    fn check_area(outline: &[Vector]) {
        let triangles = triangulate(outline);
        assert_eq!(triangles.corners.len(), outline.len() - 2);
        let (areas, whole) = areas(outline, &triangles);
        let rounding = whole * 1e-9;
        assert!(areas.iter().all(|&area| area > -rounding), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - whole).abs() <= rounding, "{} {whole}", areas.iter().sum::<f64>());
    }

    /// The Koch island after `n` steps, turned into space.
    fn koch(n: u32) -> Vec<Vector> {
        let mut points: Vec<[f64; 2]> = vec![[0.0, 0.0], [0.5, libm::sqrt(0.75)], [1.0, 0.0]];
        for _ in 0..n {
            let ends: Vec<_> = points.iter().copied().zip(points.iter().copied().cycle().skip(1)).collect();
            points = (ends.into_iter())
                .flat_map(|([x0, y0], [x1, y1])| {
                    let [dx, dy] = [(x1 - x0) / 3.0, (y1 - y0) / 3.0];
                    let (c, s) = (0.5, libm::sqrt(0.75));
                    let tip = [x0 + dx + c * dx - s * dy, y0 + dy + s * dx + c * dy];
                    [[x0, y0], [x0 + dx, y0 + dy], tip, [x0 + 2.0 * dx, y0 + 2.0 * dy]]
                })
                .collect();
        }
        points.into_iter().map(|[x, y]| [x, 0.6 * y, 0.8 * y]).collect()
    }

    #[test]
    fn outlines_of_many_vertices_keep_their_area() {
        for n in 0..=6 {
            check_area(&koch(n));
        }
    }

    proptest! {
        #[test]
        fn outlines_around_a_point_keep_their_area(
            reaches in prop::collection::vec(0.05..1.0, 4..300),
            tilt in 0.0..1.5,
        ) {
            let count = reaches.len() as f64;
            let at = |(i, reach): (usize, f64)| {
                let angle = i as f64 * core::f64::consts::TAU / count;
                let [x, y] = [reach * libm::cos(angle), reach * libm::sin(angle)];
                [x, y * libm::cos(tilt), y * libm::sin(tilt)]
            };
            check_area(&reaches.into_iter().enumerate().map(at).collect::<Vec<_>>());
        }

        #[test]
        fn any_outline_ends_within_a_piece(points in prop::collection::vec(prop::array::uniform3(-1.0..1.0), 3..2000)) {
            let triangles = triangulate(&points);
            prop_assert_eq!(triangles.corners.len(), points.len() - 2);
            prop_assert!(triangles.work <= lsystem_base::Meter::PIECE / 2 + points.len() as u64);
        }
    }

    #[test]
    fn a_polygon_takes_less_than_a_piece() {
        // In a star, ears are found late, after many tests.
        let comb = |count: usize| -> Vec<Vector> {
            let at = |i: usize| {
                (i as f64 * core::f64::consts::TAU / count as f64, if i.is_multiple_of(2) { 1.0 } else { 0.2 })
            };
            (0..count).map(at).map(|(angle, far)| [far * libm::cos(angle), far * libm::sin(angle), 0.0]).collect()
        };
        for count in [10, 100, 1000, 10_000] {
            let triangles = triangulate(&comb(count));
            assert!(triangles.work <= lsystem_base::Meter::PIECE / 2 + count as u64, "{}", triangles.work);
            assert_eq!(triangles.corners.len(), count - 2);
        }
    }

    #[test]
    fn the_work_of_cutting_is_counted() {
        let round: Vec<Vector> = (0..1000)
            .map(|i| f64::from(i) * core::f64::consts::TAU / 1000.0)
            .map(|angle| [libm::cos(angle), libm::sin(angle), 0.0])
            .collect();
        // Every ear is tested.
        assert!(triangulate(&round).work >= 997 / 8);
    }
}
