//! Blocks drawn once, as tiles, and added wherever they recur.

use super::sheet::{Pigment, Sheet};
use super::tile::{self, InkKey, SIZES, Tile, Tiles};
use crate::plane::descent::{Node, Place};
use crate::plane::inks::Shade;
use crate::plane::top_down::tile::{self as opaque, Key};

/// The largest extent, in pixels, of tiles that are still made when there is no room for all.
const CROWDED: f64 = 20.0;

/// The picture, then a sheet for each size of tile.
pub(super) type Sheets = [Sheet; 1 + SIZES];

/// Where a block is on its sheet, in pixels.
pub(super) struct Seen {
    /// The middle of its bounds.
    pub centre: [f64; 2],
    /// How far it reaches from there, across and down.
    pub reach: [f64; 2],
    /// The width of its widest stroke.
    pub width: f64,
    /// The longer side of its bounds.
    pub extent: f64,
}

/// How a tile is added to a sheet.
#[derive(Clone, Copy)]
struct Target {
    sheet: usize,
    /// The pixel of the block's origin.
    pixel: [i64; 2],
    pigment: Pigment,
}

/// A tile being made.
struct Making {
    key: InkKey,
    /// The stack's height before.
    height: usize,
    size: usize,
    /// From the pixel of the origin to the tile's upper left corner.
    corner: [i64; 2],
    target: Target,
}

/// Makes and adds the tiles of a picture.
#[derive(Default)]
pub(super) struct Tiling {
    tiles: Tiles,
    /// The tiles in the making, the innermost last.
    making: Vec<Making>,
    /// The exponent of the unit of their sums.
    unit: i32,
}

/// What became of a tile.
pub(super) enum Outcome {
    /// It was added, in so many units of work.
    Added(u64),
    /// It is being made, on a sheet that was emptied in so many units of work.
    Begun(u64),
    /// It would be too large.
    TooLarge,
}

impl Tiling {
    /// Forgets all tiles.
    pub(super) fn clear(&mut self) {
        self.tiles.clear();
    }

    /// Gives up the tiles in the making.
    pub(super) fn stop(&mut self) {
        self.making.clear();
    }

    /// Takes the unit of a picture. Tiles of another are of no use.
    pub(super) fn set_unit(&mut self, exponent: i32) {
        if exponent != self.unit {
            self.unit = exponent;
            self.tiles.clear();
        }
    }

    /// The height of the stack at which the innermost tile in the making is done.
    pub(super) fn floor(&self) -> usize {
        self.making.last().map_or(0, |making| making.height)
    }

    /// The size of the tile for a block of so many strokes, if it should have one.
    pub(super) fn tile_size(&self, node: &Node, extent: f64, strokes: u32) -> Option<usize> {
        tile::size(extent, strokes).filter(|size| size + 1 > node.canvas && (!self.tiles.crowded || extent < CROWDED))
    }

    /// Adds the tile of a block if there is one. Otherwise moves the block to the sheet where the tile is made until the
    /// stack has its present `height` again. The tile has the pigments of its block where it is entered with a `shade`.
    pub(super) fn add_or_make(
        &mut self,
        sheets: &mut Sheets,
        (node, height, size): (&mut Node, usize, usize),
        seen: &Seen,
        (strokes, width): (u32, Option<u64>),
        (shade, pigment): (Option<Shade>, Pigment),
    ) -> Outcome {
        let Place { origin, scale, heading, .. } = node.place;
        let fine = !self.tiles.crowded && tile::is_sparse(seen.extent, strokes);
        let (pixel, offset, rest) = tile::snap(origin, fine);
        let key = Key { block: node.block, heading, scale: opaque::scale(scale), offset, fine, width };
        let key = InkKey { key, shade: shade.map(|shade| shade.number) };
        let target = Target { sheet: node.canvas, pixel, pigment };
        if let Some(tile) = self.tiles.get(&key) {
            return Outcome::Added(self.add(sheets, &tile, target));
        }
        let from_origin = [0, 1].map(|axis| seen.centre[axis] - origin[axis] + rest[axis]);
        // A stroke adds ink to all pixels around it.
        let corner = [0, 1].map(|axis| (from_origin[axis] - seen.reach[axis]).floor() as i64 - 1);
        let far = [0, 1].map(|axis| (from_origin[axis] + seen.reach[axis]).ceil() as i64 + 1 - corner[axis]);
        let far = far.map(|side| side.max(1) as usize);
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
        self.making.push(Making { key, height, size, corner, target });
        Outcome::Begun(emptied)
    }

    /// Keeps and adds the innermost tile in the making, if there is one; the units of work that this took.
    pub(super) fn finish(&mut self, sheets: &mut Sheets) -> Option<u64> {
        let making = self.making.pop()?;
        let sheet = &sheets[1 + making.size];
        let kept = (sheet.height + sheet.values.len() / 64) as u64;
        let tile = self.tiles.insert(making.key, sheet, making.corner);
        Some(kept + self.add(sheets, &tile, making.target))
    }

    fn add(&self, sheets: &mut Sheets, tile: &Tile, target: Target) -> u64 {
        let at = [0, 1].map(|axis| target.pixel[axis] + tile.corner[axis]);
        sheets[target.sheet].stamp(&self.tiles.stamp(tile), at, target.pigment)
    }
}
