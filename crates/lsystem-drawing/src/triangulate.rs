//! Polygons in space as triangles, by cutting off ears.

use crate::rotation::{Vector, cross, dot, minus, norm};

/// Outlines of more vertices are cut as if they were convex: cutting ears takes the square of their number.
const MOST: usize = 1_000;

/// Vertices looked at while the ears of a polygon are cut: enough for most outlines. What is left then is cut as if it were
/// convex.
const LOOKS: usize = 1 << 19;
/// Vertices looked at in a unit of work.
const LOOKED: usize = 8;

/// A polygon cut up.
#[derive(Clone, Debug, Default)]
pub struct Triangles {
    /// The direction in which it faces, seen from where it goes counter-clockwise (Newell's method); `None` where it has
    /// no area. It has no triangles then.
    pub facing: Option<Vector>,
    /// Its vertices, by number; all go the same way round.
    pub corners: Vec<[usize; 3]>,
    /// The units of work that this has taken: at most half of a piece, and some for each vertex.
    pub work: u64,
}

/// Cuts up a polygon. Exact for outlines in a plane that do not cross themselves.
pub fn triangulate(vertices: &[Vector]) -> Triangles {
    let Some(normal) = facing(vertices) else { return Triangles::default() };
    let turn = |a: usize, b: usize, c: usize| {
        dot(normal, cross(minus(vertices[b], vertices[a]), minus(vertices[c], vertices[b])))
    };
    let mut left: Vec<usize> = (0..vertices.len()).collect();
    let mut triangles = Vec::with_capacity(vertices.len());
    let looks = core::cell::Cell::new(0);
    while left.len() > 3 && vertices.len() <= MOST && looks.get() < LOOKS {
        let count = left.len();
        let corner = |at: usize| [left[(at + count - 1) % count], left[at], left[(at + 1) % count]];
        let is_ear = |&at: &usize| {
            let [a, b, c] = corner(at);
            let inside = |&p: &usize| {
                looks.set(looks.get() + 1);
                ![a, b, c].contains(&p) && turn(a, b, p) > 0.0 && turn(b, c, p) > 0.0 && turn(c, a, p) > 0.0
            };
            turn(a, b, c) > 0.0 && !left.iter().any(inside)
        };
        // Where there is no ear the outline crosses itself or is flat there.
        let at = (0..count).find(is_ear).unwrap_or(0);
        triangles.push(corner(at));
        left.remove(at);
    }
    triangles.extend((2..left.len()).map(|at| [left[0], left[at - 1], left[at]]));
    Triangles { facing: Some(normal), corners: triangles, work: (looks.get() / LOOKED) as u64 }
}

/// The direction in which a polygon faces, as a unit vector; `None` where it has no area.
pub fn facing(vertices: &[Vector]) -> Option<Vector> {
    let next = vertices.iter().cycle().skip(1);
    let sum = vertices.iter().zip(next).fold([0.0; 3], |sum, (&a, &b)| {
        // Counted from the first vertex: far from the origin there is nothing left of the differences.
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
        // A star whose ears are found late: each has many others to look at.
        let comb = |count: usize| -> Vec<Vector> {
            let at = |i: usize| {
                (i as f64 * core::f64::consts::TAU / count as f64, if i.is_multiple_of(2) { 1.0 } else { 0.2 })
            };
            (0..count).map(at).map(|(angle, far)| [far * libm::cos(angle), far * libm::sin(angle), 0.0]).collect()
        };
        for count in [10, 100, 999, 1000] {
            let triangles = triangulate(&comb(count));
            assert!(triangles.work <= lsystem_syntax::Meter::PIECE / 2 + count as u64, "{}", triangles.work);
            assert_eq!(triangles.corners.len(), count - 2);
        }
    }

    #[test]
    fn the_work_of_cutting_is_told() {
        let round: Vec<Vector> = (0..1000)
            .map(|i| f64::from(i) * core::f64::consts::TAU / 1000.0)
            .map(|angle| [libm::cos(angle), libm::sin(angle), 0.0])
            .collect();
        // Every ear has all vertices that are left to look at.
        assert!(triangulate(&round).work >= 1000 * 999 / 2 / 8 - 1000);
    }
}
