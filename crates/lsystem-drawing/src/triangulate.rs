//! Polygons in space as triangles, by cutting off ears.

use crate::rotation::{Vector, cross, dot, minus, norm};

/// The most vertices of an outline whose ears are cut; the time grows with the square of their number. Longer outlines
/// are cut as if they were convex.
const MOST: usize = 1_000;

/// The most vertices tested while the ears of a polygon are cut: enough for most outlines. The rest of the outline is
/// then cut as if it were convex.
const MOST_TESTS: usize = 1 << 19;
/// The vertices tested in a unit of work.
const TESTS_PER_UNIT: usize = 8;

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

/// Cuts a polygon into triangles. Exact for plane outlines that do not cross themselves and are within the limits
/// above.
pub fn triangulate(vertices: &[Vector]) -> Triangles {
    let Some(normal) = facing(vertices) else { return Triangles::default() };
    let turn = |a: usize, b: usize, c: usize| {
        dot(normal, cross(minus(vertices[b], vertices[a]), minus(vertices[c], vertices[b])))
    };
    let mut left: Vec<usize> = (0..vertices.len()).collect();
    let mut triangles = Vec::with_capacity(vertices.len());
    let tests = core::cell::Cell::new(0);
    while left.len() > 3 && vertices.len() <= MOST && tests.get() < MOST_TESTS {
        let count = left.len();
        let corner = |at: usize| [left[(at + count - 1) % count], left[at], left[(at + 1) % count]];
        let is_ear = |&at: &usize| {
            let [a, b, c] = corner(at);
            let inside = |&p: &usize| {
                tests.set(tests.get() + 1);
                ![a, b, c].contains(&p) && turn(a, b, p) > 0.0 && turn(b, c, p) > 0.0 && turn(c, a, p) > 0.0
            };
            turn(a, b, c) > 0.0 && !left.iter().any(inside)
        };
        // An outline without an ear crosses itself or is flat; any corner will do.
        let at = (0..count).find(is_ear).unwrap_or(0);
        triangles.push(corner(at));
        left.remove(at);
    }
    triangles.extend((2..left.len()).map(|at| [left[0], left[at - 1], left[at]]));
    Triangles { facing: Some(normal), corners: triangles, work: (tests.get() / TESTS_PER_UNIT) as u64 }
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

    #[test]
    fn a_polygon_takes_less_than_a_piece() {
        // In a star, ears are found late, after many tests.
        let comb = |count: usize| -> Vec<Vector> {
            let at = |i: usize| {
                (i as f64 * core::f64::consts::TAU / count as f64, if i.is_multiple_of(2) { 1.0 } else { 0.2 })
            };
            (0..count).map(at).map(|(angle, far)| [far * libm::cos(angle), far * libm::sin(angle), 0.0]).collect()
        };
        for count in [10, 100, 999, 1000] {
            let triangles = triangulate(&comb(count));
            assert!(triangles.work <= lsystem_base::Meter::PIECE / 2 + count as u64, "{}", triangles.work);
            assert_eq!(triangles.corners.len(), count - 2);
        }
    }

    #[test]
    fn the_work_of_cutting_is_told() {
        let round: Vec<Vector> = (0..1000)
            .map(|i| f64::from(i) * core::f64::consts::TAU / 1000.0)
            .map(|angle| [libm::cos(angle), libm::sin(angle), 0.0])
            .collect();
        // Every ear is tested against all vertices left.
        assert!(triangulate(&round).work >= 1000 * 999 / 2 / 8 - 1000);
    }
}
