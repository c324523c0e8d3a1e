//! Drawings in space: built in steps, shown coarse at once and finer while nothing changes.

use crate::LIMITS;
use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::Report;
use crate::surface::Surface;
use crate::viewer::{Drawn, Scene, Viewer, WORK, describe_drawing};
use lsystem::{Camera, Diagnostic, Drawer, Drawing, Progress, Quality, Solid, SolidRenderer, System, solid_scale};
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// A first picture that takes longer, in milliseconds, is made coarser the next time; one that takes less than the
/// other is made finer.
const SLOW: f64 = 11.0;
const QUICK: f64 = 4.5;
/// Between the first picture and the finest there is one that comes soon.
const MIDDLE: Quality = Quality(3);

/// A drawing in space and its picture.
pub(crate) struct SolidView {
    pub(crate) drawing: Option<Arc<Drawing<Solid>>>,
    /// The drawing that is being built.
    drawer: Option<Box<Drawer<Solid>>>,
    renderer: SolidRenderer,
    pub(crate) camera: Camera,
    scene: Option<Scene>,
    /// Of the picture that is being made.
    quality: Quality,
    /// Of pictures that come in time while things move.
    pace: Quality,
    /// What the picture has taken, in milliseconds.
    spent: f64,
    /// Whether the finest picture is shown.
    done: bool,
}

impl Default for SolidView {
    fn default() -> Self {
        Self {
            drawing: None,
            drawer: None,
            renderer: SolidRenderer::new(),
            camera: Camera::default(),
            scene: None,
            quality: MIDDLE,
            pace: Quality(1),
            spent: 0.0,
            done: true,
        }
    }
}

impl Viewer for SolidView {
    fn start(&mut self, system: &System, n: u32) {
        self.drawer = Some(Box::new(Drawer::solid(system, n, LIMITS)));
    }

    fn stop(&mut self) {
        self.drawer = None;
    }

    fn build(&mut self) -> Option<Result<(), Diagnostic>> {
        if self.drawer.as_mut()?.step(WORK as u64) == Progress::More {
            return None;
        }
        Some(self.drawer.take()?.finish().map(|drawing| {
            let drawing = Arc::new(drawing);
            self.renderer.load(drawing.clone());
            self.drawing = Some(drawing);
        }))
    }

    fn forget(&mut self) {
        self.drawing = None;
        self.renderer = SolidRenderer::new();
    }

    fn describe(&self, report: &mut Report, system: &System, n: u32) {
        if let Some(drawing) = &self.drawing {
            let bounds = drawing.bounds().map(|[low, high]| [low[0], low[1], high[0], high[1]]);
            describe_drawing(report, system, n, drawing, bounds);
        }
    }

    fn begin(&mut self, scene: Scene) {
        self.scene = Some(scene);
        self.refine(self.pace);
    }

    /// A finer picture is begun when one is shown.
    fn paint(&mut self, clock: &Clock, surface: &Surface) -> Result<Option<Drawn>, JsValue> {
        let (Some(drawing), Some(scene), false) = (&self.drawing, &self.scene, self.done) else { return Ok(None) };
        let began = clock.now();
        let progress = self.renderer.step(WORK);
        self.spent += clock.now() - began;
        if progress == Progress::More {
            return Ok(None);
        }
        if self.quality == self.pace {
            if self.spent > SLOW {
                self.pace = self.pace.coarser();
            } else if self.spent < QUICK {
                self.pace = self.pace.finer();
            }
        }
        surface.show(self.renderer.pixels(), scene.viewport)?;
        let scale = solid_scale(drawing, scene.viewport, &self.camera);
        let complete = self.quality == Quality::FINEST;
        self.done = complete;
        if !complete {
            self.refine(if self.quality < MIDDLE { MIDDLE } else { Quality::FINEST });
        }
        Ok(Some(Drawn { complete, scale }))
    }

    fn is_done(&self) -> bool {
        self.done
    }

    fn snapshot(&self, scene: Scene, surface: &Surface) -> Result<(), JsValue> {
        let Some(drawing) = &self.drawing else { return Ok(()) };
        let mut renderer = SolidRenderer::new();
        renderer.load(drawing.clone());
        renderer.begin(&scene.style, scene.viewport, &self.camera, Quality::FINEST);
        while renderer.step(WORK) == Progress::More {}
        surface.show(renderer.pixels(), scene.viewport)
    }
}

impl SolidView {
    fn refine(&mut self, quality: Quality) {
        let Some(scene) = &self.scene else { return };
        self.done = false;
        self.quality = quality;
        self.spent = 0.0;
        self.renderer.begin(&scene.style, scene.viewport, &self.camera, quality);
    }
}

#[wasm_bindgen]
impl Playground {
    /// Says from where a drawing in space is looked at: angles in degrees, the target in fitted extents from the fitted
    /// centre; as [`lsystem::Camera`].
    #[expect(clippy::too_many_arguments, reason = "an object would have to be read field by field")]
    pub fn camera(
        &mut self,
        azimuth: f64,
        elevation: f64,
        zoom: f64,
        x: f64,
        y: f64,
        z: f64,
        perspective: bool,
        fade: f64,
    ) {
        let camera = Camera { azimuth, elevation, zoom, target: [x, y, z], perspective, fade };
        if camera != self.views.solid.camera {
            self.views.solid.camera = camera;
            self.outdate();
        }
    }
}
