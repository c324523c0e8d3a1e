//! The graph of shared blocks: what each letter draws in each number of steps, built once, from the last step back.

use super::builder::Builder;
use super::{BlockId, Item, Piece, Placed, Stroke, StyleChange};
use crate::sorted::set;
use crate::turtle::{Op, Pen, Score, exponent_of};
use crate::{Heading, Program, Rewrite, SymbolId};

/// How a piece of a drawing leaves the turtle, in the frame in which it entered: at the origin heading along +x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Effect {
    /// Where it ends, in units of `2^exponent` steps.
    pub at: [f64; 2],
    /// Of the unit that `at` is in.
    pub exponent: i32,
    /// How far it has turned, counter-clockwise.
    pub heading: Heading,
    /// What has happened to the style.
    pub style: StyleChange,
}

/// Whether every reachable letter always draws the same: no choices, and no rewritten letter or successor that ends
/// on another branch than it began on or returns from branches it did not open.
pub(crate) fn memoises(program: &Program, score: &Score) -> bool {
    (program.rewrites.iter().zip(program.reachable()).enumerate()).all(|(symbol, (rewrite, reached))| {
        let balanced = |word: &[SymbolId]| {
            let kept = |&&s: &&SymbolId| matches!(program.rewrites[usize::from(s)], Rewrite::Keep);
            is_balanced(word.iter().filter(kept).flat_map(|&s| &score.ops[usize::from(s)]))
        };
        match rewrite {
            _ if !reached => true,
            Rewrite::Keep => true,
            Rewrite::Always(word) => balanced(word) && is_balanced(&score.ops[symbol]),
            Rewrite::Choose(_) => false,
        }
    })
}

fn is_balanced<'a>(ops: impl IntoIterator<Item = &'a Op>) -> bool {
    let mut level = 0_i64;
    let never_below = ops.into_iter().all(|op| {
        match op {
            Op::Push => level += 1,
            Op::Pop => level -= 1,
            _ => {}
        }
        level >= 0
    });
    never_below && level == 0
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
    pub(crate) fn step(&mut self, program: &Program, left: &mut u64) {
        let mut next = Vec::new();
        let before = self.cost;
        for &symbol in &self.next {
            if let Rewrite::Always(word) = &program.rewrites[usize::from(symbol)] {
                self.cost += word.len() as u64;
                next.extend(rewritten(program, word));
            }
        }
        self.levels.push(core::mem::replace(&mut self.next, set(next)));
        *left = left.saturating_sub(1 + self.cost - before);
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
pub(crate) type Level = Vec<(SymbolId, Piece)>;

/// Makes the piece of a `word` whose rewritten letters have the pieces of the level `below`; at depth 0, where there
/// is none, every letter acts by itself. The turtle enters with `heading`.
pub(crate) fn piece(
    builder: &mut Builder,
    score: &Score,
    below: Option<&Level>,
    word: &[SymbolId],
    heading: Heading,
) -> Piece {
    let lower = |symbol: SymbolId| -> Option<&Piece> {
        let below = below?;
        below.binary_search_by_key(&symbol, |(s, _)| *s).ok().map(|place| &below[place].1)
    };
    let exponent = word.iter().filter_map(|&s| exponent(builder, score, s, lower(s))).max().unwrap_or(0);
    let mut pen = Pen { at: [0.0; 2], heading, style: StyleChange::NONE };
    let (mut saved, mut items) = (Vec::new(), Vec::new());
    for &symbol in word {
        match lower(symbol) {
            None => {
                let scale = libm::scalbn(1.0, score.exponent - exponent);
                let Builder { styles, directions, .. } = builder;
                pen.act(&score.ops[usize::from(symbol)], &mut saved, scale, directions, |from, to, style| {
                    items.push(Item::Stroke(Stroke { from, to, style: styles.id(style) }));
                });
            }
            Some(piece) => {
                if let Some(block) = piece.block {
                    items.push(Item::Block(place(builder, block, &pen, exponent)));
                }
                follow(builder, &mut pen, &piece.effect, exponent);
            }
        }
    }
    // What is left open returns where it began only in the axiom, where nothing follows.
    let block = builder.block(&items, exponent);
    Piece { block, effect: effect(&pen, exponent) }
}

/// The exponent of the longest way in what a letter does; `None` if it goes nowhere.
fn exponent(builder: &Builder, score: &Score, symbol: SymbolId, lower: Option<&Piece>) -> Option<i32> {
    match lower {
        None => {
            let goes = |op: &Op| matches!(op, Op::Draw(_) | Op::Move(_));
            score.ops[usize::from(symbol)].iter().any(goes).then_some(score.exponent)
        }
        Some(Piece { block, effect }) => {
            let block = block.map(|block| builder.blocks[block.0 as usize].exponent);
            block.max((effect.at != [0.0; 2]).then_some(effect.exponent))
        }
    }
}

/// Places `block` where the pen is, in units of `2^exponent` steps.
fn place(builder: &mut Builder, block: BlockId, pen: &Pen, exponent: i32) -> Placed {
    let own = builder.blocks[block.0 as usize].exponent;
    Placed {
        block,
        style: builder.styles.id(&pen.style),
        at: pen.at,
        heading: pen.heading,
        scale: libm::scalbn(1.0, own - exponent),
    }
}

/// Moves the pen as a piece does.
fn follow(builder: &mut Builder, pen: &mut Pen, effect: &Effect, exponent: i32) {
    let (c, s) = builder.directions.cos_sin(pen.heading);
    let [u, v] = effect.at.map(|w| libm::scalbn(w, effect.exponent.saturating_sub(exponent)));
    pen.at = [pen.at[0] + c * u - s * v, pen.at[1] + s * u + c * v];
    pen.heading += effect.heading;
    pen.style = pen.style.then(&effect.style);
}

fn effect(pen: &Pen, exponent: i32) -> Effect {
    let shift = exponent_of(pen.at[0].abs().max(pen.at[1].abs()));
    let at = pen.at.map(|w| libm::scalbn(w, -shift));
    Effect { at, exponent: exponent.saturating_add(shift), heading: pen.heading, style: pen.style }
}
