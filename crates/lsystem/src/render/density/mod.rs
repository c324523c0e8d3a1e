//! Pictures in which ink adds up: every stroke lays down its ink, whatever lies there already, and a tone curve makes
//! sums visible that range from a single stroke to 10^30 of them.
//!
//! One layer of ink is what a stroke as wide as a pixel leaves along its axis, at any magnification. What lies at a
//! pixel is the sum over all strokes of the lengths of their parts there times their widths, each part shared by the
//! pixels around it ([`sheet`]). A block smaller than a pixel adds all its ink at once, at its centre of gravity
//! ([`ink`]); larger ones are put together from tiles. The order of drawing plays no part.

mod haze;
mod ink;
mod pigment;
mod sheet;
mod tile;
mod tone;
mod walk;

#[cfg(test)]
mod tests;

use super::{Detail, PlaneRenderer, RenderStats, View, Viewport};
use crate::{Drawing, Meter, Progress, Style};
use std::sync::Arc;
pub(super) use tile::TILES as DENSITY_TILES;
use walk::{Facts, Walk};

/// Pixels along the side of a sum in a coarse picture.
pub(super) const COARSE: usize = 3;

/// Makes pictures in which ink adds up ([`Ink::Density`](crate::Ink)).
#[derive(Default)]
pub struct DensityRenderer {
    drawing: Option<Arc<Drawing>>,
    facts: Facts,
    walk: Walk,
    /// A picture that has been asked for, until the drawing is ready for it, and the pixels along the side of its sums.
    plan: Option<(Style, Viewport, usize)>,
    tone: tone::Tone,
    spent: u64,
}

impl DensityRenderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    fn go_on(&mut self, meter: &mut Meter) -> Progress {
        if let Some(drawing) = &self.drawing
            && (self.facts.step(drawing, meter) == Progress::More
                || self.walk.prepare(drawing, meter) == Progress::More)
        {
            return Progress::More;
        }
        if meter.is_spent() {
            return Progress::More;
        }
        if let Some((style, viewport, side)) = self.plan.take() {
            if self.drawing.is_none() {
                self.walk.blank(viewport);
            }
            meter.charge(self.tone.begin(&style, viewport, side));
        }
        if let Some(drawing) = &self.drawing
            && self.walk.step(drawing, &self.facts, meter) == Progress::More
        {
            return Progress::More;
        }
        self.tone.step(self.walk.sums(), self.walk.only_pigment(), meter)
    }
}

impl PlaneRenderer for DensityRenderer {
    fn load(&mut self, drawing: Arc<Drawing>) {
        self.facts = Facts::default();
        self.drawing = Some(drawing);
        self.walk.clear();
    }

    fn begin_with(&mut self, style: &Style, viewport: Viewport, view: View, detail: Detail, upto: Option<u128>) {
        let viewport = viewport.within_limits();
        let side = if detail == Detail::Coarse && self.drawing.is_some() { COARSE } else { 1 };
        if let Some(drawing) = &self.drawing {
            self.walk.begin(drawing, style, viewport, view, 1.0 / side as f64, upto);
        }
        self.plan = Some((style.clone(), viewport, side));
    }

    fn step(&mut self, work: usize) -> Progress {
        let mut meter = Meter::new(work as u64);
        let progress = self.go_on(&mut meter);
        self.spent += meter.spent();
        progress
    }

    fn pixels(&self) -> &[u8] {
        self.tone.pixels()
    }

    fn stats(&self) -> RenderStats {
        self.walk.stats
    }

    fn spent(&self) -> u64 {
        self.spent
    }
}
