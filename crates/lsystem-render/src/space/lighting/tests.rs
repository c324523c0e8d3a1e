use super::super::light::LIGHT;
use super::super::tests::{SIZE, bush, drawing, picture, system, tree};
use super::*;
use crate::Camera;
use lsystem_drawing::rotation::{Vector, cross, dot, minus, norm};
use lsystem_syntax::Dialect;
use std::sync::Arc;

/// The light of a picture, ready.
fn light(drawing: &Arc<Drawing<Solid>>, viewport: Viewport, camera: Camera) -> Lighting {
    let style = Style::default();
    let mut scene = Scene::new(drawing);
    let mut meter = Meter::new(u64::MAX);
    assert_eq!(scene.step(drawing, &mut meter), Progress::Done);
    assert_eq!(scene.dye(&style, &mut meter), Progress::Done);
    let mut lighting = Lighting::default();
    lighting.begin(drawing, &Plan { style, viewport, camera, quality: Quality::FINEST, dim: [1.0; 3], pane: None });
    assert_eq!(lighting.step(&scene, &mut meter), Progress::Done);
    lighting
}

/// The light is made once for all panes, whatever the camera says.
#[test]
fn panes_share_the_light_of_any_camera() {
    let drawing = drawing(&bush(), 4);
    for elevation in [12.0, f64::NAN, f64::INFINITY] {
        let camera = Camera { elevation, distance: f64::NAN, ..Camera::default() };
        let mut lighting = light(&drawing, SIZE, camera);
        let style = Style { hue: f64::NAN, ..Style::default() };
        let (viewport, quality) = (SIZE, Quality::FINEST);
        lighting.begin(&drawing, &Plan { style, viewport, camera, quality, dim: [1.0; 3], pane: None });
        assert_eq!(lighting.stage, Stage::Ready);
    }
}

/// The ends of all sticks as the lens sees them before perspective, and their radius.
fn sticks(drawing: &Drawing<Solid>, lens: &Lens) -> Vec<([Vector; 2], f64)> {
    let seen = |p: Vector| {
        let p = [0, 1, 2].map(|i| (p[i] - drawing.start[i]) / drawing.unit());
        [0, 1, 2].map(|i| lens.origin[i] + (0..3).map(|axis| lens.axes[axis][i] * p[axis]).sum::<f64>())
    };
    let radius = |width: f64| width / drawing.step.abs() * lens.step / 2.0;
    drawing.segments().map(|segment| ([segment.from, segment.to].map(seen), radius(segment.width))).collect()
}

/// The least distance of a stick's axis from the ray of the sun at a place, beyond a length of the ray.
fn distance(from: Vector, [a, b]: [Vector; 2], beyond: f64) -> f64 {
    let steps = (0..=200).map(|step| {
        let t = f64::from(step) / 200.0;
        let way = [0, 1, 2].map(|i| a[i] + t * (b[i] - a[i]) - from[i]);
        let along = dot(way, LIGHT).max(beyond);
        norm([0, 1, 2].map(|i| way[i] - along * LIGHT[i]))
    });
    steps.fold(f64::INFINITY, f64::min)
}

/// The definition of shadows: a ray to the sun meets another stick.
#[test]
fn shadows_fall_where_sticks_hide_the_sun() {
    let viewport = Viewport { width: 480, height: 400, ratio: 1.0 };
    let mut counts = [0; 2];
    for (system, n, width) in [(tree(), 2, 0.4), (bush(), 3, 0.3), (bush(), 4, 0.5)] {
        let mut system = system;
        (system.turtle.width, system.turtle.max_width) = (width, 0.0);
        let drawing = drawing(&system, n);
        for (azimuth, elevation) in [(25.0, 12.0), (160.0, 70.0), (-80.0, -40.0)] {
            let camera = Camera { azimuth, elevation, ..Camera::default() };
            let lens = Lens::new(&drawing, viewport, &camera, LANES as f64);
            let lighting = light(&drawing, viewport, camera);
            let texel = 1.0 / norm(lighting.sun.turned[0]);
            let all = sticks(&drawing, &lens);
            for (number, &([a, b], radius)) in all.iter().enumerate() {
                let axis = minus(b, a).map(|c| c / norm(minus(b, a)));
                let aside = cross(cross(axis, LIGHT), axis);
                if norm(aside) < 0.5 {
                    continue;
                }
                for t in [0.2, 0.35, 0.5, 0.65, 0.8] {
                    // The place of the surface that faces the sun.
                    let place = [0, 1, 2].map(|i| a[i] + t * (b[i] - a[i]) + radius * aside[i] / norm(aside));
                    let others = all.iter().enumerate().filter(|&(other, _)| other != number);
                    let near = others.map(|(_, &(ends, own))| {
                        [distance(place, ends, 0.0) - own, distance(place, ends, 3.0 * own + 8.0 * texel) / own]
                    });
                    let [gap, cover] = near.fold([f64::INFINITY; 2], |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
                    let hidden = lighting.sun.hidden(place.map(|c| c as f32));
                    if gap > 8.0 * texel {
                        counts[0] += 1;
                        assert!(hidden < 0.15, "lit: {camera:?} {number} {t}: {hidden}");
                    } else if cover < 0.4 && radius > 4.0 * texel {
                        counts[1] += 1;
                        assert!(hidden > 0.5, "hidden: {camera:?} {number} {t}: {hidden}");
                    }
                }
            }
        }
    }
    assert!(counts[0] > 100 && counts[1] > 20, "{counts:?}");
}

/// A stick alone is in full light, and a crown is darker inside.
#[test]
fn crowns_are_dark_inside() {
    let mean = |drawing: &Arc<Drawing<Solid>>| {
        let viewport = Viewport { width: 320, height: 240, ratio: 1.0 };
        let lighting = light(drawing, viewport, Camera { perspective: false, ..Camera::default() });
        let lens = Lens::new(drawing, viewport, &Camera { perspective: false, ..Camera::default() }, LANES as f64);
        let sticks = sticks(drawing, &lens);
        let dark = |&([a, b], radius): &([Vector; 2], f64)| {
            let [x, y, z] = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
            let place = [lens.middle[0] + x, lens.middle[1] + y].map(|c| c as f32);
            lighting.occlusion.at([place[0], place[1], (z - radius) as f32], &lighting.occlusion.around(place))
        };
        sticks.iter().map(dark).sum::<f32>() / sticks.len() as f32
    };
    let alone = drawing(&system(Dialect::Abop, "&(80)F", "", 20.0), 0);
    assert!(mean(&alone) < 0.06, "{}", mean(&alone));
    assert!(mean(&drawing(&bush(), 6)) > 0.2, "{}", mean(&drawing(&bush(), 6)));
}

/// The shade of an upright stick lies on the ground to the right of its foot: the sun is at the upper left. Seen from
/// below, there is no shade. Without a background, the shade is in the opacity.
#[test]
fn the_ground_is_shaded_only_below() {
    let stick = drawing(&system(Dialect::Abop, "FFFF/(90)", "", 20.0), 0);
    for rgb in [[250, 248, 240], [16, 20, 28]] {
        let lit = Style { background: lsystem_syntax::Colour { rgb }, min_width: 6.0, ..Style::default() };
        let plain = Style { shadows: false, ..lit.clone() };
        for elevation in [-60.0, -10.0, 0.0, 12.0, 50.0] {
            let camera = Camera { elevation, ..Camera::default() };
            let [with, without] =
                [&lit, &plain].map(|style| picture(&stick, style, SIZE, &camera, Quality::FINEST, 1 << 20));
            let foot = Lens::new(&stick, SIZE, &camera, 1.0);
            let foot = foot.project(foot.origin);
            let (mut count, mut right) = (0, 0);
            let width = SIZE.width as usize;
            for (number, (a, b)) in with.chunks(4).zip(without.chunks(4)).enumerate() {
                if b[..3] != rgb || a == b {
                    continue;
                }
                count += 1;
                let [x, y] = [number % width, number / width].map(|c| c as f64 + 0.5);
                assert!(a.iter().zip(b).all(|(a, b)| a <= b), "darker");
                right += usize::from(x > foot[0]);
                assert!(x > foot[0] - 24.0 && y < foot[1] + 32.0, "{elevation}: {x} {y} {foot:?}");
            }
            assert!(10 * right >= 7 * count, "{elevation}: {right} of {count}");
            assert_eq!(count > 20, elevation > 5.0, "{elevation}: {count}");
        }
    }
    let mut renderer = super::super::SolidRenderer::new().transparent();
    renderer.load(stick.clone());
    renderer.begin(&Style::default(), SIZE, &Camera::default(), Quality::FINEST);
    while renderer.step(1 << 20) == Progress::More {}
    let clear = renderer.pixels().chunks(4).filter(|pixel| pixel[3] == 0).count();
    let faint = renderer.pixels().chunks(4).filter(|pixel| (1..100).contains(&pixel[3])).count();
    assert!(clear > 10_000 && faint > 100, "{clear} {faint}");
}

/// Moving pictures do not depend on shadows.
#[test]
fn only_pictures_at_rest_have_shadows() {
    let drawing = drawing(&bush(), 5);
    let lit = Style::default();
    let plain = Style { shadows: false, ..Style::default() };
    for quality in [Quality(2), Quality::MOVING, Quality(15), Quality::FINEST] {
        let [with, without] =
            [&lit, &plain].map(|style| picture(&drawing, style, SIZE, &Camera::default(), quality, 1 << 20));
        assert_eq!(with != without, quality == Quality::FINEST);
    }
}
