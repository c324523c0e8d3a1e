//! Opaque ink.

use super::RenderStats;
use super::canvas::resolve::Output;
use super::method::Method;
use super::picture::{Picture, Plan};
use super::shape::Shapes;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;

/// Makes pictures in which strokes cover each other ([`Ink::Solid`](lsystem_syntax::Ink)).
#[derive(Default)]
pub(super) struct Opaque {
    shapes: Shapes,
    pub picture: Picture,
    output: Output,
}

impl Method for Opaque {
    fn clear(&mut self) {
        self.shapes.clear();
        self.picture.clear();
    }

    fn forget(&mut self) {
        self.picture.top_down.tiling.clear();
    }

    fn begin(&mut self, drawing: &Drawing, plan: &Plan) {
        self.picture.begin(drawing, plan.clone());
    }

    fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        match self.shapes.step(drawing, meter) {
            Progress::Done => self.picture.prepare(drawing, &self.shapes.list, meter),
            progress => progress,
        }
    }

    fn open(&mut self, plan: &Plan, _: bool) -> u64 {
        self.output.begin(plan, self.picture.inks())
    }

    fn paint(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress {
        self.picture.step(drawing, &self.shapes.list, meter)
    }

    fn resolve(&mut self, meter: &mut Meter) -> Progress {
        self.output.step(self.picture.frame(), meter)
    }

    fn pixels(&self) -> &[u8] {
        self.output.pixels()
    }

    fn stats(&self) -> RenderStats {
        self.picture.stats()
    }
}
