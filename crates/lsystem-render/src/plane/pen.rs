//! The turtle's colour and width inside a picture.

use super::inks::{Choice, Shade};
use lsystem_drawing::StyleChange;

/// The turtle's state apart from its position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    /// The shade relative to the entry of the block that the canvas shows: the root, or a tile's block.
    pub shade: Shade,
    /// The stroke width in step lengths.
    pub width: f64,
}

impl Pen {
    /// The pen after a change of style.
    pub(super) fn after(self, choice: Choice, change: &StyleChange) -> Self {
        Self { shade: choice.then(self.shade, choice.shade(change)), width: change.width.of(self.width) }
    }
}
