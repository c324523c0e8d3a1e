//! Blocks, what they hold, and what a drawing needs to know of its space to enclose them.

use super::scene::SceneSize;
use crate::Plane;
use crate::chunks::Chunks;
use crate::space::Geometry;
use crate::style::{StyleId, WidthChange};
use core::fmt::Debug;
use core::ops::Range;
use lsystem_syntax::Meter;

/// A space in which drawings are made: what a block draws there is contained in a body of its kind.
pub trait Space: Geometry {
    /// A convex body that contains what a block draws, in block units.
    type Hull: Clone + Debug;
    /// The smallest box around a drawing.
    type Extent: Copy + Debug;
    /// Looks for that box.
    type Survey: Clone + Debug;

    /// What contains all `items`, which may place blocks of the ground.
    fn enclose(ground: Ground<'_, Self>, items: &[Item<Self>]) -> Enclosed<Self>;

    /// Counts what a block with these items takes where pictures are made of it, beside the drawing itself.
    fn measure(_size: &mut SceneSize, _items: &[Item<Self>]) {}

    /// What a segment takes there at least, in bytes.
    fn least_picture() -> u64 {
        0
    }

    /// Ready to look for the extent of a block in its own units.
    fn survey(root: BlockId) -> Self::Survey;

    /// Looks on until the meter is spent; the extent when it is found, after a bounded number of calls. It does not
    /// depend on how much each of them may do.
    fn advance(survey: &mut Self::Survey, contents: Contents<'_, Self>, meter: &mut Meter) -> Option<Self::Extent>;
}

/// Which of a drawing's blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlockId(pub u32);

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

/// What blocks hold, while they are made and when they are.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a, S: Space> {
    pub blocks: &'a [Block<S>],
    pub items: &'a Chunks<Item<S>>,
    pub corners: &'a [S::Point],
    pub vertices: &'a [S::Point],
}

impl<'a, S: Space> Contents<'a, S> {
    /// A block's items.
    pub fn items_of(&self, block: BlockId) -> &'a [Item<S>] {
        let range = &self.blocks[block.0 as usize].items;
        &self.items[range.start as usize..range.end as usize]
    }
}

/// What bodies around blocks are made from, and where their corners go.
#[derive(Debug)]
pub struct Ground<'a, S: Space> {
    /// The blocks made so far, with their items and the vertices of all polygons.
    pub blocks: &'a [Block<S>],
    pub items: &'a Chunks<Item<S>>,
    pub vertices: &'a [S::Point],
    /// The corners of bodies that have some.
    pub corners: &'a mut Vec<S::Point>,
    /// Directions met before.
    pub directions: &'a mut S::Directions,
    /// Where points are collected.
    pub points: &'a mut Vec<S::Point>,
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
    /// The units of work that finding it has taken.
    pub work: u64,
}
