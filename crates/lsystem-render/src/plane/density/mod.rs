//! Pictures in which ink adds up: every stroke adds its ink to the ink already there, and a tone curve shows sums from
//! a single stroke to 10^30 strokes.
//!
//! One layer is the ink that a stroke as wide as a pixel leaves along its axis, at any magnification. The ink of a
//! pixel is the sum over all strokes of the length of their parts there times their width. Each part is shared by the
//! pixels around it ([`crate::ink`]). A block smaller than a pixel adds all its ink at once, at its centre of gravity
//! ([`deposit`]). Larger blocks are put together from tiles. The order of drawing does not matter.

mod bands;
mod deposit;
mod facts;
mod haze;
mod picture;
mod pigment;
mod survey;
mod tile;
mod tiling;

#[cfg(test)]
mod tests;

use super::RenderStats;
use super::opaque_picture::Plan;
use super::shape::Shape;
use crate::ink::{Grid, Print, Shading, Tone};
use crate::pane::{Pane, Pass};
use deposit::Deposits;
use facts::Facts;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use lsystem_syntax::ColourBy;
use picture::Picture;
pub(super) use tile::tile_bytes;

/// Makes pictures in which ink adds up ([`Ink::Density`](lsystem_syntax::Ink)).
#[derive(Default)]
pub(super) struct Density {
    deposits: Deposits,
    picture: Picture,
    tone: Tone,
}

impl Density {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        self.deposits = Deposits::default();
        self.picture.clear();
    }

    /// Forgets the tiles of the pictures before.
    pub(super) fn forget(&mut self) {
        self.picture.forget();
    }

    /// Starts a picture. An unfinished picture is given up.
    /// With `shading`, the sums shade an opaque picture: those of the whole picture, so that panes have the same shades.
    pub(super) fn begin(&mut self, drawing: &Drawing, plan: &Plan, shading: Option<Shading>) {
        self.tone.shading = shading;
        let mut plan = plan.clone();
        let grid = grid(&plan);
        if shading.is_some() {
            let whole = Pane::whole(plan.viewport);
            if plan.pass == Pass::Show && plan.pane != whole {
                // The count of the whole picture has left its sums.
                return;
            }
            plan.pane = whole;
            // The opaque picture has the colours.
            plan.style.colour_by = ColourBy::Single;
        }
        self.picture.begin(drawing, plan, grid);
    }

    /// Collects the facts that the picture needs.
    pub(super) fn prepare(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        match self.deposits.step(drawing, shapes, meter) {
            Progress::Done => self.picture.prepare(drawing, meter),
            progress => progress,
        }
    }

    /// Makes room for the pixels. Returns the units of work.
    pub(super) fn open(&mut self, plan: &Plan) -> u64 {
        let print = Print { style: &plan.style, pane: plan.pane, pass: plan.pass, is_transparent: plan.is_transparent };
        self.tone.begin(&print, grid(plan))
    }

    /// Adds up the ink.
    pub(super) fn paint(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        let facts = Facts { shapes, deposits: &self.deposits.list };
        self.picture.step(drawing, facts, meter)
    }

    /// Turns the sums into pixels, or shades those of an opaque picture.
    pub(super) fn resolve(&mut self, below: Option<&mut [u8]>, meter: &mut Meter) -> Progress {
        self.tone.step(self.picture.sums(), self.picture.only_pigment(), below, meter)
    }

    pub(super) fn pixels(&self) -> &[u8] {
        self.tone.pixels()
    }

    pub(super) fn stats(&self) -> RenderStats {
        self.picture.stats
    }
}

fn grid(plan: &Plan) -> Grid {
    Grid::new(plan.style.ink, plan.viewport, plan.detail)
}
