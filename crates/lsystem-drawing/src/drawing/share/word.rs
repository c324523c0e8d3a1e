//! The making of a plain letter's piece: its successor's letters draw their pieces for one step less.

use crate::drawing::block::Space;
use crate::drawing::builder::Builder;
use crate::drawing::piece::{Level, Piece, effect, exponent, follow, place};
use crate::drawing::tree::{Tree, WORD};
use crate::room::bytes_of;
use crate::style::{ColourChange, StyleChange};
use crate::turtle::{Pen, ScaleTrace, Score, TurtleOp, scaled, work_of};
use lsystem_base::Meter;
use lsystem_derive::LetterId;

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
    /// Whether left and right turns are exchanged at entry.
    pub swapped: bool,
}

impl<'a, S: Space> PieceWord<'a, S> {
    /// The piece of a rewritten letter.
    fn lower(&self, symbol: LetterId, swapped: bool) -> Option<&'a Piece<S>> {
        let below = self.below?;
        below.binary_search_by_key(&(symbol, swapped), |(key, _)| *key).ok().map(|place| &below[place].1)
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
    /// The factor of lengths after the letters measured.
    trace: ScaleTrace,
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
        let PieceWord { score, below, letters, origin, heading, swapped } = *word;
        let growing = origin.former.filter(|_| below.is_none() && score.growth < 1.0);
        Self {
            done: 0,
            trace: ScaleTrace::new(),
            exponent: None,
            weight: 0,
            fully_grown: growing.map(|former| score.continuation(former, letters)),
            pen: Pen { swapped, ..Pen::new(heading, StyleChange::NONE) },
            saved: vec![],
            tree: None,
        }
    }

    /// The bytes that the piece in the making occupies.
    pub(super) fn bytes(&self) -> u64 {
        bytes_of(&self.saved) + self.trace.bytes() + self.tree.as_ref().map_or(0, Tree::bytes)
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
        let mut tree =
            self.tree.take().unwrap_or_else(|| Tree::of_word(exponent, self.weight > WORD, word.score.tapers));
        while let Some(&symbol) = word.letters.get(self.done) {
            if meter.is_spent() || builder.is_full {
                self.tree = Some(tree);
                return None;
            }
            self.draw(builder, word, symbol, &mut tree, exponent);
            meter.charge(2 + work_of(word.ops(symbol)) + builder.take_work());
            self.done += 1;
        }
        let flow = tree.end(builder, word.origin.former.is_none());
        while !meter.is_spent() && !builder.is_full {
            // Only the axiom may leave branches open, and no word follows the axiom.
            let finished = tree.finish_one(builder);
            meter.charge(1 + builder.take_work());
            if let Some(block) = finished {
                return Some(Piece { block, effect: effect(&self.pen, exponent, word.swapped), flow });
            }
        }
        self.tree = Some(tree);
        None
    }

    /// Measures the length and the number of items of a letter.
    fn measure(&mut self, builder: &Builder<S>, word: &PieceWord<'_, S>, symbol: LetterId) {
        let Self { exponent: most, trace, weight, .. } = self;
        let mut reach = |own: Option<i32>, trace: &ScaleTrace| {
            *most = (*most).max(own.map(|own| own.saturating_add(trace.exponent())));
        };
        *weight += 1;
        // With exchanged turns, a piece has the same scale and about the same size.
        if let Some(piece) = word.lower(symbol, false) {
            reach(exponent(builder, piece), trace);
            trace.scale = scaled(trace.scale, piece.effect.scale);
            return;
        }
        for op in word.ops(symbol) {
            reach(op.length().map(|_| word.score.exponent), trace);
            trace.follow(op);
        }
        *weight += work_of(word.ops(symbol)) as usize;
    }

    fn draw(
        &mut self,
        builder: &mut Builder<S>,
        word: &PieceWord<'_, S>,
        symbol: LetterId,
        tree: &mut Tree<S>,
        exponent: i32,
    ) {
        let Self { done, fully_grown, pen, saved, .. } = self;
        let score = word.score;
        if score.colours_by_generation {
            pen.style.colour = word.origin.colour_of(symbol);
        }
        match word.lower(symbol, pen.swapped) {
            None => {
                let scale = libm::scalbn(1.0, score.exponent - exponent);
                let grows = fully_grown.is_some_and(|continuation| continuation != Some(*done));
                let changed: Vec<_>;
                let mut ops = word.ops(symbol);
                if grows || score.has_wind() {
                    changed = ops.iter().map(|&op| score.changed(op, grows, word.origin.step)).collect();
                    ops = &changed;
                }
                tree.draw(builder, *done as u64, |paper, directions| pen.act(ops, saved, scale, directions, paper));
            }
            Some(piece) => {
                let placed = piece.block.map(|block| place(builder, block, pen, exponent, 1.0));
                tree.place(builder, placed, &piece.flow, pen.style.width);
                follow(builder, pen, &piece.effect, exponent, 1.0);
            }
        }
    }
}
