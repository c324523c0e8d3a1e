//! A drawing is a small graph of placed blocks, not a long list of segments.
//!
//! After n derivation steps a string is exponentially long but consists of few distinct pieces: symbol `s` derived for
//! `d` more steps always draws the same piece, a [`Block`]. A block holds strokes, polygons and placed smaller blocks,
//! in drawing order. Such drawings are [shared](share). Systems whose pieces differ (stochastic or unbalanced
//! productions) are [unfolded](unfold) into a tree of blocks of the same type, so that every reader sees one data
//! structure.

mod around;
mod block;
mod body;
mod builder;
mod bulk;
mod drawer;
mod extent;
mod features;
mod girth;
mod hull;
mod item_buffer;
mod marks;
mod origin;
mod piece;
mod pieces;
mod projection;
mod scene;
mod segments;
mod share;
mod simplify;
mod solid;
mod solid_extent;
mod solid_reader;
mod taper;
mod task;
mod tree;
mod unfold;

pub use around::{Around, count_of};
pub use block::{Block, BlockId, Item, Placed, Polygon, Space, Stroke};
pub use bulk::SegmentArrays;
pub use drawer::{Drawer, draw};
pub use features::{BlockFeatures, Line};
pub use hull::hull;
pub use marks::Mark;
pub use origin::Origin;
pub(crate) use piece::Piece;
pub(crate) use pieces::{Pieces, StateWord, StateWords};
pub use projection::{Outlook, Projection};
pub use scene::SceneSize;
pub use segments::BlockFrame;
pub(crate) use segments::SegmentIter;
pub(crate) use solid_reader::{SolidMark, SolidReader};
pub(crate) use unfold::TurtleInterpreter;

use self::block::Contents;

use crate::Plane;
use crate::chunks::Chunks;
use crate::exact_path::ExactPath;
use crate::room::bytes_of;
use crate::space::finite;
use crate::style::{StyleChange, StyleId, Widths};
use lsystem_base::{LimitName, Meter};
use lsystem_derive::LetterId;
use lsystem_syntax::Diagnostic;
use std::sync::OnceLock;

/// A picture of an L-system's n-th generation in the plane or in another [`Space`], ready to be read: bounds, segments,
/// pixels, files.
#[derive(Clone, Debug)]
pub struct Drawing<S: Space = Plane> {
    /// Children before parents.
    pub blocks: Vec<Block<S>>,
    /// The contents of all blocks; [`Block::items`] is a range here.
    pub items: Chunks<Item<S>>,
    /// The corners of all hulls in the plane; [`Block::hull`] is a range here. Empty in space.
    pub corners: Vec<S::Point>,
    /// The vertices of all polygons; [`Polygon::range`] is a range here.
    pub vertices: Vec<S::Point>,
    /// The styles in use; a [`StyleId`](crate::StyleId) is an index here.
    pub styles: Vec<StyleChange>,
    /// The block of the whole drawing, or `None` if nothing is drawn. The block's frame has the axes of the model: the
    /// start heading is part of the contents, and a point `p` is `start + step * 2^exponent * p` in model units.
    pub root: Option<BlockId>,
    /// The turtle's position at the start, in model units.
    pub start: S::Point,
    /// The step length, in model units. If the system's step is zero, this is 1, and lengths and widths in steps are 0.
    pub step: f64,
    /// The turtle's stroke width at the start, in multiples of the step length.
    pub width: f64,
    /// The ways to the places of a shared drawing in the plane.
    pub(crate) exact_path: ExactPath<S>,
    /// The words of the shared pieces.
    pub(crate) pieces: Pieces<S>,
    /// Whether blocks are shared.
    pub memoised: bool,
    /// The place along the path, as in [`Tint`](lsystem_syntax::Tint), of each stroke and polygon, in drawing order.
    /// Empty if the drawing order is the path's order.
    pub places: Vec<f64>,
    /// Of a projection: the depths of all ends of strokes and vertices of polygons, in drawing order and in units of the
    /// root block; greater ones are nearer to the viewer. Empty for other drawings.
    pub depths: Vec<f64>,
    /// The number of the last segments that are outlines of shapes.
    pub wires: usize,
    /// The number of symbols of the generation, if counted.
    pub symbols: Option<u64>,
    /// The size of the scene for pictures in space.
    pub scene: SceneSize,
    /// The root's extent in root units; empty until it is known.
    pub extent: OnceLock<Option<S::Extent>>,
}

impl Drawing {
    /// A box around all segments' axes and polygons, without stroke widths: min x, min y, max x, max y in model units.
    /// The box is exact to 1e-9 of its size, but may be a little larger if very many shared blocks come close to a
    /// side. `None` if nothing is drawn. Coordinates beyond the range of `f64` are infinite.
    #[must_use]
    pub fn bounds(&self) -> Option<[f64; 4]> {
        let unit = self.unit();
        let [x0, y0, x1, y1] = self.extent()?;
        let model = |x: f64, y: f64| [self.start[0] + unit * x, self.start[1] + unit * y];
        let ([a, b], [c, d]) = (model(x0, y0), model(x1, y1));
        // A negative step reflects the picture, so that minimum and maximum change places.
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

    /// The root's extent in root units: min x, min y, max x, max y.
    pub fn extent(&self) -> Option<[f64; 4]> {
        self.surveyed()
    }
}

impl<S: Space> Drawing<S> {
    /// The root's extent in root units. If the extent is not known yet, the first call computes it, with bounded
    /// effort.
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

    /// Makes all strokes thinner by one factor if the widest exceeds `most`, a fraction of the drawing's longest side;
    /// 0 for no limit. Widths are linear in the factor, so blocks stay shared.
    pub(crate) fn limit_widths(&mut self, most: f64) {
        /// A drawing smaller than this, in steps, is a point: its size is rounding.
        const POINT: f64 = 1e-9;
        let Some(root) = self.root.filter(|_| most > 0.0) else { return };
        let side = self.extent.get().copied().flatten().map_or(0.0, |extent| S::longest(&extent));
        let side = finite(libm::scalbn(side, self.blocks[root.0 as usize].exponent));
        let factor = if side > POINT { most * side / self.widest(root) } else { 1.0 };
        if factor < 1.0 {
            self.width *= factor;
            for style in &mut self.styles {
                style.width.offset *= factor;
                style.next.iter_mut().for_each(|next| next.offset *= factor);
            }
            self.blocks.iter_mut().for_each(|block| block.widest.offset *= factor);
        }
    }

    /// The width of the widest stroke, in model units.
    #[must_use]
    pub fn widest_stroke(&self) -> f64 {
        self.root.map_or(0.0, |root| self.widest(root)) * self.step.abs()
    }

    /// The width of the widest stroke, in steps.
    fn widest(&self, root: BlockId) -> f64 {
        let bound = self.blocks[root.0 as usize].widest;
        if !self.memoised {
            // All widths are relative to the start, so that the bound is exact.
            return bound.of(self.width);
        }
        // By block: the widest entry. A wider entry makes nothing inside thinner, so the others do not matter.
        let mut entries = vec![None; self.blocks.len()];
        entries[root.0 as usize] = Some(self.width);
        let mut widest = 0.0_f64;
        for (number, block) in self.blocks.iter().enumerate().rev() {
            let Some(entry) = entries[number] else { continue };
            let style = |id: StyleId| Widths::new(entry).after(&self.styles[id.0 as usize]);
            for item in self.contents(block) {
                match item {
                    Item::Stroke(stroke) => widest = style(stroke.style).ends().into_iter().fold(widest, f64::max),
                    Item::Block(placed) => {
                        let Widths { own, next } = style(placed.style);
                        let inner = &mut entries[placed.block.0 as usize];
                        *inner = Some(inner.map_or(own, |before: f64| before.max(own)));
                        widest = widest.max(next.unwrap_or(0.0));
                    }
                    Item::Polygon(_) => {}
                }
            }
        }
        widest
    }

    /// The contents of all blocks.
    pub(crate) fn all(&self) -> Contents<'_, S> {
        Contents { blocks: &self.blocks, items: &self.items, corners: &self.corners, vertices: &self.vertices }
    }

    /// The bytes that the drawing occupies; in space, with the bytes of its scene.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        bytes_of(&self.blocks)
            + self.items.bytes()
            + bytes_of(&self.corners)
            + bytes_of(&self.vertices)
            + bytes_of(&self.styles)
            + bytes_of(&self.places)
            + bytes_of(&self.depths)
            + self.pieces.bytes()
            + self.exact_path.bytes()
            + self.scene.bytes(self.memoised)
    }

    /// The number of segments; saturating.
    #[must_use]
    pub fn segment_count(&self) -> u128 {
        self.root.map_or(0, |root| self.blocks[root.0 as usize].segments)
    }

    /// As [`Drawing::segment_count`], without the outlines of shapes, which are the last segments.
    #[must_use]
    pub fn turtle_segments(&self) -> u128 {
        self.segment_count().saturating_sub(self.wires as u128)
    }

    /// The number of polygons; saturating.
    #[must_use]
    pub fn polygon_count(&self) -> u128 {
        self.root.map_or(0, |root| self.blocks[root.0 as usize].polygons)
    }

    /// The fill style of polygon `number` (0-based, in the order of opening), relative to the start of the drawing.
    #[must_use]
    pub fn polygon_style(&self, number: u128) -> Option<StyleChange> {
        let (polygon, frame) = self.polygon(number)?;
        Some(frame.style.then(&self.styles[polygon.style.0 as usize]))
    }

    /// Checks that there are at most `most` segments and vertices of polygons.
    ///
    /// # Errors
    /// [`Kind::Limit`](lsystem_syntax::Kind::Limit) if there are more.
    pub fn check_size(&self, most: u64) -> Result<(), Diagnostic> {
        let fits = self.size() <= u128::from(most);
        if fits { Ok(()) } else { Err(Diagnostic::limit(LimitName::Segments, most, None)) }
    }

    /// The number of segments and vertices of polygons; saturating.
    pub fn size(&self) -> u128 {
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

    /// The number of blocks in the graph.
    #[must_use]
    pub fn block_count(&self) -> usize {
        self.blocks.len()
    }

    /// The number of symbols of the generation, if counted while drawing: for unfolded drawings, and for shared
    /// drawings of modules with parameters.
    #[must_use]
    pub fn symbol_count(&self) -> Option<u64> {
        self.symbols
    }

    /// Whether blocks are shared, so that the drawing's size does not depend on the number of segments.
    #[must_use]
    pub fn is_memoised(&self) -> bool {
        self.memoised
    }

    /// The piece that `symbol`, which a production rewrites, draws in `depth` more steps (at least 1). `None` unless
    /// this drawing shares the pieces of plain letters and contains this one.
    #[must_use]
    pub fn piece(&self, symbol: LetterId, depth: u32) -> Option<&Piece<S>> {
        self.piece_of(symbol, depth, false)
    }

    /// As [`Drawing::piece`]; with `swapped`, the piece that the symbol draws while left and right turns are exchanged.
    pub(crate) fn piece_of(&self, symbol: LetterId, depth: u32, swapped: bool) -> Option<&Piece<S>> {
        let Pieces::Letters(levels) = &self.pieces else { return None };
        let level = levels.get(depth.checked_sub(1)? as usize)?;
        let place = level.binary_search_by_key(&(symbol, swapped), |(key, _)| *key).ok()?;
        Some(&level[place].1)
    }

    /// Every segment, in drawing order. A shared drawing may have too many segments to read them all.
    #[must_use]
    pub fn segments(&self) -> SegmentIter<'_, S> {
        SegmentIter::new(self)
    }

    /// The segments from number `start` (0-based) on. The time depends on the depth of nested blocks, not on `start`.
    #[must_use]
    pub fn segments_from(&self, start: u128) -> SegmentIter<'_, S> {
        let mut segments = SegmentIter::new(self);
        segments.pass(start);
        segments
    }

    /// A block's items.
    pub fn items_of(&self, block: BlockId) -> &[Item<S>] {
        self.contents(&self.blocks[block.0 as usize])
    }

    /// The items of a block.
    pub fn contents(&self, block: &Block<S>) -> &[Item<S>] {
        &self.items[block.items.start as usize..block.items.end as usize]
    }

    /// The number of polygons in an item; saturating.
    pub fn polygons_in(&self, item: &Item<S>) -> u128 {
        match item {
            Item::Stroke(_) => 0,
            Item::Polygon(_) => 1,
            Item::Block(placed) => self.blocks[placed.block.0 as usize].polygons,
        }
    }

    /// The number of segments in an item; saturating.
    pub fn segments_in(&self, item: &Item<S>) -> u128 {
        match item {
            Item::Stroke(_) => 1,
            Item::Polygon(_) => 0,
            Item::Block(placed) => self.blocks[placed.block.0 as usize].segments,
        }
    }

    /// The index of the item that contains segment `number` (0-based) of `items`, and the segment's number in that
    /// item. The index is `items.len()` if the items have fewer segments.
    pub fn before(&self, items: &[Item<S>], number: u128) -> (usize, u128) {
        self.before_by(items, number, Self::segments_in)
    }

    /// As [`Drawing::before`], for the things that `count` counts.
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

    /// Polygon `number` (0-based, in drawing order), and the frame of its block in the root block's frame.
    pub fn polygon(&self, number: u128) -> Option<(&Polygon, BlockFrame<S>)> {
        let (mut block, mut left) = (self.root?, number);
        let mut frame = BlockFrame::new(1.0, StyleChange::start(self.width));
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

    /// One unit of the root block in model units, clamped to the range of `f64`.
    pub fn unit(&self) -> f64 {
        let exponent = self.root.map_or(0, |root| self.blocks[root.0 as usize].exponent);
        finite(libm::scalbn(self.step, exponent))
    }
}

/// One segment of a drawing, in model units, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<S: Space = Plane> {
    /// The first end.
    pub from: S::Point,
    /// The second end.
    pub to: S::Point,
    /// The colour index, not yet wrapped to a palette.
    pub colour: i32,
    /// The branch level: the number of open branches.
    pub level: u32,
    /// The stroke width at the first end, in model units.
    pub width: f64,
    /// The stroke width at the second end.
    pub end_width: f64,
}
