//! From a drawing's graph in space to pixels.
//!
//! The picture is the same as if every segment were drawn as a lit round stick. No stick is thinner than a pixel. A
//! pixel has 4x4 samples, and each sample shows the nearest stick. The picture is made tile by tile, and the graph is
//! descended from front to back. Blocks outside the tile or behind painted ones are not looked into. A block under half
//! a pixel is a dot with the mean colour and the mean shading of its strokes. So the cost depends on the visible
//! blocks, not on the number of segments.
//!
//! Where very many blocks lie in the same place, as in a bush that thickens without growing, even the visible blocks
//! are too many. So a picture has a budget, which a block shares out to the blocks inside. A block whose share is too
//! small to look into shows some of its strokes: those that stand out and those that face the viewer. So every picture
//! ends, and each stroke shown is part of the drawing. The budget depends on the work that the picture took with a
//! smaller budget or, while the camera moves, on the time of the picture before.
//!
//! A picture at rest has more light: ambient occlusion, soft shadows, a shade on the ground. All of it follows from two
//! depth pictures of the whole drawing, from the eye and from the sun, which come before the picture.

mod additive;
mod camera;
mod effort;
mod face;
mod ground;
mod lanes;
mod light;
mod lighting;
mod occlusion;
mod open_node;
mod opening;
mod painter;
mod path;
mod pick;
mod picture;
mod pixels;
mod place;
mod samples;
mod scene;
mod setup;
mod shares;
mod size;
mod stand_in;
mod stroke;
mod sun;
mod surface;
mod tile;

#[cfg(test)]
mod tests;

pub use camera::{Camera, camera_axes};
pub(crate) use camera::{SpaceFraming, fitted_ends, fitted_polygon, fitted_scale};
pub use effort::{Effort, Spent};
pub(crate) use opening::opening_camera;
pub(crate) use pick::pick;

use crate::{Pane, Pass, RenderStats, Viewport};
use lighting::Lighting;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Drawing, Solid};
use lsystem_syntax::{Ink, Style};
use picture::Picture;
use scene::Scene;
use std::sync::Arc;

/// The detail of a picture: 0 is the coarsest, for large drawings while the camera moves. [`Quality::FINEST`] is for
/// the screen at rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quality(pub u8);

impl Quality {
    /// For files: as [`Quality::FINEST`], with 8 times the work for crowded drawings.
    pub const BEST: Self = Self(17);
    /// Dots up to half a pixel, 4x4 samples in a pixel.
    pub const FINEST: Self = Self(16);
    /// The finest quality with one sample in a pixel, for a moving camera. Up to here two steps double the budget.
    pub const MOVING: Self = Self(14);

    /// The quality `steps` finer, or coarser for a negative number, between 0 and [`Quality::MOVING`].
    #[must_use]
    pub fn paced(self, steps: i32) -> Self {
        let number = (i32::from(self.0) + steps).clamp(0, i32::from(Self::MOVING.0));
        Self(number as u8)
    }

    /// Samples along the side of a pixel.
    const fn samples(self) -> usize {
        if self.0 >= Self::FINEST.0 {
            4
        } else if self.0 > Self::MOVING.0 {
            2
        } else {
            1
        }
    }

    /// Whether a picture has shadows. Moving pictures have none, because shadows take another picture of the drawing.
    fn has_shadows(self, style: &Style) -> bool {
        self >= Self::FINEST && style.shadows && style.ink != Ink::Density
    }

    /// The extent in samples below which blocks are dots.
    fn detail(self) -> f64 {
        match self.0 {
            0..6 => 3.0,
            6..15 => 1.5,
            15 => 1.6,
            _ => 2.0,
        }
    }

    /// Samples across and down a tile. A coarse picture has a single tile (up to 2048 samples each way), so that the
    /// graph is descended once. Fine pictures have small tiles, which stay in the processor's cache.
    fn tile(self, viewport: Viewport) -> [usize; 2] {
        /// A multiple of 1, 2 and 4 samples, and of the tile's cells.
        const SIDE: usize = 1024;
        if self > Self::MOVING {
            return [SIDE; 2];
        }
        [viewport.width, viewport.height].map(|pixels| (pixels as usize).next_multiple_of(8).clamp(8, 2 * SIDE))
    }

    /// The first budget: the most strokes and nodes that are looked into.
    fn budget(self) -> f32 {
        if self > Self::MOVING {
            return FIRST_BUDGET;
        }
        let whole = (COARSEST_BUDGET << (self.0 / 2)) as f32;
        if self.0.is_multiple_of(2) { whole } else { whole * core::f32::consts::SQRT_2 }
    }

    /// The units of work that a picture should take; 0 for coarse pictures, whose budget is fixed.
    fn work(self, viewport: Viewport) -> i64 {
        let worth = LEAST_WORK.max(i64::from(viewport.width) * i64::from(viewport.height) * WORK_PER_PIXEL);
        match self {
            Self(..=14) => 0,
            Self(15 | 16) => worth,
            _ => worth * BEST_FACTOR,
        }
    }
}

/// The units of work for each pixel of a fine picture.
const WORK_PER_PIXEL: i64 = 2;
/// The least units of work for a fine picture of any size.
const LEAST_WORK: i64 = 3_000_000;
/// The work of [`Quality::BEST`], relative to [`Quality::FINEST`].
const BEST_FACTOR: i64 = 8;
/// The first budget of fine pictures, in strokes and nodes.
const FIRST_BUDGET: f32 = 40_000.0;
/// The budget of the coarsest picture, in strokes and nodes.
const COARSEST_BUDGET: u32 = 1500;

/// Makes pictures of a drawing in space, one after the other, in the same memory.
#[derive(Default)]
pub struct SolidRenderer {
    drawing: Option<Arc<Drawing<Solid>>>,
    scene: Scene,
    /// If given, only the first `upto` segments are shown.
    upto: Option<u128>,
    /// Two pictures, whose sizes alternate between moving and rest, so that the memory of both is kept. The third is
    /// for panes.
    pictures: [Picture; 3],
    lighting: Lighting,
    /// The index of the present picture.
    at: usize,
    /// The picture that was asked for, until the scene is ready.
    plan: Option<Plan>,
    /// Whether the background is left out.
    is_transparent: bool,
    spent: u64,
}

/// Everything that a picture is asked to show.
struct Plan {
    style: Style,
    viewport: Viewport,
    camera: Camera,
    quality: Quality,
    /// If given, only this pane is made.
    pane: Option<PlannedPane>,
}

/// A pane of a picture that is made in several.
#[derive(Clone, Copy)]
struct PlannedPane {
    pane: Pane,
    pass: Pass,
    /// The budget that all panes share.
    budget: f32,
}

impl SolidRenderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The renderer of pictures without the background. A pixel has the mean colour of its painted samples, and their
    /// share as its opacity.
    #[must_use]
    pub fn transparent(self) -> Self {
        Self { is_transparent: true, ..self }
    }

    /// Takes the drawing of the next pictures. The steps of the first picture prepare the drawing.
    pub fn load(&mut self, drawing: Arc<Drawing<Solid>>) {
        self.stop();
        self.lighting.forget();
        self.scene = Scene::new(&drawing);
        self.upto = None;
        self.drawing = Some(drawing);
    }

    /// Limits the next pictures to the first `upto` segments and the polygons before the next, or shows all. An
    /// unfinished picture is given up.
    pub fn play(&mut self, upto: Option<u128>) {
        if upto != self.upto {
            self.stop();
            self.lighting.forget();
            self.scene.show(upto);
            self.upto = upto;
        }
    }

    fn stop(&mut self) {
        self.plan = None;
        self.pictures.iter_mut().for_each(Picture::stop);
    }

    /// Starts a picture of the loaded drawing. An unfinished picture is given up.
    pub fn begin(&mut self, style: &Style, viewport: Viewport, camera: &Camera, quality: Quality) {
        if !self.pictures[self.at].fits(viewport) {
            let other = usize::from(self.at == 0);
            self.at = (0..2).find(|&at| self.pictures[at].fits(viewport)).unwrap_or(other);
        }
        self.plan = Some(Plan { style: style.clone(), viewport, camera: *camera, quality, pane: None });
    }

    /// The panes of a picture in the finest quality: its tiles, row by row. Panes have the same pixels as the whole
    /// picture.
    #[must_use]
    pub fn panes(viewport: Viewport) -> Vec<Pane> {
        let quality = Quality::FINEST;
        Pane::all(viewport, quality.tile(viewport).map(|side| (side / quality.samples()) as u32))
    }

    /// Starts a pass on one of [`SolidRenderer::panes`] of the finest picture, or of the [best](Quality::BEST), which has
    /// the same panes, with the budget that all panes share. Only additive ink has a survey, which forgets earlier
    /// counts, and needs all panes counted before the first is shown. The pixels are those of the pane. The sum of what all panes
    /// [took](Self::effort_spent) shows [`Effort`] whether the budget was too small.
    pub fn begin_pane(
        &mut self,
        style: &Style,
        viewport: Viewport,
        camera: &Camera,
        (pane, pass): (Pane, Pass),
        budget: f32,
    ) {
        let pane = Some(PlannedPane { pane, pass, budget });
        self.at = 2;
        self.plan = Some(Plan { style: style.clone(), viewport, camera: *camera, quality: Quality::FINEST, pane });
    }

    /// The work of the picture, or of the pane, so far with its present budget.
    #[must_use]
    pub fn effort_spent(&self) -> Spent {
        self.pictures[self.at].spent()
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Goes on with the picture for about `work` units, as [`Meter`] counts them, and for at most [`Meter::PIECE`]
    /// more.
    pub fn step(&mut self, work: usize) -> Progress {
        let mut meter = Meter::new(work as u64);
        let progress = self.go_on(&mut meter);
        self.spent += meter.spent();
        progress
    }

    fn go_on(&mut self, meter: &mut Meter) -> Progress {
        let Some(drawing) = &self.drawing else { return Progress::Done };
        if let Some(plan) = &self.plan {
            if self.scene.step(drawing, meter) == Progress::More || self.scene.dye(&plan.style, meter) == Progress::More
            {
                return Progress::More;
            }
            if plan.quality.has_shadows(&plan.style) {
                self.lighting.begin(drawing, plan);
                if self.lighting.step(&self.scene, meter) == Progress::More {
                    return Progress::More;
                }
            }
            meter.charge(self.pictures[self.at].begin(drawing, plan, self.is_transparent, self.scene.only_ink()));
            self.plan = None;
        }
        self.pictures[self.at].step(&self.scene, &self.lighting, meter)
    }

    /// Makes the rest of the picture with `part` (0 to 1) of its budget.
    pub fn hurry(&mut self, part: f32) {
        if self.plan.is_none() {
            self.pictures[self.at].scale_budget(&self.scene, part);
        }
    }

    /// The picture so far: RGBA, 8 bits each, opaque unless [`transparent`](Self::transparent), from the upper left
    /// corner row by row. The size is that of the picture once a step has prepared the drawing.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.pictures[self.at].pixels()
    }

    /// The work and the memory of the picture so far.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.pictures[self.at].stats()
    }
}
