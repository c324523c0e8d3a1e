//! What makes a picture of a drawing in the plane: one renderer for ink that covers, one for ink that adds up.

use crate::viewer::Scene;
use lsystem::DensityRenderer;
use lsystem::render::{Detail, Pane, Pass, RenderStats};
use lsystem::syntax::Ink;
use lsystem::{Drawing, PlaneRenderer, Progress, Renderer, Style, Viewport};
use std::sync::Arc;

/// A renderer for one of the inks.
enum Maker {
    Covering(Box<Renderer>),
    Adding(Box<DensityRenderer>),
}

impl Maker {
    /// For ink that covers.
    fn covering(light: bool) -> Self {
        Self::Covering(Box::new(if light { Renderer::light() } else { Renderer::new() }))
    }

    fn of(&mut self) -> &mut dyn PlaneRenderer {
        match self {
            Self::Covering(renderer) => &mut **renderer,
            Self::Adding(renderer) => &mut **renderer,
        }
    }

    fn get(&self) -> &dyn PlaneRenderer {
        match self {
            Self::Covering(renderer) => &**renderer,
            Self::Adding(renderer) => &**renderer,
        }
    }
}

/// Makes pictures in the ink that they ask for.
pub(crate) struct Brush {
    maker: Maker,
    /// Whether it does without what takes memory for pictures of crowds.
    light: bool,
    drawing: Option<Arc<Drawing>>,
    /// Whether the renderer has the drawing.
    loaded: bool,
}

impl Default for Brush {
    fn default() -> Self {
        Self::of(false)
    }
}

impl Brush {
    /// For small pictures.
    pub(crate) fn light() -> Self {
        Self::of(true)
    }

    fn of(light: bool) -> Self {
        Self { maker: Maker::covering(light), light, drawing: None, loaded: false }
    }

    /// The most bytes that a fine and a coarse picture take together.
    pub(crate) fn most_bytes(drawing: &Drawing, style: &Style, viewport: Viewport) -> u64 {
        let most = |detail| match style.ink {
            Ink::Density => DensityRenderer::most_bytes(drawing, style, viewport, detail),
            _ => Renderer::most_bytes(drawing, style, viewport, detail),
        };
        most(Detail::Fine) + most(Detail::Coarse)
    }

    /// Takes the drawing that the next pictures are of.
    pub(crate) fn load(&mut self, drawing: Arc<Drawing>) {
        self.drawing = Some(drawing);
        self.loaded = false;
    }

    /// Starts a picture.
    pub(crate) fn begin(&mut self, scene: &Scene, detail: Detail) {
        self.prepare(scene);
        let Scene { style, viewport, view, upto, .. } = scene;
        self.maker.of().begin_with(style, *viewport, *view, detail, *upto);
    }

    /// Starts a pane of a fine picture; what its pass is concerns ink that adds up.
    pub(crate) fn begin_pane(&mut self, scene: &Scene, pane: Pane, pass: Pass) {
        self.prepare(scene);
        let Scene { style, viewport, view, upto, .. } = scene;
        match &mut self.maker {
            Maker::Covering(renderer) => renderer.begin_pane(style, *viewport, *view, *upto, pane),
            Maker::Adding(renderer) => renderer.begin_pane(style, *viewport, *view, *upto, pane, pass),
        }
    }

    /// Makes sure that the right renderer has the drawing.
    fn prepare(&mut self, scene: &Scene) {
        match (scene.style.ink, &self.maker) {
            (Ink::Solid, Maker::Covering(_)) | (Ink::Density, Maker::Adding(_)) => {}
            (ink, _) => {
                self.maker = match ink {
                    Ink::Solid => Maker::covering(self.light),
                    Ink::Density => Maker::Adding(Box::new(DensityRenderer::new())),
                };
                self.loaded = false;
            }
        }
        if let Some(drawing) = self.drawing.as_ref().filter(|_| !self.loaded) {
            self.maker.of().load(drawing.clone());
            self.loaded = true;
        }
    }

    /// Goes on with it.
    pub(crate) fn step(&mut self, work: usize) -> Progress {
        self.maker.of().step(work)
    }

    /// Whether not every line is in its place: it is put together from pictures of its parts, or outlines stand for fine
    /// detail.
    pub(crate) fn is_rough(&self) -> bool {
        let RenderStats { outlines, parts, .. } = self.maker.get().stats();
        outlines + parts > 0
    }

    /// The picture so far.
    pub(crate) fn pixels(&self) -> &[u8] {
        self.maker.get().pixels()
    }
}
