//! Pyramids of tiles: square pictures of a drawing, each twice as large as the one before, cut into tiles of one size.
//!
//! A tile is a picture of its own, made from the graph and the tile's place. It does not depend on other tiles, so many
//! processes can share the tiles of a pyramid, and a tile has the same pixels whoever makes it.
//!
//! Tiles are made top-down. The places of strokes are exact, as in the deepest view, so tiles fit together. A tile that
//! takes more than 1,000,000 steps leaves out fine detail, as [`RenderStats::outlines`](crate::RenderStats) counts.
//!
//! Ink that adds up needs one tone for all tiles of a level: the tone of a fixed sample of the level's tiles.

mod finder;
mod share;
mod tile_renderer;

pub use finder::Tiles;
pub use share::TileShare;
pub use tile_renderer::TileRenderer;

use super::shape::Shapes;
use super::view::{View, fitted_scale};
use super::wide::Wide;
use crate::viewport::Viewport;
use finder::Finder;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::Drawing;
use lsystem_syntax::Style;
use std::sync::Arc;

/// A tile of a pyramid. The picture of a level has 2^level tiles each way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TilePlace {
    /// The level: the single tile of level 0 shows the whole drawing. At most [`TilePlace::MAX_LEVEL`].
    pub level: u32,
    /// The column, from the left.
    pub x: u64,
    /// The row, from the top.
    pub y: u64,
}

impl TilePlace {
    /// The only tile of level 0.
    pub const WHOLE: Self = Self { level: 0, x: 0, y: 0 };

    /// The deepest level. The place of a tile is known to 2^-106 of the picture, so down to this level to less than a
    /// billionth of a pixel. A stroke that is more than 2^30 tiles long may be off by a pixel.
    pub const MAX_LEVEL: u32 = 60;

    /// The tile with this place; `None` if the level is too deep or has no such tile.
    #[must_use]
    pub fn new(level: u32, x: u64, y: u64) -> Option<Self> {
        let is_inside = level <= Self::MAX_LEVEL && x >> level == 0 && y >> level == 0;
        is_inside.then_some(Self { level, x, y })
    }

    /// The tile that shows this tile's place at a level above; the tile itself at other levels.
    #[must_use]
    pub fn above(self, level: u32) -> Self {
        let levels = self.level.saturating_sub(level);
        Self { level: self.level - levels, x: self.x >> levels, y: self.y >> levels }
    }

    /// The four tiles of the next level that show this tile's place.
    #[must_use]
    pub fn below(self) -> [Self; 4] {
        let Self { level, x, y } = self;
        [[0, 0], [1, 0], [0, 1], [1, 1]].map(|[dx, dy]| Self { level: level + 1, x: 2 * x + dx, y: 2 * y + dy })
    }
}

/// The pyramid of a drawing: the places of its tiles, and which of them may have ink.
#[derive(Debug)]
pub struct Pyramid {
    drawing: Arc<Drawing>,
    style: Style,
    shapes: Shapes,
    /// Pixels along the side of a tile.
    side: u32,
    /// The side of level 0, in fitted extents.
    span: f64,
}

impl Pyramid {
    /// The pyramid with tiles of `side` x `side` pixels. Takes as long as there are blocks in the drawing.
    #[must_use]
    pub fn new(drawing: Arc<Drawing>, style: Style, side: u32) -> Self {
        let mut shapes = Shapes::default();
        while shapes.step(&drawing, &mut Meter::new(u64::MAX)) == Progress::More {}
        let viewport = Viewport { width: side, height: side, ratio: 1.0 };
        let span = f64::from(side) / fitted_scale(&drawing, viewport);
        Self { drawing, style, shapes, side, span: if span.is_finite() { span } else { 1.0 } }
    }

    /// The size of a tile's picture.
    #[must_use]
    pub fn viewport(&self) -> Viewport {
        Viewport { width: self.side, height: self.side, ratio: 1.0 }
    }

    /// The view that a tile's picture shows.
    #[must_use]
    pub fn view(&self, tile: TilePlace) -> View {
        let [x, y] = [tile.x, tile.y].map(|at| {
            // From the picture's middle to the tile's, in halves of a tile.
            let halves = 2 * i128::from(at) + 1 - (1 << tile.level);
            let high = halves as f64;
            let low = (halves - high as i128) as f64;
            let unit = self.span * libm::scalbn(0.5, -(tile.level as i32));
            Wide::product(high, unit).plus_wide(Wide::product(low, unit)).parts()
        });
        View { x: x[0], y: -y[0], zoom: libm::scalbn(1.0, tile.level as i32), fine: [x[1], -y[1]] }
    }

    /// Whether a tile may have ink, by the extents of the drawing's blocks. Where many blocks lie around an empty tile,
    /// the answer may be yes.
    #[must_use]
    pub fn may_have_ink(&self, tile: TilePlace) -> bool {
        Finder::new().may_have_ink(self, tile)
    }

    /// The tiles of a level that may have ink, among those below `top`, in the order of a depth-first way. Of a tile
    /// that `wanted` refuses, no tile below is looked at.
    pub fn tiles<F: Fn(TilePlace) -> bool>(&self, level: u32, top: TilePlace, wanted: F) -> Tiles<'_, F> {
        Tiles::new(self, level, top, wanted)
    }

    /// Some tiles of a level that may have ink, spread over the drawing: all, or at most 16.
    fn sample(&self, level: u32) -> Vec<TilePlace> {
        const MAX: usize = 16;
        let mut finder = Finder::of_sample();
        let mut tiles = vec![TilePlace::WHOLE];
        for _ in 0..level {
            tiles = tiles.iter().flat_map(|tile| tile.below()).collect();
            tiles.retain(|tile| finder.may_have_ink(self, *tile));
            let all = tiles.len();
            if all > MAX {
                tiles = (0..MAX).map(|at| tiles[at * all / MAX]).collect();
            }
        }
        tiles
    }
}

#[cfg(test)]
mod tests;
