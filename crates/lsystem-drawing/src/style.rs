//! What happens to the pen's style, and how such changes compose.

use crate::space::finite;
use std::collections::HashMap;

/// Which of a drawing's style changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StyleId(pub u32);

/// What has happened to the style since a block's entry. Changes compose, which is why styled drawings memoise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StyleChange {
    /// What has happened to the colour index.
    pub colour: ColourChange,
    /// What has happened to the width.
    pub width: WidthChange,
    /// How many branches deeper.
    pub level: u32,
}

/// A change of the colour index.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColourChange {
    /// Becomes this.
    Set(i32),
    /// Goes up by this.
    Add(i32),
}

/// A change of the stroke width: `w -> factor * w + offset`, in multiples of the step length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WidthChange {
    /// What the width is multiplied by.
    pub factor: f64,
    /// What is added then.
    pub offset: f64,
}

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
