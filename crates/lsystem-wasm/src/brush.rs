//! What makes a picture of a drawing in the plane: one renderer for ink that covers, one for ink that adds up.

use crate::viewer::Scene;
#[cfg(feature = "full")]
use lsystem::{DensityRenderer, Ink};
use lsystem::{Detail, Drawing, PlaneRenderer, Progress, Renderer};
use std::sync::Arc;

/// Makes pictures in the ink that they ask for.
pub(crate) struct Brush {
    renderer: Box<dyn PlaneRenderer>,
    #[cfg(feature = "full")]
    ink: Ink,
    drawing: Option<Arc<Drawing>>,
    /// Whether the renderer has the drawing.
    loaded: bool,
}

impl Default for Brush {
    fn default() -> Self {
        Self {
            renderer: Box::new(Renderer::new()),
            #[cfg(feature = "full")]
            ink: Ink::Solid,
            drawing: None,
            loaded: false,
        }
    }
}

impl Brush {
    /// Takes the drawing that the next pictures are of.
    pub(crate) fn load(&mut self, drawing: Arc<Drawing>) {
        self.drawing = Some(drawing);
        self.loaded = false;
    }

    /// Starts a picture.
    pub(crate) fn begin(&mut self, scene: &Scene, detail: Detail) {
        #[cfg(feature = "full")]
        if self.ink != scene.style.ink {
            self.ink = scene.style.ink;
            self.renderer = match self.ink {
                Ink::Solid => Box::new(Renderer::new()),
                Ink::Density => Box::new(DensityRenderer::new()),
            };
            self.loaded = false;
        }
        if let Some(drawing) = self.drawing.as_ref().filter(|_| !self.loaded) {
            self.renderer.load(drawing.clone());
            self.loaded = true;
        }
        let Scene { style, viewport, view, upto } = scene;
        self.renderer.begin_with(style, *viewport, *view, detail, *upto);
    }

    /// Goes on with it.
    pub(crate) fn step(&mut self, work: usize) -> Progress {
        self.renderer.step(work)
    }

    /// Whether outlines stand for fine detail.
    pub(crate) fn is_rough(&self) -> bool {
        self.renderer.stats().outlines > 0
    }

    /// The picture so far.
    pub(crate) fn pixels(&self) -> &[u8] {
        self.renderer.pixels()
    }
}
