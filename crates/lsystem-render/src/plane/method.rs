//! What the renderer needs of each way in which ink is laid down.

use super::RenderStats;
use super::picture::Plan;
use lsystem_drawing::Drawing;
use lsystem_syntax::{Meter, Progress};

/// Makes pictures: [`Opaque`](super::opaque::Opaque) where strokes cover each other,
/// [`Density`](super::density::Density) where their ink adds up.
pub(super) trait Method {
    /// Forgets everything about the drawing there was.
    fn clear(&mut self);

    /// Takes what the next picture shows. A picture that was being made is given up.
    fn begin(&mut self, drawing: &Drawing, plan: &Plan);

    /// Finds out what the picture needs to know of the drawing.
    fn prepare(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress;

    /// Makes room for the pixels, which stay blank where there is no drawing; the units of work that this took.
    fn open(&mut self, plan: &Plan, is_blank: bool) -> u64;

    /// Paints.
    fn paint(&mut self, drawing: &Drawing, meter: &mut Meter) -> Progress;

    /// Makes pixels of what has been painted.
    fn resolve(&mut self, meter: &mut Meter) -> Progress;

    /// The pixels.
    fn pixels(&self) -> &[u8];

    /// What the picture has taken.
    fn stats(&self) -> RenderStats;
}
