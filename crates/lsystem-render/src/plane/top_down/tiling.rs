//! Blocks painted once, as tiles, and stamped wherever they recur.

use super::tile::{self, Key, Tile, Tiles};
use crate::plane::descent::Node;
use crate::plane::inks::{Inks, Shade};
use crate::plane::painter::{BROAD, Painter};
use crate::plane::shape::Shape;
use lsystem_syntax::Meter;

/// Makes and stamps the tiles of a picture.
pub(in crate::plane) struct Tiling {
    /// Below this number of strokes on the picture, tiles are made only where they save much.
    pub simple: u64,
    tiles: Tiles,
    /// The tiles in the making, the innermost last.
    making: Vec<Making>,
}

/// A tile being made.
#[derive(Clone, Copy, Debug)]
struct Making {
    key: Key,
    /// The stack's height before.
    height: usize,
    size: usize,
    /// The shades of its block.
    inks: Inks,
    /// From the cell of the origin to the tile's upper left corner.
    corner: [i64; 2],
    target: Target,
}

/// Where a tile is to be stamped.
#[derive(Clone, Copy, Debug)]
struct Target {
    canvas: usize,
    /// The cell of the origin.
    cell: [i64; 2],
    /// The shade at the block's entry.
    shade: Shade,
}

/// Where a block lies on its canvas, in subsamples.
#[derive(Clone, Copy, Debug)]
pub(in crate::plane) struct Bounds {
    pub centre: [f64; 2],
    /// How far the block reaches from the centre, across and down, its strokes as well.
    pub reach: [f64; 2],
    /// Half the width of its widest stroke, at most.
    pub radius: f64,
}

impl Default for Tiling {
    fn default() -> Self {
        Self { simple: tile::SIMPLE_STROKES, tiles: Tiles::default(), making: vec![] }
    }
}

impl Tiling {
    /// Forgets all tiles.
    pub(in crate::plane) fn clear(&mut self) {
        self.tiles.clear();
    }

    /// Gives up the tiles in the making.
    pub(in crate::plane) fn stop(&mut self) {
        self.making.clear();
    }

    /// Gives up the tiles in the making, and the memory of all others.
    pub(in crate::plane) fn free(&mut self) {
        self.making.clear();
        self.tiles = Tiles::default();
    }

    /// The size of the tile that a block is to be painted with, if any.
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

    /// Stamps the tile of a block, if there is one: what that took. Otherwise moves the block to the canvas where the tile
    /// is made until the stack has its present `height` again, unless the tile would be too large.
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
        let snapped = tile::snap(place.origin, size, fine);
        let key = Key {
            block: node.block,
            heading: place.heading,
            scale: tile::scale(place.scale),
            offset: snapped.offset,
            fine,
            width: painter.measure.is_wide(radius).then_some(node.pen.width.to_bits()),
        };
        let target = Target { canvas: node.canvas, cell: snapped.cell, shade: node.pen.shade };
        if let Some(tile) = self.tiles.get(&key) {
            return Some(self.stamp(painter, &tile, inks, target));
        }
        let from_origin = [0, 1].map(|axis| centre[axis] - place.origin[axis] + snapped.rest[axis]);
        let corner = [0, 1].map(|axis| (from_origin[axis] - reach[axis]).floor() as i64);
        let far = [0, 1].map(|axis| (from_origin[axis] + reach[axis]).ceil() as i64 - corner[axis]);
        let far = far.map(|side| side.max(1) as usize);
        let planes = painter.inks.planes(inks);
        if Tiles::fits(far, planes) {
            painter.empty_tile(size, far, planes);
            node.place.origin = [0, 1].map(|axis| snapped.rest[axis] - corner[axis] as f64);
            node.canvas = 1 + size;
            node.pen.shade = Shade::default();
            self.making.push(Making { key, height, size, inks, corner, target });
        }
        None
    }

    /// Keeps and stamps the innermost tile in the making, if it is done: if the stack has its `height` again. Whether it
    /// was.
    #[inline]
    pub(in crate::plane) fn finish(&mut self, painter: &mut Painter, height: usize, meter: &mut Meter) -> bool {
        let Some(making) = self.making.pop_if(|making| making.height == height) else { return false };
        let canvas = &mut painter.canvases[1 + making.size];
        canvas.settle();
        // As much again to keep it.
        meter.charge(1 + 2 * canvas.take_work());
        let tile = self.tiles.insert(making.key, canvas, making.corner);
        painter.stats.tiles += 1;
        meter.charge(self.stamp(painter, &tile, making.inks, making.target));
        true
    }

    /// Stamps a tile whose block has these shades.
    fn stamp(&mut self, painter: &mut Painter, tile: &Tile, inks: Inks, target: Target) -> u64 {
        painter.stats.stamps += 1;
        let at = [0, 1].map(|axis| target.cell[axis] + tile.corner[axis]);
        let dye = painter.inks.dye(inks, target.shade);
        painter.canvases[target.canvas].stamp(&self.tiles.bits(tile, &dye), at, &dye);
        1 + (tile.strips * tile.rows * (1 + tile.planes())) as u64 / 32
    }
}
