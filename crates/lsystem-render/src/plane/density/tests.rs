use super::super::fitted_scale;
use super::*;
use crate::fit;
use crate::pane::Pass;
use crate::plane::sample::Sample;
use crate::plane::tests::{check_odd_views, check_small_steps, close_up, difference, hard, put, samples};
use crate::plane::view::root_bounds;
use crate::plane::{Renderer, View};
use crate::viewport::Viewport;
use lsystem_syntax::{ColourBy, Ink, Style};
use std::sync::Arc;
use test_effort::sampled;

/// The picture of sums made last.
fn density(renderer: &Renderer) -> &Density {
    renderer.blend.density.as_deref().expect("a picture of sums")
}

/// Makes a picture of sums.
fn picture(renderer: &mut Renderer, style: &Style, viewport: Viewport, view: View) {
    let style = Style { ink: Ink::Density, ..style.clone() };
    crate::plane::tests::picture(renderer, &style, viewport, view);
}

/// The ink of each pixel by definition, in layers: every segment point by point, each shared by the four pixels around
/// the point, by distance.
fn by_definition(drawing: &Drawing, style: &Style, viewport: Viewport, view: View) -> Vec<f64> {
    let (width, height) = (viewport.width as i64, viewport.height as i64);
    let rect = fit(drawing);
    let longer = rect.width.max(rect.height);
    let scale = fitted_scale(drawing, viewport) * view.zoom / longer;
    let centre = [rect.x + rect.width / 2.0 + view.x * longer, rect.y + rect.height / 2.0 + view.y * longer];
    let place = |[x, y]: [f64; 2]| {
        [width as f64 / 2.0 + (x - centre[0]) * scale, height as f64 / 2.0 - (y - centre[1]) * scale]
    };
    let mut sums = vec![0.0; (width * height) as usize];
    for segment in drawing.segments() {
        let (from, to) = (place(segment.from), place(segment.to));
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = (dx * dx + dy * dy).sqrt();
        let strokes = [segment.width, segment.end_width]
            .map(|width| (width * scale).max(style.min_width * viewport.ratio).max(1.0));
        let stroke = strokes[0].max(strokes[1]);
        // A stroke one pixel wide is a line without width. A wider stroke is many lines.
        let lines = if stroke > 1.0 { (stroke * 8.0).ceil() as usize } else { 1 };
        let points = (length * 8.0).ceil().max(1.0) as usize;
        // The part of the stroke that may give ink to the picture: at a high zoom a small part of all points.
        let margin = stroke / 2.0 + 2.0;
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for (from, change, end) in [(from[0], dx, width as f64), (from[1], dy, height as f64)] {
            let [a, b] = [-margin, end + margin].map(|edge| (edge - from) / change);
            (first, last) = (first.max(a.min(b)), last.min(a.max(b)));
        }
        let seen = (first * points as f64).floor() as usize..(last * points as f64).ceil() as usize;
        for (line, point) in (0..lines).flat_map(|line| seen.clone().map(move |point| (line, point))) {
            let along = (point as f64 + 0.5) / points as f64;
            let stroke = strokes[0] + along * (strokes[1] - strokes[0]);
            let aside = ((line as f64 + 0.5) / lines as f64 - 0.5) * stroke / length.max(1e-300);
            let (x, y) = (from[0] + along * dx - aside * dy - 0.5, from[1] + along * dy + aside * dx - 0.5);
            let weight = length * stroke / (points * lines) as f64;
            for (row, column) in (0..2).flat_map(|row| (0..2).map(move |column| (row, column))) {
                let (px, py) = (x.floor() as i64 + column, y.floor() as i64 + row);
                if px >= 0 && py >= 0 && px < width && py < height {
                    let near = (1.0 - (x - px as f64).abs()) * (1.0 - (y - py as f64).abs());
                    sums[(py * width + px) as usize] += weight * near;
                }
            }
        }
    }
    sums
}

/// The samples without polygons, which are not among the segments.
fn lines() -> impl Iterator<Item = (&'static str, Sample, u32)> {
    let polygons = ["leaves", "star", "tapering leaves"];
    samples().into_iter().filter(move |(name, ..)| !polygons.contains(name))
}

/// Sums over cells of 8x8 pixels.
fn cells(sums: &[f64], width: usize) -> Vec<f64> {
    let columns = width.div_ceil(8);
    let mut cells = vec![0.0; columns * (sums.len() / width).div_ceil(8)];
    for (at, sum) in sums.iter().enumerate() {
        cells[at / width / 8 * columns + at % width / 8] += sum;
    }
    cells
}

#[test]
fn sums_are_those_of_all_strokes() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let mut renderer = Renderer::new();
    let mut failures = vec![];
    for (name, sample, n) in lines() {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        for zoom in [1.0, 7.0, 60.0] {
            let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
            let style = Style { colour_by: ColourBy::Single, ..sample.0.style.clone() };
            picture(&mut renderer, &style, viewport, view);
            let truth = by_definition(&drawing, &style, viewport, view);
            let ours: Vec<f64> = density(&renderer).picture.sums().values.iter().map(|&sum| f64::from(sum)).collect();
            let (got, all) = (ours.iter().sum::<f64>(), truth.iter().sum::<f64>());
            let off: f64 = ours.iter().zip(&truth).map(|(a, b)| (a - b).abs()).sum();
            let pairs = || cells(&ours, 320).into_iter().zip(cells(&truth, 320));
            let mean = all / pairs().filter(|(_, truth)| *truth > 0.0).count() as f64;
            let worst = pairs().map(|(a, b)| (a - b).abs() / (b + mean)).fold(0.0, f64::max);
            let (total, off) = ((got - all).abs() / all, off / all);
            println!("{name:12} {zoom:4} total {total:.1e} off {off:.3} worst {worst:.3} {:?}", renderer.stats());
            // Ink is lost only by rounding, and at the edges of a picture that cuts the drawing. Tiles are off by an
            // eighth of a pixel each way, and again if they are put together from smaller tiles. About as much of a
            // pixel's ink is in its neighbour, and of a cell's ink in the next cell.
            if total > if zoom == 1.0 { 2e-3 } else { 2e-2 } || off > 0.25 || worst > 0.12 {
                failures.push((name, zoom, total, off, worst));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

/// A picture smaller than the largest tile has its sums in the right pixels.
#[test]
fn small_pictures_have_the_sums_of_all_strokes() {
    let mut renderer = Renderer::new();
    for (name, sample, n) in lines() {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        for (width, height) in [(63, 40), (34, 34), (17, 9), (5, 8), (4, 4)] {
            let viewport = Viewport { width, height, ratio: 1.0 };
            let style = Style { colour_by: ColourBy::Single, ..sample.0.style.clone() };
            picture(&mut renderer, &style, viewport, View::default());
            let truth = by_definition(&drawing, &style, viewport, View::default());
            let ours = &density(&renderer).picture.sums().values;
            let all: f64 = truth.iter().sum();
            let off: f64 = ours.iter().zip(&truth).map(|(ours, truth)| (f64::from(*ours) - truth).abs()).sum();
            println!("{name:12} {width:3} {height:3} off {:.3} {:?}", off / all, renderer.stats());
            // As much as tiles are off by: an eighth of a pixel each way.
            assert!(off / all < 0.25, "{name} {width} x {height}: {}", off / all);
        }
    }
}

#[test]
fn polygons_add_their_area() {
    let viewport = Viewport { width: 300, height: 300, ratio: 1.0 };
    let mut renderer = Renderer::new();
    for (axiom, part) in [("{-F+F+F+F}", 1.0), ("[{-F+F+F+F}]{-F+F+F+F}", 2.0)] {
        let mut sample = Sample::abop(axiom, &[], 90.0);
        sample.0.overrides = "F: move, vertex".into();
        let drawing = Arc::new(sample.draw(0));
        renderer.load(drawing.clone());
        picture(&mut renderer, &Style::default(), viewport, View::default());
        let side = fitted_scale(&drawing, viewport);
        let sum: f64 = density(&renderer).picture.sums().values.iter().map(|&sum| f64::from(sum)).sum();
        assert!((sum / (side * side) - part).abs() < 0.01, "{axiom} {sum} {side}");
    }
}

#[test]
fn a_drawing_has_the_ink_of_its_strokes_at_any_depth() {
    let viewport = Viewport { width: 160, height: 100, ratio: 1.0 };
    let mut renderer = Renderer::new();
    for (name, sample) in hard() {
        for n in [3, 40, 400, 1000] {
            let drawing = Arc::new(sample.draw(n));
            renderer.load(drawing.clone());
            let style = Style { colour_by: ColourBy::Single, ..Style::default() };
            picture(&mut renderer, &style, viewport, View::default());
            let ink = density(&renderer).deposits.list[drawing.root.unwrap().0 as usize].length;
            let (_, rect) = root_bounds(&drawing);
            let scale = fitted_scale(&drawing, viewport) / rect.width.max(rect.height);
            let sums = density(&renderer).picture.sums();
            let expected = ink.times(scale).units(sums.exponent);
            let got: f64 = sums.values.iter().map(|&sum| f64::from(sum)).sum();
            assert!((got / expected - 1.0).abs() < 1e-3, "{name} {n}: {got} of {expected}");
        }
    }
}

/// Also if strokes are much wider than the whole drawing, which is then no dot.
#[test]
fn small_drawings_of_wide_strokes_have_their_ink() {
    let viewport = Viewport { width: 160, height: 120, ratio: 1.0 };
    let mut renderer = Renderer::new();
    for (name, sample) in hard() {
        let drawing = Arc::new(sample.draw(6));
        renderer.load(drawing.clone());
        let style = Style { colour_by: ColourBy::Single, min_width: 50.0, ..Style::default() };
        let zoom = 1e-3;
        picture(&mut renderer, &style, viewport, View { zoom, ..View::default() });
        let ink = density(&renderer).deposits.list[drawing.root.unwrap().0 as usize].length;
        let (_, rect) = root_bounds(&drawing);
        let scale = zoom * fitted_scale(&drawing, viewport) / rect.width.max(rect.height);
        let sums = density(&renderer).picture.sums();
        let expected = 50.0 * ink.times(scale).units(sums.exponent);
        let got: f64 = sums.values.iter().map(|&sum| f64::from(sum)).sum();
        assert!((got / expected - 1.0).abs() < 0.1, "{name}: {got} of {expected}");
        // As far from the middle as half a stroke is wide, and no farther.
        let far = |(at, _): (usize, &f32)| {
            let [x, y] = [at % 160, at / 160].map(|v| v as f64);
            libm::hypot(x - 79.5, y - 59.5)
        };
        let reach = sums.values.iter().enumerate().filter(|(_, sum)| **sum > 0.0).map(far).fold(0.0, f64::max);
        assert!((23.0..28.0).contains(&reach), "{name}: {reach}");
    }
}

#[test]
fn a_thousand_generations_look_like_two_hundred() {
    let viewport = Viewport { width: 160, height: 120, ratio: 1.0 };
    let [mut few, mut many] = [Renderer::new(), Renderer::new()];
    for (name, sample) in hard().into_iter().filter(|(name, _)| !name.contains("gosper")) {
        for (renderer, n) in [(&mut few, 200), (&mut many, 1000)] {
            renderer.load(Arc::new(sample.draw(n)));
            picture(renderer, &sample.0.style, viewport, View::default());
        }
        let differ = few.pixels().iter().zip(many.pixels()).map(|(a, b)| u64::from(a.abs_diff(*b))).sum::<u64>();
        assert!(differ as f64 / (few.pixels().len() as f64) < 0.5, "{name} {differ}");
    }
}

#[test]
fn panes_are_pieces_of_the_whole() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let [mut whole, mut renderer] = [Renderer::new(), Renderer::new()];
    let mut failures = vec![];
    let hard = hard().into_iter().map(|(name, sample)| (name, sample, 24));
    for (name, sample, n) in samples().into_iter().chain(hard) {
        let drawing = Arc::new(sample.draw(n));
        whole.load(drawing.clone());
        renderer.load(drawing.clone());
        for (zoom, colour_by) in [(1.0, ColourBy::Symbol), (10.0, ColourBy::Density)] {
            let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
            let style = Style { colour_by, ink: Ink::Density, ..sample.0.style.clone() };
            picture(&mut whole, &style, viewport, view);
            let mut pixels = vec![0; 320 * 200 * 4];
            for (pane, pass) in Pass::all(Ink::Density, viewport, [320, 48]) {
                renderer.begin_pane(&style, viewport, view, None, (pane, pass));
                while renderer.step(10_000) == Progress::More {}
                if pass.shows() {
                    put(&mut pixels, 320, pane, renderer.pixels());
                }
            }
            let (mean, worst) = difference(&pixels, whole.pixels(), 320);
            println!("{name:12} {colour_by:?} {zoom:4} mean {mean:.3} worst {worst:.2}");
            if mean > 0.5 || worst > 12.0 {
                failures.push((name, colour_by, zoom, mean, worst));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn work_in_small_steps_gives_the_same_picture() {
    check_small_steps([Renderer::new(), Renderer::new()], Ink::Density);
}

/// The mean of all channels' distance from the background.
fn shown(pixels: &[u8], style: &Style) -> f64 {
    let far = |pixel: &[u8]| (0..3).map(|c| f64::from(pixel[c].abs_diff(style.background.rgb[c]))).sum::<f64>();
    pixels.chunks(4).map(far).sum::<f64>() / (pixels.len() / 4 * 3) as f64
}

#[test]
fn exposure_does_not_jump_while_zooming() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let mut renderer = Renderer::new();
    for (name, sample) in sampled(hard(), 3, 1) {
        let drawing = Arc::new(sample.draw(24));
        renderer.load(drawing.clone());
        let style = &sample.0.style;
        let at = close_up(&drawing, 8.0);
        let mut last: Option<f64> = None;
        for step in 0..90 {
            let zoom = libm::pow(2.0, f64::from(step) / 30.0);
            picture(&mut renderer, style, viewport, View { zoom, ..at });
            let now = shown(renderer.pixels(), style);
            // A zoom by a fortieth of a power of two changes at most this much at the edges.
            if let Some(last) = last {
                assert!((now - last).abs() < 1.0 + 0.06 * last, "{name} step {step}: {last} then {now}");
            }
            last = Some(now);
        }
    }
}

#[test]
fn inks_mix_by_how_much_there_is_of_each() {
    let viewport = Viewport { width: 64, height: 64, ratio: 1.0 };
    let palette = ["red", "blue"].map(|name| name.parse().unwrap()).to_vec();
    let style = Style { palette, background: "white".parse().unwrap(), ..Style::default() };
    // Strokes far below a pixel, two of the first ink for each of the second.
    let sample = Sample::abop("X", &[('X', "F[+X]F['-F]X")], 90.0);
    let mut renderer = Renderer::new();
    renderer.load(Arc::new(sample.draw(30)));
    picture(&mut renderer, &style, viewport, View::default());
    let sums = density(&renderer).picture.sums();
    assert_eq!(sums.planes, 4);
    let total = |plane: usize| sums.values.iter().skip(plane).step_by(4).map(|&v| f64::from(v)).sum::<f64>();
    let (ink, pigments) = (total(0), [total(1), total(2), total(3)]);
    let [red, blue] = [0, 1].map(|i| crate::ink::pigment(style.palette[i], style.background).map(f64::from));
    for (channel, sum) in pigments.into_iter().enumerate() {
        let expected = ink * (2.0 * red[channel] + blue[channel]) / 3.0;
        assert!((sum - expected).abs() <= 0.01 * ink, "{channel}: {sum} {expected}");
    }
}

/// Colours change at every stroke of a long successor. The work for the mean of a block grows with the length of the
/// block, not with its square, and the mean is found in steps.
#[test]
fn means_of_long_blocks_are_found_in_steps() {
    for (times, n) in [(2000, 8), (12_000, 20)] {
        let sample = Sample::abop("F", &[('F', &"!F'F".repeat(times))], 0.0);
        let style = Style { ink: Ink::Density, ..sample.0.style.clone() };
        let mut renderer = Renderer::new();
        renderer.load(Arc::new(sample.draw(n)));
        renderer.begin(&style, Viewport { width: 160, height: 100, ratio: 1.0 }, View::default());
        let (mut most, mut before) = (0, 0);
        while renderer.step(1000) == Progress::More {
            most = most.max(renderer.spent() - before);
            before = renderer.spent();
        }
        assert!(most <= 1000 + Meter::PIECE, "{most}");
        // The items of all blocks a few times, and little more.
        let items = u64::from(n) * 2 * times as u64;
        assert!(before < 40 * items + 3_000_000, "{times} {n}: {before} for {items}");
    }
}

/// A small picture of very many blocks in the same place takes no longer than a large picture.
#[test]
fn small_pictures_end_in_time() {
    for (name, sample) in hard() {
        let mut renderer = Renderer::new();
        renderer.load(Arc::new(sample.draw(40)));
        for side in [1, 2, 3, 5, 9, 17] {
            let before = renderer.spent();
            picture(
                &mut renderer,
                &sample.0.style,
                Viewport { width: side, height: side, ratio: 1.0 },
                View::default(),
            );
            let spent = renderer.spent() - before;
            assert!(spent < 10_000_000, "{name} {side}: {spent} {:?}", renderer.stats());
        }
    }
}

#[test]
fn odd_views_and_sizes_do_no_harm() {
    check_odd_views(Ink::Density);
}
