//! Convex hulls that may only grow.
//!
//! Coordinates are of the order of 1 (block units), so tolerances are absolute.

/// Corners nearer than this to the line of their neighbours are rounding, not shape.
const ROUNDING: f64 = 2e-16;
/// How far pruning may move the hull outwards at a time; small enough for bounds that are exact to 1e-9.
const TOLERANCE: f64 = 1e-13;
/// More corners than this are pruned with a growing tolerance.
const MOST: usize = 192;

type Point = [f64; 2];

/// Replaces `points` by the corners of their convex hull, counter-clockwise, without corners that matter less than
/// rounding. One or two corners remain of points that coincide or lie on a line.
pub(crate) fn hull(points: &mut Vec<Point>) {
    if points.len() > 48 {
        drop_inner(points);
    }
    points.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() > 2 {
        let mut chain: Vec<Point> = Vec::with_capacity(points.len() + 1);
        half(&mut chain, points.iter());
        chain.pop();
        let lower = chain.len();
        let mut upper = Vec::with_capacity(points.len());
        half(&mut upper, points.iter().rev());
        upper.pop();
        debug_assert!(lower > 0);
        chain.append(&mut upper);
        *points = chain;
    }
    prune(points);
}

/// One half of the monotone chain (Andrew, 1979).
fn half<'a>(chain: &mut Vec<Point>, points: impl Iterator<Item = &'a Point>) {
    for &p in points {
        while let [.., a, b] = chain[..] {
            let reach = (p[0] - a[0]).abs() + (p[1] - a[1]).abs();
            if cross(a, b, p) > ROUNDING * reach {
                break;
            }
            chain.pop();
        }
        chain.push(p);
    }
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
    // An edge between equal extremes has no inside; it must not let a point pass nor hold one back.
    let edges: Vec<(Point, Point)> =
        (0..8).map(|i| (extremes[i], extremes[(i + 1) % 8])).filter(|(a, b)| a != b).collect();
    if edges.len() > 2 {
        points.retain(|&p| edges.iter().any(|&(a, b)| cross(a, b, p) <= 0.0));
    }
}

/// Replaces edges by the meeting point of their neighbours' lines where that moves the hull outwards by next to
/// nothing, and by more where there are too many corners.
fn prune(corners: &mut Vec<Point>) {
    let mut tolerance = TOLERANCE;
    loop {
        let before = corners.len();
        prune_once(corners, tolerance);
        if corners.len() > MOST {
            tolerance *= 4.0;
        } else if corners.len() == before {
            break;
        }
    }
}

fn prune_once(corners: &mut Vec<Point>, tolerance: f64) {
    let mut i = 0;
    while corners.len() > 4 && i < corners.len() {
        let n = corners.len();
        let [a, b, c, d] = [n - 1, 0, 1, 2].map(|k| corners[(i + k) % n]);
        match meeting(a, b, c, d, tolerance) {
            Some(p) => {
                corners[i] = p;
                corners.remove((i + 1) % n);
                // The new corner's edges are new as well; they get their turn in the next pass.
                i += 1;
            }
            None => i += 1,
        }
    }
}

/// Where the lines a-b and d-c meet beyond the edge b-c, if that is at most `tolerance` outside.
fn meeting(a: Point, b: Point, c: Point, d: Point, tolerance: f64) -> Option<Point> {
    let (u, v, edge) = (minus(b, a), minus(d, c), minus(c, b));
    let turn = u[0] * v[1] - u[1] * v[0];
    // Only where the three edges bend by less than a right angle does the meeting point lie above the edge.
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
