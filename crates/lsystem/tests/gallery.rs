//! The files of `data_in`: every system is read without warnings, and can be drawn and picked.

use lsystem::render::{Pointer, camera_axes, fitted_ends, fitted_polygon, fitted_scale};
use lsystem::{Camera, Figure, Limits, Plane, System, Vantage, View, Viewport, draw, pick, read_json, write_json};
use std::collections::BTreeSet;
use std::path::Path;

/// Systems without a drawing, for their strings.
const DRAWS_NOTHING: [&str; 2] = ["LRI (prose rule only)", "README S->SS"];

/// The folder, the name and the text of every file.
fn files() -> Vec<(String, String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let list = |path: &Path| std::fs::read_dir(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let folders = list(&root).map(|entry| entry.expect("readable"));
    let files = folders.flat_map(|folder| {
        let name = folder.file_name().display().to_string();
        list(&folder.path()).map(move |file| {
            let path = file.expect("readable").path();
            let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            (name.clone(), path.file_name().map_or_else(String::new, |name| name.display().to_string()), text)
        })
    });
    files.collect()
}

#[test]
fn files_read_without_a_doubt_and_draw() {
    let mut names = BTreeSet::new();
    for (folder, file, text) in files() {
        let what = format!("{folder}/{file}");
        assert!(file.ends_with(".json"), "{what}");
        let (definition, diagnostics) = read_json(&text);
        assert_eq!(diagnostics, [], "{what}");
        let definition = definition.unwrap_or_else(|| panic!("{what}"));
        for words in [&definition.name, &definition.title, &definition.source] {
            assert!(!words.trim().is_empty(), "{what}");
        }
        let system = System::new(&definition).unwrap_or_else(|problems| panic!("{what}: {problems:?}"));
        assert_eq!(system.warnings, [], "{what}");
        let drawing = draw::<Plane>(&system, definition.iterations, &Limits::default());
        let drawing = drawing.unwrap_or_else(|limit| panic!("{what}: {limit:?}"));
        assert_eq!(drawing.bounds().is_none(), DRAWS_NOTHING.contains(&definition.name.as_str()), "{what}");
        assert!(names.insert((folder, definition.name)), "{what}: its name is taken");
    }
    assert!(names.len() >= 80, "{}", names.len());
}

#[test]
fn files_survive_being_written() {
    for (folder, file, text) in files() {
        let (definition, _) = read_json(&text);
        let definition = definition.unwrap_or_else(|| panic!("{folder}/{file}"));
        let (again, diagnostics) = read_json(&write_json(&definition));
        assert_eq!((again.as_ref(), diagnostics.as_slice()), (Some(&definition), [].as_slice()), "{folder}/{file}");
    }
}

/// At every magnification, a pick succeeds within the page's budget.
#[test]
fn everything_is_picked_within_a_budget() {
    let viewport = Viewport { width: 1280, height: 800, ratio: 1.0 };
    let pointer = Pointer { at: [640.0, 400.0], tolerance: 6.0, upto: None, visits: 20_000 };
    let near = pointer.tolerance / 4.0;
    let mut filled = 0;
    for (folder, file, text) in test_effort::sampled(files(), 4, 0) {
        let what = format!("{folder}/{file}");
        let definition = read_json(&text).0.unwrap();
        let system = System::new(&definition).unwrap();
        if system.is_solid() {
            let figure = Figure::draw(&system, definition.iterations, &Limits::default()).unwrap();
            for k in 0..20 {
                let Some([from, to]) = fitted_ends(&figure, figure.segment_count() / 20 * k) else { continue };
                let camera = Camera { azimuth: 17.0 * k as f64, ..Camera::default() };
                let along = |a: [f64; 3]| (0..3).map(|i| a[i] * (from[i] + to[i]) / 2.0).sum::<f64>();
                let [right, up, back] = camera_axes(&camera).map(along);
                let scale = fitted_scale(&figure, viewport, &camera.into()) / (1.0 - back / 2.0);
                let pointer = Pointer { at: [640.0 + scale * right, 400.0 - scale * up], ..pointer };
                let found = pick(&figure, viewport, &camera.into(), &pointer);
                assert!(found.is_some_and(|pick| pick.distance <= near), "{what} {k}: {found:?}");
            }
            continue;
        }
        let later = Figure::draw(&system, 40, &Limits::default()).ok().filter(Figure::is_memoised);
        for figure in
            [Figure::draw(&system, definition.iterations, &Limits::default()).ok(), later].into_iter().flatten()
        {
            for zoom in [1.0, 30.0, 1e3, 1e6, 1e9] {
                for k in 0..20 {
                    let ends = fitted_ends(&figure, figure.segment_count() / 20 * k + k);
                    // Magnifications at which a segment is longer than a hundred screens are useless.
                    let long = |[from, to]: &[Vec<f64>; 2]| {
                        let [x, y] = [0, 1].map(|i| to[i] - from[i] + (to[i + 2] - from[i + 2]));
                        fitted_scale(&figure, viewport, &Vantage::default()) * zoom * x.abs().max(y.abs()) > 1e5
                    };
                    let end = ends.filter(|ends| !long(ends)).map(|[from, _]| from);
                    let corner = fitted_polygon(&figure, figure.polygon_count() / 20 * k + k).into_iter().next();
                    filled += u32::from(corner.is_some());
                    for place in [end, corner].into_iter().flatten() {
                        let view = View { x: place[0], y: place[1], zoom, fine: [place[2], place[3]] };
                        let found = pick(&figure, viewport, &view.into(), &pointer);
                        assert!(found.is_some_and(|pick| pick.distance <= near), "{what} {zoom} {k}: {found:?}");
                    }
                }
            }
        }
    }
    assert!(filled > 25, "{filled}");
}
