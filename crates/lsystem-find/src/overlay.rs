//! A drawing laid on a picture: how much of the ink agrees, whether both are the same, and where they differ.

use crate::hull::Fit;
use crate::picture::{LOOSE, Picture};
use crate::strokes::{Laid, Strokes};
use lsystem_base::Limits;
use lsystem_drawing::{Plane, System, draw};
use lsystem_syntax::Definition;

pub use lsystem_render::mask::SIDE;

/// The most segments of a drawing that is laid on a picture.
pub(crate) const MAX_SEGMENTS: u64 = 200_000;
/// The limits of such a drawing.
pub(crate) const LIMITS: Limits =
    Limits { symbols: 2_000_000, modules: 2_000_000, segments: 400_000, work: 4_000_000, memory: 128 << 20 };
/// The least agreement of a system that counts as found: it draws the picture or nearly so.
pub const FOUND: f64 = 0.985;
/// The agreement of drawings that are not the same is at most this.
pub(crate) const NOT_THE_SAME: f64 = 1.0 - f64::EPSILON;
/// The sides of the box around a drawing differ from that of the picture by at most this many pixels.
const OTHER_BOX: f64 = 6.0;
/// The same limit for drawings by hand: a tenth of the side of the picture, in pixels.
const BY_HAND: f64 = SIDE as f64 / 10.0;
/// The heading of coordinates in the plane: its cosine and its sine.
const RIGHT: (f64, f64) = (1.0, 0.0);

/// A drawing laid on a picture.
pub(crate) struct Overlay {
    strokes: Strokes,
    laid: Laid,
    /// As [`judged`].
    pub(crate) agreement: f64,
    /// In systems that are unlike the picture.
    pub(crate) work: u64,
}

impl Overlay {
    /// The drawing of a system after `n` steps. `None` if it has no strokes, too many of them, or filled shapes, or if its
    /// box has another shape than that of the picture. If the shape is as near as that of a drawing by hand, it is only laid
    /// on the picture by the middles of both.
    pub(crate) fn of(system: &System, n: u32, picture: &Picture) -> Option<Self> {
        let looser = if picture.is_photograph { 2.0 * f64::from(LOOSE) } else { 0.0 };
        Self::close(system, n, picture, OTHER_BOX + looser)
    }

    /// As [`Overlay::of`]. The sides of boxes of the same shape differ by at most `most` pixels.
    fn close(system: &System, n: u32, picture: &Picture, most: f64) -> Option<Self> {
        let drawing = draw::<Plane>(system, n, &LIMITS).ok()?;
        if system.is_solid() || drawing.polygon_count() > 0 || drawing.segment_count() > u128::from(MAX_SEGMENTS) {
            return None;
        }
        let own = drawing.bounds()?;
        let ink = picture.bounds();
        let sides = |[left, low, right, high]: [f64; 4]| [right - left, high - low];
        let [wide, high] = sides(own);
        let [ink_wide, ink_high] = sides(ink);
        let stroke = picture.stroke;
        let units = [(ink_wide, wide), (ink_high, high)].map(|(ink, own)| (ink - 2.0 * stroke) / own);
        let by_longer = if wide > high { units[0] } else { units[1] };
        let off = |ink: f64, own: f64| (ink - 2.0 * stroke - own * by_longer).abs();
        let off = off(ink_wide, wide).max(off(ink_high, high));
        if !(by_longer > 0.0 && by_longer.is_finite()) || off > most.max(BY_HAND) {
            return None;
        }
        let strokes = Strokes::of_segments(drawing.segments().map(|at| [at.from, at.to]), RIGHT, by_longer);
        // A twig that only one of both has may reach further than all else: so the boxes are laid on each other by each
        // corner, and by their middles.
        let place = |unit: f64, part: [f64; 2]| {
            let along = |at: usize| {
                let of = |low: f64, high: f64| low + (high - low) * part[at];
                of(ink[at] + stroke, ink[at + 2] - stroke) - unit * of(own[at], own[at + 2])
            };
            Fit { unit, x: along(0), y: along(1), stroke }
        };
        if off > most {
            let unit = units.into_iter().fold(f64::INFINITY, f64::min);
            let laid = Laid::straight(RIGHT, place(unit, [0.5, 0.5]));
            let agreement = strokes.mask(laid).agreement(&picture.mask);
            let work = strokes.work_once(laid.fit);
            return Some(Self { strokes, laid, agreement, work });
        }
        let parts = [[0.5, 0.5], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let fits = units.into_iter().flat_map(|unit| parts.map(|part| place(unit, part)));
        let agreement = |fit: &Fit| strokes.mask(Laid::straight(RIGHT, *fit)).agreement(&picture.mask);
        let usable = fits.filter(|fit| fit.unit > 0.0 && fit.unit.is_finite());
        let (_, fit) = usable.map(|fit| (agreement(&fit), fit)).max_by(|a, b| a.0.total_cmp(&b.0))?;
        let (agreement, laid) = judged(&strokes, RIGHT, picture, fit);
        let work = strokes.work(laid.fit, picture) + picture.sheet.work();
        Some(Self { strokes, laid, agreement, work })
    }
}

impl Picture {
    /// Where the picture and the drawing of a system differ: a code for each pixel of [`SIDE`] times [`SIDE`], row by row
    /// from above: 1 for ink of both, 2 for ink of the picture only, 4 for ink of the system only, 0 for none. `None` if the
    /// system cannot be laid on the picture.
    #[must_use]
    pub fn compared(&self, definition: &Definition) -> Option<Vec<u8>> {
        let system = System::new(definition).ok()?;
        let overlay = Overlay::close(&system, definition.iterations, self, f64::INFINITY)?;
        Some(overlay.strokes.mask(overlay.laid).compared(&self.mask))
    }
}

/// The part of the ink of strokes and of a picture that agrees, from 0 to 1, with the best of the fits near this one, and
/// where they lie then. It is 1 only if both are the same: the skeletons agree within a stroke width in both directions and nothing
/// is left over, at the picture's own resolution. `first` is the cosine and the sine of the first heading.
pub(crate) fn judged(strokes: &Strokes, first: (f64, f64), picture: &Picture, fit: Fit) -> (f64, Laid) {
    let (agreement, laid) = strokes.fitted(first, picture, fit);
    let is_same = agreement >= FOUND && picture.sheet.agrees(strokes.in_pixels(laid));
    (if is_same { 1.0 } else { agreement.min(NOT_THE_SAME) }, laid)
}
