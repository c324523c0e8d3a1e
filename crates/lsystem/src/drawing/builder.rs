//! Blocks in the making: every block gets its exponent, hull, count and widest stroke here.

use super::hull::hull;
use super::style::Styles;
use super::{Block, BlockId, Item, Placed, StyleId, WidthChange};
use crate::turtle::{Directions, exponent_of};

/// The growing vectors of a [`Drawing`](super::Drawing).
#[derive(Clone, Debug)]
pub(crate) struct Builder {
    pub(crate) blocks: Vec<Block>,
    pub(crate) items: Vec<Item>,
    pub(crate) corners: Vec<[f64; 2]>,
    pub(crate) styles: Styles,
    pub(crate) directions: Directions,
    points: Vec<[f64; 2]>,
}

impl Builder {
    pub(crate) fn new() -> Self {
        Self {
            blocks: vec![],
            items: vec![],
            corners: vec![],
            styles: Styles::new(),
            directions: Directions::new(),
            points: vec![],
        }
    }

    /// Makes a block of `items`, whose coordinates are in units of `2^exponent` steps; `None` without items.
    /// A block that would hold nothing but another one as it is, is that other one.
    pub(crate) fn block(&mut self, items: &[Item], exponent: i32) -> Option<BlockId> {
        match *items {
            [] => return None,
            [Item::Block(only)] if only.is_plain(self) => return Some(only.block),
            _ => {}
        }
        self.points.clear();
        let (mut segments, mut widest, mut slack) = (0_u128, WidthChange { factor: 0.0, offset: 0.0 }, 0.0_f64);
        for item in items {
            match item {
                Item::Stroke(stroke) => {
                    // Most strokes begin where the one before ended.
                    if self.points.last() != Some(&stroke.from) {
                        self.points.push(stroke.from);
                    }
                    self.points.push(stroke.to);
                    segments = segments.saturating_add(1);
                    widest = widest.widest(self.width(stroke.style));
                }
                Item::Block(placed) => {
                    let block = &self.blocks[placed.block.0 as usize];
                    let (c, s) = self.directions.cos_sin(placed.heading);
                    let (c, s, [x, y]) = (c * placed.scale, s * placed.scale, placed.at);
                    let corners = &self.corners[block.hull.start as usize..block.hull.end as usize];
                    self.points.extend(corners.iter().map(|&[u, v]| [x + c * u - s * v, y + s * u + c * v]));
                    segments = segments.saturating_add(block.segments);
                    slack = slack.max(placed.scale * block.slack);
                    widest = widest.widest(self.width(placed.style).then(block.widest));
                }
            }
        }
        let reach = self.points.iter().flatten().fold(0.0_f64, |reach, c| reach.max(c.abs()));
        let shift = exponent_of(reach);
        let unit = libm::scalbn(1.0, -shift);
        for c in self.points.iter_mut().flatten() {
            *c *= unit;
        }
        let slack = slack * unit + hull(&mut self.points);

        let first = self.items.len() as u32;
        self.items.extend(items.iter().map(|item| item.scaled(unit)));
        let corner = self.corners.len() as u32;
        self.corners.extend(&self.points);
        self.blocks.push(Block {
            items: first..self.items.len() as u32,
            exponent: exponent.saturating_add(shift),
            segments,
            hull: corner..self.corners.len() as u32,
            slack,
            widest,
        });
        Some(BlockId(self.blocks.len() as u32 - 1))
    }

    fn width(&self, style: StyleId) -> WidthChange {
        self.styles.list[style.0 as usize].width
    }
}

impl Placed {
    /// Whether it is placed where the containing block begins, with nothing changed.
    fn is_plain(&self, builder: &Builder) -> bool {
        let style = &builder.styles.list[self.style.0 as usize];
        self.at == [0.0; 2] && self.heading == crate::Heading::EAST && *style == super::StyleChange::NONE
    }
}

impl Item {
    /// The same with coordinates times `unit`.
    fn scaled(&self, unit: f64) -> Self {
        let times = |[x, y]: [f64; 2]| [x * unit, y * unit];
        match *self {
            Self::Stroke(stroke) => {
                Self::Stroke(super::Stroke { from: times(stroke.from), to: times(stroke.to), ..stroke })
            }
            Self::Block(placed) => Self::Block(Placed { at: times(placed.at), scale: placed.scale * unit, ..placed }),
        }
    }
}
