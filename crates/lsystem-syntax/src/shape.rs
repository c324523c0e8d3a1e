//! Shapes that plants grow in or around: solids made of balls, boxes, cylinders, cones, half-spaces, outlines and
//! meshes, and of their unions, differences and intersections.
//!
//! A shape is asked for its signed distance: how far a point is outside, or, negative, how far it is inside. For a
//! single solid the distance is exact. For a union outside, and for an intersection or a difference inside, it is exact
//! too; elsewhere it is a lower bound of the absolute value.

use core::fmt;
use lsystem_base::number::number;

/// A shape in the coordinates of the model, in model units: x to the right, y up, z towards the viewer.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// `ball(x, y, z, r)`: a ball with this centre and radius.
    Ball([f64; 4]),
    /// `box(x0, y0, z0, x1, y1, z1)`: a box between two corners.
    Block([f64; 6]),
    /// `cylinder(x0, y0, z0, x1, y1, z1, r)`: a cylinder between the centres of its ends.
    Cylinder([f64; 7]),
    /// `cone(x0, y0, z0, x1, y1, z1, r)`: a cone with the radius at its first end, and its tip at the second.
    Cone([f64; 7]),
    /// `half(x, y, z, a, b, c)`: the half-space behind a plane through a point; (a, b, c) points out of the shape.
    Half([f64; 6]),
    /// `outline(x0, y0, x1, y1, …)`: what is inside a polygon in the plane, at any z. Its sides may cross: a point is
    /// inside if the polygon winds around it.
    Outline(Vec<[f64; 2]>),
    /// `mesh(x, y, z, x, y, z, x, y, z, …)`: what is inside a closed mesh of triangles, three corners each. A point is
    /// inside if the mesh winds around it, from whichever side its triangles are seen.
    Mesh(Vec<[[f64; 3]; 3]>),
    /// `a + b`: what is in either.
    Union(Box<Self>, Box<Self>),
    /// `a - b`: what is in the first and not in the second.
    Difference(Box<Self>, Box<Self>),
    /// `a & b`: what is in both.
    Intersection(Box<Self>, Box<Self>),
}

/// The solids by name: how many numbers each has; `None` for lists, an even number of 6 or more for an outline, and 9 for
/// each triangle of a mesh.
pub(crate) const SOLIDS: [(&str, Option<usize>); 7] = [
    ("ball", Some(4)),
    ("box", Some(6)),
    ("cylinder", Some(7)),
    ("cone", Some(7)),
    ("half", Some(6)),
    ("outline", None),
    ("mesh", None),
];

/// The most triangles of a mesh, and the most corners of an outline: each distance looks at all of them.
pub const MAX_SIDES: usize = 2000;

type Point = [f64; 3];

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn length(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// The signed distance in the plane from a rectangle or a similar shape, given the signed distances from its sides
/// across and along: positive ones are outside.
fn corner(across: f64, along: f64) -> f64 {
    let outside = [across.max(0.0), along.max(0.0)];
    (outside[0] * outside[0] + outside[1] * outside[1]).sqrt() + across.max(along).min(0.0)
}

impl Shape {
    /// The solid of this name with these numbers; `None` if there is no such solid, or the numbers do not fit.
    pub(crate) fn solid(name: &str, numbers: &[f64]) -> Option<Self> {
        Some(match name {
            "ball" => Self::Ball(numbers.try_into().ok()?),
            "box" => Self::Block(numbers.try_into().ok()?),
            "cylinder" => Self::Cylinder(numbers.try_into().ok()?),
            "cone" => Self::Cone(numbers.try_into().ok()?),
            "half" => Self::Half(numbers.try_into().ok()?),
            "outline" => {
                let (corners, rest) = numbers.as_chunks::<2>();
                let fits = (3..=MAX_SIDES).contains(&corners.len()) && rest.is_empty();
                fits.then(|| Self::Outline(corners.to_vec()))?
            }
            "mesh" => {
                let (corners, rest) = numbers.as_chunks::<3>();
                let (triangles, odd) = corners.as_chunks::<3>();
                let fits = (4..=MAX_SIDES).contains(&triangles.len()) && rest.is_empty() && odd.is_empty();
                fits.then(|| Self::Mesh(triangles.to_vec()))?
            }
            _ => return None,
        })
    }

    /// The signed distance of a point: positive outside, negative inside.
    #[must_use]
    pub fn distance(&self, at: Point) -> f64 {
        match self {
            &Self::Ball([x, y, z, r]) => length(minus(at, [x, y, z])) - r,
            Self::Block(ends) => {
                let beside = [0, 1, 2].map(|i| {
                    let (low, high) = (ends[i].min(ends[i + 3]), ends[i].max(ends[i + 3]));
                    (low - at[i]).max(at[i] - high)
                });
                length(beside.map(|d| d.max(0.0))) + beside[0].max(beside[1]).max(beside[2]).min(0.0)
            }
            &Self::Cylinder([x0, y0, z0, x1, y1, z1, r]) => {
                let (along, aside, height) = about([x0, y0, z0], [x1, y1, z1], at);
                corner(aside - r, (-along).max(along - height))
            }
            &Self::Cone([x0, y0, z0, x1, y1, z1, r]) => {
                let (along, aside, height) = about([x0, y0, z0], [x1, y1, z1], at);
                cone([aside, along], height, r.max(0.0))
            }
            &Self::Half([x, y, z, a, b, c]) => {
                let size = length([a, b, c]);
                if size > 0.0 { dot(minus(at, [x, y, z]), [a, b, c]) / size } else { f64::INFINITY }
            }
            Self::Outline(corners) => outline(corners, [at[0], at[1]]),
            Self::Mesh(triangles) => mesh(triangles, at),
            Self::Union(a, b) => a.distance(at).min(b.distance(at)),
            Self::Difference(a, b) => a.distance(at).max(-b.distance(at)),
            Self::Intersection(a, b) => a.distance(at).max(b.distance(at)),
        }
    }

    /// Whether a point is inside, or on the surface.
    #[must_use]
    pub fn contains(&self, at: Point) -> bool {
        self.distance(at) <= 0.0
    }

    /// The units of work of a distance: 1 for each solid, 1 for each side of an outline, and 4 for each triangle.
    #[must_use]
    pub fn work(&self) -> u64 {
        match self {
            Self::Outline(corners) => corners.len() as u64,
            Self::Mesh(triangles) => 4 * triangles.len() as u64,
            Self::Union(a, b) | Self::Difference(a, b) | Self::Intersection(a, b) => 1 + a.work() + b.work(),
            _ => 1,
        }
    }
}

/// A point relative to an axis: how far it is along, how far aside, and the length of the axis.
fn about(from: Point, to: Point, at: Point) -> (f64, f64, f64) {
    let (way, off) = (minus(to, from), minus(at, from));
    let height = length(way);
    if height <= 0.0 {
        return (0.0, length(off), 0.0);
    }
    let along = dot(off, way) / height;
    (along, (dot(off, off) - along * along).max(0.0).sqrt(), height)
}

/// The signed distance from a cone that stands on the origin, of a point `[aside, along]`.
fn cone([aside, along]: [f64; 2], height: f64, r: f64) -> f64 {
    // In the half plane of the axis the cone is a triangle: the nearest of its base and its slope.
    let on = |from: [f64; 2], to: [f64; 2]| {
        let way = [to[0] - from[0], to[1] - from[1]];
        let square = way[0] * way[0] + way[1] * way[1];
        let part = if square > 0.0 {
            (((aside - from[0]) * way[0] + (along - from[1]) * way[1]) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let off = [aside - from[0] - part * way[0], along - from[1] - part * way[1]];
        (off[0] * off[0] + off[1] * off[1]).sqrt()
    };
    let near = on([0.0, 0.0], [r, 0.0]).min(on([r, 0.0], [0.0, height]));
    let inside = along >= 0.0 && along <= height && aside * height <= r * (height - along);
    if inside { -near } else { near }
}

/// The signed distance from a polygon in the plane.
fn outline(corners: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let (mut near, mut winding) = (f64::INFINITY, 0_i32);
    for (at, a) in corners.iter().enumerate() {
        let b = corners[(at + 1) % corners.len()];
        let way = [b[0] - a[0], b[1] - a[1]];
        let square = way[0] * way[0] + way[1] * way[1];
        let part =
            if square > 0.0 { (((x - a[0]) * way[0] + (y - a[1]) * way[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
        let off = [x - a[0] - part * way[0], y - a[1] - part * way[1]];
        near = near.min(off[0] * off[0] + off[1] * off[1]);
        let turn = i32::from(a[1] <= y) - i32::from(b[1] <= y);
        if turn != 0 && a[0] + (y - a[1]) / way[1] * way[0] > x {
            winding += turn;
        }
    }
    if winding != 0 { -near.sqrt() } else { near.sqrt() }
}

/// The vector product.
fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The signed distance from a mesh of triangles: that of the nearest triangle, and the winding number as the sum of the
/// solid angles of all triangles (Van Oosterom and Strackee 1983; Jacobson et al. 2013).
fn mesh(triangles: &[[Point; 3]], at: Point) -> f64 {
    let (mut near, mut angles) = (f64::INFINITY, 0.0);
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| minus(corner, at));
        near = near.min(from_triangle([a, b, c]));
        let [u, v, w] = [a, b, c].map(length);
        angles += libm::atan2(dot(a, cross(b, c)), u * v * w + dot(a, b) * w + dot(b, c) * u + dot(c, a) * v);
    }
    // The sum is half of all angles, so a full turn of 4 pi is 2 pi here; half a turn decides.
    if angles.abs() > core::f64::consts::PI { -near.sqrt() } else { near.sqrt() }
}

/// The square of the distance of the origin from a triangle.
fn from_triangle([a, b, c]: [Point; 3]) -> f64 {
    let normal = cross(minus(b, a), minus(c, a));
    let square = dot(normal, normal);
    let sides = [(a, b), (b, c), (c, a)];
    if square > 0.0 && sides.iter().all(|&(from, to)| dot(cross(minus(to, from), normal), from) >= 0.0) {
        let off = dot(normal, a);
        return off * off / square;
    }
    let from_side = |(from, to): (Point, Point)| {
        let way = minus(to, from);
        let size = dot(way, way);
        let part = if size > 0.0 { (-dot(from, way) / size).clamp(0.0, 1.0) } else { 0.0 };
        let off = [0, 1, 2].map(|i| from[i] + part * way[i]);
        dot(off, off)
    };
    sides.map(from_side).into_iter().fold(f64::INFINITY, f64::min)
}

impl Shape {
    /// Prints the shape, in parentheses if it is not a single solid and `inner`.
    fn write(&self, f: &mut fmt::Formatter<'_>, inner: bool) -> fmt::Result {
        let solid = |f: &mut fmt::Formatter<'_>, name: &str, numbers: &[f64]| {
            let numbers: Vec<String> = numbers.iter().map(|&value| number(value)).collect();
            write!(f, "{name}({})", numbers.join(", "))
        };
        let (sign, a, b) = match self {
            Self::Ball(numbers) => return solid(f, "ball", numbers),
            Self::Block(numbers) => return solid(f, "box", numbers),
            Self::Cylinder(numbers) => return solid(f, "cylinder", numbers),
            Self::Cone(numbers) => return solid(f, "cone", numbers),
            Self::Half(numbers) => return solid(f, "half", numbers),
            Self::Outline(corners) => return solid(f, "outline", corners.as_flattened()),
            Self::Mesh(triangles) => return solid(f, "mesh", triangles.as_flattened().as_flattened()),
            Self::Union(a, b) => ('+', a, b),
            Self::Difference(a, b) => ('-', a, b),
            Self::Intersection(a, b) => ('&', a, b),
        };
        if inner {
            f.write_str("(")?;
        }
        // All three signs bind equally, from left to right.
        a.write(f, false)?;
        write!(f, " {sign} ")?;
        b.write(f, true)?;
        if inner { f.write_str(")") } else { Ok(()) }
    }
}

impl fmt::Display for Shape {
    /// Prints the shape in the notation.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, false)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distance by a search: the least distance from points on a grid on the other side of the surface.
    fn searched(shape: &Shape, at: Point) -> f64 {
        let inside = shape.contains(at);
        let mut least = f64::INFINITY;
        let steps = |from: f64, to: f64| (0..=60).map(move |i| from + f64::from(i) * (to - from) / 60.0);
        for x in steps(-3.0, 3.0) {
            for y in steps(-3.0, 3.0) {
                for z in steps(-3.0, 3.0) {
                    if shape.contains([x, y, z]) != inside {
                        least = least.min(length(minus([x, y, z], at)));
                    }
                }
            }
        }
        if inside { -least } else { least }
    }

    #[test]
    fn distances_are_those_of_a_search() {
        let shapes = [
            Shape::Ball([0.2, -0.1, 0.3, 1.1]),
            Shape::Block([1.0, -1.0, 0.5, -0.5, 1.2, -0.9]),
            Shape::Cylinder([0.0, -1.0, 0.2, 0.5, 1.0, 0.0, 0.8]),
            Shape::Cone([0.0, -1.0, 0.0, 0.3, 1.5, 0.2, 1.0]),
            Shape::Half([0.1, 0.2, 0.0, 1.0, 2.0, -0.5]),
            Shape::Outline(vec![[-1.0, -1.0], [1.5, -0.5], [0.0, 0.0], [0.5, 1.5]]),
        ];
        let points = [[0.0, 0.1, 0.2], [1.6, 0.4, -0.3], [-0.4, 1.9, 0.7], [0.3, -0.6, 0.1], [-1.2, -1.3, -1.0]];
        for shape in &shapes {
            for at in points {
                let (own, found) = (shape.distance(at), searched(shape, at));
                assert!((own - found).abs() < 0.16, "{shape} at {at:?}: {own}, searched {found}");
            }
        }
    }

    #[test]
    fn combinations_contain_what_they_say() {
        let (a, b) = (Shape::Ball([0.0, 0.0, 0.0, 1.0]), Shape::Block([0.0, -1.0, -1.0, 2.0, 1.0, 1.0]));
        let of = |make: fn(Box<Shape>, Box<Shape>) -> Shape| make(Box::new(a.clone()), Box::new(b.clone()));
        let all = [of(Shape::Union), of(Shape::Difference), of(Shape::Intersection)];
        for at in [[-0.5, 0.0, 0.0], [0.5, 0.0, 0.0], [1.5, 0.0, 0.0], [-1.5, 0.0, 0.0]] {
            let [p, q] = [a.contains(at), b.contains(at)];
            assert_eq!(all.each_ref().map(|shape| shape.contains(at)), [p || q, p && !q, p && q], "{at:?}");
        }
    }

    /// The two triangles of a square.
    fn square([a, b, c, d]: [Point; 4]) -> [[Point; 3]; 2] {
        [[a, b, c], [a, c, d]]
    }

    /// A block as a mesh.
    fn block([x0, y0, z0, x1, y1, z1]: [f64; 6]) -> Vec<[Point; 3]> {
        let at = |i: usize| [[x0, x1][i & 1], [y0, y1][i >> 1 & 1], [z0, z1][i >> 2 & 1]];
        let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        sides.iter().flat_map(|corners| square(corners.map(at))).collect()
    }

    #[test]
    fn a_mesh_of_a_block_is_the_block() {
        let numbers = [-1.0, 0.0, -2.0, 2.0, 3.0, 1.0];
        let (own, mesh) = (Shape::Block(numbers), Shape::Mesh(block(numbers)));
        let turned = Shape::Mesh(block(numbers).into_iter().map(|[a, b, c]| [a, c, b]).collect());
        for i in 0..4_000 {
            let part = |by: f64| (f64::from(i) * by).fract() * 9.0 - 4.0;
            let at = [part(0.618_033_988_7), part(0.754_877_666_2), part(0.569_840_290_9)];
            for mesh in [&mesh, &turned] {
                assert!((own.distance(at) - mesh.distance(at)).abs() < 1e-9, "{at:?}");
            }
        }
    }

    #[test]
    fn a_mesh_with_a_dent_is_that_of_rays_and_samples() {
        // A block whose upper side is a funnel down to near its lower side.
        let mut triangles = block([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0]);
        triangles.retain(|triangle| triangle.iter().any(|corner| corner[1] < 0.0));
        let rim = [[-1.0, 1.0, -1.0], [-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0]];
        triangles.extend((0..4).map(|at| [rim[at], rim[(at + 1) % 4], [0.1, -0.8, 0.0]]));
        let mesh = Shape::Mesh(triangles.clone());
        // Moller and Trumbore 1997: whether a ray meets a triangle.
        let meets = |at: Point, way: Point, [a, b, c]: &[Point; 3]| {
            let (u, v, off) = (minus(*b, *a), minus(*c, *a), minus(at, *a));
            let (p, q) = (cross(way, v), cross(off, u));
            let [s, t, far] = [dot(off, p), dot(way, q), dot(v, q)].map(|value| value / dot(u, p));
            s >= 0.0 && t >= 0.0 && s + t <= 1.0 && far > 0.0
        };
        for i in 0..400 {
            let part = |by: f64| (f64::from(i) * by).fract() * 3.0 - 1.5;
            let at = [part(0.618_033_988_7), part(0.754_877_666_2), part(0.569_840_290_9)];
            let way = [part(0.414_213_562), part(0.732_050_807), part(0.236_067_977)];
            let crossings = triangles.iter().filter(|triangle| meets(at, way, triangle)).count();
            assert_eq!(mesh.contains(at), crossings % 2 == 1, "{at:?} {way:?}");
            let samples = (0..=60).flat_map(|s| (0..=60 - s).map(move |t| [f64::from(s) / 60.0, f64::from(t) / 60.0]));
            let near = triangles.iter().flat_map(|[a, b, c]| {
                samples
                    .clone()
                    .map(|[s, t]| length([0, 1, 2].map(|i| a[i] * (1.0 - s - t) + b[i] * s + c[i] * t - at[i])))
            });
            let near = near.fold(f64::INFINITY, f64::min);
            let own = mesh.distance(at).abs();
            assert!(own <= near + 1e-12 && near - own < 0.06, "{at:?}: {own}, sampled {near}");
        }
    }
}
