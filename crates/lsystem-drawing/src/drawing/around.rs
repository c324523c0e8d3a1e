//! What lies around one segment, as a drawing of its own: the way to any depth of a drawing 10^301 times as large.
//!
//! Coordinates in `f64` tell a segment from its neighbours only up to 10^16, and sums of two `f64` up to 10^32. But a
//! view shows little at a time: a few blocks of about its size, and how they lie to each other. These places are exact
//! sums of the turtle's [way](crate::exact_path), computed with as many digits as the drawing needs. A drawing of the blocks
//! near a segment, with the segment at the origin, is then an ordinary drawing for all that reads drawings.

mod exact;
mod finder;

use super::Drawing;
use super::block::{BlockId, Item};
use super::origin::Origin;
use exact::Exact;
use finder::Finder;
use lsystem_base::fixed::{Fixed, FixedPoint};
use std::sync::Arc;

/// The neighbourhood of a place near a segment.
#[derive(Clone, Debug)]
pub struct Around {
    /// The items near the place, in the directions of the whole drawing. The place is the origin of the model.
    pub drawing: Arc<Drawing>,
    /// The origin, in units of the whole drawing's root block: x, y, and their rounding remainders.
    pub start: [f64; 4],
    /// The place itself, in units of the whole drawing's root block.
    pub origin: [f64; 2],
    /// By item of the root block: the number of its first segment in the whole drawing.
    pub firsts: Vec<Fixed>,
    /// Indices of items of the root block: strokes that are cut off far away, descending.
    cut: Vec<usize>,
}

impl Around {
    /// The number in the whole drawing of a segment of the neighbourhood (both 0-based); `None` after the last.
    #[must_use]
    pub fn number_of(&self, segment: u128) -> Option<Fixed> {
        let items = self.drawing.items_of(self.drawing.root?);
        let (at, within) = self.drawing.before(items, segment);
        Some(self.firsts.get(at)?.plus(&Fixed::units(within)))
    }

    /// The number of segments of the neighbourhood among the first `upto` of the whole drawing: they come first here, too.
    #[must_use]
    pub fn among_first(&self, upto: u128) -> u128 {
        let (mut all, end) = (0_u128, Fixed::units(upto));
        let items = self.drawing.root.map_or(&[][..], |root| self.drawing.items_of(root));
        for (item, first) in items.iter().zip(&self.firsts) {
            let count = self.drawing.segments_in(item);
            if first.plus(&Fixed::units(count)).compared(&end).is_gt() {
                let within = end.minus(first).decimal().parse().unwrap_or(0);
                return all.saturating_add(if first.compared(&end).is_lt() { within } else { 0 });
            }
            all = all.saturating_add(count);
        }
        all
    }

    /// The number here of a segment of the whole drawing (both 0-based); `None` if it is not here.
    #[must_use]
    pub fn local(&self, number: u128) -> Option<u128> {
        let before = self.among_first(number);
        Some(before).filter(|_| self.among_first(number.saturating_add(1)) > before)
    }

    /// A place in the whole drawing, from a segment of the neighbourhood (0-based) and the part of it before the place;
    /// `None` after the last segment, and on a segment that is cut off.
    #[must_use]
    pub fn origin_on(&self, segment: &Fixed, along: f64) -> Option<Origin> {
        let counts = self.drawing.counts();
        let mut left = segment.clone();
        for (at, item) in self.drawing.items_of(self.drawing.root?).iter().enumerate() {
            let count = count_of(&counts, item);
            if left.compared(&count).is_lt() {
                let origin = Origin { segment: self.firsts[at].plus(&left), along };
                return Some(origin).filter(|_| !self.cut.contains(&at));
            }
            left = left.minus(&count);
        }
        None
    }
}

/// The most places of a drawing that is seen from near: they have a list.
const MAX_LEGS: usize = 1 << 18;

impl Drawing {
    /// The number of segments, exactly.
    #[must_use]
    pub fn exact_count(&self) -> Fixed {
        self.root.map_or_else(Fixed::default, |root| self.counts().swap_remove(root.0 as usize))
    }

    /// The items within `2^reach` steps of a place, and parts that lie farther away. The place is `offset` from the origin,
    /// in units of the root block. `None` if there is no such segment, if the drawing is not a shared one, or if it has too many parts.
    #[must_use]
    pub fn around(&self, origin: &Origin, offset: [f64; 2], reach: i32) -> Option<Around> {
        if !self.exact_path.kept || self.exact_path.legs.len() > MAX_LEGS {
            return None;
        }
        let counts = self.counts();
        let way = self.way(&counts, &origin.segment)?;
        let mut exact = Exact::new(self, &way, reach);
        let centre = exact.centre(&way, origin.along)?;
        let unit = self.exact_path.exponent - self.blocks[self.root?.0 as usize].exponent;
        let places = exact.places[0];
        let [x, y] = centre.numbers(places, unit);
        let rest = centre.minus(&FixedPoint([x, y].map(|c| fixed(c, places, -unit))));
        let [fine_x, fine_y] = rest.numbers(places, unit);
        let mut finder = Finder::new(self, exact, &counts, reach);
        let middle = centre.plus(&FixedPoint(offset.map(|c| fixed(c, places, -unit))));
        let place = middle.numbers(places, unit);
        finder.find(middle)?;
        finder.finish([x, y, fine_x, fine_y], place)
    }

    /// The numbers of segments of all blocks, exactly.
    #[must_use]
    pub fn counts(&self) -> Vec<Fixed> {
        let mut counts: Vec<Fixed> = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let all =
                self.contents(block).iter().fold(Fixed::default(), |sum, item| sum.plus(&count_of(&counts, item)));
            counts.push(all);
        }
        counts
    }

    /// The blocks around a segment, from the root on, with the index of the item that leads to the segment.
    fn way(&self, counts: &[Fixed], segment: &Fixed) -> Option<Vec<(BlockId, usize)>> {
        let (mut block, mut left) = (self.root?, segment.clone());
        let mut way = vec![];
        loop {
            let items = self.items_of(block);
            let at = items.iter().position(|item| {
                let count = count_of(counts, item);
                let inside = left.compared(&count).is_lt();
                if !inside {
                    left = left.minus(&count);
                }
                inside
            })?;
            way.push((block, at));
            match &items[at] {
                Item::Block(placed) => block = placed.block,
                _ => return Some(way),
            }
        }
    }
}

/// A number times `2^exponent`.
fn fixed(number: f64, places: usize, exponent: i32) -> Fixed {
    let (fraction, own) = libm::frexp(number);
    Fixed::of(fraction, places).shifted(own + exponent)
}

/// The number of segments in an item, from those of all blocks.
#[must_use]
pub fn count_of(counts: &[Fixed], item: &Item) -> Fixed {
    match item {
        Item::Stroke(_) => Fixed::units(1),
        Item::Polygon(_) => Fixed::default(),
        Item::Block(placed) => counts[placed.block.0 as usize].clone(),
    }
}
