//! The turtle's colour and width inside a picture.

use crate::ink::{Choice, Shade};
use lsystem_drawing::{StyleChange, Widths};

/// The turtle's state apart from its position.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pen {
    /// The shade relative to the entry of the block that the canvas shows: the root, or a tile's block.
    pub shade: Shade,
    pub widths: Widths,
}

impl Pen {
    /// The pen after a change of style.
    pub(super) fn after(self, choice: Choice, change: &StyleChange) -> Self {
        Self { shade: choice.then(self.shade, choice.shade(change)), widths: self.widths.after(change) }
    }

    /// The pen without a taper.
    pub(super) fn even(self) -> Self {
        Self { widths: self.widths.even(), ..self }
    }
}
