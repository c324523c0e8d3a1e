//! Drawings in space: built in steps, shown coarse at once and finer while nothing changes.

use crate::LIMITS;
use crate::clock::Clock;
use crate::playground::Playground;
use crate::report::Report;
use crate::surface::Surface;
use crate::viewer::{Drawn, Scene, Viewer, WORK, describe_drawing, go_on};
use lsystem::{Camera, Diagnostic, Drawer, Drawing, Progress, Quality, Solid, SolidRenderer, System, solid_scale};
use std::sync::Arc;
use wasm_bindgen::prelude::*;

/// What a picture is to take while things move, in milliseconds.
const TARGET: f64 = 7.5;
/// One that takes longer than this is finished with less effort.
const HURRY: f64 = 9.0;
/// Between the first picture and the finest there is one that comes soon.
const MIDDLE: Quality = Quality(12);
/// The first picture of a drawing of which nothing is known.
const UNKNOWN: Quality = Quality(4);
/// Work units between two looks at the clock while things move.
const MOVING_WORK: usize = WORK / 4;

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
    /// What the picture has taken, in milliseconds, and when it is told to hurry.
    spent: f64,
    hurried: f64,
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
            pace: UNKNOWN,
            hurried: 0.0,
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
        Some(go_on(&mut self.drawer)?.map(|drawing| {
            self.renderer.load(drawing.clone());
            self.pace = UNKNOWN;
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
        self.renderer.play(scene.upto);
        self.scene = Some(scene);
        self.refine(self.pace);
    }

    /// A finer picture is begun when one is shown.
    fn paint(&mut self, clock: &Clock, surface: &Surface) -> Result<Option<Drawn>, JsValue> {
        let (Some(drawing), Some(scene), false) = (&self.drawing, &self.scene, self.done) else { return Ok(None) };
        let began = clock.now();
        let moving = self.quality == self.pace;
        let progress = self.renderer.step(if moving { MOVING_WORK } else { WORK });
        self.spent += clock.now() - began;
        if progress == Progress::More {
            if moving && self.spent > self.hurried {
                self.renderer.hurry(0.3);
                self.hurried += 0.5 * HURRY;
            }
            return Ok(None);
        }
        if moving {
            self.pace = self.pace.paced(steps(self.spent));
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

    fn is_refining(&self) -> bool {
        !self.done && self.quality != self.pace
    }

    fn snapshot(&self, scene: Scene, surface: &Surface) -> Result<(), JsValue> {
        let Some(drawing) = &self.drawing else { return Ok(()) };
        let mut renderer = SolidRenderer::new();
        renderer.load(drawing.clone());
        renderer.play(scene.upto);
        renderer.begin(&scene.style, scene.viewport, &self.camera, Quality::BEST);
        while renderer.step(WORK) == Progress::More {}
        surface.show(renderer.pixels(), scene.viewport)
    }
}

impl SolidView {
    fn refine(&mut self, quality: Quality) {
        let Some(scene) = &self.scene else { return };
        self.done = false;
        self.quality = quality;
        (self.spent, self.hurried) = (0.0, HURRY);
        self.renderer.begin(&scene.style, scene.viewport, &self.camera, quality);
    }
}

/// By how many steps the next picture is to be finer than one that took so many milliseconds. Two are twice the effort.
fn steps(spent: f64) -> i32 {
    let ratio = TARGET / spent.max(0.01);
    match ratio {
        ..0.25 => -4,
        ..0.5 => -2,
        ..0.85 => -1,
        ..1.5 => 0,
        ..2.5 => 1,
        _ => 3,
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
