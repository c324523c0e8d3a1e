//! Filled polygons as strokes side by side, so that everything that is seen in space is strokes.

use crate::rotation::{Vector, cross, dot, norm};

/// Strokes across a polygon.
const STROKES: usize = 7;

/// Strokes that cover a polygon along its length, from end to end, and how wide they are; caps apart, which stay inside.
/// What the outline winds around is inside; a polygon is taken for flat.
pub(super) fn hatch(vertices: &[Vector]) -> (Vec<[Vector; 2]>, f64) {
    let origin = vertices.first().copied().unwrap_or_default();
    let from = |point: Vector| [0, 1, 2].map(|i| point[i] - origin[i]);
    // The longest way from the first vertex is along it; the vertex farthest from that way says how it is turned.
    let along = vertices.iter().map(|&v| from(v)).fold([0.0; 3], |a, b| if norm(b) > norm(a) { b } else { a });
    let length = norm(along);
    let u = along.map(|c| c / length);
    let aside = |point: Vector| {
        let way = from(point);
        let part = dot(way, u);
        [0, 1, 2].map(|i| way[i] - part * u[i])
    };
    let off = vertices.iter().map(|&v| aside(v)).fold([0.0; 3], |a, b| if norm(b) > norm(a) { b } else { a });
    let width = norm(off);
    if !(length > 0.0 && width > 1e-9 * length && length.is_finite()) {
        return (vec![], 0.0);
    }
    // At a right angle to `u`, whatever rounding has done.
    let normal = cross(u, off);
    let v = cross(normal, u).map(|c| c / norm(normal));
    let flat: Vec<[f64; 2]> = vertices.iter().map(|&p| [dot(from(p), u), dot(from(p), v)]).collect();
    let low = flat.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
    let high = flat.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
    let wide = (high - low) / STROKES as f64;
    let place = |x: f64, y: f64| [0, 1, 2].map(|i| origin[i] + x * u[i] + y * v[i]);
    let mut strokes = Vec::new();
    for row in 0..STROKES {
        let y = low + (row as f64 + 0.5) * wide;
        let next = flat.iter().cycle().skip(1);
        let crossing = |(a, b): (&[f64; 2], &[f64; 2])| {
            let crosses = (a[1] <= y) != (b[1] <= y);
            crosses.then(|| (a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), if a[1] < b[1] { 1 } else { -1 }))
        };
        let mut crossings: Vec<(f64, i32)> = flat.iter().zip(next).filter_map(crossing).collect();
        crossings.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (mut winding, mut start) = (0, 0.0);
        for (x, way) in crossings {
            if winding == 0 {
                start = x;
            }
            winding += way;
            if winding == 0 {
                let (middle, half) = (0.5 * (start + x), 0.5 * (x - start - wide).max(0.0));
                strokes.push([place(middle - half, y), place(middle + half, y)]);
            }
        }
    }
    (strokes, wide)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_cover_the_area() {
        // A leaf in a plane that leans.
        let tilt = |x: f64, y: f64| [x + 3.0, 0.6 * y, 0.8 * y];
        let leaf = [tilt(0.0, 0.0), tilt(1.0, 0.5), tilt(3.0, 0.5), tilt(4.0, 0.0), tilt(3.0, -0.5), tilt(1.0, -0.5)];
        let (strokes, wide) = hatch(&leaf);
        assert_eq!(strokes.len(), STROKES);
        let covered: f64 = strokes.iter().map(|[a, b]| wide * (norm([0, 1, 2].map(|i| b[i] - a[i])) + wide)).sum();
        assert!((covered - 3.0).abs() < 0.1, "{covered}");
        assert!(hatch(&[[0.0; 3], [1.0; 3], [2.0; 3]]).0.is_empty() && hatch(&[]).0.is_empty());
    }
}
