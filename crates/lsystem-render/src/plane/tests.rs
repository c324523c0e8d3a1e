use super::sample::{Sample, brute_force, brute_force_until};
use super::wide::Wide;
use super::*;
use crate::pane::{Pane, Pass};
use crate::viewport::{Detail, Viewport};
use lsystem_base::Progress;
use lsystem_drawing::{Drawing, Item};
use lsystem_syntax::{ColourBy, Ink, Style};
use std::sync::Arc;
use test_effort::sampled;

/// The most steps of 100,000 units of work for one picture.
const MAX_STEPS: usize = 5_000;

pub(super) fn picture(renderer: &mut Renderer, style: &Style, viewport: Viewport, view: View) {
    renderer.begin(style, viewport, view);
    while renderer.step(10_000) == Progress::More {}
}

/// Mean absolute difference of two pictures, and the largest mean over an 8x8 tile, in levels of 255.
pub(super) fn difference(a: &[u8], b: &[u8], width: usize) -> (f64, f64) {
    assert_eq!(a.len(), b.len());
    let columns = width.div_ceil(8);
    let mut tiles = vec![0_u64; columns * (a.len() / 4 / width).div_ceil(8)];
    for (i, (p, q)) in a.chunks(4).zip(b.chunks(4)).enumerate() {
        let d: u64 = p.iter().zip(q).map(|(p, q)| u64::from(p.abs_diff(*q))).sum();
        tiles[i / width / 8 * columns + i % width / 8] += d;
    }
    let mean = tiles.iter().sum::<u64>() as f64 / (a.len() / 4 * 3) as f64;
    (mean, tiles.iter().copied().max().unwrap_or(0) as f64 / (64.0 * 3.0))
}

/// The opaque picture in the making.
fn opaque(renderer: &mut Renderer) -> &mut opaque_picture::Picture {
    &mut renderer.blend.opaque.picture
}

pub(super) fn samples() -> Vec<(&'static str, Sample, u32)> {
    vec![
        ("koch", Sample::abop("-F", &[('F', "F+F--F+F")], 60.0), 6),
        ("dragon", Sample::abop("X", &[('X', "X+YF+"), ('Y', "-FX-Y")], 90.0), 12),
        ("fine dragon", Sample::abop("X", &[('X', "X+YF+"), ('Y', "-FX-Y")], 90.0), 17),
        ("plant f", Sample::abop("X", &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5), 6),
        ("fine plant", Sample::abop("X", &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5), 8),
        ("plant d", Sample::abop("X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], 20.0), 7),
        ("bush", Sample::abop("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5), 5),
        ("fine bush", Sample::abop("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5), 6),
        ("fine gosper", Sample::abop("F", &[('F', "F-G--G+F++FF+G-"), ('G', "+F-GG--G-F++F+G")], 60.0), 6),
        ("fine coloured", Sample::lowercase("X", &[('X', "g-[[X]+X]+g[+gX]-X"), ('g', "gg")], 22.5), 8),
        ("plant b", Sample::abop("F", &[('F', "F[+F]F[-F][F]")], 25.7), 6),
        ("sierpinski", Sample::abop("F-G-G", &[('F', "F-G+F+G-F"), ('G', "GG")], 120.0), 7),
        ("gosper", Sample::abop("F", &[('F', "F-G--G+F++FF+G-"), ('G', "+F-GG--G-F++F+G")], 60.0), 5),
        ("coloured", Sample::lowercase("X", &[('X', "g-[[X]+X]+g[+gX]-X"), ('g', "gg")], 22.5), 6),
        ("wide", Sample::abop("X", &[('X', "F!-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5).wide(0.6), 5),
        ("leaves", Sample::abop("X", &[('X', "F[+X]F[-X]{'+f-f+f|+f-f}X"), ('F', "FF")], 25.7).wide(0.2), 5),
        ("star", Sample::abop("{F+F+F+F+F}", &[], 144.0).wide(0.02), 1),
        ("narrowing", narrowing(Sample::abop("X", &[('X', "F[+X][-X]'FX")], 25.7).wide(0.4)), 6),
        ("tapering", Sample::abop("X", &[('X', "F!!![+X]F[-X]!!+X"), ('F', "FF")], 25.7).wide(3.0), 5),
        ("tapering leaves", Sample::abop("X", &[('X', "F![+F!!X]!!F[-X]!F{-f+f+f}"), ('F', "FF")], 40.0).wide(1.5), 4),
        ("step colours", Sample::abop("X", &[('X', "F[+'X]F[-''X]+X"), ('F', "FF")], 25.7).wide(0.3), 6),
    ]
}

#[test]
fn the_picture_is_that_of_every_segment_stroked_in_order() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let mut renderer = Renderer::new();
    let mut failures = vec![];
    for (name, sample, n) in sampled(samples(), 3, 0) {
        let drawing = Arc::new(sample.draw(n));
        for (colour_by, zoom) in [
            (ColourBy::Symbol, 1.0),
            (ColourBy::Level, 1.0),
            (ColourBy::Symbol, 10.0),
            (ColourBy::Single, 100.0),
            (ColourBy::Path, 1.0),
            (ColourBy::Path, 10.0),
        ] {
            let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
            let style = Style { colour_by, ..sample.0.style.clone() };
            let truth = brute_force(&drawing, &style, viewport, view);
            // With the usual tiles, and with tiles wherever they are possible.
            for simple in [top_down::tile::SIMPLE_STROKES, 0] {
                opaque(&mut renderer).top_down.tiling.simple = simple;
                renderer.load(drawing.clone());
                picture(&mut renderer, &style, viewport, view);
                let (mean, worst) = difference(renderer.pixels(), &truth, 320);
                let stats = renderer.stats();
                println!("{name:12} {colour_by:?} {zoom:5} {simple:5} mean {mean:.3} worst {worst:.2} {stats:?}");
                if mean > 2.0 || worst > 12.0 {
                    failures.push((name, colour_by, zoom, simple, mean, worst));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn panes_together_are_the_picture() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let (mut renderer, mut whole) = (Renderer::new(), Renderer::new());
    let mut failures = vec![];
    for (name, sample, n) in samples() {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        whole.load(drawing.clone());
        for (zoom, colour_by) in [(1.0, ColourBy::Symbol), (10.0, ColourBy::Level), (10.0, ColourBy::Path)] {
            let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
            let style = Style { colour_by, ..sample.0.style.clone() };
            let truth = brute_force(&drawing, &style, viewport, view);
            for simple in [top_down::tile::SIMPLE_STROKES, 0] {
                for renderer in [&mut renderer, &mut whole] {
                    opaque(renderer).top_down.tiling.simple = simple;
                }
                picture(&mut whole, &style, viewport, view);
                let mut pixels = vec![0; 320 * 200 * 4];
                for (pane, pass) in Pass::all(Ink::Solid, viewport, [144, 48]) {
                    renderer.begin_pane(&style, viewport, view, None, (pane, pass));
                    while renderer.step(10_000) == Progress::More {}
                    if pass.shows() {
                        put(&mut pixels, 320, pane, renderer.pixels());
                    }
                }
                // The tiles and the last holes depend on the order in which blocks were painted.
                let (mean, worst) = difference(&pixels, whole.pixels(), 320);
                let (_, off) = difference(&pixels, &truth, 320);
                println!("{name:12} {colour_by:?} {zoom:5} {simple:5} mean {mean:.3} worst {worst:.2}");
                let most = if simple == 0 { 0.05 } else { 1.0 };
                if mean > most || worst > 12.0 || off > 12.0 {
                    failures.push((name, colour_by, zoom, simple, mean, worst, off));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

/// Copies a pane into a picture that is `width` pixels wide.
pub(super) fn put(pixels: &mut [u8], width: usize, pane: Pane, own: &[u8]) {
    assert_eq!(own.len(), (pane.width * pane.height * 4) as usize);
    for (y, row) in own.chunks(pane.width as usize * 4).enumerate() {
        let at = ((pane.y as usize + y) * width + pane.x as usize) * 4;
        pixels[at..at + row.len()].copy_from_slice(row);
    }
}

#[test]
fn a_drawing_without_shared_blocks_needs_no_survey() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let sample = Sample::abop("F", &[('F', "F[+F]F : 1"), ('F', "F[-F]F : 1")], 25.0);
    let drawing = Arc::new(sample.draw(8));
    assert!(!drawing.memoised);
    let mut renderer = Renderer::new();
    renderer.load(drawing);
    picture(&mut renderer, &sample.0.style, viewport, View::default());
    let before = renderer.spent();
    let whole = (Pane::whole(viewport), Pass::Survey);
    renderer.begin_pane(&sample.0.style, viewport, View::default(), None, whole);
    while renderer.step(10_000) == Progress::More {}
    assert!(renderer.spent() - before < 100, "{}", renderer.spent() - before);
    assert!(renderer.pixels().is_empty());
}

#[test]
fn panes_cover_the_picture_once() {
    for (width, height) in [(0, 0), (1, 1), (320, 200), (1600, 1000)] {
        let viewport = Viewport { width, height, ratio: 1.0 };
        for size in [[0, 0], [16, 64], [1600, 48], [256, 256]] {
            if size[0] == 0 && width > 320 {
                continue;
            }
            let mut covered = vec![0_u8; (width * height) as usize];
            for pane in Pane::all(viewport, size) {
                assert_eq!(pane.within(viewport), pane);
                for y in pane.y..pane.y + pane.height {
                    covered[(y * width + pane.x) as usize..][..pane.width as usize].iter_mut().for_each(|n| *n += 1);
                }
            }
            assert!(covered.iter().all(|&times| times == 1), "{viewport:?} in panes of {size:?}");
        }
    }
}

#[test]
fn a_turtle_on_its_way_has_drawn_the_first_segments() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let (style, view) = (Style { ink: Ink::Solid, ..Style::default() }, View::default());
    let mut renderer = Renderer::new();
    for (name, sample, n) in samples() {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        let count = drawing.segment_count();
        for upto in [0, 1, count / 3, count - 1, count] {
            renderer.begin_with(&style, viewport, view, Detail::Fine, Some(upto));
            while renderer.step(10_000) == Progress::More {}
            let truth = brute_force_until(&drawing, &style, viewport, view, upto as usize);
            let (mean, worst) = difference(renderer.pixels(), &truth, 320);
            assert!(mean <= 2.0 && worst <= 12.0, "{name} until {upto}: mean {mean:.3} worst {worst:.2}");
        }
    }
}

#[test]
fn a_stroke_broader_than_the_picture_is_found_first() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let sample = Sample::abop("F", &[('F', "F+F--F+F")], 60.0).wide(40.0);
    let style = &sample.0.style;
    let mut renderer = Renderer::new();
    for (n, zoom) in [(6, 1e3), (20, 1e9)] {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        picture(&mut renderer, style, viewport, close_up(&drawing, zoom));
        assert_eq!(renderer.stats().strokes, 1);
        assert!(renderer.pixels().chunks(4).all(|pixel| pixel[..3] == style.ink(0).rgb), "{n}");
    }
}

#[test]
fn what_is_broad_and_in_one_colour_takes_few_of_its_strokes() {
    let viewport = Viewport { width: 96, height: 64, ratio: 1.0 };
    let sample = Sample::abop("F", &[('F', "F+F--F+F")], 86.0).wide(30.0);
    let mut renderer = Renderer::new();
    let drawing = Arc::new(sample.draw(6));
    renderer.load(drawing.clone());
    for zoom in sampled([3.0, 4.0, 10.0], 3, 2) {
        let view = close_up(&drawing, zoom);
        let mut strokes = [0; 2];
        for (strokes, colour_by) in strokes.iter_mut().zip([ColourBy::Single, ColourBy::Path]) {
            let style = Style { colour_by, ..sample.0.style.clone() };
            let truth = brute_force(&drawing, &style, viewport, view);
            picture(&mut renderer, &style, viewport, view);
            let (mean, worst) = difference(renderer.pixels(), &truth, 96);
            println!("{colour_by:?} {zoom:5} mean {mean:.3} worst {worst:.2} {:?}", renderer.stats());
            *strokes = renderer.stats().strokes;
            assert!(mean <= 0.1 && worst <= 4.0, "{colour_by:?} {zoom}: mean {mean:.3} worst {worst:.2}");
        }
        assert!(strokes[0] * 4 < strokes[1], "{zoom}: {strokes:?}");
    }
}

/// The sample with strokes that do not taper.
/// The sample with branches that are shorter and thinner than the branch they grow from.
fn narrowing(mut sample: Sample) -> Sample {
    (sample.0.length_factor, sample.0.style.width_factor) = (0.7, 0.5);
    sample
}

/// A view at `zoom` onto a segment of the drawing.
pub(super) fn close_up(drawing: &Drawing, zoom: f64) -> View {
    let (mut at, mut turn) = ([0.0, 0.0], [1.0, 0.0]);
    let place = |at: [f64; 2], turn: [f64; 2], p: [f64; 2]| {
        [at[0] + turn[0] * p[0] - turn[1] * p[1], at[1] + turn[1] * p[0] + turn[0] * p[1]]
    };
    let mut block = drawing.root.unwrap();
    let root = drawing.blocks[block.0 as usize].clone();
    for depth in 0.. {
        let range = drawing.blocks[block.0 as usize].items.clone();
        let items = &drawing.items[range.start as usize..range.end as usize];
        let size = |item: &Item| match item {
            Item::Stroke(_) => 1,
            Item::Polygon(_) => 0,
            Item::Block(p) => drawing.blocks[p.block.0 as usize].segments,
        };
        // One of the largest items, a different one at each level.
        let most = items.iter().map(size).max().unwrap();
        let large: Vec<&Item> = items.iter().filter(|i| size(i) == most).collect();
        match large[(depth * 7 + 1) % large.len()] {
            Item::Stroke(s) => {
                at = place(at, turn, s.to);
                break;
            }
            Item::Polygon(_) => {}
            Item::Block(p) => {
                let (c, s) = p.heading.cos_sin();
                at = place(at, turn, p.at);
                turn = place([0.0; 2], turn, [c * p.scale, s * p.scale]);
                block = p.block;
            }
        }
    }
    let fit = fit(drawing);
    let unit = libm::scalbn(drawing.step, root.exponent);
    let side = fit.width.max(fit.height);
    View {
        x: (at[0] * unit - fit.x - fit.width / 2.0) / side,
        y: (at[1] * unit - fit.y - fit.height / 2.0) / side,
        zoom,
        ..View::default()
    }
}

pub(super) fn hard() -> Vec<(&'static str, Sample)> {
    vec![
        ("koch", Sample::abop("-F", &[('F', "F+F--F+F")], 60.0)),
        ("dragon", Sample::abop("X", &[('X', "X+YF+"), ('Y', "-FX-Y")], 90.0)),
        ("plant f", Sample::abop("X", &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5)),
        ("plant d", Sample::abop("X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], 20.0)),
        ("plant b 25.7", Sample::abop("F", &[('F', "F[+F]F[-F][F]")], 25.7)),
        ("bush", Sample::abop("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5)),
        ("sierpinski", Sample::abop("F-G-G", &[('F', "F-G+F+G-F"), ('G', "GG")], 120.0)),
        ("gosper", Sample::abop("F", &[('F', "F-G--G+F++FF+G-"), ('G', "+F-GG--G-F++F+G")], 60.0)),
        ("coloured f", Sample::lowercase("X", &[('X', "g-[[X]+X]+g[+gX]-X"), ('g', "gg")], 22.5)),
        ("coloured c", Sample::lowercase("g", &[('g', "gg-[-g+g+g]+[+g-g-g]")], 22.5)),
    ]
}

#[test]
fn the_fitted_scale_is_that_of_the_view() {
    for (name, sample, n) in samples() {
        let drawing = sample.draw(n);
        let viewport = Viewport { width: 320, height: 200, ratio: 2.0 };
        let (_, rect) = view::root_bounds(&drawing);
        for zoom in [1.0, 8.0] {
            let transform = view::ViewTransform::new(&drawing, viewport, View { zoom, ..View::default() }, 1.0);
            let at = |x| transform.place([Wide::sum(x, 0.0), Wide::ZERO])[0];
            let scale = at(rect.width.max(rect.height)) - at(0.0);
            assert!((scale / (fitted_scale(&drawing, viewport) * zoom) - 1.0).abs() < 1e-9, "{name}");
        }
    }
}

/// Steps a picture with a bound on the number of steps, so that endless work shows.
fn finishes(renderer: &mut Renderer) -> bool {
    (0..MAX_STEPS).any(|_| renderer.step(100_000) == Progress::Done)
}

/// With odd views and sizes pictures end, have the right size, and are opaque.
pub(super) fn check_odd_views(ink: Ink) {
    let mut renderer = Renderer::new();
    renderer.begin(&Style { ink, ..Style::default() }, Viewport { width: 7, height: 5, ratio: 1.0 }, View::default());
    assert!(finishes(&mut renderer));
    assert_eq!(renderer.pixels().len(), 7 * 5 * 4);
    let odd = [0.0, -1.0, 1e-300, 1e17, 1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
    for (name, sample) in hard() {
        for n in [0, 1, 9, 200] {
            let drawing = Arc::new(sample.draw(n));
            renderer.load(drawing.clone());
            for (i, value) in odd.into_iter().enumerate() {
                let viewport = Viewport { width: [0, 1, 63, 65][i % 4], height: [65, 1, 16, 0][i % 4], ratio: value };
                let view =
                    View { x: value, y: odd[(i + 3) % odd.len()], zoom: odd[(i + 5) % odd.len()], fine: [value; 2] };
                let style = Style { ink, min_width: odd[(i + 1) % odd.len()], exposure: value, ..Style::default() };
                let details = [Detail::Fine, Detail::Coarse].into_iter();
                for (detail, upto) in details.flat_map(|detail| [(detail, None), (detail, Some(7))]) {
                    renderer.begin_with(&style, viewport, view, detail, upto);
                    assert!(finishes(&mut renderer), "{name} {n} {view:?}");
                    assert_eq!(renderer.pixels().len(), (viewport.width * viewport.height * 4) as usize);
                    assert!(renderer.pixels().iter().skip(3).step_by(4).all(|&alpha| alpha == u8::MAX));
                }
            }
        }
    }
}

#[test]
fn odd_views_and_sizes_do_no_harm() {
    check_odd_views(Ink::Solid);
}

#[test]
fn blocks_small_beside_their_strokes_are_as_wide_as_the_widest() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    // The segment drawn last is a thousandth as wide as the trunk.
    let mut sample = Sample::abop("A", &[('A', "AILR"), ('I', "F"), ('L', "[+F]"), ('R', "[-F]")], 30.0);
    (sample.0.style.width, sample.0.style.width_factor, sample.0.style.max_width) = (1000.0, 0.001, 0.0);
    for (mut renderer, n) in [(Renderer::new(), 2), (Renderer::new(), 5), (bottom_up(), 5)] {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        picture(&mut renderer, &sample.0.style, viewport, View::default());
        let truth = brute_force(&drawing, &sample.0.style, viewport, View::default());
        let (mean, worst) = difference(renderer.pixels(), &truth, 320);
        assert!(mean < 2.0 && worst < 12.0, "{n}: {mean} {worst}");
    }
}

#[test]
fn crowds_that_never_repeat_end() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let [mut renderer, mut fresh] = [Renderer::new(), Renderer::new()];
    for sample in [
        Sample::lowercase("A", &[('A', "g[+A][-A]")], 20.0),
        narrowing(Sample::abop("X", &[('X', "F[+X][-X]'FX")], 25.7)),
    ] {
        let drawing = Arc::new(sample.draw(300));
        opaque(&mut renderer).is_light = true;
        renderer.load(drawing.clone());
        renderer.begin(&sample.0.style, viewport, View::default());
        assert!(finishes(&mut renderer));
        let RenderStats { blocks, strokes, stamps, outlines, .. } = renderer.stats();
        assert!((900_000..3_000_000).contains(&(blocks + strokes + stamps)), "{:?}", renderer.stats());
        assert!(outlines > 0);
        let inked = renderer.pixels().chunks(4).filter(|pixel| pixel[..3] != sample.0.style.background.rgb).count();
        assert!(inked > 320 * 200 / 20, "{inked}");
        // Tiles with outlines leave no trace in the next picture.
        let drawing = Arc::new(sample.draw(6));
        for renderer in [&mut renderer, &mut fresh] {
            renderer.load(drawing.clone());
            picture(renderer, &sample.0.style, viewport, View::default());
            assert_eq!(renderer.stats().outlines, 0);
        }
        assert!(renderer.pixels() == fresh.pixels());
    }
}

#[test]
fn what_would_take_far_too_long_is_made_bottom_up_early() {
    let viewport = Viewport { width: 1600, height: 1000, ratio: 1.0 };
    let mut renderer = Renderer::new();
    let crowd = Sample::lowercase("A", &[('A', "g[+A][-A]")], 20.0);
    // The gaps between the lines of this lattice are never covered, and the lines recur exactly.
    let lattice = Sample::abop("A++A++A", &[('A', "F"), ('F', "F-[+F][-A]")], 60.0);
    for (sample, n, early) in [(&crowd, 40, true), (&crowd, 24, false), (&lattice, 40, false)] {
        renderer.load(Arc::new(sample.draw(n)));
        picture(&mut renderer, &sample.0.style, viewport, View::default());
        let RenderStats { blocks, strokes, parts, .. } = renderer.stats();
        assert_eq!((parts > 0, blocks + strokes > 105_000), (early, !early), "{n} {:?}", renderer.stats());
    }
}

/// A renderer that makes pictures bottom-up if it can.
fn bottom_up() -> Renderer {
    let mut renderer = Renderer::new();
    opaque(&mut renderer).opening = strategy::Strategy::BottomUp;
    renderer
}

#[test]
fn a_bottom_up_picture_is_the_same() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let mut renderer = bottom_up();
    let mut failures = vec![];
    let crowds = [
        ("bud", Sample::lowercase("A", &[('A', "g[+A][-A]")], 20.0), 10),
        ("simple", Sample::lowercase("g", &[('g', "g[+g][-g]")], 20.0), 8),
        ("fork", Sample::abop("X", &[('X', "F[+X][-X]")], 25.0), 10),
    ];
    for (name, sample, n) in sampled(samples().into_iter().chain(crowds), 3, 1) {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        for (colour_by, zoom) in [(ColourBy::Symbol, 1.0), (ColourBy::Level, 1.0), (ColourBy::Symbol, 4.0)] {
            let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
            let style = Style { colour_by, ..sample.0.style.clone() };
            picture(&mut renderer, &style, viewport, view);
            let truth = brute_force(&drawing, &style, viewport, view);
            // Each part is off by an eighth of a pixel at most, and all of them by half a pixel, which is a sixteenth
            // of a tile: 16 levels where a tile is crossed by an edge, more where by several, and less in all others.
            let (ours, theirs) = (tiles(renderer.pixels(), 320), tiles(&truth, 320));
            let apart = ours.iter().zip(&theirs).map(|(a, b)| (a - b).abs());
            let (mean, worst) = (apart.clone().sum::<f64>() / ours.len() as f64, apart.fold(0.0, f64::max));
            let stats = renderer.stats();
            println!("{name:12} {colour_by:?} {zoom} mean {mean:.2} worst {worst:.2} {stats:?}");
            if mean > 3.0 || worst > 24.0 || stats.outlines > 0 || stats.parts == 0 {
                failures.push((name, colour_by, zoom, mean, worst));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn a_bottom_up_picture_is_exact_where_all_is_on_the_lattice() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let mut renderer = bottom_up();
    for (sample, n) in [
        (Sample::abop("X", &[('X', "X+YF+"), ('Y', "-FX-Y")], 90.0), 9),
        (Sample::lowercase("X", &[('X', "g-[[X]+X]+g[+gX]-X"), ('g', "gg")], 90.0), 4),
        (Sample::lowercase("A", &[('A', "g[+A][-A]g")], 90.0), 9),
    ] {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        for steps in [12.0, 17.0] {
            // A step is `steps` subsamples long, and the origin lies between two subsamples.
            let transform = |view| view::ViewTransform::new(&drawing, viewport, view, 4.0);
            let view = View { zoom: steps / transform(View::default()).step, ..View::default() };
            let transform = transform(view);
            let side = view::root_bounds(&drawing).1.longer_side() * transform.scale;
            let [x, y] = transform.place(Default::default()).map(|v| (v - libm::round(v)) / side);
            let view = View { x: x + view.x, y: view.y - y, ..view };
            for colour_by in [ColourBy::Symbol, ColourBy::Level] {
                let style = Style { colour_by, ..sample.0.style.clone() };
                picture(&mut renderer, &style, viewport, view);
                assert!(renderer.stats().parts > 1 && renderer.stats().stamps > 1);
                let (mean, worst) = difference(renderer.pixels(), &brute_force(&drawing, &style, viewport, view), 320);
                assert!(worst == 0.0, "{steps} {colour_by:?} mean {mean} worst {worst}");
            }
        }
    }
}

#[test]
fn crowds_that_never_repeat_are_made_bottom_up() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let mut renderer = Renderer::new();
    for (sample, n) in [
        (Sample::lowercase("A", &[('A', "g[+A][-A]")], 20.0), 60),
        (Sample::lowercase("g", &[('g', "g[+g][-g]")], 20.0), 60),
        (Sample::abop("X", &[('X', "F[+X][-X]")], 25.0), 60),
    ] {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        picture(&mut renderer, &sample.0.style, viewport, View::default());
        let RenderStats { blocks, strokes, stamps, outlines, parts, .. } = renderer.stats();
        assert!(parts > 0 && outlines == 0 && blocks + strokes + stamps < 1_100_000, "{:?}", renderer.stats());
        // The picture fills the hull of the drawing.
        let hull = &drawing.blocks[drawing.root.unwrap().0 as usize].hull;
        let corners = &drawing.corners[hull.start as usize..hull.end as usize];
        let next = corners.iter().cycle().skip(1);
        let twice: f64 = corners.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum();
        let scale = view::ViewTransform::new(&drawing, viewport, View::default(), 1.0).scale;
        let inked = renderer.pixels().chunks(4).filter(|pixel| pixel[..3] != sample.0.style.background.rgb).count();
        let filled = inked as f64 / (twice.abs() / 2.0 * scale * scale);
        assert!((0.9..1.1).contains(&filled), "{filled}");
        // Panes are pieces of the same picture.
        let whole = renderer.pixels().to_vec();
        let mut pixels = vec![0; whole.len()];
        for (pane, pass) in Pass::all(Ink::Solid, viewport, [208, 200]) {
            renderer.begin_pane(&sample.0.style, viewport, View::default(), None, (pane, pass));
            while renderer.step(10_000) == Progress::More {}
            if pass.shows() {
                put(&mut pixels, 320, pane, renderer.pixels());
            }
        }
        assert!(pixels == whole, "{n}");
    }
}

#[test]
fn a_bottom_up_picture_in_small_steps_is_the_same() {
    check_small_steps([bottom_up(), bottom_up()], Ink::Solid);
}

#[test]
fn a_thousand_generations_look_like_two_hundred() {
    let viewport = Viewport { width: 160, height: 120, ratio: 1.0 };
    let [mut few, mut many] = [Renderer::new(), Renderer::new()];
    // The pictures can only be alike if headings and sizes recur. The dragon turns by 45 degrees with each generation.
    // Gosper's curve turns by 19.1 degrees, which never recurs. The twigs of `narrowing` shrink with each generation.
    let recurs = |name: &str| !name.contains("gosper") && name != "narrowing";
    for (name, sample, _) in samples().into_iter().filter(|(name, ..)| recurs(name)) {
        for (renderer, n) in [(&mut few, 200), (&mut many, 1000)] {
            renderer.load(Arc::new(sample.draw(n)));
            picture(renderer, &sample.0.style, viewport, View::default());
        }
        let (mean, worst) = difference(few.pixels(), many.pixels(), 160);
        assert!(mean < 0.1 && worst < 4.0, "{name} {mean} {worst}");
    }
}

/// Pictures are the same however the work is cut into steps, and whatever picture was given up before.
pub(super) fn check_small_steps([mut whole, mut stepped]: [Renderer; 2], ink: Ink) {
    let viewport = Viewport { width: 200, height: 150, ratio: 1.0 };
    for (name, sample, n) in samples() {
        let drawing = Arc::new(sample.draw(n));
        let style = Style { ink, ..sample.0.style.clone() };
        whole.load(drawing.clone());
        stepped.load(drawing);
        for detail in [Detail::Fine, Detail::Coarse, Detail::Sketch] {
            whole.begin_with(&style, viewport, View::default(), detail, None);
            while whole.step(usize::MAX) == Progress::More {}
            // A picture given up half-way leaves no trace.
            stepped.begin(&style, viewport, View { x: 0.1, ..View::default() });
            (0..100).for_each(|_| _ = stepped.step(1));
            stepped.begin_with(&style, viewport, View::default(), detail, None);
            while stepped.step(1) == Progress::More {}
            assert!(whole.pixels() == stepped.pixels(), "{name} {detail:?}");
        }
    }
}

#[test]
fn work_in_small_steps_gives_the_same_picture() {
    check_small_steps([Renderer::new(), Renderer::new()], Ink::Solid);
}

#[test]
fn a_segment_fills_the_picture_at_any_depth() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let style = Style { colour_by: ColourBy::Single, ink: Ink::Solid, ..Style::default() };
    for (sample, n) in [
        (Sample::abop("F", &[('F', "F+F-F-F+F")], 90.0), 40),
        (Sample::abop("F", &[('F', "F+F--F+F")], 60.0), 40),
        (Sample::abop("X", &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5), 40),
    ] {
        let drawing = Arc::new(sample.draw(n));
        let mut renderer = Renderer::new();
        renderer.load(drawing.clone());
        let (middle, length) = deep_segment(&drawing);
        let (_, rect) = view::root_bounds(&drawing);
        let side = rect.width.max(rect.height);
        let fitted = fitted_scale(&drawing, viewport) / side;
        for pixels in [40.0, 100.0, 100.7] {
            // The segment is `pixels` long, and its middle is shifted from the picture's by whole pixels.
            let zoom = pixels / (length * fitted);
            let mut pictures = vec![];
            for shift in [0.0, 16.0] {
                let offset = |axis: usize, by: f64| {
                    let centre = [rect.x + rect.width / 2.0, rect.y + rect.height / 2.0][axis];
                    let exact = middle[axis].plus(-centre).plus(by / (fitted * zoom));
                    let coarse = exact.minus(Wide::default()) / side;
                    let rest = exact.plus_wide(Wide::product(-coarse, side)).minus(Wide::default());
                    (coarse, rest / side)
                };
                let ((x, fx), (y, fy)) = (offset(0, shift), offset(1, 0.0));
                picture(&mut renderer, &style, viewport, View { x, y, zoom, fine: [fx, fy] });
                pictures.push(renderer.pixels().to_vec());
            }
            let ink = |picture: &[u8], x: usize, y: usize| picture[4 * (y * 320 + x)] != style.background.rgb[0];
            assert!((98..=101).any(|y| ink(&pictures[0], 160, y) || ink(&pictures[0], 159, y)), "{pixels}");
            let count = |picture: &[u8]| (0..320 * 200).filter(|i| ink(picture, i % 320, i / 320)).count();
            assert!((pixels as usize..6000).contains(&count(&pictures[0])), "{}", count(&pictures[0]));
            // Moving the view by whole pixels moves the picture as much, to the last subsample.
            let moved = (0..200).all(|y| (16..320).all(|x| ink(&pictures[0], x, y) == ink(&pictures[1], x - 16, y)));
            assert!(moved, "the picture trembles at {pixels} pixels to the segment");
        }
    }
}

/// The middle of a segment in the innermost blocks, in the root block's frame, and its length there.
fn deep_segment(drawing: &Drawing) -> ([Wide; 2], f64) {
    let mut block = drawing.root.unwrap();
    let (mut at, mut heading, mut scale) = ([Wide::default(); 2], lsystem_syntax::Heading::EAST, 1.0);
    for depth in 0_u32.. {
        let items = drawing.items_of(block);
        let choice = items.len() * (1 + depth as usize % 3) / 4;
        let item = items[choice..].iter().chain(items).find(|item| matches!(item, Item::Block(_)));
        let (c, s) = heading.cos_sin();
        let place =
            |[x, y]: [f64; 2]| [at[0].plus(c * scale * x - s * scale * y), at[1].plus(s * scale * x + c * scale * y)];
        match item.or(items.first()) {
            Some(Item::Block(placed)) => {
                at = place(placed.at);
                heading = heading + placed.heading;
                scale *= placed.scale;
                block = placed.block;
            }
            Some(Item::Polygon(_)) => break,
            Some(Item::Stroke(stroke)) => {
                let middle = [0, 1].map(|axis| (stroke.from[axis] + stroke.to[axis]) / 2.0);
                let [x, y] = [0, 1].map(|axis| stroke.to[axis] - stroke.from[axis]);
                return (place(middle), (x * x + y * y).sqrt() * scale);
            }
            None => break,
        }
    }
    unreachable!("blocks hold segments in the end")
}

#[test]
#[ignore = "takes minutes: run it in release mode after changing what tiles may do"]
fn full_size_pictures_are_true() {
    let viewport = Viewport { width: 1600, height: 1000, ratio: 1.0 };
    let mut renderer = Renderer::new();
    let mut failures = vec![];
    for (name, sample) in hard() {
        let count = |drawing: &Drawing| drawing.root.map_or(0, |root| drawing.blocks[root.0 as usize].segments);
        for n in (1..20).filter(|&n| (20_000..600_000).contains(&count(&sample.draw(n)))) {
            let drawing = Arc::new(sample.draw(n));
            renderer.load(drawing.clone());
            for zoom in [1.0, 10.0, 100.0] {
                let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
                let truth = brute_force(&drawing, &sample.0.style, viewport, view);
                // Where all lines lie on one square grid, they fall to the next subsamples together. An 8x8 tile may
                // differ by as much as it does if the whole picture moves by half a subsample, the most by which a
                // tile and the tile in it are off together.
                let moved = |truth: &[u8]| {
                    let by = 0.125 / (fitted_scale(&drawing, viewport) * zoom);
                    let moved = View { x: view.x + by, y: view.y + by, ..view };
                    difference(&brute_force(&drawing, &sample.0.style, viewport, moved), truth, 1600).1
                };
                picture(&mut renderer, &sample.0.style, viewport, view);
                let (mean, worst) = difference(renderer.pixels(), &truth, 1600);
                println!("{name:12} {n:2} {zoom:5} mean {mean:.3} worst {worst:.2} {:?}", renderer.stats());
                let most = if worst > 12.0 { 12.0_f64.max(moved(&truth)) } else { 12.0 };
                if mean > 2.0 || worst > most {
                    failures.push((name, n, zoom, mean, worst));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

#[test]
fn a_coarse_picture_has_the_ink_of_the_fine_one_where_that_has_it() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let [mut fine, mut coarse] = [Renderer::new(), Renderer::new()];
    for (name, sample, n) in samples() {
        let drawing = Arc::new(sample.draw(n));
        fine.load(drawing.clone());
        coarse.load(drawing.clone());
        for zoom in [1.0, 10.0] {
            let view = if zoom == 1.0 { View::default() } else { close_up(&drawing, zoom) };
            picture(&mut fine, &sample.0.style, viewport, view);
            for detail in [Detail::Coarse, Detail::Sketch] {
                coarse.begin_with(&sample.0.style, viewport, view, detail, None);
                while coarse.step(10_000) == Progress::More {}
                assert_eq!(coarse.pixels().len(), fine.pixels().len());
                // One sample stands for sixteen; the errors even out over some pixels.
                let (blurred, truth) = (tiles(coarse.pixels(), 320), tiles(fine.pixels(), 320));
                let differences = blurred.iter().zip(&truth).map(|(a, b)| (a - b).abs());
                let worst = differences.clone().fold(0.0, f64::max);
                let mean = differences.sum::<f64>() / truth.len() as f64;
                println!("{name:12} {zoom:5} {detail:?} mean {mean:.2} worst {worst:.2}");
                assert!(mean < 8.0 && worst < 48.0, "{name} {zoom} {detail:?}: mean {mean:.2} worst {worst:.2}");
            }
        }
    }
}

/// The mean of each 8x8 tile of a picture.
fn tiles(pixels: &[u8], width: usize) -> Vec<f64> {
    let columns = width.div_ceil(8);
    let mut sums = vec![0.0; columns * (pixels.len() / 4 / width).div_ceil(8)];
    for (i, pixel) in pixels.chunks(4).enumerate() {
        let sum: f64 = pixel[..3].iter().map(|&v| f64::from(v)).sum();
        sums[i / width / 8 * columns + i % width / 8] += sum / (3.0 * 64.0);
    }
    sums
}

#[test]
fn pictures_have_a_largest_size() {
    let within = |width, height| {
        let Viewport { width, height, .. } = Viewport { width, height, ratio: 1.0 }.within_limits();
        (width, height)
    };
    assert_eq!(within(11_520, 5_800), (11_520, 5_800));
    assert_eq!(within(100_000, 10), (32_768, 10));
    assert_eq!(within(20_000, u32::MAX), (20_000, 5_000));
    assert_eq!(within(0, u32::MAX), (0, 32_768));
}

/// Series of views a little apart: zooming in slowly, and panning by parts of a pixel.
fn steady_views(drawing: &Drawing, zoom: f64) -> Vec<Vec<View>> {
    let view = if zoom == 1.0 { View::default() } else { close_up(drawing, zoom) };
    let zooms = (0..6).map(|i| View { zoom: zoom * (1.0 + f64::from(i) / 640.0), ..view }).collect();
    let viewport = Viewport { width: 160, height: 100, ratio: 1.0 };
    let pixel = 1.0 / (fitted_scale(drawing, viewport) * zoom);
    let pans = (0..6).map(|i| View { x: view.x + f64::from(i) * pixel / 8.0, ..view }).collect();
    vec![zooms, pans]
}

#[test]
fn slow_zooms_and_pans_neither_shimmer_nor_pop() {
    let viewport = Viewport { width: 160, height: 100, ratio: 1.0 };
    let mut renderer = Renderer::new();
    let mut failures = vec![];
    let ink = |pixels: &[u8], style: &Style| {
        let far = |pixel: &[u8]| (0..3).map(|c| f64::from(pixel[c].abs_diff(style.background.rgb[c]))).sum::<f64>();
        pixels.chunks(4).map(far).sum::<f64>() / (pixels.len() / 4 * 3) as f64
    };
    for (name, sample, n) in sampled(samples(), 3, 2) {
        let drawing = Arc::new(sample.draw(n));
        let style = &sample.0.style;
        let series = [1.0, 10.0].map(|zoom| (zoom, steady_views(&drawing, zoom)));
        let truths = series.each_ref().map(|(_, series)| {
            let truth = |view: &View| brute_force(&drawing, style, viewport, *view);
            series.iter().map(|views| views.iter().map(truth).collect::<Vec<_>>()).collect::<Vec<_>>()
        });
        for (simple, at) in [(top_down::tile::SIMPLE_STROKES, 0), (0, 0), (0, 1)] {
            opaque(&mut renderer).top_down.tiling.simple = simple;
            renderer.load(drawing.clone());
            let (zoom, series) = &series[at];
            for (views, truths) in series.iter().zip(&truths[at]) {
                let mut last: Option<(Vec<u8>, &Vec<u8>)> = None;
                for (view, truth) in views.iter().zip(truths) {
                    picture(&mut renderer, style, viewport, *view);
                    let ours = renderer.pixels().to_vec();
                    // The amount of ink follows the truth.
                    let (got, expected) = (ink(&ours, style), ink(truth, style));
                    let off = (got - expected).abs() / (1.0 + 0.02 * expected);
                    let (mut extra, mut worst) = (0.0, 0.0_f64);
                    if let Some((before, truth_before)) = &last {
                        // Moving by an eighth of a pixel changes the pixels at edges. Further changes come from tiles,
                        // which are off by an eighth of a subsample or less, in both pictures.
                        let (change, _) = difference(before, &ours, 160);
                        let (needed, _) = difference(truth_before, truth, 160);
                        extra = change - needed;
                        // No stroke appears or vanishes: no 8x8 tile changes much more than in truth.
                        let moved = |a: &[u8], b: &[u8]| -> Vec<f64> {
                            tiles(a, 160).iter().zip(tiles(b, 160)).map(|(a, b)| a - b).collect()
                        };
                        let pops = moved(before, &ours)
                            .into_iter()
                            .zip(moved(truth_before, truth))
                            .map(|(a, b)| (a - b).abs());
                        worst = pops.fold(0.0, f64::max);
                    }
                    if off > 1.0 || extra > 2.5 || worst > 16.0 {
                        failures.push((name, simple, *zoom, view.zoom, off, extra, worst));
                    }
                    last = Some((ours, truth));
                }
            }
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}
