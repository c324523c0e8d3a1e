//! Films of growth: in every frame the drawing fills the picture, so that no frame's scale jumps.

use lsystem::film::{Film, Script, growth};
use lsystem::render::{fitted_ends, fitted_scale, fitted_solid_ends, fitted_solid_polygon, solid_scale};
use lsystem::{Camera, Definition, Limits, Plane, Solid, System, View, Viewport, draw, read_file};

/// A square: the margins are as wide as they are high.
const VIEWPORT: Viewport = Viewport { width: 1000, height: 1000, ratio: 1.0 };

/// A film of the growth of a system in the gallery, without stroke widths, and seen from the side.
fn film(file: &str, n: u32) -> Film {
    let path = format!("{}/../../data_in/{file}.json", env!("CARGO_MANIFEST_DIR"));
    let mut definition = read_file(&std::fs::read(path).unwrap()).definition.unwrap();
    definition.style.width = 0.0;
    let script = Script { seconds: 4.0, ..Script::default() };
    let script = Script { tracks: vec![growth(&script, n)], ..script };
    let camera = Camera { perspective: false, elevation: 0.0, ..Camera::default() };
    Film::new(script, definition, View::default(), camera).unwrap()
}

/// The largest distance from the middle of the picture to the side, and up or down, of points in pixels.
fn reach(points: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    points.fold([0.0_f64; 2], |most, point| [0, 1].map(|axis| most[axis].max(point[axis].abs())))
}

fn reach_in_plane(definition: &Definition) -> Option<[f64; 2]> {
    let drawing = draw::<Plane>(&System::new(definition).0?, definition.iterations, &Limits::default()).ok()?;
    let scale = fitted_scale(&drawing, VIEWPORT);
    let ends = (0..drawing.segment_count()).filter_map(|number| fitted_ends(&drawing, number)).flatten();
    (drawing.segment_count() > 0).then(|| reach(ends.map(|[x, y, ..]| [x * scale, y * scale])))
}

/// The picture has room for the drawing from all sides: the distance to the side is that from the upright axis.
fn reach_in_space(definition: &Definition, camera: &Camera) -> Option<[f64; 2]> {
    let drawing = draw::<Solid>(&System::new(definition).0?, definition.iterations, &Limits::default()).ok()?;
    let scale = solid_scale(&drawing, VIEWPORT, camera);
    let ends = (0..drawing.segment_count()).filter_map(|number| fitted_solid_ends(&drawing, number)).flatten();
    let vertices = (0..drawing.polygon_count()).flat_map(|number| fitted_solid_polygon(&drawing, number));
    let points = ends.chain(vertices);
    (drawing.segment_count() > 0).then(|| reach(points.map(|[x, y, z]| [libm::hypot(x, z) * scale, y * scale])))
}

/// Checks that the drawing in every frame fills the same part of the picture, up to `tolerance`.
fn check(file: &str, n: u32, tolerance: f64) {
    let film = film(file, n);
    let mut before: Option<f64> = None;
    let mut frames = 0;
    for number in 0..film.frames() {
        let frame = film.frame(number);
        let is_solid = System::new(&frame.definition).0.unwrap().is_solid();
        let reach =
            if is_solid { reach_in_space(&frame.definition, &frame.camera) } else { reach_in_plane(&frame.definition) };
        // Some axioms draw nothing.
        let Some([aside, up]) = reach else { continue };
        let filled = (2.0 * aside / f64::from(VIEWPORT.width)).max(2.0 * up / f64::from(VIEWPORT.height));
        // There is a margin, and no more.
        assert!(filled <= 1.0 && filled > 0.85, "{file}, frame {number}: {filled} of the picture is filled");
        if let Some(before) = before {
            let jump = (filled / before - 1.0).abs();
            assert!(jump <= tolerance, "{file}, frame {number}: the scale jumps by {jump}");
        }
        before = Some(filled);
        frames += 1;
    }
    assert!(frames > 90, "{file}: {frames} frames");
}

#[test]
fn no_scale_jumps_in_the_plane() {
    // The extent is exact but for rounding.
    for (file, n) in [("abop/1.24f", 4), ("curves/gosper", 3), ("curves/penrose", 4), ("focs-lsystems/koch-curve", 4)] {
        check(file, n, 1e-9);
    }
}

#[test]
fn no_scale_jumps_in_space() {
    // A reach is exact to 1e-4 of the root block's unit, and a drawing is at least half a unit wide.
    let files = [
        ("practical-1/tree3d0", 3),
        ("practical-1/tree3d1", 3),
        ("abop/1.19", 2),
        ("abop/1.25", 4),
        ("trees-and-turtles/of-trees-and-turtles", 4),
    ];
    for (file, n) in files {
        check(file, n, 1e-3);
    }
}
