//! A drawing at the size of a picture, and the look of its parts.

use super::features::Features;
use crate::strokes::StrokeLook;
use lsystem_drawing::{BlockId, ColourChange, Drawing, StyleChange, WidthChange};
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
    pub(super) width: f64,
}

impl From<Entry> for StyleChange {
    fn from(Entry { colour, level, width }: Entry) -> Self {
        Self { colour: ColourChange::Set(colour), width: WidthChange { factor: 0.0, offset: width }, level }
    }
}

impl StyledDrawing<'_> {
    pub(super) fn look(&self, change: &StyleChange) -> StrokeLook {
        StrokeLook::of(self.style, change, self.step, 1.0)
    }

    /// The visible part of the style at the start of a block.
    pub(super) fn entry(&self, block: BlockId, style: &StyleChange) -> Entry {
        let (colour, level) = style.seen(self.style);
        let width = style.width.of(0.0);
        // If all strokes have the least width, the width is not visible.
        let widest = self.drawing.blocks[block.0 as usize].widest.of(width) * self.step;
        Entry { colour, level, width: if widest <= self.style.min_width { 0.0 } else { width } }
    }
}
