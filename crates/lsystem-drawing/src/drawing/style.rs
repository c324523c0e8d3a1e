//! How style changes compose.

use super::{ColourChange, StyleChange, StyleId, WidthChange};
use crate::turtle::finite;
use std::collections::HashMap;

impl StyleChange {
    /// Nothing has happened.
    pub const NONE: Self = Self { colour: ColourChange::Add(0), width: WidthChange::NONE, level: 0 };

    /// The first palette entry, a width and level 0, whatever was before.
    #[must_use]
    pub fn start(width: f64) -> Self {
        Self { colour: ColourChange::Set(0), width: WidthChange { factor: 0.0, offset: width }, level: 0 }
    }

    /// This change, and `next` after it.
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
    /// This change, and `next` after it. Indices wrap around at the ends of `i32`.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        match (self, next) {
            (_, Self::Set(index)) => Self::Set(index),
            (Self::Set(index), Self::Add(by)) => Self::Set(index.wrapping_add(by)),
            (Self::Add(index), Self::Add(by)) => Self::Add(index.wrapping_add(by)),
        }
    }

    /// The colour index after this change, from `index`.
    #[must_use]
    pub fn of(self, index: i32) -> i32 {
        match self {
            Self::Set(index) => index,
            Self::Add(by) => index.wrapping_add(by),
        }
    }
}

impl WidthChange {
    /// The width stays.
    pub const NONE: Self = Self { factor: 1.0, offset: 0.0 };

    /// This change, and `next` after it. Stays finite.
    #[must_use]
    pub fn then(self, next: Self) -> Self {
        Self { factor: finite(next.factor * self.factor), offset: finite(next.factor * self.offset + next.offset) }
    }

    /// The width after this change, from `width`.
    #[must_use]
    pub fn of(self, width: f64) -> f64 {
        finite(self.factor * width + self.offset)
    }

    /// A change that makes every width at least as wide as both do.
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

/// The styles of a drawing that is being made, each once.
#[derive(Clone, Debug)]
pub(crate) struct Styles {
    pub list: Vec<StyleChange>,
    ids: HashMap<(ColourChange, u64, u64, u32), StyleId>,
    /// The styles asked for last, by level and colour: most are asked for again at once.
    recent: [(StyleChange, Option<StyleId>); 32],
}

impl Styles {
    pub(crate) fn new() -> Self {
        Self { list: vec![], ids: HashMap::new(), recent: [(StyleChange::NONE, None); 32] }
    }

    /// The bytes that they take.
    pub(crate) fn bytes(&self) -> u64 {
        let each = size_of::<(ColourChange, u64, u64, u32)>() + size_of::<StyleId>() + 1;
        // A hash map leaves an eighth of its places free.
        (self.list.capacity() * size_of::<StyleChange>() + self.ids.capacity() / 7 * 8 * each) as u64
    }

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
