//! From a drawing's graph in space to pixels.
//!
//! The picture is what drawing every segment as a lit round stick would show: no stick thinner than a pixel, 4x4 samples
//! a pixel, each showing what is nearest. It is made tile by tile: the graph is descended from front to back, what is
//! outside the tile or behind what is painted already is not looked into, and a block under half a pixel is a dot with
//! the mean colour and the mean shading of what it draws. So a picture costs what can be seen of it, however many
//! segments there are.
//!
//! Where very many blocks lie in the same place, as in a bush that thickens without growing, even that is too much. So
//! a picture has a budget, which a block shares out to the blocks in it; one whose share is too small to look into
//! shows as many of its strokes as it may, those that stand out and face the viewer. Pictures end in time, and all that
//! they show is there. How large the budget is depends on the work that the picture took with a smaller one, or, while
//! things move, on the time that the picture before took.

mod camera;
mod effort;
mod face;
mod frame;
mod lanes;
mod light;
mod painter;
mod path;
mod pick;
mod picture;
mod pixels;
mod place;
mod scene;
mod setup;
mod shares;
mod size;
mod stand_in;
mod stroke;
mod surface;
mod tile;

#[cfg(test)]
mod tests;

pub use camera::{Camera, camera_axes, fitted_solid_ends, fitted_solid_polygon, solid_scale};
pub use effort::{Effort, Spent};
pub use pick::pick_solid;

use crate::{Pane, RenderStats, Viewport};
use lsystem_drawing::{Drawing, Solid};
use lsystem_syntax::{Meter, Progress, Style};
use picture::Picture;
use scene::Scene;
use std::sync::Arc;

/// How much a picture may show for its time: 0 is the coarsest, for large drawings on the move, and
/// [`Quality::FINEST`] the picture as it is meant for the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Quality(pub u8);

impl Quality {
    /// For files: as [`Quality::FINEST`], with more time where there is more to see than that has time for.
    pub const BEST: Self = Self(17);
    /// Blocks of half a pixel, 4x4 samples a pixel.
    pub const FINEST: Self = Self(16);
    /// The finest of those with one sample a pixel, which are for what moves. They differ in how much is looked into:
    /// two steps are twice as much.
    pub const MOVING: Self = Self(14);

    /// Finer by `steps`, or coarser by a negative number, but still for what moves.
    #[must_use]
    pub fn paced(self, steps: i32) -> Self {
        let number = (i32::from(self.0) + steps).clamp(0, i32::from(Self::MOVING.0));
        Self(number as u8)
    }

    /// Samples along the side of a pixel.
    fn samples(self) -> usize {
        if self >= Self::FINEST {
            4
        } else if self > Self::MOVING {
            2
        } else {
            1
        }
    }

    /// Blocks smaller than this are dots, in samples.
    fn detail(self) -> f64 {
        match self.0 {
            0..6 => 3.0,
            6..15 => 1.5,
            15 => 1.6,
            _ => 2.0,
        }
    }

    /// Samples across and down a tile. What moves has a single one, so that what is nowhere need not be looked for
    /// often; fine pictures have small ones, which stay in a near cache.
    fn tile(self, viewport: Viewport) -> [usize; 2] {
        /// A multiple of all numbers of samples, and of the tile's cells.
        const SIDE: usize = 1024;
        if self > Self::MOVING {
            return [SIDE; 2];
        }
        [viewport.width, viewport.height].map(|pixels| (pixels as usize).next_multiple_of(8).clamp(8, 2 * SIDE))
    }

    /// Strokes and nodes that are looked into at most.
    fn budget(self) -> f32 {
        if self > Self::MOVING {
            return FIRST;
        }
        let whole = (COARSEST << (self.0 / 2)) as f32;
        if self.0.is_multiple_of(2) { whole } else { whole * core::f32::consts::SQRT_2 }
    }

    /// Work that a picture is worth: for fine ones, what there is to see depends on the room for it.
    fn work(self, viewport: Viewport) -> i64 {
        let worth = LEAST.max(i64::from(viewport.width) * i64::from(viewport.height) * WORTH);
        match self {
            Self(..=14) => 0,
            Self(15 | 16) => worth,
            _ => worth * BETTER,
        }
    }
}

/// Units of work for each pixel of a fine picture, and for one of whatever size.
const WORTH: i64 = 2;
const LEAST: i64 = 3_000_000;
/// How many times more the best one is worth.
const BETTER: i64 = 8;
/// The first budget of fine pictures, in strokes and nodes.
const FIRST: f32 = 40_000.0;
/// Strokes and nodes in the coarsest picture.
const COARSEST: u32 = 1500;

/// Makes pictures of a drawing in space, one after the other, in the same memory.
#[derive(Default)]
pub struct SolidRenderer {
    drawing: Option<Arc<Drawing<Solid>>>,
    scene: Scene,
    /// How many segments are shown; all of them without it.
    upto: Option<u128>,
    /// Pictures of two sizes in turn, as while things move and at rest, keep the memory of both; the last is for panes.
    pictures: [Picture; 3],
    /// Which of them makes the picture.
    at: usize,
    /// A picture that has been asked for, until the scene is ready for it.
    plan: Option<Plan>,
    spent: u64,
}

struct Plan {
    style: Style,
    viewport: Viewport,
    camera: Camera,
    quality: Quality,
    /// Only this pane, with this budget.
    pane: Option<(Pane, f32)>,
}

impl SolidRenderer {
    /// A renderer without a drawing.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes the drawing that the next pictures are of. It is made ready for them in the steps of the first.
    pub fn load(&mut self, drawing: Arc<Drawing<Solid>>) {
        self.stop();
        self.scene = Scene::new(&drawing);
        self.upto = None;
        self.drawing = Some(drawing);
    }

    /// The next pictures are of the first `upto` segments and the polygons before them, or of all. A picture that was being
    /// made is given up.
    pub fn play(&mut self, upto: Option<u128>) {
        if upto != self.upto {
            self.stop();
            self.scene.show(upto);
            self.upto = upto;
        }
    }

    fn stop(&mut self) {
        self.plan = None;
        self.pictures.iter_mut().for_each(Picture::stop);
    }

    /// Starts a picture of the loaded drawing; a picture that was being made is given up.
    pub fn begin(&mut self, style: &Style, viewport: Viewport, camera: &Camera, quality: Quality) {
        if !self.pictures[self.at].fits(viewport) {
            let other = usize::from(self.at == 0);
            self.at = (0..2).find(|&at| self.pictures[at].fits(viewport)).unwrap_or(other);
        }
        self.plan = Some(Plan { style: style.clone(), viewport, camera: *camera, quality, pane: None });
    }

    /// Panes of a picture in the finest quality that are made like the whole picture: its tiles, row by row.
    #[must_use]
    pub fn panes(viewport: Viewport) -> Vec<Pane> {
        let quality = Quality::FINEST;
        Pane::all(viewport, quality.tile(viewport).map(|side| (side / quality.samples()) as u32))
    }

    /// Starts one of [`SolidRenderer::panes`] of the finest picture, with a budget that holds for all of them: the pixels
    /// are those of the pane. Whether that was too small what all of them have [taken](Self::effort_spent) tells [`Effort`].
    pub fn begin_pane(&mut self, style: &Style, viewport: Viewport, camera: &Camera, pane: Pane, budget: f32) {
        let pane = Some((pane, budget));
        self.at = 2;
        self.plan = Some(Plan { style: style.clone(), viewport, camera: *camera, quality: Quality::FINEST, pane });
    }

    /// What the picture, or the pane, has taken with its budget so far.
    #[must_use]
    pub fn effort_spent(&self) -> Spent {
        self.pictures[self.at].spent()
    }

    /// The units of work of all steps so far.
    #[must_use]
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Goes on with the picture for about `work` units, as [`Meter`] counts them: at most [`Meter::PIECE`] more.
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
            let Plan { style, viewport, camera, quality, pane } = plan;
            meter.charge(self.pictures[self.at].begin(drawing, style, *viewport, camera, *quality, *pane));
            self.plan = None;
        }
        self.pictures[self.at].step(&self.scene, meter)
    }

    /// What is left of the picture is made with only `part` of the effort that was meant for it.
    pub fn hurry(&mut self, part: f32) {
        if self.plan.is_none() {
            self.pictures[self.at].hurry(&self.scene, part);
        }
    }

    /// The picture so far, once it has been begun in a step: RGBA, 8 bits each, opaque, from the upper left corner row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u8] {
        self.pictures[self.at].pixels()
    }

    /// What the picture took so far.
    #[must_use]
    pub fn stats(&self) -> RenderStats {
        self.pictures[self.at].stats()
    }
}
