//! Pictures of drawings in the plane: one renderer for opaque ink, one for additive ink.

use crate::viewer::Scene;
use lsystem::DensityRenderer;
use lsystem::render::{Detail, Pane, Pass, RenderStats};
use lsystem::syntax::Ink;
use lsystem::{Drawing, PlaneRenderer, Progress, Renderer, Style, Viewport};
use std::sync::Arc;

/// A renderer for one of the inks.
enum InkRenderer {
    Covering(Box<Renderer>),
    Adding(Box<DensityRenderer>),
}

impl InkRenderer {
    /// A renderer for opaque ink; a `light` one takes less memory.
    fn covering(light: bool) -> Self {
        Self::Covering(Box::new(if light { Renderer::light() } else { Renderer::new() }))
    }

    fn get_mut(&mut self) -> &mut dyn PlaneRenderer {
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

/// Makes pictures in the ink of their style.
pub(crate) struct Brush {
    renderer: InkRenderer,
    /// As [`Renderer::light`].
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
    /// A brush for small pictures.
    pub(crate) fn light() -> Self {
        Self::of(true)
    }

    fn of(light: bool) -> Self {
        Self { renderer: InkRenderer::covering(light), light, drawing: None, loaded: false }
    }

    /// The most bytes of a fine and a coarse picture together.
    pub(crate) fn most_bytes(drawing: &Drawing, style: &Style, viewport: Viewport) -> u64 {
        let most = |detail| match style.ink {
            Ink::Density => DensityRenderer::most_bytes(drawing, style, viewport, detail),
            _ => Renderer::most_bytes(drawing, style, viewport, detail),
        };
        most(Detail::Fine) + most(Detail::Coarse)
    }

    /// Sets the drawing of the next pictures.
    pub(crate) fn load(&mut self, drawing: Arc<Drawing>) {
        self.drawing = Some(drawing);
        self.loaded = false;
    }

    /// Starts a picture.
    pub(crate) fn begin(&mut self, scene: &Scene, detail: Detail) {
        self.prepare(scene);
        let Scene { style, viewport, view, upto, .. } = scene;
        self.renderer.get_mut().begin_with(style, *viewport, *view, detail, *upto);
    }

    /// Starts a pane of a fine picture; only additive ink uses `pass`.
    pub(crate) fn begin_pane(&mut self, scene: &Scene, pane: Pane, pass: Pass) {
        self.prepare(scene);
        let Scene { style, viewport, view, upto, .. } = scene;
        match &mut self.renderer {
            InkRenderer::Covering(renderer) => renderer.begin_pane(style, *viewport, *view, *upto, pane),
            InkRenderer::Adding(renderer) => renderer.begin_pane(style, *viewport, *view, *upto, pane, pass),
        }
    }

    /// Loads the drawing into a renderer for the scene's ink.
    fn prepare(&mut self, scene: &Scene) {
        match (scene.style.ink, &self.renderer) {
            (Ink::Solid, InkRenderer::Covering(_)) | (Ink::Density, InkRenderer::Adding(_)) => {}
            (ink, _) => {
                self.renderer = match ink {
                    Ink::Solid => InkRenderer::covering(self.light),
                    Ink::Density => InkRenderer::Adding(Box::new(DensityRenderer::new())),
                };
                self.loaded = false;
            }
        }
        if let Some(drawing) = self.drawing.as_ref().filter(|_| !self.loaded) {
            self.renderer.get_mut().load(drawing.clone());
            self.loaded = true;
        }
    }

    /// Continues the picture for about `work` units.
    pub(crate) fn step(&mut self, work: usize) -> Progress {
        self.renderer.get_mut().step(work)
    }

    /// Whether the picture is not exact: pictures of parts compose it, or outlines stand for fine detail.
    pub(crate) fn is_rough(&self) -> bool {
        let RenderStats { outlines, parts, .. } = self.renderer.get().stats();
        outlines + parts > 0
    }

    /// The picture so far.
    pub(crate) fn pixels(&self) -> &[u8] {
        self.renderer.get().pixels()
    }
}
