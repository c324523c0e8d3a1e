use super::sample::{Sample, brute_force};
use super::*;
use std::time::Instant;

fn picture(renderer: &mut Renderer, style: &Style, viewport: Viewport, view: View) {
    renderer.begin(style, viewport, view);
    while renderer.step(10_000) == Progress::More {}
}

/// Mean absolute difference of two pictures, and the largest mean over an 8x8 tile, in levels of 255.
fn difference(a: &[u8], b: &[u8], width: usize) -> (f64, f64) {
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

fn samples() -> Vec<(&'static str, Sample, u32)> {
    let coloured =
        |axiom, rules, angle| Sample { dialect: crate::Dialect::Lowercase, ..Sample::abop(axiom, rules, angle) };
    vec![
        ("koch", Sample { start: 0.0, ..Sample::abop("F", &[('F', "F+F--F+F")], 60.0) }, 6),
        ("dragon", Sample::abop("X", &[('X', "X+YF+"), ('Y', "-FX-Y")], 90.0), 12),
        ("plant f", Sample::abop("X", &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5), 6),
        ("plant d", Sample::abop("X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], 20.0), 7),
        ("bush", Sample::abop("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5), 5),
        ("plant b", Sample::abop("F", &[('F', "F[+F]F[-F][F]")], 25.7), 6),
        ("sierpinski", Sample::abop("F-G-G", &[('F', "F-G+F+G-F"), ('G', "GG")], 120.0), 7),
        ("gosper", Sample::abop("F", &[('F', "F-G--G+F++FF+G-"), ('G', "+F-GG--G-F++F+G")], 60.0), 5),
        ("coloured", coloured("X", &[('X', "g-[[X]+X]+g[+gX]-X"), ('g', "gg")], 22.5), 6),
        ("wide", Sample { width: 0.6, ..Sample::abop("X", &[('X', "F!-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5) }, 5),
        ("step colours", Sample { width: 0.3, ..Sample::abop("X", &[('X', "F[+'X]F[-''X]+X"), ('F', "FF")], 25.7) }, 6),
    ]
}

#[test]
fn the_picture_is_that_of_every_segment_stroked_in_order() {
    let viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
    let mut renderer = Renderer::new();
    let mut failures = vec![];
    for (name, sample, n) in samples() {
        let drawing = Arc::new(sample.draw(n));
        renderer.load(drawing.clone());
        for (colour_by, view) in [
            (ColourBy::Symbol, View::default()),
            (ColourBy::Level, View { x: 0.1, y: -0.05, zoom: 1.1 }),
            (ColourBy::Symbol, View { x: 0.02, y: -0.2, zoom: 10.0 }),
            (ColourBy::Single, View { x: 0.0, y: -0.1, zoom: 100.0 }),
        ] {
            let style = Style { colour_by, ..Style::default() };
            picture(&mut renderer, &style, viewport, view);
            let truth = brute_force(&drawing, &style, viewport, view);
            let (mean, worst) = difference(renderer.pixels(), &truth, 320);
            println!("{name:12} {colour_by:?} {:5} mean {mean:.3} worst {worst:.2} {:?}", view.zoom, renderer.stats());
            if mean > 2.0 || worst > 12.0 {
                failures.push((name, colour_by, view));
            }
        }
    }
    assert!(failures.is_empty(), "{failures:?}");
}

fn hard() -> Vec<(&'static str, Sample)> {
    vec![
        ("koch", Sample { start: 0.0, ..Sample::abop("F", &[('F', "F+F--F+F")], 60.0) }),
        ("dragon", Sample::abop("X", &[('X', "X+YF+"), ('Y', "-FX-Y")], 90.0)),
        ("plant f", Sample::abop("X", &[('X', "F-[[X]+X]+F[+FX]-X"), ('F', "FF")], 22.5)),
        ("plant d", Sample::abop("X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], 20.0)),
        ("plant b 25.7", Sample::abop("F", &[('F', "F[+F]F[-F][F]")], 25.7)),
        ("bush", Sample::abop("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], 22.5)),
        ("sierpinski", Sample::abop("F-G-G", &[('F', "F-G+F+G-F"), ('G', "GG")], 120.0)),
        ("gosper", Sample::abop("F", &[('F', "F-G--G+F++FF+G-"), ('G', "+F-GG--G-F++F+G")], 60.0)),
        (
            "coloured f",
            Sample {
                dialect: crate::Dialect::Lowercase,
                ..Sample::abop("X", &[('X', "g-[[X]+X]+g[+gX]-X"), ('g', "gg")], 22.5)
            },
        ),
        (
            "coloured c",
            Sample { dialect: crate::Dialect::Lowercase, ..Sample::abop("g", &[('g', "gg-[-g+g+g]+[+g-g-g]")], 22.5) },
        ),
    ]
}

/// Run with `--ignored --nocapture`; writes pictures where `PICTURES` says.
#[test]
#[ignore = "a measurement"]
fn timing() {
    let viewport = Viewport { width: 1600, height: 1000, ratio: 1.0 };
    let folder = std::env::var("PICTURES").ok();
    let only = std::env::var("ONLY").unwrap_or_default();
    let mut renderer = Renderer::new();
    for (name, sample) in hard().into_iter().filter(|(name, _)| name.contains(&only)) {
        for n in [6, 12, 40] {
            renderer.load(Arc::new(sample.draw(n)));
            for zoom in [1.0, 30.0, 1e3, 1e6] {
                let mut best = f64::INFINITY;
                for (_, x) in (0..3).zip([0.0, 1e-3, 0.0]) {
                    let view = View { x: x / zoom, y: -0.1, zoom: zoom * (1.0 + x) };
                    renderer.begin(&Style::default(), viewport, view);
                    let start = Instant::now();
                    let late = || start.elapsed().as_secs() > 5;
                    while renderer.step(10_000) == Progress::More && !late() {}
                    best = best.min(start.elapsed().as_secs_f64() * 1e3);
                }
                println!("{name:12} n {n:2} zoom {zoom:7} {best:9.2} ms {:?}", renderer.stats());
                if let Some(folder) = &folder {
                    let mut ppm = b"P6 1600 1000 255\n".to_vec();
                    ppm.extend(renderer.pixels().chunks(4).flat_map(|p| &p[..3]));
                    std::fs::write(format!("{folder}/{}-{n}-{zoom}.ppm", name.replace(' ', "_")), ppm).unwrap();
                }
            }
        }
    }
}

#[test]
fn the_fitted_scale_is_that_of_the_view() {
    for (name, sample, n) in samples() {
        let drawing = sample.draw(n);
        let viewport = Viewport { width: 320, height: 200, ratio: 2.0 };
        let extent = fit(&drawing).width.max(fit(&drawing).height);
        for zoom in [1.0, 8.0] {
            let at = |px| to_model(&drawing, viewport, View { zoom, ..View::default() }, px, 0.0)[0];
            let scale = extent * 320.0 / (at(320.0) - at(0.0));
            assert!((scale / (fitted_scale(&drawing, viewport) * zoom) - 1.0).abs() < 1e-9, "{name}");
        }
    }
}
