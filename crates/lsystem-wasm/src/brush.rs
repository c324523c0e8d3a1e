//! What makes a picture of a drawing in the plane: one renderer for ink that covers, one for ink that adds up.

use crate::viewer::Scene;
#[cfg(feature = "full")]
use lsystem::{DensityRenderer, Ink};
use lsystem::{Detail, Drawing, Progress, Renderer};
use std::sync::Arc;

/// A renderer of either sort.
trait Painting {
    fn load(&mut self, drawing: Arc<Drawing>);
    fn begin(&mut self, scene: &Scene, detail: Detail);
    fn step(&mut self, work: usize) -> Progress;
    fn pixels(&self) -> &[u8];
}

macro_rules! painting {
    ($renderer:ty) => {
        impl Painting for $renderer {
            fn load(&mut self, drawing: Arc<Drawing>) {
                Self::load(self, drawing);
            }

            fn begin(&mut self, Scene { style, viewport, view, upto }: &Scene, detail: Detail) {
                self.begin_with(style, *viewport, *view, detail, *upto);
            }

            fn step(&mut self, work: usize) -> Progress {
                Self::step(self, work)
            }

            fn pixels(&self) -> &[u8] {
                Self::pixels(self)
            }
        }
    };
}

painting!(Renderer);
#[cfg(feature = "full")]
painting!(DensityRenderer);

/// Makes pictures in the ink that they ask for.
pub(crate) struct Brush {
    painting: Box<dyn Painting>,
    #[cfg(feature = "full")]
    ink: Ink,
    drawing: Option<Arc<Drawing>>,
    /// Whether the renderer has the drawing.
    loaded: bool,
}

impl Default for Brush {
    fn default() -> Self {
        Self {
            painting: Box::new(Renderer::new()),
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
            self.painting = match self.ink {
                Ink::Solid => Box::new(Renderer::new()),
                Ink::Density => Box::new(DensityRenderer::new()),
            };
            self.loaded = false;
        }
        if let Some(drawing) = self.drawing.as_ref().filter(|_| !self.loaded) {
            self.painting.load(drawing.clone());
            self.loaded = true;
        }
        self.painting.begin(scene, detail);
    }

    /// Goes on with it.
    pub(crate) fn step(&mut self, work: usize) -> Progress {
        self.painting.step(work)
    }

    /// The picture so far.
    pub(crate) fn pixels(&self) -> &[u8] {
        self.painting.pixels()
    }
}
