//! The rules of pictures that are drawn here, naively, with strokes of any width.

use lsystem_base::{Limits, Progress};
use lsystem_drawing::{Plane, System, draw};
use lsystem_find::{
    Drawn, FOUND, Finder, Found, Known, Named, Picture, PictureSearch, Question, Searched, Share, merged,
};
use lsystem_render::{Renderer, View, Viewport};
use lsystem_syntax::{Colour, Definition, Dialect, Style};
use std::sync::Arc;

/// Systems that are tried at most.
const MAX: u64 = 4_000_000;

/// Replaces every symbol in each step.
fn derive(axiom: &str, rules: &[(char, &str)], n: u32) -> String {
    (0..n).fold(axiom.to_owned(), |word, _| {
        let successor =
            |c: char| rules.iter().find(|rule| rule.0 == c).map_or_else(|| c.to_string(), |rule| rule.1.into());
        word.chars().map(successor).collect()
    })
}

/// The segments of a word; `draws` are the letters that draw.
fn walk(word: &str, draws: &str, angle: f64, heading: f64) -> Vec<[f64; 4]> {
    let (mut at, mut stack, mut found) = ((0.0, 0.0, heading), vec![], vec![]);
    for c in word.chars() {
        let (x, y, degrees): (f64, f64, f64) = at;
        match c {
            '+' => at.2 += angle,
            '-' => at.2 -= angle,
            '[' => stack.push(at),
            ']' => at = stack.pop().unwrap(),
            _ if draws.contains(c) => {
                let (sin, cos) = libm::sincos(degrees.to_radians());
                found.push([x, y, x + cos, y + sin]);
                (at.0, at.1) = (x + cos, y + sin);
            }
            _ => {}
        }
    }
    found
}

/// A picture with sides of 600 pixels whose longer side is filled up to a margin, with strokes of a width.
fn drawn(segments: &[[f64; 4]], width: f64) -> Picture {
    const SIDE: usize = 600;
    let places = || segments.iter().flat_map(|&[a, b, c, d]| [[a, b], [c, d]]);
    let range = |axis: usize| {
        let low = places().map(|at| at[axis]).fold(f64::INFINITY, f64::min);
        (low, places().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max) - low)
    };
    let [(left, wide), (low, high)] = [range(0), range(1)];
    let unit = 500.0 / wide.max(high);
    let mut grey = vec![255; SIDE * SIDE];
    for [a, b, c, d] in segments {
        let pixel = |x: f64, y: f64| ((x - left) * unit + 40.3, 560.6 - (y - low) * unit);
        let ((x1, y1), (x2, y2)) = (pixel(*a, *b), pixel(*c, *d));
        let reach = width / 2.0;
        let (dx, dy) = (x2 - x1, y2 - y1);
        for y in (y1.min(y2) - reach) as usize..=(y1.max(y2) + reach) as usize {
            for x in (x1.min(x2) - reach) as usize..=(x1.max(x2) + reach) as usize {
                let (px, py) = (x as f64 + 0.5 - x1, y as f64 + 0.5 - y1);
                let along = ((px * dx + py * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
                if libm::hypot(px - along * dx, py - along * dy) <= reach {
                    grey[y * SIDE + x] = 0;
                }
            }
        }
    }
    Picture::new(&grey, SIDE, SIDE).expect("lines")
}

/// The best system after at most [`MAX`] systems.
fn best(picture: Picture, axiom: &str, angle: f64, steps: &[u32]) -> (Option<Drawn>, Vec<(String, usize)>) {
    let known = Known { axiom: axiom.to_owned(), angle, headings: vec![90.0], steps: steps.to_vec(), draws: None };
    let mut search = PictureSearch::new(Arc::new(picture), known, Share::WHOLE).expect("a search");
    let mut left = MAX;
    let is_same = |search: &PictureSearch| search.found().first().is_some_and(Drawn::is_same);
    while left > 0 && !is_same(&search) && search.step(10_000) == Searched::More {
        left -= 10_000;
    }
    (search.found().first().cloned(), search.searched())
}

/// An axiom, its rules, the letters that draw, the angle and the number of steps.
type Case = (&'static str, &'static [(char, &'static str)], &'static str, f64, u32);

const CASES: [Case; 17] = [
    // The four pictures of the assignment.
    ("F", &[('F', "F[+F]F")], "F", 60.0, 6),
    ("F+F+F+F", &[('F', "F-FF+F+FF-F")], "F", 90.0, 3),
    ("-F+F+F+F+F+F", &[('F', "F-F++F-F")], "F", 60.0, 4),
    ("T", &[('T', "F[+T][-T]"), ('F', "FF")], "TF", 120.0, 6),
    // Curves of The Algorithmic Beauty of Plants, chapter 1.
    ("-F", &[('F', "F+F-F-F+F")], "F", 90.0, 4),
    ("F", &[('F', "F+G"), ('G', "F-G")], "FG", 90.0, 8),
    ("F", &[('F', "G+F+G"), ('G', "F-G-F")], "FG", 60.0, 6),
    ("X", &[('X', "F[+X][-X]X"), ('F', "FF")], "F", 25.0, 5),
    // Plants whose successors are too long to be tried one after the other.
    ("F", &[('F', "F[+F]F[-F]F")], "F", 25.7, 4),
    ("X", &[('X', "F[-X][X]F[-X]+FX"), ('F', "FF")], "F", 22.5, 5),
    ("X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], "F", 20.0, 6),
    ("F", &[('F', "FF-[-F+F+F]+[+F-F-F]")], "F", 22.5, 4),
    // An angle that leads to many headings.
    ("F", &[('F', "F[+F]F[-F]")], "F", 25.7, 4),
    // Curves whose successors are read from their edges: figure 1.7a, and those of Gosper, Hilbert and Peano.
    ("F-F-F-F", &[('F', "F+FF-FF-F-F+F+FF-F-F+F+FF+FF-F")], "F", 90.0, 2),
    ("F", &[('F', "F+G++G-F--FF-G+"), ('G', "-F+GG++G+F--F-G")], "FG", 60.0, 3),
    ("X", &[('X', "+YF-XFX-FY+"), ('Y', "-XF+YFY+FX-")], "F", 90.0, 5),
    ("X", &[('X', "XFYFX+F+YFXFY-F-XFYFX"), ('Y', "YFXFY-F-XFYFX+F+YFXFY")], "F", 90.0, 2),
];

#[test]
fn rules_of_pictures_are_found() {
    const WIDTHS: [f64; 2] = [1.5, 3.0];
    for (number, (axiom, rules, draws, angle, n)) in test_effort::sampled(CASES.into_iter().enumerate(), 3, 1) {
        // The width decides how well the lines are read, not which rules are tried: neighbouring cases, which are alike,
        // have different widths.
        let widths = if test_effort::is_thorough() { &WIDTHS[..] } else { &WIDTHS[number % 2..][..1] };
        for &width in widths {
            let segments =
                |rules: &[(char, &str)], draws: &str, n: u32| walk(&derive(axiom, rules, n), draws, angle, 90.0);
            let picture = drawn(&segments(rules, draws, n), width);
            let (best, searched) = best(picture.clone(), axiom, angle, &[n]);
            let best = best.unwrap_or_else(|| panic!("{axiom} {rules:?} {width}: {searched:?}"));
            assert!(best.agreement >= FOUND, "{axiom} {rules:?} {width}: {best:?}");
            // The rules may be others, if they draw the same: the naive picture says so.
            let rules: Vec<(char, &str)> = best.found.rules.iter().map(|(from, to)| (*from, to.as_str())).collect();
            let again = drawn(&segments(&rules, &best.draws, best.found.n), width);
            assert!(picture.agreement(&again) > FOUND, "{axiom} {rules:?} {width}");
            assert!(best.is_same(), "{axiom} {rules:?} {width}: {best:?}");
        }
    }
}

#[test]
fn systems_of_which_nothing_is_known_are_found() {
    for (axiom, rules, angle, n) in [
        ("F", [('F', "F[+F]F")], 60.0, 5),
        ("F-F-F-F", [('F', "F-F+F+F-F")], 90.0, 3),
        ("F", [('F', "F+F--F+F")], 60.0, 4),
    ] {
        let picture = Arc::new(drawn(&walk(&derive(axiom, &rules, n), "F", angle, 90.0), 2.0));
        let mut finder = Finder::new(&picture, &Question::default(), Share::WHOLE).expect("a search");
        let mut left = MAX;
        while left > 0 && !finder.is_found() && finder.step(10_000) == Searched::More {
            left -= 10_000;
        }
        assert!(finder.is_found(), "{axiom} {rules:?}: {:?} {}", finder.found(), finder.searched());
        // The definition is a system that the whole library reads and draws.
        let definition = finder.found()[0].definition();
        let system = System::new(&definition).expect("a system");
        let drawing = draw::<Plane>(&system, definition.iterations, &Limits::default()).expect("a drawing");
        let segments: Vec<[f64; 4]> =
            drawing.segments().map(|at| [at.from[0], at.from[1], at.to[0], at.to[1]]).collect();
        assert!(picture.agreement(&drawn(&segments, 2.0)) >= FOUND, "{definition:?}");
        let (merged, searched) = merged(&[&finder, &finder]);
        assert_eq!((merged.first(), searched), (finder.found().first(), finder.searched()));
    }
}

#[test]
fn the_number_of_steps_is_found() {
    let picture = drawn(&walk(&derive("F", &[('F', "F[+F]F")], 5), "F", 60.0, 90.0), 2.0);
    let best = best(picture, "F", 60.0, &[1, 2, 3, 4, 5, 6, 7, 8]).0.expect("a system");
    assert_eq!((best.found.text().as_str(), best.found.n), ("F -> F[+F]F", 5));
}

#[test]
fn pictures_of_other_systems_are_not_told_as_found() {
    let three: [(char, &str); 3] = [('F', "F[+G]-F"), ('G', "H+F[-H]"), ('H', "G[+F]+FH")];
    let mut state = 7_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state >> 8) / f64::from(1 << 24) * 30.0
    };
    let scribbles: Vec<Vec<[f64; 4]>> =
        (0..3).map(|_| (0..40).map(|_| [random(), random(), random(), random()]).collect()).collect();
    let grown = walk(&derive("F", &three, 5), "FGH", 40.0, 90.0);
    for segments in scribbles.iter().chain([&grown]) {
        let known =
            Known { axiom: "F".to_owned(), angle: 40.0, headings: vec![90.0], steps: vec![3, 4, 5], draws: None };
        let mut search = PictureSearch::new(Arc::new(drawn(segments, 2.0)), known, Share::WHOLE).expect("a search");
        search.step(200_000);
        assert!(search.found().iter().all(|drawn| drawn.agreement < FOUND), "{:?}", search.found());
    }
}

#[test]
fn what_cannot_be_searched_is_told() {
    let picture = Arc::new(drawn(&[[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]], 2.0));
    let known = Known { axiom: "F".to_owned(), angle: 90.0, headings: vec![90.0], steps: vec![3], draws: None };
    for (wrong, said) in [
        (Known { axiom: "F(1)".to_owned(), ..known.clone() }, "letters, turns"),
        (Known { axiom: "F]".to_owned(), ..known.clone() }, "closed"),
        (Known { axiom: "FGH".to_owned(), ..known.clone() }, "one or two letters"),
        (Known { axiom: String::new(), ..known.clone() }, "one or two letters"),
        (Known { angle: 0.0, ..known.clone() }, "angle"),
        (Known { angle: f64::NAN, ..known.clone() }, "angle"),
        (Known { steps: vec![13], ..known.clone() }, "1 to 12"),
        (Known { headings: vec![], ..known }, "heading"),
    ] {
        let told = PictureSearch::new(picture.clone(), wrong.clone(), Share::WHOLE);
        assert!(told.as_ref().is_err_and(|why| why.contains(said)), "{wrong:?} {:?}", told.err());
    }
}

/// A search of a picture on which nearly everything lies asks often whether it is over.
#[test]
fn a_search_ends_soon_after_it_is_over() {
    let mut state = 5_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        if state >> 30 == 0 { 0 } else { 255 }
    };
    let noise: Vec<u8> = (0..512 * 512).map(|_| random()).collect();
    let picture = Arc::new(Picture::new(&noise, 512, 512).expect("lines"));
    let mut finder = Finder::new(&picture, &Question::default(), Share::WHOLE).expect("a search");
    let asked = core::cell::Cell::new(0);
    let is_over = || {
        asked.set(asked.get() + 1);
        asked.get() > 20
    };
    assert_eq!(finder.step_until(1 << 20, &is_over), Searched::More);
    assert!(finder.tried() <= 20 * 16, "{}", finder.tried());
    assert!(asked.get() < 100, "{}", asked.get());
}

/// A drawing of a system by our renderer, black on white, as a JPEG file gives it back: levels of grey.
fn photographed(definition: &Definition, side: u32, stroke: f64, quality: u8) -> Vec<u8> {
    let black = Style {
        palette: vec![Colour { rgb: [0; 3] }],
        background: Colour { rgb: [255; 3] },
        width: 0.0,
        min_width: stroke,
        ..Style::default()
    };
    let system = System::new(&Definition { style: black, ..definition.clone() }).expect("a system");
    let drawing = draw::<Plane>(&system, definition.iterations, &Limits::default()).expect("a drawing");
    let mut renderer = Renderer::new();
    renderer.load(Arc::new(drawing));
    renderer.begin(&system.style, Viewport { width: side, height: side, ratio: 1.0 }, View::default());
    while renderer.step(1 << 20) == Progress::More {}
    let colours: Vec<u8> = renderer.pixels().chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    let mut file = Vec::new();
    let mut encoder = image::codecs::jpeg::JpegEncoder::new_with_quality(&mut file, quality);
    encoder.encode(&colours, side, side, image::ExtendedColorType::Rgb8).expect("a JPEG");

    image::load_from_memory(&file).expect("a picture").into_luma8().into_raw()
}

fn textbook() -> Definition {
    Definition {
        axiom: "X".to_owned(),
        rules: "X -> F[+X][-X]FX\nF -> FF".to_owned(),
        iterations: 5,
        angle: 25.7,
        dialect: Dialect::Abop,
        ..Definition::default()
    }
}

/// The rules that draw the same picture, best first, of which nothing is known; a system that is only nearly the same
/// does not end the search.
fn searched(picture: &Arc<Picture>, named: &[Named], most: u64) -> Vec<Drawn> {
    let mut finder = Finder::new(picture, &Question::default(), Share::WHOLE).expect("a search");
    finder.try_first(named.iter().cloned());
    let mut left = most;
    while left > 0 && !finder.is_same() && finder.step(10_000) == Searched::More {
        left = left.saturating_sub(10_000);
    }
    assert!(finder.is_same(), "{:?}", finder.found());
    finder.found().to_vec()
}

/// Figure 1.24e of The Algorithmic Beauty of Plants, as in a textbook: 1200 pixels, lines of 3 pixels, a JPEG.
#[test]
fn the_rule_of_a_textbook_is_found_in_a_jpeg() {
    let grey = photographed(&textbook(), 1200, 3.0, 85);
    let picture = Arc::new(Picture::new(&grey, 1200, 1200).expect("lines"));
    let found = searched(&picture, &[], MAX);
    let best = &found[0];
    assert_eq!(
        (best.rules().as_str(), best.axiom.as_str(), best.found.n, best.angle),
        ("X -> F[+X][-X]FX\nF -> FF", "X", 5, 25.7),
        "{found:?}"
    );
    // With curled twigs at all tips it is nearly the same, and is not called the same.
    let curled = Definition { rules: "X -> FF[-F+F][-X][+X]FFX\nF -> FF".to_owned(), ..textbook() };
    for drawn in found.iter().filter(|drawn| drawn.is_same()) {
        let again = Picture::new(&photographed(&drawn.definition(), 1200, 3.0, 85), 1200, 1200).expect("lines");
        assert!(picture.agreement(&again) > 0.9999, "{drawn:?}");
    }
    let differs = |definition: &Definition| {
        let codes = picture.compared(definition).expect("a drawing");
        [2, 4].map(|code| codes.iter().filter(|&&at| at == code).count())
    };
    assert_eq!(differs(&textbook()), [0, 0]);
    let [missing, extra] = differs(&curled);
    assert!(missing < 20 && extra > 50, "{missing} {extra}");
    // The same with a name is told at once.
    let named = |name: &str, definition: Definition| Named { name: name.to_owned(), definition };
    let gallery = [named("Curled", curled), named("Forked tree", Definition { iterations: 7, ..textbook() })];
    let found = searched(&picture, &gallery, 100_000);
    let names: Vec<_> = found.iter().map(|drawn| drawn.named.as_ref().map(|named| named.name.as_str())).collect();
    assert_eq!((names[0], found[0].found.n, found[0].percent()), (Some("Forked tree"), 5, 100.0));
    let curled = found.iter().find(|drawn| drawn.named.as_ref().is_some_and(|named| named.name == "Curled"));
    assert!(curled.is_some_and(|drawn| !drawn.is_same() && drawn.percent() > 98.0), "{found:?}");
}

/// In 256 pixels, lines that are as far apart as they are wide show by the greys between them only.
#[test]
fn small_pictures_tell_by_their_soft_edges() {
    let flower = Definition {
        axiom: "T".to_owned(),
        rules: "T -> F[+T][-T]\nF -> FF".to_owned(),
        iterations: 7,
        angle: 120.0,
        overrides: "T: draw".to_owned(),
        ..Definition::default()
    };
    let picture = Arc::new(Picture::new(&photographed(&flower, 256, 1.5, 95), 256, 256).expect("lines"));
    let question = Question { axiom: Some("T".to_owned()), angle: Some(120.0), n: Some(7), ..Question::default() };
    let mut finder = Finder::new(&picture, &question, Share::WHOLE).expect("a search");
    let mut left = MAX;
    while left > 0 && !finder.is_same() && finder.step(10_000) == Searched::More {
        left = left.saturating_sub(10_000);
    }
    let best = finder.found().first().expect("a system");
    let large =
        |definition: &Definition| Picture::new(&photographed(definition, 1200, 1.5, 95), 1200, 1200).expect("lines");
    assert!(best.is_same() && large(&best.definition()).agreement(&large(&flower)) > 0.999, "{best:?}");
}

/// The hull of a polygon with twelve sides is a circle in the twelve directions of its turns.
#[test]
fn polygons_are_found() {
    let lines = walk(&derive("F", &[('F', "+F-F-")], 8), "F", 30.0, 90.0);
    let (found, _) = best(drawn(&lines, 3.0), "F", 30.0, &[8]);
    assert!(found.is_some_and(|found| found.is_same()));
}

#[test]
fn names_are_tried_for_what_is_known_only() {
    let grey = photographed(&textbook(), 600, 2.0, 90);
    let picture = Arc::new(Picture::new(&grey, 600, 600).expect("lines"));
    let is_found = |question: Question| {
        let mut finder = Finder::new(&picture, &question, Share::WHOLE).expect("a search");
        finder.try_first([Named { name: "Forked tree".to_owned(), definition: textbook() }]);
        finder.step(1024);
        finder.is_same()
    };
    let usual = Question::default();
    for (question, expected) in [
        (usual.clone(), true),
        (Question { axiom: Some("X ".to_owned()), angle: Some(25.7), n: Some(5), ..usual.clone() }, true),
        (Question { draws: Some("F".to_owned()), heading: Some(450.0), ..usual.clone() }, true),
        (Question { axiom: Some("F".to_owned()), ..usual.clone() }, false),
        (Question { angle: Some(25.0), ..usual.clone() }, false),
        (Question { n: Some(4), ..usual.clone() }, false),
        (Question { heading: Some(0.0), ..usual.clone() }, false),
        (Question { draws: Some("FX".to_owned()), axiom: Some("X".to_owned()), ..usual }, false),
    ] {
        assert_eq!(is_found(question.clone()), expected, "{question:?}");
    }
}

/// Curled twigs that the picture does not have are little ink, and agree by more than [`FOUND`].
#[test]
fn nearly_the_same_is_not_the_same() {
    let found = |rules: &[(char, &str)], width: f64| {
        let picture = |rules: &[(char, &str)]| drawn(&walk(&derive("X", rules, 5), "F", 25.7, 90.0), width);
        let agreement = picture(&[('X', "F[+X][-X]FX"), ('F', "FF")]).agreement(&picture(rules));
        let (axiom, draws) = ("X".to_owned(), "F".to_owned());
        let found = Found { rules: rules.iter().map(|(from, to)| (*from, (*to).to_owned())).collect(), n: 5 };
        Drawn { axiom, found, draws, angle: 25.7, heading: 90.0, agreement, named: None }
    };
    for width in [1.5, 3.0] {
        let curled = found(&[('X', "FF[-F+F][-X][+X]FFX"), ('F', "FF")], width);
        assert!(!curled.is_same() && curled.percent() < 100.0, "{width}: {curled:?}");
        for rules in [[('X', "F[+X][-X]FX"), ('F', "FF")], [('X', "F[-X][+X]FX"), ('F', "FF")]] {
            let same = found(&rules, width);
            assert!(same.is_same() && same.percent() == 100.0, "{width}: {same:?}");
        }
    }
    assert!(found(&[('X', "FF[-F+F][-X][+X]FFX"), ('F', "FF")], 3.0).agreement > 0.97);
}

#[test]
fn what_is_no_number_or_no_angle_is_refused() {
    let empty = [[0.0, f64::NAN, 1.0, f64::NAN], [f64::NAN, 0.0, f64::NAN, 1.0]];
    assert!(Picture::of_segments(&empty).is_err(), "nothing can be drawn");
    let picture = Arc::new(Picture::of_segments(&[[0.0, 0.0, 1.0, 0.0], [1.0, 0.0, 1.0, 1.0]]).unwrap());
    for angle in [1e-300, f64::MIN_POSITIVE, 0.0, -1e-17, f64::NAN, f64::INFINITY] {
        let question = Question { angle: Some(angle), ..Question::default() };
        assert!(Finder::new(&picture, &question, Share { index: 0, count: 1 }).is_err(), "{angle}");
    }
}
