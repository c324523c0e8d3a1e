//! The making of blocks: exponent, hull, counts and widest stroke.
use crate::Plane;
use crate::chunks::Chunks;
use crate::drawing::block::{Block, BlockId, Contents, Enclosed, HullInput, Item, Placed, Space, Stroke};
use crate::drawing::scene::SceneSize;
use crate::exact_path::{ExactPath, Spot};
use crate::room::{bytes_for, bytes_of, reserve};
use crate::space::times;
use crate::style::{StyleChange, Styles, WidthChange};

/// The growing vectors of a [`Drawing`](super::Drawing).
#[derive(Clone, Debug)]
pub(crate) struct Builder<S: Space = Plane> {
    pub blocks: Vec<Block<S>>,
    pub items: Chunks<Item<S>>,
    pub corners: Vec<S::Point>,
    /// The vertices of polygons; polygons share none.
    pub vertices: Vec<S::Point>,
    pub(crate) styles: Styles,
    pub(crate) exact_path: ExactPath<S>,
    pub directions: S::Directions,
    /// A reusable buffer for a hull's points.
    pub points: Vec<S::Point>,
    /// The size of the scene for pictures in space.
    pub scene: SceneSize,
    /// Units of work since the last call of [`Builder::take_work`].
    work: u64,
    /// The most bytes that the builder may occupy.
    memory: u64,
    /// Whether a block was left out for lack of memory.
    pub is_full: bool,
}

impl<S: Space> Builder<S> {
    pub(crate) fn new() -> Self {
        Self::within(u64::MAX)
    }

    /// A builder that occupies at most `memory` bytes.
    pub(crate) fn within(memory: u64) -> Self {
        Self {
            scene: SceneSize::default(),
            work: 0,
            memory,
            is_full: false,
            blocks: vec![],
            items: Chunks::new(),
            corners: vec![],
            vertices: vec![],
            styles: Styles::new(),
            exact_path: ExactPath::new(),
            directions: S::directions(),
            points: vec![],
        }
    }

    pub(crate) fn contents(&self) -> Contents<'_, S> {
        Contents { blocks: &self.blocks, items: &self.items, corners: &self.corners, vertices: &self.vertices }
    }

    /// The units of work since the last call.
    pub(crate) fn take_work(&mut self) -> u64 {
        core::mem::take(&mut self.work)
    }

    /// The bytes that the builder occupies.
    pub(crate) fn bytes(&self) -> u64 {
        bytes_of(&self.blocks)
            + self.items.bytes()
            + bytes_of(&self.corners)
            + bytes_of(&self.vertices)
            + bytes_of(&self.points)
            + self.styles.bytes()
            + self.exact_path.bytes()
    }

    /// Frees the unused capacity of the lists.
    pub(crate) fn shrink(&mut self) {
        self.blocks.shrink_to_fit();
        self.items.shrink();
        self.corners.shrink_to_fit();
        self.vertices.shrink_to_fit();
        self.exact_path.legs.shrink_to_fit();
    }

    /// Makes room for a block with this many items. Returns false, and the builder is full, if memory does not suffice.
    /// While a list grows, the old and the new list count.
    fn has_room(&mut self, items: usize) -> bool {
        let more = bytes_for(&self.blocks, 1)
            + self.items.bytes_for(items)
            + bytes_for(&self.corners, 64)
            + self.exact_path.bytes_for(items);
        self.is_full |= more > 0 && self.bytes() + more > self.memory;
        if !self.is_full {
            reserve(&mut self.blocks, 1);
            reserve(&mut self.corners, 64);
        }
        !self.is_full
    }

    /// Makes a block of `items`, whose coordinates are in units of `2^exponent` steps from `origin`. If the only item is an unchanged
    /// block, returns that block. `None` without items, or if memory does not suffice; the builder is then full.
    pub(crate) fn block(&mut self, items: &[Item<S>], exponent: i32, origin: Spot) -> Option<BlockId> {
        match *items {
            [] => None,
            [Item::Block(only)] if only.is_plain(self, exponent) => Some(only.block),
            _ => self.new_block(items, exponent, origin),
        }
    }

    /// As [`Builder::block`], but always makes a block of its own. There is at least one item.
    pub(crate) fn new_block(&mut self, items: &[Item<S>], exponent: i32, origin: Spot) -> Option<BlockId> {
        if !self.has_room(items.len()) {
            return None;
        }
        let (mut segments, mut polygons) = (0_u128, 0_u128);
        let mut widest = WidthChange { factor: 0.0, offset: 0.0 };
        for item in items {
            match item {
                Item::Stroke(stroke) => {
                    segments = segments.saturating_add(1);
                    let StyleChange { width, next, .. } = self.styles.list[stroke.style.0 as usize];
                    widest = next.into_iter().fold(widest.widest(width), WidthChange::widest);
                }
                Item::Polygon(_) => polygons = polygons.saturating_add(1),
                Item::Block(placed) => {
                    let block = &self.blocks[placed.block.0 as usize];
                    segments = segments.saturating_add(block.segments);
                    polygons = polygons.saturating_add(block.polygons);
                    let StyleChange { width, next, .. } = self.styles.list[placed.style.0 as usize];
                    widest = next.into_iter().fold(widest.widest(width.then(block.widest)), WidthChange::widest);
                }
            }
        }
        let Self { blocks, items: made, vertices, corners, directions, points, .. } = self;
        let input = HullInput { blocks, items: made, vertices, corners, directions, points };
        let Enclosed { hull, slack, shift, work } = S::enclose(input, items);
        self.work += work + 2 * (1 + items.len() as u64);
        let unit = libm::scalbn(1.0, -shift);
        let numbers = self.items.push(items.iter().map(|item| item.scaled(unit)));
        for item in items {
            if let Item::Polygon(polygon) = item {
                self.vertices[polygon.range()].iter_mut().for_each(|vertex| *vertex = times(*vertex, unit));
            }
        }
        S::measure(&mut self.scene, items);
        self.blocks.push(Block {
            items: numbers,
            exponent: exponent.saturating_add(shift),
            origin,
            segments,
            polygons,
            hull,
            slack,
            widest,
        });
        Some(BlockId(self.blocks.len() as u32 - 1))
    }
}

impl<S: Space> Placed<S> {
    /// Whether the block is placed unchanged at the origin of a container in units of `2^exponent` steps.
    fn is_plain(&self, builder: &Builder<S>, exponent: i32) -> bool {
        let same = libm::scalbn(1.0, builder.blocks[self.block.0 as usize].exponent.saturating_sub(exponent));
        let style = &builder.styles.list[self.style.0 as usize];
        self.scale == same
            && self.spot.is_none_or(|spot| spot == Spot::ENTRY)
            && self.at == S::Point::default()
            && self.heading == S::AHEAD
            && *style == StyleChange::NONE
    }
}

impl<S: Space> Item<S> {
    /// The item with coordinates times `unit`.
    fn scaled(&self, unit: f64) -> Self {
        match *self {
            Self::Stroke(stroke) => {
                Self::Stroke(Stroke { from: times(stroke.from, unit), to: times(stroke.to, unit), ..stroke })
            }
            // [`Builder::block`] scales the vertices.
            Self::Polygon(polygon) => Self::Polygon(polygon),
            Self::Block(placed) => {
                Self::Block(Placed { at: times(placed.at, unit), scale: placed.scale * unit, ..placed })
            }
        }
    }
}
