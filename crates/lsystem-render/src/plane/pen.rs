//! What the turtle carries on its way through a picture.

use super::inks::{Choice, Shade};
use lsystem_drawing::StyleChange;

/// What the turtle carries apart from its position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    /// Relative to what is painted on the canvas: the whole drawing, or a tile's block.
    pub shade: Shade,
    /// In step lengths.
    pub width: f64,
}

impl Pen {
    pub(super) fn after(self, choice: Choice, change: &StyleChange) -> Self {
        Self { shade: choice.then(self.shade, choice.shade(change)), width: change.width.of(self.width) }
    }
}
