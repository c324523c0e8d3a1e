//! Convex hulls in the plane. Simplification moves edges only outwards, so that a hull contains all its points.
//!
//! Coordinates are in block units, of the order of 1, so tolerances are absolute.

use lsystem_syntax::Heading;

/// Points are snapped to multiples of this before the hull is taken. The orientation of three points is then exact, and
/// rounding cannot separate points that coincide or lie on a line.
const GRID: f64 = 1.0 / (1_u64 << 48) as f64;
/// The most by which one pass of pruning moves the edges of a hull with at most [`MAX`] corners outwards.
const TOLERANCE: f64 = 1e-13;
/// The most corners of a hull. More corners are pruned with a growing tolerance.
const MAX: usize = 64;
/// With more corners than this the tolerance grows faster, so that few passes handle all of them.
const MANY: usize = 4096;

type Point = [f64; 2];
type Cell = [i64; 2];

/// Replaces `points`, with coordinates from -1 to 1, by the corners of their convex hull, counter-clockwise. One corner
/// remains of points that coincide, two of points on a line. The hull may be smaller than the exact one by half of
/// 2^-48. Returns the most by which the hull may be larger, and the units of work spent.
pub fn hull(points: &mut Vec<Point>) -> (f64, u64) {
    let all = points.len() as u64;
    if points.len() > 48 {
        drop_inner(points);
    }
    // Sorting takes most of the time.
    let sorted = 2 * points.len() as u64;
    snap(points);
    let (slack, pruned) = prune(points);
    (slack, all + sorted + pruned)
}

/// Replaces `points` by the corners of their hull on the grid.
fn snap(points: &mut Vec<Point>) {
    let mut cells: Vec<Cell> = points.iter().map(|p| p.map(|c| libm::round(c / GRID) as i64)).collect();
    cells.sort_unstable();
    cells.dedup();
    if cells.len() > 2 {
        let mut corners = half(cells.iter());
        corners.pop();
        corners.extend(half(cells.iter().rev()));
        corners.pop();
        cells = corners;
    }
    points.clear();
    points.extend(cells.iter().map(|cell| cell.map(|c| c as f64 * GRID)));
}

/// One half of the monotone chain (Andrew, 1979), both ends included.
fn half<'a>(cells: impl Iterator<Item = &'a Cell>) -> Vec<Cell> {
    let mut chain: Vec<Cell> = Vec::new();
    for &p in cells {
        while let [.., a, b] = chain[..] {
            let side = |i: usize, j: usize| i128::from(b[i] - a[i]) * i128::from(p[j] - a[j]);
            if side(0, 1) > side(1, 0) {
                break;
            }
            chain.pop();
        }
        chain.push(p);
    }
    chain
}

/// Drops points strictly inside the octagon of the extremes in eight directions (Akl and Toussaint, 1978).
fn drop_inner(points: &mut Vec<Point>) {
    const DIRECTIONS: [Point; 8] =
        [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0], [-1.0, -1.0], [0.0, -1.0], [1.0, -1.0]];
    let mut extremes = [points[0]; 8];
    let mut values = DIRECTIONS.map(|d| d[0] * points[0][0] + d[1] * points[0][1]);
    for &p in points.iter() {
        for ((direction, extreme), value) in DIRECTIONS.iter().zip(&mut extremes).zip(&mut values) {
            let reach = direction[0] * p[0] + direction[1] * p[1];
            if reach > *value {
                (*extreme, *value) = (p, reach);
            }
        }
    }
    // An edge between equal extremes has no inside and decides nothing.
    let edges: Vec<(Point, Point)> =
        (0..8).map(|i| (extremes[i], extremes[(i + 1) % 8])).filter(|(a, b)| a != b).collect();
    if edges.len() > 2 {
        points.retain(|&p| edges.iter().any(|&(a, b)| cross(a, b, p) <= 0.0));
    }
}

/// Replaces an edge by the meeting point of its neighbours' lines if that moves the hull outwards by at most the
/// tolerance. The tolerance grows until at most [`MAX`] corners remain. Returns the largest movement and the units of
/// work.
fn prune(corners: &mut Vec<Point>) -> (f64, u64) {
    let (mut tolerance, mut moved, mut work) = (TOLERANCE, 0.0, 0);
    let exact = if corners.len() > MAX { corners.clone() } else { vec![] };
    loop {
        let before = corners.len();
        work += before as u64 / 2;
        prune_once(corners, tolerance);
        if corners.len() < before {
            // Within one pass, an edge is moved at most once.
            moved += tolerance;
        }
        if corners.len() > MAX {
            // Every edge is within this tolerance, so rounding has bent the outline and more passes change nothing.
            if tolerance > 1.0 {
                work += (exact.len() * MAX) as u64 / 4;
                *corners = exact;
                return (cap(corners), work);
            }
            tolerance *= if corners.len() > MANY { 256.0 } else { 4.0 };
        } else if corners.len() == before {
            return (moved, work);
        }
    }
}

/// One pass over all edges, in linear time. The corners before `done` are written; the corners from `next` on are
/// unread.
fn prune_once(corners: &mut Vec<Point>, tolerance: f64) {
    let len = corners.len();
    let (mut done, mut next, mut is_first_gone) = (0, 0, false);
    while next < len && done + (len - next) > 4 {
        let left = done + (len - next);
        let corner = |at: usize| {
            let at = at % left;
            corners[if at < done { at } else { next + at - done }]
        };
        let [a, b, c, d] = [left - 1, 0, 1, 2].map(|ahead| corner(done + ahead));
        match meeting(a, b, c, d, tolerance) {
            Some(p) => {
                corners[done] = p;
                // The new corner's edges are new; the next pass handles them.
                is_first_gone = next + 1 == len;
                next += 2;
            }
            None => {
                corners[done] = b;
                next += 1;
            }
        }
        done += 1;
    }
    while next < len {
        corners[done] = corners[next];
        (done, next) = (done + 1, next + 1);
    }
    corners.truncate(done);
    if is_first_gone {
        corners.remove(0);
    }
}

/// Replaces the hull by the polygon of [`MAX`] sides with equally spaced directions that touch the hull. Returns the
/// most by which that moves the hull outwards.
fn cap(corners: &mut Vec<Point>) -> f64 {
    let sides: Vec<(Point, f64)> = (0..MAX)
        .map(|side| {
            let (c, s) = Heading::from_degrees(360.0 * side as f64 / MAX as f64).cos_sin();
            let reach = corners.iter().map(|[x, y]| c * x + s * y).fold(f64::NEG_INFINITY, f64::max);
            // The margin keeps all corners inside in spite of rounding.
            ([c, s], reach + 4.0 * GRID)
        })
        .collect();
    let next = sides.iter().cycle().skip(1);
    let meet = |(&(a, reach_a), &(b, reach_b)): (&(Point, f64), &(Point, f64))| {
        let turn = a[0] * b[1] - a[1] * b[0];
        [(reach_a * b[1] - reach_b * a[1]) / turn, (a[0] * reach_b - b[0] * reach_a) / turn]
    };
    let mut capped: Vec<Point> = sides.iter().zip(next).map(meet).collect();
    snap(&mut capped);
    let edges = || corners.iter().zip(corners.iter().cycle().skip(1));
    let distance = |p: &Point| edges().map(|(&a, &b)| distance_to_edge(*p, a, b)).fold(f64::INFINITY, f64::min);
    let moved = capped.iter().map(distance).fold(0.0, f64::max);
    *corners = capped;
    moved
}

/// The distance of a point from the edge between `a` and `b`.
fn distance_to_edge(p: Point, a: Point, b: Point) -> f64 {
    let ([u, v], [x, y]) = (minus(b, a), minus(p, a));
    let length = u * u + v * v;
    let along = if length > 0.0 { ((u * x + v * y) / length).clamp(0.0, 1.0) } else { 0.0 };
    let [x, y] = [x - along * u, y - along * v];
    (x * x + y * y).sqrt()
}

/// The meeting point of the lines a-b and d-c beyond the edge b-c, if it is at most `tolerance` outside the edge.
fn meeting(a: Point, b: Point, c: Point, d: Point, tolerance: f64) -> Option<Point> {
    let (u, v, edge) = (minus(b, a), minus(d, c), minus(c, b));
    let turn = u[0] * v[1] - u[1] * v[0];
    // The meeting point lies above the edge only if the outer edges differ by less than a right angle.
    if u[0] * v[0] + u[1] * v[1] <= 0.0 || turn <= 0.0 {
        return None;
    }
    let along = (edge[0] * v[1] - edge[1] * v[0]) / turn;
    let p = [b[0] + along * u[0], b[1] + along * u[1]];
    let length = edge[0] * edge[0] + edge[1] * edge[1];
    let foot = (minus(p, b)[0] * edge[0] + minus(p, b)[1] * edge[1]) / length;
    let outside = -cross(b, c, p);
    (along >= 0.0 && (0.0..=1.0).contains(&foot) && outside * outside <= tolerance * tolerance * length).then_some(p)
}

/// Twice the area of the triangle, positive when counter-clockwise.
fn cross(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn hull_of(points: &[Point]) -> Vec<Point> {
        let mut corners = points.to_vec();
        hull(&mut corners);
        corners
    }

    #[test]
    fn simple_shapes() {
        let square = [[0.0, 0.0], [0.5, 0.5], [0.0, 0.5], [0.5, 0.0], [0.25, 0.25], [0.25, 0.0], [0.0, 0.0]];
        assert_eq!(hull_of(&square), [[0.0, 0.0], [0.5, 0.0], [0.5, 0.5], [0.0, 0.5]]);
        assert_eq!(hull_of(&[[0.5, 0.5]; 3]), [[0.5, 0.5]]);
        assert_eq!(hull_of(&[[0.5, 0.5], [0.25, 0.25], [-0.5, -0.5], [0.0, 0.0]]), [[-0.5, -0.5], [0.5, 0.5]]);
    }

    #[test]
    fn corners_that_rounding_has_cut_meet_again() {
        let corner = |at: usize| {
            let (c, s) = Heading::from_degrees(60.0 * at as f64).cos_sin();
            [c * 0.5, s * 0.5]
        };
        let near = |p: Point, towards: Point| [0, 1].map(|i| p[i] + 1e-13 * (towards[i] - p[i]));
        let cut: Vec<Point> =
            (0..6).flat_map(|at| [at + 5, at + 1].map(|other| near(corner(at), corner(other)))).collect();
        let corners = hull_of(&cut);
        assert_eq!(corners.len(), 6, "{corners:?}");
        contains(&corners, &cut, 1e-13).unwrap();
    }

    #[test]
    fn a_circle_is_capped_from_outside() {
        let circle: Vec<Point> = (0..3600)
            .map(|tenth| {
                let (c, s) = Heading::from_degrees(f64::from(tenth) / 10.0).cos_sin();
                [c * 0.9, s * 0.9]
            })
            .collect();
        let corners = hull_of(&circle);
        assert!(corners.len() <= MAX);
        contains(&corners, &circle, 1e-13).unwrap();
        assert!(corners.iter().all(|[x, y]| (x * x + y * y).sqrt() < 0.905));
    }

    /// With turns of nearly 90, 30 or 60 degrees, corners crowd in a few places, where rounding bends the outline.
    #[test]
    fn crowded_corners_end() {
        for (degrees, count) in [(89.999_999, 8192), (30.000_000_246, 8192), (60.000_000_083, 12_000)] {
            let turn = Heading::from_degrees(degrees);
            let (mut at, mut heading) = ([0.0; 2], Heading::EAST);
            let points: Vec<Point> = (0..count)
                .map(|_| {
                    let (c, s) = heading.cos_sin();
                    heading = heading + turn;
                    at = [at[0] + 0.2 * c, at[1] + 0.2 * s];
                    at
                })
                .collect();
            let mut corners = points.clone();
            let (slack, _) = hull(&mut corners);
            assert!(corners.len() <= MAX && slack < 0.1, "{degrees} {slack}");
            contains(&corners, &points, 1e-13).unwrap();
        }
    }

    #[test]
    fn capping_contains_all() {
        let needle: Vec<Point> = (0..1000).map(|at| [0.0008 * f64::from(at), 0.0001 * f64::from(at % 7)]).collect();
        let mut corners = needle.clone();
        let slack = cap(&mut corners);
        assert!(corners.len() <= MAX && slack < 0.1, "{slack}");
        contains(&corners, &needle, 1e-13).unwrap();
    }

    fn contains(corners: &[Point], points: &[Point], tolerance: f64) -> Result<(), TestCaseError> {
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            let length = ((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1])).sqrt();
            for &p in points {
                prop_assert!(cross(a, b, p) >= -tolerance * length.max(tolerance), "{:?} {:?} {:?}", a, b, p);
            }
        }
        Ok(())
    }

    proptest! {
        #![proptest_config(test_effort::config())]

        #[test]
        fn hulls_contain_and_fit(points in prop::collection::vec((-0.9..0.9, -0.9..0.9), 1..200),
                                 flat in prop_oneof![Just(1.0), Just(0.0), Just(1e-15), Just(1e-9)], turn in 0.0..360.0) {
            // Flattened and rotated: the points are near a line in any direction.
            let (c, s) = Heading::from_degrees(turn).cos_sin();
            let points: Vec<Point> = points.iter().map(|&(x, y)| [c * x - s * y * flat, s * x + c * y * flat])
                .map(|p| p.map(|c| c * 0.7)).collect();
            let mut corners = points.clone();
            let (slack, _) = hull(&mut corners);
            prop_assert!(slack < 1e-11 && corners.len() <= MAX);
            contains(&corners, &points, 1e-14)?;
            // In every direction the hull and the points have the same reach.
            for direction in 0..36 {
                let (c, s) = Heading::from_degrees(f64::from(direction) * 10.0 + turn).cos_sin();
                let reach = |points: &[Point]| points.iter().map(|p| c * p[0] + s * p[1]).fold(f64::MIN, f64::max);
                prop_assert!((reach(&corners) - reach(&points)).abs() <= slack + 1e-14, "{:?}", corners);
            }
        }
    }
}
