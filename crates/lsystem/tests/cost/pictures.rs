//! The cost of the steps of pictures.

use super::systems::{Case, LENGTHS, LONGEST, cases, generations};
use lsystem::base::Meter;
use lsystem::render::{Detail, Pointer, Quality};
use lsystem::syntax::Ink;
use lsystem::{
    Camera, Drawing, Figure, Limits, Plane, Progress, Renderer, Solid, SolidRenderer, Style, View, Viewport, draw, pick,
};
use std::collections::BTreeMap;
use std::sync::Arc;
use test_effort::{is_thorough, sampled};

/// The units of work of a step, as in the page.
const SHARE: u64 = 16_384;
/// The most steps tested of a picture, because pictures of a million segments take too long for a test.
const STEPS: usize = 60;
/// The limits of the page, but with more memory, and with less work to find that a drawing is too large.
const LIMITS: Limits =
    Limits { symbols: 64 << 20, modules: 16 << 20, segments: u32::MAX as u64, work: 2_000_000, memory: 112 << 20 };

/// The largest step of each entry point, with the picture's name.
#[derive(Default)]
struct Most {
    steps: BTreeMap<&'static str, (u64, String)>,
    drawings: usize,
}

impl Most {
    /// Adds a step, which may exceed its share by one piece.
    fn note(&mut self, entry: &'static str, name: &str, units: u64) {
        assert!(units <= SHARE + Meter::PIECE, "{entry}, {name}: {units} units in one step");
        let most = self.steps.entry(entry).or_default();
        if units > most.0 {
            *most = (units, name.to_owned());
        }
    }

    fn print(&self) {
        for (entry, (units, name)) in &self.steps {
            println!("{entry:24} {units:8} {name}");
        }
    }
}

/// The steps of a picture in the plane.
fn look_at(renderer: &mut Renderer, entry: &'static str, name: &str, most: &mut Most) {
    for _ in 0..STEPS {
        let before = renderer.spent();
        let progress = renderer.step(SHARE as usize);
        most.note(entry, name, renderer.spent() - before);
        if progress == Progress::Done {
            return;
        }
    }
}

fn check_plane(drawing: &Arc<Drawing>, name: &str, viewport: Viewport, view: View, most: &mut Most) {
    let [mut covering, mut adding, mut shading] = [(); 3].map(|()| Renderer::new());
    for renderer in [&mut covering, &mut adding, &mut shading] {
        renderer.load(drawing.clone());
    }
    for (detail, upto) in [(Detail::Coarse, None), (Detail::Fine, Some(drawing.segment_count() / 2))] {
        let style = Style { ink: Ink::Solid, ..Style::default() };
        covering.begin_with(&style, viewport, view, detail, upto);
        look_at(&mut covering, "Renderer::step", name, most);
        let style = Style { ink: Ink::Density, ..Style::default() };
        adding.begin_with(&style, viewport, view, detail, upto);
        look_at(&mut adding, "Renderer::step, density", name, most);
        shading.begin_with(&Style::default(), viewport, view, detail, upto);
        look_at(&mut shading, "Renderer::step, shaded", name, most);
    }
    let at = [f64::from(viewport.width) / 2.0, f64::from(viewport.height) / 2.0];
    let pointer = Pointer { at, tolerance: 8.0, upto: None, visits: 20_000 };
    let _ = pick(&Figure::Plane(drawing.clone()), viewport, &view.into(), &pointer);
}

fn check_space(drawing: &Arc<Drawing<Solid>>, name: &str, viewport: Viewport, zoom: f64, most: &mut Most) {
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
    let pointer = Pointer { at, tolerance: 8.0, upto: None, visits: 20_000 };
    let _ = pick(&Figure::Space(drawing.clone()), viewport, &camera.into(), &pointer);
}

/// Pictures of one drawing in several sizes and magnifications.
fn check(case: &Case, n: u32, views: &[(Viewport, f64)], most: &mut Most) {
    let system = case.system();
    let name = |viewport: &Viewport, zoom: f64| {
        format!("{} n {n} {}x{} zoom {zoom}", case.name, viewport.width, viewport.height)
    };
    if system.is_solid() {
        let Ok(drawing) = draw::<Solid>(&system, n, &LIMITS).map(Arc::new) else { return };
        for (viewport, zoom) in views {
            check_space(&drawing, &name(viewport, *zoom), *viewport, *zoom, most);
        }
    } else {
        let Ok(drawing) = draw::<Plane>(&system, n, &LIMITS).map(Arc::new) else { return };
        for (viewport, zoom) in views {
            check_plane(&drawing, &name(viewport, *zoom), *viewport, View { zoom: *zoom, ..View::default() }, most);
        }
    }
    most.drawings += 1;
}

const ORDINARY: Viewport = Viewport { width: 160, height: 100, ratio: 1.0 };

#[test]
fn no_step_of_a_picture_exceeds_its_share_by_more_than_a_piece() {
    let mut most = Most::default();
    for (number, length) in LENGTHS[..3].iter().enumerate() {
        for case in sampled(cases(*length), 3, number) {
            for &n in generations(*length).iter().filter(|&&n| *length <= 100 || n <= 12) {
                check(&case, n, &[(ORDINARY, 1.0)], &mut most);
            }
        }
    }
    most.print();
    assert!(most.drawings > 30);
}

#[test]
fn no_step_of_a_picture_of_the_longest_texts_does() {
    let mut most = Most::default();
    for case in cases(LONGEST) {
        if ["axiom", "successor", "polygons", "styles", "space"].iter().any(|kind| case.name.starts_with(kind)) {
            for n in [0, 1] {
                check(&case, n, &[(ORDINARY, 1.0)], &mut most);
            }
        }
    }
    most.print();
    assert!(most.drawings > 5);
}

#[test]
fn no_step_of_an_odd_view_does() {
    let mut most = Most::default();
    let sizes = [(1, 1), (17, 17), (4096, 2048), (32_768, 2)];
    let all = sizes.iter().flat_map(|&(width, height)| [1.0, 1e25, f64::NAN].map(|zoom| (width, height, zoom)));
    let views: Vec<_> = all.map(|(width, height, zoom)| (Viewport { width, height, ratio: 1.0 }, zoom)).collect();
    for (at, case) in cases(100).iter().enumerate() {
        // Each system gets some of the views; neighbouring systems get different ones.
        let step = if is_thorough() { 1 } else { 5 };
        let some: Vec<_> = views.iter().copied().skip(at % step).step_by(step).collect();
        check(case, 12, &some, &mut most);
    }
    most.print();
}
