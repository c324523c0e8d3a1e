//! Blocks in the making: every block gets its exponent, hull, count and widest stroke here.

use super::style::Styles;
use super::{Block, BlockId, Item, Placed, Stroke, StyleChange, StyleId, WidthChange};
use crate::Plane;
use crate::space::{Space, times};

/// The growing vectors of a [`Drawing`](super::Drawing).
#[derive(Clone, Debug)]
pub struct Builder<S: Space = Plane> {
    pub(crate) blocks: Vec<Block<S>>,
    pub(crate) items: Vec<Item<S>>,
    pub(crate) corners: Vec<S::Point>,
    /// Of polygons; each polygon has its own.
    pub(crate) vertices: Vec<S::Point>,
    pub(crate) styles: Styles,
    pub(crate) directions: S::Directions,
    /// Where a hull's points are collected.
    pub(crate) points: Vec<S::Point>,
}

/// What contains some items.
#[derive(Clone, Debug)]
pub struct Enclosed<S: Space> {
    /// In units that are `2^shift` times those of the items, so that the farthest coordinate is within 1.
    pub hull: S::Hull,
    /// As in [`Block::slack`].
    pub slack: f64,
    /// The exponent that is added to the items'.
    pub shift: i32,
}

impl<S: Space> Builder<S> {
    pub(crate) fn new() -> Self {
        Self {
            blocks: vec![],
            items: vec![],
            corners: vec![],
            vertices: vec![],
            styles: Styles::new(),
            directions: S::directions(),
            points: vec![],
        }
    }

    /// Makes a block of `items`, whose coordinates are in units of `2^exponent` steps; `None` without items.
    /// A block that would hold nothing but another one as it is, is that other one.
    pub(crate) fn block(&mut self, items: &[Item<S>], exponent: i32) -> Option<BlockId> {
        match *items {
            [] => return None,
            [Item::Block(only)] if only.is_plain(self, exponent) => return Some(only.block),
            _ => {}
        }
        let (mut segments, mut polygons) = (0_u128, 0_u128);
        let mut widest = WidthChange { factor: 0.0, offset: 0.0 };
        for item in items {
            match item {
                Item::Stroke(stroke) => {
                    segments = segments.saturating_add(1);
                    widest = widest.widest(self.width(stroke.style));
                }
                Item::Polygon(_) => polygons = polygons.saturating_add(1),
                Item::Block(placed) => {
                    let block = &self.blocks[placed.block.0 as usize];
                    segments = segments.saturating_add(block.segments);
                    polygons = polygons.saturating_add(block.polygons);
                    widest = widest.widest(self.width(placed.style).then(block.widest));
                }
            }
        }
        let Enclosed { hull, slack, shift } = S::enclose(self, items);
        let unit = libm::scalbn(1.0, -shift);
        let first = self.items.len() as u32;
        self.items.extend(items.iter().map(|item| item.scaled(unit)));
        for item in items {
            if let Item::Polygon(polygon) = item {
                self.vertices[polygon.range()].iter_mut().for_each(|vertex| *vertex = times(*vertex, unit));
            }
        }
        self.blocks.push(Block {
            items: first..self.items.len() as u32,
            exponent: exponent.saturating_add(shift),
            segments,
            polygons,
            hull,
            slack,
            widest,
        });
        Some(BlockId(self.blocks.len() as u32 - 1))
    }

    fn width(&self, style: StyleId) -> WidthChange {
        self.styles.list[style.0 as usize].width
    }
}

impl<S: Space> Placed<S> {
    /// Whether it is placed where the containing block, in units of `2^exponent` steps, begins, with nothing changed.
    fn is_plain(&self, builder: &Builder<S>, exponent: i32) -> bool {
        let same = libm::scalbn(1.0, builder.blocks[self.block.0 as usize].exponent.saturating_sub(exponent));
        let style = &builder.styles.list[self.style.0 as usize];
        self.scale == same && self.at == S::Point::default() && self.heading == S::AHEAD && *style == StyleChange::NONE
    }
}

impl<S: Space> Item<S> {
    /// The same with coordinates times `unit`.
    fn scaled(&self, unit: f64) -> Self {
        match *self {
            Self::Stroke(stroke) => {
                Self::Stroke(Stroke { from: times(stroke.from, unit), to: times(stroke.to, unit), ..stroke })
            }
            // Its vertices are elsewhere.
            Self::Polygon(polygon) => Self::Polygon(polygon),
            Self::Block(placed) => {
                Self::Block(Placed { at: times(placed.at, unit), scale: placed.scale * unit, ..placed })
            }
        }
    }
}
