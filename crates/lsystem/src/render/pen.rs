//! The style in force at a place of a drawing, and how changes of style add up.

use crate::{ColourBy, Style, StyleChange};

/// What the turtle carries apart from its position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pen {
    /// The colour index, not yet wrapped to a palette.
    pub colour: i32,
    /// In step lengths.
    pub width: f64,
    pub level: u32,
}

impl Pen {
    pub(super) fn after(self, change: &StyleChange) -> Self {
        Self {
            colour: change.colour.of(self.colour),
            width: change.width.of(self.width),
            level: self.level.saturating_add(change.level),
        }
    }

    /// The palette entry it draws with; the palette has `colours` entries.
    pub(super) fn ink(self, colours: u32, by: ColourBy) -> u32 {
        let colours = colours.max(1);
        match by {
            ColourBy::Single => 0,
            ColourBy::Symbol => i64::from(self.colour).rem_euclid(i64::from(colours)) as u32,
            ColourBy::Level => self.level % colours,
        }
    }
}

/// How many colours a picture can need: the palette's, or one.
pub(super) fn colours(style: &Style) -> u32 {
    match style.colour_by {
        ColourBy::Single => 1,
        ColourBy::Symbol | ColourBy::Level => u32::try_from(style.palette.len()).unwrap_or(u32::MAX).max(1),
    }
}
