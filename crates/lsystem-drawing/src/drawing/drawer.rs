//! Drawing in resumable steps: with shared blocks if possible, unfolded otherwise.

use super::Drawing;
use super::block::{BlockId, Item, Placed, Space, Stroke};
use super::builder::Builder;
use super::pieces::Pieces;
use super::share::Share;
use super::task::{Made, Outcome, Task};
use super::unfold::Unfold;
use crate::exact_path::Spot;
use crate::space::times;
use crate::{ColourChange, Plane, StyleChange, System, Turtle};
use lsystem_base::{LimitName, Limits, MAX_ITERATIONS, Meter, Progress};
use lsystem_syntax::{Diagnostic, Style};
use std::sync::OnceLock;

/// Draws generation `n` in a space: `draw::<Plane>` or `draw::<Solid>`. In space also a system that does not [leave the
/// plane](System::is_solid) is drawn; [`Figure::draw`](crate::Figure::draw) chooses.
///
/// # Errors
/// [`Kind::Limit`](lsystem_syntax::Kind::Limit): the drawing would exceed [`Limits::segments`], [`Limits::work`],
/// [`Limits::modules`] or [`Limits::memory`], or `n` is above [`MAX_ITERATIONS`].
/// [`Kind::NotFinite`](lsystem_syntax::Kind::NotFinite): a production computes a number that is not finite.
pub fn draw<S: Space>(system: &System, n: u32, limits: &Limits) -> Result<Drawing<S>, Diagnostic> {
    Drawer::new(system, n, *limits).finish()
}

/// A drawing in the making. The drawer borrows nothing, so it can rest between steps. Drop it to cancel the drawing.
#[derive(Clone, Debug)]
pub struct Drawer<S: Space = Plane> {
    task: Task<S>,
    shares: bool,
    builder: Builder<S>,
    /// The number of symbols of the generation, if counted.
    symbols: Option<u64>,
    stage: Stage<S>,
    /// The units of work of all steps so far.
    spent: u64,
}

#[derive(Clone, Debug)]
enum Stage<S: Space> {
    Share(Share<S>),
    Unfold(Unfold<S>),
    /// The search for the extent of the finished blocks.
    Survey {
        survey: Box<S::Survey>,
        root: BlockId,
        pieces: Pieces<S>,
    },
    Done {
        root: Option<BlockId>,
        pieces: Pieces<S>,
        extent: Option<S::Extent>,
    },
    Failed(Diagnostic),
}

impl<S: Space> Drawer<S> {
    /// Prepares to draw generation `n` in a space.
    #[must_use]
    pub fn new(system: &System, n: u32, limits: Limits) -> Self {
        let (rules, turtle, seed) = (system.rules.clone(), system.turtle.clone(), system.seed);
        let score = turtle.score(&rules.drawn());
        let task = Task { rules, turtle, score, seed, n, limits };
        let shares = Share::is_possible(&task);
        let stage = if n > MAX_ITERATIONS {
            Stage::Failed(Diagnostic::limit(LimitName::Iterations, u64::from(MAX_ITERATIONS), Some(MAX_ITERATIONS)))
        } else if shares {
            Share::new(&task).map_or_else(Stage::Failed, Stage::Share)
        } else {
            Unfold::new(&task, None).map_or_else(Stage::Failed, Stage::Unfold)
        };
        let mut builder = Builder::within(limits.memory);
        builder.exact_path.keep(shares && S::LEVEL, task.score.exponent);
        Self { task, shares, builder, symbols: None, stage, spent: 0 }
    }

    /// Continues for about `work` units (100,000 take a few milliseconds). Returns whether there is more to do.
    // Inlined into `draw` as well, the code would be twice in the wasm: a tenth of what the page loads.
    #[inline(never)]
    pub fn step(&mut self, work: u64) -> Progress {
        let mut meter = Meter::new(work);
        let mut progress = Progress::More;
        while progress == Progress::More && !meter.is_spent() {
            self.advance(&mut meter);
            if self.builder.is_full || self.bytes() > self.task.limits.memory {
                self.builder = Builder::new();
                let searches = match &mut self.stage {
                    Stage::Unfold(unfold) => unfold.begin_search(&self.task),
                    _ => false,
                };
                if !searches {
                    self.stage = Stage::Failed(Diagnostic::limit(LimitName::Memory, self.task.limits.memory, None));
                }
            }
            if matches!(self.stage, Stage::Done { .. } | Stage::Failed(_)) {
                progress = Progress::Done;
            }
        }
        self.spent = self.spent.saturating_add(meter.spent());
        progress
    }

    /// The units of work of all steps so far, as [`Meter`] counts them.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// The bytes that the drawing in the making occupies, as [`Limits::memory`] counts them: in space, with the scene
    /// for its pictures.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        let stage = match &self.stage {
            Stage::Share(share) => share.bytes(),
            Stage::Unfold(unfold) => unfold.bytes(),
            Stage::Survey { pieces, .. } | Stage::Done { pieces, .. } => pieces.bytes(),
            Stage::Failed(_) => 0,
        };
        self.builder.bytes() + self.builder.scene.bytes(self.shares) + stage
    }

    /// Runs all steps left and returns the drawing.
    ///
    /// # Errors
    /// As [`draw`].
    pub fn finish(mut self) -> Result<Drawing<S>, Diagnostic> {
        while self.step(1 << 20) == Progress::More {}
        let (root, pieces, extent) = match self.stage {
            Stage::Failed(diagnostic) => return Err(diagnostic),
            Stage::Done { root, pieces, extent } => (root, pieces, extent),
            _ => (None, Pieces::None, None),
        };
        self.builder.shrink();
        let mut drawing = Drawing {
            blocks: self.builder.blocks,
            items: self.builder.items,
            corners: self.builder.corners,
            vertices: self.builder.vertices,
            styles: self.builder.styles.list,
            root,
            start: S::point([self.task.turtle.start[0], self.task.turtle.start[1], 0.0]),
            step: self.task.score.step,
            width: self.task.score.width,
            pieces,
            exact_path: self.builder.exact_path,
            memoised: self.shares,
            places: vec![],
            depths: vec![],
            wires: self.task.turtle.wires.len(),
            symbols: self.symbols,
            scene: self.builder.scene,
            extent: extent.map_or_else(OnceLock::new, |extent| OnceLock::from(Some(extent))),
        };
        drawing.limit_widths(self.task.turtle.max_width);
        Ok(drawing)
    }

    /// Continues in the present stage, or changes to the next.
    // Inlined, the code would be twice in the wasm.
    #[inline(never)]
    fn advance(&mut self, meter: &mut Meter) {
        let Self { task, shares, builder, symbols, stage, .. } = self;
        let outcome = match stage {
            Stage::Share(share) => share.step(task, builder, meter),
            Stage::Unfold(unfold) => unfold.step(task, builder, meter),
            Stage::Survey { survey, root, pieces } => {
                if let Some(extent) = S::advance(survey, builder.contents(), meter) {
                    let pieces = core::mem::replace(pieces, Pieces::None);
                    *stage = Stage::Done { root: Some(*root), pieces, extent: Some(extent) };
                }
                return;
            }
            Stage::Done { .. } | Stage::Failed(_) => return,
        };
        match outcome {
            Outcome::Paused => {}
            Outcome::Ended(made) => {
                *symbols = made.symbols;
                let root = with_wires(made.root, task, builder);
                *stage = complete(Made { root, ..made });
            }
            Outcome::NotShareable(largest) => {
                *shares = false;
                builder.exact_path.keep(false, 0);
                *stage = Unfold::new(task, largest).map_or_else(Stage::Failed, Stage::Unfold);
            }
            Outcome::Failed(diagnostic) => *stage = Stage::Failed(diagnostic),
        }
    }
}

/// The drawing, followed by the wireframes of its shapes.
fn with_wires<S: Space>(root: Option<BlockId>, task: &Task<S>, builder: &mut Builder<S>) -> Option<BlockId> {
    let Turtle { wires, start: [x, y], .. } = &task.turtle;
    if wires.is_empty() {
        return root;
    }
    let look = StyleChange { colour: ColourChange::Set(Style::FAINT), ..StyleChange::start(0.0) };
    let style = builder.styles.id(&look);
    let place = |[a, b, c]: [f64; 3]| times(S::point([a - x, b - y, c]), 1.0 / task.score.step);
    let strokes = wires
        .iter()
        .map(|[from, to]| Item::Stroke(Stroke { from: place(*from), to: place(*to), style, spot: Spot::ENTRY }));
    let wires = builder.block(&strokes.collect::<Vec<_>>(), 0, Spot::ENTRY);
    let unchanged = builder.styles.id(&StyleChange::NONE);
    let whole = [root, wires].into_iter().flatten().map(|block| {
        let scale = libm::scalbn(1.0, builder.blocks[block.0 as usize].exponent);
        Item::Block(Placed { block, style: unchanged, spot: None, at: S::Point::default(), heading: S::AHEAD, scale })
    });
    builder.block(&whole.collect::<Vec<_>>(), 0, Spot::ENTRY)
}

/// The stage after all blocks are made.
fn complete<S: Space>(Made { root, pieces, .. }: Made<S>) -> Stage<S> {
    match root {
        None => Stage::Done { root, pieces, extent: None },
        Some(root) => Stage::Survey { survey: Box::new(S::survey(root)), root, pieces },
    }
}
