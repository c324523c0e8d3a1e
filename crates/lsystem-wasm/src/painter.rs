//! Pictures on time: a coarse one first where the fine one takes longer than a frame.

use crate::clock::Clock;
use crate::playground::WORK;
use crate::surface::Surface;
use lsystem::{Detail, Drawing, Progress, Renderer, Style, View, Viewport};
use std::sync::Arc;
use wasm_bindgen::JsValue;

/// Milliseconds that a fine picture may take before a coarse one is shown in its stead.
const PATIENCE: f64 = 8.0;

/// What a picture is to show.
#[derive(Clone, PartialEq)]
pub(crate) struct Scene {
    pub(crate) style: Style,
    pub(crate) viewport: Viewport,
    pub(crate) view: View,
    /// How many segments; all of them without it.
    pub(crate) upto: Option<u128>,
}

/// Makes pictures and shows them.
pub(crate) struct Painter {
    pub(crate) surface: Surface,
    drawing: Option<Arc<Drawing>>,
    fine: Renderer,
    coarse: Renderer,
    /// Whether the coarse renderer has the drawing.
    sketches: bool,
    scene: Option<Scene>,
    stage: Stage,
    /// Milliseconds spent on the fine picture so far.
    spent: f64,
    /// Whether the last fine picture took too long to wait for it.
    slow: bool,
}

/// How far a picture is.
#[derive(Clone, Copy, PartialEq)]
enum Stage {
    /// The coarse picture is being made, before the fine one is begun or in its midst.
    Coarse { begun: bool },
    /// The fine picture is being made; a coarse one is shown already or need not be.
    Fine { sketched: bool },
    /// It is shown.
    Done,
}

impl Painter {
    pub(crate) fn new(surface: Surface) -> Self {
        Self {
            surface,
            drawing: None,
            fine: Renderer::new(),
            coarse: Renderer::new(),
            sketches: false,
            scene: None,
            stage: Stage::Done,
            spent: 0.0,
            slow: false,
        }
    }

    /// Takes the drawing that the next pictures are of.
    pub(crate) fn load(&mut self, drawing: Arc<Drawing>) {
        self.fine.load(drawing.clone());
        self.drawing = Some(drawing);
        self.sketches = false;
    }

    /// Starts a picture; one that is under way is given up.
    pub(crate) fn begin(&mut self, scene: Scene) {
        self.scene = Some(scene);
        if self.slow {
            self.begin_coarse(false);
        } else {
            self.begin_fine();
        }
    }

    /// Whether there is nothing more to do.
    pub(crate) fn is_done(&self) -> bool {
        self.stage == Stage::Done
    }

    /// Goes on with the picture; whether a new one is on the canvas, and if so whether it is the fine one.
    pub(crate) fn step(&mut self, clock: &Clock) -> Result<Option<bool>, JsValue> {
        let Some(viewport) = self.scene.as_ref().map(|scene| scene.viewport) else { return Ok(None) };
        match self.stage {
            Stage::Done => Ok(None),
            Stage::Coarse { begun } => {
                if self.coarse.step(WORK) == Progress::More {
                    return Ok(None);
                }
                self.surface.show(self.coarse.pixels(), viewport)?;
                if !begun {
                    self.begin_fine();
                }
                self.stage = Stage::Fine { sketched: true };
                Ok(Some(false))
            }
            Stage::Fine { sketched } => {
                let start = clock.now();
                let progress = self.fine.step(WORK);
                self.spent += clock.now() - start;
                if progress == Progress::Done {
                    self.slow = self.spent > PATIENCE;
                    self.stage = Stage::Done;
                    self.surface.show(self.fine.pixels(), viewport)?;
                    return Ok(Some(true));
                }
                if self.spent > PATIENCE {
                    self.slow = true;
                    if !sketched {
                        self.begin_coarse(true);
                    }
                }
                Ok(None)
            }
        }
    }

    fn begin_fine(&mut self) {
        if let Some(Scene { style, viewport, view, upto }) = &self.scene {
            self.fine.begin_with(style, *viewport, *view, Detail::Fine, *upto);
        }
        self.spent = 0.0;
        self.stage = Stage::Fine { sketched: false };
    }

    fn begin_coarse(&mut self, begun: bool) {
        if let Some(drawing) = self.drawing.as_ref().filter(|_| !self.sketches) {
            self.coarse.load(drawing.clone());
            self.sketches = true;
        }
        if let Some(Scene { style, viewport, view, upto }) = &self.scene {
            self.coarse.begin_with(style, *viewport, *view, Detail::Coarse, *upto);
        }
        self.stage = Stage::Coarse { begun };
    }
}
