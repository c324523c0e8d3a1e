use super::camera::Lens;
use super::light::LIGHT;
use super::scene::Scene;
use super::*;
use crate::figure_renderer::tests::paint;
use crate::{FigureRenderer, Pass, PictureOptions, Vantage, Viewport, fitted_ends, fitted_scale};
use lsystem_base::{Limits, Meter, Progress};
use lsystem_drawing::rotation::{Vector, dot};
use lsystem_drawing::{Drawing, Figure, Solid, System, draw};
use lsystem_syntax::{Colour, ColourBy, Definition, Dialect, Ink, Style};
use std::sync::Arc;
use test_effort::sampled;

pub(super) const SIZE: Viewport = Viewport { width: 160, height: 120, ratio: 1.0 };

pub(super) fn system(dialect: Dialect, axiom: &str, rules: &str, angle: f64) -> System {
    let definition =
        Definition { dialect, axiom: axiom.to_owned(), rules: rules.to_owned(), angle, ..Definition::default() };
    System::new(&definition).unwrap()
}

/// Practical 1, where branches pitch and roll.
pub(super) fn tree() -> System {
    system(Dialect::Practical, "T", "T -> TF\nF -> F[+F][-FF][<F][>FF][&F]", 40.0)
}

/// ABOP 1.25 without its leaves.
pub(super) fn bush() -> System {
    system(Dialect::Abop, "A", "A -> [&F!A]/////'[&F!A]///////'[&F!A]\nF -> S/////F\nS -> F", 22.5)
}

/// Branches that become thinner and thicker, with trunks of several strokes.
fn tapering() -> System {
    let mut system = system(Dialect::Abop, "A", "A -> FF!!F[&A][^!!A]#/FA\nF -> FF", 40.0);
    system.turtle.max_width = 0.05;
    system
}

/// ABOP 1.25 with its leaves.
fn leafy_bush() -> System {
    let rules = "A -> [&FL!A]/////'[&FL!A]///////'[&FL!A]\nF -> S/////F\nS -> FL\nL -> ['''^^{-f+f+f-|-f+f+f}]";
    system(Dialect::Abop, "A", rules, 22.5)
}

pub(super) fn drawing(system: &System, n: u32) -> Arc<Drawing<Solid>> {
    Arc::new(draw::<Solid>(system, n, &Limits::default()).unwrap())
}

pub(super) fn picture(
    drawing: &Arc<Drawing<Solid>>,
    style: &Style,
    viewport: Viewport,
    camera: &Camera,
    quality: Quality,
    work: usize,
) -> Vec<u8> {
    let mut renderer = SolidRenderer::new();
    renderer.load(drawing.clone());
    renderer.begin(style, viewport, camera, quality);
    while renderer.step(work) == Progress::More {}
    renderer.pixels().to_vec()
}

/// The point where a line of sight meets a stroke: its depth, its normal, and its place along the stroke (0 to 1).
fn meet(ends: [Vector; 2], radii: [f64; 2], [x, y]: [f64; 2]) -> Option<(f64, Vector, f64)> {
    let [a, b] = ends;
    let way = [0, 1, 2].map(|i| b[i] - a[i]);
    let flat = (way[0] * way[0] + way[1] * way[1]).sqrt();
    let ball = |end: usize| {
        let [dx, dy] = [x - ends[end][0], y - ends[end][1]].map(|d| d / radii[end]);
        let rest = 1.0 - dx * dx - dy * dy;
        (rest >= 0.0).then(|| (ends[end][2] - radii[end] * rest.sqrt(), [dx, dy, -rest.sqrt()], end as f64))
    };
    let length = dot(way, way).sqrt();
    if flat <= 1e-3 * length || flat < 1e-6 {
        return ball(usize::from(b[2] < a[2]));
    }
    // The point of the axis that is nearest in the picture, and the side's bulge there.
    let along = ((x - a[0]) * way[0] + (y - a[1]) * way[1]) / flat;
    let sideways = ((y - a[1]) * way[0] - (x - a[0]) * way[1]) / flat;
    let radius = radii[0] + (radii[1] - radii[0]) * (along / flat).clamp(0.0, 1.0);
    let u = sideways / radius;
    if u.abs() > 1.0 {
        return None;
    }
    let h = (1.0 - u * u).sqrt();
    let met = along - radius * h * way[2] / length;
    if met < 0.0 || met > flat {
        return ball(usize::from(met > 0.0));
    }
    // The normal is at right angles to the axis: sideways, and up to the viewer.
    let [ex, ey] = [way[0] / flat, way[1] / flat];
    let up = [ex * way[2] / length, ey * way[2] / length, -flat / length];
    let normal = [h * up[0] - u * ey, h * up[1] + u * ex, h * up[2]];
    Some((a[2] + along / flat * way[2] - radius * h * length / flat, normal, met / flat))
}

/// The picture by definition: every segment against every sample, in double precision.
fn naive(drawing: &Drawing<Solid>, style: &Style, viewport: Viewport, camera: &Camera) -> Vec<u8> {
    naive_until(drawing, style, viewport, camera, usize::MAX)
}

/// As [`naive`], of the first `upto` segments.
fn naive_until(drawing: &Drawing<Solid>, style: &Style, viewport: Viewport, camera: &Camera, upto: usize) -> Vec<u8> {
    let lens = Lens::new(drawing, viewport, camera, 4.0);
    let (width, height) = (viewport.width as usize * 4, viewport.height as usize * 4);
    let paper = style.background.rgb.map(f64::from);
    let mut samples = vec![(f64::INFINITY, paper); width * height];
    let unit = drawing.unit();
    for (number, segment) in drawing.segments().enumerate().take(upto) {
        let seen = [segment.from, segment.to].map(|p| {
            let p = [0, 1, 2].map(|i| (p[i] - drawing.start[i]) / unit);
            [0, 1, 2].map(|i| lens.origin[i] + (0..3).map(|axis| lens.axes[axis][i] * p[axis]).sum::<f64>())
        });
        let ends = seen.map(|p| lens.project(p));
        let hairline = style.min_width.max(1.0) * viewport.ratio * 2.0;
        let width_of =
            |p: Vector, width: f64| width / drawing.step.abs() * lens.step / 2.0 / (1.0 + p[2] * lens.nearness);
        let widths = [segment.width, segment.end_width];
        let radii = [0, 1].map(|end| width_of(seen[end], widths[end]).max(hairline));
        let place = (number as f64 + 0.5) / drawing.segment_count() as f64;
        let tint = lsystem_syntax::Tint { index: segment.colour, level: segment.level, place };
        let ink = style.colour_of(tint).rgb.map(f64::from);
        let reach = |axis: usize, side: usize| {
            let radius = radii[0].max(radii[1]) + 1.0;
            let low = (ends[0][axis].min(ends[1][axis]) - radius).clamp(0.0, side as f64);
            low as usize..(ends[0][axis].max(ends[1][axis]) + radius).clamp(0.0, side as f64) as usize
        };
        let lean = |row: usize| 0.5 + [-0.375, 0.125, -0.125, 0.375][row % 4];
        for y in reach(1, height) {
            for x in reach(0, width) {
                let Some((depth, normal, t)) = meet(ends, radii, [x as f64 + lean(y), y as f64 + 0.5]) else {
                    continue;
                };
                let sample = &mut samples[y * width + x];
                if depth < sample.0 {
                    let spot = seen.map(|p| [0, 1, 2].map(|i| (p[i] - lens.centre[i]) / lens.radius));
                    *sample = (depth, lit(style, camera, ink, spot, t, normal));
                }
            }
        }
    }
    let mut pixels = Vec::new();
    for y in 0..viewport.height as usize {
        for x in 0..viewport.width as usize {
            let all = (0..16).map(|i| samples[(y * 4 + i / 4) * width + x * 4 + i % 4].1);
            let sum = all.fold([0.0; 3], |sum, colour| [0, 1, 2].map(|i| sum[i] + colour[i]));
            pixels.extend(sum.map(|c| (c / 16.0).round() as u8));
            pixels.push(u8::MAX);
        }
    }
    pixels
}

/// The definition of the light, with the numbers written out.
fn lit(style: &Style, camera: &Camera, ink: [f64; 3], spot: [Vector; 2], t: f64, normal: Vector) -> [f64; 3] {
    let mix = |of: &dyn Fn(Vector) -> f64| of(spot[0]) + t * (of(spot[1]) - of(spot[0]));
    let facing = mix(&|p| 0.3 * dot(p, LIGHT).clamp(-1.0, 1.0));
    let open = mix(&|p| 1.0 - 0.25 * (1.0 - dot(p, p).min(1.0)));
    let haze = mix(&|p| {
        let depth = (0.5 + 0.5 * p[2]).clamp(0.0, 1.0);
        camera.fade * depth * (0.55 + 0.4 * depth)
    });
    let wrap = 0.5 + 0.5 * (0.7 * dot(normal, LIGHT) + facing);
    let [r, g, b] = style.background.rgb.map(f64::from);
    let edge = if 0.3 * r + 0.59 * g + 0.11 * b < 110.0 { 0.42 } else { -0.3 };
    let strength = (0.54 + 0.9 * wrap * wrap) * open * (1.0 + edge * (1.0 + normal[2]) * (1.0 + normal[2]));
    let paper = style.background.rgb.map(f64::from);
    [0, 1, 2].map(|i| {
        let own = ink[i] * strength + 255.0 * 0.16 * libm::pow(wrap, 8.0) * open;
        (own + (paper[i] - own) * haze).min(255.0)
    })
}

/// The mean difference of two pictures over all channels, and the part of the pixels that differ by more than `by`.
fn difference(a: &[u8], b: &[u8], by: u8) -> (f64, f64) {
    let sum: u64 = a.iter().zip(b).map(|(a, b)| u64::from(a.abs_diff(*b))).sum();
    let far = a.chunks(4).zip(b.chunks(4)).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > by));
    (sum as f64 / a.len() as f64, far.count() as f64 / (a.len() / 4) as f64)
}

fn cameras() -> [Camera; 4] {
    let usual = Camera::default();
    [
        usual,
        Camera { perspective: false, azimuth: -70.0, elevation: 40.0, ..usual },
        Camera { zoom: 3.0, target: [0.1, 0.15, -0.1], azimuth: 200.0, fade: 0.8, ..usual },
        Camera { elevation: -90.0, azimuth: 10.0, ..usual },
    ]
}

/// Styles without shadows.
fn styles() -> [Style; 3] {
    let dark = Colour { rgb: [12, 16, 24] };
    let plain = Style { shadows: false, ..Style::default() };
    [
        Style { width: 0.25, colour_by: ColourBy::Level, ..plain.clone() },
        Style { background: dark, min_width: 2.0, ..plain.clone() },
        Style { width: 0.25, colour_by: ColourBy::Path, ..plain },
    ]
}

/// The same styles with shadows and without.
fn all_styles() -> Vec<Style> {
    let lit = styles().map(|style| Style { shadows: true, ..style });
    [styles(), lit].concat()
}

/// The number of pixels that show ink.
fn inked(pixels: &[u8], style: &Style) -> f64 {
    let paper = style.background.rgb.map(i32::from);
    let is_ink = |pixel: &&[u8]| pixel.iter().zip(paper).any(|(&a, b)| (i32::from(a) - b).abs() > 24);
    pixels.chunks(4).filter(is_ink).count() as f64
}

/// Fewer and larger leaves stand for all, whatever the budget.
#[test]
fn a_moving_crown_has_the_ink_of_a_crown_at_rest() {
    let drawing = drawing(&leafy_bush(), 7);
    let style = Style { shadows: false, ..Style::default() };
    let viewport = Viewport { width: 480, height: 360, ratio: 1.0 };
    let ink = |quality| inked(&picture(&drawing, &style, viewport, &Camera::default(), quality, 10_000), &style);
    let rest = ink(Quality::FINEST);
    for quality in [0, 4, 8, Quality::MOVING.0] {
        let part = ink(Quality(quality)) / rest;
        assert!((0.85..1.15).contains(&part), "{part} at {quality}");
    }
}

/// Large leaves that hide each other are no crowd.
#[test]
fn leaves_at_rest_are_those_of_a_file() {
    let rules = "A(l) -> F(l)[&(11)/(36)A(l*0.81)]/(137.5)[&(52)/(119)A(l*0.74)]/(137.5)[&(26)/(99)A(l*0.76)]\
        /(137.5)[&(43)/(88)A(l*0.6)]\ndraw:\nA(l) -> F(l*0.6)[&(38)L(l*1.81)]/(120)[&(62)L(l*1.81)]/(120)[&(50)L(l*1.81)]";
    let definition = Definition {
        dialect: Dialect::Abop,
        axiom: "F(11)A(35)".to_owned(),
        rules: rules.to_owned(),
        overrides: "L: leaf heart 1".to_owned(),
        ..Definition::default()
    };
    let drawing = drawing(&System::new(&definition).unwrap(), 5);
    let style = Style { shadows: false, ..Style::default() };
    let viewport = Viewport { width: 1280, height: 720, ratio: 1.0 };
    let pictures = [Quality::FINEST, Quality::BEST]
        .map(|quality| picture(&drawing, &style, viewport, &Camera::default(), quality, 10_000));
    let others = pictures[0].chunks(4).zip(pictures[1].chunks(4)).filter(|(screen, file)| screen != file).count();
    assert!(others * 50 < 1280 * 720, "{others} pixels");
}

/// Moving pictures have no shadows, but are as dark as the last picture at rest.
#[test]
fn a_moving_crown_is_as_dark_as_at_rest() {
    let style = Style::default();
    let viewport = Viewport { width: 480, height: 360, ratio: 1.0 };
    let mut renderer = SolidRenderer::new();
    renderer.load(drawing(&leafy_bush(), 7));
    let mut mean = |quality| {
        renderer.begin(&style, viewport, &Camera::default(), quality);
        while renderer.step(10_000) == Progress::More {}
        // The shade on the ground is lighter than any leaf.
        let leaves = renderer.pixels().chunks(4).filter(|pixel| pixel[1] < 160);
        let (sum, count) = leaves.fold((0.0, 0.0), |(sum, count), pixel| (sum + f64::from(pixel[1]), count + 1.0));
        sum / count
    };
    let [before, rest, after] = [Quality::MOVING, Quality::FINEST, Quality::MOVING].map(&mut mean);
    assert!((after - rest).abs() < (before - rest).abs(), "{before}, {rest}, {after}");
}

/// No stroke is left out. Pictures may differ by rounding, and in which of two equally deep strokes is in front.
/// Rounding moves an edge by much less than a sample, a sixteenth of a pixel's colour.
#[test]
fn pictures_are_true_where_all_is_looked_into() {
    for (system, n) in [(tree(), 2), (bush(), 4), (tapering(), 3)] {
        for mut style in styles() {
            style.width = style.width.min(if n == 2 { 0.25 } else { 1.0 });
            let mut system = system.clone();
            system.turtle.width = style.width;
            let drawing = drawing(&system, n);
            for camera in cameras() {
                let truth = naive(&drawing, &style, SIZE, &camera);
                let seen = picture(&drawing, &style, SIZE, &camera, Quality::FINEST, 1 << 20);
                let (mean, far) = difference(&truth, &seen, 16);
                assert!(mean < 0.15 && far < 0.002, "{camera:?}: mean {mean}, far {far}");
            }
        }
    }
}

/// Blocks are dots of half a pixel: their edges may be off by a quarter of a pixel, and their colours are means. So in
/// a crown, where every pixel has an edge, a pixel may differ by a part of its contrast. On the whole the picture is as
/// bright and as dense as the true picture.
#[test]
fn pictures_of_small_blocks_are_true_on_the_whole() {
    let [level, _, path] = &styles();
    let size = Viewport { width: 96, height: 72, ratio: 1.0 };
    for (system, n) in [(bush(), 7), (tree(), 4)] {
        let mut system = system.clone();
        system.turtle.width = 0.1;
        let drawing = drawing(&system, n);
        for (style, camera) in [level, path].into_iter().flat_map(|style| cameras().map(|camera| (style, camera))) {
            let truth = naive(&drawing, style, size, &camera);
            let seen = picture(&drawing, style, size, &camera, Quality::FINEST, 1 << 20);
            let (mean, far) = difference(&truth, &seen, 48);
            let sum = |pixels: &[u8]| pixels.iter().map(|&c| f64::from(c)).sum::<f64>() / pixels.len() as f64;
            let bias = (sum(&truth) - sum(&seen)).abs();
            assert!(mean < 2.5 && far < 0.02 && bias < 0.6, "{n} {camera:?}: mean {mean}, far {far}, bias {bias}");
        }
    }
}

/// A drawing that is cut anywhere shows its first segments, in the colours of the whole drawing. Shown in full again,
/// the drawing is as before.
#[test]
fn the_first_segments_are_shown_alone() {
    let [level, _, path] = &styles();
    for (style, system, n) in [(level, tree(), 2), (path, tree(), 2), (path, bush(), 4), (level, tapering(), 2)] {
        let mut system = system.clone();
        system.turtle.width = 0.25;
        let drawing = drawing(&system, n);
        let (camera, count) = (cameras()[0], drawing.segment_count());
        let mut renderer = SolidRenderer::new();
        renderer.load(drawing.clone());
        let mut paint = |upto| {
            renderer.play(upto);
            renderer.begin(style, SIZE, &camera, Quality::FINEST);
            while renderer.step(1 << 20) == Progress::More {}
            renderer.pixels().to_vec()
        };
        let whole = paint(None);
        for upto in [0, 1, count / 3, count / 2, count - 1, count] {
            let truth = naive_until(&drawing, style, SIZE, &camera, upto as usize);
            let (mean, far) = difference(&truth, &paint(Some(upto)), 16);
            assert!(mean < 0.15 && far < 0.002, "{upto} of {count}: mean {mean}, far {far}");
        }
        assert_eq!(whole, paint(None));
    }
    // The work of the descent grows with the depth of the drawing.
    let deep = drawing(&bush(), 200);
    let mut renderer = SolidRenderer::new();
    renderer.load(deep.clone());
    renderer.play(Some(deep.segment_count() / 7 * 3));
    renderer.begin(path, SIZE, &Camera::default(), Quality(2));
    while renderer.step(1 << 20) == Progress::More {}
}

/// Pictures are the same however the work is cut into steps, and whatever was painted before.
#[test]
fn pictures_do_not_depend_on_steps() {
    for style in [&styles()[0], &Style::default()] {
        pictures_do_not_depend_on_steps_in(style);
    }
}

fn pictures_do_not_depend_on_steps_in(style: &Style) {
    let camera = Camera::default();
    let big = drawing(&bush(), 9);
    let whole = picture(&big, style, SIZE, &camera, Quality::FINEST, usize::MAX);
    assert_eq!(whole, picture(&big, style, SIZE, &camera, Quality::FINEST, 37));
    let mut renderer = SolidRenderer::new();
    renderer.load(drawing(&tree(), 3));
    for quality in [Quality(0), Quality::FINEST, Quality(4)] {
        renderer.begin(style, SIZE, &Camera { zoom: 2.0, ..camera }, quality);
        renderer.step(5000);
    }
    renderer.load(big);
    renderer.begin(style, SIZE, &camera, Quality::FINEST);
    while renderer.step(1000) == Progress::More {}
    assert_eq!(whole, renderer.pixels());
}

#[test]
fn wide_strokes_are_painted_in_steps() {
    let viewport = Viewport { width: 1920, height: 1080, ratio: 1.0 };
    let drawing = drawing(&system(Dialect::Abop, "F+F{f+f+f}&F[^F]", "F -> FF{f-f-f}", 60.0), 3);
    let style = Style { min_width: 10_000.0, ..Style::default() };
    let all = [(Quality(4), 1.0), (Quality(4), 30.0), (Quality::MOVING, 1.0), (Quality(15), 1.0)];
    for (quality, zoom) in sampled(all, 3, 0) {
        let camera = Camera { zoom, ..Camera::default() };
        let whole = picture(&drawing, &style, viewport, &camera, quality, usize::MAX);
        let mut renderer = SolidRenderer::new();
        renderer.load(drawing.clone());
        renderer.begin(&style, viewport, &camera, quality);
        let mut before = 0;
        while renderer.step(16_384) == Progress::More {
            assert!(renderer.spent() - before <= 16_384 + Meter::PIECE, "{quality:?} {zoom}");
            before = renderer.spent();
        }
        assert!(renderer.pixels() == whole, "{quality:?} {zoom}");
    }
}

/// The picture made pane by pane, in any order and by several renderers, with one budget after the other; and the
/// number of budgets.
fn in_panes(drawing: &Arc<Drawing<Solid>>, style: &Style, viewport: Viewport, camera: &Camera) -> (Vec<u8>, usize) {
    let mut renderers = [SolidRenderer::new(), SolidRenderer::new()];
    renderers.iter_mut().for_each(|renderer| renderer.load(drawing.clone()));
    let mut effort = Effort::new(Quality::FINEST, viewport);
    let width = viewport.width as usize;
    let mut pixels = vec![0; width * viewport.height as usize * 4];
    let mut rounds = 0;
    loop {
        let mut spent = Spent::default();
        for (number, pane) in SolidRenderer::panes(viewport).into_iter().rev().enumerate() {
            let renderer = &mut renderers[number % 2];
            renderer.begin_pane(style, viewport, camera, (pane, Pass::Show), effort.budget());
            while renderer.step(10_000) == Progress::More {}
            spent.add(renderer.effort_spent());
            for (y, row) in renderer.pixels().chunks(pane.width as usize * 4).enumerate() {
                let at = ((pane.y as usize + y) * width + pane.x as usize) * 4;
                pixels[at..at + row.len()].copy_from_slice(row);
            }
        }
        rounds += 1;
        if !effort.is_too_small(spent) {
            return (pixels, rounds);
        }
    }
}

#[test]
fn panes_together_are_the_picture() {
    let viewport = Viewport { width: 560, height: 400, ratio: 1.0 };
    let mut rounds = 0;
    let views =
        [(bush(), 9, Camera::default()), (bush(), 20, Camera { zoom: 3.0, ..cameras()[1] }), (tree(), 3, cameras()[0])];
    for (number, (system, n, camera)) in views.into_iter().enumerate() {
        let drawing = drawing(&system, n);
        for style in sampled(all_styles(), 3, number) {
            let whole = picture(&drawing, &style, viewport, &camera, Quality::FINEST, usize::MAX);
            let (pixels, count) = in_panes(&drawing, &style, viewport, &camera);
            rounds += count;
            assert!(pixels == whole, "n = {n}, {camera:?}");
        }
    }
    assert!(rounds > 8, "some are made again: {rounds}");
}

/// Strokes may be so wide that no tile has work for all of them.
#[test]
fn panes_of_wide_strokes_are_the_picture() {
    let viewport = Viewport { width: 300, height: 270, ratio: 1.0 };
    let camera = Camera::default();
    for min_width in sampled([200.0, 10_000.0], 2, 1) {
        let style = Style { min_width, ..Style::default() };
        for drawing in [drawing(&tree(), 4), drawing(&bush(), 9)] {
            let whole = picture(&drawing, &style, viewport, &camera, Quality::FINEST, usize::MAX);
            assert!(in_panes(&drawing, &style, viewport, &camera).0 == whole, "{min_width}");
        }
    }
}

/// Every tile's work is bounded at any number of segments, also if all segments lie in the same place.
#[test]
fn deep_drawings_end_in_time() {
    for (system, n) in [(tree(), 30), (bush(), 30), (tree(), 300), (bush(), 1000)] {
        let drawing = drawing(&system, n);
        for quality in [Quality(0), Quality(3)] {
            let mut renderer = SolidRenderer::new();
            renderer.load(drawing.clone());
            renderer.begin(&Style::default(), SIZE, &Camera::default(), quality);
            let mut steps = 0;
            while renderer.step(100_000) == Progress::More {
                steps += 1;
                assert!(steps < 400, "n = {n}, {quality:?}: {:?}", renderer.stats());
            }
            let painted = renderer.pixels().chunks(4).filter(|pixel| pixel[..3] != Style::default().background.rgb);
            assert!(painted.count() > 100, "n = {n}, {quality:?}");
        }
    }
}

#[test]
fn strange_cameras_and_drawings_do_no_harm() {
    let strange = [f64::NAN, f64::INFINITY, -1e300, 1e300, 0.0, 1e-300];
    let drawings = [drawing(&tree(), 2), drawing(&system(Dialect::Abop, "f", "", 0.0), 1), drawing(&bush(), 0)];
    for drawing in &drawings {
        for value in strange {
            for camera in [
                Camera { azimuth: value, ..Camera::default() },
                Camera { elevation: value, ..Camera::default() },
                Camera { zoom: value, ..Camera::default() },
                Camera { target: [value, 0.0, value], ..Camera::default() },
                Camera { target: [0.0, 0.0, 0.7], zoom: 9.0, fade: value, ..Camera::default() },
            ] {
                for quality in [Quality(2), Quality::FINEST] {
                    picture(drawing, &Style::default(), SIZE, &camera, quality, 1 << 20);
                }
            }
        }
        let none = Viewport { width: 0, height: 0, ratio: f64::NAN };
        assert!(picture(drawing, &Style::default(), none, &Camera::default(), Quality::FINEST, 1 << 20).is_empty());
    }
}

/// From every side the fitted drawing lies in the picture and fills it, also with perspective and thick strokes.
#[test]
fn the_whole_drawing_is_shown() {
    let style = Style::default();
    let cube = system(Dialect::Abop, "F&F&F/(90)&F^F\\F&F", "", 90.0);
    for (system, n, width, least) in [(bush(), 5, 0.1, 0.45), (tree(), 3, 0.2, 0.45), (cube, 0, 0.6, 0.3)] {
        let mut system = system;
        system.turtle.width = width;
        let drawing = drawing(&system, n);
        for azimuth in [0.0, 45.0, 130.0] {
            for elevation in [-90.0, -30.0, 0.0, 12.0, 60.0, 90.0] {
                for perspective in [true, false] {
                    let camera = Camera { azimuth, elevation, perspective, ..Camera::default() };
                    let pixels = picture(&drawing, &style, SIZE, &camera, Quality(3), 1 << 20);
                    let painted =
                        |x: u32, y: u32| pixels[((y * SIZE.width + x) * 4) as usize..][..3] != style.background.rgb;
                    let edge = (0..SIZE.width).any(|x| painted(x, 0) || painted(x, SIZE.height - 1))
                        || (0..SIZE.height).any(|y| painted(0, y) || painted(SIZE.width - 1, y));
                    assert!(!edge, "{camera:?}");
                    let rows: Vec<u32> = (0..SIZE.height).filter(|&y| (0..SIZE.width).any(|x| painted(x, y))).collect();
                    let tall = f64::from(rows.last().unwrap() - rows[0]) / f64::from(SIZE.height);
                    let columns = (0..SIZE.width).filter(|&x| (0..SIZE.height).any(|y| painted(x, y))).count();
                    let wide = columns as f64 / f64::from(SIZE.width);
                    assert!(tall.max(wide) > least, "{camera:?}: {wide} {tall}");
                }
            }
        }
    }
}

/// A straight line of any number of segments is red at its foot and blue at its top.
#[test]
fn colours_go_along_the_path() {
    let ends = [[255, 0, 0], [0, 0, 255]].map(|rgb| Colour { rgb });
    let style = Style { palette: ends.to_vec(), colour_by: ColourBy::Path, ..Style::default() };

    for n in [5, 9, 40, 1000] {
        let line = drawing(&system(Dialect::Abop, "F/(90)", "F -> FF", 20.0), n);
        let pixels = picture(&line, &style, SIZE, &Camera::default(), Quality::FINEST, 1 << 20);
        let colours = |row: u32| {
            let row = &pixels[(row * SIZE.width * 4) as usize..][..(SIZE.width * 4) as usize];
            let inked = row.chunks(4).min_by_key(|pixel| pixel[1]).unwrap();
            [i32::from(inked[0]), i32::from(inked[2])]
        };
        let [top, middle, foot] = [25, SIZE.height / 2, SIZE.height - 25].map(colours);
        let blend = (middle[0] - middle[1]).abs();
        assert!(top[1] > top[0] + 40 && foot[0] > foot[1] + 40 && blend < 20, "{n}: {top:?} {middle:?} {foot:?}");
    }
}

/// A filled square covers its area from every side; a square of half the side covers a quarter.
#[test]
fn polygons_are_filled() {
    let style = Style::default();
    for (axiom, factor, part) in [("F{f+f+f+f}", 1.0, 1.0), ("F[{f+f+f+f}]", 0.5, 0.25)] {
        let definition =
            Definition { axiom: axiom.into(), angle: 90.0, length_factor: factor, ..Definition::default() };
        let drawing = drawing(&System::new(&definition).unwrap(), 0);
        for azimuth in [0.0, 40.0, 170.0] {
            let camera = Camera { azimuth, elevation: 0.0, perspective: false, ..Camera::default() };
            let lens = Lens::new(&drawing, SIZE, &camera, 1.0);
            let step = lens.step;
            let pixels = picture(&drawing, &style, SIZE, &camera, Quality(3), 1 << 20);
            let painted = pixels.chunks(4).filter(|pixel| pixel[..3] != style.background.rgb).count() as f64;
            let expected = part * step * step * libm::cos(azimuth.to_radians()).abs();
            // The tolerance is the stroke before the polygon, a pixel wide, and the polygon's edges.
            assert!((painted - expected).abs() < 3.0 * step, "{axiom} {azimuth}: {painted} {expected}");
        }
    }
}

/// A polygon without an area has no triangles, so that a block of it alone shows nothing.
#[test]
fn polygons_without_an_area_show_nothing() {
    let style = Style::default();
    let paper = [style.background.rgb[0], style.background.rgb[1], style.background.rgb[2], u8::MAX];
    let alone = drawing(&system(Dialect::Abop, "&{fff}", "", 60.0), 0);
    let pixels = picture(&alone, &style, SIZE, &Camera::default(), Quality::FINEST, 1 << 20);
    assert!(pixels.chunks(4).all(|pixel| pixel == paper));

    // A block without a node leaves no other item in its place.
    let beside = system(Dialect::Abop, "X&ffffA", "X -> F[+F][-F][^F]F\nA -> {fff}", 60.0);
    let beside = drawing(&beside, 1);
    let mut scene = Scene::new(&beside);
    while scene.step(&beside, &mut Meter::new(u64::MAX)) == Progress::More {}
    let root = &scene.nodes[scene.root.unwrap() as usize];
    assert_eq!((root.links, root.lines), (1, 0), "X alone");
}

/// A step makes no more of the scene than its work allows, however many contents a block has.
#[test]
fn long_blocks_are_made_ready_in_steps() {
    let long = drawing(&system(Dialect::Abop, "A", &format!("A -> &{}", "F+".repeat(24_000)), 7.0), 1);
    let mut renderer = SolidRenderer::new();
    renderer.load(long.clone());
    for upto in [None, Some(20_000)] {
        renderer.play(upto);
        renderer.begin(&Style::default(), SIZE, &Camera::default(), Quality::FINEST);
        let (mut most, mut before) = (0, renderer.spent());
        while renderer.step(1000) == Progress::More {
            most = most.max(renderer.spent() - before);
            before = renderer.spent();
        }
        assert!(most <= 1000 + Meter::PIECE, "{most}");
    }
    assert!(renderer.stats().strokes > 0);
}

/// A drawing in additive ink that lies in one plane and faces the eye, beside the picture of the same drawing in the plane.
fn flat_and_solid(rules: &str, n: u32, style: &Style, viewport: Viewport) -> [Vec<u8>; 2] {
    let definition = |axiom: &str| Definition {
        axiom: axiom.to_owned(),
        rules: rules.to_owned(),
        angle: 25.0,
        ..Definition::default()
    };
    let figure = |axiom| Figure::draw(&System::new(&definition(axiom)).unwrap(), n, &Limits::default()).unwrap();
    let (flat, solid) = (figure("A"), figure("/(0)A"));
    let camera = Camera { azimuth: 0.0, elevation: 0.0, perspective: false, fade: 0.0, ..Camera::default() };
    // The same scale and the same middle, by the first segment, which points up.
    let of = |figure: &Figure, vantage: &Vantage| {
        let [from, to] = fitted_ends(figure, 0).unwrap();
        (fitted_scale(figure, viewport, vantage), [from[0], from[1]], to[1] - from[1])
    };
    let (scale, start, length) = of(&flat, &Vantage::default());
    let (other, place, own) = of(&solid, &camera.into());
    let zoom = scale * length / (other * own);
    let target = [0, 1].map(|i| place[i] - start[i] * own / length);
    let camera = Camera { zoom, target: [target[0], target[1], 0.0], ..camera };
    [(flat, Vantage::default()), (solid, camera.into())].map(|(figure, vantage)| {
        let mut renderer = FigureRenderer::new();
        renderer.load(&figure);
        let (style, quality, band) = (style.clone(), Quality::FINEST, u32::MAX);
        paint(&mut renderer, PictureOptions { style, viewport, vantage, upto: None, quality, band })
    })
}

#[test]
fn additive_ink_is_that_of_the_plane() {
    let viewport = Viewport { width: 200, height: 200, ratio: 1.0 };
    let colours = [[200, 40, 20], [20, 120, 200], [40, 160, 60]].map(|rgb| Colour { rgb });
    let one = Style { ink: Ink::Density, ..Style::default() };
    let many = Style { palette: colours.to_vec(), colour_by: ColourBy::Level, ..one.clone() };
    let ramp = Style { colour_by: ColourBy::Density, ..many.clone() };
    let wide = Style { min_width: 9.0, ..many.clone() };
    for (rules, n) in [
        ("A -> F[+A][-A]FA\nF -> FF", 5),
        ("A -> F[+A][-A]FA\nF -> FF", 30),
        ("A -> F[+A]F[-A]+A\nF -> FF", 8),
        ("A -> FF-[-A+F+F]+[+A-F-F]{-F+F+F}\nF -> FF", 6),
    ] {
        let deep = n == 30;
        for (name, style) in
            [("one", &one), ("many", &many), ("ramp", &ramp), ("wide", if deep { &many } else { &wide })]
        {
            let [flat, solid] = flat_and_solid(rules, n, style, viewport);
            let paper = [flat[0], flat[1], flat[2]];
            let inked = flat.chunks_exact(4).filter(|pixel| pixel[..3] != paper).count();
            let (mean, _) = difference(&flat, &solid, 255);
            let share = inked as f64 / (200.0 * 200.0);
            assert!(inked > 1000 && mean < 9.0 * share, "{name} {rules} {n}: mean {mean} of {share}");
        }
    }
}

#[test]
fn additive_panes_have_the_tone_of_the_whole() {
    let viewport = Viewport { width: 600, height: 400, ratio: 1.0 };
    for (system, n) in sampled([(tree(), 3), (bush(), 7), (bush(), 20)], 3, 2) {
        let mut renderer = FigureRenderer::new();
        renderer.load(&Figure::Space(drawing(&system, n)));
        let mut in_bands = |band| {
            let style = Style { ink: Ink::Density, ..Style::default() };
            let (vantage, quality) = (Vantage::default(), Quality::BEST);
            paint(&mut renderer, PictureOptions { style, viewport, vantage, upto: None, quality, band })
        };
        let (whole, panes) = (in_bands(u32::MAX), in_bands(600 * 48));
        let (mean, _) = difference(&whole, &panes, 255);
        assert!(whole.len() == panes.len() && mean < 1.0, "n = {n}: {mean}");
    }
}
