//! The shapes of the gallery's drawings, which no surprise may have.

use expect_test::expect_file;
use lsystem_drawing::{Figure, System};
use lsystem_files::read_json;
use lsystem_invent::{LIMITS, Moments, SEGMENTS, lines};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Figures of the plane with at most [`SEGMENTS`] segments: every generation of every system of the gallery.
#[test]
fn the_gallery_is_known() {
    let mut shapes: Vec<Moments> = vec![];
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in");
    let folders = fs::read_dir(data).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir());
    for path in folders.flat_map(|folder| fs::read_dir(folder).unwrap()).map(|entry| entry.unwrap().path()) {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        let (Some(definition), _) = read_json(&text) else { continue };
        let Ok(system) = System::new(&definition) else { continue };
        for n in 2..=14 {
            let Ok(figure) = Figure::draw(&system, n, &LIMITS) else { break };
            let count = figure.segment_count().saturating_add(figure.polygon_count());
            if figure.is_solid() || count > SEGMENTS {
                break;
            }
            if count >= 60 {
                shapes.push(Moments::of(&lines(&figure)));
            }
        }
    }
    shapes.retain(|shape| shape.spread.is_finite() && shape.tail.is_finite());
    shapes.sort_by_key(|shape| (shape.count, (shape.spread * 1e6) as u64));
    let text: BTreeSet<(usize, String)> = shapes.iter().map(|shape| (shape.count, shape.line())).collect();
    let text: String = text.into_iter().map(|(_, line)| line).collect();
    assert!(text.lines().count() > 200);
    expect_file!["../src/gallery.txt"].assert_eq(&text);
}
