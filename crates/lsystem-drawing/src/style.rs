//! Changes of the pen's style, and how they compose.

use crate::space::finite;
use lsystem_syntax::{ColourBy, Style};
use std::collections::HashMap;

/// The index of a style change in [`Drawing::styles`](crate::Drawing::styles).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StyleId(pub u32);

/// The change of the style since the entry of a block. Changes compose, so that a block can be shared among styles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StyleChange {
    /// The change of the colour index.
    pub colour: ColourChange,
    /// The change of the stroke width.
    pub width: WidthChange,
    /// The number of branches opened and not closed.
    pub level: u32,
}

/// A change of the colour index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColourChange {
    /// The new index.
    Set(i32),
    /// The number added to the index.
    Add(i32),
}

/// A change of the stroke width: `w -> factor * w + offset`, in multiples of the step length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WidthChange {
    /// The factor of the width.
    pub factor: f64,
    /// The number added after the multiplication.
    pub offset: f64,
}

impl StyleChange {
    /// No change.
    pub const NONE: Self = Self { colour: ColourChange::Add(0), width: WidthChange::NONE, level: 0 };

    /// The style at the start of a drawing: colour index 0, `width`, and level 0 if nothing was before.
    #[must_use]
    pub fn start(width: f64) -> Self {
        Self { colour: ColourChange::Set(0), width: WidthChange { factor: 0.0, offset: width }, level: 0 }
    }

    /// The parts of the colour index and of the branch level that a style shows; 0 for those that it does not.
    #[must_use]
    pub fn seen(&self, style: &Style) -> (i32, u32) {
        let colours = style.palette.len().clamp(1, i32::MAX as usize) as i32;
        let seen = |index: i32| if style.holds() { index.clamp(0, colours - 1) } else { index.rem_euclid(colours) };
        match style.colour_by {
            ColourBy::Single | ColourBy::Path | ColourBy::Density => (0, 0),
            ColourBy::Symbol | ColourBy::Turn | ColourBy::Generation => (seen(self.colour.of(0)), 0),
            ColourBy::Level => (0, seen(i32::try_from(self.level).unwrap_or(i32::MAX)).cast_unsigned()),
        }
    }

    /// This change, followed by `next`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            colour: self.colour.then(next.colour),
            width: self.width.then(next.width),
            level: self.level.saturating_add(next.level),
        }
    }
}

impl ColourChange {
    /// This change, followed by `next`. Indices wrap around at the ends of `i32`.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        match (self, next) {
            (_, Self::Set(index)) => Self::Set(index),
            (Self::Set(index), Self::Add(by)) => Self::Set(index.wrapping_add(by)),
            (Self::Add(index), Self::Add(by)) => Self::Add(index.wrapping_add(by)),
        }
    }

    /// The colour index that this change makes from `index`.
    #[must_use]
    pub fn of(self, index: i32) -> i32 {
        match self {
            Self::Set(index) => index,
            Self::Add(by) => index.wrapping_add(by),
        }
    }
}

impl WidthChange {
    /// No change.
    pub const NONE: Self = Self { factor: 1.0, offset: 0.0 };

    /// This change, followed by `next`, with finite numbers.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        Self { factor: finite(next.factor * self.factor), offset: finite(next.factor * self.offset + next.offset) }
    }

    /// The width that this change makes from `width`.
    #[must_use]
    pub fn of(self, width: f64) -> f64 {
        finite(self.factor * width + self.offset)
    }

    /// A change that makes every width (at least 0) at least as wide as both changes do.
    #[must_use]
    pub fn widest(self, other: Self) -> Self {
        Self { factor: self.factor.max(other.factor), offset: self.offset.max(other.offset) }
    }
}

impl From<ColourChange> for StyleChange {
    fn from(colour: ColourChange) -> Self {
        Self { colour, ..Self::NONE }
    }
}

impl From<WidthChange> for StyleChange {
    fn from(width: WidthChange) -> Self {
        Self { width, ..Self::NONE }
    }
}

/// The distinct styles of a drawing in the making.
#[derive(Clone, Debug)]
pub(crate) struct Styles {
    pub list: Vec<StyleChange>,
    ids: HashMap<(ColourChange, u64, u64, u32), StyleId>,
    /// A cache of recent styles by level and colour: consecutive strokes mostly have the same style.
    recent: [(StyleChange, Option<StyleId>); 32],
}

impl Styles {
    pub(crate) fn new() -> Self {
        Self { list: vec![], ids: HashMap::new(), recent: [(StyleChange::NONE, None); 32] }
    }

    /// The bytes that the styles occupy.
    pub(crate) fn bytes(&self) -> u64 {
        let each = size_of::<(ColourChange, u64, u64, u32)>() + size_of::<StyleId>() + 1;
        // A hash map leaves an eighth of its places free.
        (self.list.capacity() * size_of::<StyleChange>() + self.ids.capacity() / 7 * 8 * each) as u64
    }

    /// The index of a style, which is added if it is new.
    pub(crate) fn id(&mut self, style: &StyleChange) -> StyleId {
        let place =
            style.level.wrapping_add(style.colour.of(0).cast_unsigned().wrapping_mul(8)) as usize % self.recent.len();
        match self.recent[place] {
            (recent, Some(id)) if recent == *style => id,
            _ => {
                let key = (style.colour, style.width.factor.to_bits(), style.width.offset.to_bits(), style.level);
                let next = StyleId(self.list.len() as u32);
                let id = *self.ids.entry(key).or_insert(next);
                if id == next {
                    self.list.push(*style);
                }
                self.recent[place] = (*style, Some(id));
                id
            }
        }
    }
}
