//! Successors of plants, found by laying small copies of a picture on the picture.
//!
//! After many steps a plant consists of copies of itself: of the whole picture at a fixed part of its size, each turned by
//! some turns. The copies that lie on the ink are found first. Then the ink is covered with a few of them, whose bases lie
//! where the turtle comes by; each cover is a successor. Whether the successor draws the picture is for others to say.

use crate::picture::Picture;
use crate::source::Told;
use crate::words::{Alphabet, Symbol};
use lsystem_compare::SIDE;
use std::collections::HashSet;
use std::sync::Arc;

/// The number of places that are sampled to lay a copy on the ink, and to see whether the ink is covered.
const TESTS: usize = 240;
const PLACES: usize = 1024;
/// The least part of a copy that lies on ink. Its smallest twigs lie beside it: the copy has one generation more. Where
/// ink is dense, a larger part lies on ink by chance.
const ON_INK: f64 = 0.7;
/// The same part where the base is up to two pixels off.
const ROUGHLY: f64 = 0.5;
/// The misses beyond the allowed ones after which a copy is given up.
const SOME: f64 = 6.0;
/// The least distance of two different copies, in pixels.
const APART: f64 = 4.0;
/// The largest distance of a base from the turtle's path, in pixels.
const NEAR: f64 = 3.0;
/// The most copies with the same turns, the most lengths of a step, and the shortest one in pixels.
const MAX_COPIES: usize = 24;
const MAX_LENGTHS: usize = 12;
const SHORTEST: f64 = 8.0;
/// A length is promising if it leads to at least this share of the copies to which the best length leads.
const PROMISING: f64 = 0.6;
/// The most steps in the way from the base to a copy.
const MAX_STEPS: usize = 4;
/// The most turns each way that are tried at angles that lead to many headings.
const MAX_TURNS: i32 = 6;
const MANY: usize = 24;
/// The most places where the turtle comes by, one for each bit of a set.
const MAX_NODES: usize = 120;
/// The most steps from the base to a copy.
const MAX_DEPTH: usize = 6;
/// A stalk lies on ink with at least this part of its length.
const STALK: f64 = 0.95;
/// The part of the ink that a cover may leave, the part that is too small to look for more, and the part that no copy may
/// cover.
const UNCOVERED: usize = PLACES / 12;
const RESIDUE: usize = PLACES / 60;
const UNCOVERABLE: usize = PLACES / 12;
/// The most elements of a cover, and the most covers that are looked at for one length.
const MAX_ELEMENTS: usize = 9;
const MAX_LOOKS: usize = 20_000;
/// The most turns from one step to the next.
const MAX_BEND: i32 = 4;

/// What the letter of the successor that steps forward draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// A copy of the picture, which the turtle leaves at its end: `F -> F[+F]F[-F]F`.
    Copy,
    /// A stalk: `X -> F[+X][-X]FX`, `F -> FF`.
    Stalk,
}

type Cover = [u64; PLACES / 64];

/// A copy of the picture.
#[derive(Clone, Copy, Debug)]
struct Copy {
    /// Where its base lies, in pixels, with the y axis upwards.
    at: [f64; 2],
    score: f64,
}

/// Where the turtle comes by.
#[derive(Clone, Debug)]
struct Node {
    at: [f64; 2],
    depth: usize,
    /// The node before and the heading from there, as turns from the first heading.
    from: Option<(usize, i32)>,
    /// The ink of the steps from the base to here.
    cover: Cover,
}

/// What covers ink: a step to a node, or a copy at the end of a branch.
#[derive(Clone, Copy, Debug)]
struct Element {
    node: usize,
    copy: Option<i32>,
    cover: Cover,
}

/// A search for covers in steps.
#[derive(Clone, Debug)]
pub(crate) struct Collage {
    picture: Arc<Picture>,
    step: Step,
    /// The size of the copies.
    ratio: f64,
    alphabet: Alphabet,
    /// The first heading and the angle, in radians.
    heading: f64,
    angle: f64,
    base: [f64; 2],
    /// The least part of a copy that lies on ink.
    on_ink: f64,
    /// Places of the ink, with the y axis upwards.
    places: Vec<[f64; 2]>,
    /// The turns that are still to be tried for copies.
    turns: Vec<i32>,
    all_turns: Vec<i32>,
    copies: Vec<Copy>,
    /// The lengths of a step that are still to be tried, in pixels.
    lengths: Option<Vec<f64>>,
    words: Vec<Vec<Symbol>>,
    told: HashSet<Vec<Symbol>>,
}

impl Collage {
    /// `heading` and `angle` are in degrees.
    pub(crate) fn new(
        picture: &Arc<Picture>,
        step: Step,
        ratio: f64,
        alphabet: Alphabet,
        heading: f64,
        angle: f64,
    ) -> Option<Self> {
        let (heading, angle) = (heading.to_radians(), angle.to_radians());
        let ink: Vec<[f64; 2]> = (0..SIDE * SIDE)
            .filter(|at| picture.mask.has(at % SIDE, at / SIDE))
            .map(|at| [(at % SIDE) as f64 + 0.5, -((at / SIDE) as f64 + 0.5)])
            .collect();
        // The same pseudo-random places each time (a linear congruential generator).
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize
        };
        let places = (0..PLACES).map(|_| ink[random() % ink.len().max(1)]).collect();
        let half = alphabet.order as i32 / 2;
        let turns: Vec<i32> = match alphabet.order <= MANY {
            true => (half + 1 - alphabet.order as i32..=half).collect(),
            false => (-MAX_TURNS..=MAX_TURNS).collect(),
        };
        let base = base(&ink, heading, picture.stroke)?;
        let density = (picture.close.count() as f64 / picture.hull_area().max(1.0)).min(1.0);
        Some(Self {
            picture: picture.clone(),
            step,
            ratio,
            alphabet,
            heading,
            angle,
            base,
            on_ink: ON_INK + (1.0 - ON_INK) * density * density,
            places,
            turns: turns.clone(),
            all_turns: turns,
            copies: Vec::new(),
            lengths: None,
            words: Vec::new(),
            told: HashSet::new(),
        })
    }

    /// Works for some milliseconds at most.
    pub(crate) fn advance(&mut self) -> Told {
        if let Some(word) = self.words.pop() {
            return Told::Word(word);
        }
        if let Some(turns) = self.turns.pop() {
            let copies = self.find_copies(turns);
            self.copies.extend(copies);
            return Told::More;
        }
        let mut lengths = self.lengths.take().unwrap_or_else(|| self.find_lengths());
        let length = lengths.pop();
        self.lengths = Some(lengths);
        let Some(length) = length else { return Told::Done };
        self.cover(length);
        Told::More
    }

    fn direction(&self, turns: i32) -> [f64; 2] {
        let (sin, cos) = libm::sincos(self.heading + self.angle * f64::from(turns));
        [cos, sin]
    }

    /// Where a copy with these turns is tested, from its base.
    fn offsets(&self, turns: i32) -> Vec<[f64; 2]> {
        let (sin, cos) = libm::sincos(self.angle * f64::from(turns));
        let offset = |[x, y]: &[f64; 2]| {
            let (x, y) = ((x - self.base[0]) * self.ratio, (y - self.base[1]) * self.ratio);
            [x * cos - y * sin, x * sin + y * cos]
        };
        self.places[..TESTS].iter().map(offset).collect()
    }

    /// The part of a copy that lies on ink, if that is enough.
    fn score(&self, offsets: &[[f64; 2]], [x, y]: [f64; 2], least: f64) -> Option<f64> {
        let mut misses = 0.0;
        let is_on_ink = offsets.iter().enumerate().all(|(tested, [dx, dy])| {
            misses += f64::from(u8::from(!is_inked(&self.picture, x + dx, y + dy)));
            misses <= SOME + (1.0 - least) * tested as f64
        });
        is_on_ink.then_some(1.0 - misses / TESTS as f64)
    }

    /// The copies with these turns that lie on ink straight ahead of the base, the best ones first.
    fn find_copies(&self, turns: i32) -> Vec<Copy> {
        let offsets = self.offsets(turns);
        let mut found: Vec<Copy> = Vec::new();
        for &ray in &self.all_turns {
            let [x, y] = self.direction(ray);
            let along = |length: usize, aside: f64| {
                [self.base[0] + length as f64 * x - aside * y, self.base[1] + length as f64 * y + aside * x]
            };
            let is_on_ink = |length: &usize| {
                let [x, y] = along(*length, 0.0);
                is_inked(&self.picture, x, y)
            };
            for length in (1..SIDE).take_while(is_on_ink).filter(|&length| length as f64 >= SHORTEST) {
                for aside in [-1.0, 0.0, 1.0] {
                    let at = along(length, aside);
                    found.extend(self.score(&offsets, at, self.on_ink).map(|score| Copy { at, score }));
                }
            }
        }
        found.sort_by(|a, b| b.score.total_cmp(&a.score));
        let mut best: Vec<Copy> = Vec::new();
        for copy in &found {
            if best.len() == MAX_COPIES {
                break;
            }
            if best.iter().all(|other| distance(other.at, copy.at) >= APART) {
                // The middle of the places that are as good.
                let near = || {
                    (found.iter())
                        .filter(|other| distance(other.at, copy.at) < APART && other.score > copy.score - 0.01)
                };
                let count = near().count() as f64;
                let middle = |axis: usize| near().map(|other| other.at[axis]).sum::<f64>() / count;
                best.push(Copy { at: [middle(0), middle(1)], ..*copy });
            }
        }
        best
    }

    /// The lengths of a step that lead to copies, the most promising ones last.
    fn find_lengths(&self) -> Vec<f64> {
        let mut lengths: Vec<(f64, f64)> = Vec::new();
        for copy in &self.copies {
            let way = [copy.at[0] - self.base[0], copy.at[1] - self.base[1]];
            let length = libm::hypot(way[0], way[1]);
            for steps in 1..=MAX_STEPS {
                let length = length / steps as f64;
                if length < SHORTEST {
                    continue;
                }
                match lengths.iter_mut().find(|(other, _)| (other - length).abs() < NEAR / 2.0) {
                    Some((_, weight)) => *weight += copy.score * copy.score,
                    None => lengths.push((length, copy.score * copy.score)),
                }
            }
        }
        lengths.sort_by(|a, b| b.1.total_cmp(&a.1));
        lengths.truncate(MAX_LENGTHS);
        // Among promising lengths, the longest one makes the shortest word.
        let enough = lengths.first().map_or(0.0, |best| best.1 * PROMISING);
        lengths.sort_by(|a, b| (b.1 > enough).cmp(&(a.1 > enough)).then(b.0.total_cmp(&a.0)));
        if self.step == Step::Copy {
            lengths.extend(self.lengths_ahead());
        }
        lengths.into_iter().rev().map(|(length, _)| length).collect()
    }

    /// The lengths of a step after which another copy without turns follows.
    fn lengths_ahead(&self) -> Vec<(f64, f64)> {
        let offsets = self.offsets(0);
        let [x, y] = self.direction(0);
        let score = |length: usize| {
            let length = length as f64;
            self.score(&offsets, [self.base[0] + length * x, self.base[1] + length * y], ON_INK).unwrap_or(0.0)
        };
        let scores: Vec<f64> = (0..SIDE).map(score).collect();
        let is_peak = |&at: &usize| scores[at] > scores[at - 1] && scores[at] >= scores[at + 1];
        let peaks = (SHORTEST as usize..SIDE - 1).filter(is_peak).map(|at| (at as f64, scores[at]));
        let mut peaks: Vec<(f64, f64)> = peaks.collect();
        peaks.sort_by(|a, b| b.1.total_cmp(&a.1));
        peaks.truncate(MAX_LENGTHS);
        peaks
    }

    /// The best copy with its base near a node.
    fn copy_at(&self, offsets: &[[f64; 2]], node: [f64; 2]) -> Option<Copy> {
        let mut best = Some(Copy { at: node, score: self.score(offsets, node, ROUGHLY)? });
        best = best.filter(|best| best.score >= ON_INK);
        for dx in -2..=2 {
            for dy in -2..=2 {
                let at = [node[0] + f64::from(dx), node[1] + f64::from(dy)];
                if let Some(score) =
                    self.score(offsets, at, ON_INK).filter(|score| best.is_none_or(|best| *score > best.score))
                {
                    best = Some(Copy { at, score });
                }
            }
        }
        best
    }

    /// The places that a copy with its base there covers.
    fn cover_of(&self, turns: i32, at: [f64; 2]) -> Cover {
        let (sin, cos) = libm::sincos(-self.angle * f64::from(turns));
        covered(&self.places, |[x, y]| {
            let (x, y) = ((x - at[0]) / self.ratio, (y - at[1]) / self.ratio);
            let (x, y) = (x * cos - y * sin + self.base[0], x * sin + y * cos + self.base[1]);
            let (column, row) = (x.floor(), (-y).floor());
            let is_inside = column >= 0.0 && row >= 0.0 && column < SIDE as f64 && row < SIDE as f64;
            is_inside && self.picture.near.has(column as usize, row as usize)
        })
    }

    /// The nodes that steps of this length lead to, and what covers ink there.
    fn nodes(&self, length: f64) -> (Vec<Node>, Vec<Element>) {
        let mut nodes = vec![Node { at: self.base, depth: 0, from: None, cover: [0; PLACES / 64] }];
        let mut elements = Vec::new();
        let offsets: Vec<Vec<[f64; 2]>> = self.all_turns.iter().map(|&turns| self.offsets(turns)).collect();
        let mut next = 0;
        while next < nodes.len() {
            let node = nodes[next].clone();
            let (before, order) = (node.from.map_or(0, |(_, turns)| turns), self.alphabet.order as i32);
            for (&turns, offsets) in self.all_turns.iter().zip(&offsets) {
                let bend = (turns - before).rem_euclid(order);
                if bend.min(order - bend) > MAX_BEND {
                    continue;
                }
                let copy = self.copy_at(offsets, node.at);
                let cover = copy.map(|copy| self.cover_of(turns, copy.at));
                if let (Some(cover), Step::Stalk) = (cover, self.step) {
                    elements.push(Element { node: next, copy: Some(turns), cover: union(&cover, &node.cover) });
                }
                let [x, y] = self.direction(turns);
                let at = [node.at[0] + length * x, node.at[1] + length * y];
                let step = match self.step {
                    Step::Copy => cover,
                    Step::Stalk => self.stalk(node.at, at),
                };
                let known = nodes.iter().filter(|other| distance(other.at, at) < NEAR).count();
                // Two copies may end at the same place.
                let most = if self.step == Step::Copy { 2 } else { 1 };
                let Some(step) = step else { continue };
                if nodes.len() < MAX_NODES && node.depth < MAX_DEPTH && known < most {
                    let cover = union(&step, &node.cover);
                    elements.push(Element { node: nodes.len(), copy: None, cover });
                    nodes.push(Node { at, depth: node.depth + 1, from: Some((next, turns)), cover });
                }
            }
            next += 1;
        }
        (nodes, elements)
    }

    /// What a stalk covers, if it lies on ink.
    fn stalk(&self, from: [f64; 2], to: [f64; 2]) -> Option<Cover> {
        let length = distance(from, to);
        let along = |part: f64| [from[0] + (to[0] - from[0]) * part, from[1] + (to[1] - from[1]) * part];
        let steps = length.ceil() as usize;
        let inked = (0..=steps).map(|at| along(at as f64 / steps as f64));
        let inked = inked.filter(|&[x, y]| is_inked(&self.picture, x, y)).count();
        let reach = self.picture.stroke + 1.5;
        (inked as f64 >= STALK * (steps + 1) as f64).then(|| {
            covered(&self.places, |[x, y]| {
                let part = ((x - from[0]) * (to[0] - from[0]) + (y - from[1]) * (to[1] - from[1])) / (length * length);
                distance([x, y], along(part.clamp(0.0, 1.0))) <= reach
            })
        })
    }

    /// Covers the ink, with steps of this length.
    fn cover(&mut self, length: f64) {
        let (nodes, mut elements) = self.nodes(length);
        elements.truncate(128);
        let mut by_place = vec![0_u128; PLACES];
        for (number, element) in elements.iter().enumerate() {
            for (place, covering) in by_place.iter_mut().enumerate() {
                *covering |= u128::from(element.cover[place / 64] >> (place % 64) & 1) << number;
            }
        }
        let none = covered_by(&by_place);
        let missing = PLACES - count(&none);
        if missing > UNCOVERABLE {
            return;
        }
        // Where the turtle leaves a copy of the whole.
        let [x, y] = self.direction(0);
        let far = length / self.ratio;
        let end = [self.base[0] + far * x, self.base[1] + far * y];
        let ends = match self.step {
            Step::Stalk => vec![None],
            Step::Copy => {
                (0..nodes.len()).filter(|&at| distance(nodes[at].at, end) < 2.0 * NEAR && at > 0).map(Some).collect()
            }
        };
        for end in ends {
            let mut looking = Looking { elements: &elements, by_place: &by_place, looks: 0, covers: Vec::new() };
            let start = end.map_or([0; PLACES / 64], |end: usize| nodes[end].cover);
            looking.look(&none, &start, &mut Vec::new());
            for cover in std::mem::take(&mut looking.covers) {
                let chosen: Vec<Element> = cover.into_iter().map(|at| elements[at]).collect();
                let word = self.word(&nodes, &chosen, end);
                if self.told.insert(word.clone()) {
                    self.words.push(word);
                }
            }
        }
    }

    /// The successor of a cover. The turtle leaves it at the node `end`, if there is one.
    fn word(&self, nodes: &[Node], chosen: &[Element], end: Option<usize>) -> Vec<Symbol> {
        // The nodes that the turtle comes by, and those on the way to the end.
        let mut used = vec![false; nodes.len()];
        let mut main = vec![false; nodes.len()];
        let mark = |marks: &mut Vec<bool>, mut node: usize| loop {
            marks[node] = true;
            match nodes[node].from {
                Some((from, _)) => node = from,
                None => return,
            }
        };
        chosen.iter().for_each(|element| mark(&mut used, element.node));
        if let Some(end) = end {
            mark(&mut used, end);
            mark(&mut main, end);
        }
        let mut word = Vec::new();
        self.write(nodes, chosen, (&used, &main), (0, 0), &mut word);
        word
    }

    /// Writes what is drawn from a node on, with the heading at its beginning.
    fn write(
        &self,
        nodes: &[Node],
        chosen: &[Element],
        (used, main): (&[bool], &[bool]),
        (node, heading): (usize, i32),
        word: &mut Vec<Symbol>,
    ) {
        let copies = chosen.iter().filter(|element| element.node == node).filter_map(|element| element.copy);
        let mut parts: Vec<(i32, Option<usize>)> = copies.map(|turns| (turns, None)).collect();
        for (child, other) in nodes.iter().enumerate().filter(|&(child, _)| used[child]) {
            if let Some((_, turns)) = other.from.filter(|&(from, _)| from == node) {
                parts.push((turns, Some(child)));
            }
        }
        parts.sort_unstable();
        parts.dedup();
        // The turtle stays on the way to the end; elsewhere it does not come back from the last part.
        let is_on_way = main.contains(&true);
        let last = match is_on_way && main[node] {
            true => parts.iter().position(|(_, child)| child.is_some_and(|child| main[child])),
            false => parts.iter().rposition(|(_, child)| child.is_some()).or(parts.len().checked_sub(1)),
        };
        let (step, copy) = match self.step {
            Step::Copy => (0, 0),
            Step::Stalk => (1, 0),
        };
        let last_part = last.map(|last| parts.remove(last));
        for (turns, child) in parts {
            word.push(self.alphabet.open());
            self.turn(turns - heading, word);
            word.push(if child.is_some() { step } else { copy });
            if let Some(child) = child {
                self.write(nodes, chosen, (used, main), (child, turns), word);
            }
            word.push(self.alphabet.close());
        }
        match last_part {
            Some((turns, child)) => {
                self.turn(turns - heading, word);
                word.push(if child.is_some() { step } else { copy });
                if let Some(child) = child {
                    self.write(nodes, chosen, (used, main), (child, turns), word);
                }
            }
            // The end has the first heading.
            None if is_on_way && main[node] => self.turn(-heading, word),
            None => {}
        }
    }

    fn turn(&self, turns: i32, word: &mut Vec<Symbol>) {
        let order = self.alphabet.order as i32;
        let turns = (turns + order / 2).rem_euclid(order) - order / 2;
        let symbol = if turns > 0 { self.alphabet.left() } else { self.alphabet.right() };
        word.extend(std::iter::repeat_n(symbol, turns.unsigned_abs() as usize));
    }
}

/// The covers that are found by looking for what covers the place with the fewest choices.
struct Looking<'a> {
    elements: &'a [Element],
    by_place: &'a [u128],
    looks: usize,
    covers: Vec<Vec<usize>>,
}

impl Looking<'_> {
    fn look(&mut self, coverable: &Cover, covered: &Cover, chosen: &mut Vec<usize>) {
        self.looks += 1;
        let open = |place: usize| (coverable[place / 64] & !covered[place / 64]) >> (place % 64) & 1 == 1;
        let places = || (0..PLACES).filter(|&place| open(place));
        let count = places().count();
        if count <= UNCOVERED {
            self.covers.push(chosen.clone());
        }
        if count <= RESIDUE || chosen.len() == MAX_ELEMENTS {
            return;
        }
        let Some(place) = places().min_by_key(|&place| self.by_place[place].count_ones()) else { return };
        let gain = |number: &usize| {
            let new = self.elements[*number].cover.iter().zip(coverable.iter().zip(covered));
            new.map(|(own, (all, covered))| (own & all & !covered).count_ones()).sum::<u32>()
        };
        let covering = self.by_place[place];
        let mut choices: Vec<usize> = (0..self.elements.len()).filter(|number| covering >> number & 1 == 1).collect();
        choices.sort_by_key(|number| std::cmp::Reverse(gain(number)));
        for number in choices {
            if self.looks > MAX_LOOKS {
                return;
            }
            chosen.push(number);
            self.look(coverable, &union(covered, &self.elements[number].cover), chosen);
            chosen.pop();
        }
    }
}

/// Where a turtle begins: at the ink that reaches furthest against its heading, if that is one stroke.
fn base(ink: &[[f64; 2]], heading: f64, stroke: f64) -> Option<[f64; 2]> {
    let (sin, cos) = libm::sincos(heading);
    let along = |[x, y]: &[f64; 2]| x * cos + y * sin;
    let across = |[x, y]: &[f64; 2]| y * cos - x * sin;
    let least = ink.iter().map(along).fold(f64::INFINITY, f64::min);
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    for place in ink.iter().filter(|place| along(place) < least + 1.0) {
        (left, right) = (left.min(across(place)), right.max(across(place)));
    }
    let is_one_stroke = right - left <= 2.0 * stroke + 3.0;
    let (ahead, aside) = (least + stroke - 0.5, f64::midpoint(left, right));
    is_one_stroke.then_some([ahead * cos - aside * sin, ahead * sin + aside * cos])
}

fn is_inked(picture: &Picture, x: f64, y: f64) -> bool {
    let (column, row) = (x.floor(), (-y).floor());
    let is_inside = column >= 0.0 && row >= 0.0 && column < SIDE as f64 && row < SIDE as f64;
    is_inside && picture.close.has(column as usize, row as usize)
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

fn union(a: &Cover, b: &Cover) -> Cover {
    std::array::from_fn(|at| a[at] | b[at])
}

fn count(cover: &Cover) -> usize {
    cover.iter().map(|word| word.count_ones() as usize).sum()
}

fn covered(places: &[[f64; 2]], is_covered: impl Fn([f64; 2]) -> bool) -> Cover {
    let mut cover = [0; PLACES / 64];
    for (at, &place) in places.iter().enumerate() {
        cover[at / 64] |= u64::from(is_covered(place)) << (at % 64);
    }
    cover
}

/// The places that something covers.
fn covered_by(by_place: &[u128]) -> Cover {
    let mut cover = [0; PLACES / 64];
    for (at, &covering) in by_place.iter().enumerate() {
        cover[at / 64] |= u64::from(covering != 0) << (at % 64);
    }
    cover
}
