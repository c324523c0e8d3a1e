//! Pictures in which ink adds up: every stroke lays down its ink, whatever lies there already, and a tone curve makes
//! sums visible that range from a single stroke to 10^30 of them.
//!
//! One layer of ink is what a stroke as wide as a pixel leaves along its axis, at any magnification. What lies at a
//! pixel is the sum over all strokes of the lengths of their parts there times their widths, each part shared by the
//! pixels around it ([`sheet`]). A block smaller than a pixel adds all its ink at once, at its centre of gravity
//! ([`ink`]); larger ones are put together from tiles. The order of drawing plays no part.

mod bands;
mod facts;
mod haze;
mod ink;
mod look;
mod pigment;
mod sheet;
mod tile;
mod tone;
mod walk;

#[cfg(test)]
mod tests;

use super::{Detail, Pane, PlaneRenderer, RenderStats, View, Viewport};
use facts::Facts;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Meter, Progress, Style};
use std::sync::Arc;
pub(super) use tile::TILES as DENSITY_TILES;
use walk::Walk;

/// Pixels along the side of a sum in a coarse picture.
pub(super) const COARSE: usize = 3;

/// What is done with a pane. A picture that is too large to be made at once is looked at as a whole without its pixels,
/// then every pane of it is counted, then every pane is shown: the tone depends on all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pass {
    /// It is the only one: all is done for it.
    #[default]
    Only,
    /// Of the whole picture, how much there is to see, and how closely it can be looked at.
    Survey,
    /// How much ink lies at how many of its pixels.
    Count,
    /// Its pixels.
    Show,
}

impl Pass {
    /// All that is done for a picture in panes of this size, in order.
    #[must_use]
    pub fn all(viewport: Viewport, size: [u32; 2]) -> Vec<(Pane, Self)> {
        let panes = Pane::all(viewport, size);
        if panes.len() < 2 {
            return panes.into_iter().map(|pane| (pane, Self::Only)).collect();
        }
        let each = |pass| panes.iter().map(move |&pane| (pane, pass));
        [(Pane::whole(viewport), Self::Survey)].into_iter().chain(each(Self::Count)).chain(each(Self::Show)).collect()
    }

    /// Whether there are pixels after it.
    #[must_use]
    pub fn shows(self) -> bool {
        matches!(self, Self::Only | Self::Show)
    }
}

/// Makes pictures in which ink adds up ([`Ink::Density`](lsystem_syntax::Ink)).
#[derive(Default)]
pub struct DensityRenderer {
    drawing: Option<Arc<Drawing>>,
    facts: Facts,
    walk: Walk,
    /// A picture that has been asked for, until the drawing is ready for it, and the pixels along the side of its sums.
    plan: Option<(Style, Pane, Pass, usize)>,
    tone: tone::Tone,
    spent: u64,
}

impl DensityRenderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// As [`PlaneRenderer::begin_with`], but only a pane of the fine picture, of which first the whole is surveyed, then
    /// all panes are counted, then all are shown. Of those that are shown there are pixels.
    pub fn begin_pane(
        &mut self,
        style: &Style,
        viewport: Viewport,
        view: View,
        upto: Option<u128>,
        pane: Pane,
        pass: Pass,
    ) {
        self.start(style, (viewport.within_limits(), view), 1, upto, (pane, pass));
    }

    fn start(
        &mut self,
        style: &Style,
        sight: (Viewport, View),
        side: usize,
        upto: Option<u128>,
        (pane, pass): (Pane, Pass),
    ) {
        let pane = pane.within(sight.0);
        if let Some(drawing) = &self.drawing {
            self.walk.begin(drawing, style, sight, 1.0 / side as f64, upto, (pane, pass));
        }
        self.plan = Some((style.clone(), pane, pass, side));
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
        if let Some((style, pane, pass, side)) = self.plan.take() {
            if self.drawing.is_none() {
                self.walk.blank(pane);
            }
            meter.charge(self.tone.begin(&style, pane, side, pass));
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
        self.start(style, (viewport, view), side, upto, (Pane::whole(viewport), Pass::Only));
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
