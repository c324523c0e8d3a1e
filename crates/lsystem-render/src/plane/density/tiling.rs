//! Blocks drawn once, as tiles, and added wherever they recur.

use super::tile::{self, InkKey, SIZES, Tile, Tiles};
use crate::ink::Grid;
use crate::ink::Shade;
use crate::ink::{Pigment, Sheet};
use crate::plane::descent::{Node, Place};
use crate::plane::top_down::tile::{self as opaque, Key};

/// Once tiles had to be dropped, only blocks smaller than this extent, in pixels, get tiles.
const CROWDED_EXTENT: f64 = 20.0;

/// The picture, then a sheet for each size of tile.
pub(super) type Sheets = [Sheet; 1 + SIZES];

/// The area of a block on its sheet, in pixels.
pub(super) struct Footprint {
    /// The middle of the block's bounds.
    pub centre: [f64; 2],
    /// How far the block and its strokes reach from the centre, across and down.
    pub reach: [f64; 2],
    /// The most that the width of a stroke is.
    pub width: f64,
    /// The longer side of the bounds, without the width of strokes.
    pub extent: f64,
}

/// The tile that a block would have.
#[derive(Clone, Copy)]
pub(super) struct WantedTile {
    /// The height of the stack before the tile's block, at which a new tile is done.
    pub height: usize,
    /// The index of its sheet, by size.
    pub size: usize,
    /// The number of the block's strokes.
    pub strokes: u32,
    /// The width of the pen, as bits, if it matters.
    pub width: Option<[u64; 2]>,
    /// The entry for which the tile has pigments of its own, if the block has several inks.
    pub shade: Option<Shade>,
    /// The pigment of the tile on its sheet.
    pub pigment: Pigment,
}

/// The place and the pigment of a tile on a sheet.
#[derive(Clone, Copy)]
struct Destination {
    sheet: usize,
    /// The pixel of the block's origin.
    pixel: [i64; 2],
    pigment: Pigment,
}

/// A tile in the making.
struct UnfinishedTile {
    key: InkKey,
    /// The height of the stack before the tile's block.
    height: usize,
    size: usize,
    /// The upper left corner, in pixels from the pixel of the block's origin.
    corner: [i64; 2],
    destination: Destination,
}

/// Makes and adds the tiles of a picture.
#[derive(Default)]
pub(super) struct Tiling {
    tiles: Tiles,
    /// The unfinished tiles, the innermost last.
    unfinished: Vec<UnfinishedTile>,
    /// The exponent of the unit of the tiles' sums.
    unit: i32,
    /// Whether tiles have the few places of a sketch.
    is_sketch: bool,
}

/// The result of asking for a tile.
pub(super) enum Outcome {
    /// The tile was added, in this many units of work.
    Added(u64),
    /// The tile was begun, on a sheet that was emptied in this many units of work.
    Begun(u64),
    /// The tile would be too large.
    TooLarge,
}

impl Tiling {
    /// Forgets all tiles.
    pub(super) fn clear(&mut self) {
        self.tiles.clear();
    }

    /// Takes the memory for tiles and their places from the grid of a picture. Tiles in other places are dropped.
    pub(super) fn begin(&mut self, grid: Grid) {
        self.tiles.limit(grid.chunks);
        if self.is_sketch != grid.is_sketch {
            self.is_sketch = grid.is_sketch;
            self.tiles.clear();
        }
    }

    /// Gives up the unfinished tiles.
    pub(super) fn stop(&mut self) {
        self.unfinished.clear();
    }

    /// Sets the unit of the sums, `2^exponent` layers. Tiles in another unit are dropped.
    pub(super) fn set_unit(&mut self, exponent: i32) {
        if exponent != self.unit {
            self.unit = exponent;
            self.tiles.clear();
        }
    }

    /// The height of the stack at which the innermost unfinished tile is done; 0 without one.
    pub(super) fn floor(&self) -> usize {
        self.unfinished.last().map_or(0, |tile| tile.height)
    }

    /// The size of the tile for a block; `None` if the block is drawn without a tile.
    pub(super) fn tile_size(&self, node: &Node, extent: f64, strokes: u32) -> Option<usize> {
        tile::size(extent, strokes)
            .filter(|size| size + 1 > node.canvas && (!self.tiles.crowded || extent < CROWDED_EXTENT))
    }

    /// Adds the tile of a block, if there is one. Otherwise moves the block to the sheet of a new tile.
    pub(super) fn add_or_make(
        &mut self,
        sheets: &mut Sheets,
        node: &mut Node,
        footprint: &Footprint,
        wanted: WantedTile,
    ) -> Outcome {
        let WantedTile { height, size, strokes, width, shade, pigment } = wanted;
        let Place { origin, scale, heading, .. } = node.place;
        let fine = !self.tiles.crowded && tile::is_sparse(footprint.extent, strokes);
        let (pixel, offset, rest) = tile::snap(origin, fine, self.is_sketch);
        let key = Key { block: node.block, heading, scale: opaque::scale(scale), offset, fine, width };
        let key = InkKey { key, shade: shade.map(|shade| shade.number) };
        let destination = Destination { sheet: node.canvas, pixel, pigment };
        if let Some(tile) = self.tiles.get(&key) {
            return Outcome::Added(self.add(sheets, &tile, destination));
        }
        let from_origin = [0, 1].map(|axis| footprint.centre[axis] - origin[axis] + rest[axis]);
        // A stroke adds ink to the pixels around it as well.
        let (corner, far) = opaque::area(from_origin, footprint.reach, 1);
        let planes = if shade.is_some() { 4 } else { 1 };
        if !Tiles::fits(far, planes) {
            return Outcome::TooLarge;
        }
        let emptied = sheets[1 + size].reset(far, planes, self.unit);
        node.place.origin = [0, 1].map(|axis| rest[axis] - corner[axis] as f64);
        node.canvas = 1 + size;
        if shade.is_none() {
            node.pen.shade = Shade::default();
        }
        self.unfinished.push(UnfinishedTile { key, height, size, corner, destination });
        Outcome::Begun(emptied)
    }

    /// Keeps and adds the innermost unfinished tile, if there is one. Returns the units of work.
    pub(super) fn finish(&mut self, sheets: &mut Sheets) -> Option<u64> {
        let making = self.unfinished.pop()?;
        let sheet = &sheets[1 + making.size];
        let kept = (sheet.height + sheet.values.len() / 64) as u64;
        let tile = self.tiles.insert(making.key, sheet, making.corner);
        Some(kept + self.add(sheets, &tile, making.destination))
    }

    fn add(&self, sheets: &mut Sheets, tile: &Tile, destination: Destination) -> u64 {
        let at = [0, 1].map(|axis| destination.pixel[axis] + tile.corner[axis]);
        sheets[destination.sheet].stamp(&self.tiles.stamp(tile), at, destination.pigment)
    }
}
