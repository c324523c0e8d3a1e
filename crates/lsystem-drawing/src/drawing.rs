//! A drawing is a small graph of placed blocks, not a long list of segments.
//!
//! After n derivation steps a string is exponentially long but made of few distinct pieces: symbol `s` derived for
//! `d` more steps is always the same piece, a [`Block`]. Blocks hold strokes and placed smaller blocks, in drawing
//! order. Systems whose pieces are not all alike (stochastic or unbalanced productions) are materialised into a
//! tree of blocks of the same type, so every reader sees one shape of data.

mod body;
mod budget;
mod builder;
mod bulk;
mod contents;
mod drawer;
mod extent;
mod girth;
mod graph;
mod hull;
mod marks;
mod materialise;
mod modules;
mod parametric;
mod projection;
mod scales;
mod scene;
mod segments;
mod shape;
mod sheet;
mod solid;
mod style;
mod tally;
mod tree;
mod vertical;

pub(crate) use body::Body;
pub(crate) use body::{Extent as SolidExtent, Survey as SolidSurvey};
pub(crate) use builder::{Builder, Enclosed, reserve};
pub use bulk::SegmentArrays;
pub(crate) use contents::Contents;
pub use drawer::{Drawer, draw};
pub(crate) use extent::Survey as PlaneSurvey;
pub(crate) use graph::Effect;
pub use hull::hull;
pub use marks::Mark;
pub use marks::MarkReader;
pub use projection::Outlook;
pub use scene::SceneSize;
pub use segments::Frame;
pub(crate) use segments::Segments;
pub use shape::{Line, Shape, shapes};
pub use solid::draw_solid;

use crate::turtle::finite;
use crate::{Plane, Space};
use core::ops::Range;
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
    pub items: Vec<Item<S>>,
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
    /// By depth from 1, sorted by letter: what every rewritten letter draws in that many steps and how it leaves the
    /// turtle; empty where blocks do not memoise.
    pub pieces: Vec<Vec<(LetterId, Piece<S>)>>,
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

/// What a letter derived for some more steps does.
#[derive(Clone, Copy, Debug)]
pub struct Piece<S: Space = Plane> {
    /// What it draws; `None` if nothing.
    pub block: Option<BlockId>,
    /// How it leaves the turtle.
    pub effect: Effect<S>,
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
        let pieces: u64 = self.pieces.iter().map(builder::bytes_of).sum();
        builder::bytes_of(&self.blocks)
            + builder::bytes_of(&self.items)
            + builder::bytes_of(&self.corners)
            + builder::bytes_of(&self.vertices)
            + builder::bytes_of(&self.styles)
            + builder::bytes_of(&self.places)
            + pieces
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
        let level = self.pieces.get(depth.checked_sub(1)? as usize)?;
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

/// Which of a drawing's blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlockId(pub u32);

/// Which of a drawing's style changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct StyleId(pub u32);

/// A piece of a drawing, in its own frame: the turtle enters at the origin heading along +x.
#[derive(Clone, Debug)]
pub struct Block<S: Space = Plane> {
    /// Its contents in drawing order.
    pub items: Range<u32>,
    /// One unit of this block's frame is `2^exponent` step lengths, chosen so that its farthest coordinate is at least
    /// 0.5 and less than 1 away from its origin. Powers of two cost no precision and keep n = 1,000 within range.
    pub exponent: i32,
    /// How many segments it draws; `u128::MAX` stands for that many or more.
    pub segments: u128,
    /// How many polygons it fills; `u128::MAX` stands for that many or more.
    pub polygons: u128,
    /// A convex body that contains every segment's axis (strokes' widths apart), in block units.
    pub hull: S::Hull,
    /// How far the hull may be larger than the smallest one of its sort, in block units: nothing to speak of, unless
    /// the smallest one is very complicated.
    pub slack: f64,
    /// No stroke inside is wider than this change makes the width at entry.
    pub widest: WidthChange,
}

/// Something a block contains.
#[derive(Clone, Copy, Debug)]
pub enum Item<S: Space = Plane> {
    /// One segment.
    Stroke(Stroke<S>),
    /// A filled polygon.
    Polygon(Polygon),
    /// A smaller block.
    Block(Placed<S>),
}

/// One segment, in block units.
#[derive(Clone, Copy, Debug)]
pub struct Stroke<S: Space = Plane> {
    /// Where it starts.
    pub from: S::Point,
    /// Where it ends.
    pub to: S::Point,
    /// The style it is drawn in, relative to the block's entry.
    pub style: StyleId,
}

/// A filled polygon: inside is what its outline winds around a number of times other than zero.
#[derive(Clone, Copy, Debug)]
pub struct Polygon {
    /// Its first vertex among the drawing's.
    pub first: u32,
    /// How many vertices it has: at least 3, each joined to the next and the last to the first. Block units.
    pub count: u32,
    /// The style it is filled in, relative to the block's entry.
    pub style: StyleId,
    /// The place of the symbol that opens it: where blocks are shared in the axiom or the successor that its block comes
    /// of, otherwise in the whole string; 0-based.
    pub symbol: u32,
}

impl Polygon {
    /// Its vertices among the drawing's.
    pub fn range(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// A block placed in another block's frame: `p -> at + scale * rotate(heading, p)`.
#[derive(Clone, Copy, Debug)]
pub struct Placed<S: Space = Plane> {
    /// Which block.
    pub block: BlockId,
    /// The style at its entry, relative to the containing block's entry.
    pub style: StyleId,
    /// Its origin, in the containing block's units.
    pub at: S::Point,
    /// How it is turned.
    pub heading: S::Turn,
    /// Containing units for one of its own: length factor times `2^(its exponent - the container's)`.
    pub scale: f64,
}

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
