//! From a drawing's graph to pixels.
//!
//! # The picture
//!
//! The picture is the one that stroking every segment in drawing order would give. Strokes have round caps and are at
//! least a pixel wide. A pixel has 4x4 subsamples, or one in a coarse picture. Each subsample keeps the colour that is
//! drawn last. Polygons are filled by the non-zero winding rule.
//!
//! # The way of a picture
//!
//! ```text
//!                graph of blocks
//!                       |
//!            opaque ink | ink that adds up
//!          +------------+------------+
//!       `opaque`                 `density`
//!          |                         |
//!      `strategy`                 survey
//!       /       \                    |
//!   top-down  bottom-up          sums of ink
//!       \       /                    |
//!      subsamples                  tone curve
//!          +------------+------------+
//!                       |
//!                    pixels
//! ```
//!
//! Opaque pictures are made by one of two strategies:
//!
//! - **Top-down** (`top_down`, `descent`): the block drawn last comes first, so that a covered block costs one step. A
//!   block that is straight or at most 2 subsamples large is one stroke. A small block that recurs is stamped from its
//!   tile, which is put together from smaller tiles. Any other block is looked into. Broad strokes in one colour, where
//!   the order of painting is free, are painted in passes from coarse to fine.
//! - **Bottom-up** (`bottom_up`), for crowds, on which very much overlaps and each subsample is covered late: the picture
//!   of each part is composed from the pictures of the parts inside it, on a lattice.
//!
//! `strategy` is the one place that chooses: every picture is begun top-down, and judged after a probe of fixed work. The
//! panes of a large picture are made as a survey of the whole picture has chosen, so that they fit together.
//!
//! # Cost
//!
//! A step visits one item: a block, a stroke or a tile. A top-down picture takes at most 1,000,000 steps in full detail.
//! Then it is made bottom-up, unless the drawing has more than 20,000 parts or 200,000 items in them, or the pictures of
//! its parts take more than 400 Mi words. What cannot be made bottom-up either is painted as outlines of ever larger
//! blocks: their extent doubles every 100,000 steps, so that every picture ends. Tiles take at most 21 MiB, the parts of a
//! bottom-up picture 24 MiB.
//!
//! # Exactness
//!
//! - A stroke is exact to the rounding of `f64`, at any magnification.
//! - A tile is off by at most a quarter of a subsample in each direction. The smaller tiles that it is put together from
//!   are, too.
//! - A part of a bottom-up picture is off by at most half a cell of the lattice for each level of parts inside each other,
//!   and by at most 3 % of the drawing in all. A cell is 1, 2 or 4 subsamples wide.
//! - An outline hides the detail of its block.
//!
//! [`RenderStats`] counts parts and outlines, so that the page can tell the reader.

mod amount;
mod bottom_up;
mod canvas;
mod density;
mod descent;
mod exact;
mod inks;
mod method;
mod mixer;
mod opaque;
mod painter;
mod pane;
mod path;
mod pen;
mod pick;
mod picture;
mod room;
mod search;
mod seen;
mod shape;
mod strategy;
mod sweep;
mod top_down;
mod view;
mod wide;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod tests;

pub(crate) use amount::Amount;
pub use exact::{Fitted, fitted_ends, fitted_outline, fitted_polygon};
pub(crate) use inks::{Choice, Shade};
pub use pane::{Pane, Pass};
pub use pick::pick;
pub(crate) use search::{Aim, Order, Sight, covers, nearest_on, search};
pub use search::{Pick, Pointer, Target};
pub use view::{Detail, View, Viewport, fit, fitted_scale};

use density::Density;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Ink, Meter, Progress, Style};
use method::Method;
use opaque::Opaque;
use picture::Plan;
use std::sync::Arc;

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

impl RenderStats {
    /// Whether not every line is in its place.
    #[must_use]
    pub fn is_rough(&self) -> bool {
        self.outlines + self.parts > 0
    }
}

/// Makes pictures of a drawing in the plane, one after the other, in the same memory.
#[derive(Default)]
pub struct Renderer {
    drawing: Option<Arc<Drawing>>,
    maker: Maker,
    /// A picture that has been asked for, until the drawing is ready for it.
    plan: Option<Plan>,
    /// Whether pictures are never made bottom-up.
    is_light: bool,
    spent: u64,
}

/// The method of the picture's ink.
enum Maker {
    Opaque(Box<Opaque>),
    Density(Box<Density>),
}

impl Default for Maker {
    fn default() -> Self {
        Self::Opaque(Box::default())
    }
}

impl Maker {
    fn is_of(&self, ink: Ink) -> bool {
        matches!((self, ink), (Self::Opaque(_), Ink::Solid) | (Self::Density(_), Ink::Density))
    }

    fn get(&self) -> &dyn Method {
        match self {
            Self::Opaque(opaque) => &**opaque,
            Self::Density(density) => &**density,
        }
    }

    fn get_mut(&mut self) -> &mut dyn Method {
        match self {
            Self::Opaque(opaque) => &mut **opaque,
            Self::Density(density) => &mut **density,
        }
    }
}

impl Renderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A renderer for small pictures, without the memory that bottom-up pictures take.
    #[must_use]
    pub fn light() -> Self {
        Self { is_light: true, ..Self::default() }
    }

    /// Takes the drawing that the next pictures are of. It is made ready for them in the steps of the first.
    pub fn load(&mut self, drawing: Arc<Drawing>) {
        self.maker.get_mut().clear();
        self.drawing = Some(drawing);
    }

    /// Starts a picture of the loaded drawing; a picture that was being made is given up. A viewport that is too large
    /// is cut to [`Viewport::within_limits`].
    pub fn begin(&mut self, style: &Style, viewport: Viewport, view: View) {
        self.begin_with(style, viewport, view, Detail::Fine, None);
    }

    /// As [`Renderer::begin`], in coarse or in fine `detail`; of the first `upto` segments only, if that is given: the
    /// turtle on its way.
    pub fn begin_with(&mut self, style: &Style, viewport: Viewport, view: View, detail: Detail, upto: Option<u128>) {
        let pane = Pane::whole(viewport);
        self.start(Plan { style: style.clone(), viewport, view, detail, upto, pane, pass: Pass::Only });
    }

    /// As [`Renderer::begin_with`], but only one of the [panes](Pass::all) of the fine picture. The pixels are those of
    /// the pane. Panes that begin at multiples of 16 pixels have the same subsamples as the whole.
    pub fn begin_pane(
        &mut self,
        style: &Style,
        viewport: Viewport,
        view: View,
        upto: Option<u128>,
        (pane, pass): (Pane, Pass),
    ) {
        self.start(Plan { style: style.clone(), viewport, view, detail: Detail::Fine, upto, pane, pass });
    }

    fn start(&mut self, plan: Plan) {
        let viewport = plan.viewport.within_limits();
        let plan = Plan { viewport, pane: plan.pane.within(viewport), ..plan };
        if !self.maker.is_of(plan.style.ink) {
            self.maker = match plan.style.ink {
                Ink::Solid => Maker::default(),
                Ink::Density => Maker::Density(Box::default()),
            };
        }
        if let Maker::Opaque(opaque) = &mut self.maker {
            opaque.picture.is_light = self.is_light;
        }
        if let Some(drawing) = &self.drawing {
            self.maker.get_mut().begin(drawing, &plan);
        }
        self.plan = Some(plan);
    }

    /// Goes on with the picture for about `work` units, as [`Meter`] counts them: at most [`Meter::PIECE`] more.
    pub fn step(&mut self, work: usize) -> Progress {
        let mut meter = Meter::new(work as u64);
        let progress = self.go_on(&mut meter);
        self.spent += meter.spent();
        progress
    }

    fn go_on(&mut self, meter: &mut Meter) -> Progress {
        let method = self.maker.get_mut();
        if let Some(drawing) = &self.drawing
            && method.prepare(drawing, meter) == Progress::More
        {
            return Progress::More;
        }
        if meter.is_spent() {
            return Progress::More;
        }
        if let Some(plan) = self.plan.take() {
            meter.charge(method.open(&plan, self.drawing.is_none()));
        }
        if let Some(drawing) = &self.drawing
            && method.paint(drawing, meter) == Progress::More
        {
            return Progress::More;
        }
        method.resolve(meter)
    }

    /// The picture so far, once it has been begun in a step: RGBA, 8 bits each, opaque, from the upper left corner row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.maker.get().pixels()
    }

    /// What the picture took so far.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.maker.get().stats()
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }
}
