//! The renderer of drawings in space.

use super::camera::Camera;
use super::effort::Spent;
use super::lighting::Lighting;
use super::picture::Picture;
use super::plan::{Plan, PlannedPane};
use super::quality::Quality;
use super::scene::Scene;
use crate::{Pane, Pass, RenderStats, Viewport};
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Drawing, Solid};
use lsystem_syntax::Style;
use std::sync::Arc;

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
    /// How dark shadows make pictures of a style at rest on the whole: moving pictures have no shadows.
    dim: Option<(Style, [f32; 3])>,
    /// Whether the background is left out.
    is_transparent: bool,
    spent: u64,
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
        let known = self.dim.as_ref().filter(|(known, _)| style.shadows && known == style);
        let dim = known.map_or([1.0; 3], |(_, dim)| *dim);
        self.plan = Some(Plan { style: style.clone(), viewport, camera: *camera, quality, dim, pane: None });
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
        let (style, camera, dim) = (style.clone(), *camera, [1.0; 3]);
        self.plan = Some(Plan { style, viewport, camera, quality: Quality::FINEST, dim, pane });
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
        let progress = self.pictures[self.at].step(&self.scene, &self.lighting, meter);
        if progress == Progress::Done
            && let (Some(dim), Some(style)) = (self.pictures[self.at].dim(), self.lighting.style())
        {
            self.dim = Some((style.clone(), dim));
        }
        progress
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
