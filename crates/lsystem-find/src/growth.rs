//! Successors of plants, grown branch by branch on the ink of a picture.
//!
//! A branch in brackets moves nothing else, so the drawing of a word is a part of the drawing of the same word with one
//! more branch, after any number of steps. A branch that leaves the ink is therefore in no successor that has the other
//! branches too. So words grow from their trunk: each branch that stays on the ink is tried, those first after which
//! most of the ink is covered. The scale is that of the trunk, whose end lies somewhere straight ahead of the base.

use crate::family::{Family, Rule};
use crate::hull::{Fit, Hulls, System, Target};
use crate::picture::Picture;
use crate::strokes::{Laid, Strokes, pixel};
use crate::successors::{Advance, Alphabet, Symbol};
use lsystem_base::sorted;
use lsystem_render::mask::SIDE;
use std::cmp::Reverse;
use std::collections::HashSet;
use std::sync::Arc;

/// The shortest trunk, in pixels.
const SHORTEST: usize = 16;
/// The usual length of a line, in pixels.
const USUAL: f64 = 4.0;
/// The largest distance, in pixels, between the computed end of a trunk and its end in the picture.
const OFF: f64 = 5.0;
/// How far before the place where a trunk is wider a branch begins, in pixels: it parts from the trunk little by little.
const PARTING: f64 = 1.5;
/// A trunk is wider by this many pixels where a branch begins.
const WIDER: usize = 2;
/// The most lines of a trunk before the first branch.
const LINES: usize = 3;
/// The most letters of a trunk that is made of copies.
const MAX_TRUNK: usize = 4;
/// The most turns each way from one letter to the next.
const MAX_BEND: i32 = 4;
/// The most letters of a word.
const MAX_LETTERS: usize = 12;
/// One in this many places of the ink may be uncovered.
const UNCOVERED: usize = 40;
/// The number of sampled places of ink, from which the covered share is estimated.
const PLACES: usize = 1024;
/// The most words of one trunk, and the most branches that are tried after each of them.
const MAX_WORDS: usize = 40;
const MAX_BRANCHES: usize = 3;
/// The number of words that a step of the search lays on the ink, and the strokes of a word that is twice the work.
const SHARE: usize = 1_000;
const STROKES: usize = 64;
/// Each row of trunks gets a part of the work that is smaller by this factor.
const SHARES: [usize; 3] = [1, 2, 2];
/// One in this many places of a straight line may lie beside the ink.
const GAPS: usize = 10;

/// The parts of a plant.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    /// Copies of itself, which the turtle leaves at their ends: `F -> F[+F]F[-F]F`.
    Copies,
    /// Stalks with copies at their ends: `X -> F[+X][-X]FX`, `F -> FF`.
    Stalks,
}

/// A search for the words of one family on one picture, in steps.
#[derive(Clone, Debug)]
pub(crate) struct GrowthSearch {
    picture: Arc<Picture>,
    target: Target,
    alphabet: Alphabet,
    axiom: Vec<Symbol>,
    draws: Vec<bool>,
    /// The successors of the letters; the first one is searched.
    words: Vec<Vec<Symbol>>,
    kind: Kind,
    /// Where the turtle begins, in the frame of the first heading, in pixels.
    base: [f64; 2],
    /// The sampled places of the ink, from which the covered share is estimated.
    places: Vec<[usize; 2]>,
    /// The trunks that are still to be tried, with the work so far: those that end where the picture tells it, in the first
    /// row; all, those first whose lines are a few pixels long, as in most pictures, in the second one; and all, those first
    /// with the longest lines, which have the fewest strokes, in the last one.
    trunks: [(Vec<Trunk>, usize); 3],
    tried: HashSet<Trunk>,
    /// The row of the present trunk.
    row: usize,
    /// The words of the present trunk that are still to grow, and those that were seen.
    open: Vec<Plant>,
    /// The plant on which branches are tried now.
    growing: Option<Growing>,
    seen: HashSet<Vec<Symbol>>,
    /// The words that cover the ink.
    covering: Vec<Vec<Symbol>>,
    /// The work of this step.
    tested: usize,
    scale: Scale,
    left: usize,
    hulls: Hulls,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
struct Trunk {
    n: u8,
    letters: u8,
    /// In half pixels: a plant may be some times as high as its trunk.
    length: u16,
}

/// The number of steps, and the length of a line in pixels.
#[derive(Clone, Copy, Debug, Default)]
struct Scale {
    n: u32,
    unit: f64,
    /// The length of a letter that steps forward, in pixels.
    step: f64,
    /// The letters of the trunk; they come first.
    trunk: usize,
}

/// A letter of a word, on a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Branch {
    /// The letter at whose end it begins, or none at the base.
    from: Option<usize>,
    /// The turns from the first heading.
    turns: i32,
    /// Whether it is a copy at the end of a branch, from which nothing grows.
    is_leaf: bool,
}

/// A word as a tree.
#[derive(Clone, Debug)]
struct Plant {
    branches: Vec<Branch>,
    /// The branches that may come next, as far as is known.
    next: Vec<Branch>,
}

/// A plant on which branches are tried.
#[derive(Clone, Debug)]
struct Growing {
    plant: Plant,
    /// How many of the next branches were tried.
    tried: usize,
    /// Those that stay on the ink, with the places that are covered then.
    kept: Vec<(usize, Branch)>,
}

impl Kind {
    /// The kind of a family whose axiom is one letter.
    fn of(family: &Family) -> Option<Self> {
        let kind = match &family.letters[..] {
            [(_, true, Rule::Free)] => Self::Copies,
            [(_, false, Rule::Free), (_, true, Rule::Fixed(word))] if word.len() == 2 => Self::Stalks,
            _ => return None,
        };
        (family.axiom == [0] && family.alphabet.has_branches).then_some(kind)
    }
}

impl GrowthSearch {
    /// Whether words of a family can be searched.
    pub(crate) fn is_for(family: &Family) -> bool {
        Kind::of(family).is_some()
    }

    /// A search for words of a family whose axiom is one letter that draws, or one that does not with another letter
    /// that is doubled.
    pub(crate) fn new(picture: &Arc<Picture>, family: &Family, target: &Target, steps: &[u32]) -> Option<Self> {
        let kind = Kind::of(family)?;
        let ink: Vec<[usize; 2]> =
            (0..SIDE * SIDE).map(|at| [at % SIDE, at / SIDE]).filter(|&[x, y]| picture.mask.has(x, y)).collect();
        // Each one of a row of places that lie everywhere.
        let places = (0..PLACES).map(|at| ink[(at * ink.len() + ink.len() / 2) / PLACES]).collect();
        let base = base(&ink, target, picture.stroke)?;
        let mut search = Self {
            picture: picture.clone(),
            target: target.clone(),
            alphabet: family.alphabet,
            axiom: family.axiom.clone(),
            draws: family.draws.clone(),
            words: family.successors(&[]),
            kind,
            base,
            places,
            trunks: [(Vec::new(), 0), (Vec::new(), 0), (Vec::new(), 0)],
            tried: HashSet::new(),
            row: 0,
            open: Vec::new(),
            growing: None,
            seen: HashSet::new(),
            covering: Vec::new(),
            tested: 0,
            scale: Scale::default(),
            left: 0,
            hulls: Hulls::default(),
        };
        let straight = (SHORTEST..SIDE).take_while(|&length| search.is_inked([0.0, 0.0], length as f64, 0)).last()?;
        let mut trunks = Vec::new();
        for length in 2 * SHORTEST..=2 * straight + 2 {
            let letters = if kind == Kind::Copies { 1..=MAX_TRUNK } else { 1..=1 };
            for (letters, &n) in letters.flat_map(|letters| steps.iter().map(move |n| (letters, n))) {
                let (n, letters, length) = (n as u8, letters as u8, length as u16);
                trunks.push(Trunk { n, letters, length });
            }
        }
        // The last ones are tried first.
        let unit = |trunk: &Trunk| search.scale_of(*trunk).unit;
        let unusual = |trunk: &Trunk| (unit(trunk) / USUAL).max(USUAL / unit(trunk));
        let ends = search.ends(straight);
        // How far a trunk ends beside the nearest of these places, in pixels.
        let off = |trunk: &Trunk| {
            let length = f64::from(trunk.length) / 2.0;
            ends.iter().map(|end| (end - length).abs()).fold(f64::INFINITY, f64::min)
        };
        let mut told: Vec<Trunk> = trunks.iter().filter(|trunk| off(trunk) <= OFF).copied().collect();
        sorted::sort_by_key(&mut told, |trunk| Reverse((off(trunk).round() as u32, unusual(trunk).to_bits())));
        let (mut usual, mut long) = (trunks.clone(), trunks);
        // The bits of positive numbers are in the order of the numbers.
        sorted::sort_by_key(&mut usual, |trunk| Reverse(unusual(trunk).to_bits()));
        sorted::sort_by_key(&mut long, |trunk| unit(trunk).to_bits());
        search.trunks = [(told, 0), (usual, 0), (long, 0)];
        Some(search)
    }

    /// Works for some milliseconds at most.
    pub(crate) fn advance(&mut self) -> Advance {
        self.tested = 0;
        while self.tested < SHARE {
            if let Some(word) = self.covering.pop() {
                return Advance::Word(word);
            }
            if let Some(growing) = self.growing.take() {
                self.grow(growing);
                continue;
            }
            if let Some(plant) = self.open.pop().filter(|_| self.left > 0) {
                self.left -= 1;
                let is_growing = plant.branches.len() < MAX_LETTERS;
                self.growing = is_growing.then(|| Growing { plant, tried: 0, kept: Vec::new() });
                continue;
            }
            let open = self.trunks.iter().enumerate().filter(|(_, (trunks, _))| !trunks.is_empty());
            let Some((row, _)) = open.min_by_key(|(row, (_, work))| work * SHARES[*row]) else { return Advance::Done };
            self.row = row;
            let Some(trunk) = self.trunks[row].0.pop() else { return Advance::Done };
            if self.tried.insert(trunk) {
                self.left = MAX_WORDS;
                self.begin(trunk);
            }
        }
        Advance::More
    }

    /// Where trunks may end, in pixels from the base, if the ink goes straight on as far: copies end at the top, and stalks
    /// at the first branch or at an equal part of the way there.
    fn ends(&self, straight: usize) -> Vec<f64> {
        let fit = Fit { unit: 1.0, x: self.base[0], y: self.base[1], stroke: 0.0 };
        let is_inked = |along: usize, aside: f64| {
            let [x, y] = pixel(self.target.first, fit, along as f64, aside);
            x >= 0.0 && y >= 0.0 && x < SIDE as f64 && y < SIDE as f64 && self.picture.mask.has(x as usize, y as usize)
        };
        if self.kind == Kind::Copies {
            // The line may have had gaps; the last ink is the round end of the stroke.
            let last = (0..=straight).rev().find(|&along| is_inked(along, 0.0)).unwrap_or(straight);
            return vec![last as f64 - self.picture.stroke];
        }
        let width = |along: usize| {
            let aside = |sign: f64| (1..SIDE).take_while(|&far| is_inked(along, sign * far as f64)).count();
            aside(1.0) + aside(-1.0)
        };
        let from = (2.0 * self.picture.stroke).ceil() as usize + 1;
        let trunk = width(from);
        let first = (from..straight).find(|&along| width(along) >= trunk + WIDER).unwrap_or(straight);
        (1..=LINES).map(|lines| (first as f64 - PARTING) / lines as f64).collect()
    }

    fn scale_of(&self, trunk: Trunk) -> Scale {
        let (length, letters) = (f64::from(trunk.length) / 2.0, f64::from(trunk.letters));
        let unit = match self.kind {
            Kind::Copies => length / libm::pow(letters, f64::from(trunk.n)),
            Kind::Stalks => length / libm::ldexp(1.0, i32::from(trunk.n) - 1),
        };
        Scale { n: trunk.n.into(), unit, step: length / letters, trunk: trunk.letters.into() }
    }

    /// Begins with a trunk, if it stays on the ink.
    fn begin(&mut self, trunk: Trunk) {
        let letters = usize::from(trunk.letters);
        self.scale = self.scale_of(trunk);
        self.open.clear();
        self.seen.clear();
        let branches: Vec<Branch> =
            (0..letters).map(|at| Branch { from: at.checked_sub(1), turns: 0, is_leaf: false }).collect();
        if self.scale.unit >= 1.0 && self.covered(&branches).is_some() {
            let bases = std::iter::once(None).chain((0..letters).map(Some));
            let next = bases.flat_map(|from| self.branches_from(from, 0)).collect();
            self.open.push(Plant { branches, next });
        }
    }

    /// The branches that may begin at the end of a letter with this heading.
    fn branches_from(&self, from: Option<usize>, turns: i32) -> Vec<Branch> {
        let order = self.alphabet.order as i32;
        let most = MAX_BEND.min(order / 2);
        let bends = (-most..=most).filter(move |bend| 2 * bend != -order);
        let kinds: &[bool] = if self.kind == Kind::Copies { &[false] } else { &[false, true] };
        bends.flat_map(|bend| kinds.iter().map(move |&is_leaf| Branch { from, turns: turns + bend, is_leaf })).collect()
    }

    /// Whether a branch may grow on a plant, as far as its first straight line tells.
    fn is_open(&self, branches: &[Branch], branch: Branch) -> bool {
        let length = if branch.is_leaf { 0.0 } else { self.scale.step };
        !branches.contains(&branch) && self.is_inked(self.end(branches, branch.from), length, branch.turns)
    }

    /// Tries the next branch on a plant; after the last one, grows each of the best.
    fn grow(&mut self, mut growing: Growing) {
        let with =
            |plant: &Plant, branch: Branch| -> Vec<Branch> { plant.branches.iter().copied().chain([branch]).collect() };
        if let Some(&branch) = growing.plant.next.get(growing.tried) {
            growing.tried += 1;
            if self.is_open(&growing.plant.branches, branch) {
                let covered = self.covered(&with(&growing.plant, branch));
                growing.kept.extend(covered.map(|covered| (covered, branch)));
            }
            self.growing = Some(growing);
            return;
        }
        let Growing { plant, mut kept, .. } = growing;
        let next: Vec<Branch> = kept.iter().map(|(_, branch)| *branch).collect();
        sorted::sort_by_key(&mut kept, |(covered, _)| Reverse(*covered));
        kept.truncate(MAX_BRANCHES);
        for &(covered, branch) in kept.iter().rev() {
            let branches = with(&plant, branch);
            let word = self.word(&branches);
            if !self.seen.insert(word.clone()) {
                continue;
            }
            if (PLACES - covered) * UNCOVERED <= PLACES {
                self.covering.push(word);
            }
            let new =
                if branch.is_leaf { Vec::new() } else { self.branches_from(Some(branches.len() - 1), branch.turns) };
            let next = next.iter().copied().chain(new).collect();
            self.open.push(Plant { branches, next });
        }
    }

    fn fit(&self) -> Fit {
        Fit { unit: self.scale.unit, x: self.base[0], y: self.base[1], stroke: self.picture.stroke }
    }

    /// The strokes of a plant, if they stay on the ink.
    fn strokes(&mut self, branches: &[Branch]) -> Option<Strokes> {
        self.words[0] = self.word(branches);
        let Self { hulls, words, axiom, draws, alphabet, target, picture, scale, .. } = self;
        let system = System { alphabet: *alphabet, axiom, words, draws };
        hulls.set(&target.headings, system, scale.n);
        let fit = Fit { unit: scale.unit, x: self.base[0], y: self.base[1], stroke: picture.stroke };
        let strokes = Strokes::on_ink(system, hulls, scale.n, target, picture, fit);
        let work = 1 + strokes.as_ref().map_or(0, |strokes| strokes.count() / STROKES);
        self.tested += work;
        self.trunks[self.row].1 += work;
        strokes
    }

    /// How many places the strokes of a plant cover, if they stay on the ink.
    fn covered(&mut self, branches: &[Branch]) -> Option<usize> {
        let fit = self.fit();
        let strokes = self.strokes(branches)?;
        let mask = strokes.mask(Laid::straight(self.target.first, Fit { stroke: fit.stroke + 1.0, ..fit }));
        Some(self.places.iter().filter(|&&[x, y]| mask.has(x, y)).count())
    }

    /// Where a letter ends, from the base, in the frame of the first heading, in pixels.
    fn end(&self, branches: &[Branch], mut at: Option<usize>) -> [f64; 2] {
        let mut end = [0.0, 0.0];
        while let Some(branch) = at.map(|at| branches[at]) {
            let (cos, sin) = self.direction(branch.turns);
            end = [end[0] + cos * self.scale.step, end[1] + sin * self.scale.step];
            at = branch.from;
        }
        end
    }

    fn direction(&self, turns: i32) -> (f64, f64) {
        let all = &self.target.headings.all;
        let (cos, sin, ..) = all[turns.rem_euclid(all.len() as i32) as usize];
        (cos, sin)
    }

    /// Whether a straight line from a place, in the frame of the first heading, lies on the ink.
    fn is_inked(&self, from: [f64; 2], length: f64, turns: i32) -> bool {
        let (cos, sin) = self.direction(turns);
        let fit = Fit { unit: 1.0, x: self.base[0], y: self.base[1], stroke: 0.0 };
        let steps = length.ceil() as usize;
        let is_missing = |at: &usize| {
            let far = *at as f64;
            let [x, y] = pixel(self.target.first, fit, from[0] + cos * far, from[1] + sin * far);
            !(x >= 0.0
                && y >= 0.0
                && x < SIDE as f64
                && y < SIDE as f64
                && self.picture.close.has(x as usize, y as usize))
        };
        (0..=steps).filter(is_missing).count() * GAPS <= steps
    }

    /// The word of a tree. The turtle leaves a plant of copies at the end of its trunk; elsewhere it does not come back
    /// from the last branch.
    fn word(&self, branches: &[Branch]) -> Vec<Symbol> {
        let mut word = Vec::new();
        self.write(branches, None, 0, &mut word);
        word
    }

    fn write(&self, branches: &[Branch], at: Option<usize>, heading: i32, word: &mut Vec<Symbol>) {
        let mut from: Vec<usize> = (0..branches.len()).filter(|&branch| branches[branch].from == at).collect();
        // As books do, branches to the left come first.
        sorted::sort_by_key(&mut from, |&branch| (Reverse(branches[branch].turns), branches[branch].is_leaf));
        let is_on_trunk = self.kind == Kind::Copies && at.is_none_or(|at| at < self.scale.trunk);
        let last = match is_on_trunk {
            true => from.iter().position(|&branch| branch < self.scale.trunk),
            // As books do, the stalk that goes on most straight comes last.
            false => (0..from.len()).max_by_key(|&at| {
                let branch = branches[from[at]];
                (!branch.is_leaf, Reverse((branch.turns - heading).abs()), at)
            }),
        };
        let last = last.map(|last| from.remove(last));
        let letter = |branch: usize| match (self.kind, branches[branch].is_leaf) {
            (Kind::Copies, _) | (_, true) => 0,
            (Kind::Stalks, false) => 1,
        };
        for branch in from {
            word.push(self.alphabet.open());
            self.turn(branches[branch].turns - heading, word);
            word.push(letter(branch));
            self.write(branches, Some(branch), branches[branch].turns, word);
            word.push(self.alphabet.close());
        }
        if let Some(branch) = last {
            self.turn(branches[branch].turns - heading, word);
            word.push(letter(branch));
            self.write(branches, Some(branch), branches[branch].turns, word);
        }
    }

    fn turn(&self, turns: i32, word: &mut Vec<Symbol>) {
        let order = self.alphabet.order as i32;
        let turns = (turns + order / 2).rem_euclid(order) - order / 2;
        let symbol = if turns > 0 { self.alphabet.left() } else { self.alphabet.right() };
        word.extend(std::iter::repeat_n(symbol, turns.unsigned_abs() as usize));
    }
}

/// Where a turtle begins, in the frame of the first heading: at the ink that reaches furthest against its heading, if
/// that is one stroke.
fn base(ink: &[[usize; 2]], target: &Target, stroke: f64) -> Option<[f64; 2]> {
    let (cos, sin) = target.first;
    let place = |&[x, y]: &[usize; 2]| (x as f64 + 0.5, -(y as f64 + 0.5));
    let along = |at: &[usize; 2]| place(at).0 * cos + place(at).1 * sin;
    let across = |at: &[usize; 2]| place(at).1 * cos - place(at).0 * sin;
    let least = ink.iter().map(along).fold(f64::INFINITY, f64::min);
    let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
    for at in ink.iter().filter(|at| along(at) < least + 1.0) {
        (left, right) = (left.min(across(at)), right.max(across(at)));
    }
    let is_one_stroke = right - left <= 2.0 * stroke + 3.0;
    is_one_stroke.then_some([least + stroke - 0.5, f64::midpoint(left, right)])
}
