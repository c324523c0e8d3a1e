//! The making of a plain letter's piece: its successor's letters draw their pieces for one step less.

use crate::drawing::block::Space;
use crate::drawing::builder::Builder;
use crate::drawing::piece::{Level, Piece, branch_exponent, effect, exponent, follow, place};
use crate::drawing::tree::{Tree, WORD};
use crate::room::bytes_of;
use crate::style::{ColourChange, StyleChange};
use crate::turtle::{Pen, Score, TurtleOp};
use lsystem_derive::LetterId;
use lsystem_syntax::Meter;

/// The production that makes a word.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Origin {
    /// The predecessor; `None` for the axiom.
    pub former: Option<LetterId>,
    /// The derivation step that makes the word; 0 for the axiom.
    pub step: u32,
}

impl Origin {
    /// The colour by generation of a letter of the word: a letter equal to its predecessor keeps the colour at entry.
    pub(super) fn colour_of(&self, letter: LetterId) -> ColourChange {
        let continues = self.former == Some(letter);
        if continues { ColourChange::Add(0) } else { ColourChange::Set(self.step.cast_signed()) }
    }
}

/// A word, and the pieces of its letters.
#[derive(Clone, Copy)]
pub(super) struct PieceWord<'a, S: Space> {
    pub score: &'a Score<S>,
    /// The pieces of the rewritten letters; `None` at depth 0, where every letter acts by itself.
    pub below: Option<&'a Level<S>>,
    pub letters: &'a [LetterId],
    pub origin: Origin,
    /// The turtle's heading at entry.
    pub heading: S::Turn,
}

impl<'a, S: Space> PieceWord<'a, S> {
    /// The piece of a rewritten letter.
    fn lower(&self, symbol: LetterId) -> Option<&'a Piece<S>> {
        let below = self.below?;
        below.binary_search_by_key(&symbol, |(s, _)| *s).ok().map(|place| &below[place].1)
    }

    fn ops(&self, symbol: LetterId) -> &'a [TurtleOp<S>] {
        &self.score.ops[usize::from(symbol)]
    }
}

/// A piece in the making, letter by letter.
#[derive(Clone, Debug)]
pub(super) struct LetterPieceWriting<S: Space> {
    /// The number of letters done: letters are measured while `tree` is `None`, then drawn.
    done: usize,
    /// The number of open branches after the letters measured.
    level: i32,
    /// The exponent of the piece's longest length so far.
    exponent: Option<i32>,
    /// An upper bound on the number of items.
    weight: usize,
    /// In the last step, under growth: the index of the one letter that is fully grown, if any; all other letters still
    /// grow. `None` if no letter grows.
    fully_grown: Option<Option<usize>>,
    pen: Pen<S>,
    saved: Vec<Pen<S>>,
    tree: Option<Tree<S>>,
}

impl<S: Space> LetterPieceWriting<S> {
    pub(super) fn new(word: &PieceWord<'_, S>) -> Self {
        let PieceWord { score, below, letters, origin, heading } = *word;
        let growing = origin.former.filter(|_| below.is_none() && score.growth < 1.0);
        Self {
            done: 0,
            level: 0,
            exponent: None,
            weight: 0,
            fully_grown: growing.map(|former| score.continuation(former, letters)),
            pen: Pen::new(heading, StyleChange::NONE),
            saved: vec![],
            tree: None,
        }
    }

    /// The bytes that the piece in the making occupies.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.saved) + self.tree.as_ref().map_or(0, Tree::bytes)
    }

    /// Continues until the meter is spent. Returns the finished piece.
    pub(super) fn step(
        &mut self,
        builder: &mut Builder<S>,
        word: &PieceWord<'_, S>,
        meter: &mut Meter,
    ) -> Option<Piece<S>> {
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
            // Only the axiom may leave branches open, and no word follows the axiom.
            let finished = tree.finish_one(builder);
            meter.charge(1 + builder.take_work());
            if let Some(block) = finished {
                return Some(Piece { block, effect: effect(&self.pen, exponent) });
            }
        }
        self.tree = Some(tree);
        None
    }

    /// Measures the length and the number of items of a letter.
    fn measure(&mut self, builder: &Builder<S>, word: &PieceWord<'_, S>, symbol: LetterId) {
        let score = word.score;
        let below = word.lower(symbol);
        let own = match below {
            None => score.goes(symbol).then_some(score.exponent),
            Some(piece) => exponent(builder, piece),
        };
        self.exponent = self.exponent.max(own.map(|own| own.saturating_add(branch_exponent(score, self.level))));
        self.weight += 1;
        if below.is_none() {
            self.weight += word.ops(symbol).len();
            let depths = word.ops(symbol).iter().map(|op| match op {
                TurtleOp::Push(_) => 1,
                TurtleOp::Pop => -1,
                _ => 0,
            });
            self.level = self.level.saturating_add(depths.sum::<i32>()).max(0);
        }
    }

    fn draw(
        &mut self,
        builder: &mut Builder<S>,
        word: &PieceWord<'_, S>,
        symbol: LetterId,
        (tree, exponent): (&mut Tree<S>, i32),
    ) {
        let Self { done, fully_grown, pen, saved, .. } = self;
        let score = word.score;
        if score.colours_by_generation {
            pen.style.colour = word.origin.colour_of(symbol);
        }
        match word.lower(symbol) {
            None => {
                let scale = libm::scalbn(1.0, score.exponent - exponent);
                let grown;
                let ops = match fully_grown {
                    Some(continuation) if *continuation != Some(*done) => {
                        grown = word.ops(symbol).iter().map(|&op| score.growing(op)).collect::<Vec<_>>();
                        grown.as_slice()
                    }
                    _ => word.ops(symbol),
                };
                tree.draw(builder, *done as u64, |paper, directions| pen.act(ops, saved, scale, directions, paper));
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
