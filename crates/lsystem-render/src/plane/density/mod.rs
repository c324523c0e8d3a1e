//! Pictures in which ink adds up: every stroke adds its ink to the ink already there, and a tone curve shows sums from
//! a single stroke to 10^30 strokes.
//!
//! One layer is the ink that a stroke as wide as a pixel leaves along its axis, at any magnification. The ink of a
//! pixel is the sum over all strokes of the length of their parts there times their width. Each part is shared by the
//! pixels around it ([`sheet`]). A block smaller than a pixel adds all its ink at once, at its centre of gravity
//! ([`deposit`]). Larger blocks are put together from tiles. The order of drawing does not matter.

mod bands;
mod deposit;
mod facts;
mod haze;
mod picture;
mod pigment;
mod sheet;
mod survey;
mod tile;
mod tiling;
mod tone;

#[cfg(test)]
mod tests;

use super::method::Method;
use super::picture::Plan;
use super::{Detail, RenderStats};
use facts::Facts;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use picture::Picture;
pub(super) use tile::TILE_BYTES as DENSITY_TILE_BYTES;
use tone::Tone;

/// Pixels along the side of a sum's place in a coarse picture: a ninth of the sums of a fine picture.
pub(super) const COARSE_SIDE: usize = 3;

/// Makes pictures in which ink adds up ([`Ink::Density`](lsystem_syntax::Ink)).
#[derive(Default)]
pub(super) struct Density {
    facts: Facts,
    picture: Picture,
    tone: Tone,
}

impl Method for Density {
    fn clear(&mut self) {
        self.facts = Facts::default();
        self.picture.clear();
    }

    fn forget(&mut self) {
        self.picture.forget();
    }

    fn begin(&mut self, drawing: &Drawing, plan: &Plan) {
        self.picture.begin(drawing, plan.clone(), 1.0 / side(plan.detail) as f64);
    }

    fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        match self.facts.step(drawing, meter) {
            Progress::Done => self.picture.prepare(drawing, meter),
            progress => progress,
        }
    }

    fn open(&mut self, plan: &Plan, is_blank: bool) -> u64 {
        if is_blank {
            self.picture.blank(plan.pane);
        }
        self.tone.begin(plan, if is_blank { 1 } else { side(plan.detail) })
    }

    fn paint(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        self.picture.step(drawing, &self.facts, meter)
    }

    fn resolve(&mut self, meter: &mut Meter) -> Progress {
        self.tone.step(self.picture.sums(), self.picture.only_pigment(), meter)
    }

    fn pixels(&self) -> &[u8] {
        self.tone.pixels()
    }

    fn stats(&self) -> RenderStats {
        self.picture.stats
    }
}

/// Pixels along the side of a sum's place.
fn side(detail: Detail) -> usize {
    if detail == Detail::Coarse { COARSE_SIDE } else { 1 }
}
