//! The search for rules: of pictures and of strings. A step takes a second at most.

use crate::{Gauge, Source, make};
use lsystem::find::{Drawn, Finder, Named, Photograph, Picture, Question, Searched, Share, StringFinder, merged};
use lsystem::{Limits, Progress, Renderer, SegmentArrays, System, View, Viewport, draw, expand};
use std::sync::Arc;

/// The systems that a step of a picture's search tries, and the symbols that a step of a string's search reads.
const STEP: u64 = 2048;
/// The steps of an execution.
const STEPS: usize = 2;
/// The limits of the system whose picture or string is searched.
const LIMITS: Limits = Limits { symbols: 5_000, modules: 5_000, segments: 5_000, work: 50_000, memory: 64 << 20 };

/// Rules of random pictures, and of pictures of random systems.
pub(super) fn pictures_found(source: &mut Source<'_>, gauge: &mut Gauge) {
    let picture = match source.below(4) {
        0 => noise(source, gauge),
        1 => segments(source, gauge),
        _ => picture_of_system(source, gauge),
    };
    let Some(picture) = picture else { return };
    gauge.reach("picture");
    let picture = Arc::new(picture);
    let question = question(source);
    let (index, count) = source.pick(&[(0, 1), (0, 1), (1, 2), (6, 7)]);
    let Ok(mut finder) = gauge.call("finder", || Finder::new(&picture, &question, Share { index, count })) else {
        return;
    };
    gauge.reach("search");
    if source.once_in(2)
        && let Some((definition, _)) = make::system(source)
    {
        let codes = gauge.call("compared", || picture.compared(&definition));
        assert!(codes.is_none_or(|codes| codes.iter().all(|code| [0, 1, 2, 4].contains(code))));
        finder.try_first([Named { name: "a system".to_owned(), definition }]);
        gauge.reach("named");
    }
    let _ = (0..STEPS).any(|_| gauge.call("step", || finder.step(STEP)) == Searched::All);
    check(finder.found(), gauge);
    let (found, words) = gauge.call("merged", || merged(&[&finder, &finder]));
    assert!(!words.is_empty() && !finder.searched().is_empty());
    assert!(found.len() <= finder.found().len(), "the same search twice finds no more");
}

/// The known properties of a system: mostly few, and seldom in range.
fn question(source: &mut Source<'_>) -> Question {
    const AXIOMS: [&str; 16] =
        ["F", "X", "F-F-F-F", "F+F+F", "FX", "X+X", "[F]", "F[+F]F", "-F", "", " ", "[", "]F", "🌿", "F(1)", "A+B"];
    Question {
        axiom: source.once_in(2).then(|| {
            let axiom = source.pick(&AXIOMS);
            axiom.repeat(source.times(20, &[10, 100, 1000]))
        }),
        // Angles take long to suggest, so they are mostly known.
        angle: (!source.once_in(4)).then(|| source.usual(8, &[90.0, 60.0, 25.7, 45.0, 120.0, 180.0, 1.0, 0.01, 360.0])),
        heading: source.once_in(2).then(|| source.usual(8, &[90.0, 0.0, 60.0, -45.0, 1e6])),
        n: source.once_in(2).then(|| source.pick(&[1, 2, 3, 4, 5, 8, 12, 0, 13, u32::MAX])),
        draws: source.once_in(3).then(|| source.pick(&["F", "FG", "X", "", "🌿", "FF"]).to_owned()),
    }
}

/// A picture of grey noise: blocks, stripes, or single pixels.
fn noise(source: &mut Source<'_>, gauge: &mut Gauge) -> Option<Picture> {
    let side = |source: &mut Source<'_>| source.pick(&[64, 1, 2, 3, 17, 100, 300, 512, 700, 0]);
    let (width, height) = (side(source), side(source));
    let cell = [source.pick(&[1, 2, 8, 50, 1000]), source.pick(&[1, 2, 8, 50, 1000])];
    let levels = source.pick(&[2, 2, 3, 256]);
    let sparse = source.pick(&[2, 3, 10, 50]);
    let bytes = source.bytes(1024);
    let level = |x: usize, y: usize| {
        let at = (y / cell[1]).wrapping_mul(31).wrapping_add(x / cell[0]);
        let byte = usize::from(bytes.get(at % bytes.len().max(1)).copied().unwrap_or_default());
        let byte = (byte ^ at.wrapping_mul(0x9e37_79b1) >> 8) & 255;
        if byte.is_multiple_of(sparse) { (byte % levels * 255 / levels) as u8 } else { 255 }
    };
    let grey: Vec<u8> = (0..width * height).map(|at| level(at % width.max(1), at / width.max(1))).collect();
    if source.once_in(3) {
        let straight = gauge.call("photograph", || Photograph::straightened(&grey, width, height));
        if let Some(Photograph { grey, width, height }) = straight {
            gauge.reach("photograph");
            assert_eq!(grey.len(), width * height);
            return gauge.call("picture", || Picture::new(&grey, width, height)).ok();
        }
    }
    gauge.call("picture", || Picture::new(&grey, width, height)).ok()
}

/// A picture of random segments.
fn segments(source: &mut Source<'_>, gauge: &mut Gauge) -> Option<Picture> {
    let extreme = source.once_in(3);
    let segments: Vec<[f64; 4]> = (0..source.pick(&[0, 1, 2, 5, 30]))
        .map(|_| {
            [(); 4].map(|()| if extreme && source.once_in(3) { source.number() } else { source.between(0, 20) as f64 })
        })
        .collect();
    gauge.call("picture of segments", || Picture::of_segments(&segments)).ok()
}

/// A picture of a random system.
fn picture_of_system(source: &mut Source<'_>, gauge: &mut Gauge) -> Option<Picture> {
    let (definition, system) = make::system(source)?;
    let drawing = draw(&system, definition.iterations.min(6), &LIMITS).ok()?;
    if source.once_in(2) {
        let mut arrays = SegmentArrays::default();
        drawing.write_segments(LIMITS.segments, &mut arrays).ok()?;
        let segments: Vec<[f64; 4]> = drawing.segments().map(|s| [s.from[0], s.from[1], s.to[0], s.to[1]]).collect();
        return gauge.call("picture of segments", || Picture::of_segments(&segments)).ok();
    }
    let (width, height) = (source.pick(&[200, 64, 400]), source.pick(&[200, 64, 400]));
    let mut renderer = Renderer::new();
    renderer.load(Arc::new(drawing));
    renderer.begin(&system.style, Viewport { width, height, ratio: 1.0 }, View::default());
    while renderer.step(100_000) == Progress::More {}
    let grey: Vec<u8> = renderer.pixels().chunks_exact(4).map(|pixel| pixel[1]).collect();
    gauge.call("picture", || Picture::new(&grey, width as usize, height as usize)).ok()
}

/// Checks that what was found are systems whose agreement is a part.
fn check(found: &[Drawn], gauge: &mut Gauge) {
    for drawn in found {
        gauge.reach("found");
        assert!((0.0..=1.0).contains(&drawn.agreement), "{drawn:?}");
        let definition = drawn.definition();
        assert!(System::new(&definition).is_ok(), "{drawn:?} is no system");
    }
}

/// Rules of random strings, and of strings of random systems.
pub(super) fn strings_found(source: &mut Source<'_>, gauge: &mut Gauge) {
    let text = if source.once_in(3) {
        let pieces = ["F", "+", "-", "[", "]", "F+F", "AB", "A", " ", "\n", "🌿", "F(1)", "`", "{", "1", "λ"];
        (0..source.between(0, 40)).map(|_| source.pick(&pieces)).collect::<String>()
    } else {
        let Some((definition, system)) = make::system(source) else { return };
        let Ok(text) = expand(&system, definition.iterations.min(6), &LIMITS) else { return };
        text
    };
    let question = question(source);
    let Ok(mut finder) = gauge.call("finder", || StringFinder::new(&text, &question)) else { return };
    gauge.reach("search");
    let _ = (0..STEPS).any(|_| gauge.call("step", || finder.step(STEP as usize)) == Searched::All);
    assert!(!finder.searched().is_empty());
    let found = gauge.call("found", || finder.found());
    check(&found, gauge);
    let symbols: String = text.chars().filter(|symbol| !symbol.is_whitespace()).collect();
    for drawn in found {
        let Ok(system) = System::new(&drawn.definition()) else { continue };
        if expand(&system, drawn.found.n, &LIMITS).ok().as_ref() != Some(&symbols) {
            panic!("the rules derive another string: {drawn:?}");
        }
    }
}
