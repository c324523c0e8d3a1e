//! The wireframes of shapes: lines on their surfaces, as strokes in model units.
//!
//! Each solid has a few curves: a ball three circles, a box its edges, a cylinder and a cone circles and straight lines.
//! In the plane they are where the solid cuts the plane z = 0. The rim where a half-space cuts another solid is a curve
//! too. A part of a curve is drawn if it lies on the surface of the whole shape.

use crate::rotation::{cross, dot, minus, norm};
use lsystem_base::sorted::sort;
use lsystem_syntax::Shape;
use lsystem_syntax::grammar::NamedShape;

type Point = [f64; 3];
type Curve<'a> = &'a dyn Fn(f64) -> Point;

/// The pieces of a curve: a circle of 96 sides is off by 1/1800 of its radius.
const PIECES: u32 = 96;

/// The units of work for the wireframe of a combination, about 20 ms. A shape that takes more has none.
const MAX_WORK: u64 = 1 << 22;

/// The wireframes of shapes: in the plane z = 0, or in space.
pub(crate) fn wireframe(shapes: &[NamedShape], is_solid: bool) -> Vec<[Point; 2]> {
    shapes.iter().flat_map(|named| wires(&named.shape, is_solid)).collect()
}

fn wires(shape: &Shape, is_solid: bool) -> Vec<[Point; 2]> {
    let mut solids = vec![];
    leaves(shape, &mut solids);
    let size = extent(&solids);
    let reach = norm(minus(size[1], size[0]));
    if !reach.is_finite() || reach <= 0.0 {
        return vec![];
    }
    let mut tracer = Tracer { shape, is_single: solids.len() == 1, reach, left: MAX_WORK, wires: vec![] };
    if is_solid {
        solids.iter().for_each(|solid| curves(solid, &mut |curve| tracer.trace(curve, &[])));
        for half in &solids {
            if let Shape::Half([x, y, z, a, b, c]) = **half {
                tracer.cut(&solids, [[x, y, z], [a, b, c]], mean(size));
            }
        }
    } else {
        tracer.cut(&solids, [[0.0; 3], [0.0, 0.0, 1.0]], mean(size));
    }
    if tracer.left == 0 { vec![] } else { tracer.wires }
}

/// The least and the greatest coordinates of the curves of solids.
fn extent(solids: &[&Shape]) -> [Point; 2] {
    let [mut least, mut most] = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for solid in solids {
        curves(solid, &mut |curve| {
            for piece in 0..=PIECES {
                let point = curve(f64::from(piece) / f64::from(PIECES));
                least = [0, 1, 2].map(|i| least[i].min(point[i]));
                most = [0, 1, 2].map(|i| most[i].max(point[i]));
            }
        });
    }
    [least, most]
}

/// The solids that a shape is made of.
fn leaves<'a>(shape: &'a Shape, found: &mut Vec<&'a Shape>) {
    match shape {
        Shape::Union(a, b) | Shape::Difference(a, b) | Shape::Intersection(a, b) => {
            leaves(a, found);
            leaves(b, found);
        }
        _ => found.push(shape),
    }
}

/// Calls `each` with the curves of a solid, as functions of 0 to 1. A half-space has none, and an outline is at z = 0.
fn curves(solid: &Shape, each: &mut dyn FnMut(Curve<'_>)) {
    let line = |from: Point, to: Point, each: &mut dyn FnMut(Curve<'_>)| each(&|t| mix(from, to, t));
    let circle =
        |at: Point, [u, v]: [Point; 2], r: f64, each: &mut dyn FnMut(Curve<'_>)| each(&|t| around(at, [u, v], r, t));
    match solid {
        &Shape::Ball([x, y, z, r]) => {
            for i in 0..3 {
                let axis = |i: usize| [0, 1, 2].map(|j| f64::from(u8::from(i % 3 == j)));
                circle([x, y, z], [axis(i), axis(i + 1)], r, each);
            }
        }
        Shape::Block(ends) => {
            // The edges along each axis, through the corners of the other two.
            for (axis, corner) in (0..3).flat_map(|axis| (0..4).map(move |corner| (axis, corner))) {
                let other = |i: usize| ends[i + 3 * (corner >> ((i + 2 - axis) % 3) & 1)];
                let end = |far: usize| [0, 1, 2].map(|i| if i == axis { ends[i + 3 * far] } else { other(i) });
                line(end(0), end(1), each);
            }
        }
        &(Shape::Cylinder([x0, y0, z0, x1, y1, z1, r]) | Shape::Cone([x0, y0, z0, x1, y1, z1, r])) => {
            let (from, to) = ([x0, y0, z0], [x1, y1, z1]);
            let (across, end) = (plane_of(minus(to, from)), if matches!(solid, Shape::Cone(_)) { 0.0 } else { r });
            circle(from, across, r, each);
            if end > 0.0 {
                circle(to, across, r, each);
            }
            (0..4)
                .map(|at| f64::from(at) / 4.0)
                .for_each(|t| line(around(from, across, r, t), around(to, across, end, t), each));
        }
        Shape::Outline(corners) => {
            for (at, [x, y]) in corners.iter().enumerate() {
                let [a, b] = corners[(at + 1) % corners.len()];
                line([*x, *y, 0.0], [a, b, 0.0], each);
            }
        }
        Shape::Mesh(triangles) => {
            for [a, b, c] in triangles {
                // The neighbour of a closed mesh has the same edge the other way round.
                for (from, to) in [(a, b), (b, c), (c, a)].into_iter().filter(|(from, to)| from < to) {
                    line(*from, *to, each);
                }
            }
        }
        _ => {}
    }
}

struct Tracer<'a> {
    shape: &'a Shape,
    /// Whether the shape is a single solid, so that all of its curves lie on the surface.
    is_single: bool,
    /// The diagonal of a box around all curves.
    reach: f64,
    /// The units of work that are left.
    left: u64,
    wires: Vec<[Point; 2]>,
}

impl Tracer<'_> {
    /// Adds the parts of a curve that lie on the surface of the shape, with `knots` from 0 to 1 among the ends of strokes.
    fn trace(&mut self, curve: Curve<'_>, knots: &[f64]) {
        // The bits of numbers that are not negative have the order of the numbers.
        let even = (0..=PIECES).map(|at| f64::from(at) / f64::from(PIECES));
        let mut all: Vec<u64> = even.chain(knots.iter().copied()).map(f64::to_bits).collect();
        sort(&mut all);
        let mut before: Option<(f64, bool)> = None;
        for t in all.into_iter().map(f64::from_bits) {
            let is_on = self.is_on(curve(t));
            if let Some((from, was_on)) = before {
                let mut ends = [from, t];
                if was_on != is_on {
                    let (mut on, mut off) = if is_on { (t, from) } else { (from, t) };
                    for _ in 0..30 {
                        let middle = 0.5 * (on + off);
                        *(if self.is_on(curve(middle)) { &mut on } else { &mut off }) = middle;
                    }
                    ends[usize::from(was_on)] = on;
                }
                if was_on || is_on {
                    self.stroke(ends.map(curve));
                }
            }
            before = Some((t, is_on));
        }
    }

    fn is_on(&mut self, at: Point) -> bool {
        if self.is_single {
            return true;
        }
        self.left = self.left.saturating_sub(self.shape.work());
        self.left > 0 && self.shape.distance(at).abs() <= 1e-7 * self.reach
    }

    /// Adds a stroke, or goes on with the last one if it is straight. Curves of solids beyond the range of numbers have none.
    fn stroke(&mut self, [from, to]: [Point; 2]) {
        if ![from, to].as_flattened().iter().all(|value| value.is_finite()) {
            return;
        }
        if let Some([start, end]) = self.wires.last_mut()
            && *end == from
        {
            let (before, way) = (minus(from, *start), minus(to, from));
            let along = dot(before, way);
            if along > 0.0 && along * along >= (1.0 - 1e-12) * dot(before, before) * dot(way, way) {
                *end = to;
                return;
            }
        }
        if from != to {
            self.wires.push([from, to]);
        }
    }

    /// Adds the curves in which a plane, a point and a direction across, cuts solids.
    fn cut(&mut self, solids: &[&Shape], [at, across]: [Point; 2], centre: Point) {
        let height = |point: Point| dot(minus(point, at), across);
        for solid in solids {
            match solid {
                &&Shape::Half([x, y, z, a, b, c]) => {
                    let way = cross(across, [a, b, c]);
                    // Two planes meet in a line; parallel ones do not.
                    if dot(way, way) <= 1e-18 * dot(across, across) * dot([a, b, c], [a, b, c]) {
                        continue;
                    }
                    let own = dot(minus([x, y, z], centre), [a, b, c]);
                    let foot = times(
                        plus(times(cross([a, b, c], way), -height(centre)), times(cross(way, across), own)),
                        1.0 / dot(way, way),
                    );
                    let (middle, half) = (plus(centre, foot), times(way, 0.5 * self.reach / norm(way)));
                    self.trace(&|t| plus(middle, times(half, 2.0 * t - 1.0)), &[]);
                }
                Shape::Outline(_) if across[2] == 0.0 => {}
                Shape::Outline(_) => curves(solid, &mut |side| {
                    let lifted = |[x, y, _]: Point| [x, y, -height([x, y, 0.0]) / across[2]];
                    self.trace(&|t| lifted(side(t)), &[]);
                }),
                Shape::Mesh(triangles) => {
                    for triangle in triangles {
                        let heights = triangle.map(height);
                        let ends: Vec<Point> = [(0, 1), (1, 2), (2, 0)]
                            .into_iter()
                            .filter(|&(i, j)| (heights[i] > 0.0) != (heights[j] > 0.0))
                            .map(|(i, j)| mix(triangle[i], triangle[j], heights[i] / (heights[i] - heights[j])))
                            .collect();
                        if let &[from, to] = &*ends {
                            self.trace(&|t| mix(from, to, t), &[]);
                        }
                    }
                }
                _ => self.cut_convex(solid, [at, across]),
            }
        }
    }

    /// The curve in which a plane cuts a convex solid: the last points inside of it on rays from one inside.
    fn cut_convex(&mut self, solid: &Shape, [at, across]: [Point; 2]) {
        let height = |point: Point| dot(minus(point, at), across);
        // Where the solid's own curves cross the plane, the section has its corners.
        let mut crossings: Vec<Point> = vec![];
        curves(solid, &mut |curve| {
            for piece in 0..PIECES {
                let [mut low, mut high] = [piece, piece + 1].map(|t| f64::from(t) / f64::from(PIECES));
                let is_above = height(curve(low)) > 0.0;
                if is_above != (height(curve(high)) > 0.0) {
                    for _ in 0..40 {
                        let middle = 0.5 * (low + high);
                        *(if (height(curve(middle)) > 0.0) == is_above { &mut low } else { &mut high }) = middle;
                    }
                    crossings.push(curve(low));
                }
            }
        });
        let inner = match solid {
            &Shape::Ball([x, y, z, _]) => plus([x, y, z], times(across, -height([x, y, z]) / dot(across, across))),
            _ => times(crossings.iter().copied().fold([0.0; 3], plus), 1.0 / crossings.len() as f64),
        };
        // A plane that crosses no curve of a solid passes it by.
        let inside = solid.distance(inner);
        if inner[0].is_nan() || inside >= 0.0 || inside.is_nan() {
            return;
        }
        let [u, v] = plane_of(across);
        let turn = |point: Point| {
            let off = minus(point, inner);
            let angle = libm::atan2(dot(off, v), dot(off, u)) / core::f64::consts::TAU;
            if angle < 0.0 { angle + 1.0 } else { angle }
        };
        let knots: Vec<f64> = crossings.into_iter().map(turn).collect();
        let reach = self.reach;
        self.trace(
            &|t| {
                let (mut near, mut far) = (0.0, 2.0 * reach);
                for _ in 0..50 {
                    let middle = 0.5 * (near + far);
                    *(if solid.contains(around(inner, [u, v], middle, t)) { &mut near } else { &mut far }) = middle;
                }
                around(inner, [u, v], near, t)
            },
            &knots,
        );
    }
}

/// The point of a circle after the part `t` of a turn.
fn around(at: Point, [u, v]: [Point; 2], r: f64, t: f64) -> Point {
    let (sin, cos) = libm::sincos(t * core::f64::consts::TAU);
    plus(at, plus(times(u, r * cos), times(v, r * sin)))
}

/// Two unit vectors across a direction and each other.
fn plane_of(way: Point) -> [Point; 2] {
    let least = [0, 1, 2].into_iter().min_by(|&i, &j| way[i].abs().total_cmp(&way[j].abs())).unwrap_or(0);
    let u = cross(way, [0, 1, 2].map(|i| f64::from(u8::from(i == least))));
    let v = cross(way, u);
    [u, v].map(|side| times(side, 1.0 / norm(side)))
}

fn plus(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|i| a[i] + b[i])
}

fn times(a: Point, by: f64) -> Point {
    a.map(|c| c * by)
}

fn mix(a: Point, b: Point, t: f64) -> Point {
    [0, 1, 2].map(|i| a[i] * (1.0 - t) + b[i] * t)
}

fn mean([a, b]: [Point; 2]) -> Point {
    mix(a, b, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_syntax::{Definition, notation};

    fn shape(text: &str) -> NamedShape {
        let reading = notation::read("A", &format!("shape s = {text}\nA -> A(inside(s, 0, 0, 0))"));
        reading.grammar.shapes.into_iter().next().unwrap_or_else(|| panic!("{text}"))
    }

    /// The distance of a point from the nearest wire.
    fn from_wires(wires: &[[Point; 2]], at: Point) -> f64 {
        let from = |[a, b]: &[Point; 2]| {
            let way = minus(*b, *a);
            let part = (dot(minus(at, *a), way) / dot(way, way)).clamp(0.0, 1.0);
            norm(minus(at, mix(*a, *b, part)))
        };
        wires.iter().map(from).fold(f64::INFINITY, f64::min)
    }

    const SHAPES: [&str; 8] = [
        "ball(0, 0, 0, 9) - half(0, 3, 0, 0.1, 1, 0.2)",
        "cone(1, 0, 0, 2, 9, 1, 5) & half(1, 4, 0, 1, 1, 0)",
        "cylinder(0, -5, 0.5, 1, 5, 0, 4) & half(0, 0, 0, 1, 0, 0.3) & half(0, 1, 0, 0, 0.2, 1)",
        "box(-12, 0, -2.5, 12, 13, 2.5) - cylinder(0, 4, -4, 0, 4, 4, 5) - box(-5, -1, -4, 5, 4, 4)",
        "outline(-3, 0, 10, 2, 4, 6, 5, 10) - ball(2, 4, 0, 2)",
        "outline(0, 0, 4, 0, 4, 4) & half(0, 0, 1, 0, 0.3, 1)",
        "mesh(0,0,0, 0,4,0, 4,0,0, 0,0,0, 4,0,0, 0,0,4, 0,0,0, 0,0,4, 0,4,0, 4,0,0, 0,4,0, 0,0,4) - half(1, 1, 1, 1, 0, 0)",
        "ball(0, 0, 0, 3) + ball(2, 1, 1, 3)",
    ];

    #[test]
    fn wires_are_numbers() {
        let outline = "(outline(0, 1e-9, 3.5, 3.5, 3.5, 3.5) & half(1e300, 1e-9, 1e300, 1e300, 3.5, 10))";
        for text in [
            &format!("{outline} - half(3.5, 1e300, 1e300, -2, -2, 1e-9)"),
            "ball(0, 0, 0, 1) & half(0, 0, 0, 1e300, 1, 1e300)",
        ] {
            for is_solid in [false, true] {
                let wires = wires(&shape(text).shape, is_solid);
                assert!(wires.iter().flatten().flatten().all(|value| value.is_finite()), "{text}: {wires:?}");
            }
        }
    }

    #[test]
    fn wires_lie_on_the_surface() {
        for text in SHAPES {
            let named = shape(text);
            for is_solid in [false, true] {
                let wires = wires(&named.shape, is_solid);
                assert!(wires.len() > 2, "{text}: {}", wires.len());
                for [from, to] in wires {
                    for end in [from, to] {
                        assert!(named.shape.distance(end).abs() < 1e-5, "{text} {is_solid}: {end:?}");
                        assert!(is_solid || end[2].abs() < 1e-9);
                    }
                    // The chord of a piece of a circle is near its arc.
                    assert!(named.shape.distance(mean([from, to])).abs() < 0.02, "{text} {is_solid}: {from:?} {to:?}");
                }
            }
        }
    }

    #[test]
    fn sections_are_whole() {
        for text in SHAPES {
            let named = shape(text);
            let wires = wires(&named.shape, false);
            // Where the plane goes from outside to inside along a line of a grid, there is a wire.
            let mut crossings = 0;
            for row in 0..60 {
                let fixed = -14.97 + f64::from(row) * 0.5;
                for flips in [false, true] {
                    let at = |t: f64| if flips { [fixed, t, 0.0] } else { [t, fixed, 0.0] };
                    let on = |t: f64| named.shape.contains(at(t));
                    for step in 0..600 {
                        let [mut low, mut high] = [step, step + 1].map(|step| -15.0 + f64::from(step) * 0.05);
                        let was = on(low);
                        if was == on(high) {
                            continue;
                        }
                        crossings += 1;
                        for _ in 0..40 {
                            let middle = 0.5 * (low + high);
                            *(if on(middle) == was { &mut low } else { &mut high }) = middle;
                        }
                        let off = from_wires(&wires, at(low));
                        assert!(off < 0.02, "{text}: {:?} is {off} from all wires", at(low));
                    }
                }
            }
            assert!(crossings > 20, "{text}");
        }
    }

    #[test]
    fn what_the_plane_misses_has_no_section() {
        for text in ["cylinder(-2, 0.75, 3.5, 0, 1, 1, 1)", "cone(0, 0, 2, 1, 0, 9, 1)", "box(0, 0, 1, 2, 2, 2)"] {
            assert!(wireframe(&[shape(text)], false).is_empty(), "{text}");
        }
    }

    #[test]
    fn rims_are_whole() {
        // The rim of a dome is a circle in the plane that cuts the ball.
        let named = shape(SHAPES[0]);
        let wires = wires(&named.shape, true);
        let across = times([0.1, 1.0, 0.2], 1.0 / norm([0.1, 1.0, 0.2]));
        let high = 3.0 * across[1];
        let [u, v] = plane_of(across);
        for step in 0..360 {
            let at = around(times(across, high), [u, v], (81.0 - high * high).sqrt(), f64::from(step) / 360.0);
            assert!(from_wires(&wires, at) < 0.01, "{at:?}");
        }
        // Below the plane there is no wire.
        assert!(wires.iter().flatten().all(|at| dot(*at, across) > high - 1e-5));
    }

    #[test]
    fn shapes_are_drawn_if_the_style_says_so() {
        let rules = "shape s = box(-1, -1, -1, 1, 3, 1)\nA -> F(inside(s, 0, 0))A";
        let mut definition = Definition { axiom: "A".into(), rules: rules.into(), ..Definition::default() };
        let segments = |definition: &Definition| {
            let system = crate::System::new(definition).unwrap();
            let limits = lsystem_base::Limits::default();
            let drawing = crate::draw::<crate::Plane>(&system, 3, &limits).unwrap();
            (drawing.segment_count(), drawing.bounds().unwrap())
        };
        // The box is a rectangle in the plane; one of its sides has two strokes, since the rays begin there.
        assert_eq!(segments(&definition), (3 + 5, [-1.0, -1.0, 1.0, 3.0]));
        definition.style.shapes = false;
        assert_eq!(segments(&definition), (3, [0.0, 0.0, 0.0, 3.0]));
        // Shared drawings have the same shapes.
        (definition.style.shapes, definition.rules) = (true, "shape s = box(-1, -1, -1, 1, 3, 1)\nA -> F+F".into());
        assert_eq!(segments(&definition).0, 2 + 5);
    }
}
