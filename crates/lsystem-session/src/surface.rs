//! The boundary's part: a clock, and a canvas that takes pixels.

use lsystem::Viewport;
use lsystem::render::Pane;

/// A monotonic clock, in milliseconds. With a clock that stands still, a step ends only when there is a picture or nothing
/// is left to do.
pub type Clock = Box<dyn Fn() -> f64>;

/// A canvas.
pub trait Screen {
    /// The reason why the canvas refuses pixels.
    type Error;

    /// Shows a pane of a picture of `viewport`'s size: opaque RGBA pixels, 8 bits each, row by row from the pane's upper
    /// left corner.
    ///
    /// # Errors
    /// If the canvas refuses the pixels. The session stays usable.
    fn put(&mut self, pixels: &[u8], viewport: Viewport, pane: Pane) -> Result<(), Self::Error>;

    /// Shows a whole picture.
    ///
    /// # Errors
    /// As [`Screen::put`].
    fn show(&mut self, pixels: &[u8], viewport: Viewport) -> Result<(), Self::Error> {
        self.put(pixels, viewport, Pane::whole(viewport))
    }
}
