use super::*;
use crate::Renderer;
use crate::plane::fitted_ends;
use crate::plane::sample::Sample;
use crate::plane::tests::{difference, hard, picture};
use lsystem_base::Progress;
use lsystem_syntax::Ink;
use test_effort::sampled;

const SIDE: u32 = 64;

fn pyramid(sample: &Sample, n: u32, ink: Ink) -> Arc<Pyramid> {
    let style = Style { ink, ..sample.0.style.clone() };
    Arc::new(Pyramid::new(Arc::new(sample.draw(n)), style, SIDE))
}

fn made(renderer: &mut TileRenderer, tile: TilePlace) -> Vec<u8> {
    renderer.begin(tile);
    while renderer.step(10_000) == Progress::More {}
    renderer.pixels().to_vec()
}

fn all(level: u32) -> impl Iterator<Item = TilePlace> {
    (0..1_u64 << level).flat_map(move |y| (0..1 << level).map(move |x| TilePlace { level, x, y }))
}

#[test]
fn places_of_tiles() {
    let tile = TilePlace::new(3, 5, 2).unwrap();
    assert_eq!(tile.above(1), TilePlace { level: 1, x: 1, y: 0 });
    assert_eq!(tile.above(7), tile);
    assert!(tile.below().iter().all(|below| below.level == 4 && below.above(3) == tile));
    assert!(TilePlace::new(3, 8, 0).is_none() && TilePlace::new(61, 0, 0).is_none());
    assert!(TilePlace::new(60, (1 << 60) - 1, 0).is_some());
}

#[test]
fn no_tile_with_ink_is_left_out() {
    let mut without = 0;
    for (name, sample) in hard() {
        for n in [4, 30] {
            let pyramid = pyramid(&sample, n, Ink::Solid);
            let found: Vec<_> = pyramid.tiles(3, TilePlace::WHOLE, |_| true).collect();
            without += 64 - found.len();
            let mut renderer = TileRenderer::new(pyramid.clone(), false);
            for tile in all(3).filter(|tile| !found.contains(tile)) {
                made(&mut renderer, tile);
                assert!(renderer.is_blank(), "{name} {n} {tile:?}");
            }
            assert!(found.iter().all(|tile| pyramid.may_have_ink(*tile)));
        }
    }
    assert!(without > 100, "{without}");
}

#[test]
fn tiles_make_the_picture_of_their_level() {
    for (name, sample) in hard() {
        let pyramid = pyramid(&sample, 6, Ink::Solid);
        let mut renderer = TileRenderer::new(pyramid.clone(), false);
        let width = 4 * SIDE as usize;
        let mut joined = vec![0; 4 * width * width];
        for tile in all(2) {
            let pixels = made(&mut renderer, tile);
            for (y, row) in pixels.chunks(4 * SIDE as usize).enumerate() {
                let at = 4 * ((tile.y as usize * SIDE as usize + y) * width + tile.x as usize * SIDE as usize);
                joined[at..at + row.len()].copy_from_slice(row);
            }
        }
        let mut whole = Renderer::light();
        whole.load(pyramid.drawing.clone());
        let viewport = Viewport { width: 4 * SIDE, height: 4 * SIDE, ratio: 1.0 };
        picture(&mut whole, &pyramid.style, viewport, View::default());
        // Stamped parts are off by a quarter of a subsample, in other places in a tile than in the whole picture.
        let (mean, worst) = difference(&joined, whole.pixels(), width);
        assert!(mean < 1.0 && worst < 16.0, "{name}: {mean} {worst}");
    }
}

#[test]
fn tiles_do_not_depend_on_each_other() {
    for (name, sample) in sampled(hard(), 3, 0) {
        for ink in Ink::ALL {
            let pyramid = pyramid(&sample, 12, ink);
            let tiles: Vec<_> = all(2).chain(all(1)).collect();
            let mut one = TileRenderer::new(pyramid.clone(), false);
            let forwards: Vec<_> = tiles.iter().map(|tile| made(&mut one, *tile)).collect();
            for (tile, pixels) in tiles.iter().zip(&forwards).rev().step_by(3) {
                let alone = made(&mut TileRenderer::new(pyramid.clone(), false), *tile);
                assert!(alone == *pixels, "{name} {ink:?} {tile:?}");
            }
            let mut other = TileRenderer::new(pyramid, false);
            for (tile, pixels) in tiles.iter().zip(&forwards).rev() {
                assert!(made(&mut other, *tile) == *pixels, "{name} {ink:?} {tile:?}");
            }
        }
    }
}

#[test]
fn the_deepest_level_has_single_segments() {
    // 3^40 steps across: a segment takes 6 pixels of a tile at level 60.
    let sample = Sample::abop("F", &[('F', "F+F--F+F")], 60.0);
    let pyramid = pyramid(&sample, 40, Ink::Solid);
    let mut renderer = TileRenderer::new(pyramid.clone(), false);
    // The last segments are left out: bounds are rounded to 2^-53 of the drawing, 128 tiles, so that the outermost ink of
    // this level may be lost.
    for number in [0, 1 << 70, (1 << 79) + 12_345, (1 << 80) - (1 << 30)] {
        let [[x, y, fine_x, fine_y], end] = fitted_ends(&pyramid.drawing, number).unwrap();
        // The place in tiles of the deepest level.
        let tiles = |at: f64, fine: f64| {
            let [high, low] =
                Wide::sum(at, fine).over(pyramid.span).plus(0.5).parts().map(|part| libm::scalbn(part, 60));
            let floor = high as i128 + i128::from(libm::floor(low) as i64);
            (floor as u64, low - libm::floor(low))
        };
        let ((column, across), (row, down)) = (tiles(x, fine_x), tiles(-y, -fine_y));
        let tile = TilePlace::new(60, column, row).unwrap();
        assert_eq!(pyramid.tiles(60, tile, |_| true).collect::<Vec<_>>(), [tile]);
        let pixels = made(&mut renderer, tile);
        let pixel = [across, down].map(|part| ((part * f64::from(SIDE)) as usize).min(SIDE as usize - 1));
        let at = 4 * (pixel[1] * SIDE as usize + pixel[0]);
        let background = pyramid.style.background.rgb;
        assert!(pixels[at..at + 3] != background, "{number}: the segment begins in this pixel");
        assert!(!renderer.is_blank() && pixels.chunks(4).filter(|p| p[..3] == background).count() > 2000);
        assert!(((end[0] - x) + (end[2] - fine_x)).abs() < 1e-18);
    }
}

#[test]
fn parts_share_all_tiles() {
    for of in [1, 2, 3, 7, 64, 1000] {
        let parts: Vec<_> = (0..of).map(|part| TileShare::new(part, of).unwrap()).collect();
        for tile in all(5).chain(all(2)).chain(all(0)) {
            let owners: Vec<_> = parts.iter().filter(|part| part.has(tile)).collect();
            assert_eq!(owners.len(), 1, "{of} {tile:?}");
            assert!((0..=tile.level).all(|level| owners[0].leads_on(tile.above(level))));
        }
    }
    // Parts are about equal where there are enough tiles.
    let parts: Vec<_> = (0..5).map(|part| TileShare::new(part, 5).unwrap()).collect();
    let counts: Vec<_> = parts.iter().map(|part| all(7).filter(|tile| part.has(*tile)).count()).collect();
    assert!(counts.iter().all(|count| (2500..4000).contains(count)), "{counts:?}");
    assert!(TileShare::new(5, 5).is_none() && TileShare::new(0, 0).is_none());
}
