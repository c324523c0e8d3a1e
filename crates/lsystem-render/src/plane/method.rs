//! The steps that the renderer asks of each kind of ink.

use super::RenderStats;
use super::picture::Plan;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;

/// Makes pictures: [`Opaque`](super::opaque::Opaque) where strokes cover each other,
/// [`Density`](super::density::Density) where their ink adds up.
pub(super) trait Method {
    /// Forgets the drawing.
    fn clear(&mut self);

    /// Forgets what pictures have left for later pictures.
    fn forget(&mut self);

    /// Starts a picture. An unfinished picture is given up.
    fn begin(&mut self, drawing: &Drawing, plan: &Plan);

    /// Collects the facts about the drawing's blocks that the picture needs.
    fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress;

    /// Makes room for the pixels. They stay blank if there is no drawing. Returns the units of work.
    fn open(&mut self, plan: &Plan, is_blank: bool) -> u64;

    /// Paints the drawing.
    fn paint(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress;

    /// Turns the painting into pixels.
    fn resolve(&mut self, meter: &mut Meter) -> Progress;

    /// The pixels: RGBA, 8 bits each, from the upper left corner row by row.
    fn pixels(&self) -> &[u8];

    /// The work and the memory of the picture so far.
    fn stats(&self) -> RenderStats;
}
