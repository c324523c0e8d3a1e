//! What the steps of pictures may cost.

use crate::systems::{Case, GENERATIONS, LENGTHS, LONGEST, cases};
use lsystem::{
    Camera, DensityRenderer, Detail, Drawing, Ink, Limits, Meter, PlaneRenderer, Pointer, Progress, Quality, Renderer,
    Solid, SolidRenderer, Style, View, Viewport, draw, draw_solid, pick, pick_solid,
};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The share of a step, as in the page.
const SHARE: u64 = 16_384;
/// Steps of a picture that are looked at: pictures of a million segments take longer than a test may.
const STEPS: usize = 150;
/// As in the page.
const LIMITS: Limits =
    Limits { symbols: 64 << 20, modules: 16 << 20, segments: 1_000_000, work: 100_000_000, memory: 96 << 20 };

/// The largest step of each entry point, and what it was at.
#[derive(Default)]
struct Most(BTreeMap<&'static str, (u64, String)>);

impl Most {
    /// Notes a step, which may exceed its share by one piece.
    fn note(&mut self, entry: &'static str, name: &str, units: u64) {
        assert!(units <= SHARE + Meter::PIECE, "{entry}, {name}: {units} units in one step");
        let most = self.0.entry(entry).or_default();
        if units > most.0 {
            *most = (units, name.to_owned());
        }
    }

    fn print(&self) {
        for (entry, (units, name)) in &self.0 {
            println!("{entry:24} {units:8} {name}");
        }
    }
}

/// The steps of a picture in the plane.
fn look_at(renderer: &mut impl PlaneRenderer, entry: &'static str, name: &str, most: &mut Most) {
    for _ in 0..STEPS {
        let before = renderer.spent();
        let progress = renderer.step(SHARE as usize);
        most.note(entry, name, renderer.spent() - before);
        if progress == Progress::Done {
            return;
        }
    }
}

fn check_plane(drawing: Drawing, name: &str, viewport: Viewport, view: View, most: &mut Most) {
    let drawing = Arc::new(drawing);
    let (mut covering, mut adding) = (Renderer::new(), DensityRenderer::new());
    covering.load(drawing.clone());
    adding.load(drawing.clone());
    for (detail, upto) in [(Detail::Coarse, None), (Detail::Fine, Some(drawing.segment_count() / 2))] {
        let style = Style { ink: Ink::Solid, ..Style::default() };
        covering.begin_with(&style, viewport, view, detail, upto);
        look_at(&mut covering, "Renderer::step", name, most);
        let style = Style { ink: Ink::Density, ..Style::default() };
        adding.begin_with(&style, viewport, view, detail, upto);
        look_at(&mut adding, "DensityRenderer::step", name, most);
    }
    let at = [f64::from(viewport.width) / 2.0, f64::from(viewport.height) / 2.0];
    let _ = pick(&drawing, viewport, view, &Pointer { at, tolerance: 8.0, upto: None, visits: 20_000 });
}

fn check_space(drawing: Drawing<Solid>, name: &str, viewport: Viewport, zoom: f64, most: &mut Most) {
    let drawing = Arc::new(drawing);
    let camera = Camera { zoom, ..Camera::default() };
    let mut renderer = SolidRenderer::new();
    renderer.load(drawing.clone());
    for (quality, upto) in [(Quality::MOVING, None), (Quality::FINEST, Some(drawing.segment_count() / 2))] {
        renderer.play(upto);
        renderer.begin(&Style::default(), viewport, &camera, quality);
        for _ in 0..STEPS {
            let before = renderer.spent();
            let progress = renderer.step(SHARE as usize);
            most.note("SolidRenderer::step", name, renderer.spent() - before);
            if progress == Progress::Done {
                break;
            }
        }
    }
    let at = [f64::from(viewport.width) / 2.0, f64::from(viewport.height) / 2.0];
    let _ = pick_solid(&drawing, viewport, &camera, &Pointer { at, tolerance: 8.0, upto: None, visits: 20_000 });
}

fn check(case: &Case, n: u32, viewport: Viewport, zoom: f64, most: &mut Most) {
    let name = format!("{} n {n} {}x{} zoom {zoom}", case.name, viewport.width, viewport.height);
    let system = case.system();
    if system.is_solid() {
        if let Ok(drawing) = draw_solid(&system, n, &LIMITS) {
            check_space(drawing, &name, viewport, zoom, most);
        }
    } else if let Ok(drawing) = draw(&system, n, &LIMITS) {
        check_plane(drawing, &name, viewport, View { zoom, ..View::default() }, most);
    }
}

const ORDINARY: Viewport = Viewport { width: 160, height: 100, ratio: 1.0 };

#[test]
#[ignore = "takes minutes, and its bounds are not settled yet"]
fn no_step_of_a_picture_exceeds_its_share_by_more_than_a_piece() {
    let mut most = Most::default();
    for length in &LENGTHS[..3] {
        for case in cases(*length) {
            for n in GENERATIONS.into_iter().filter(|&n| *length <= 100 || n <= 12) {
                check(&case, n, ORDINARY, 1.0, &mut most);
            }
        }
    }
    most.print();
}

#[test]
#[ignore = "takes minutes, and its bounds are not settled yet"]
fn no_step_of_a_picture_of_the_longest_texts_does() {
    let mut most = Most::default();
    for case in cases(LONGEST) {
        if ["axiom", "successor", "polygons", "styles", "space"].iter().any(|kind| case.name.starts_with(kind)) {
            check(&case, 1, ORDINARY, 1.0, &mut most);
        }
    }
    most.print();
}

#[test]
#[ignore = "takes minutes, and its bounds are not settled yet"]
fn no_step_of_an_odd_view_does() {
    let mut most = Most::default();
    let sizes = [(1, 1), (17, 17), (4096, 2048), (32_768, 2)];
    for case in cases(100) {
        for (width, height) in sizes {
            for zoom in [1.0, 1e25, f64::NAN] {
                check(&case, 12, Viewport { width, height, ratio: 1.0 }, zoom, &mut most);
            }
        }
    }
    most.print();
}
