//! What is under a pointer in space, against all segments projected one by one.

mod cases;

use cases::cases;
use lsystem::{
    Camera, Definition, Drawing, Limits, Pointer, Solid, Style, System, Viewport, camera_axes, draw_solid,
    fitted_solid_ends, pick_solid, solid_scale,
};
use proptest::prelude::*;

const VIEWPORT: Viewport = Viewport { width: 400, height: 300, ratio: 1.0 };

/// A segment as it is seen.
struct Seen {
    /// The distance of its stroke from the pointer, in device pixels.
    distance: f64,
    /// How far behind the target the nearest place of the stroke's surface is, in device pixels at the target.
    depth: f64,
}

/// Every segment that is before the eye.
fn seen(drawing: &Drawing<Solid>, camera: &Camera, at: [f64; 2]) -> Vec<Option<Seen>> {
    let [right, up, back] = camera_axes(camera);
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let scale = solid_scale(drawing, VIEWPORT, camera) * camera.zoom;
    let ends = |number: usize| fitted_solid_ends(drawing, number as u128).unwrap();
    // Fitted extents in a model unit.
    let all: Vec<_> = drawing.segments().collect();
    let length = |[a, b]: [[f64; 3]; 2]| dot([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| b[i] - a[i])).sqrt();
    let longest = (0..all.len()).max_by(|&a, &b| length(ends(a)).total_cmp(&length(ends(b)))).unwrap();
    let unit = length(ends(longest)) / length([all[longest].from, all[longest].to]);
    // The eye is two fitted extents before the target.
    let larger = |depth: f64| if camera.perspective { 1.0 / (1.0 + depth / 2.0) } else { 1.0 };
    let view = |segment: usize, t: f64| {
        let [from, to] = ends(segment);
        let p = [0, 1, 2].map(|i| from[i] + t * (to[i] - from[i]) - camera.target[i]);
        let depth = -dot(back, p);
        let pixels = scale * larger(depth);
        ([200.0 + pixels * dot(right, p), 150.0 - pixels * dot(up, p)], depth)
    };
    let one = |segment: usize| {
        // What is nearer to the eye than a twentieth of its distance is not shown.
        if camera.perspective && [0.0, 1.0].iter().any(|&t| 1.0 + view(segment, t).1 / 2.0 <= 0.05) {
            return None;
        }
        let ([x0, y0], near) = view(segment, 0.0);
        let ([x1, y1], far) = view(segment, 1.0);
        let (dx, dy) = (x1 - x0, y1 - y0);
        let along = dx * dx + dy * dy;
        let part = if along > 0.0 { (((at[0] - x0) * dx + (at[1] - y0) * dy) / along).clamp(0.0, 1.0) } else { 0.0 };
        // Half-way in the picture is nearer than half-way along the segment.
        let t = if camera.perspective {
            let (a, b) = (1.0 + near / 2.0, 1.0 + far / 2.0);
            part * a / (part * a + (1.0 - part) * b)
        } else {
            part
        };
        let ([x, y], depth) = view(segment, t);
        let axis = ((x - at[0]) * (x - at[0]) + (y - at[1]) * (y - at[1])).sqrt();
        let radius = all[segment].width / 2.0 * unit * scale;
        let off = axis / larger(depth);
        let bulge = (radius * radius - off * off).max(0.0).sqrt();
        Some(Seen { distance: (axis - radius * larger(depth)).max(0.0), depth: scale * depth - bulge })
    };
    (0..all.len()).map(one).collect()
}

fn check(drawing: &Drawing<Solid>, camera: &Camera, pointer: &Pointer) -> Result<(), TestCaseError> {
    let all = seen(drawing, camera, pointer.at);
    let there = &all[..pointer.upto.map_or(all.len(), |upto| all.len().min(upto as usize))];
    let (tolerance, enough) = (pointer.tolerance, pointer.tolerance / 4.0);
    let slack = tolerance / 16.0;
    let found = pick_solid(drawing, VIEWPORT, camera, pointer);
    let nearest = there.iter().flatten().map(|seen| seen.distance).fold(f64::INFINITY, f64::min);
    let Some(found) = found else {
        prop_assert!(nearest >= tolerance - slack, "nothing, but {} is there", nearest);
        return Ok(());
    };
    prop_assert!((found.segment as usize) < there.len(), "{:?}", found);
    // One that reaches behind the eye is seen in part, and only its own word is there for where.
    let Some(own) = &there[found.segment as usize] else { return Ok(()) };
    prop_assert!((own.distance - found.distance).abs() < 1e-6 * (1.0 + own.distance), "{:?} {}", found, own.distance);
    prop_assert!(found.distance < tolerance);
    let front = there.iter().flatten().filter(|seen| seen.distance <= enough - slack);
    let front = front.map(|seen| seen.depth).fold(f64::INFINITY, f64::min);
    if front < f64::INFINITY {
        prop_assert!(found.distance <= enough + slack, "{:?} beside {}", found, front);
        prop_assert!(own.depth <= front + enough + slack, "{:?} at {} behind {}", found, own.depth, front);
    } else {
        prop_assert!(found.distance <= (nearest + slack).max(enough + slack), "{:?} {}", found, nearest);
    }
    Ok(())
}

fn word() -> impl Strategy<Value = String> {
    let parts =
        vec!["F", "F", "A", "B", "+", "-", "&", "^", "\\", "/", "f", "!", "[&F]", "[/A]", "[^^B]", "$", "{f+f+f}", "]"];
    prop::collection::vec(prop::sample::select(parts), 1..7).prop_map(|parts| parts.concat())
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
            fade: 0.0,
        },
    )
}

proptest! {
    #![proptest_config(cases())]

    #[test]
    fn what_is_under_a_pointer_is_nearest_to_the_eye(
        words in prop::array::uniform4(word()),
        (n, width, step) in (0..5_u32, prop::sample::select(vec![0.0, 0.05, 0.6]), prop::sample::select(vec![1.0, -0.7])),
        camera in camera(),
        places in prop::array::uniform4((0.0..400.0, 0.0..300.0)),
        (tolerance, part) in (2.0..16.0, 0.0..2.0),
        chance in any::<bool>(),
    ) {
        let [axiom, a, b, f] = words;
        let rules = if chance { format!("A -> {a} : 1\nA -> {b} : 2\nF -> {f}F") } else { format!("A -> {a}\nB -> {b}\nF -> {f}F") };
        let style = Style { width, ..Style::default() };
        let definition = Definition { axiom: format!("F{axiom}"), rules, angle: 25.7, start: [3.0, -2.0], style, ..Definition::default() };
        let (system, problems) = System::new(&definition);
        let mut system = system.unwrap_or_else(|| panic!("{definition:?}: {problems:?}"));
        system.turtle.step = step;
        prop_assume!(lsystem::count_segments(&system, n).is_none_or(|count| count.to_string().len() < 5));
        let drawing = draw_solid(&system, n, &Limits::default()).unwrap();
        let count = drawing.segment_count();
        // At places of the picture, and upon segments.
        for (k, (x, y)) in places.into_iter().enumerate() {
            let upto = Some((part * count as f64) as u128).filter(|&upto| upto < count);
            check(&drawing, &camera, &Pointer { at: [x, y], tolerance, upto, visits: usize::MAX })?;
            let number = count * k as u128 / 4;
            let [right, up, back] = camera_axes(&camera);
            let [from, to] = fitted_solid_ends(&drawing, number).unwrap();
            let p = [0, 1, 2].map(|i| 0.5 * (from[i] + to[i]) - camera.target[i]);
            let along = |a: [f64; 3]| a[0] * p[0] + a[1] * p[1] + a[2] * p[2];
            let larger = if camera.perspective { 1.0 / (1.0 - along(back) / 2.0).max(0.05) } else { 1.0 };
            let pixels = solid_scale(&drawing, VIEWPORT, &camera) * camera.zoom * larger;
            let at = [200.0 + pixels * along(right), 150.0 - pixels * along(up)];
            check(&drawing, &camera, &Pointer { at, tolerance, upto: None, visits: usize::MAX })?;
            let hurried = pick_solid(&drawing, VIEWPORT, &camera, &Pointer { at, tolerance, upto: None, visits: 3 });
            prop_assert!(hurried.is_none_or(|pick| pick.segment < count && pick.distance < tolerance));
        }
    }
}

/// However many segments there are, something is found on every one of them, soon; also where branches do not become
/// smaller and lie in the same place.
#[test]
fn deep_bushes_are_picked_within_a_budget() {
    // ABOP, figure 1.25, without its leaves; and a tree of the course.
    let bush = "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^F]";
    let tree = "A -> AF\nF -> F[+F][-FF][\\F][/FF][&F]";
    for (rules, angle, n) in [(bush, 22.5, 40), (tree, 40.0, 30)] {
        let definition = Definition { axiom: "A".into(), rules: rules.into(), angle, ..Definition::default() };
        let drawing = draw_solid(&System::new(&definition).0.unwrap(), n, &Limits::default()).unwrap();
        let large = Viewport { width: 1000, height: 800, ratio: 1.0 };
        let mut missed = 0;
        for k in 0..200 {
            let camera = Camera { azimuth: 7.0 * f64::from(k), perspective: k % 2 == 0, ..Camera::default() };
            let [right, up, back] = camera_axes(&camera);
            let [from, _] = fitted_solid_ends(&drawing, drawing.segment_count() / 201 * (k as u128 + 1)).unwrap();
            let along = |a: [f64; 3]| a[0] * from[0] + a[1] * from[1] + a[2] * from[2];
            let larger = if camera.perspective { 1.0 / (1.0 - along(back) / 2.0) } else { 1.0 };
            let pixels = solid_scale(&drawing, large, &camera) * larger;
            let at = [500.0 + pixels * along(right), 400.0 - pixels * along(up)];
            let pointer = Pointer { at, tolerance: 6.0, upto: None, visits: 20_000 };
            missed += u32::from(pick_solid(&drawing, large, &camera, &pointer).is_none());
        }
        assert_eq!(missed, 0, "{rules}");
    }
}
