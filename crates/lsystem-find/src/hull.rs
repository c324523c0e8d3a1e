//! Convex hulls of drawings, found without drawing them.
//!
//! A hull is given by how far it reaches in some directions (its support function). The hull of a word is the hull of the
//! moved hulls of its symbols, so the hulls of all letters after `n` steps need work for `n` times the symbols of the
//! rules, however many segments are drawn. Places are in steps, with the first heading along the x axis.

use crate::picture::Picture;
use crate::words::{Alphabet, Symbol};
use std::f64::consts::TAU;

/// The fewest and the most directions of a hull.
const FEWEST: usize = 24;
const MOST: usize = 72;
/// How far a hull reaches that is empty.
const NOWHERE: f64 = -1e15;
/// How far a line of a picture may be from where it is drawn, in pixels: on the average, and at most.
const USUAL: f64 = 0.9;
const FURTHEST: f64 = 2.5;
/// The thickest stroke, as a part of the longer side of the picture.
const THICKEST: f64 = 0.05;

/// The headings that an angle leads to.
#[derive(Clone, Debug)]
pub(crate) struct Headings {
    /// For each heading the cosine, the sine, and the direction of the hull before it with the part of the way to the
    /// next one.
    pub(crate) all: Vec<(f64, f64, usize, f64)>,
    directions: Vec<(f64, f64)>,
}

impl Headings {
    /// The headings of turns of `angle` degrees, to a hundredth.
    pub(crate) fn new(angle: f64) -> Self {
        let hundredths = ((angle * 100.0).round() as u32).clamp(1, 36_000);
        let order = (36_000 / gcd(36_000, hundredths)) as usize;
        let count = if order <= MOST { FEWEST.div_ceil(order) * order } else { MOST };
        let heading = |at: usize| {
            let turn = f64::from(hundredths) / 36_000.0 * at as f64;
            let (turn, (sin, cos)) = (turn.fract() * count as f64, libm::sincos(turn * TAU));
            let whole = (turn + 1e-9).floor();
            (cos, sin, whole as usize % count, if turn - whole < 1e-6 { 0.0 } else { turn - whole })
        };
        let direction = |at: usize| {
            let (sin, cos) = libm::sincos(at as f64 / count as f64 * TAU);
            (cos, sin)
        };
        Self { all: (0..order).map(heading).collect(), directions: (0..count).map(direction).collect() }
    }

    /// How many turns make a full one.
    pub(crate) fn order(&self) -> usize {
        self.all.len()
    }
}

const fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// What a letter does after some steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Where the turtle is then, and how many turns it has made.
    pub(crate) end: (f64, f64),
    pub(crate) turns: usize,
    /// How far the ink reaches, twice around.
    reach: [f64; 2 * MOST],
}

impl Block {
    const EMPTY: Self = Self { end: (0.0, 0.0), turns: 0, reach: [NOWHERE; 2 * MOST] };

    /// The largest distance of the ink from where the letter begins.
    pub(crate) fn radius(&self) -> f64 {
        self.reach.iter().copied().fold(0.0, f64::max)
    }
}

/// A letter without steps.
fn letter(headings: &Headings, draws: bool) -> Block {
    let mut block = Block::EMPTY;
    if draws {
        block.end = (1.0, 0.0);
        let count = headings.directions.len();
        for (at, &(cos, _)) in headings.directions.iter().enumerate() {
            (block.reach[at], block.reach[at + count]) = (cos.max(0.0), cos.max(0.0));
        }
    }
    block
}

/// What a word does if its letters are these blocks.
fn follow(headings: &Headings, alphabet: Alphabet, word: &[Symbol], blocks: &[Block], stack: &mut Vec<Place>) -> Block {
    let count = headings.directions.len();
    let order = headings.order();
    let mut whole = Block::EMPTY;
    let mut place = Place { x: 0.0, y: 0.0, turns: 0 };
    stack.clear();
    for &symbol in word {
        if let Some(block) = blocks.get(usize::from(symbol)).filter(|_| symbol < alphabet.letters) {
            let (cos, sin, shift, part) = headings.all[place.turns];
            if block.reach[0] > NOWHERE {
                let from = &block.reach[count - shift..2 * count - shift];
                let into = whole.reach[..count].iter_mut().zip(&headings.directions);
                if part == 0.0 {
                    for ((reach, &(u, v)), from) in into.zip(from) {
                        *reach = reach.max(place.x * u + place.y * v + from);
                    }
                } else {
                    let before = |at: usize| block.reach[(2 * count + at - shift - 1) % count];
                    for (at, ((reach, &(u, v)), from)) in into.zip(from).enumerate() {
                        let from = from * (1.0 - part) + before(at) * part;
                        *reach = reach.max(place.x * u + place.y * v + from);
                    }
                }
            }
            place.x += block.end.0 * cos - block.end.1 * sin;
            place.y += block.end.0 * sin + block.end.1 * cos;
            place.turns = (place.turns + block.turns) % order;
        } else if symbol == alphabet.left() {
            place.turns = (place.turns + 1) % order;
        } else if symbol == alphabet.right() {
            place.turns = (place.turns + order - 1) % order;
        } else if symbol == alphabet.open() {
            stack.push(place);
        } else {
            place = stack.pop().unwrap_or(place);
        }
    }
    let (once, again) = whole.reach.split_at_mut(count);
    again[..count].copy_from_slice(once);
    whole.end = (place.x, place.y);
    whole.turns = place.turns;
    whole
}

/// Where a turtle is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) turns: usize,
}

/// Where a drawing lies on a picture, in pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    /// One step.
    pub(crate) unit: f64,
    /// Where the drawing begins, with the y axis upwards.
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// Half the width of the stroke.
    pub(crate) stroke: f64,
}

/// The hull of a picture, as seen by a turtle with a first heading.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    pub(crate) headings: Headings,
    /// The first heading: its cosine and sine.
    pub(crate) first: (f64, f64),
    reach: Vec<f64>,
    moments: (f64, f64, f64),
    /// The reach without its mean and without its place, and the sum of its squares.
    shape: Vec<f64>,
    square: f64,
    /// Half the usual width of a line.
    stroke: f64,
}

impl Target {
    /// `angle` and `heading` are in degrees.
    pub(crate) fn new(picture: &Picture, angle: f64, heading: f64) -> Self {
        let headings = Headings::new(angle);
        let first = heading.to_radians();
        let (sin, cos) = libm::sincos(first);
        let count = headings.directions.len();
        let reach: Vec<f64> = (0..count).map(|at| picture.reach(at as f64 / count as f64 * TAU + first)).collect();
        let moments = moments(&reach, &headings.directions);
        let (mean, x, y) = moments;
        let rest = |(reach, &(u, v)): (&f64, &(f64, f64))| reach - mean - x * u - y * v;
        let shape: Vec<f64> = reach.iter().zip(&headings.directions).map(rest).collect();
        let square = shape.iter().map(|at| at * at).sum();
        Self { headings, first: (cos, sin), reach, moments, shape, square, stroke: picture.stroke }
    }

    /// How the hull lies best on that of the picture, by least squares, if it does. Where the picture is nearly round, its
    /// hull alone does not tell a larger drawing from thicker strokes; so the first fit expects the usual width of the
    /// lines, and the second one any.
    fn fits(&self, block: &Block) -> [Option<Fit>; 2] {
        let count = self.shape.len() as f64;
        let reach = &block.reach[..self.shape.len()];
        if reach[0] <= NOWHERE / 2.0 {
            return [None, None];
        }
        let (mean, x, y) = moments(reach, &self.headings.directions);
        let square: f64 = reach.iter().map(|at| at * at).sum();
        let own = square - count * (mean * mean + (x * x + y * y) / 2.0);
        let both: f64 = reach.iter().zip(&self.shape).map(|(a, b)| a * b).sum();
        let least = self.square - both * both / own;
        if own < square * 1e-9 || both <= 0.0 || least > USUAL * USUAL * count {
            return [None, None];
        }
        let (wanted, wanted_x, wanted_y) = self.moments;
        let fit = |unit: f64| {
            let fit = Fit { unit, x: wanted_x - unit * x, y: wanted_y - unit * y, stroke: wanted - unit * mean };
            let lines = reach.iter().zip(&self.reach).zip(&self.headings.directions);
            let lines = lines.map(|((own, wanted), (u, v))| own * unit + fit.x * u + fit.y * v + fit.stroke - wanted);
            let (square, furthest) =
                lines.fold((0.0, 0.0_f64), |(sum, most), off| (sum + off * off, most.max(off.abs())));
            let is_thin = (-0.6..=2.0 * wanted * THICKEST + 1.0).contains(&fit.stroke);
            let is_near = square <= USUAL * USUAL * count && furthest < FURTHEST;
            (is_thin && is_near).then_some(Fit { stroke: fit.stroke.max(0.5), ..fit })
        };
        let weight = count / 2.0 * mean;
        let usual = (both + weight * (wanted - self.stroke)) / (own + weight * mean);
        [fit(usual), fit(both / own)]
    }
}

/// The mean of a support function, and the place of its middle (the Steiner point).
fn moments(reach: &[f64], directions: &[(f64, f64)]) -> (f64, f64, f64) {
    let count = reach.len() as f64;
    let (mut mean, mut x, mut y) = (0.0, 0.0, 0.0);
    for (at, (u, v)) in reach.iter().zip(directions) {
        (mean, x, y) = (mean + at, x + at * u, y + at * v);
    }
    (mean / count, 2.0 * x / count, 2.0 * y / count)
}

/// A system to be tried: an axiom, and for each letter its successor and whether it draws.
#[derive(Clone, Copy, Debug)]
pub(crate) struct System<'a> {
    pub(crate) alphabet: Alphabet,
    pub(crate) axiom: &'a [Symbol],
    pub(crate) words: &'a [Vec<Symbol>],
    pub(crate) draws: &'a [bool],
}

/// The hulls of a system, level by level; kept so that each system uses the memory of the one before.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hulls {
    /// The blocks of all letters after no step, after one step, and so on.
    pub(crate) levels: Vec<Vec<Block>>,
    stack: Vec<Place>,
}

impl Hulls {
    /// Gives each number of steps in `steps`, in ascending order, after which the system has the hull of the picture, and
    /// for which of the `targets`, all of the same angle.
    pub(crate) fn search(
        &mut self,
        targets: &[Target],
        system: System,
        steps: &[u32],
        mut found: impl FnMut(&Self, u32, usize, Fit),
    ) {
        let Some(Target { headings, .. }) = targets.first() else { return };
        self.levels.clear();
        self.levels.push(system.draws.iter().map(|&draws| letter(headings, draws)).collect());
        for n in 0..=steps.last().copied().unwrap_or(0) {
            if steps.contains(&n) {
                let blocks = &self.levels[n as usize];
                let axiom = follow(headings, system.alphabet, system.axiom, blocks, &mut self.stack);
                for (at, target) in targets.iter().enumerate() {
                    target.fits(&axiom).into_iter().flatten().for_each(|fit| found(self, n, at, fit));
                }
            }
            if steps.last().is_some_and(|&last| n < last) {
                let blocks = &self.levels[n as usize];
                let stack = &mut self.stack;
                let next = system.words.iter();
                let next = next.map(|word| follow(headings, system.alphabet, word, blocks, stack)).collect();
                self.levels.push(next);
            }
        }
    }
}
