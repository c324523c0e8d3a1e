//! Paints sticks, triangles and dots on a tile, band by band.

use super::additive::Additive;
use super::camera::NEAR;
use super::face::Face;
use super::light::{LIGHT, LightKind};
use super::setup::Setup;
use super::stroke::{Dot, Painted, Stick};
use super::tile::ScreenTile;
use crate::RenderStats;
use crate::ink::Amount;
use lsystem_base::Meter;
use lsystem_drawing::Widths;
use lsystem_drawing::rotation::{Vector, cross, dot, minus, norm};
use std::collections::VecDeque;

/// The greatest radius, in pixels, up to which strokes that stand for others are made thicker.
const THICKER: f64 = 1.25;
/// The units of work for a line, a triangle or a dot, without its samples.
pub(super) const LINE_WORK: i64 = 4;
/// Samples of a round stick in a unit of work, and of a flat triangle, which only compares depths.
const SAMPLES_WORK: i64 = 8;
const FLAT_SAMPLES_WORK: i64 = 32;

/// A shape that is painted on a tile.
#[derive(Clone, Copy)]
enum Primitive {
    Stick(Stick),
    Face(Face),
    Dot(Dot),
}

impl Primitive {
    /// The units of work for so many samples.
    fn work(&self, samples: usize) -> i64 {
        samples as i64 / if matches!(self, Self::Face(_)) { FLAT_SAMPLES_WORK } else { SAMPLES_WORK }
    }
}

/// Paints a tile. Functions that paint return the units of work.
#[derive(Default)]
pub(super) struct TilePainter {
    pub tile: ScreenTile,
    /// The tile's upper left corner in the picture, in samples.
    pub corner: [f64; 2],
    /// The unfinished primitives, and the row from which on each is still to be painted: wide ones are painted in
    /// bands.
    primitives: VecDeque<(Primitive, usize)>,
    /// How often large primitives have covered this tile: the sum of the squares of the covered parts.
    pub layers: f64,
    /// The part of the tile that the present primitive has covered so far.
    layer: f64,
    pub stats: RenderStats,
    /// Where ink adds up. Then nothing is painted on the tile.
    pub additive: Option<Box<Additive>>,
}

impl TilePainter {
    /// Starts a tile of this `size`, in samples.
    pub(super) fn begin(&mut self, setup: &Setup, corner: [f64; 2], size: [usize; 2]) {
        self.corner = corner;
        (self.layers, self.layer) = (0.0, 0.0);
        if self.additive.is_some() {
            self.tile.size = size;
            return;
        }
        self.tile.leans = setup.samples == 4;
        self.tile.reset(size, setup.side, setup.background);
    }

    /// Gives up the unfinished primitives.
    pub(super) fn stop(&mut self) {
        self.primitives.clear();
    }

    /// Paints a triangle, which is visible from both sides. A triangle that reaches behind the eye is left out.
    pub(super) fn face(&mut self, setup: &Setup, corners: [Vector; 3], ink: [f32; 3]) -> i64 {
        let lens = &setup.lens;
        if corners.iter().any(|corner| 1.0 + corner[2] * lens.nearness <= NEAR) {
            return 1;
        }
        self.stats.strokes += 1;
        let [a, b, c] = corners;
        let normal = cross(minus(b, a), minus(c, a));
        let size = norm(normal);
        if size <= 0.0 {
            return 1;
        }
        // The normal points towards the viewer.
        let spot = setup.light.spot([0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0));
        if let Some(additive) = &mut self.additive {
            let corners = corners.map(|corner| {
                let [x, y, _] = lens.project(corner);
                [x - self.corner[0], y - self.corner[1]]
            });
            return additive.triangle(corners, f64::from(1.0 - spot.haze), ink);
        }
        let sign = if normal[2] > 0.0 { -1.0 } else { 1.0 };
        let normal = normal.map(|n| sign * n / size);
        let colour = if setup.light.kind == LightKind::Full {
            setup.light.leaf(ink, &spot, normal)
        } else {
            setup.light.surface(ink, &spot, dot(normal, LIGHT) as f32, -normal[2] as f32)
        };
        let face = Face { corners: corners.map(|corner| lens.project(corner)), colour };
        self.primitive(setup, Primitive::Face(face))
    }

    /// Paints a stroke, made `thicker` by a factor if it stands for others.
    pub(super) fn stick(
        &mut self,
        setup: &Setup,
        ends: [Vector; 2],
        widths: Widths,
        thicker: f32,
        ink: [f32; 3],
    ) -> i64 {
        if self.additive.is_some() {
            return self.strokes(setup, ends, widths, Amount::new(thicker.into()), ink);
        }
        self.stats.strokes += 1;
        let Some(parts) = setup.lens.before_eye(ends) else { return 1 };
        let radius = |part: (Vector, f64)| {
            let own = radius(setup, widths, part);
            (own * f64::from(thicker)).min(THICKER * setup.samples as f64).max(own)
        };
        let stick = Stick {
            ends: parts.map(|(end, _)| setup.lens.project(end)),
            radii: parts.map(radius),
            ink,
            spots: parts.map(|(end, _)| setup.light.spot(end)),
        };
        self.primitive(setup, Primitive::Stick(stick))
    }

    /// Adds the ink of so many strokes in one place.
    pub(super) fn strokes(
        &mut self,
        setup: &Setup,
        ends: [Vector; 2],
        widths: Widths,
        times: Amount,
        ink: [f32; 3],
    ) -> i64 {
        self.stats.strokes += 1;
        let (Some(parts), Some(additive)) = (setup.lens.before_eye(ends), &mut self.additive) else { return 1 };
        let clear = parts.iter().map(|(end, _)| 0.5 * (1.0 - setup.light.spot(*end).haze)).sum::<f32>();
        let places = parts.map(|(end, _)| {
            let [x, y, _] = setup.lens.project(end);
            [x - self.corner[0], y - self.corner[1]]
        });
        let widths = parts.map(|part| 2.0 * radius(setup, widths, part));
        additive.stroke(places, widths, times.times(clear.into()), ink)
    }

    /// Paints a dot.
    pub(super) fn dot(&mut self, setup: &Setup, dot: Dot) -> i64 {
        self.primitive(setup, Primitive::Dot(dot))
    }

    /// Paints the first band of a primitive, or queues the primitive behind unfinished ones.
    #[inline]
    fn primitive(&mut self, setup: &Setup, primitive: Primitive) -> i64 {
        if !self.primitives.is_empty() {
            self.primitives.push_back((primitive, 0));
            return LINE_WORK;
        }
        let Painted { looked, rest } = self.band(setup, &primitive, 0);
        self.primitives.extend(rest.map(|from| (primitive, from)));
        LINE_WORK + primitive.work(looked)
    }

    /// Paints the next band of an unfinished primitive; `None` if there is none.
    #[inline]
    pub(super) fn go_on(&mut self, setup: &Setup, meter: &mut Meter) -> Option<i64> {
        if let Some(additive) = &mut self.additive {
            return additive.go_on(meter);
        }
        let (primitive, from) = self.primitives.pop_front()?;
        let Painted { looked, rest } = self.band(setup, &primitive, from);
        if let Some(from) = rest {
            self.primitives.push_front((primitive, from));
        }
        let cost = primitive.work(looked);
        meter.charge(cost.unsigned_abs());
        Some(cost)
    }

    /// Paints a band of a primitive, from the row `from` on.
    fn band(&mut self, setup: &Setup, primitive: &Primitive, from: usize) -> Painted {
        let painted = match primitive {
            Primitive::Stick(stick) => stick.paint(&mut self.tile, self.corner, &setup.light, from),
            Primitive::Face(face) => face.paint(&mut self.tile, self.corner, from),
            Primitive::Dot(dot) => dot.paint(&mut self.tile, self.corner, from),
        };
        let [width, height] = self.tile.size;
        self.layer += painted.looked as f64 / (width * height) as f64;
        if painted.rest.is_none() {
            // Squared, so that any number of small primitives hardly counts.
            self.layers += self.layer * self.layer;
            self.layer = 0.0;
        }
        painted
    }
}

/// Half the width of a stroke at an end of its visible part, in samples.
#[inline]
fn radius(setup: &Setup, widths: Widths, (end, place): (Vector, f64)) -> f64 {
    let [first, last] = widths.ends();
    let width = first + place * (last - first);
    (width * setup.lens.step * setup.lens.factor(end[2]) / 2.0).max(setup.hairline)
}
