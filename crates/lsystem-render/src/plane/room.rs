//! The memory that pictures take, known before they are made.

use super::bottom_up::ROOM;
use super::density::DENSITY_TILES;
use super::seen::SEEN;
use super::shape::Shape;
use super::top_down::tile::TILES;
use super::{Detail, Renderer, Viewport};
use lsystem_drawing::Drawing;
use lsystem_syntax::{ColourBy, Ink, Style};

/// Lists of nodes that are looked into, polygons in hand and the like.
const LISTS: u64 = 2 << 20;

impl Renderer {
    /// The most bytes that a renderer takes which makes pictures of this size in this detail, beside the drawing. Tiles
    /// and parts take most of them only where the drawing is rich.
    #[must_use]
    pub fn most_bytes(drawing: &Drawing, style: &Style, viewport: Viewport, detail: Detail) -> u64 {
        let facts = (drawing.block_count() * size_of::<Shape>()) as u64;
        let own = match style.ink {
            Ink::Solid => facts + opaque(style, viewport, detail),
            Ink::Density => 2 * facts + density(style, viewport, detail),
        };
        own + LISTS + 4 * u64::from(viewport.width) * u64::from(viewport.height)
    }
}

fn opaque(style: &Style, viewport: Viewport, detail: Detail) -> u64 {
    let samples = detail.samples() as u64;
    // One bit plane for what is covered, and one for each digit of a colour's number.
    let planes = 1 + u64::from(usize::BITS - colours(style).saturating_sub(1).leading_zeros());
    let columns = (u64::from(viewport.width) * samples).next_multiple_of(64);
    let rows = (u64::from(viewport.height) * samples).next_multiple_of(64);
    // An eighth more for how groups of subsamples are covered.
    let bits = columns * rows / 8;
    let frame = bits * planes + bits / 8;
    let parts = if detail == Detail::Fine { 8 * ROOM } else { 0 };
    frame + TILES + parts + SEEN
}

fn density(style: &Style, viewport: Viewport, detail: Detail) -> u64 {
    let side = if detail == Detail::Coarse { super::density::COARSE as u64 } else { 1 };
    let sums = u64::from(viewport.width).div_ceil(side) * u64::from(viewport.height).div_ceil(side);
    let numbers = if colours(style) > 1 { 4 } else { 1 };
    4 * numbers * sums + DENSITY_TILES
}

/// The colours in use.
fn colours(style: &Style) -> usize {
    if style.colour_by == ColourBy::Single { 1 } else { style.palette.len() }
}
