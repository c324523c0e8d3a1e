//! From a drawing's graph to pixels.
//!
//! # The picture
//!
//! The picture is the same as if every segment were stroked in drawing order. Strokes have round caps and are at least
//! a pixel wide. A pixel has 4x4 subsamples, or one in a coarse picture. Each subsample keeps the colour that is drawn
//! last. Polygons are filled by the non-zero winding rule.
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
//! An opaque picture is made by one of two strategies:
//!
//! - **Top-down** (`top_down`, `descent`): the block drawn last comes first, so that a covered block costs one step. A
//!   block that is straight or at most 2 subsamples large is one stroke. A small block that recurs is stamped from its
//!   tile, which is put together from smaller tiles. Any other block is looked into. Broad strokes in one colour, where
//!   the order of painting is free, are painted in passes from coarse to fine.
//! - **Bottom-up** (`bottom_up`), for crowds, where many blocks overlap and each subsample is covered late: the picture
//!   of each part is composed from the pictures of the parts inside it, on a lattice.
//!
//! `strategy` chooses: every picture is begun top-down, and judged after a probe of fixed work. The panes of a large
//! picture follow the strategy of a survey of the whole picture, so that the panes fit together.
//!
//! The default ink (`blend`) is opaque, and its colours become paler or deeper with the sums of ink where many strokes are
//! finer than a hairline (`fineness`).
//!
//! # Cost
//!
//! A step visits one item: a block, a stroke or a tile. A top-down picture takes at most 1,000,000 steps in full
//! detail. Then the picture is made bottom-up, unless the drawing has more than 20,000 parts or 200,000 items in them,
//! or the pictures of its parts take more than 24 MiB at a time or 400 Mi words in all. Otherwise the picture goes on
//! top-down with outlines of ever larger blocks: their extent doubles every 100,000 steps, so that every picture ends.
//! Tiles take at most 21 MiB.
//!
//! # Exactness
//!
//! - A stroke is exact to the rounding of `f64`, at any magnification.
//! - A tile is off by at most a quarter of a subsample in each direction. The smaller tiles that it is put together
//!   from are, too.
//! - A part of a bottom-up picture is off by at most half a cell of the lattice for each level of parts inside each
//!   other, by a quarter of a cell on average: about 3 % of the drawing in all. A cell is 1, 2 or 4 subsamples wide.
//! - An outline hides the detail of its block.
//!
//! [`RenderStats`] counts parts and outlines, so that the page can inform the reader.

mod alpha;
mod amount;
mod blend;
mod bottom_up;
mod canvas;
mod closeup;
mod density;
mod descent;
mod exact;
mod fineness;
mod inks;
mod opaque;
mod painter;
mod pane;
mod path;
mod pen;
mod pick;
mod picture;
mod pyramid;
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
pub use closeup::{Closeup, MAX_ZOOM, seen_from};
pub(crate) use density::{Grid, Pigment, Print, Sheet, Tone, pigment};
pub(crate) use exact::{fitted_ends, fitted_outline, fitted_polygon};
pub(crate) use inks::{Choice, Shade};
pub use pane::{Pane, Pass};
pub(crate) use pick::pick;
pub use pick::{Near, segment_near};
pub use pyramid::{Pyramid, Share, TilePlace, TileRenderer, Tiles};
pub(crate) use room::TONE_BYTES;
pub(crate) use search::{Aim, Order, Sight, covers, nearest_on, search};
pub use search::{Pick, Pointer, Target};
pub use view::{Detail, View, Viewport, fit};
pub(crate) use view::{PlaneFraming, fitted_scale};

use blend::Blend;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use lsystem_syntax::Style;
use picture::Plan;
use std::sync::Arc;

/// Counts of what a picture took.
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
    /// Blocks of which only the outline was painted, because the picture took too long. Fine detail is left out if
    /// there are any.
    pub outlines: u64,
    /// Pictures of parts in a bottom-up picture. If there are any, strokes are a little off their places: by some
    /// pixels where many parts are inside each other.
    pub parts: u64,
}

impl RenderStats {
    fn plus(self, other: Self) -> Self {
        Self {
            blocks: self.blocks + other.blocks,
            strokes: self.strokes + other.strokes,
            stamps: self.stamps + other.stamps,
            tiles: self.tiles + other.tiles,
            outlines: self.outlines + other.outlines,
            parts: self.parts + other.parts,
        }
    }

    /// Whether some strokes are missing or off their places.
    #[must_use]
    pub fn is_rough(&self) -> bool {
        self.outlines + self.parts > 0
    }
}

/// A smooth step from 0 below the first number to 1 above the second.
fn smooth([from, to]: [f64; 2], at: f64) -> f64 {
    let part = ((at - from) / (to - from)).clamp(0.0, 1.0);
    part * part * (3.0 - 2.0 * part)
}

/// Makes pictures of a drawing in the plane, one after the other, in the same memory.
#[derive(Default)]
pub struct Renderer {
    drawing: Option<Arc<Drawing>>,
    blend: Blend,
    /// Whether the background is left out.
    is_transparent: bool,
    spent: u64,
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
        let mut renderer = Self::default();
        renderer.blend.opaque.picture.is_light = true;
        renderer
    }

    /// The renderer of pictures without the background. Opaque ink has the mean colour of a pixel's covered subsamples,
    /// and their share as its opacity. Ink that adds up has the least opacity with which it looks the same over the
    /// style's background: over another background it looks different. So does the default ink where it shades.
    #[must_use]
    pub fn transparent(self) -> Self {
        Self { is_transparent: true, ..self }
    }

    /// Forgets what pictures have left for later pictures of the same drawing, which are then the same whatever was
    /// drawn before.
    pub fn forget(&mut self) {
        self.blend.forget();
    }

    /// Takes the drawing of the next pictures. The steps of the first picture prepare the drawing.
    pub fn load(&mut self, drawing: Arc<Drawing>) {
        self.blend.clear();
        self.drawing = Some(drawing);
    }

    /// Starts a picture of the loaded drawing. An unfinished picture is given up. A viewport that is too large is cut
    /// to [`Viewport::within_limits`].
    pub fn begin(&mut self, style: &Style, viewport: Viewport, view: View) {
        self.begin_with(style, viewport, view, Detail::Fine, None);
    }

    /// As [`Renderer::begin`], in coarse or in fine `detail`. If `upto` is given, only the first `upto` segments are
    /// shown, for playback.
    pub fn begin_with(&mut self, style: &Style, viewport: Viewport, view: View, detail: Detail, upto: Option<u128>) {
        let (viewport, is_transparent) = (viewport.within_limits(), self.is_transparent);
        let pane = Pane::whole(viewport);
        let pass = Pass::Only;
        self.start(Plan { style: style.clone(), viewport, view, detail, upto, pane, pass, is_transparent });
    }

    /// As [`Renderer::begin_with`] in fine detail, for one of the [panes](Pass::all) of the picture. The pixels are
    /// those of the pane. Panes that begin at multiples of 16 pixels have the same subsamples as the whole picture. The
    /// picture may have [`MAX_PICTURE_SIDE`](lsystem_base::MAX_PICTURE_SIDE) pixels each way, and a pane
    /// [`MAX_PICTURE_PIXELS`](lsystem_base::MAX_PICTURE_PIXELS) in all.
    pub fn begin_pane(
        &mut self,
        style: &Style,
        viewport: Viewport,
        view: View,
        upto: Option<u128>,
        (pane, pass): (Pane, Pass),
    ) {
        let (detail, is_transparent) = (Detail::Fine, self.is_transparent);
        self.start(Plan { style: style.clone(), viewport, view, detail, upto, pane, pass, is_transparent });
    }

    fn start(&mut self, plan: Plan) {
        let viewport = plan.viewport.within_sides();
        let pane = if plan.pass == Pass::Survey { plan.pane } else { plan.pane.within(viewport).within_limits() };
        self.blend.begin(Plan { viewport, pane, ..plan });
    }

    /// Goes on with the picture for about `work` units, as [`Meter`] counts them, and for at most [`Meter::PIECE`]
    /// more.
    pub fn step(&mut self, work: usize) -> Progress {
        let mut meter = Meter::new(work as u64);
        let progress = self.blend.step(self.drawing.as_deref(), &mut meter);
        self.spent += meter.spent();
        progress
    }

    /// The picture so far: RGBA, 8 bits each, opaque unless [`transparent`](Self::transparent), from the upper left
    /// corner row by row. The size is that of the picture once a step has prepared the drawing.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.blend.pixels()
    }

    /// The work and the memory of the picture so far.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.blend.stats()
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }
}
