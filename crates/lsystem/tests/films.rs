//! Films of growth: in every frame the drawing fills the picture, so that no frame's scale jumps.

use lsystem::film::{Film, Frame, Script, grow};
use lsystem::render::{fitted_ends, fitted_polygon, fitted_scale};
use lsystem::{Camera, Figure, Limits, System, Viewport, read_file};

/// A square: the margins are as wide as they are high.
const VIEWPORT: Viewport = Viewport { width: 1000, height: 1000, ratio: 1.0 };

/// A film of the growth of a system in the gallery, without stroke widths, and seen from the side.
fn film(file: &str, n: u32) -> Film {
    let path = format!("{}/../../data_in/{file}.json", env!("CARGO_MANIFEST_DIR"));
    let mut definition = read_file(&std::fs::read(path).unwrap()).definition.unwrap();
    definition.style.width = 0.0;
    let script = Script { seconds: 4.0, ..Script::default() };
    let script = Script { tracks: vec![grow(&script, n)], ..script };
    let camera = Camera { perspective: false, elevation: 0.0, ..Camera::default() };
    Film::new(script, definition, camera.into()).unwrap()
}

/// The largest distance from the middle of the picture to the side, and up or down, of points in pixels.
fn reach(points: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    points.fold([0.0_f64; 2], |most, point| [0, 1].map(|axis| most[axis].max(point[axis].abs())))
}

/// As [`reach`], of a frame's drawing. In space the picture has room for the drawing from all sides: the distance to the
/// side is that from the upright axis.
fn reach_of(Frame { definition, vantage, .. }: &Frame) -> Option<[f64; 2]> {
    let figure = Figure::draw(&System::new(definition).ok()?, definition.iterations, &Limits::default()).ok()?;
    let scale = fitted_scale(&figure, VIEWPORT, vantage);
    let ends = (0..figure.segment_count()).filter_map(|number| fitted_ends(&figure, number)).flatten();
    let vertices = (0..figure.polygon_count()).flat_map(|number| fitted_polygon(&figure, number));
    let aside = |place: &[f64]| if figure.is_solid() { libm::hypot(place[0], place[2]) } else { place[0] };
    let points = ends.chain(vertices).map(|place| [aside(&place) * scale, place[1] * scale]);
    (figure.segment_count() > 0).then(|| reach(points))
}

/// Checks that the drawing in every frame fills the same part of the picture, up to `tolerance`.
fn check(file: &str, n: u32, tolerance: f64) {
    let film = film(file, n);
    let mut before: Option<f64> = None;
    let mut frames = 0;
    for number in 0..film.frames() {
        let frame = film.frame(number);
        // Some axioms draw nothing.
        let Some([aside, up]) = reach_of(&frame) else { continue };
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
