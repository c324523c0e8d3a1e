//! The graph of shared blocks: what each letter draws in each number of steps, built once, from the last step back.

use super::builder::Builder;
use super::sheet::{Desk, Sheet};
use super::{BlockId, ColourChange, Item, Piece, Placed, StyleChange};
use crate::space::{Space, reach, times};
use crate::turtle::{LARGEST, Op, Pen, Score, exponent_of};
use crate::{Plane, Program, Rewrite, SymbolId};
use lsystem_syntax::sorted::set;

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
pub(crate) fn memoises<S: Space>(program: &Program, score: &Score<S>) -> bool {
    let looks_out = |op: &Op<S>| matches!(op, Op::Bend(_)) || matches!(op, Op::Upright) && !S::LEVEL;
    let is_kept = |s: SymbolId| matches!(program.rewrites[usize::from(s)], Rewrite::Keep);
    !score.varies()
        && !score.ops.iter().flatten().any(looks_out)
        && is_filled_at_once(&program.axiom, score, is_kept)
        && (program.rewrites.iter().zip(program.reachable()).enumerate()).all(|(symbol, (rewrite, reached))| {
            let balanced = |word: &[SymbolId]| {
                let kept = word.iter().filter(|&&s| is_kept(s));
                is_balanced(kept.flat_map(|&s| &score.ops[usize::from(s)])) && is_filled_at_once(word, score, is_kept)
            };
            match rewrite {
                _ if !reached => true,
                Rewrite::Keep => true,
                Rewrite::Always(word) => {
                    let alone = [symbol as SymbolId];
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
fn is_filled_at_once<S: Space>(word: &[SymbolId], score: &Score<S>, stays: impl Fn(SymbolId) -> bool) -> bool {
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
pub(crate) struct Plan {
    /// By depth from `n` down to 1: the rewritten letters, sorted.
    levels: Vec<Vec<SymbolId>>,
    /// The letters that the next level needs.
    next: Vec<SymbolId>,
    /// The letters of the axiom and of the successors in all levels.
    pub(crate) cost: u64,
}

impl Plan {
    pub(crate) fn new(program: &Program) -> Self {
        Self { levels: vec![], next: rewritten(program, &program.axiom), cost: program.axiom.len() as u64 }
    }

    /// The depths planned.
    pub(crate) fn depths(&self) -> u32 {
        self.levels.len() as u32
    }

    /// Plans one depth more.
    pub(crate) fn step(&mut self, program: &Program, meter: &mut crate::Meter) {
        let mut next = Vec::new();
        let before = self.cost;
        for &symbol in &self.next {
            if let Rewrite::Always(word) = &program.rewrites[usize::from(symbol)] {
                self.cost += word.len() as u64;
                next.extend(rewritten(program, word));
            }
        }
        self.levels.push(core::mem::replace(&mut self.next, set(next)));
        meter.charge(1 + self.cost - before);
    }

    /// By depth from 1: the letters to make the pieces of.
    pub(crate) fn levels(&mut self) -> Vec<Vec<SymbolId>> {
        let mut levels = core::mem::take(&mut self.levels);
        levels.reverse();
        levels
    }
}

/// The letters of `word` that a production rewrites, each once.
fn rewritten(program: &Program, word: &[SymbolId]) -> Vec<SymbolId> {
    let is_rewritten = |s: &SymbolId| !matches!(program.rewrites[usize::from(*s)], Rewrite::Keep);
    set(word.iter().copied().filter(is_rewritten))
}

/// The pieces of one depth, sorted by letter.
pub(crate) type Level<S = Plane> = Vec<(SymbolId, Piece<S>)>;

/// Where a word comes from.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Origin {
    /// The letter that it replaces; `None` for the axiom.
    pub(crate) former: Option<SymbolId>,
    /// The derivation step that makes it.
    pub(crate) step: u32,
}

/// Makes the piece of a `word` whose rewritten letters have the pieces of the level `below`; at depth 0, where there
/// is none, every letter acts by itself. The turtle enters with `heading`.
pub(crate) fn piece<S: Space>(
    builder: &mut Builder<S>,
    score: &Score<S>,
    below: Option<&Level<S>>,
    word: &[SymbolId],
    origin: Origin,
    heading: S::Turn,
) -> Piece<S> {
    let lower = |symbol: SymbolId| -> Option<&Piece<S>> {
        let below = below?;
        below.binary_search_by_key(&symbol, |(s, _)| *s).ok().map(|place| &below[place].1)
    };
    let mut level = 0_i32;
    let exponent = word.iter().filter_map(|&s| {
        let below = lower(s);
        let own = match below {
            None => score.goes(s).then_some(score.exponent),
            Some(piece) => exponent(builder, piece),
        };
        let own = own.map(|own| own.saturating_add(smaller(score, level)));
        if below.is_none() {
            let depths = score.ops[usize::from(s)].iter().map(|op| match op {
                Op::Push(_) => 1,
                Op::Pop => -1,
                _ => 0,
            });
            level = level.saturating_add(depths.sum::<i32>()).max(0);
        }
        own
    });
    let exponent = exponent.max().unwrap_or(0);
    // In the last step all but one of the letters that replace another are new.
    let youngest = origin.former.filter(|_| below.is_none() && score.growth < 1.0);
    let heir = youngest.and_then(|former| score.heir(former, word));
    let mut pen = Pen::new(heading, StyleChange::NONE);
    let (mut saved, mut sheet) = (Vec::new(), Sheet::new());
    for (index, &symbol) in word.iter().enumerate() {
        if score.dated {
            let goes_on = origin.former == Some(symbol);
            let step = origin.step.cast_signed();
            pen.style.colour = if goes_on { ColourChange::Add(0) } else { ColourChange::Set(step) };
        }
        match lower(symbol) {
            None => {
                let scale = libm::scalbn(1.0, score.exponent - exponent);
                sheet.symbol = index as u32;
                let Builder { styles, directions, vertices, .. } = builder;
                let mut desk = Desk { sheet: &mut sheet, styles, vertices };
                let ops = &score.ops[usize::from(symbol)];
                if youngest.is_some() && heir != Some(index) {
                    pen.act(&score.growing(ops), &mut saved, scale, directions, &mut desk);
                } else {
                    pen.act(ops, &mut saved, scale, directions, &mut desk);
                }
            }
            Some(piece) => {
                if let Some(block) = piece.block {
                    let placed = place(builder, block, &pen, exponent, 1.0);
                    sheet.items.push(Item::Block(placed));
                }
                follow(builder, &mut pen, &piece.effect, exponent, 1.0);
            }
        }
    }
    // What is left open returns where it began only in the axiom, where nothing follows.
    sheet.finish();
    let block = builder.block(&sheet.items, exponent);
    Piece { block, effect: effect(&pen, exponent) }
}

/// The exponent of what lengths are multiplied by on a branch so many levels deep.
fn smaller<S: Space>(score: &Score<S>, level: i32) -> i32 {
    if score.shrinking == 1.0 || level == 0 {
        return 0;
    }
    exponent_of(libm::pow(score.shrinking, f64::from(level)).min(LARGEST))
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
    let shift = exponent_of(reach(&pen.at));
    let at = shifted(pen.at, -shift);
    Effect { at, exponent: exponent.saturating_add(shift), heading: pen.heading, style: pen.style }
}

/// Every coordinate times `2^exponent`.
fn shifted<P: AsMut<[f64]>>(mut point: P, exponent: i32) -> P {
    point.as_mut().iter_mut().for_each(|c| *c = libm::scalbn(*c, exponent));
    point
}
