//! Zooming about a line to any depth, as the page does it.

use super::{Bench, definition};
use lsystem::drawing::Origin;
use lsystem::render::seen_from;
use lsystem::{Definition, View, Viewport};

const VIEWPORT: Viewport = Viewport { width: 320, height: 200, ratio: 1.0 };
/// As on the page, in pixels.
const NEAR: f64 = 24.0;
/// As on the page: beyond this zoom, views are about a segment; always if there are more than 2^128.
const DEEP: f64 = 1e12;

/// A page: its view, and the place that it holds while it zooms.
struct Page {
    bench: Bench,
    scale: f64,
    is_enormous: bool,
    view: View,
    at: Option<String>,
    held: Option<[f64; 4]>,
}

impl Page {
    fn of(definition: &Definition) -> Self {
        let mut bench = Bench::new();
        bench.session.look(VIEWPORT, View::default(), None);
        bench.session.define(definition.clone());
        let scale = bench.settle().0.last().unwrap().scale;
        let is_enormous = definition.iterations > 64;
        Self { bench, scale, is_enormous, view: View::default(), at: None, held: None }
    }

    /// Where a place is seen, in pixels from the upper left corner.
    fn seen(&self, place: [f64; 4]) -> [f64; 2] {
        let View { x, y, zoom, fine } = self.view;
        let [dx, dy, fine_x, fine_y] = seen_from([x, y, fine[0], fine[1]], place);
        let pixels = self.scale * zoom;
        [160.0 + (dx + fine_x) * pixels, 100.0 - (dy + fine_y) * pixels]
    }

    /// Moves the view's centre by a part of the picture at zoom 1.
    fn move_by(&mut self, [x, y]: [f64; 2]) {
        let View { x: x0, y: y0, fine, .. } = self.view;
        // The sum, with its rounding remainders.
        let [x, y, fine_x, fine_y] = seen_from([-x, -y, 0.0, 0.0], [x0, y0, fine[0], fine[1]]);
        self.view = View { x, y, fine: [fine_x, fine_y], ..self.view };
    }

    /// Makes a place near `at` the origin, and holds it.
    fn anchor(&mut self, [x, y]: [f64; 2], reach: f64) {
        let Some(anchor) = self.bench.session.anchor(x, y, reach) else { return };
        let place: [f64; 4] = anchor.place.try_into().unwrap();
        let before = self.seen(place);
        let View { x, y, fine, .. } = self.view;
        let [x, y, fine_x, fine_y] = seen_from(place, [x, y, fine[0], fine[1]]);
        self.view = View { x, y, fine: [fine_x, fine_y], ..self.view };
        (self.at, self.held) = (Some(anchor.at), Some([0.0; 4]));
        let after = self.seen([0.0; 4]);
        assert!((before[0] - after[0]).abs() + (before[1] - after[1]).abs() < 1e-3, "{before:?} {after:?}");
        self.look();
    }

    fn look(&mut self) {
        self.bench.session.set_origin(self.at.as_deref().map(|at| Origin::read(at).unwrap()));
        self.bench.session.look(VIEWPORT, self.view, None);
    }

    /// One turn of the wheel.
    fn zoom(&mut self, factor: f64, at: [f64; 2]) {
        let deep = self.is_enormous || self.view.zoom > DEEP;
        if deep && (self.at.is_none() || self.held.is_none()) {
            self.anchor(at, NEAR);
        } else if self.held.is_none() {
            let picked = self.bench.session.pick(at[0], at[1], NEAR).stroke;
            self.held = picked.map(|stroke| stroke.fitted_from.try_into().unwrap());
        }
        let [x, y] = self.held.map_or(at, |held| self.seen(held));
        let zoom = self.view.zoom * factor;
        let shift = (1.0 / self.view.zoom - 1.0 / zoom) / self.scale;
        self.move_by([(x - 160.0) * shift, (100.0 - y) * shift]);
        self.view.zoom = zoom;
        self.look();
    }
}

fn koch(n: u32) -> Definition {
    definition("F--F--F", "F -> F+F--F+F", 60.0, n)
}

/// Zooms from one place of the pointer, and looks at each depth for the line that is held.
fn dive(definition: &Definition, at: [f64; 2], deepest: f64) -> Page {
    let mut page = Page::of(definition);
    let mut first: Option<[f64; 2]> = None;
    for turn in 0.. {
        page.zoom([1.2, 1.7, 1.45, 1.8][turn % 4], at);
        let zoom = page.view.zoom;
        let Some(held) = page.held else { continue };
        let [x, y] = page.seen(held);
        // The held place stays where it is, but for the choice of another one nearby where views begin to be about it.
        let [x0, y0] = *first.get_or_insert([x, y]);
        let moved = (x - x0).abs() + (y - y0).abs();
        assert!(moved < if page.at.is_some() { 2.0 * NEAR } else { 1e-6 }, "{zoom:e}: moved by {moved}");
        if page.at.is_some() {
            let session = &page.bench.session;
            // Segments beyond the first 2^128 of a picture are not picked.
            let picked = session.pick(x, y, 4.0).segment;
            let found =
                picked.or_else(|| session.anchor(x, y, 4.0).filter(|_| page.is_enormous).map(|anchor| anchor.at));
            assert!(found.is_some(), "{zoom:e}: nothing at {x} {y}, about {:?} {:?}", page.at, page.view);
        }
        if zoom > deepest {
            break;
        }
    }
    page
}

#[test]
fn a_held_line_stays_under_the_pointer_at_any_depth() {
    dive(&koch(60), [112.0, 23.0], 1e120);
}

#[test]
fn a_place_on_a_long_segment_is_held_at_any_depth() {
    dive(&koch(4), [112.0, 23.0], 1e120);
}

#[test]
fn a_line_among_countless_segments_is_held() {
    let mut page = dive(&koch(1000), [112.0, 23.0], 1e20);
    // Then lines elsewhere in the picture, at all depths.
    let mut numbers = vec![];
    while page.view.zoom < 1e295 {
        let [x, y] = page.seen([0.0; 4]);
        page.zoom(1e6, [x, y]);
        page.anchor([x + 60.0, y], 90.0);
        numbers.extend(page.at.clone());
    }
    numbers.dedup();
    assert!(numbers.len() > 20, "{}", numbers.len());
}

/// The part that is played so far is the same in a close-up as in the usual view, with the turtle at its end.
#[test]
fn playback_is_the_same_from_near() {
    let mut page = Page::of(&koch(5));
    page.view = View { x: -0.2, y: 0.2, zoom: 4.0, fine: [0.0; 2] };
    page.look();
    page.bench.settle();
    let usual = |page: &mut Page, upto| {
        page.bench.session.play(upto);
        let (drawn, _) = page.bench.settle();
        (page.bench.screen.pixels(), drawn.last().unwrap().pose.clone())
    };
    let parts = [1, 700, 800, 1000, 3000].map(Some);
    let whole = parts.map(|upto| usual(&mut page, upto));
    assert!(whole.windows(2).all(|two| two[0].0 != two[1].0));
    page.bench.session.play(None);
    page.anchor([160.0, 100.0], 200.0);
    assert!(page.at.is_some());
    for (upto, (pixels, pose)) in parts.into_iter().zip(whole) {
        let (near, turtle) = usual(&mut page, upto);
        let differing = near.chunks(4).zip(pixels.chunks(4)).filter(|(a, b)| a[0].abs_diff(b[0]) > 16).count();
        assert!(differing < 4, "{upto:?}: {differing}");
        let (pose, turtle) = (pose.unwrap(), turtle.unwrap());
        assert!(pose.at.iter().zip(&turtle.at).all(|(a, b)| (a - b).abs() < 1e-9 * (1.0 + a.abs())));
    }
}
