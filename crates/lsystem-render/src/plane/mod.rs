//! From a drawing's graph to pixels.
//!
//! # The picture
//!
//! The picture is the one that stroking every segment in drawing order would give. Strokes have round caps and are at
//! least a pixel wide. A pixel has 4x4 subsamples, or one in a coarse picture. Each subsample keeps the colour that is
//! drawn last. Polygons are filled by the non-zero winding rule.
//!
//! # Three strategies
//!
//! ```text
//!                         graph of blocks
//!                                |
//!              broad strokes in one colour? --- yes --> passes, coarse to fine
//!                                | no
//!       descent: the block drawn last comes first <-----------+
//!         covered or outside the picture: leave it out        |
//!         straight or at most 2 subsamples: one stroke        |
//!         small: stamp its tile, which is made once           |
//!         anything else: the blocks inside it ----------------+
//!                                |
//!                  too many steps? (`switch`)
//!                                | yes
//!       ascent: the picture of each part once, the smallest part first
//!                                | too many parts
//!       descent again: outlines of ever larger blocks
//! ```
//!
//! - The **descent** (`walk`, `descent`) paints the last block first, so that a covered block costs one step. A small
//!   block that recurs becomes a tile, put together from smaller tiles (`tiling`, `tile`).
//! - The **ascent** (`ascent`, `parts`, `layout`) serves pictures on which very much overlaps, where each subsample is
//!   covered late. It composes the picture of each part from the pictures of the parts inside, on a lattice.
//! - The **passes** (`passes`) serve broad strokes in one colour, where the order of painting is free.
//!
//! `switch` is the one place that chooses between descent and ascent, from counted steps.
//!
//! # Cost
//!
//! A step visits one item: a block, a stroke or a tile. A picture takes at most 1,000,000 steps before the ascent is
//! tried. The ascent refuses more than 20,000 parts, 200,000 items or 400 Mi words. Without an ascent the outlines begin
//! after 2,500,000 steps, and double their extent every 100,000 steps, so that every picture ends. Tiles take at most
//! 23 MiB, and the parts of an ascent 24 MiB.
//!
//! # Exactness
//!
//! - A stroke is exact to the rounding of `f64`, at any magnification.
//! - A tile is off by at most a quarter of a subsample in each direction. The smaller tiles that it is put together from
//!   are, too.
//! - A part of an ascent is off by at most half a cell of the lattice for each level of parts inside each other, and by
//!   at most 3 % of the drawing in all. A cell is 1, 2 or 4 subsamples wide.
//! - An outline hides the detail of its block.
//!
//! [`RenderStats`] counts parts and outlines, so that the page can tell the reader.

mod amount;
mod ascent;
mod bits;
mod canvas;
mod density;
mod descent;
mod exact;
mod inks;
mod layout;
mod mixer;
mod painter;
mod pane;
mod parts;
mod passes;
mod path;
mod pen;
mod pick;
mod polygon;
mod resolve;
mod room;
mod search;
mod seen;
mod shape;
mod stroke;
mod sweep;
mod switch;
mod tile;
mod tiling;
mod view;
mod walk;
mod wide;
mod words;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

pub(crate) use amount::Amount;
pub use density::{DensityRenderer, Pass};
pub use exact::{Fitted, fitted_ends, fitted_outline, fitted_polygon};
pub(crate) use inks::{Choice, Shade};
pub use pane::Pane;
pub use pick::pick;
pub(crate) use search::{Aim, Order, Sight, covers, nearest_on, search};
pub use search::{Pick, Pointer, Target};
pub use view::{Detail, View, Viewport, fit, fitted_scale};

use lsystem_drawing::Drawing;
use lsystem_syntax::{Meter, Progress, Style};
use shape::Shapes;
use std::sync::Arc;
use walk::Walk;

/// What a picture took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RenderStats {
    /// Blocks looked into.
    pub blocks: u64,
    /// Strokes painted one by one.
    pub strokes: u64,
    /// Tiles painted.
    pub stamps: u64,
    /// Tiles made.
    pub tiles: u64,
    /// Blocks of which only the outline was painted, because the picture took too long: where there are any, fine detail
    /// is left out.
    pub outlines: u64,
    /// Pictures of parts that it was put together from, because it took too long to look for each of them: where there
    /// are any, what is drawn is a little off its place, by some pixels where very much is inside each other.
    pub parts: u64,
}

/// Makes pictures of a drawing in the plane, one after the other, in the same memory: [`Renderer`] where strokes cover
/// each other, [`DensityRenderer`] where their ink adds up.
pub trait PlaneRenderer {
    /// Takes the drawing that the next pictures are of. It is made ready for them in the steps of the first.
    fn load(&mut self, drawing: Arc<Drawing>);

    /// Starts a picture of the loaded drawing; a picture that was being made is given up. A viewport that is too large
    /// is cut to [`Viewport::within_limits`].
    fn begin(&mut self, style: &Style, viewport: Viewport, view: View) {
        self.begin_with(style, viewport, view, Detail::Fine, None);
    }

    /// As [`PlaneRenderer::begin`], in coarse or in fine `detail`; of the first `upto` segments only, if that is given:
    /// the turtle on its way.
    fn begin_with(&mut self, style: &Style, viewport: Viewport, view: View, detail: Detail, upto: Option<u128>);

    /// Goes on with the picture for about `work` units, as [`Meter`] counts them: at most [`Meter::PIECE`] more.
    fn step(&mut self, work: usize) -> Progress;

    /// The picture so far, once it has been begun in a step: RGBA, 8 bits each, opaque, from the upper left corner row by row.
    #[must_use]
    fn pixels(&self) -> &[u8];

    /// What the picture took so far.
    #[must_use]
    fn stats(&self) -> RenderStats;

    /// The units of work of all steps so far.
    #[must_use]
    fn spent(&self) -> u64;
}

/// Makes pictures in which strokes cover each other.
#[derive(Default)]
pub struct Renderer {
    drawing: Option<Arc<Drawing>>,
    shapes: Shapes,
    walk: Walk,
    /// A picture that has been asked for, until the drawing is ready for it.
    plan: Option<(Style, Pane, Detail)>,
    output: resolve::Output,
    spent: u64,
}

impl Renderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The same for a program that is to be small: where a picture takes too long, only outlines end it, and what else
    /// could is not compiled in.
    #[must_use]
    pub fn light() -> Self {
        Self {
            drawing: None,
            shapes: Shapes::default(),
            walk: Walk::new(None),
            plan: None,
            output: resolve::Output::default(),
            spent: 0,
        }
    }

    /// As [`PlaneRenderer::begin_with`], but only a pane of the fine picture: the pixels are those of the pane, as they
    /// are in the whole but for rounding. Panes that begin at multiples of 16 pixels have the same subsamples.
    pub fn begin_pane(&mut self, style: &Style, viewport: Viewport, view: View, upto: Option<u128>, pane: Pane) {
        self.start(style, viewport.within_limits(), view, Detail::Fine, upto, pane);
    }

    fn start(&mut self, style: &Style, viewport: Viewport, view: View, detail: Detail, upto: Option<u128>, pane: Pane) {
        let pane = pane.within(viewport);
        if let Some(drawing) = &self.drawing {
            self.walk.begin(drawing, style, viewport, view, detail, upto, pane);
        }
        self.plan = Some((style.clone(), pane, detail));
    }

    fn go_on(&mut self, meter: &mut Meter) -> Progress {
        if let Some(drawing) = &self.drawing
            && (self.shapes.step(drawing, meter) == Progress::More
                || self.walk.prepare(drawing, meter) == Progress::More)
        {
            return Progress::More;
        }
        if meter.is_spent() {
            return Progress::More;
        }
        if let Some((style, pane, detail)) = self.plan.take() {
            meter.charge(self.output.begin(&style, self.walk.inks(), pane, detail));
        }
        if let Some(drawing) = &self.drawing
            && self.walk.step(drawing, &self.shapes.list, meter) == Progress::More
        {
            return Progress::More;
        }
        self.output.step(self.walk.frame(), meter)
    }
}

impl PlaneRenderer for Renderer {
    fn load(&mut self, drawing: Arc<Drawing>) {
        self.shapes.clear();
        self.drawing = Some(drawing);
        self.walk.clear();
    }

    fn begin_with(&mut self, style: &Style, viewport: Viewport, view: View, detail: Detail, upto: Option<u128>) {
        let viewport = viewport.within_limits();
        self.start(style, viewport, view, detail, upto, Pane::whole(viewport));
    }

    fn step(&mut self, work: usize) -> Progress {
        let mut meter = Meter::new(work as u64);
        let progress = self.go_on(&mut meter);
        self.spent += meter.spent();
        progress
    }

    fn pixels(&self) -> &[u8] {
        self.output.pixels()
    }

    fn stats(&self) -> RenderStats {
        self.walk.stats()
    }

    fn spent(&self) -> u64 {
        self.spent
    }
}
