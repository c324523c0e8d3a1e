//! The graph of shared blocks: what each letter draws in each number of steps, built once, from the last step back.

use super::Piece;
use super::builder::Builder;
use super::tree::{Tree, WORD};
use crate::Plane;
use crate::drawing::block::{BlockId, Placed, Space};
use crate::room::bytes_of;
use crate::space::{reach, times, unit_of};
use crate::style::{ColourChange, StyleChange};
use crate::turtle::{LARGEST, Op, Pen, Score};
use lsystem_derive::{LetterId, Rewrite, Rules};
use lsystem_syntax::Meter;

/// How a piece of a drawing leaves the turtle, in the frame in which it entered: at the origin heading along +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect<S: Space = Plane> {
    /// Where it ends, in units of `2^exponent` steps.
    pub at: S::Point,
    /// Of the unit that `at` is in.
    pub exponent: i32,
    /// How it has turned.
    pub heading: S::Turn,
    /// What has happened to the style.
    pub style: StyleChange,
}

/// Whether every reachable letter always draws the same: no choices, no variation, nothing that looks to the directions
/// of the model, no rewritten letter or successor that ends on another branch than it began on or returns from branches
/// it did not open, and no polygon that is made by more than one production.
pub(crate) fn memoises<S: Space>(rules: &Rules, score: &Score<S>) -> bool {
    let looks_out = |op: &Op<S>| matches!(op, Op::Bend(_)) || matches!(op, Op::Upright) && !S::LEVEL;
    let is_kept = |s: LetterId| matches!(rules.rewrites[usize::from(s)], Rewrite::Keep);
    !score.varies()
        && !score.ops.iter().flatten().any(looks_out)
        && is_filled_at_once(&rules.axiom.letters, score, is_kept)
        && (rules.rewrites.iter().zip(rules.reachable()).enumerate()).all(|(symbol, (rewrite, reached))| {
            let balanced = |word: &[LetterId]| {
                let kept = word.iter().filter(|&&s| is_kept(s));
                is_balanced(kept.flat_map(|&s| &score.ops[usize::from(s)])) && is_filled_at_once(word, score, is_kept)
            };
            match rewrite {
                _ if !reached => true,
                Rewrite::Keep => true,
                Rewrite::Always(word) => {
                    let alone = [symbol as LetterId];
                    balanced(word) && is_balanced(&score.ops[symbol]) && is_filled_at_once(&alone, score, |_| true)
                }
                Rewrite::Choose(_) => false,
            }
        })
}

pub(super) fn is_balanced<'a, S: Space>(ops: impl IntoIterator<Item = &'a Op<S>>) -> bool {
    let mut level = 0_i64;
    let never_below = ops.into_iter().all(|op| {
        match op {
            Op::Push(_) => level += 1,
            Op::Pop => level -= 1,
            _ => {}
        }
        level >= 0
    });
    never_below && level == 0
}

/// Whether every polygon that is opened or closed by the letters of `word` that stay is opened and closed by them, and
/// only they stand inside.
fn is_filled_at_once<S: Space>(word: &[LetterId], score: &Score<S>, stays: impl Fn(LetterId) -> bool) -> bool {
    let mut open = 0_i64;
    let fits = word.iter().all(|&symbol| {
        let stays = stays(symbol);
        for op in score.ops[usize::from(symbol)].iter().filter(|_| stays) {
            match op {
                Op::OpenPolygon => open += 1,
                Op::ClosePolygon => open -= 1,
                _ => {}
            }
        }
        open == 0 || (open > 0 && stays)
    });
    fits && open == 0
}

/// Which letters are needed at which depth.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// By depth from `n` down to 1: the rewritten letters, sorted.
    levels: Vec<Vec<LetterId>>,
    /// The letters that the next level needs; `None` while the axiom is read.
    next: Option<Vec<LetterId>>,
    /// Which of them is read, and how many letters of its successor have been.
    at: (usize, usize),
    /// By letter: whether one that has been read makes it.
    made: Vec<bool>,
    /// The letters of the axiom and of the successors in all levels.
    pub cost: u64,
}

/// Letters read between two looks at the meter.
const READ: usize = 256;

impl Plan {
    pub(super) fn new(rules: &Rules) -> Self {
        let (made, cost) = (vec![false; rules.rewrites.len()], rules.axiom.letters.len() as u64);
        Self { levels: vec![], next: None, at: (0, 0), made, cost }
    }

    /// The depths planned; `None` while the axiom is read.
    pub(super) fn depths(&self) -> Option<u32> {
        self.next.is_some().then_some(self.levels.len() as u32)
    }

    /// Plans one depth more, or goes on with that until the meter is spent.
    pub(super) fn step(&mut self, rules: &Rules, meter: &mut Meter) {
        loop {
            let word = match &self.next {
                None if self.at.0 == 0 => rules.axiom.letters.as_slice(),
                None => break,
                Some(next) => match next.get(self.at.0) {
                    Some(&symbol) => successor(rules, symbol),
                    None => break,
                },
            };
            let run = &word[self.at.1..word.len().min(self.at.1 + READ)];
            if self.at.1 == 0 && self.next.is_some() {
                self.cost += word.len() as u64;
            }
            for &symbol in run {
                self.made[usize::from(symbol)] |= is_rewritten(rules, symbol);
            }
            self.at.1 += run.len();
            if self.at.1 == word.len() {
                self.at = (self.at.0 + 1, 0);
            }
            // Reading takes a quarter of what handling a symbol does.
            meter.charge(1 + run.len() as u64 / 4);
            if meter.is_spent() {
                return;
            }
        }
        let is_made = |letter: &usize| self.made[*letter];
        let needed = (0..self.made.len()).filter(is_made).map(|letter| letter as LetterId).collect();
        meter.charge(1 + self.made.len() as u64 / 8);
        self.levels.extend(self.next.replace(needed));
        self.made.fill(false);
        self.at = (0, 0);
    }

    /// By depth from 1: the letters to make the pieces of.
    pub(super) fn levels(&mut self) -> Vec<Vec<LetterId>> {
        let mut levels = core::mem::take(&mut self.levels);
        levels.reverse();
        levels
    }
}

fn is_rewritten(rules: &Rules, symbol: LetterId) -> bool {
    !matches!(rules.rewrites[usize::from(symbol)], Rewrite::Keep)
}

/// What always replaces a letter.
fn successor(rules: &Rules, symbol: LetterId) -> &[LetterId] {
    rules.rewrites[usize::from(symbol)].always().unwrap_or_default()
}

/// The pieces of one depth, sorted by letter.
pub(super) type Level<S = Plane> = Vec<(LetterId, Piece<S>)>;

/// Where a word comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Origin {
    /// The letter that it replaces; `None` for the axiom.
    pub former: Option<LetterId>,
    /// The derivation step that makes it.
    pub step: u32,
}

impl Origin {
    /// The colour of a letter of the word, where that tells when it was made: what goes on keeps it.
    pub(super) fn date_of(&self, letter: LetterId) -> ColourChange {
        let goes_on = self.former == Some(letter);
        if goes_on { ColourChange::Add(0) } else { ColourChange::Set(self.step.cast_signed()) }
    }
}

/// What a piece is made of.
#[derive(Clone, Copy)]
pub(super) struct Word<'a, S: Space> {
    pub score: &'a Score<S>,
    /// The pieces of its rewritten letters; at depth 0, where there are none, every letter acts by itself.
    pub below: Option<&'a Level<S>>,
    pub letters: &'a [LetterId],
    pub origin: Origin,
    /// With which the turtle enters.
    pub heading: S::Turn,
}

impl<'a, S: Space> Word<'a, S> {
    fn lower(&self, symbol: LetterId) -> Option<&'a Piece<S>> {
        let below = self.below?;
        below.binary_search_by_key(&symbol, |(s, _)| *s).ok().map(|place| &below[place].1)
    }

    fn ops(&self, symbol: LetterId) -> &'a [Op<S>] {
        &self.score.ops[usize::from(symbol)]
    }
}

/// A piece in the making, letter by letter.
#[derive(Clone, Debug)]
pub(super) struct Writing<S: Space> {
    /// The letters done: measured while there is no tree, then drawn.
    done: usize,
    /// How many branches are open there.
    level: i32,
    exponent: Option<i32>,
    /// What the letters do at most, in items.
    weight: usize,
    /// In the last step all but one of the letters that replace another are new: whether that is so, and which is not.
    young: Option<Option<usize>>,
    pen: Pen<S>,
    saved: Vec<Pen<S>>,
    tree: Option<Tree<S>>,
}

impl<S: Space> Writing<S> {
    pub(super) fn new(word: &Word<'_, S>) -> Self {
        let Word { score, below, letters, origin, heading } = *word;
        let youngest = origin.former.filter(|_| below.is_none() && score.growth < 1.0);
        Self {
            done: 0,
            level: 0,
            exponent: None,
            weight: 0,
            young: youngest.map(|former| score.heir(former, letters)),
            pen: Pen::new(heading, StyleChange::NONE),
            saved: vec![],
            tree: None,
        }
    }

    /// The bytes that it takes.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.saved) + self.tree.as_ref().map_or(0, Tree::bytes)
    }

    /// Goes on until the meter is spent; the piece when it is made.
    pub(super) fn step(&mut self, builder: &mut Builder<S>, word: &Word<'_, S>, meter: &mut Meter) -> Option<Piece<S>> {
        if self.tree.is_none() {
            while let Some(&symbol) = word.letters.get(self.done) {
                if meter.is_spent() {
                    return None;
                }
                meter.charge(1);
                self.measure(builder, word, symbol);
                self.done += 1;
            }
            self.done = 0;
        }
        let exponent = self.exponent.unwrap_or(0);
        let mut tree = self.tree.take().unwrap_or_else(|| Tree::of_word(exponent, self.weight > WORD));
        while let Some(&symbol) = word.letters.get(self.done) {
            if meter.is_spent() || builder.is_full {
                self.tree = Some(tree);
                return None;
            }
            self.draw(builder, word, symbol, (&mut tree, exponent));
            meter.charge(2 + word.ops(symbol).len() as u64 + builder.take_work());
            self.done += 1;
        }
        while !meter.is_spent() && !builder.is_full {
            // What is left open returns where it began only in the axiom, where nothing follows.
            let finished = tree.finish_one(builder);
            meter.charge(1 + builder.take_work());
            if let Some(block) = finished {
                return Some(Piece { block, effect: effect(&self.pen, exponent) });
            }
        }
        self.tree = Some(tree);
        None
    }

    /// Looks how far a letter goes.
    fn measure(&mut self, builder: &Builder<S>, word: &Word<'_, S>, symbol: LetterId) {
        let score = word.score;
        let below = word.lower(symbol);
        let own = match below {
            None => score.goes(symbol).then_some(score.exponent),
            Some(piece) => exponent(builder, piece),
        };
        self.exponent = self.exponent.max(own.map(|own| own.saturating_add(smaller(score, self.level))));
        self.weight += 1;
        if below.is_none() {
            self.weight += word.ops(symbol).len();
            let depths = word.ops(symbol).iter().map(|op| match op {
                Op::Push(_) => 1,
                Op::Pop => -1,
                _ => 0,
            });
            self.level = self.level.saturating_add(depths.sum::<i32>()).max(0);
        }
    }

    fn draw(
        &mut self,
        builder: &mut Builder<S>,
        word: &Word<'_, S>,
        symbol: LetterId,
        (tree, exponent): (&mut Tree<S>, i32),
    ) {
        let Self { done, young, pen, saved, .. } = self;
        let score = word.score;
        if score.dated {
            pen.style.colour = word.origin.date_of(symbol);
        }
        match word.lower(symbol) {
            None => {
                let scale = libm::scalbn(1.0, score.exponent - exponent);
                let grown;
                let ops = match young {
                    Some(heir) if *heir != Some(*done) => {
                        grown = word.ops(symbol).iter().map(|&op| score.growing(op)).collect::<Vec<_>>();
                        grown.as_slice()
                    }
                    _ => word.ops(symbol),
                };
                tree.draw(builder, *done as u64, |desk, directions| pen.act(ops, saved, scale, directions, desk));
            }
            Some(piece) => {
                if let Some(block) = piece.block {
                    let placed = place(builder, block, pen, exponent, 1.0);
                    tree.place(builder, placed);
                }
                follow(builder, pen, &piece.effect, exponent, 1.0);
            }
        }
    }
}

/// The exponent of what lengths are multiplied by on a branch so many levels deep.
pub(super) fn smaller<S: Space>(score: &Score<S>, level: i32) -> i32 {
    if score.shrinking == 1.0 || level == 0 {
        return 0;
    }
    unit_of(libm::pow(score.shrinking, f64::from(level)).min(LARGEST))
}

/// The exponent of the longest way in a piece; `None` if it goes nowhere.
pub(super) fn exponent<S: Space>(builder: &Builder<S>, Piece { block, effect }: &Piece<S>) -> Option<i32> {
    let block = block.map(|block| builder.blocks[block.0 as usize].exponent);
    block.max((effect.at != S::Point::default()).then_some(effect.exponent))
}

/// Places `block`, `factor` times as large, where the pen is, in units of `2^exponent` steps.
pub(super) fn place<S: Space>(
    builder: &mut Builder<S>,
    block: BlockId,
    pen: &Pen<S>,
    exponent: i32,
    factor: f64,
) -> Placed<S> {
    let own = builder.blocks[block.0 as usize].exponent;
    Placed {
        block,
        style: builder.styles.id(&pen.style),
        at: pen.at,
        heading: pen.heading,
        scale: pen.scale * libm::scalbn(factor, own - exponent),
    }
}

/// Moves the pen as a piece does that is `factor` times as large.
pub(super) fn follow<S: Space>(
    builder: &mut Builder<S>,
    pen: &mut Pen<S>,
    effect: &Effect<S>,
    exponent: i32,
    factor: f64,
) {
    let axes = S::axes(&mut builder.directions, pen.heading);
    let by = times(shifted(times(effect.at, factor), effect.exponent.saturating_sub(exponent)), pen.scale);
    pen.at = S::lie(&axes, pen.at, by);
    pen.heading = S::then(pen.heading, effect.heading);
    pen.style = pen.style.then(&effect.style);
}

/// What has happened to the pen, in units of `2^exponent` steps.
pub(super) fn effect<S: Space>(pen: &Pen<S>, exponent: i32) -> Effect<S> {
    let shift = unit_of(reach(&pen.at));
    let at = shifted(pen.at, -shift);
    Effect { at, exponent: exponent.saturating_add(shift), heading: pen.heading, style: pen.style }
}

/// Every coordinate times `2^exponent`.
fn shifted<P: AsMut<[f64]>>(mut point: P, exponent: i32) -> P {
    point.as_mut().iter_mut().for_each(|c| *c = libm::scalbn(*c, exponent));
    point
}
