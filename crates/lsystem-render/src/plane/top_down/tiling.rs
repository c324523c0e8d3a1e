//! Blocks painted once, as tiles, and stamped wherever they recur.

use super::tile::{self, Key, Tile, Tiles};
use crate::ink::{Inks, Shade};
use crate::plane::descent::Node;
use crate::plane::painter::{BROAD, Painter};
use crate::plane::shape::Shape;
use crate::viewport::Detail;
use lsystem_base::Meter;

/// Makes and stamps the tiles of a picture.
pub(in crate::plane) struct Tiling {
    /// Below this number of strokes on the picture, tiles are made only of blocks with many strokes.
    pub simple: u64,
    /// Whether tiles have the few places of a sketch.
    is_sketch: bool,
    tiles: Tiles,
    /// The unfinished tiles, the innermost last.
    unfinished: Vec<UnfinishedTile>,
}

/// A tile in the making.
#[derive(Clone, Copy, Debug)]
struct UnfinishedTile {
    key: Key,
    /// The height of the stack before the tile's block.
    height: usize,
    size: usize,
    /// The shades of the block.
    inks: Inks,
    /// The upper left corner, in subsamples from the subsample of the block's origin.
    corner: [i64; 2],
    destination: Destination,
}

/// The place where a tile is stamped.
#[derive(Clone, Copy, Debug)]
struct Destination {
    canvas: usize,
    /// The subsample of the block's origin.
    cell: [i64; 2],
    /// The shade at the block's entry.
    shade: Shade,
}

/// The bounds of a block on its canvas, in subsamples.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Bounds {
    pub centre: [f64; 2],
    /// How far the block and its strokes reach from the centre, across and down.
    pub reach: [f64; 2],
    /// The most that half the width of a stroke is.
    pub radius: f64,
}

impl Default for Tiling {
    fn default() -> Self {
        Self { simple: tile::SIMPLE_STROKES, is_sketch: false, tiles: Tiles::default(), unfinished: vec![] }
    }
}

impl Tiling {
    /// Forgets all tiles.
    pub(in crate::plane) fn clear(&mut self) {
        self.tiles.clear();
    }

    /// Starts a picture in this detail. Tiles in other places are dropped.
    pub(in crate::plane) fn begin(&mut self, detail: Detail) {
        if self.is_sketch != (detail == Detail::Sketch) {
            self.is_sketch = !self.is_sketch;
            self.tiles.clear();
        }
    }

    /// Gives up the unfinished tiles.
    pub(in crate::plane) fn stop(&mut self) {
        self.unfinished.clear();
    }

    /// Gives up the unfinished tiles, and the memory of all others.
    pub(in crate::plane) fn free(&mut self) {
        self.unfinished.clear();
        self.tiles = Tiles::default();
    }

    /// The size of the tile for a block; `None` if the block is painted without a tile.
    #[inline]
    pub(in crate::plane) fn tile_size(
        &self,
        painter: &Painter,
        node: &Node,
        strokes: u32,
        extent: f64,
        radius: f64,
    ) -> Option<usize> {
        let simple = node.canvas == 0 && painter.painted < self.simple;
        let inks = painter.inks.of(node.block.0 as usize);
        tile::size(extent, strokes, inks, simple)
            .filter(|size| size + 1 > node.canvas && radius <= BROAD && painter.repeats)
    }

    /// Stamps the tile of a block, if there is one, and returns the units of work. Otherwise moves the block to the
    /// canvas of a new tile, unless the tile would be too large. The tile is done when the stack has its present
    /// `height` again.
    #[inline]
    pub(in crate::plane) fn stamp_or_make(
        &mut self,
        painter: &mut Painter,
        (shape, node): (&Shape, &mut Node),
        bounds: Bounds,
        size: usize,
        height: usize,
    ) -> Option<u64> {
        let Bounds { centre, reach, radius } = bounds;
        let place = node.place;
        let inks = painter.inks.of(node.block.0 as usize);
        let fine = !self.tiles.crowded && tile::is_sparse(shape.extent(place.scale), shape.strokes);
        let snapped = tile::snap(place.origin, size, fine, self.is_sketch);
        let key = Key {
            block: node.block,
            heading: place.heading,
            scale: tile::scale(place.scale),
            offset: snapped.offset,
            fine,
            width: painter.measure.is_wide(radius).then_some(node.pen.widths.key()),
        };
        let destination = Destination { canvas: node.canvas, cell: snapped.cell, shade: node.pen.shade };
        if let Some(tile) = self.tiles.get(&key) {
            return Some(self.stamp(painter, &tile, inks, destination));
        }
        let from_origin = [0, 1].map(|axis| centre[axis] - place.origin[axis] + snapped.rest[axis]);
        let (corner, far) = tile::area(from_origin, reach, 0);
        let planes = painter.inks.planes(inks);
        if Tiles::fits(far, planes) {
            painter.empty_tile(size, far, planes);
            node.place.origin = [0, 1].map(|axis| snapped.rest[axis] - corner[axis] as f64);
            node.canvas = 1 + size;
            node.pen.shade = Shade::default();
            self.unfinished.push(UnfinishedTile { key, height, size, inks, corner, destination });
        }
        None
    }

    /// Keeps and stamps the innermost unfinished tile, if the stack has the tile's height again. Returns whether that
    /// was so.
    #[inline]
    pub(in crate::plane) fn finish(&mut self, painter: &mut Painter, height: usize, meter: &mut Meter) -> bool {
        let Some(making) = self.unfinished.pop_if(|making| making.height == height) else { return false };
        let canvas = &mut painter.canvases[1 + making.size];
        canvas.settle();
        // Keeping the tile takes as much work as painting it.
        meter.charge(1 + 2 * canvas.take_work());
        let tile = self.tiles.insert(making.key, canvas, making.corner);
        painter.stats.tiles += 1;
        meter.charge(self.stamp(painter, &tile, making.inks, making.destination));
        true
    }

    /// Stamps a tile whose block has these shades. Returns the units of work.
    fn stamp(&mut self, painter: &mut Painter, tile: &Tile, inks: Inks, destination: Destination) -> u64 {
        painter.stats.stamps += 1;
        let at = [0, 1].map(|axis| destination.cell[axis] + tile.corner[axis]);
        let dye = painter.inks.dye(inks, destination.shade);
        painter.canvases[destination.canvas].stamp(&self.tiles.bits(tile, &dye), at, &dye);
        1 + (tile.strips * tile.rows * (1 + tile.planes())) as u64 / 32
    }
}
