//! Paints sticks, triangles and dots on a tile, band by band.

use super::camera::NEAR;
use super::face::Face;
use super::light::LIGHT;
use super::setup::Setup;
use super::stroke::{Dot, Painted, Stick};
use super::tile::Tile;
use crate::RenderStats;
use lsystem_drawing::rotation::{Vector, cross, dot, minus, norm};
use std::collections::VecDeque;

/// Strokes that stand for others are made thicker up to this radius at most, in pixels.
const THICKER: f64 = 1.25;
/// What a line, a triangle or a dot costs, in units of work, apart from the samples.
pub(super) const LINE_WORK: i64 = 4;
/// Samples in a unit of work.
const SAMPLES_WORK: i64 = 8;

/// What is painted on a tile.
#[derive(Clone, Copy)]
enum Shape {
    Stick(Stick),
    Face(Face),
    Dot(Dot),
}

/// What paints a tile. All that paints returns the units of work that it took.
#[derive(Default)]
pub(super) struct TilePainter {
    pub tile: Tile,
    /// The tile's upper left corner in the picture, in samples.
    pub corner: [f64; 2],
    /// What is painted before anything else, and from which row on: wide strokes are painted band by band.
    shapes: VecDeque<(Shape, usize)>,
    /// How often this tile has been painted over, and how much of it the shape in hand has so far.
    pub coats: f64,
    coat: f64,
    pub stats: RenderStats,
}

impl TilePainter {
    /// Starts a tile of this `size`, in samples.
    pub(super) fn begin(&mut self, setup: &Setup, corner: [f64; 2], size: [usize; 2]) {
        self.corner = corner;
        (self.coats, self.coat) = (0.0, 0.0);
        self.tile.leans = setup.samples == 4;
        self.tile.reset(size, setup.side, setup.background);
    }

    /// Gives up what is still to be painted.
    pub(super) fn stop(&mut self) {
        self.shapes.clear();
    }

    /// Paints a triangle, which is seen from both sides; one that reaches behind the eye is left out.
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
        // Towards the viewer.
        let sign = if normal[2] > 0.0 { -1.0 } else { 1.0 };
        let normal = normal.map(|n| sign * n / size);
        let spot = setup.light.spot([0, 1, 2].map(|i| (a[i] + b[i] + c[i]) / 3.0));
        let colour = setup.light.surface(ink, &spot, dot(normal, LIGHT) as f32, -normal[2] as f32);
        let face = Face { corners: corners.map(|corner| lens.project(corner)), colour };
        self.shape(setup, Shape::Face(face))
    }

    /// Paints a stroke, `thicker` by a factor where it stands for others.
    pub(super) fn stick(&mut self, setup: &Setup, ends: [Vector; 2], width: f64, thicker: f32, ink: [f32; 3]) -> i64 {
        self.stats.strokes += 1;
        let Some(ends) = setup.lens.before_eye(ends) else { return 1 };
        let radius = |end: Vector| {
            let own = (width * setup.lens.step * setup.lens.factor(end[2]) / 2.0).max(setup.hairline);
            (own * f64::from(thicker)).min(THICKER * setup.samples as f64).max(own)
        };
        let stick = Stick {
            ends: ends.map(|end| setup.lens.project(end)),
            radii: ends.map(radius),
            ink,
            spots: ends.map(|end| setup.light.spot(end)),
        };
        self.shape(setup, Shape::Stick(stick))
    }

    /// Paints a dot.
    pub(super) fn dot(&mut self, setup: &Setup, dot: Dot) -> i64 {
        self.shape(setup, Shape::Dot(dot))
    }

    /// Paints the first band of something, unless something else is to be painted before; the rest follows.
    #[inline]
    fn shape(&mut self, setup: &Setup, shape: Shape) -> i64 {
        if !self.shapes.is_empty() {
            self.shapes.push_back((shape, 0));
            return LINE_WORK;
        }
        let Painted { looked, rest } = self.band(setup, &shape, 0);
        self.shapes.extend(rest.map(|from| (shape, from)));
        LINE_WORK + looked as i64 / SAMPLES_WORK
    }

    /// Paints the next band of what is still to be painted; `None` where nothing is.
    #[inline]
    pub(super) fn go_on(&mut self, setup: &Setup) -> Option<i64> {
        let (shape, from) = self.shapes.pop_front()?;
        let Painted { looked, rest } = self.band(setup, &shape, from);
        if let Some(from) = rest {
            self.shapes.push_front((shape, from));
        }
        Some(looked as i64 / SAMPLES_WORK)
    }

    /// Paints a band of something, from a row on.
    fn band(&mut self, setup: &Setup, shape: &Shape, from: usize) -> Painted {
        let painted = match shape {
            Shape::Stick(stick) => stick.paint(&mut self.tile, self.corner, &setup.light, from),
            Shape::Face(face) => face.paint(&mut self.tile, self.corner, from),
            Shape::Dot(dot) => dot.paint(&mut self.tile, self.corner, from),
        };
        let [width, height] = self.tile.size;
        self.coat += painted.looked as f64 / (width * height) as f64;
        if painted.rest.is_none() {
            // So that what is small does not count, however much there is of it.
            self.coats += self.coat * self.coat;
            self.coat = 0.0;
        }
        painted
    }
}
