//! Picking, compared with the distances of all segments and polygons, one by one.

use lsystem::drawing::{Mark, Plane, Space};
use lsystem::render::{Pick, Pointer, Target, camera_axes, fitted_ends, fitted_polygon, fitted_scale};
use lsystem::{Camera, Definition, Drawing, Figure, Limits, Solid, Style, System, View, Viewport, draw, pick};
use proptest::prelude::*;
use std::sync::Arc;

const VIEWPORT: Viewport = Viewport { width: 400, height: 300, ratio: 1.0 };

/// The place of a mark in the picture.
struct Seen {
    /// The distance from the pointer to the mark, in device pixels.
    distance: f64,
    /// The depth of the nearest point of the mark's surface behind the camera's target, in device pixels at the target;
    /// 0 in the plane.
    depth: f64,
    /// For a polygon: the distance from the pointer to its sides, in device pixels.
    sides: Option<f64>,
}

impl Seen {
    /// Whether the pointer hits the mark, so that the mark hides others, with a margin of `slack`.
    fn is_hit(&self, enough: f64, slack: f64) -> bool {
        match self.sides {
            None => self.distance <= enough - slack,
            Some(sides) => {
                if self.distance == 0.0 {
                    sides >= slack
                } else {
                    sides <= -slack
                }
            }
        }
    }
}

/// A segment, or a polygon at the place of its opening.
struct Shown {
    target: Target,
    /// The number of segments before the mark.
    before: u128,
    /// The place in the picture; `None` if the mark reaches behind the eye.
    seen: Option<Seen>,
}

/// The coordinates of a fitted place: four in the plane, three in space.
fn coordinates<const N: usize>(place: Vec<f64>) -> [f64; N] {
    place.try_into().unwrap()
}

/// The distance from a point to a segment, and the nearest point's position along the segment, from 0 to 1.
fn to_line([x, y]: [f64; 2], [[x0, y0], [x1, y1]]: [[f64; 2]; 2]) -> (f64, f64) {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let along = dx * dx + dy * dy;
    let part = if along > 0.0 { (((x - x0) * dx + (y - y0) * dy) / along).clamp(0.0, 1.0) } else { 0.0 };
    let (dx, dy) = (x0 + part * dx - x, y0 + part * dy - y);
    ((dx * dx + dy * dy).sqrt(), part)
}

/// Whether an outline winds around a point, by the sum of angles between its corners.
fn winds(outline: &[[f64; 2]], at: [f64; 2]) -> bool {
    let angle = |p: [f64; 2]| libm::atan2(p[1] - at[1], p[0] - at[0]);
    let turn = |a: f64, b: f64| {
        let by = b - a;
        if by > core::f64::consts::PI {
            by - core::f64::consts::TAU
        } else if by < -core::f64::consts::PI {
            by + core::f64::consts::TAU
        } else {
            by
        }
    };
    let sum: f64 = (0..outline.len()).map(|i| turn(angle(outline[i]), angle(outline[(i + 1) % outline.len()]))).sum();
    sum.abs() > 1.0
}

/// A target, the number of segments before it, and the stroke widths at its ends in fitted extents.
type Marked = (Target, u128, [f64; 2]);

/// All marks.
fn marks<S: Space>(drawing: &Drawing<S>, length: &dyn Fn(u128) -> f64) -> Vec<Marked> {
    let size = |from: &S::Point, to: &S::Point| {
        from.as_ref().iter().zip(to.as_ref()).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
    };
    let longest = (drawing.segments().map(|s| size(&s.from, &s.to)).enumerate()).max_by(|a, b| a.1.total_cmp(&b.1));
    // One model unit in fitted extents.
    let unit = longest.map_or(0.0, |(number, model)| length(number as u128) / model);
    let (mut segments, mut polygons) = (0, 0);
    let one = |mark: Mark<S>| match mark {
        Mark::Segment(segment, _) => {
            segments += 1;
            (Target::Segment(segments - 1), segments - 1, [segment.width * unit, segment.end_width * unit])
        }
        Mark::Polygon(..) => {
            polygons += 1;
            (Target::Polygon(polygons - 1), segments, [0.0; 2])
        }
    };
    drawing.marks().map(one).collect()
}

/// All marks of a drawing in space, with their places in the picture.
fn seen_solid(figure: &Figure, camera: &Camera, at: [f64; 2]) -> Vec<Shown> {
    let Figure::Space(drawing) = figure else { panic!("a figure in the plane") };
    let [right, up, back] = camera_axes(camera);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let minus = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|i| a[i] - b[i]);
    let scale = fitted_scale(figure, VIEWPORT, &(*camera).into()) * camera.zoom;
    // The eye is two fitted extents before the target.
    let larger = |depth: f64| if camera.perspective { 1.0 / (1.0 + depth / 2.0) } else { 1.0 };
    let view = |point: [f64; 3]| {
        let p = minus(point, camera.target);
        let depth = -dot(back, p);
        let pixels = scale * larger(depth);
        ([200.0 + pixels * dot(right, p), 150.0 - pixels * dot(up, p)], depth)
    };
    // Points nearer to the eye than a twentieth of the target's distance are not shown.
    let is_near = |&point: &[f64; 3]| camera.perspective && 1.0 + view(point).1 / 2.0 <= 0.05;
    // The nearest point of a line: its distance in the picture, and its depth behind the target.
    let nearest = |[from, to]: [[f64; 3]; 2]| {
        let ((a, near), (b, far)) = (view(from), view(to));
        let (_, part) = to_line(at, [a, b]);
        // In perspective, the middle in the picture is not the middle of the segment.
        let t = if camera.perspective {
            let (a, b) = (1.0 + near / 2.0, 1.0 + far / 2.0);
            part * a / (part * a + (1.0 - part) * b)
        } else {
            part
        };
        let ([x, y], depth) = view([0, 1, 2].map(|i| from[i] + t * (to[i] - from[i])));
        (((x - at[0]) * (x - at[0]) + (y - at[1]) * (y - at[1])).sqrt(), depth, t)
    };
    let ends = |number: u128| fitted_ends(figure, number).unwrap().map(coordinates);
    let length = |number: u128| {
        let [from, to] = ends(number);
        dot(minus(to, from), minus(to, from)).sqrt()
    };
    let one = |(target, before, [first, last]): Marked| {
        let seen = match target {
            Target::Segment(number) => {
                let ends = ends(number);
                (!ends.iter().any(is_near)).then(|| {
                    let (axis, depth, along) = nearest(ends);
                    let radius = (first + along * (last - first)) / 2.0 * scale;
                    let off = axis / larger(depth);
                    let bulge = (radius * radius - off * off).max(0.0).sqrt();
                    let distance = (axis - radius * larger(depth)).max(0.0);
                    Seen { distance, depth: scale * depth - bulge, sides: None }
                })
            }
            Target::Polygon(number) => {
                let outline: Vec<_> = fitted_polygon(figure, number).into_iter().map(coordinates).collect();
                (!outline.iter().any(is_near)).then(|| {
                    let corners: Vec<_> = outline.iter().map(|&corner| view(corner).0).collect();
                    let sides = (0..outline.len()).map(|i| nearest([outline[i], outline[(i + 1) % outline.len()]]));
                    let (sides, beside, _) = sides.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
                    if !winds(&corners, at) {
                        return Seen { distance: sides, depth: scale * beside, sides: Some(sides) };
                    }
                    // Intersect the ray through the pointer with the plane of the corner with the largest normal.
                    let way = |k: usize| minus(outline[(k + 1) % outline.len()], outline[k]);
                    let cross = |a: [f64; 3], b: [f64; 3]| {
                        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
                    };
                    let normals = (0..outline.len()).map(|k| cross(way(k), way((k + 1) % outline.len())));
                    let normal = normals.max_by(|&a, &b| dot(a, a).total_cmp(&dot(b, b))).unwrap();
                    let [x, y] = [(at[0] - 200.0) / scale, (150.0 - at[1]) / scale];
                    let upon = [0, 1, 2].map(|i| camera.target[i] + x * right[i] + y * up[i]);
                    let eye = [0, 1, 2].map(|i| camera.target[i] + 2.0 * back[i]);
                    let ray = if camera.perspective { minus(upon, eye) } else { back.map(|c| -c) };
                    let t = dot(normal, minus(outline[0], upon)) / dot(normal, ray);
                    let depth = -dot(back, minus([0, 1, 2].map(|i| upon[i] + t * ray[i]), camera.target));
                    Seen { distance: 0.0, depth: scale * depth, sides: Some(sides) }
                })
            }
        };
        Shown { target, before, seen }
    };
    marks(drawing, &length).into_iter().map(one).collect()
}

/// All marks of a drawing in the plane, with their places in the picture.
fn seen_flat(figure: &Figure, view: View, at: [f64; 2]) -> Vec<Shown> {
    let Figure::Plane(drawing) = figure else { panic!("a figure in space") };
    let scale = fitted_scale(figure, VIEWPORT, &view.into()) * view.zoom;
    let place = |place: Vec<f64>| {
        let [x, y, fine_x, fine_y] = coordinates(place);
        [200.0 + scale * (x + fine_x - view.x), 150.0 - scale * (y + fine_y - view.y)]
    };
    let ends = |number: u128| fitted_ends(figure, number).unwrap().map(place);
    let length = |number: u128| {
        let [[x0, y0], [x1, y1]] = ends(number);
        ((x1 - x0) * (x1 - x0) + (y1 - y0) * (y1 - y0)).sqrt() / scale
    };
    let one = |(target, before, [first, last]): Marked| {
        let seen = match target {
            Target::Segment(number) => {
                let (axis, along) = to_line(at, ends(number));
                let width = first + along * (last - first);
                let distance = (axis - width * scale / 2.0).max(0.0);
                Seen { distance, depth: 0.0, sides: None }
            }
            Target::Polygon(number) => {
                let outline: Vec<_> = fitted_polygon(figure, number).into_iter().map(place).collect();
                let sides = (0..outline.len()).map(|i| to_line(at, [outline[i], outline[(i + 1) % outline.len()]]).0);
                let sides = sides.fold(f64::INFINITY, f64::min);
                Seen { distance: if winds(&outline, at) { 0.0 } else { sides }, depth: 0.0, sides: Some(sides) }
            }
        };
        Shown { target, before, seen: Some(seen) }
    };
    marks(drawing, &length).into_iter().map(one).collect()
}

/// Checks that the pick is in front of all marks that the pointer hits, or the nearest mark if the pointer hits none.
fn check(all: &[Shown], pointer: &Pointer, found: Option<Pick>) -> Result<(), TestCaseError> {
    let upto = pointer.upto.unwrap_or(u128::MAX);
    let is_there =
        |shown: &&Shown| shown.before < upto || shown.before == upto && matches!(shown.target, Target::Polygon(_));
    let there = || {
        all.iter()
            .enumerate()
            .filter(|(_, shown)| is_there(shown))
            .filter_map(|(at, shown)| Some((at, shown.seen.as_ref()?)))
    };
    let (tolerance, enough) = (pointer.tolerance, pointer.tolerance / 4.0);
    let slack = tolerance / 16.0;
    let nearest = there().map(|(_, seen)| seen.distance).fold(f64::INFINITY, f64::min);
    let Some(found) = found else {
        prop_assert!(nearest >= tolerance - slack, "nothing, but {} is there", nearest);
        return Ok(());
    };
    let at = all.iter().position(|shown| shown.target == found.target).unwrap();
    prop_assert!(is_there(&&all[at]), "{:?}", found);
    // For a mark that reaches behind the eye, there is no place to compare with.
    let Some(own) = &all[at].seen else { return Ok(()) };
    prop_assert!((own.distance - found.distance).abs() < 1e-6 * (1.0 + own.distance), "{:?} {}", found, own.distance);
    prop_assert!(found.distance < tolerance);
    let hits = || there().filter(|(_, seen)| seen.is_hit(enough, slack));
    let front = hits().map(|(_, seen)| seen.depth).fold(f64::INFINITY, f64::min);
    if front < f64::INFINITY {
        prop_assert!(own.is_hit(enough, -slack), "{:?} beside {}", found, front);
        prop_assert!(own.depth <= front + enough + slack, "{:?} at {} behind {}", found, own.depth, front);
        // In the plane all depths are 0, and the last mark is in front.
        if own.depth == 0.0 && front == 0.0 {
            let last = hits().map(|(at, _)| at).max().unwrap_or(0);
            prop_assert!(at >= last, "{:?} beneath {:?}", found, all[last].target);
        }
    } else {
        prop_assert!(found.distance <= (nearest + slack).max(enough + slack), "{:?} {}", found, nearest);
    }
    Ok(())
}

fn word() -> impl Strategy<Value = String> {
    let parts = vec![
        "F",
        "F",
        "A",
        "B",
        "+",
        "-",
        "&",
        "^",
        "\\",
        "/",
        "f",
        "!",
        "[&F]",
        "[/A]",
        "[^^B]",
        "$",
        "{f+f+f}",
        "[^{f-f-f}]",
        "○",
        "●",
        "@",
        "~",
        "]",
    ];
    prop::collection::vec(prop::sample::select(parts), 1..7).prop_map(|parts| parts.concat())
}

/// A system from an axiom and three successors. With `chance`, two of them replace the first letter.
fn system([axiom, a, b, f]: [String; 4], chance: bool, width: f64, step: f64) -> System {
    let rules = if chance {
        format!("A -> {a} : 1\nA -> {b} : 2\nF -> {f}F")
    } else {
        format!("A -> {a}\nB -> {b}\nF -> {f}F")
    };
    let style = Style { width, ..Style::default() };
    let definition = Definition {
        axiom: format!("F{axiom}"),
        rules,
        angle: 25.7,
        right_angle: Some(40.0),
        start: [3.0, -2.0],
        overrides: "@: length times 0.8\n~: swap turns".into(),
        style,
        ..Definition::default()
    };
    let mut system = System::new(&definition).unwrap_or_else(|problems| panic!("{definition:?}: {problems:?}"));
    system.turtle.step = step;
    system
}

fn camera() -> impl Strategy<Value = Camera> {
    let zoom = prop::sample::select(vec![1.0, 2.5, 7.0]);
    (-180.0..180.0, -90.0..90.0, zoom, prop::array::uniform3(-0.2..0.2), any::<bool>()).prop_map(
        |(azimuth, elevation, zoom, target, perspective)| Camera {
            azimuth,
            elevation,
            zoom,
            target,
            perspective,
            ..Camera::default()
        },
    )
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn what_is_under_a_pointer_is_nearest_to_the_eye(
        words in prop::array::uniform4(word()),
        (n, width, step) in (0..5_u32, prop::sample::select(vec![0.0, 0.05, 0.6]), prop::sample::select(vec![1.0, -0.7])),
        camera in camera(),
        places in prop::array::uniform4((0.0..400.0, 0.0..300.0)),
        (tolerance, part) in (2.0..16.0, 0.0..2.0),
        chance in any::<bool>(),
    ) {
        let system = system(words, chance, width, step);
        prop_assume!(lsystem::count_segments(&system, n).is_none_or(|count| count.to_string().len() < 5));
        let figure = Figure::Space(Arc::new(draw::<Solid>(&system, n, &Limits::default()).unwrap()));
        let count = figure.segment_count();
        // Pointers at random places and on segments.
        for (k, (x, y)) in places.into_iter().enumerate() {
            let upto = Some((part * count as f64) as u128).filter(|&upto| upto < count);
            let pointer = Pointer { at: [x, y], tolerance, upto, visits: usize::MAX };
            check(&seen_solid(&figure, &camera, pointer.at), &pointer, pick(&figure, VIEWPORT, &camera.into(), &pointer))?;
            let number = count * k as u128 / 4;
            let [right, up, back] = camera_axes(&camera);
            let [from, to] = fitted_ends(&figure, number).unwrap();
            let p = [0, 1, 2].map(|i| 0.5 * (from[i] + to[i]) - camera.target[i]);
            let along = |a: [f64; 3]| a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
            let larger = if camera.perspective { 1.0 / (1.0 - along(back) / 2.0).max(0.05) } else { 1.0 };
            let pixels = fitted_scale(&figure, VIEWPORT, &camera.into()) * camera.zoom * larger;
            let at = [200.0 + pixels * along(right), 150.0 - pixels * along(up)];
            let pointer = Pointer { at, tolerance, upto: None, visits: usize::MAX };
            check(&seen_solid(&figure, &camera, at), &pointer, pick(&figure, VIEWPORT, &camera.into(), &pointer))?;
            let hurried = pick(&figure, VIEWPORT, &camera.into(), &Pointer { at, tolerance, upto: None, visits: 3 });
            prop_assert!(hurried.is_none_or(|pick| pick.distance < tolerance));
        }
    }
}

proptest! {
    #![proptest_config(test_effort::config())]

    #[test]
    fn what_is_under_a_pointer_is_drawn_last(
        words in prop::array::uniform4(word()),
        (n, width, step) in (0..5_u32, prop::sample::select(vec![0.0, 0.05, 0.6]), prop::sample::select(vec![1.0, -0.7])),
        (zoom, x, y) in (prop::sample::select(vec![1.0, 2.5, 7.0]), -0.3..0.3, -0.3..0.3),
        places in prop::array::uniform4((0.0..400.0, 0.0..300.0)),
        (tolerance, part) in (2.0..16.0, 0.0..2.0),
        chance in any::<bool>(),
    ) {
        // In the plane, rotations out of the plane are ignored.
        let words = words.map(|word| word.replace(['&', '^', '\\', '/', '$'], "+"));
        let system = system(words, chance, width, step);
        prop_assume!(lsystem::count_segments(&system, n).is_none_or(|count| count.to_string().len() < 5));
        let figure = Figure::Plane(Arc::new(draw::<Plane>(&system, n, &Limits::default()).unwrap()));
        let (count, polygons) = (figure.segment_count(), figure.polygon_count());
        let view = View { x, y, zoom, fine: [0.0; 2] };
        let scale = fitted_scale(&figure, VIEWPORT, &view.into()) * zoom;
        for (k, at) in places.into_iter().enumerate() {
            let upto = Some((part * count as f64) as u128).filter(|&upto| upto < count);
            // Pointers at random places and inside polygons.
            let corners = (polygons > 0).then(|| fitted_polygon(&figure, polygons * k as u128 / 4));
            let middle = corners.map(|corners| {
                let [x, y] = [0, 1].map(|i| corners.iter().map(|c| c[i]).sum::<f64>() / corners.len() as f64);
                [200.0 + scale * (x - view.x), 150.0 - scale * (y - view.y)]
            });
            for (at, upto) in [(<[f64; 2]>::from(at), upto), (middle.unwrap_or([200.0, 150.0]), None)] {
                let pointer = Pointer { at, tolerance, upto, visits: usize::MAX };
                check(&seen_flat(&figure, view, at), &pointer, pick(&figure, VIEWPORT, &view.into(), &pointer))?;
            }
        }
    }
}

/// On every segment of a huge drawing a mark is found with little work, also if branches do not become smaller and lie
/// in the same place.
#[test]
fn deep_bushes_are_picked_within_a_budget() {
    // ABOP, figure 1.25, without leaves; and a tree of the course.
    let bush = "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^F]";
    let tree = "A -> AF\nF -> F[+F][-FF][\\F][/FF][&F]";
    for (rules, angle, n) in [(bush, 22.5, 40), (tree, 40.0, 30)] {
        let definition = Definition { axiom: "A".into(), rules: rules.into(), angle, ..Definition::default() };
        let figure = Figure::draw(&System::new(&definition).unwrap(), n, &Limits::default()).unwrap();
        assert!(figure.is_solid());
        let large = Viewport { width: 1000, height: 800, ratio: 1.0 };
        let mut missed = 0;
        for k in 0..200 {
            let camera = Camera { azimuth: 7.0 * f64::from(k), perspective: k % 2 == 0, ..Camera::default() };
            let [right, up, back] = camera_axes(&camera);
            let [from, _] = fitted_ends(&figure, figure.segment_count() / 201 * (k as u128 + 1)).unwrap();
            let along = |a: [f64; 3]| a[0] * from[0] + a[1] * from[1] + a[2] * from[2];
            let larger = if camera.perspective { 1.0 / (1.0 - along(back) / 2.0) } else { 1.0 };
            let pixels = fitted_scale(&figure, large, &camera.into()) * larger;
            let at = [500.0 + pixels * along(right), 400.0 - pixels * along(up)];
            let pointer = Pointer { at, tolerance: 6.0, upto: None, visits: 20_000 };
            missed += u32::from(pick(&figure, large, &camera.into(), &pointer).is_none());
        }
        assert_eq!(missed, 0, "{rules}");
    }
}
