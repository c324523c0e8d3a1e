//! Changes of the pen's style, and how they compose.

use crate::space::finite;
use lsystem_syntax::{ColourSource, Style};
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
    /// The width, as a change from the same entry, with which the branch goes on after the last stroke: the stroke tapers
    /// to it. `None`: as where the block is placed, or the stroke's own width if the block is placed nowhere.
    pub next: Option<WidthChange>,
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
    pub const NONE: Self = Self { colour: ColourChange::Add(0), width: WidthChange::NONE, level: 0, next: None };

    /// The style at the start of a drawing: colour index 0, `width`, and level 0 if nothing was before.
    #[must_use]
    pub fn start(width: f64) -> Self {
        Self { colour: ColourChange::Set(0), width: WidthChange { factor: 0.0, offset: width }, ..Self::NONE }
    }

    /// The widths of a style that began with [`StyleChange::start`].
    #[must_use]
    pub fn widths(&self) -> Widths {
        Widths::new(0.0).after(self)
    }

    /// The parts of the colour index and of the branch level that a style shows; 0 for those that it does not.
    #[must_use]
    pub fn seen(&self, style: &Style) -> (i32, u32) {
        let colours = style.palette.len().clamp(1, i32::MAX as usize) as i32;
        let seen = |index: i32| if style.holds() { index.clamp(0, colours - 1) } else { index.rem_euclid(colours) };
        match style.colour_by.source() {
            _ if style.is_faint(self.colour.of(0)) => (Style::FAINT, 0),
            ColourSource::Constant | ColourSource::Along | ColourSource::Ink => (0, 0),
            ColourSource::Index => (seen(self.colour.of(0)), 0),
            ColourSource::Level => (0, seen(i32::try_from(self.level).unwrap_or(i32::MAX)).cast_unsigned()),
        }
    }

    /// Whether a stroke in the style `next` goes on evenly from the end of one in this style: both look alike, and this
    /// one does not taper.
    #[must_use]
    pub fn goes_on(&self, next: &Self) -> bool {
        // Without tapers no stroke has a `next`.
        let is_even = self.next == Some(self.width) || self.next.is_none() && next.next.is_none();
        is_even && Self { next: None, ..*self } == (Self { next: None, ..*next })
    }

    /// This change, followed by `next`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self {
            colour: self.colour.then(next.colour),
            width: self.width.then(next.width),
            level: self.level.saturating_add(next.level),
            next: next.next.map(|next| self.width.then(next)).or(self.next),
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

    /// The change that is the part `t` of the way, from 0 to 1, from this one to `end`.
    #[must_use]
    pub fn between(self, end: Self, t: f64) -> Self {
        let mix = |from: f64, to: f64| finite(from * (1.0 - t) + to * t);
        if self == end {
            return self;
        }
        Self { factor: mix(self.factor, end.factor), offset: mix(self.offset, end.offset) }
    }

    /// A change that makes every width (at least 0) at least as wide as both changes do.
    #[must_use]
    pub fn widest(self, other: Self) -> Self {
        Self { factor: self.factor.max(other.factor), offset: self.offset.max(other.offset) }
    }
}

/// The stroke width at a block's entry, and the width with which the branch goes on after the block's last stroke.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widths {
    /// The width at entry, in step lengths.
    pub own: f64,
    /// The width after the last stroke, in step lengths; `None` if that stroke does not taper.
    pub next: Option<f64>,
}

impl Widths {
    /// The widths at the entry of a whole drawing.
    #[must_use]
    pub fn new(own: f64) -> Self {
        Self { own, next: None }
    }

    /// The widths after a change of style.
    #[must_use]
    pub fn after(self, change: &StyleChange) -> Self {
        Self { own: change.width.of(self.own), next: change.next.map(|next| next.of(self.own)).or(self.next) }
    }

    /// The widths at the two ends of a stroke.
    #[must_use]
    pub fn ends(self) -> [f64; 2] {
        [self.own, self.next.unwrap_or(self.own)]
    }

    /// The widths without a taper.
    #[must_use]
    pub fn even(self) -> Self {
        Self { next: None, ..self }
    }

    /// The most width of strokes inside a block with this bound.
    #[must_use]
    pub fn widest(self, bound: WidthChange) -> f64 {
        bound.of(self.own).max(self.next.unwrap_or(0.0))
    }

    /// Numbers that are equal for equal widths.
    #[must_use]
    pub fn key(self) -> [u64; 2] {
        [self.own.to_bits(), self.next.map_or(u64::MAX, f64::to_bits)]
    }
}

impl From<Widths> for StyleChange {
    /// The change that makes these widths from any others.
    fn from(Widths { own, next }: Widths) -> Self {
        let set = |offset: f64| WidthChange { factor: 0.0, offset };
        Self { width: set(own), next: next.map(set), ..Self::NONE }
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

/// The members of a style as bits.
type StyleKey = (ColourChange, [u64; 2], u32, Option<[u64; 2]>);

/// The distinct styles of a drawing in the making.
#[derive(Clone, Debug)]
pub(crate) struct Styles {
    pub list: Vec<StyleChange>,
    ids: HashMap<StyleKey, StyleId>,
    /// A cache of recent styles by level and colour: consecutive strokes mostly have the same style.
    recent: [(StyleChange, Option<StyleId>); 32],
}

impl Styles {
    pub(crate) fn new() -> Self {
        Self { list: vec![], ids: HashMap::new(), recent: [(StyleChange::NONE, None); 32] }
    }

    /// The bytes that the styles occupy.
    pub(crate) fn bytes(&self) -> u64 {
        let each = size_of::<StyleKey>() + size_of::<StyleId>() + 1;
        // A hash map leaves an eighth of its places free.
        (self.list.capacity() * size_of::<StyleChange>() + self.ids.capacity() / 7 * 8 * each) as u64
    }

    /// The index of a style, which is added if it is new.
    pub(crate) fn id(&mut self, style: &StyleChange) -> StyleId {
        let colour = style.colour.of(0).cast_unsigned().wrapping_mul(8);
        let tapers = u32::from(style.next.is_some()) * 16;
        let place = style.level.wrapping_add(colour).wrapping_add(tapers) as usize % self.recent.len();
        match self.recent[place] {
            (recent, Some(id)) if recent == *style => id,
            _ => {
                let bits = |width: WidthChange| [width.factor.to_bits(), width.offset.to_bits()];
                let key = (style.colour, bits(style.width), style.level, style.next.map(bits));
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
