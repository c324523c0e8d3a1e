//! The memory that a picture takes, computed before the picture is made.

use super::Renderer;
use super::bottom_up::PART_WORDS;
use super::density::tile_bytes;
use super::seen::SEEN_BYTES;
use super::shape::Shape;
use super::top_down::tile::TILE_BYTES;
use crate::ink::{Grid, TONE_BYTES};
use crate::viewport::{Detail, Viewport};
use lsystem_drawing::Drawing;
use lsystem_syntax::{ColourSource, Ink, Style};

/// The bytes of all lists without a limit of their own: the stack of nodes, the polygon being filled.
const LISTS: u64 = 2 << 20;

impl Renderer {
    /// The most bytes that a renderer takes for pictures of this size in this detail, without the drawing. Only rich
    /// drawings fill the share of the tiles and parts.
    #[must_use]
    pub fn most_bytes(drawing: &Drawing, style: &Style, viewport: Viewport, detail: Detail) -> u64 {
        let pixels = 4 * u64::from(viewport.width) * u64::from(viewport.height);
        let facts = (drawing.block_count() * size_of::<Shape>()) as u64;
        let own = match style.ink {
            Ink::Solid => facts + opaque(style, viewport, detail),
            Ink::Density => 2 * facts + density(Ink::Density, colours(style), viewport, detail),
            Ink::Auto => 3 * facts + opaque(style, viewport, detail) + density(Ink::Auto, 1, viewport, detail),
        };
        own + LISTS + pixels
    }
}

fn opaque(style: &Style, viewport: Viewport, detail: Detail) -> u64 {
    let samples = detail.samples() as u64;
    // One bit plane marks the covered subsamples; each binary digit of a colour's number has one more.
    let planes = 1 + u64::from(usize::BITS - colours(style).saturating_sub(1).leading_zeros());
    let columns = (u64::from(viewport.width) * samples).next_multiple_of(64);
    let rows = (u64::from(viewport.height) * samples).next_multiple_of(64);
    // The state of each group of subsamples takes an eighth of a plane more.
    let bits = columns * rows / 8;
    let frame = bits * planes + bits / 8;
    let parts = if detail == Detail::Fine { 8 * PART_WORDS } else { 0 };
    // The parts take the memory of the tiles.
    frame + TILE_BYTES.max(parts) + SEEN_BYTES
}

fn density(ink: Ink, colours: usize, viewport: Viewport, detail: Detail) -> u64 {
    let grid = Grid::new(ink, viewport, detail);
    let [width, height] = grid.size([viewport.width, viewport.height]);
    let sums = width as u64 * height as u64;
    let numbers = if colours > 1 { 4 } else { 1 };
    4 * numbers * sums + tile_bytes(grid.chunks) + TONE_BYTES
}

/// The number of colours in use.
fn colours(style: &Style) -> usize {
    match style.colour_by.source() {
        ColourSource::Constant => 1,
        ColourSource::Index | ColourSource::Level | ColourSource::Along | ColourSource::Ink => style.palette.len(),
    }
}
