//! The strokes of a system, and how much of their ink agrees with a picture.

use crate::align::{self, aligned};
use crate::brush::{PIXELS, put_stroke};
use crate::hull::{Block, Fit, Headings, Hulls, Place, System, Target};
use crate::picture::{LOOSE, NEAR_INK, Picture};
use crate::projection::Projection;
use lsystem_base::Mixer;
use lsystem_render::mask::{Mask, SIDE};
use std::collections::HashSet;
use std::hash::BuildHasherDefault;

/// The most strokes of one system.
const MAX_STROKES: usize = 100_000;
/// Blocks that are smaller than this many pixels are one dot.
const DOT: f64 = 0.7;
/// The pixels from one test of a stroke to the next.
const APART: f64 = 2.0;
/// A system is rejected if more than this share of its strokes lies outside the ink, plus some tests.
const BESIDE: f64 = 0.03;
const SOME: f64 = 8.0;
/// Parts of a drawing whose places differ by less than this many pixels are the same part.
const SAME: f64 = 0.25;
/// The same of a drawing's segments: a quarter of a pixel of the sheet.
const SAME_PLACE: f64 = 0.0625;
/// Larger than any distance within a picture: a conversion to an integer then saturates at the same end.
const FAR: f64 = 1e6;
/// Of systems that agree less, only the nearest one is kept.
pub(crate) const NEAR: f64 = 0.8;
/// The fit is improved only from this agreement on; that of strokes that a projection has laid, from the second one.
const PROMISING: f64 = 0.7;
const LAID: f64 = 0.9;
/// The changes of a fit, in pixels, that are tried one after the other.
const CHANGES: [f64; 3] = [0.5, 0.25, 0.12];
/// The changes of the half width of a photograph's lines, in pixels, that are tried.
const WIDTHS: [f64; 4] = [-1.0, -0.5, 0.0, 0.5];
/// The most times that each change is applied while it improves the fit.
const MAX_ROUNDS: usize = 6;
/// The most strokes that are put onto masks to improve one fit: of drawings with more than 50,000, fewer fits are tried.
const MAX_TRIED: usize = 8_000_000;

/// Strokes from place to place, in steps.
pub(crate) struct Strokes(Vec<[f64; 4]>);

/// Where strokes lie on a picture.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Laid {
    /// The cosine and the sine of the first heading.
    pub(crate) first: (f64, f64),
    pub(crate) fit: Fit,
    /// How the pixels are moved after that.
    pub(crate) by: Projection,
}

impl Laid {
    pub(crate) const fn straight(first: (f64, f64), fit: Fit) -> Self {
        Self { first, fit, by: Projection::NONE }
    }
}

/// A walk from the blocks of a system down to its strokes.
struct Tracer<'a> {
    system: System<'a>,
    hulls: &'a Hulls,
    radii: Vec<Vec<f64>>,
    target: &'a Target,
    picture: &'a Picture,
    fit: Fit,
    strokes: Vec<[f64; 4]>,
    /// The parts that were traced: letter, steps, heading and place.
    traced: HashSet<(u8, u8, u32, i32, i32), BuildHasherDefault<Mixer>>,
    tested: f64,
    beside: f64,
}

impl Strokes {
    /// The strokes after `n` steps, if they lie on the ink.
    pub(crate) fn on_ink(
        system: System,
        hulls: &Hulls,
        n: u32,
        target: &Target,
        picture: &Picture,
        fit: Fit,
    ) -> Option<Self> {
        let radii = (0..=n as usize).map(|n| hulls.level(n).iter().map(Block::radius).collect()).collect();
        let (strokes, traced, tested, beside) = (Vec::new(), HashSet::default(), 0.0, 0.0);
        let mut tracer = Tracer { system, hulls, radii, target, picture, fit, strokes, traced, tested, beside };
        tracer.word(system.axiom, n as usize, Place { x: 0.0, y: 0.0, turns: 0 })?;
        Some(Self(tracer.strokes))
    }

    /// Segments of a drawing in steps, each of `unit` pixels: of those that lie in the same places, one. `cos` and `sin` are
    /// those of the first heading.
    pub(crate) fn of_segments(
        segments: impl Iterator<Item = [[f64; 2]; 2]>,
        (cos, sin): (f64, f64),
        unit: f64,
    ) -> Self {
        let cell = |at: f64| (at * unit / SAME_PLACE) as i64;
        let mut seen = HashSet::<_, BuildHasherDefault<Mixer>>::default();
        let turned = |[x, y]: [f64; 2]| [x * cos + y * sin, y * cos - x * sin];
        let stroke = |[from, to]: [[f64; 2]; 2]| {
            let ([x1, y1], [x2, y2]) = (turned(from), turned(to));
            [x1, y1, x2, y2]
        };
        let is_new = |&[x1, y1, x2, y2]: &[f64; 4]| seen.insert((cell(x1), cell(y1), cell(x2), cell(y2)));
        Self(segments.map(stroke).filter(is_new).collect())
    }

    pub(crate) const fn count(&self) -> usize {
        self.0.len()
    }

    /// The work of a measure of the agreement, in systems that are unlike the picture.
    pub(crate) fn work(&self, fit: Fit, picture: &Picture) -> u64 {
        // Each change is tried eight times in a round, and mostly in two rounds.
        let once = self.work_once(fit) * (1 + CHANGES.len() as u64 * 16);
        if picture.is_photograph { once + align::WORK / PIXELS } else { once }
    }

    /// The work of one mask.
    pub(crate) fn work_once(&self, fit: Fit) -> u64 {
        let across = 2.0 * fit.stroke + 2.0;
        let length = |[x1, y1, x2, y2]: &[f64; 4]| libm::hypot(x2 - x1, y2 - y1) * fit.unit + across;
        let pixels = self.0.iter().map(length).sum::<f64>() * 2.0 * across;
        pixels as u64 / PIXELS
    }

    /// The part of the ink that agrees, with the best of the fits near this one.
    pub(crate) fn agreement(&self, target: &Target, picture: &Picture, fit: Fit) -> f64 {
        self.fitted(target.first, picture, fit).0
    }

    /// The part of the ink that agrees, and the best of the fits near this one. In a photograph, a small projection lays the
    /// strokes on the ink first. `first` is the cosine and the sine of the first heading.
    pub(crate) fn fitted(&self, first: (f64, f64), picture: &Picture, fit: Fit) -> (f64, Laid) {
        let straight = Laid::straight(first, fit);
        if picture.is_photograph { self.projected(picture, straight) } else { self.improved(picture, straight) }
    }

    /// As [`Strokes::fitted`], for a photograph.
    fn projected(&self, picture: &Picture, straight: Laid) -> (f64, Laid) {
        let fit = straight.fit;
        let mask = self.mask(straight);
        let agreement = mask.agreement(&picture.mask);
        // As few of the ink may lie far from the strokes as of the strokes from the ink.
        let near = (0..NEAR_INK + LOOSE).fold(mask, |mask, _| mask.grown());
        if (picture.mask.common(&near) as f64) < (1.0 - BESIDE) * picture.mask.count() as f64 {
            return (agreement, straight);
        }
        let pixels: Vec<_> = self.in_pixels(straight).collect();
        let laid = Laid { by: aligned(&pixels, &picture.mask, picture.stroke), ..straight };
        // The projection may lead astray. It does not tell how wide the lines are, nor does the ink where they are near.
        let wide = |by: f64| Laid { fit: Fit { stroke: (fit.stroke + by).max(0.5), ..fit }, ..laid };
        let all = WIDTHS.map(wide).into_iter().map(|laid| (self.mask(laid).agreement(&picture.mask), laid));
        let best =
            all.chain([(agreement, straight)]).max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((agreement, straight));
        if best.0 < LAID { best } else { self.improved(picture, best.1) }
    }

    /// As [`Strokes::fitted`], with this projection.
    fn improved(&self, picture: &Picture, laid: Laid) -> (f64, Laid) {
        let fit = laid.fit;
        let agreement = |fit: Fit| self.mask(Laid { fit, ..laid }).agreement(&picture.mask);
        let size = SIDE as f64 / fit.unit;
        let (mut best, mut most) = (fit, agreement(fit));
        if most < PROMISING {
            return (most, laid);
        }
        let mut left = MAX_TRIED / self.count().max(1);
        for change in CHANGES {
            for _ in 0..MAX_ROUNDS {
                let before = most;
                for by in [change, -change] {
                    let near = [
                        Fit { x: best.x + by, ..best },
                        Fit { y: best.y + by, ..best },
                        Fit { stroke: (best.stroke + by).max(0.5), ..best },
                        Fit { unit: best.unit + by / size, ..best },
                    ];
                    left = left.saturating_sub(near.len());
                    for fit in near {
                        let value = agreement(fit);
                        if value > most {
                            (best, most) = (fit, value);
                        }
                    }
                }
                if most == before || left == 0 {
                    break;
                }
            }
            if most < NEAR || left == 0 {
                break;
            }
        }
        (most, Laid { fit: best, ..laid })
    }

    /// The pixels of the strokes.
    pub(crate) fn mask(&self, laid: Laid) -> Mask {
        let mut mask = Mask::default();
        self.in_pixels(laid).for_each(|stroke| put_stroke(&mut mask, stroke, laid.fit.stroke));
        mask
    }

    /// The strokes in pixels of the mask, from the upper left corner.
    pub(crate) fn in_pixels(&self, Laid { first, fit, by }: Laid) -> impl Iterator<Item = [[f64; 2]; 2]> {
        let at = move |x: f64, y: f64| by.place(pixel(first, fit, x, y));
        self.0.iter().map(move |&[x1, y1, x2, y2]| [at(x1, y1), at(x2, y2)])
    }
}

/// A place of the turtle in the picture, from the upper left corner. `first` is the cosine and the sine of the first
/// heading.
pub(crate) fn pixel((cos, sin): (f64, f64), fit: Fit, x: f64, y: f64) -> [f64; 2] {
    // The fit is given in the frame of the first heading.
    let (x, y) = (fit.unit * x + fit.x, fit.unit * y + fit.y);
    [x * cos - y * sin, -(x * sin + y * cos)]
}

impl Tracer<'_> {
    /// Follows the word, whose letters are derived `n` steps, and returns the turtle's place at its end.
    fn word(&mut self, word: &[u8], n: usize, mut place: Place) -> Option<Place> {
        let abc = self.system.alphabet;
        let headings: &Headings = &self.target.headings;
        let order = headings.order();
        let mut stack = Vec::new();
        for &symbol in word {
            if symbol < abc.letters {
                self.letter(symbol, n, place)?;
                let block = &self.hulls.level(n)[usize::from(symbol)];
                let (cos, sin, ..) = headings.all[place.turns];
                place.x += block.end.0 * cos - block.end.1 * sin;
                place.y += block.end.0 * sin + block.end.1 * cos;
                place.turns = (place.turns + block.turns) % order;
            } else if symbol == abc.left() {
                place.turns = (place.turns + 1) % order;
            } else if symbol == abc.right() {
                place.turns = (place.turns + order - 1) % order;
            } else if symbol == abc.open() {
                stack.push(place);
            } else {
                place = stack.pop()?;
            }
        }
        Some(place)
    }

    fn letter(&mut self, letter: u8, n: usize, place: Place) -> Option<()> {
        let radius = self.radii[n][usize::from(letter)];
        let (cos, sin, ..) = self.target.headings.all[place.turns];
        // Drawings that cross themselves, such as grids, have the same parts many times.
        let cell = |at: f64| (at * self.fit.unit / SAME + FAR) as i32;
        let part = (letter, n as u8, place.turns as u32, cell(place.x), cell(place.y));
        if radius == 0.0 || !self.traced.insert(part) {
            return Some(());
        }
        if n > 0 && radius * self.fit.unit >= DOT {
            let word = &self.system.words[usize::from(letter)];
            return self.word(word, n - 1, place).map(|_| ());
        }
        match (n, self.system.draws[usize::from(letter)]) {
            (0, true) => self.stroke([place.x, place.y, place.x + cos, place.y + sin]),
            (0, false) => Some(()),
            _ if radius > 0.0 => self.stroke([place.x, place.y, place.x, place.y]),
            _ => Some(()),
        }
    }

    fn stroke(&mut self, stroke: [f64; 4]) -> Option<()> {
        let [x1, y1, x2, y2] = stroke;
        let length = ((x2 - x1) * (x2 - x1) + (y2 - y1) * (y2 - y1)).sqrt() * self.fit.unit;
        let tests = (length / APART) as usize + 1;
        for test in 0..=tests {
            let along = test as f64 / tests as f64;
            let [x, y] = pixel(self.target.first, self.fit, x1 + (x2 - x1) * along, y1 + (y2 - y1) * along);
            let is_inside = x >= 0.0 && y >= 0.0 && x < SIDE as f64 && y < SIDE as f64;
            self.tested += 1.0;
            self.beside += f64::from(u8::from(!is_inside || !self.picture.near.has(x as usize, y as usize)));
        }
        if self.beside > SOME + BESIDE * self.tested || self.strokes.len() >= MAX_STROKES {
            return None;
        }
        self.strokes.push(stroke);
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_segments_in_the_same_places_there_is_one_stroke() {
        let strokes = |unit: f64, count: u32, step: f64| {
            let segments =
                (0..count).map(|at| f64::from(at % 1000) * step).map(|x| [[1e9 + x, x], [1e9 + x + step, x]]);
            Strokes::of_segments(segments, (1.0, 0.0), unit).count()
        };
        assert_eq!(strokes(1.0, 100_000, 1.0), 1000, "each a hundred times");
        assert!(strokes(1.0, 1000, 0.001) < 100, "many on each pixel");
        assert_eq!(strokes(0.001, 1000, 1000.0), 1000);
    }

    #[test]
    fn a_stroke_has_the_pixels_near_it() {
        let mut state = 3_u32;
        let mut random = |most: f64| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1 << 24) * most
        };
        for case in 0..60 {
            let [x1, y1, x2, mut y2] = [(); 4].map(|()| random(600.0) - 40.0);
            if case % 4 == 0 {
                y2 = y1;
            }
            let reach = random(4.0);
            let mut mask = Mask::default();
            put_stroke(&mut mask, [[x1, y1], [x2, y2]], reach);
            let (dx, dy) = (x2 - x1, y2 - y1);
            for (x, y) in (0..SIDE * SIDE).map(|at| (at % SIDE, at / SIDE)) {
                let (px, py) = (x as f64 + 0.5 - x1, y as f64 + 0.5 - y1);
                let along = ((px * dx + py * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
                let far = libm::hypot(px - along * dx, py - along * dy);
                if (far - reach).abs() > 1e-9 {
                    assert_eq!(mask.has(x, y), far < reach, "{x1} {y1} {x2} {y2} {reach}: {x} {y}");
                }
            }
        }
    }
}
