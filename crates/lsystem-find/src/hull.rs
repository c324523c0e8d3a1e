//! Convex hulls of drawings, found without drawing them.
//!
//! A hull is given by how far it reaches in some directions (its support function). The hull of a word is the hull of
//! the moved hulls of its symbols, so the hulls of all letters after `n` steps need work for `n` times the symbols of
//! the rules, however many segments are drawn. Places are in steps, with the first heading along the x axis.

use crate::picture::{LOOSE, Picture};
use crate::successors::{Alphabet, Symbol};
use std::f64::consts::TAU;

/// The fewest and the most directions of a hull.
const FEWEST: usize = 12;
const MAX: usize = 72;
/// How far a hull reaches that is empty.
const NOWHERE: f32 = -1e15;
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
    pub(crate) all: Vec<(f64, f64, usize, f32)>,
    /// The cosines and the sines of the directions of hulls.
    cos: Vec<f32>,
    sin: Vec<f32>,
}

impl Headings {
    /// The headings of turns of `angle` degrees, to a hundredth.
    pub(crate) fn new(angle: f64) -> Self {
        let hundredths = ((angle * 100.0).round() as u32).clamp(1, 36_000);
        let order = (36_000 / gcd(36_000, hundredths)) as usize;
        let count = if order <= MAX { FEWEST.div_ceil(order) * order } else { MAX };
        let heading = |at: usize| {
            let turn = f64::from(hundredths) / 36_000.0 * at as f64;
            let (turn, (sin, cos)) = (turn.fract() * count as f64, libm::sincos(turn * TAU));
            let whole = (turn + 1e-9).floor();
            (cos, sin, whole as usize % count, if turn - whole < 1e-6 { 0.0 } else { (turn - whole) as f32 })
        };
        let direction = |at: usize| libm::sincos(at as f64 / count as f64 * TAU);
        Self {
            all: (0..order).map(heading).collect(),
            cos: (0..count).map(|at| direction(at).1 as f32).collect(),
            sin: (0..count).map(|at| direction(at).0 as f32).collect(),
        }
    }

    /// How many turns make a full one.
    pub(crate) fn order(&self) -> usize {
        self.all.len()
    }
}

const fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The displacement, turn and hull of a letter after some derivation steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// Where the turtle is then, and how many turns it has made.
    pub(crate) end: (f64, f64),
    pub(crate) turns: usize,
    /// How far the ink reaches, twice around. Half of the usual precision is enough for pixels and twice as fast.
    reach: [f32; 2 * MAX],
}

impl Block {
    const EMPTY: Self = Self { end: (0.0, 0.0), turns: 0, reach: [NOWHERE; 2 * MAX] };

    /// The largest distance of the ink from where the letter begins.
    pub(crate) fn radius(&self) -> f64 {
        f64::from(self.reach.iter().copied().fold(0.0, f32::max))
    }

    /// A letter without steps.
    fn set_letter(&mut self, headings: &Headings, draws: bool) {
        (self.end, self.turns) = ((0.0, 0.0), 0);
        self.reach.fill(NOWHERE);
        if draws {
            self.end = (1.0, 0.0);
            let count = headings.cos.len();
            for (at, &cos) in headings.cos.iter().enumerate() {
                (self.reach[at], self.reach[at + count]) = (cos.max(0.0), cos.max(0.0));
            }
        }
    }

    /// Composes the block of a word from the blocks of its letters.
    fn set_word(
        &mut self,
        headings: &Headings,
        alphabet: Alphabet,
        word: &[Symbol],
        blocks: &[Self],
        stack: &mut Vec<Place>,
    ) {
        let count = headings.cos.len();
        let order = headings.order();
        let mut place = Place { x: 0.0, y: 0.0, turns: 0 };
        stack.clear();
        let (once, again) = self.reach.split_at_mut(count);
        once.fill(NOWHERE);
        for &symbol in word {
            if let Some(block) = blocks.get(usize::from(symbol)).filter(|_| symbol < alphabet.letters) {
                let (cos, sin, shift, part) = headings.all[place.turns];
                if block.reach[0] > NOWHERE {
                    let from = &block.reach[count - shift..2 * count - shift];
                    let (x, y) = (place.x as f32, place.y as f32);
                    let into = once.iter_mut().zip(headings.cos.iter().zip(&headings.sin));
                    if part == 0.0 {
                        for ((reach, (u, v)), from) in into.zip(from) {
                            let new = x * u + y * v + from;
                            *reach = if new > *reach { new } else { *reach };
                        }
                    } else {
                        // The reach between two directions.
                        let before = &block.reach[count - shift - 1..2 * count - shift - 1];
                        for (((reach, (u, v)), from), before) in into.zip(from).zip(before) {
                            let new = x * u + y * v + from * (1.0 - part) + before * part;
                            *reach = if new > *reach { new } else { *reach };
                        }
                    }
                }
                place.x += block.end.0 * cos - block.end.1 * sin;
                place.y += block.end.0 * sin + block.end.1 * cos;
                place.turns += block.turns;
                place.turns -= if place.turns >= order { order } else { 0 };
            } else if symbol == alphabet.left() {
                place.turns += 1;
                place.turns -= if place.turns == order { order } else { 0 };
            } else if symbol == alphabet.right() {
                place.turns += if place.turns == 0 { order } else { 0 };
                place.turns -= 1;
            } else if symbol == alphabet.open() {
                stack.push(place);
            } else {
                place = stack.pop().unwrap_or(place);
            }
        }
        again[..count].copy_from_slice(once);
        self.end = (place.x, place.y);
        self.turns = place.turns;
    }
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
    moments: Moments,
    /// The reach without its mean and without its place, and the sum of its squares.
    shape: Vec<f32>,
    square: f64,
    /// Half the usual width of a line.
    stroke: f64,
    /// How far the hulls may be apart, in pixels: on the average, and at most.
    apart: [f64; 2],
}

impl Target {
    /// `angle` and `heading` are in degrees.
    pub(crate) fn new(picture: &Picture, angle: f64, heading: f64) -> Self {
        let headings = Headings::new(angle);
        let first = heading.to_radians();
        let (sin, cos) = libm::sincos(first);
        let count = headings.cos.len();
        let reach: Vec<f64> = (0..count).map(|at| picture.reach(at as f64 / count as f64 * TAU + first)).collect();
        let single: Vec<f32> = reach.iter().map(|&reach| reach as f32).collect();
        let moments = Moments::of(&single, &headings);
        let directions = headings.cos.iter().zip(&headings.sin).map(|(&u, &v)| (f64::from(u), f64::from(v)));
        let rest = |(reach, (u, v)): (&f64, (f64, f64))| reach - moments.mean - moments.x * u - moments.y * v;
        let shape: Vec<f64> = reach.iter().zip(directions).map(rest).collect();
        let square = shape.iter().map(|at| at * at).sum();
        let shape = shape.into_iter().map(|at| at as f32).collect();
        let looser = if picture.is_photograph { f64::from(LOOSE) } else { 0.0 };
        let apart = [USUAL + looser / 2.0, FURTHEST + looser];
        Self { headings, first: (cos, sin), reach, moments, shape, square, stroke: picture.stroke, apart }
    }

    /// All headings, in hundredths of a degree: the way from one to the next, and the first one.
    pub(crate) fn turned(&self) -> [u32; 2] {
        let (cos, sin) = self.first;
        let apart = 36_000 / self.headings.order() as u32;
        let first = (libm::atan2(sin, cos).to_degrees() * 100.0).round() as i64;
        [apart, first.rem_euclid(apart.into()) as u32]
    }

    /// How the hull lies best on that of the picture, by least squares, if it does. Where the picture is nearly round,
    /// its hull alone cannot distinguish a larger drawing from thicker strokes; so the first fit expects the usual
    /// width of the lines, and the second one any.
    fn fits(&self, block: &Block, moments: &Moments) -> [Option<Fit>; 2] {
        let count = self.shape.len() as f64;
        let reach = &block.reach[..self.shape.len()];
        let both = dot(reach, &self.shape);
        let Moments { mean, x, y, own } = *moments;
        let [usual_off, furthest_off] = self.apart;
        // A polygon may be a circle in these directions: then its mean alone tells how large it is.
        let is_round = own == 0.0;
        let least = if is_round { self.square } else { self.square - both * both / own };
        if (both <= 0.0 && !is_round) || least > usual_off * usual_off * count {
            return [None, None];
        }
        let Moments { mean: wanted, x: wanted_x, y: wanted_y, .. } = self.moments;
        let fit = |unit: f64| {
            let fit = Fit { unit, x: wanted_x - unit * x, y: wanted_y - unit * y, stroke: wanted - unit * mean };
            let directions = self.headings.cos.iter().zip(&self.headings.sin);
            let lines = reach.iter().zip(&self.reach).zip(directions).map(|((&own, wanted), (&u, &v))| {
                f64::from(own) * unit + fit.x * f64::from(u) + fit.y * f64::from(v) + fit.stroke - wanted
            });
            let (square, furthest) =
                lines.fold((0.0, 0.0_f64), |(sum, most), off| (sum + off * off, most.max(off.abs())));
            let is_thin = (-0.6..=2.0 * wanted * THICKEST + 1.0).contains(&fit.stroke);
            let is_near = square <= usual_off * usual_off * count && furthest < furthest_off;
            (is_thin && is_near).then_some(Fit { stroke: fit.stroke.max(0.5), ..fit })
        };
        let weight = count / 2.0 * mean;
        let usual = (both + weight * (wanted - self.stroke)) / (own + weight * mean);
        [fit(usual), if is_round { None } else { fit(both / own) }]
    }
}

/// The moments of a hull, which do not depend on the picture.
#[derive(Clone, Copy, Debug)]
struct Moments {
    /// The mean of the support function.
    mean: f64,
    /// The place of its middle (the Steiner point).
    x: f64,
    y: f64,
    /// The sum of its squares without the mean and the place.
    own: f64,
}

impl Moments {
    fn of(reach: &[f32], headings: &Headings) -> Self {
        let count = reach.len() as f64;
        let mean = reach.iter().map(|&at| f64::from(at)).sum::<f64>() / count;
        let x = 2.0 * dot(reach, &headings.cos) / count;
        let y = 2.0 * dot(reach, &headings.sin) / count;
        let square = dot(reach, reach);
        let own = square - count * (mean * mean + (x * x + y * y) / 2.0);
        Self { mean, x, y, own: if own < square * 1e-6 { 0.0 } else { own } }
    }
}

/// The sum of the products, as four independent partial sums.
fn dot(a: &[f32], b: &[f32]) -> f64 {
    let mut sums = [0.0; 4];
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(&a, &b)| f64::from(a) * f64::from(b)).sum();
    for (a, b) in a.zip(b) {
        for at in 0..4 {
            sums[at] += f64::from(a[at]) * f64::from(b[at]);
        }
    }
    sums.iter().sum::<f64>() + rest
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
    blocks: Vec<Block>,
    letters: usize,
    /// The successor of the last letter that the blocks are of, whether it draws, and the number of steps.
    last: (Vec<Symbol>, bool, u32),
    stack: Vec<Place>,
}

impl Hulls {
    /// The blocks of all letters after `n` steps.
    pub(crate) fn level(&self, n: usize) -> &[Block] {
        &self.blocks[n * self.letters..(n + 1) * self.letters]
    }

    /// Finds the blocks of all letters after up to `last` steps.
    pub(crate) fn set(&mut self, headings: &Headings, system: System, last: u32) {
        let letters = system.draws.len();
        // Often the last letter's rule has not changed. If the rule has no other letters, its blocks have not changed
        // either.
        let (word, draws) = (&system.words[letters - 1], system.draws[letters - 1]);
        let is_known = self.letters == letters
            && (&self.last.0, self.last.1, self.last.2) == (word, draws, last)
            && word.iter().all(|&symbol| symbol >= system.alphabet.letters || usize::from(symbol) == letters - 1);
        if !is_known {
            self.last.0.clone_from(word);
            (self.last.1, self.last.2) = (draws, last);
        }
        let changed = if is_known { letters - 1 } else { letters };
        self.letters = letters;
        self.blocks.resize((last as usize + 1) * self.letters, Block::EMPTY);
        for (block, &draws) in self.blocks.iter_mut().zip(system.draws).take(changed) {
            block.set_letter(headings, draws);
        }
        for n in 0..last as usize {
            let (below, above) = self.blocks.split_at_mut((n + 1) * letters);
            let blocks = &below[n * letters..];
            for (block, word) in above.iter_mut().zip(system.words).take(changed) {
                block.set_word(headings, system.alphabet, word, blocks, &mut self.stack);
            }
        }
    }

    /// Gives each number of steps in `steps`, in ascending order, after which the system has the hull of the picture,
    /// and for which of the `targets`, all of the same angle.
    pub(crate) fn search(
        &mut self,
        targets: &[Target],
        system: System,
        steps: &[u32],
        mut found: impl FnMut(&Self, u32, usize, Fit),
    ) {
        let Some(Target { headings, .. }) = targets.first() else { return };
        self.set(headings, system, steps.last().copied().unwrap_or(0));
        let mut axiom = Block::EMPTY;
        for &n in steps {
            let blocks = &self.blocks[n as usize * self.letters..(n as usize + 1) * self.letters];
            let whole = match system.axiom {
                &[letter] if letter < system.alphabet.letters => &blocks[usize::from(letter)],
                word => {
                    axiom.set_word(headings, system.alphabet, word, blocks, &mut self.stack);
                    &axiom
                }
            };
            let reach = &whole.reach[..headings.cos.len()];
            let moments = Moments::of(reach, headings);
            if reach[0] <= NOWHERE / 2.0 || moments.mean <= 0.0 {
                continue;
            }
            let fits =
                targets.iter().zip(0..).flat_map(|(target, at)| target.fits(whole, &moments).map(|fit| (at, fit)));
            let fits: Vec<(usize, Fit)> = fits.filter_map(|(at, fit)| Some((at, fit?))).collect();
            for (at, fit) in fits {
                found(self, n, at, fit);
            }
        }
    }
}
