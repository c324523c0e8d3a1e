//! A drawing at the size of a picture, and the look of its parts.

use super::features::Features;
use crate::strokes::StrokeLook;
use lsystem_drawing::{BlockId, ColourChange, Drawing, StyleChange, Widths};
use lsystem_syntax::Style;

/// A drawing with its style and features.
pub(super) struct StyledDrawing<'a> {
    pub(super) drawing: &'a Drawing,
    pub(super) style: &'a Style,
    pub(super) features: &'a Features,
    /// The step length, in pixels.
    pub(super) step: f64,
}

/// The style at the start of a block.
#[derive(Clone, Copy)]
pub(super) struct Entry {
    pub(super) colour: i32,
    pub(super) level: u32,
    pub(super) widths: Widths,
}

impl From<Entry> for StyleChange {
    fn from(Entry { colour, level, widths }: Entry) -> Self {
        Self { colour: ColourChange::Set(colour), level, ..widths.into() }
    }
}

impl StyledDrawing<'_> {
    pub(super) fn look(&self, change: &StyleChange) -> StrokeLook {
        StrokeLook::of(self.style, change, self.step, 1.0)
    }

    /// The visible part of the style at the start of a block.
    pub(super) fn entry(&self, block: BlockId, style: &StyleChange) -> Entry {
        let (colour, level) = style.seen(self.style);
        let widths = style.widths();
        // If all strokes have the least width, the width is not visible.
        let widest = widths.widest(self.drawing.blocks[block.0 as usize].widest) * self.step;
        Entry { colour, level, widths: if widest <= self.style.min_width { Widths::new(0.0) } else { widths } }
    }
}
