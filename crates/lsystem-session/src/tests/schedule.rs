//! What is shown when.

use super::{Bench, Refused, VIEWPORT, bush, random, weed};
use crate::STEP;
use crate::pace::REFINING;
use lsystem::render::{Detail, Quality, opening_camera};
use lsystem::{Camera, Figure, Limits, Progress, Renderer, SolidRenderer, System, View, Viewport};

/// The finest picture of the fitted view, by a renderer alone.
fn finest(definition: &lsystem::Definition) -> Vec<u8> {
    let system = System::new(definition).unwrap();
    let mut drawer = Figure::drawer(&system, definition.iterations, Limits::PAGE);
    while drawer.step(1 << 20) == Progress::More {}
    match drawer.finish().unwrap() {
        Figure::Plane(drawing) => {
            let mut renderer = Renderer::new();
            renderer.load(drawing);
            renderer.begin_with(&system.style, VIEWPORT, View::default(), Detail::Fine, None);
            while renderer.step(1 << 20) == Progress::More {}
            renderer.pixels().to_vec()
        }
        figure @ Figure::Space(_) => {
            let camera = opening_camera(&figure);
            let Figure::Space(drawing) = figure else { return vec![] };
            let mut renderer = SolidRenderer::new();
            renderer.load(drawing);
            renderer.begin(&system.style, VIEWPORT, &camera, Quality::FINEST);
            while renderer.step(1 << 20) == Progress::More {}
            renderer.pixels().to_vec()
        }
    }
}

/// Whether each picture is complete.
fn complete(bench: &mut Bench) -> Vec<bool> {
    bench.settle().0.iter().map(|drawn| drawn.complete).collect()
}

#[test]
fn a_quick_picture_in_the_plane_is_fine_at_once() {
    let mut bench = Bench::with(&weed(5), 0.0);
    assert_eq!(complete(&mut bench), [true]);
    assert_eq!(bench.screen.pixels(), finest(&weed(5)));
    bench.session.look(VIEWPORT, View::default(), None);
    assert_eq!(complete(&mut bench), [true], "an equal view gets a new picture");
    assert_eq!(complete(&mut bench), [false; 0], "a picture at rest stays");
}

#[test]
fn a_slow_picture_in_the_plane_is_coarse_first_and_fine_after_rest() {
    let mut bench = Bench::with(&random(15), STEP);
    while bench.session.step().unwrap().drawn.is_none() {}
    assert_eq!(bench.screen.0.borrow().size, [80, 60], "half the width and height");
    assert_eq!(complete(&mut bench), [true]);
    assert_eq!(bench.screen.pixels(), finest(&random(15)));
    // The next pictures are coarse at once, and one fine picture is tried after them.
    bench.tick(0.0);
    let first_pictures: Vec<bool> = (0..6)
        .map(|_| {
            bench.session.look(VIEWPORT, View::default(), None);
            loop {
                let answer = bench.session.step().unwrap();
                if let Some(drawn) = answer.drawn {
                    break drawn.complete;
                }
            }
        })
        .collect();
    assert_eq!(first_pictures, [false, false, false, false, true, true]);
}

#[test]
fn a_picture_in_space_is_refined_in_two_steps() {
    let mut bench = Bench::with(&bush(5), 0.01);
    let (pictures, _) = bench.settle();
    let stages: Vec<(bool, bool)> = pictures.iter().map(|drawn| (drawn.moving, drawn.complete)).collect();
    assert_eq!(stages, [(true, false), (false, false), (false, true)]);
    assert_eq!(bench.screen.pixels(), finest(&bush(5)));
}

#[test]
fn late_pictures_in_space_have_fewer_pixels_until_the_drawing_rests() {
    let mut bench = Bench::with(&bush(6), 4.0);
    let mut turned = |degrees: f64| {
        let camera = Camera { azimuth: degrees, ..Camera::default() };
        bench.session.look(VIEWPORT, View::default(), Some(camera));
        while bench.session.step().unwrap().drawn.is_none() {}
        bench.screen.0.borrow().size
    };
    let sizes: Vec<[u32; 2]> = (1..8).map(|turn| turned(f64::from(turn))).collect();
    assert_eq!(sizes[..2], [[160, 120]; 2], "one late picture may be an accident");
    assert!(sizes.contains(&[80, 60]), "{sizes:?}");
    let (pictures, _) = bench.settle();
    assert!(pictures.last().unwrap().complete);
    assert_eq!(bench.screen.0.borrow().size, [160, 120]);
}

#[test]
fn a_newer_view_supersedes_an_older_one() {
    let near = View { zoom: 3.0, ..View::default() };
    let mut right = Bench::with(&random(15), 0.0);
    right.session.look(VIEWPORT, near, None);
    right.settle();
    let mut bench = Bench::with(&random(15), 3.0);
    bench.build();
    assert!(bench.session.step().unwrap().drawn.is_none(), "the picture is in the making");
    bench.session.look(VIEWPORT, near, None);
    let (pictures, _) = bench.settle();
    assert_eq!(bench.screen.pixels(), right.screen.pixels());
    assert!(pictures.iter().all(|drawn| drawn.scale == pictures[0].scale), "{pictures:?}");
    assert!(pictures.len() <= 2 && pictures.last().unwrap().complete);
}

#[test]
fn a_newer_definition_supersedes_an_older_one() {
    let mut bench = Bench::with(&random(16), STEP);
    assert!(!bench.session.step().unwrap().idle && !bench.session.built(), "the drawing is in the making");
    bench.session.define(weed(4));
    let (_, report) = bench.settle();
    assert_eq!(report.unwrap().segments.unwrap(), "625");
    assert_eq!(bench.screen.pixels(), finest(&weed(4)));
}

#[test]
fn an_edit_of_the_style_keeps_the_drawing() {
    let mut bench = Bench::with(&weed(4), 0.0);
    bench.settle();
    let mut dark = weed(4);
    dark.style.background.rgb = [0, 0, 64];
    let report = bench.session.define(dark.clone()).into_owned();
    assert!(bench.session.built() && report.memoised == Some(true), "{report:?}");
    bench.settle();
    assert_eq!(bench.screen.pixels(), finest(&dark));
    assert_ne!(bench.screen.pixels(), finest(&weed(4)));
}

#[test]
fn a_mistake_keeps_the_last_good_drawing() {
    let mut bench = Bench::with(&weed(4), 0.0);
    bench.settle();
    let report = bench.session.define(super::definition("F", "F = FF", 20.0, 3)).into_owned();
    assert!(!report.ok && !report.diagnostics.is_empty());
    assert!(bench.session.step().unwrap().idle);
    assert_eq!(bench.session.string(1, 0, 99).text.unwrap(), "F[+F]F[-F]F");
}

/// Works until the session is idle. Checks that no step takes more than its share and one piece of work. Returns the
/// number of steps that used up their share.
fn steps_in_time(bench: &mut Bench, tick: f64) -> usize {
    // The most looks at the clock between two ends of pieces.
    const LOOKS: f64 = 4.0;
    let (mut full, mut refines) = (0, false);
    loop {
        let before = bench.hand.now.get();
        let answer = bench.session.step().unwrap();
        let (idle, drawn) = (answer.idle, answer.drawn);
        let taken = bench.hand.now.get() - before;
        let share = if refines { REFINING } else { STEP };
        assert!(taken <= share + LOOKS * tick, "{taken} ms of {share}");
        full += usize::from(taken >= share);
        refines = (refines || drawn.is_some()) && !idle && drawn.is_none_or(|drawn| !drawn.complete && !drawn.moving);
        if idle {
            return full;
        }
    }
}

#[test]
fn steps_end_in_time_whatever_they_do() {
    let tick = 0.5;
    // A large drawing with a slow picture, a quick one, and pictures in space.
    for (definition, least) in [(random(17), 4), (weed(4), 0), (bush(7), 2)] {
        let mut bench = Bench::with(&definition, tick);
        let full = steps_in_time(&mut bench, tick);
        assert!(full >= least, "{}: {full} steps used up their share", definition.rules);
    }
}

#[test]
fn a_small_canvas_gets_no_picture() {
    let mut bench = Bench::with(&weed(4), 0.0);
    bench.session.look(Viewport { width: 0, height: 100, ratio: 1.0 }, View::default(), None);
    let (pictures, report) = bench.settle();
    assert_eq!((pictures, report.unwrap().memoised), (vec![], Some(true)));
}

#[test]
fn a_part_of_the_drawing_has_the_pose_of_the_turtle() {
    let mut bench = Bench::with(&weed(2), 0.0);
    let (pictures, _) = bench.settle();
    assert_eq!(pictures[0].pose, None);
    for upto in [0, 1] {
        bench.session.play(Some(upto));
        let pose = bench.settle().0[0].pose.clone().unwrap();
        assert_eq!(pose.at[0], 0.0);
        assert_eq!(pose.at[1], upto as f64);
    }
    bench.session.play(Some(1));
    assert!(bench.session.step().unwrap().idle, "the same part");
}

#[test]
fn a_canvas_that_refuses_a_picture_can_be_tried_again() {
    let mut bench = Bench::with(&weed(4), 0.0);
    bench.screen.0.borrow_mut().refuses = true;
    assert_eq!(bench.session.step().unwrap_err(), Refused);
    bench.screen.0.borrow_mut().refuses = false;
    bench.session.look(VIEWPORT, View::default(), None);
    assert_eq!(complete(&mut bench), [true]);
}

#[test]
fn drawings_in_a_held_frame_grow_from_the_ground() {
    let height = |bench: &Bench| {
        let pixels = bench.screen.pixels();
        let rows = pixels.chunks(4 * VIEWPORT.width as usize);
        let inked = rows.enumerate().filter(|(_, row)| row.chunks(4).any(|pixel| pixel != &pixels[..4]));
        let inked: Vec<usize> = inked.map(|(at, _)| at).collect();
        (inked.len(), inked.last().copied())
    };
    for (small, large) in [(weed(3), weed(4)), (bush(5), bush(6))] {
        let mut bench = Bench::with(&large, 0.0);
        bench.settle();
        let (whole, ground) = height(&bench);
        let picture = bench.screen.pixels();
        bench.session.hold(true);
        bench.session.define(small);
        bench.settle();
        let (part, root) = height(&bench);
        assert!(part < whole && root.unwrap().abs_diff(ground.unwrap()) <= 2, "{part} of {whole}, {root:?} {ground:?}");
        assert!(bench.session.pick(80.0, 60.0, 1e3).segment.is_none());
        bench.session.define(large);
        bench.settle();
        assert_eq!(bench.screen.pixels(), picture, "the last frame is the fitted picture");
        bench.session.hold(false);
        bench.settle();
        assert!(bench.session.pick(80.0, 60.0, 1e3).segment.is_some());
    }
}

/// The page starts an own look with what an automatic look chose, so the width is one that people can read.
#[test]
fn an_automatic_look_reports_the_width_that_is_drawn() {
    let auto = |rgb: [u8; 3]| {
        let mut definition = weed(4);
        (definition.style.auto, definition.style.palette) = (true, vec![lsystem::syntax::Colour { rgb }]);
        definition
    };
    let mut bench = Bench::with(&auto([0, 255, 0]), 0.0);
    let width = bench.settle().1.unwrap().look.unwrap().width;
    assert!((0.01..100.0).contains(&width), "{width}");
    assert_eq!(format!("{width}").trim_start_matches(['0', '.']).replace('.', "").len(), 3, "{width}");
    // The drawing stays when only colours change, and with it the width.
    let again = bench.session.define(auto([0, 0, 255])).look.as_ref().unwrap().width;
    assert_eq!(again, width);
}
