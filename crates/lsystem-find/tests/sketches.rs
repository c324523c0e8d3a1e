//! Sketches by hand are told as nearest to a system, never as found.

use lsystem_base::Limits;
use lsystem_drawing::{Plane, System, draw};
use lsystem_files::read_link;
use lsystem_find::{FOUND, Finder, Named, Picture, Question, SIDE, Share};
use lsystem_syntax::Definition;
use std::sync::Arc;

/// The side of a sketch, its margin and half the width of its lines, in pixels.
const WIDTH: usize = 900;
const MARGIN: f64 = 40.0;
const REACH: f64 = 2.5;
/// The places of a stroke that a hand draws straight.
const PLACES: usize = 24;

/// Numbers by chance (Steele et al., SplitMix64), from -1 to 1.
struct Chance(u64);

impl Chance {
    fn part(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut at = self.0;
        at = (at ^ (at >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        at = (at ^ (at >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((at ^ (at >> 31)) >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// A system as somebody draws it by hand: each stroke begins and ends up to `wobble` pixels beside its place, so corners
/// stay open, and bends by as much on its way.
fn sketch(definition: &Definition, wobble: f64, seed: u64) -> Vec<u8> {
    let system = System::new(definition).expect("a system");
    let drawing = draw::<Plane>(&system, definition.iterations, &Limits::default()).expect("a drawing");
    let [left, low, right, high] = drawing.bounds().expect("strokes");
    let scale = (WIDTH as f64 - 2.0 * MARGIN) / (right - left).max(high - low);
    let mut chance = Chance(seed);
    let mut grey = vec![255; WIDTH * WIDTH];
    for segment in drawing.segments() {
        let mut moved = |[x, y]: [f64; 2]| {
            let (x, y) = ((x - left) * scale + MARGIN, (high - y) * scale + MARGIN);
            [x + wobble * chance.part(), y + wobble * chance.part()]
        };
        let (from, to) = (moved(segment.from), moved(segment.to));
        let bend = [(); 2].map(|()| wobble * chance.part());
        for place in 0..=PLACES {
            let along = place as f64 / PLACES as f64;
            let bent = libm::sin(along * std::f64::consts::PI);
            dot(&mut grey, [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * along + bend[axis] * bent));
        }
    }
    grey
}

fn dot(grey: &mut [u8], [x, y]: [f64; 2]) {
    let near = |at: f64| (at - REACH).max(0.0) as usize..=(at + REACH).min(WIDTH as f64 - 1.0) as usize;
    for (row, column) in near(y).flat_map(|row| near(x).map(move |column| (row, column))) {
        if libm::hypot(column as f64 + 0.5 - x, row as f64 + 0.5 - y) <= REACH {
            grey[row * WIDTH + column] = 0;
        }
    }
}

fn gallery() -> Vec<Named> {
    let read = |line: &str| {
        let (path, link) = line.split_once('\t')?;
        Some(Named { name: path.to_owned(), definition: read_link(link)?.definition })
    };
    include_str!("../../lsys/src/find/gallery.txt").lines().filter_map(read).collect()
}

fn figure(axiom: &str, rules: &str, n: u32, angle: f64, heading: f64) -> Definition {
    let (axiom, rules) = (axiom.to_owned(), rules.to_owned());
    Definition { axiom, rules, iterations: n, angle, heading, ..Definition::default() }
}

#[test]
fn a_sketch_is_told_as_nearest_and_never_as_found() {
    let koch = figure("F", "F -> F+F--F+F", 3, 60.0, 0.0);
    let plant = figure("X", "X -> F[+X][-X]FX\nF -> FF", 4, 25.7, 90.0);
    for (figure, seed) in [(&koch, 1), (&koch, 2), (&plant, 3), (&plant, 4)] {
        let grey = sketch(figure, 5.0, seed);
        let picture = Arc::new(Picture::new(&grey, WIDTH, WIDTH).expect("lines"));
        let mut finder = Finder::new(&picture, &Question::default(), Share::WHOLE).expect("a search");
        finder.try_first(gallery());
        finder.step(200_000);
        let nearest = finder.found().first().expect("a nearest system");
        assert_eq!(nearest.found.n, figure.iterations);
        assert_eq!(nearest.rules().replace(' ', ""), figure.rules.replace(' ', ""));
        assert!(!finder.is_found() && !nearest.is_same() && nearest.agreement < FOUND, "{nearest:?}");
        // What differs is shown, on both sides.
        let pixels = picture.compared(&nearest.definition()).expect("laid on the sketch");
        assert_eq!(pixels.len(), SIDE * SIDE);
        for code in [1, 2, 4] {
            assert!(pixels.contains(&code), "{code}");
        }
    }
}
