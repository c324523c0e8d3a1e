//! A drawing is a small graph of placed blocks, not a long list of segments.
//!
//! After n derivation steps a string is exponentially long but made of few distinct pieces: symbol `s` derived for
//! `d` more steps is always the same piece, a [`Block`]. Blocks hold strokes and placed smaller blocks, in drawing
//! order: such drawings are [shared](share). Systems whose pieces are not all alike (stochastic or unbalanced
//! productions) are [unfolded](unfold) into a tree of blocks of the same type, so every reader sees one shape of data.

mod block;
mod body;
mod builder;
mod bulk;
mod drawer;
mod extent;
mod girth;
mod hull;
mod marks;
mod piece;
mod pieces;
mod projection;
mod scene;
mod segments;
mod shape;
mod share;
mod sheet;
mod solid;
mod task;
mod tree;
mod unfold;

pub use block::{Block, BlockId, Item, Placed, Polygon, Space, Stroke};
pub use bulk::SegmentArrays;
pub use drawer::{Drawer, draw};
pub use hull::hull;
pub use marks::Mark;
pub use marks::MarkReader;
pub(crate) use piece::Piece;
pub(crate) use pieces::{Pieces, StateWord, StateWords};
pub use projection::{Outlook, Projection};
pub use scene::SceneSize;
pub use segments::Frame;
pub(crate) use segments::Segments;
pub use shape::{Line, Shape};
pub use solid::draw_solid;

use self::block::Contents;
use crate::Plane;
use crate::chunks::Chunks;
use crate::room::bytes_of;
use crate::space::finite;
use crate::style::StyleChange;
use lsystem_derive::LetterId;
use lsystem_syntax::{Diagnostic, LimitName, Meter};
use std::sync::OnceLock;

/// A picture of an L-system's n-th generation in the plane or in another [`Space`], ready to be read: bounds, segments,
/// pixels, files.
#[derive(Clone, Debug)]
pub struct Drawing<S: Space = Plane> {
    /// Children before parents.
    pub blocks: Vec<Block<S>>,
    /// The contents of all blocks; each block names its range.
    pub items: Chunks<Item<S>>,
    /// The corners of all hulls that have some; each block names its range.
    pub corners: Vec<S::Point>,
    /// The vertices of all polygons; each names its range.
    pub vertices: Vec<S::Point>,
    /// The styles in use; strokes and placements name theirs.
    pub styles: Vec<StyleChange>,
    /// The whole drawing, or `None` when nothing is drawn. Its frame has the axes of the model: the start heading is
    /// part of its contents, and a point `p` of it is `start + step * 2^exponent * p` in model units.
    pub root: Option<BlockId>,
    /// Where the turtle starts, in model units.
    pub start: S::Point,
    /// The step length, in model units; 1 where it is zero, and all lengths and widths that depend on it are then 0.
    pub step: f64,
    /// The turtle's stroke width at the start, in multiples of the step length.
    pub width: f64,
    /// The words of the pieces that it shares.
    pub(crate) pieces: Pieces<S>,
    /// Whether blocks are shared.
    pub memoised: bool,
    /// By stroke and polygon, in drawing order: where it is along the path, as in [`Tint`](lsystem_syntax::Tint); empty where
    /// they follow each other on it.
    pub places: Vec<f64>,
    /// The symbols of its generation, where they were counted.
    pub symbols: Option<u64>,
    /// What pictures in space make of it.
    pub scene: SceneSize,
    /// The root's extent in its own units, when somebody has asked.
    pub extent: OnceLock<Option<S::Extent>>,
}

impl Drawing {
    /// A box around all segments' axes, strokes' widths apart: min x, min y, max x, max y in model units,
    /// exact to 1e-9 of the extent, unless the drawing shares blocks and very many of them come close to a side: then it may
    /// be a little larger. `None` when nothing is drawn. What is beyond the range of `f64` is infinite.
    #[must_use]
    pub fn bounds(&self) -> Option<[f64; 4]> {
        let unit = self.unit();
        let [x0, y0, x1, y1] = self.extent()?;
        let model = |x: f64, y: f64| [self.start[0] + unit * x, self.start[1] + unit * y];
        let ([a, b], [c, d]) = (model(x0, y0), model(x1, y1));
        // A negative step turns the picture round.
        Some([a.min(c), b.min(d), a.max(c), b.max(d)])
    }

    /// The direction in which the segment `number` (0-based) is drawn: degrees counter-clockwise from +x, in
    /// `0.0..360.0`.
    #[must_use]
    pub fn heading_at(&self, number: u128) -> Option<f64> {
        self.segments_from(number).heading()
    }

    /// The corners of a block's hull.
    pub fn corners_of(&self, block: &Block) -> &[[f64; 2]] {
        &self.corners[block.hull.start as usize..block.hull.end as usize]
    }

    /// The root's extent in its own units: min x, min y, max x, max y.
    pub fn extent(&self) -> Option<[f64; 4]> {
        self.surveyed()
    }
}

impl<S: Space> Drawing<S> {
    /// The root's extent in its own units, found by whoever asks first where it was not when the drawing was made: after
    /// a bounded effort.
    pub fn surveyed(&self) -> Option<S::Extent> {
        *self.extent.get_or_init(|| {
            let mut survey = S::survey(self.root?);
            loop {
                if let Some(extent) = S::advance(&mut survey, self.all(), &mut Meter::new(u64::MAX)) {
                    return Some(extent);
                }
            }
        })
    }

    pub(crate) fn all(&self) -> Contents<'_, S> {
        Contents { blocks: &self.blocks, items: &self.items, corners: &self.corners, vertices: &self.vertices }
    }

    /// The bytes that the drawing takes; of one in space, with what its
    /// pictures are made from.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        bytes_of(&self.blocks)
            + self.items.bytes()
            + bytes_of(&self.corners)
            + bytes_of(&self.vertices)
            + bytes_of(&self.styles)
            + bytes_of(&self.places)
            + self.pieces.bytes()
            + self.scene.bytes(self.memoised)
    }

    /// How many segments there are; `u128::MAX` stands for that many or more.
    #[must_use]
    pub fn segment_count(&self) -> u128 {
        self.root.map_or(0, |root| self.blocks[root.0 as usize].segments)
    }

    /// How many polygons there are; `u128::MAX` stands for that many or more.
    #[must_use]
    pub fn polygon_count(&self) -> u128 {
        self.root.map_or(0, |root| self.blocks[root.0 as usize].polygons)
    }

    /// The style in which the polygon `number` (0-based, in the order in which they are opened) is filled, from the start of
    /// the drawing.
    #[must_use]
    pub fn polygon_style(&self, number: u128) -> Option<StyleChange> {
        let (polygon, frame) = self.polygon(number)?;
        Some(frame.style.then(&self.styles[polygon.style.0 as usize]))
    }

    /// Looks whether there are at most so many segments and vertices of polygons.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) otherwise.
    pub fn check_size(&self, most: u64) -> Result<(), Diagnostic> {
        let fits = self.size() <= u128::from(most);
        if fits { Ok(()) } else { Err(Diagnostic::limit(LimitName::Segments, most, None)) }
    }

    /// How many segments and vertices of polygons there are; `u128::MAX` stands for that many or more.
    fn size(&self) -> u128 {
        let Some(root) = self.root.filter(|_| self.polygon_count() > 0) else { return self.segment_count() };
        let mut sizes: Vec<u128> = Vec::with_capacity(self.blocks.len());
        for block in &self.blocks {
            let own = self.contents(block).iter().map(|item| match item {
                Item::Stroke(_) => 1,
                Item::Polygon(polygon) => u128::from(polygon.count),
                Item::Block(placed) => sizes[placed.block.0 as usize],
            });
            sizes.push(own.fold(0, u128::saturating_add));
        }
        sizes[root.0 as usize]
    }

    /// How many blocks the graph has.
    #[must_use]
    pub fn block_count(&self) -> usize {
        self.blocks.len()
    }

    /// How many symbols its generation has, where they were counted on the way: where the drawing does not memoise, and
    /// where modules with parameters do.
    #[must_use]
    pub fn symbol_count(&self) -> Option<u64> {
        self.symbols
    }

    /// Whether blocks are shared, so that the drawing's size does not depend on its number of segments.
    #[must_use]
    pub fn is_memoised(&self) -> bool {
        self.memoised
    }

    /// What `symbol`, which a production rewrites, does in `depth` more steps (at least 1), where this drawing
    /// memoises and contains it.
    #[must_use]
    pub fn piece(&self, symbol: LetterId, depth: u32) -> Option<&Piece<S>> {
        let Pieces::Letters(levels) = &self.pieces else { return None };
        let level = levels.get(depth.checked_sub(1)? as usize)?;
        let place = level.binary_search_by_key(&symbol, |(s, _)| *s).ok()?;
        Some(&level[place].1)
    }

    /// Every segment, in drawing order. A drawing that memoises may have more of them than anybody can wait for.
    #[must_use]
    pub fn segments(&self) -> Segments<'_, S> {
        Segments::new(self)
    }

    /// The segments from the one at `start` (0-based) on. Takes as long as the blocks are nested deep, however many
    /// segments come before.
    #[must_use]
    pub fn segments_from(&self, start: u128) -> Segments<'_, S> {
        let mut segments = Segments::new(self);
        segments.pass(start);
        segments
    }

    /// A block's items.
    pub fn items_of(&self, block: BlockId) -> &[Item<S>] {
        self.contents(&self.blocks[block.0 as usize])
    }

    /// The same of a block at hand.
    pub fn contents(&self, block: &Block<S>) -> &[Item<S>] {
        &self.items[block.items.start as usize..block.items.end as usize]
    }

    /// How many polygons an item fills; `u128::MAX` stands for that many or more.
    pub fn polygons_in(&self, item: &Item<S>) -> u128 {
        match item {
            Item::Stroke(_) => 0,
            Item::Polygon(_) => 1,
            Item::Block(placed) => self.blocks[placed.block.0 as usize].polygons,
        }
    }

    /// How many segments an item draws; `u128::MAX` stands for that many or more.
    pub fn segments_in(&self, item: &Item<S>) -> u128 {
        match item {
            Item::Stroke(_) => 1,
            Item::Polygon(_) => 0,
            Item::Block(placed) => self.blocks[placed.block.0 as usize].segments,
        }
    }

    /// How many of `items` come before the one with the segment `number` (0-based, of theirs), and the segment's number
    /// in that one; all items where they have no such segment. Polygons before it come before.
    pub fn before(&self, items: &[Item<S>], number: u128) -> (usize, u128) {
        self.before_by(items, number, Self::segments_in)
    }

    /// The same by another count.
    pub fn before_by(&self, items: &[Item<S>], number: u128, count: fn(&Self, &Item<S>) -> u128) -> (usize, u128) {
        let mut left = number;
        let place = items.iter().position(|item| {
            let count = count(self, item);
            let inside = count > left;
            left -= if inside { 0 } else { count };
            inside
        });
        (place.unwrap_or(items.len()), left)
    }

    /// The polygon `number` (0-based, in drawing order), and where it lies in the root block's frame.
    pub fn polygon(&self, number: u128) -> Option<(&Polygon, Frame<S>)> {
        let (mut block, mut left) = (self.root?, number);
        let mut frame = Frame::new(1.0, StyleChange::start(self.width));
        let mut directions = S::directions();
        loop {
            let items = self.items_of(block);
            let (at, within) = self.before_by(items, left, Self::polygons_in);
            match items.get(at)? {
                Item::Block(placed) => {
                    frame = frame.place(placed, self, &mut directions);
                    (block, left) = (placed.block, within);
                }
                Item::Polygon(polygon) => return Some((polygon, frame)),
                Item::Stroke(_) => return None,
            }
        }
    }

    /// A polygon's vertices.
    pub fn vertices_of(&self, polygon: &Polygon) -> &[S::Point] {
        &self.vertices[polygon.range()]
    }

    /// Model units for one unit of the root block; the greatest finite number where that is beyond `f64`.
    pub fn unit(&self) -> f64 {
        let exponent = self.root.map_or(0, |root| self.blocks[root.0 as usize].exponent);
        finite(libm::scalbn(self.step, exponent))
    }
}

/// One segment of a drawing, in model units, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<S: Space = Plane> {
    /// Where it starts.
    pub from: S::Point,
    /// Where it ends.
    pub to: S::Point,
    /// The colour index, not yet wrapped to a palette.
    pub colour: i32,
    /// The branch level: how many branches are open.
    pub level: u32,
    /// The stroke width, in model units.
    pub width: f64,
}
