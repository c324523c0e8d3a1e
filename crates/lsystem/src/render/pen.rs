//! The style in force at a place of a drawing, and how changes of style add up.

use crate::{ColourBy, ColourChange, Style, StyleChange, WidthChange};

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
            colour: match change.colour {
                ColourChange::Set(index) => index,
                ColourChange::Add(count) => self.colour.wrapping_add(count),
            },
            width: change.width.factor * self.width + change.width.offset,
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

/// No change.
pub(super) const SAME: StyleChange =
    StyleChange { colour: ColourChange::Add(0), width: WidthChange { factor: 1.0, offset: 0.0 }, level: 0 };

/// `first`, then `second`.
pub(super) fn compose(first: &StyleChange, second: &StyleChange) -> StyleChange {
    StyleChange {
        colour: match (first.colour, second.colour) {
            (_, ColourChange::Set(index)) => ColourChange::Set(index),
            (ColourChange::Set(index), ColourChange::Add(count)) => ColourChange::Set(index.wrapping_add(count)),
            (ColourChange::Add(a), ColourChange::Add(b)) => ColourChange::Add(a.wrapping_add(b)),
        },
        width: WidthChange {
            factor: second.width.factor * first.width.factor,
            offset: second.width.factor * first.width.offset + second.width.offset,
        },
        level: first.level.saturating_add(second.level),
    }
}

/// How many colours a picture can need: the palette's, or one.
pub(super) fn colours(style: &Style) -> u32 {
    match style.colour_by {
        ColourBy::Single => 1,
        ColourBy::Symbol | ColourBy::Level => u32::try_from(style.palette.len()).unwrap_or(u32::MAX).max(1),
    }
}
