//! Drawings in space: built in steps, shown coarse at once and finer while nothing changes.

use crate::LIMITS;
use crate::clock::Clock;
use crate::playground::{Drawn, Playground, WORK};
use crate::surface::Surface;
use lsystem::{
    Camera, Diagnostic, Drawer, Drawing, Progress, Quality, Solid, SolidRenderer, Style, System, Viewport, solid_scale,
};
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
    pub(crate) drawer: Option<Box<Drawer<Solid>>>,
    renderer: SolidRenderer,
    pub(crate) camera: Camera,
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
            quality: MIDDLE,
            pace: Quality(1),
            spent: 0.0,
            done: true,
        }
    }
}

impl SolidView {
    /// Starts building a drawing.
    pub(crate) fn start(&mut self, system: &System, n: u32) {
        self.drawer = Some(Box::new(Drawer::solid(system, n, LIMITS)));
    }

    /// Gives up the drawing that is being built.
    pub(crate) fn stop(&mut self) {
        self.drawer = None;
    }

    /// Shows nothing any more.
    pub(crate) fn forget(&mut self) {
        self.drawing = None;
        self.renderer = SolidRenderer::new();
    }

    /// Goes on building; the drawing or what is wrong with it, when that is over.
    pub(crate) fn build(&mut self) -> Option<Result<Arc<Drawing<Solid>>, Diagnostic>> {
        if self.drawer.as_mut()?.step(WORK as u64) == Progress::More {
            return None;
        }
        Some(self.drawer.take()?.finish().map(|drawing| {
            let drawing = Arc::new(drawing);
            self.renderer.load(drawing.clone());
            self.drawing = Some(drawing.clone());
            drawing
        }))
    }

    /// Whether the finest picture is shown.
    pub(crate) fn is_done(&self) -> bool {
        self.done
    }

    /// Starts a picture.
    pub(crate) fn begin(&mut self, style: &Style, viewport: Viewport) {
        self.refine(style, viewport, self.pace);
    }

    fn refine(&mut self, style: &Style, viewport: Viewport, quality: Quality) {
        self.done = false;
        self.quality = quality;
        self.spent = 0.0;
        self.renderer.begin(style, viewport, &self.camera, quality);
    }

    /// Goes on with the picture; what is on the canvas after that, if anything new is. A finer one is begun then.
    pub(crate) fn paint(
        &mut self,
        style: &Style,
        viewport: Viewport,
        clock: &Clock,
        surface: &Surface,
    ) -> Result<Option<Drawn>, JsValue> {
        let Some(drawing) = self.drawing.as_ref().filter(|_| !self.done) else { return Ok(None) };
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
        surface.show(self.renderer.pixels(), viewport)?;
        let complete = self.quality == Quality::FINEST;
        self.done = complete;
        let scale = solid_scale(drawing, viewport, &self.camera);
        if !complete {
            self.refine(style, viewport, if self.quality < MIDDLE { MIDDLE } else { Quality::FINEST });
        }
        Ok(Some(Drawn { complete, scale }))
    }

    /// Paints the whole picture at another size.
    pub(crate) fn snapshot(&self, style: &Style, viewport: Viewport, surface: &Surface) -> Result<(), JsValue> {
        let Some(drawing) = &self.drawing else { return Ok(()) };
        let mut renderer = SolidRenderer::new();
        renderer.load(drawing.clone());
        renderer.begin(style, viewport, &self.camera, Quality::FINEST);
        while renderer.step(WORK) == Progress::More {}
        surface.show(renderer.pixels(), viewport)
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
        if camera != self.solid.camera {
            self.solid.camera = camera;
            if self.solid.drawing.is_some() {
                self.outdate();
            }
        }
    }
}
