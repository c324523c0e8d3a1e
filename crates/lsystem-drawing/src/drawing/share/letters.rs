//! Sharing the pieces of plain letters: one for each letter and number of steps, made from the last step back.

use super::plan::LetterPlan;
use super::word::{LetterPieceWriting, Origin, PieceWord};
use crate::drawing::block::Space;
use crate::drawing::builder::Builder;
use crate::drawing::piece::{Level, variants};
use crate::drawing::pieces::Pieces;
use crate::drawing::task::{Made, Outcome, Task};
use crate::room::bytes_of;
use crate::turtle::{Score, TurtleOp};
use lsystem_base::Meter;
use lsystem_derive::{LetterId, Rewrite, Rules};
use lsystem_syntax::Diagnostic;

/// Whether every reachable letter always draws the same piece. The system must have:
/// - no random choice and no variation;
/// - no operation that depends on directions of the model;
/// - balanced branches in every rewritten letter and every successor;
/// - every polygon within one successor.
pub(super) fn memoises<S: Space>(rules: &Rules, score: &Score<S>) -> bool {
    let uses_model = |op: &TurtleOp<S>| matches!(op, TurtleOp::Bend(_)) || matches!(op, TurtleOp::Upright) && !S::LEVEL;
    let is_kept = |s: LetterId| matches!(rules.rewrites[usize::from(s)], Rewrite::Keep);
    let ops = |s: LetterId| score.ops[usize::from(s)].as_slice();
    let filled = |word: &[LetterId]| is_filled_at_once(word.iter().map(|&s| is_kept(s).then(|| ops(s))));
    !score.varies()
        && !score.has_tubes()
        && !score.ops.iter().flatten().any(uses_model)
        && filled(&rules.axiom.letters)
        && (rules.rewrites.iter().zip(rules.reachable()).enumerate()).all(|(symbol, (rewrite, reached))| {
            let balanced = |word: &[LetterId]| {
                let kept = word.iter().filter(|&&s| is_kept(s));
                is_balanced(kept.flat_map(|&s| ops(s))) && filled(word)
            };
            match rewrite {
                _ if !reached => true,
                Rewrite::Keep => true,
                Rewrite::Always(word) => {
                    let alone = score.ops[symbol].as_slice();
                    balanced(word) && is_balanced(alone) && is_filled_at_once([Some(alone)])
                }
                Rewrite::Choose(_) => false,
            }
        })
}

/// Whether operations close exactly the branches that they open.
pub(super) fn is_balanced<'a, S: Space>(ops: impl IntoIterator<Item = &'a TurtleOp<S>>) -> bool {
    let mut level = 0_i64;
    let never_below = ops.into_iter().all(|op| {
        match op {
            TurtleOp::Push(_) => level += 1,
            TurtleOp::Pop => level -= 1,
            _ => {}
        }
        level >= 0
    });
    never_below && level == 0
}

/// Whether every polygon of a word is complete within the word, with no rewritten letter inside. Each letter is given
/// by its operations, or by `None` if it is rewritten.
pub(super) fn is_filled_at_once<'a, S: Space>(word: impl IntoIterator<Item = Option<&'a [TurtleOp<S>]>>) -> bool {
    let mut open = 0_i64;
    let fits = word.into_iter().all(|ops| {
        for op in ops.into_iter().flatten() {
            match op {
                TurtleOp::OpenPolygon => open += 1,
                TurtleOp::ClosePolygon => open -= 1,
                _ => {}
            }
        }
        open == 0 || (open > 0 && ops.is_some())
    });
    fits && open == 0
}

/// A drawing in the making.
#[derive(Clone, Debug)]
pub(crate) enum LetterSharing<S: Space> {
    /// Find the letters that each depth needs.
    Plan(LetterPlan),
    /// Make the pieces of one depth after the other.
    Build(Build<S>),
}

/// Pieces in the making.
#[derive(Clone, Debug)]
pub(crate) struct Build<S: Space> {
    /// By depth from 1: the letters that need pieces.
    needed: Vec<Vec<LetterId>>,
    /// The pieces made so far, by depth; the last level may be incomplete.
    pieces: Vec<Level<S>>,
    /// The next piece, in the making.
    writing: Option<Box<LetterPieceWriting<S>>>,
    /// The bytes of complete levels.
    held: u64,
}

impl<S: Space> LetterSharing<S> {
    pub(super) fn new(rules: &Rules) -> Self {
        Self::Plan(LetterPlan::new(rules))
    }

    /// The bytes that the pieces occupy.
    pub(super) fn bytes(&self) -> u64 {
        match self {
            Self::Plan(_) => 0,
            Self::Build(build) => build.held + build.writing.as_ref().map_or(0, |writing| writing.bytes()),
        }
    }

    /// Continues until the meter is spent or a stage is over.
    pub(super) fn step(&mut self, task: &Task<S>, builder: &mut Builder<S>, meter: &mut Meter) -> Outcome<Made<S>> {
        match self {
            Self::Plan(plan) => {
                let Some(depths) = plan.depths() else {
                    plan.step(&task.rules, meter);
                    return Outcome::Paused;
                };
                let (most, limit) = task.most_letters();
                if plan.cost.saturating_mul(variants(&task.score) as u64) > most {
                    let largest = depths.checked_sub(1);
                    return Outcome::Failed(Diagnostic::limit(limit, task.limits.value(limit), largest));
                }
                if depths < task.n {
                    plan.step(&task.rules, meter);
                } else {
                    let build = Build { needed: plan.levels(), pieces: vec![], writing: None, held: 0 };
                    *self = Self::Build(build);
                }
                Outcome::Paused
            }
            Self::Build(build) => build.step(task, builder, meter),
        }
    }
}

impl<S: Space> Build<S> {
    fn step(&mut self, task: &Task<S>, builder: &mut Builder<S>, meter: &mut Meter) -> Outcome<Made<S>> {
        let Self { needed, pieces, writing, held } = self;
        let Task { rules, turtle, score, n, .. } = task;
        let depth = pieces.len().saturating_sub(1);
        let variants = variants(score);
        let done = pieces.last().map_or(0, Vec::len);
        let mut write = |word: PieceWord<'_, S>| {
            let piece =
                writing.get_or_insert_with(|| Box::new(LetterPieceWriting::new(&word))).step(builder, &word, meter)?;
            *writing = None;
            meter.charge(8);
            Some(piece)
        };
        match needed.get(depth).and_then(|letters| letters.get(done / variants)) {
            Some(&symbol) => {
                let letters = rules.rewrites[usize::from(symbol)].always().unwrap_or_default();
                let below = depth.checked_sub(1).map(|below| &pieces[below]);
                let origin = Origin { former: Some(symbol), step: n.saturating_sub(depth as u32) };
                let swapped = done % variants == 1;
                let word = PieceWord { score, below, letters, origin, heading: S::AHEAD, swapped };
                let Some(piece) = write(word) else {
                    return Outcome::Paused;
                };
                if pieces.is_empty() {
                    pieces.push(vec![]);
                }
                pieces[depth].push(((symbol, swapped), piece));
            }
            None if pieces.len() < needed.len() => {
                *held += pieces.last().map_or(0, bytes_of);
                pieces.push(vec![]);
                meter.charge(8);
            }
            None => {
                let (letters, origin) = (rules.axiom.letters.as_slice(), Origin { former: None, step: 0 });
                let (heading, _) = turtle.start::<S>();
                let word = PieceWord { score, below: pieces.last(), letters, origin, heading, swapped: false };
                if let Some(root) = write(word) {
                    return Outcome::Ended(Made {
                        root: root.block,
                        pieces: Pieces::Letters(core::mem::take(pieces)),
                        symbols: None,
                    });
                }
            }
        }
        Outcome::Paused
    }
}
