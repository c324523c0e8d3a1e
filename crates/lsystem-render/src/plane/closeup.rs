//! Views deeper than coordinates in `f64` reach: what lies around a segment, drawn by itself.

use super::View;
use super::exact::FittedFrame;
use super::view::{PlaneFraming, root_bounds};
use super::wide::Wide;
use crate::viewport::Viewport;
use lsystem_drawing::{Around, Drawing, Origin, exponent_of};
use std::sync::Arc;

/// The neighbourhood that is drawn reaches at least `2^MARGIN` times the longer side of the picture.
const MARGIN: i32 = 4;
/// Neighbourhoods reach to powers of `2^STEP` steps, so that one serves many views.
const STEP: i32 = 16;

/// The largest zoom of close views.
pub const MAX_ZOOM: f64 = 1e301;

/// Close views of a drawing around a place on a segment, which is the origin of views.
#[derive(Clone, Debug)]
pub struct Closeup {
    whole: Arc<Drawing>,
    /// The place.
    pub origin: Origin,
    near: Option<Near>,
}

/// The neighbourhood drawn last.
#[derive(Clone, Debug)]
struct Near {
    /// The exponent of its reach, in steps.
    reach: i32,
    /// Its middle from the origin, in units of the whole drawing's root block.
    middle: [f64; 2],
    around: Arc<Around>,
}

impl Closeup {
    /// Views around a place.
    #[must_use]
    pub fn new(whole: Arc<Drawing>, origin: Origin) -> Self {
        Self { whole, origin, near: None }
    }

    /// A close-up and the view that shows one step of the turtle as `share` of the fitted side of a picture; `None` as for
    /// [`Closeup::show`].
    #[must_use]
    pub fn on_step(whole: Arc<Drawing>, origin: Origin, share: f64) -> Option<(Self, View)> {
        let mut new = Self::new(whole, origin);
        new.show(Viewport { width: 1, height: 1, ratio: 1.0 }, View::default())?;
        let zoom = libm::scalbn(share * root_bounds(&new.whole).1.longer_side(), exponent(&new.whole));
        Some((new, View { zoom: zoom.clamp(1.0, MAX_ZOOM), ..View::default() }))
    }

    /// The drawing and its view that show what `view` shows of the whole drawing. The view's zoom and coordinates are
    /// relative to the fitted whole, from the origin. `None` if there is no such segment, or if
    /// the drawing cannot be seen this way: only shared drawings in the plane can.
    pub fn show(&mut self, viewport: Viewport, view: View) -> Option<(Arc<Around>, View)> {
        let outer = PlaneFraming::of_root(&self.whole);
        let zoom = if view.zoom.is_normal() && view.zoom > 0.0 { view.zoom } else { 1.0 };
        // Pixels in a unit of the root block.
        let pixels = outer.scale(viewport) * zoom;
        let window = f64::from(viewport.width.max(viewport.height)) / pixels;
        let size = exponent_of(window).saturating_add(exponent(&self.whole));
        let reach = ((size + MARGIN).div_euclid(STEP) + 1) * STEP;
        let side = root_bounds(&self.whole).1.longer_side();
        let at = [view.x + view.fine[0], view.y + view.fine[1]].map(|v| v * side);
        let is_inside = |near: &Near| {
            let most = libm::scalbn(0.5, reach - exponent(&self.whole));
            near.reach == reach && (0..2).all(|axis| (at[axis] - near.middle[axis]).abs() < most)
        };
        if !self.near.as_ref().is_some_and(is_inside) {
            let around = Arc::new(self.whole.around(&self.origin, at, reach)?);
            self.near = Some(Near { reach, middle: at, around });
        }
        let Near { middle, around, .. } = self.near.as_ref()?;
        let (inner, ratio) = (PlaneFraming::of_root(&around.drawing), self.ratio(around));
        let (_, bounds) = root_bounds(&around.drawing);
        let [x, y] = bounds.centre().map(|centre| -centre / bounds.longer_side());
        let fine = [0, 1].map(|axis| libm::scalbn(at[axis] - middle[axis], ratio) / bounds.longer_side());
        let zoom = libm::scalbn(pixels, -ratio) / inner.scale(viewport);
        Some((around.clone(), View { x, y, zoom, fine }))
    }

    /// The origin in the fitted whole, as in [`fitted_ends`](crate::fitted_ends), once something is shown.
    #[must_use]
    pub fn place(&self) -> Option<[f64; 4]> {
        let [x, y, fine_x, fine_y] = self.near.as_ref()?.around.start;
        Some(FittedFrame::new(&self.whole).fit([Wide::sum(x, fine_x), Wide::sum(y, fine_y)]))
    }

    /// A place in the fitted neighbourhood as one right of the origin and above it, in extents of the fitted
    /// whole.
    #[must_use]
    pub fn outside(&self, [x, y, fine_x, fine_y]: [f64; 4]) -> Option<[f64; 4]> {
        let Near { middle, around, .. } = self.near.as_ref()?;
        let (_, bounds) = root_bounds(&around.drawing);
        let (centre, inner) = (bounds.centre(), bounds.longer_side());
        let side = root_bounds(&self.whole).1.longer_side();
        let out = |v: f64, fine: f64, axis: usize| {
            let [place, _] = Wide::product(v, inner).plus(fine * inner).plus(centre[axis]).parts();
            Wide::sum(middle[axis], libm::scalbn(place, -self.ratio(around))).over(side).parts()
        };
        let ([x, fine_x], [y, fine_y]) = (out(x, fine_x, 0), out(y, fine_y, 1));
        Some([x, y, fine_x, fine_y])
    }

    /// The exponent of a unit of the whole in units of a neighbourhood.
    fn ratio(&self, near: &Around) -> i32 {
        exponent(&self.whole) - exponent(&near.drawing)
    }
}

/// The exponent of the root block.
fn exponent(drawing: &Drawing) -> i32 {
    drawing.root.map_or(0, |root| drawing.blocks[root.0 as usize].exponent)
}

/// A place in the fitted view, right of another one and above it; both as in [`fitted_ends`](crate::fitted_ends).
#[must_use]
pub fn seen_from([x0, y0, fine_x0, fine_y0]: [f64; 4], [x, y, fine_x, fine_y]: [f64; 4]) -> [f64; 4] {
    let [x, fine_x] = Wide::sum(x, -x0).plus(fine_x - fine_x0).parts();
    let [y, fine_y] = Wide::sum(y, -y0).plus(fine_y - fine_y0).parts();
    [x, y, fine_x, fine_y]
}

#[cfg(test)]
mod tests {
    use super::super::tests::{difference, hard, picture};
    use super::super::{fitted_ends, fitted_scale};
    use super::*;
    use crate::Renderer;
    use lsystem_base::fixed::Fixed;
    use lsystem_syntax::{ColourBy, Style};

    const VIEWPORT: Viewport = Viewport { width: 320, height: 200, ratio: 1.0 };

    /// A close-up shows what the usual view shows at the same place, as long as that is exact.
    #[test]
    fn a_closeup_is_the_usual_picture() {
        let style = Style { colour_by: ColourBy::Single, ..Style::default() };
        for (name, sample) in hard() {
            let drawing = Arc::new(sample.draw(if name == "dragon" { 24 } else { 9 }));
            let count = drawing.segment_count();
            for (part, zoom) in [(0.3, 1.0), (0.41, 7.0), (0.77, 60.0), (0.12, 300.0)] {
                let number = (part * count as f64) as u64;
                let [[x, y, fx, fy], _] = fitted_ends(&drawing, number.into()).unwrap();
                let aside = 20.0 / (fitted_scale(&drawing, VIEWPORT) * zoom);
                let usual = View { x: x + aside, y, zoom, fine: [fx, fy] };
                let mut closeup = Closeup::new(drawing.clone(), Fixed::units(number.into()).into());
                let own = View { x: aside, y: 0.0, zoom, fine: [0.0; 2] };
                let (near, view) = closeup.show(VIEWPORT, own).unwrap();
                // The place of the segment, and of its end as the neighbourhood has it.
                let [start, end] = fitted_ends(&drawing, number.into()).unwrap();
                let off = |a: [f64; 4], b: [f64; 4]| seen_from(a, b).map(f64::abs).iter().sum::<f64>();
                assert!(off(closeup.place().unwrap(), start) < 1e-15, "{name}");
                let mut before = 0;
                let inside = near.drawing.items_of(near.drawing.root.unwrap()).iter().find_map(|item| {
                    let all = near.drawing.segments_in(item);
                    let first: u64 = near.number_of(before).unwrap().decimal().parse().unwrap();
                    before += all;
                    number
                        .checked_sub(first)
                        .map(u128::from)
                        .filter(|&within| within < all)
                        .map(|within| before - all + within)
                });
                let Some(local) = inside else { panic!("{name}: the segment is not near itself") };
                let [_, to] = fitted_ends(&near.drawing, local).unwrap();
                assert!(off(closeup.outside(to).unwrap(), seen_from(start, end)) < 1e-13, "{name}");
                let [mut a, mut b] = [Renderer::new(), Renderer::new()];
                a.load(drawing.clone());
                b.load(near.drawing.clone());
                picture(&mut a, &style, VIEWPORT, usual);
                picture(&mut b, &style, VIEWPORT, view);
                let (mean, worst) = difference(a.pixels(), b.pixels(), 320);
                // Tiles snap to a part of a subsample, and shades of crowds are sums in another order.
                assert!(mean < 1.0 && worst < 24.0, "{name} {zoom}: {mean} {worst}");
            }
        }
    }

    /// At the greatest magnification the segment goes through the middle of the picture, and the next one joins it.
    #[test]
    fn a_segment_fills_the_picture() {
        let style = Style { colour_by: ColourBy::Single, ..Style::default() };
        for (name, sample) in hard().into_iter().filter(|(name, _)| *name == "koch" || *name == "gosper") {
            let drawing = Arc::new(sample.draw(1000));
            let half = drawing.exact_count().shifted(-1);
            let mut closeup = Closeup::new(drawing.clone(), half.into());
            for zoom in [1e20, 1e100, 1e290] {
                let (near, view) = closeup.show(VIEWPORT, View { zoom, ..View::default() }).unwrap();
                let mut renderer = Renderer::new();
                renderer.load(near.drawing.clone());
                picture(&mut renderer, &style, VIEWPORT, view);
                let ink = |x: usize, y: usize| renderer.pixels()[4 * (y * 320 + x)] != style.background.rgb[0];
                let near = (156..=164).flat_map(|x| (96..=104).map(move |y| (x, y))).filter(|&(x, y)| ink(x, y));
                assert!(near.count() > 4, "{name} {zoom}");
            }
        }
    }

    #[test]
    fn there_is_no_closeup_without_the_segment() {
        let (_, sample) = hard().swap_remove(0);
        let drawing = Arc::new(sample.draw(3));
        let none = Closeup::new(drawing.clone(), drawing.exact_count().into()).show(VIEWPORT, View::default());
        assert!(none.is_none());
    }
}
