//! Pyramids of tiles: a tile does not depend on the tiles before it or on the size of steps, blank places are known, and
//! workers share all tiles.

use super::drawing::random_drawing;
use crate::gauge::WORK;
use crate::{Gauge, Source, make};
use lsystem::render::{Pyramid, TilePlace, TileRenderer, TileShare};
use std::sync::Arc;

/// The most work of a tile in this target.
const MAX_WORK: usize = 100 * WORK;

/// Some tiles of one pyramid.
pub(super) fn tiles(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((_, system, drawing)) = random_drawing(source, gauge) else { return };
    let style = if source.once_in(3) { make::style(source) } else { system.style.clone() };
    let side = source.pick(&[1, 2, 7, 16, 64, 128]);
    let is_transparent = source.once_in(2);
    gauge.allow(128 * (side * side) as usize);
    let pyramid = Arc::new(gauge.call("pyramid", || Pyramid::new(drawing, style, side)));
    let mut renderer = TileRenderer::new(pyramid.clone(), is_transparent);
    for _ in 0..source.between(1, 4) {
        let tile = place(source);
        shared(source, tile);
        let Some(picture) = made(&mut renderer, tile, WORK, gauge) else { return gauge.reach("long") };
        let other = source.pick(&[300, 3_000, WORK]);
        let mut fresh = TileRenderer::new(pyramid.clone(), is_transparent);
        let Some(again) = made(&mut fresh, tile, other, gauge) else { return gauge.reach("long") };
        assert_eq!(picture, again, "{tile:?} after other tiles and alone, in steps of {other}");
        let is_inked = gauge.call("may_have_ink", || pyramid.may_have_ink(tile));
        gauge.reach(if renderer.is_blank() { "blank" } else { "ink" });
        assert!(is_inked || renderer.is_blank(), "{tile:?} has ink");
    }
}

/// A tile at any level; mostly one that shows the middle or a corner.
fn place(source: &mut Source<'_>) -> TilePlace {
    let level = source.pick(&[0, 1, 2, 3, 5, 8, 20, 40, TilePlace::MAX_LEVEL]);
    let last = (1_u64 << level) - 1;
    let mut along = || match source.below(4) {
        0 => 0,
        1 => last,
        2 => last / 2,
        _ => (u64::from(source.word()) << 32 | u64::from(source.word())) & last,
    };
    TilePlace { level, x: along(), y: along() }
}

/// Checks that exactly one of several workers has the tile, and that it looks at all tiles above.
fn shared(source: &mut Source<'_>, tile: TilePlace) {
    let of = source.pick(&[1, 2, 3, 16, 1000]);
    let parts: Vec<TileShare> =
        (0..of).filter_map(|part| TileShare::new(part, of)).filter(|share| share.has(tile)).collect();
    let [share] = parts[..] else { panic!("{tile:?} belongs to {} of {of} workers", parts.len()) };
    assert!((0..=tile.level).all(|level| share.leads_on(tile.above(level))), "{tile:?} is not found");
}

/// The tile's picture, made in steps; `None` if it takes too many.
fn made(renderer: &mut TileRenderer, tile: TilePlace, work: usize, gauge: &mut Gauge) -> Option<Vec<u8>> {
    gauge.call("begin", || renderer.begin(tile));
    for _ in 0..MAX_WORK / work {
        if gauge.call("tile", || renderer.step(work)) == lsystem::Progress::Done {
            return Some(renderer.pixels().to_vec());
        }
    }
    None
}
