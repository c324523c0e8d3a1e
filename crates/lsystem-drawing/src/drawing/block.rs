//! Blocks, their items, and the interface of a space that encloses them.

use super::scene::SceneSize;
use crate::Plane;
use crate::chunks::Chunks;
use crate::exact_path::Spot;
use crate::space::Geometry;
use crate::style::{StyleId, WidthChange};
use core::fmt::Debug;
use core::ops::Range;
use lsystem_base::Meter;

/// A space for drawings. Each space has its own kind of convex body around a block.
pub trait Space: Geometry {
    /// A convex body around a block's segments and polygons, in block units.
    type Hull: Clone + Debug;
    /// The smallest box around a drawing.
    type Extent: Copy + Debug;
    /// A search for that box.
    type Survey: Clone + Debug;

    /// The body around `items`, which may place the blocks of `input`.
    fn enclose(input: HullInput<'_, Self>, items: &[Item<Self>]) -> Enclosed<Self>;

    /// Adds to `size` the part of a picture's scene that a block with these items needs.
    fn measure(_size: &mut SceneSize, _items: &[Item<Self>]) {}

    /// The least bytes of a segment in a picture's scene.
    fn least_picture() -> u64 {
        0
    }

    /// A search for the extent of a block in block units.
    fn survey(root: BlockId) -> Self::Survey;

    /// The longest side of the box.
    fn longest(extent: &Self::Extent) -> f64;

    /// Continues the search until the meter is spent. Returns the extent after a bounded number of calls. The extent
    /// does not depend on the budgets of the calls.
    fn advance(survey: &mut Self::Survey, contents: Contents<'_, Self>, meter: &mut Meter) -> Option<Self::Extent>;
}

/// The index of a block in [`Drawing::blocks`](crate::Drawing::blocks).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BlockId(pub u32);

/// A piece of a drawing, in its own frame: the turtle enters at the origin heading along +x.
#[derive(Clone, Debug)]
pub struct Block<S: Space = Plane> {
    /// The range of the block's items, in drawing order.
    pub items: Range<u32>,
    /// One unit of the block's frame is `2^exponent` step lengths. The exponent makes the farthest coordinate at least
    /// 0.5 and less than 1. Powers of two cost no precision and keep n = 1,000 within range.
    pub exponent: i32,
    /// The block's origin, in the frame of its piece.
    pub origin: Spot,
    /// The number of segments; saturating.
    pub segments: u128,
    /// The number of polygons; saturating.
    pub polygons: u128,
    /// A convex body that contains every segment's axis (without stroke widths) and every polygon, in block units.
    pub hull: S::Hull,
    /// The most by which the hull exceeds the smallest one of its kind, in block units: nearly 0, unless the smallest
    /// hull is very complicated.
    pub slack: f64,
    /// An upper bound on the width change, from entry, of all strokes inside.
    pub widest: WidthChange,
}

/// A part of a block.
#[derive(Clone, Copy, Debug)]
pub enum Item<S: Space = Plane> {
    /// One segment.
    Stroke(Stroke<S>),
    /// A filled polygon.
    Polygon(Polygon),
    /// A smaller block.
    Block(Placed<S>),
}

impl<S: Space> Item<S> {
    /// Whether the item is a polygon that is not closed, or has fewer than three vertices.
    pub(crate) fn is_hollow(&self) -> bool {
        matches!(self, Self::Polygon(Polygon { count: 0, .. }))
    }
}

/// One segment, in block units.
#[derive(Clone, Copy, Debug)]
pub struct Stroke<S: Space = Plane> {
    /// The first end.
    pub from: S::Point,
    /// The second end.
    pub to: S::Point,
    /// The style, relative to the block's entry.
    pub style: StyleId,
    /// The second end, in the frame of the block's piece. The first is where the last leg of the way to it begins.
    pub spot: Spot,
}

/// A filled polygon, by the nonzero winding rule. The vertices are in block units; each is joined to the next and the
/// last to the first.
#[derive(Clone, Copy, Debug)]
pub struct Polygon {
    /// The index of the first vertex in [`Drawing::vertices`](crate::Drawing::vertices).
    pub first: u32,
    /// The number of vertices: at least 3.
    pub count: u32,
    /// The fill style, relative to the block's entry.
    pub style: StyleId,
    /// The place (0-based) of the symbol that opens the polygon: in the whole string, or in a shared drawing in the
    /// axiom or successor that the block draws.
    pub symbol: u32,
}

impl Polygon {
    /// The range of the vertices in [`Drawing::vertices`](crate::Drawing::vertices).
    pub fn range(&self) -> Range<usize> {
        self.first as usize..(self.first + self.count) as usize
    }
}

/// A block placed in another block's frame: `p -> at + scale * rotate(heading, p)`.
#[derive(Clone, Copy, Debug)]
pub struct Placed<S: Space = Plane> {
    /// The placed block.
    pub block: BlockId,
    /// The style at the placed block's entry, relative to the containing block's entry.
    pub style: StyleId,
    /// The placed block's origin, in the frame of the containing block's piece; `None` where no exact path is kept. As an
    /// option it leaves room for the kind of the [`Item`], which would take eight bytes more.
    pub spot: Option<Spot>,
    /// The placed block's origin, in the containing block's units.
    pub at: S::Point,
    /// The placed block's rotation.
    pub heading: S::Turn,
    /// One unit of the placed block in units of the container: length factor times `2^(own exponent - container's)`.
    pub scale: f64,
}

/// The lists with the contents of all blocks, of a finished drawing or of one in the making.
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

/// The input for the body around a new block, and the list that receives its corners.
#[derive(Debug)]
pub struct HullInput<'a, S: Space> {
    /// The blocks made so far, with their items and the vertices of all polygons.
    pub blocks: &'a [Block<S>],
    pub items: &'a Chunks<Item<S>>,
    pub vertices: &'a [S::Point],
    /// The corners of all hulls in the plane.
    pub corners: &'a mut Vec<S::Point>,
    /// The cache of axes.
    pub directions: &'a mut S::Directions,
    /// A reusable buffer for points.
    pub points: &'a mut Vec<S::Point>,
}

/// The body around some items.
#[derive(Clone, Debug)]
pub struct Enclosed<S: Space> {
    /// The body, in units of `2^shift` item units, so that the farthest coordinate is below 1.
    pub hull: S::Hull,
    /// As [`Block::slack`], in the same units.
    pub slack: f64,
    /// The exponent from item units to the body's units.
    pub shift: i32,
    /// The units of work spent.
    pub work: u64,
}
