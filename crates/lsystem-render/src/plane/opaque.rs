//! Opaque ink.

use super::RenderStats;
use super::canvas::resolve::Output;
use super::opaque_picture::{Picture, Plan};
use super::shape::Shape;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;

/// Makes pictures in which strokes cover each other ([`Ink::Solid`](lsystem_syntax::Ink)).
#[derive(Default)]
pub(super) struct Opaque {
    pub picture: Picture,
    output: Output,
}

impl Opaque {
    /// Forgets the drawing.
    pub(super) fn clear(&mut self) {
        self.picture.clear();
    }

    /// Frees the memory of pictures.
    pub(super) fn free(&mut self) {
        let mut picture = Picture::default();
        (picture.opening, picture.is_light) = (self.picture.opening, self.picture.is_light);
        *self = Self { picture, output: Output::default() };
    }

    /// Forgets what pictures have left for later pictures.
    pub(super) fn forget(&mut self) {
        self.picture.top_down.tiling.clear();
    }

    /// Starts a picture. An unfinished picture is given up.
    pub(super) fn begin(&mut self, drawing: &Drawing, plan: &Plan) {
        self.picture.begin(drawing, plan.clone());
    }

    /// Collects the facts that the picture needs.
    pub(super) fn prepare(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        self.picture.prepare(drawing, shapes, meter)
    }

    /// Makes room for the pixels. Returns the units of work.
    pub(super) fn open(&mut self, plan: &Plan) -> u64 {
        self.output.begin(plan, &self.picture.inks())
    }

    /// Paints the drawing.
    pub(super) fn paint(&mut self, drawing: &Drawing, shapes: &[Shape], meter: &mut Meter) -> Progress {
        self.picture.step(drawing, shapes, meter)
    }

    /// Turns the painting into pixels.
    pub(super) fn resolve(&mut self, meter: &mut Meter) -> Progress {
        self.output.step(self.picture.frame(), meter)
    }

    pub(super) fn pixels(&self) -> &[u8] {
        self.output.pixels()
    }

    pub(super) fn pixels_mut(&mut self) -> &mut [u8] {
        self.output.pixels_mut()
    }

    pub(super) fn stats(&self) -> RenderStats {
        self.picture.stats()
    }
}
